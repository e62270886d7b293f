#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// What is looked at before a mesh's file is given to assimp, which believes what files say of themselves.
namespace ptb::mesh_formats {

/// A file, named as people know it.
struct File {
    std::filesystem::path path;
    std::uintmax_t bytes = 0;

    /// Throws UsageError "cannot read bunny.obj: why".
    [[noreturn]] void fail(const std::string& why) const;
    /// Up to `most` bytes from an offset.
    std::string part(std::uintmax_t offset, std::size_t most) const;
};

/// Refuses a file that does not begin like text.
void check_text(const File& file);
/// Refuses a file that is shorter than it says.
void check_stl(const File& file);
void check_ply(const File& file);

/// The triangles of a glTF or GLB document, and nothing else of it, as GLB whose parts are known to fit
/// together.
std::string bare_glb(const File& file);

/// Files beside a glTF or GLB document that its buffers are in.
std::vector<std::filesystem::path> buffer_files(const File& file);

}  // namespace ptb::mesh_formats
