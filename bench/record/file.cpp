#include "bench/record/file.h"

#include <stdexcept>

#include "core/file/replace_file.h"

namespace ptb {

void write_file(const std::filesystem::path& file, std::string_view text) {
    if (const std::error_code error = replace_file(file, text))
        throw std::runtime_error("cannot write " + file.string() + ": " + error.message());
}

}  // namespace ptb
