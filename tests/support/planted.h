#pragma once

#include <filesystem>
#include <string>

namespace ptb {

/// A text of the kernels with something wrong in it.
struct Planted {
    const char *name, *file, *right, *wrong;
};

/// A folder of kernels with this fault, until the next is planted. The test fails where the kernels have no
/// such text, or have it more than once.
std::filesystem::path plant(const Planted& fault);

}  // namespace ptb
