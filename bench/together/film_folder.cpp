#include "bench/together/film_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

fs::path place_for(std::uint64_t bytes) {
    const fs::path memory = "/dev/shm";
    std::error_code error;
    const fs::space_info space = fs::space(memory, error);
    const bool fits = !error && space.available >= bytes && ::access(memory.c_str(), W_OK) == 0;
    return fits ? memory : fs::temp_directory_path();
}

}  // namespace

FilmFolder::FilmFolder(std::uint64_t bytes) {
    std::string name = (place_for(bytes) / "ptbench-film-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error(fmt::format("cannot create {}: {}", name, std::strerror(errno)));
    path_ = name;
}

FilmFolder::~FilmFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace ptb
