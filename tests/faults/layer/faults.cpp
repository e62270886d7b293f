#include "tests/faults/layer/faults.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace ptb::faults {
namespace {

/// The call that a fault hits unless `call` says so, and the keys it has beside those of all faults.
struct Kind {
    const char* call;
    std::set<std::string> keys;
};
const std::map<std::string, Kind>& kinds() {
    static const std::map<std::string, Kind> all{
        {"timer", {"clGetEventProfilingInfo", {"how", "factor"}}},
        {"fail", {"clEnqueueNDRangeKernel", {"call", "code"}}},
        {"hang", {"clFinish", {"call"}}},
        {"crash", {"clEnqueueNDRangeKernel", {"call", "how"}}},
        {"lose", {"clEnqueueNDRangeKernel", {"call", "code"}}},
        {"corrupt", {"clEnqueueReadBuffer", {"pixels", "pixel_bytes", "factor"}}},
        {"say", {"clBuildProgram", {"call", "text", "to"}}},
        {"slow", {"clEnqueueNDRangeKernel", {"factor"}}},
    };
    return all;
}
const std::set<std::string> before_calls{"say", "fail", "hang", "crash", "lose"};
const std::set<std::string> keys_of_all{"from", "at", "count", "share", "kernel", "local", "once", "given"};

Fault parse_fault(const std::string& text) {
    std::istringstream words(text);
    Fault fault;
    words >> fault.kind;
    if (!kinds().contains(fault.kind)) throw std::runtime_error("no fault is called \"" + fault.kind + "\"");
    for (std::string word; words >> word;) {
        const auto split = word.find('=');
        const std::string key = word.substr(0, split);
        if (split == std::string::npos ||
            !(keys_of_all.contains(key) || kinds().at(fault.kind).keys.contains(key)))
            throw std::runtime_error(fault.kind + ": no such key: \"" + word + "\"");
        fault.values[key] = word.substr(split + 1);
    }
    return fault;
}

/// True for `share` of all numbers, spread evenly but in no pattern: Steele, Lea and Flood's SplitMix64.
bool falls_into(double share, std::uint64_t number) {
    std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) < share * 0x1p53;
}

void say(const Fault& fault) {
    const int to = fault.value("to", "stderr") == "stdout" ? STDOUT_FILENO : STDERR_FILENO;
    ::dprintf(to, "%s\n", fault.value("text", "1_warning_generated.").c_str());
}

[[noreturn]] void hang() {
    for (;;) ::pause();
}

[[noreturn]] void crash(const std::string& how, const std::string& call) {
    std::fprintf(stderr, "fault layer: %s in %s\n", how.c_str(), call.c_str());
    const int number = how == "kill" ? SIGKILL : how == "segv" ? SIGSEGV : SIGABRT;
    std::signal(number, SIG_DFL);  // a driver's handler may have other plans
    std::raise(number);
    std::abort();
}

}  // namespace

std::string Fault::value(const std::string& key, const std::string& otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : found->second;
}

double Fault::number(const std::string& key, double otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : std::stod(found->second);
}

std::vector<Fault> parse_faults(const std::string& text) {
    std::vector<Fault> faults;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ';');) faults.push_back(parse_fault(part));
    return faults;
}

bool Injector::aims_at_last_launch(const Fault& fault, const std::string& call) const {
    const std::string kernel = fault.value("kernel", last_kernel_);
    if (call == "clEnqueueNDRangeKernel" && kernel != last_kernel_) return false;
    const auto local = local_.find(kernel);
    if (local == local_.end()) return !fault.values.contains("kernel") && !fault.values.contains("local");
    return fault.number("local", static_cast<double>(local->second)) == static_cast<double>(local->second);
}

bool Injector::is_time_by_files(const Fault& fault) const {
    const std::string needed = fault.value("given", "");
    if (!needed.empty() && ::access(needed.c_str(), F_OK) != 0) return false;
    const std::string file = fault.value("once", "");
    if (file.empty()) return true;
    const int descriptor = ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0644);
    if (descriptor >= 0) ::close(descriptor);
    return descriptor >= 0;
}

bool Injector::fires(Fault& fault, const std::string& call) {
    if (fault.value("call", kinds().at(fault.kind).call) != call || !aims_at_last_launch(fault, call))
        return false;
    const auto number = static_cast<double>(++fault.calls);
    const double from = fault.number("at", fault.number("from", 1));
    const double unlimited = std::numeric_limits<double>::infinity();
    const double count = fault.number("count", fault.values.contains("at") ? 1 : unlimited);
    return number >= from && number < from + count && falls_into(fault.number("share", 1), fault.calls) &&
           is_time_by_files(fault);
}

