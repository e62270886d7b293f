#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <CL/cl_icd.h>

namespace ptb::faults {

/// One fault of PTB_FAULT: "kind key=value ...".
struct Fault {
    std::string kind;
    std::map<std::string, std::string> values;
    std::uint64_t calls = 0;  ///< that this fault could have hit so far
    std::string value(const std::string& key, const std::string& otherwise) const;
    double number(const std::string& key, double otherwise) const;
};

/// Throws std::runtime_error on a kind or a key that does not exist.
std::vector<Fault> parse_faults(const std::string& text);

/// The faults of a process and what they need to know of it. For one thread: ptbench calls from no other.
class Injector {
  public:
    Injector(std::vector<Fault> faults, const cl_icd_dispatch& driver)
        : faults_(std::move(faults)), driver_(driver) {}

    /// Hangs or ends the process, or returns the code with which the call shall fail, or CL_SUCCESS.
    cl_int before(const std::string& call);

    void launching(cl_kernel kernel, cl_uint dimensions, const size_t* local);
    void launched(cl_command_queue queue, cl_event event);
    void was_read(void* data, size_t bytes);
    void was_timed(cl_event event, cl_profiling_info name, cl_ulong& time_ns);

  private:
    bool fires(Fault& fault, const std::string& call);
    bool aims_at_last_launch(const Fault& fault, const std::string& call) const;
    bool is_time_by_files(const Fault& fault) const;
    cl_ulong time_ns(cl_event event, cl_profiling_info name) const;

    std::vector<Fault> faults_;
    const cl_icd_dispatch& driver_;
    cl_int lost_ = CL_SUCCESS;                ///< with what every call fails once the device is lost
    std::string last_kernel_;                 ///< of the last launch
    std::map<std::string, size_t> local_;     ///< work-group of each kernel's last launch, 0 when implicit
    std::map<cl_event, cl_ulong> longer_ns_;  ///< of slowed launches
};

}  // namespace ptb::faults
