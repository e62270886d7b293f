#include "bench/cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "bench/cli/exit_code.h"

namespace ptb {
namespace {

// A signal handler can only reach what is global.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int) {
    if (interrupted.exchange(true)) ::_exit(exit_codes::interrupted);
}

}  // namespace

const std::atomic<bool>& watch_for_interruption() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    return interrupted;
}

}  // namespace ptb
