#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/tell.h"
#include "bench/record/continued.h"
#include "bench/worker/device_worker.h"

namespace {

int dispatch(const ptb::Options& options, const std::vector<std::string>& argv) {
    switch (options.command) {
        case ptb::Options::Command::text:
            ptb::put(stdout, options.text);
            return ptb::exit_codes::done;
        case ptb::Options::Command::list:
            return ptb::list_command(options);
        case ptb::Options::Command::render:
            return ptb::render_command(options);
        case ptb::Options::Command::compare:
            return ptb::compare_command(options);
        case ptb::Options::Command::ab:
            return ptb::ab_command(options, argv);
        case ptb::Options::Command::tune:
            return ptb::tune_command(options);
        case ptb::Options::Command::doctor:
            return ptb::doctor_command(options);
        case ptb::Options::Command::report:
            return ptb::report_command(options);
        case ptb::Options::Command::worker:
            return ptb::worker_command_line(options);
        case ptb::Options::Command::run:
            break;
    }
    return ptb::run_command(options, argv);
}

int fail(int code, const std::string& reason) {
    ptb::put(stderr, "error: " + reason + "\n");
    return code;
}

/// The exit code, unless what stdout should have got was lost.
int check_stdout(int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    const int lost = fail(ptb::exit_codes::failed, "stdout did not take everything");
    return code == ptb::exit_codes::done ? lost : code;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv, argv + argc);
    try {
        return check_stdout(dispatch(ptb::parse_options({words.begin() + 1, words.end()}), words));
    } catch (const ptb::Interrupted&) {
        return ptb::exit_codes::interrupted;
    } catch (const ptb::UsageError& error) {
        return fail(ptb::exit_codes::usage, error.what());
    } catch (const ptb::VersionMismatch& error) {
        return fail(ptb::exit_codes::not_comparable, error.what());
    } catch (const ptb::NotComparable& error) {
        return fail(ptb::exit_codes::not_comparable, error.what());
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(ptb::exit_codes::failed,
                    "cannot use " + error.path1().string() + ": " + error.code().message());
    } catch (const std::exception& error) {
        return fail(ptb::exit_codes::failed, error.what());
    }
}
