#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/worker/device_worker.h"

namespace {

int dispatch(const ptb::Options& options, const std::vector<std::string>& argv) {
    switch (options.command) {
        case ptb::Options::Command::text:
            fmt::print("{}", options.text);
            return ptb::exit_codes::done;
        case ptb::Options::Command::list:
            return ptb::list_command(options);
        case ptb::Options::Command::render:
            return ptb::render_command(options);
        case ptb::Options::Command::worker:
            return ptb::worker_command_line(options);
        case ptb::Options::Command::run:
            break;
    }
    return ptb::run_command(options, argv);
}

int fail(int code, const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv, argv + argc);
    try {
        return dispatch(ptb::parse_options({words.begin() + 1, words.end()}), words);
    } catch (const ptb::UsageError& error) {
        return fail(ptb::exit_codes::usage, error);
    } catch (const ptb::VersionMismatch& error) {
        return fail(ptb::exit_codes::not_comparable, error);
    } catch (const std::exception& error) {
        return fail(ptb::exit_codes::failed, error);
    }
}
