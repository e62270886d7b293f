#pragma once

#include <string>
#include <vector>

#include "bench/cli/command_text.h"

namespace ptb {

/// roff for man(1).
std::string man_page(const std::vector<CommandText>& commands, const std::string& version);

/// Completions for the shell of that name; they know commands, flags, and the values that are words.
std::string bash_completion(const std::vector<CommandText>& commands);
std::string zsh_completion(const std::vector<CommandText>& commands);

}  // namespace ptb
