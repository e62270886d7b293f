#include "core/ocl/program.h"

#include <fmt/format.h>

namespace ptb::ocl {

namespace {

std::string build_log(const cl::Program& program, const cl::Device& device) {
    std::string log;
    if (program.getBuildInfo(device, CL_PROGRAM_BUILD_LOG, &log) != CL_SUCCESS) return "";
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
    return log;
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
        try {
            built.program.build({device.device}, options.c_str());
        } catch (const cl::Error& e) {
            if (e.err() != CL_BUILD_PROGRAM_FAILURE && e.err() != CL_COMPILE_PROGRAM_FAILURE) throw;
            const std::string log = build_log(built.program, device.device);
            throw BuildError(fmt::format("the kernel does not compile on \"{}\": {}", device.info.name,
                                         log.empty() ? "the driver left no log" : first_error(log)),
                             log);
        }
        built.log = build_log(built.program, device.device);
        return built;
    });
}

KernelFacts kernel_facts(const Device& device, const cl::Kernel& kernel) {
    return checked("kernel facts", device.info.name, [&] {
        KernelFacts facts;
        facts.max_work_group = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device.device);
        facts.preferred_multiple =
            kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(device.device);
        facts.local_bytes = kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device.device);
        facts.private_bytes = kernel.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(device.device);
        return facts;
    });
}

}  // namespace ptb::ocl
