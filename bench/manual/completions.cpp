#include <fmt/format.h>

#include "bench/manual/manual.h"

namespace ptb {
namespace {

/// For the inside of '...' in a shell.
std::string quoted(const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return "'" + escaped + "'";
}

std::vector<std::string> all_flags(const CommandText& command) {
    std::vector<std::string> flags;
    for (const OptionText& option : command.options)
        flags.insert(flags.end(), option.flags.begin(), option.flags.end());
    return flags;
}

std::vector<std::string> command_names(const std::vector<CommandText>& commands) {
    std::vector<std::string> names{"run"};
    for (std::size_t i = 1; i < commands.size(); ++i) names.push_back(commands[i].name);
    return names;
}

std::vector<std::string> words_of(const OptionText& option) {
    return option.choices.empty() ? option.names : option.choices;
}

/// "    ab:--profile) COMPREPLY=(...) ;;", for options whose values are known.
std::string bash_values(const CommandText& command, const std::string& name) {
    std::string text;
    for (const OptionText& option : command.options) {
        if (words_of(option).empty() && !option.is_folder) continue;
        std::vector<std::string> patterns;
        for (const auto& flag : option.flags) patterns.push_back(fmt::format("{}:{}", name, flag));
        const std::string words = option.is_folder ? std::string("-d")
                                                   : fmt::format("{}-W '{}'", option.is_file ? "-f " : "",
                                                                 fmt::join(words_of(option), " "));
        text += fmt::format("        {}) mapfile -t COMPREPLY < <(compgen {} -- \"$word\"); return ;;\n",
                            fmt::join(patterns, " | "), words);
    }
    return text;
}

/// In the brackets of an _arguments specification.
std::string zsh_help(const std::string& help) {
    std::string escaped;
    for (const char c : help) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string zsh_option(const OptionText& option, const std::string& flag) {
    std::string action;
    if (option.is_folder)
        action = ":folder:_files -/";
    else if (option.is_file)
        action = fmt::format(":{}: _ptbench_names {}", option.value, fmt::join(words_of(option), " "));
    else if (!words_of(option).empty())
        action = fmt::format(":{}:({})", option.value, fmt::join(words_of(option), " "));
    else if (!option.value.empty())
        action = fmt::format(":{}:_files", option.value);
    return quoted(fmt::format("{}{}[{}]{}", action.empty() ? "" : "*", flag, zsh_help(option.help), action));
}

std::string zsh_arguments(const CommandText& command) {
    std::string text = "_arguments -S";
    for (const OptionText& option : command.options) {
        for (const auto& flag : option.flags) text += " \\\n            " + zsh_option(option, flag);
    }
    return text + " \\\n            '*:file:_files'";
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
    const auto names = command_names(commands);
    std::string text = "# bash completion of ptbench; generated from its --help\n_ptbench() {\n";
    text += "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=run\n";
    text += fmt::format(
        "    case ${{COMP_WORDS[1]}} in {}) command=${{COMP_WORDS[1]}} ;; esac\n    case $command:$before "
        "in\n",
        fmt::join(names, " | "));
    for (std::size_t i = 0; i < commands.size(); ++i) text += bash_values(commands[i], names[i]);
    text += "    esac\n    local words=''\n    case $command in\n";
    for (std::size_t i = 0; i < commands.size(); ++i)
        text += fmt::format("        {}) words='{}' ;;\n", names[i], fmt::join(all_flags(commands[i]), " "));
    text +=
        fmt::format("    esac\n    if [ \"$COMP_CWORD\" -eq 1 ] && [[ $word != -* ]]; then words='{}'; fi\n",
                    fmt::join(names, " "));
    text += "    if [ \"$COMP_CWORD\" -gt 1 ] && [[ $word != -* ]]; then words=''; fi\n";
    return text +
           "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n}\ncomplete -o bashdefault -o "
           "default -F _ptbench ptbench\n";
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
    const auto names = command_names(commands);
    std::string text =
        "#compdef ptbench\n# generated from ptbench --help\n"
        "_ptbench_names() { _alternative \"names:name:($*)\" 'files:file:_files' }\n"
        "_ptbench() {\n    local -a commands=(";
    for (std::size_t i = 0; i < commands.size(); ++i)
        text += fmt::format("\n        {}", quoted(names[i] + ":" +
                                                   (i == 0 ? "measure; what happens without a command"
                                                           : commands[i].description)));
    text +=
        ")\n    if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n        _describe command commands\n     "
        "   return\n    fi\n    case $words[2] in\n";
    for (std::size_t i = 1; i < commands.size(); ++i)
        text += fmt::format("        {})\n            {} ;;\n", names[i], zsh_arguments(commands[i]));
    return text + fmt::format("        *)\n            {} ;;\n    esac\n}}\n_ptbench \"$@\"\n",
                              zsh_arguments(commands[0]));
}

}  // namespace ptb
