#include "core/ocl/error.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/ocl/opencl.h"

namespace ptb::ocl {

namespace {

#define PTB_CODE(name) \
    std::pair<int, const char*> { name, #name }
constexpr std::array codes{
    PTB_CODE(CL_DEVICE_NOT_FOUND),
    PTB_CODE(CL_DEVICE_NOT_AVAILABLE),
    PTB_CODE(CL_COMPILER_NOT_AVAILABLE),
    PTB_CODE(CL_MEM_OBJECT_ALLOCATION_FAILURE),
    PTB_CODE(CL_OUT_OF_RESOURCES),
    PTB_CODE(CL_OUT_OF_HOST_MEMORY),
    PTB_CODE(CL_PROFILING_INFO_NOT_AVAILABLE),
    PTB_CODE(CL_MEM_COPY_OVERLAP),
    PTB_CODE(CL_IMAGE_FORMAT_MISMATCH),
    PTB_CODE(CL_IMAGE_FORMAT_NOT_SUPPORTED),
    PTB_CODE(CL_BUILD_PROGRAM_FAILURE),
    PTB_CODE(CL_MAP_FAILURE),
    PTB_CODE(CL_MISALIGNED_SUB_BUFFER_OFFSET),
    PTB_CODE(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
    PTB_CODE(CL_COMPILE_PROGRAM_FAILURE),
    PTB_CODE(CL_LINKER_NOT_AVAILABLE),
    PTB_CODE(CL_LINK_PROGRAM_FAILURE),
    PTB_CODE(CL_INVALID_VALUE),
    PTB_CODE(CL_INVALID_DEVICE_TYPE),
    PTB_CODE(CL_INVALID_PLATFORM),
    PTB_CODE(CL_INVALID_DEVICE),
    PTB_CODE(CL_INVALID_CONTEXT),
    PTB_CODE(CL_INVALID_QUEUE_PROPERTIES),
    PTB_CODE(CL_INVALID_COMMAND_QUEUE),
    PTB_CODE(CL_INVALID_HOST_PTR),
    PTB_CODE(CL_INVALID_MEM_OBJECT),
    PTB_CODE(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
    PTB_CODE(CL_INVALID_IMAGE_SIZE),
    PTB_CODE(CL_INVALID_SAMPLER),
    PTB_CODE(CL_INVALID_BINARY),
    PTB_CODE(CL_INVALID_BUILD_OPTIONS),
    PTB_CODE(CL_INVALID_PROGRAM),
    PTB_CODE(CL_INVALID_PROGRAM_EXECUTABLE),
    PTB_CODE(CL_INVALID_KERNEL_NAME),
    PTB_CODE(CL_INVALID_KERNEL_DEFINITION),
    PTB_CODE(CL_INVALID_KERNEL),
    PTB_CODE(CL_INVALID_ARG_INDEX),
    PTB_CODE(CL_INVALID_ARG_VALUE),
    PTB_CODE(CL_INVALID_ARG_SIZE),
    PTB_CODE(CL_INVALID_KERNEL_ARGS),
    PTB_CODE(CL_INVALID_WORK_DIMENSION),
    PTB_CODE(CL_INVALID_WORK_GROUP_SIZE),
    PTB_CODE(CL_INVALID_WORK_ITEM_SIZE),
    PTB_CODE(CL_INVALID_GLOBAL_OFFSET),
    PTB_CODE(CL_INVALID_EVENT_WAIT_LIST),
    PTB_CODE(CL_INVALID_EVENT),
    PTB_CODE(CL_INVALID_OPERATION),
    PTB_CODE(CL_INVALID_BUFFER_SIZE),
    PTB_CODE(CL_INVALID_GLOBAL_WORK_SIZE),
    PTB_CODE(CL_INVALID_PROPERTY),
    std::pair<int, const char*>{-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
};
#undef PTB_CODE

std::string describe(const std::string& call, int code, const std::string& device, const std::string& hint) {
    std::string line = call;
    if (!device.empty()) line += fmt::format(" on \"{}\"", device);
    line += fmt::format(": {} ({})", error_name(code), code);
    if (!hint.empty()) line += "; " + hint;
    return line;
}

}  // namespace

const char* error_name(int code) {
    for (const auto& [value, name] : codes)
        if (value == code) return name;
    return "unknown error";
}

Error::Error(std::string call, int code, const std::string& device, const std::string& hint)
    : std::runtime_error(describe(call, code, device, hint)), call_(std::move(call)), code_(code) {}

}  // namespace ptb::ocl
