#pragma once

#include <string>
#include <vector>

namespace ptb {

/// The whole file around its parts. `main` is HTML; `data` are texts as `packed` makes them; `scripts` are
/// names of embedded files.
std::string framed(const std::string& title, const std::string& main, const std::vector<std::string>& data,
                   const std::vector<std::string>& scripts);

/// A part of a page under a heading; nothing where there is nothing in it.
std::string part(const std::string& id, const std::string& heading, const std::string& html);

}  // namespace ptb
