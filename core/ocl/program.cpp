#include "core/ocl/program.h"

#include <charconv>

#include <fmt/format.h>

namespace ptb::ocl {

bool takes_nvidia_options(const Device& device) { return device.info.platform == "NVIDIA CUDA"; }

namespace {

std::string build_log(const cl::Program& program, const cl::Device& device) {
    std::string log;
    try {
        program.getBuildInfo(device, CL_PROGRAM_BUILD_LOG, &log);
    } catch (const cl::Error&) {
        return "";  // no reason to forget how the build went
    }
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    return log;
}

/// Asks NVIDIA's compiler for registers and spills; the code is the same.
std::string asked_log(const Device& device) { return takes_nvidia_options(device) ? " -cl-nv-verbose" : ""; }

std::optional<std::uint64_t> number_between(std::string_view text, std::string_view before,
                                            std::string_view after) {
    const auto end = text.find(after);
    const auto begin = end == text.npos ? text.npos : text.rfind(before, end);
    if (begin == text.npos) return std::nullopt;
    const char* const first = text.data() + begin + before.size();
    std::uint64_t value = 0;
    if (std::from_chars(first, text.data() + end, value).ptr != text.data() + end) return std::nullopt;
    return value;
}

std::optional<std::uint64_t> binary_bytes(const cl::Program& program) {
    try {
        const auto sizes = program.getInfo<CL_PROGRAM_BINARY_SIZES>();
        if (sizes.size() == 1 && sizes[0] > 0) return sizes[0];
    } catch (const cl::Error&) {  // some drivers keep none
    }
    return std::nullopt;
}

/// The first line of a log that speaks of an error, else its first line.
std::string first_error(const std::string& log) {
    const auto at = log.find("error");
    const auto begin = at == std::string::npos ? 0 : log.rfind('\n', at) + 1;  // npos + 1 is 0
    return log.substr(begin, log.find('\n', begin) - begin);
}

}  // namespace

Program build(const Device& device, const KernelSource& source, const std::string& options) {
    return checked(options, device.info.name, [&] {
        Program built{cl::Program(device.context, source.text), options, source.hash, source.overridden, ""};
        // Not the binding's build(): where a driver has no log either, that one throws away the error.
        const cl_device_id id = device.device();
        const std::string all = options + asked_log(device);
        const cl_int code = clBuildProgram(built.program(), 1, &id, all.c_str(), nullptr, nullptr);
        built.log = build_log(built.program, device.device);
        if (code == CL_BUILD_PROGRAM_FAILURE || code == CL_COMPILE_PROGRAM_FAILURE)
            throw BuildError(
                fmt::format("the kernel does not compile on \"{}\": {}", device.info.name,
                            built.log.empty() ? "the driver left no log" : first_error(built.log)),
                built.log);
        if (code != CL_SUCCESS) throw cl::Error(code, "clBuildProgram");
        return built;
    });
}

LogFacts log_facts(std::string_view log, std::string_view kernel) {
    const auto begin = log.find(fmt::format("entry function '{}'", kernel));
    if (begin == log.npos) return {};
    log = log.substr(begin);
    log = log.substr(0, log.find("entry function", 1));
    return {number_between(log, "Used ", " registers"), number_between(log, ", ", " bytes spill stores"),
            number_between(log, ", ", " bytes spill loads")};
}

KernelFacts kernel_facts(const Device& device, const cl::Kernel& kernel) {
    return checked("kernel facts", device.info.name, [&] {
        KernelFacts facts;
        facts.max_work_group = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device.device);
        facts.preferred_multiple =
            kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(device.device);
        facts.local_bytes = kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device.device);
        facts.private_bytes = kernel.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(device.device);
        const cl::Program program = kernel.getInfo<CL_KERNEL_PROGRAM>();
        facts.binary_bytes = binary_bytes(program);
        facts.log = log_facts(build_log(program, device.device), kernel.getInfo<CL_KERNEL_FUNCTION_NAME>());
        return facts;
    });
}

}  // namespace ptb::ocl
