#pragma once

#include <string>
#include <vector>

namespace ptb {

/// One option as --help has it.
struct OptionText {
    std::vector<std::string> flags;  ///< "-d", "--device"; none for the words of a command, such as files
    std::string value;               ///< "TEXT", "INT", ...; empty for one that takes no value
    std::vector<std::string> choices;
    std::vector<std::string> names;  ///< values that are known, beside others
    bool is_folder = false, is_file = false;
    std::string help, variable;  ///< `variable`: of the environment, or empty
    bool operator==(const OptionText&) const = default;
};

/// One command as --help has it; the first of a program is named after it.
struct CommandText {
    std::string name, description;
    std::vector<OptionText> options;
    bool operator==(const CommandText&) const = default;
};

}  // namespace ptb
