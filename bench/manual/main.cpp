// Writes the man page or a shell's completions, from what --help is made of: ptbench_manual man|bash|zsh
#include <cstdio>
#include <string_view>

#include "bench/cli/options.h"
#include "bench/manual/manual.h"
#include "bench/version.h"

int main(int argc, char** argv) {
    const std::string_view what = argc == 2 ? argv[1] : "";
    const auto commands = ptb::command_texts();
    const std::string text = what == "man"    ? ptb::man_page(commands, ptb::version::tool)
                             : what == "bash" ? ptb::bash_completion(commands)
                             : what == "zsh"  ? ptb::zsh_completion(commands)
                                              : "";
    if (text.empty()) std::fputs("usage: ptbench_manual man|bash|zsh\n", stderr);
    return !text.empty() && std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0 ? 0 : 2;
}
