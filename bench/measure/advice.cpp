#include "bench/measure/advice.h"

#include "bench/measure/causes.h"

namespace ptb {

namespace {

std::string clock_advice(const Place& place) {
    const std::string moved = "the device's clock moved: ";
    if (!place.cpu_device) return moved + "let it cool, or lock its clock (NVIDIA: `nvidia-smi -lgc`)";
    if (place.host.virtual_machine)
        return moved + "the host of a virtual machine decides on it; compare side by side (`ptbench ab`)";
    if (place.host.battery) return moved + "plug the machine in, and let it cool";
    if (place.host.container) return moved + "it is set outside of this container; let the machine cool";
    return moved + "let it cool, or fix its clock (`ptbench doctor` says how)";
}

std::string busy_advice(const Place& place) {
    if (place.host.container)
        return "other programs, perhaps outside of this container, take CPU time: end them, or give it CPUs "
               "of "
               "its own (`docker run --cpuset-cpus`)";
    return "other programs take CPU time: end what `top` shows";
}

std::string unexplained_advice(const Place& place) {
    if (place.cpu_device && place.host.virtual_machine)
        return "neighbours of a virtual machine may leave no trace: take longer (--max-time), or compare "
               "side "
               "by side (`ptbench ab`)";
    return "end other programs, or take longer (--max-time)";
}

}  // namespace

std::string advice(const std::string& why, const Place& place) {
    if (why == cause::clock_low) return clock_advice(place);
    if (why == cause::busy) return busy_advice(place);
    if (why == cause::steal)
        return "other virtual machines take this one's CPU time: measure at a quieter time, or side by side "
               "(`ptbench ab`)";
    if (why == cause::timer_fault) return "the device's event times are wrong: use --timer auto or host";
    if (why == cause::clocks_differ)
        return "the host waited much longer than the events last, as on a busy machine: end other programs, "
               "or "
               "use --timer host";
    if (why == cause::first) return "take more samples (--min-samples)";
    return unexplained_advice(place);
}

}  // namespace ptb
