#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ptb {

/// One self-contained text for a driver: includes flattened, with #line directives that keep files and lines.
struct KernelSource {
    std::string text;
    std::string hash;         ///< of the text
    bool overridden = false;  ///< at least one file came from the override folder
};

struct SourceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Names of the embedded kernel files, "pt/pt.cl", sorted.
std::vector<std::string> embedded_files();

/// The flattened text of `file` ("pt/pt.cl"). Each `#include "..."` is looked for in `override_folder` (when
/// not empty), then among the embedded files. Throws SourceError when a file is nowhere, naming who includes
/// it.
KernelSource kernel_source(const std::string& file, const std::filesystem::path& override_folder = {});

}  // namespace ptb
