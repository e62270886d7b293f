#include <string_view>

#include <fmt/format.h>

#include "bench/cli/exit_code.h"
#include "bench/manual/manual.h"

namespace ptb {
namespace {

/// Text for roff: no hyphens that break or turn into dashes, no line that begins with a request.
std::string roff(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n'))
            escaped += std::string("\\&") + c;
        else
            escaped += c;
    }
    return escaped;
}

std::string option_entry(const OptionText& option) {
    std::vector<std::string> flags;
    for (const auto& flag : option.flags) flags.push_back("\\fB" + roff(flag) + "\\fR");
    std::string text = ".TP\n" + fmt::format("{}", fmt::join(flags, ", "));
    const std::string value =
        option.choices.empty() ? option.value : fmt::format("{}", fmt::join(option.choices, "|"));
    if (!value.empty()) text += fmt::format("{}\\fI{}\\fR", flags.empty() ? "" : " ", roff(value));
    text += "\n" + roff(option.help);
    if (!option.variable.empty()) text += fmt::format(" (\\fB{}\\fR)", roff(option.variable));
    return text + "\n";
}

std::string command_section(const CommandText& command, bool is_program) {
    std::string text = is_program
                           ? ".SH OPTIONS\n"
                           : fmt::format(".SS {}\n{}.\n", roff(command.name), roff(command.description));
    for (const OptionText& option : command.options) text += option_entry(option);
    return text;
}

std::string exit_status() {
    std::string text = ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : exit_code_meanings)
        text += fmt::format(".TP\n{}\n{}\n", code, roff(meaning));
    return text;
}

constexpr auto files = R"(.SH FILES
.TP
\fIptbench\-results/TIME\-CONFIG/\fR
Outputs of a run: result.json, table.csv, table.md, journal.jsonl, one picture per device.
.TP
\fI../share/ptbench/\fR
Beside the program's folder: configs, scenes, schemas and references; \fBPTBENCH_DATA_DIR\fR names another place.
)";

constexpr auto examples = R"(.SH EXAMPLES
.TP
ptbench \-\-all\-devices
Measures every OpenCL device under config quick.
.TP
ptbench \-d cpu \-\-kernel pt \-\-spp 10,100 \-\-wg implicit,64 \-\-csv times.csv
A sweep of samples per pixel and work\-groups.
.TP
ptbench ab \-\-base old/ptbench \-\-new new/ptbench
Two builds, measured alternately; the exit status says whether the new one is slower.
.SH SEE ALSO
.BR clinfo (1)
)";

}  // namespace

std::string man_page(const std::vector<CommandText>& commands, const std::string& version) {
    const CommandText& program = commands.front();
    std::string text = fmt::format(".TH PTBENCH 1 \"\" \"ptbench {}\" \"User Commands\"\n", roff(version));
    text += ".SH NAME\nptbench \\- how fast OpenCL devices trace light\n.SH SYNOPSIS\n";
    text += ".B ptbench\n[\\fBrun\\fR] [\\fIOPTIONS\\fR]\n";
    for (std::size_t i = 1; i < commands.size(); ++i)
        text += fmt::format(".br\n.B ptbench {}\n[\\fIOPTIONS\\fR]\n", roff(commands[i].name));
    text += ".SH DESCRIPTION\n" + roff(program.description) + "\n";
    text += command_section(program, true);
    text += ".SH COMMANDS\n";
    for (std::size_t i = 1; i < commands.size(); ++i) text += command_section(commands[i], false);
    return text + exit_status() + files + examples;
}

}  // namespace ptb