cl_int Injector::before(const std::string& call) {
    for (Fault& fault : faults_) {
        if (!before_calls.contains(fault.kind)) continue;
        if (lost_ != CL_SUCCESS || !fires(fault, call)) continue;
        if (fault.kind == "say") say(fault);
        if (fault.kind == "hang") hang();
        if (fault.kind == "crash") crash(fault.value("how", "abort"), call);
        const auto code = static_cast<cl_int>(fault.number("code", CL_OUT_OF_RESOURCES));
        if (fault.kind == "fail") return code;
        if (fault.kind == "lose") lost_ = code;
    }
    return lost_;
}

void Injector::launching(cl_kernel kernel, cl_uint dimensions, const size_t* local) {
    char name[256] = "";
    driver_.clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, nullptr);
    last_kernel_ = name;
    size_t items = local == nullptr ? 0 : 1;
    for (cl_uint i = 0; i < dimensions && local != nullptr; ++i) items *= local[i];
    local_[last_kernel_] = items;
}

cl_ulong Injector::time_ns(cl_event event, cl_profiling_info name) const {
    cl_ulong ns = 0;
    driver_.clGetEventProfilingInfo(event, name, sizeof ns, &ns, nullptr);
    return ns;
}

/// A slowed launch is waited for, then the host sleeps, and its END is told as that much later: both clocks
/// agree, and whatever follows starts after it.
void Injector::launched(cl_command_queue queue, cl_event event) {
    longer_ns_.erase(event);  // a driver gives the address of a released event to a new one
    for (Fault& fault : faults_) {
        if (fault.kind != "slow" || !fires(fault, "clEnqueueNDRangeKernel")) continue;
        driver_.clFinish(queue);
        const auto ns = static_cast<double>(time_ns(event, CL_PROFILING_COMMAND_END) -
                                            time_ns(event, CL_PROFILING_COMMAND_START));
        longer_ns_[event] += static_cast<cl_ulong>(ns * (fault.number("factor", 2) - 1));
        std::this_thread::sleep_for(std::chrono::nanoseconds(longer_ns_[event]));
    }
}

namespace {

/// Red, green and blue of a pixel: three whole numbers in a film of 64 bytes a pixel, else three floats. What
/// is no number is the least whole one there.
void scale_pixel(char* pixel, std::size_t pixel_bytes, double factor) {
    for (int c = 0; c < 3; ++c) {
        if (pixel_bytes == 64) {
            auto& sum = reinterpret_cast<std::int64_t*>(pixel)[c];
            sum = std::isnan(factor) ? std::numeric_limits<std::int64_t>::min()
                                     : static_cast<std::int64_t>(static_cast<double>(sum) * factor);
        } else {
            reinterpret_cast<float*>(pixel)[c] *= static_cast<float>(factor);
        }
    }
}

}  // namespace

void Injector::was_read(void* data, size_t bytes) {
    for (Fault& fault : faults_) {
        if (fault.kind != "corrupt" || !fires(fault, "clEnqueueReadBuffer")) continue;
        const auto pixel_bytes = static_cast<size_t>(fault.number("pixel_bytes", 64));
        for (size_t i = 0; (i + 1) * pixel_bytes <= bytes; ++i) {
            if (!falls_into(fault.number("pixels", 1), i)) continue;
            scale_pixel(static_cast<char*>(data) + i * pixel_bytes, pixel_bytes, fault.number("factor", 0));
        }
    }
}

void Injector::was_timed(cl_event event, cl_profiling_info name, cl_ulong& time) {
    const auto longer = longer_ns_.find(event);
    if (longer != longer_ns_.end() && name == CL_PROFILING_COMMAND_END) time += longer->second;
    for (Fault& fault : faults_) {
        if (fault.kind != "timer" || !fires(fault, "clGetEventProfilingInfo")) continue;
        const std::string how = fault.value("how", "zero");
        if (how == "zero") time = 0;
        if (how == "scale")
            time = static_cast<cl_ulong>(static_cast<double>(time) * fault.number("factor", 1000));
        if (how == "swap" && name == CL_PROFILING_COMMAND_START)
            time = time_ns(event, CL_PROFILING_COMMAND_END);
        if (how == "swap" && name == CL_PROFILING_COMMAND_END)
            time = time_ns(event, CL_PROFILING_COMMAND_START);
        if (how == "underflow" && name == CL_PROFILING_COMMAND_END) time = cl_ulong{0} - 1000;
    }
}

}  // namespace ptb::faults
