// The OpenCL layer itself: a copy of the driver's dispatch table in which the calls that ptbench makes pass
// through the faults first. See "OpenCL ICD Loader", by Khronos, section on layers.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <tuple>
#include <type_traits>

#include <CL/cl_layer.h>

#include "tests/faults/layer/faults.h"

namespace {

using ptb::faults::Injector;

const char* environment(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

std::vector<ptb::faults::Fault> faults_asked_for() {
    try {
        return ptb::faults::parse_faults(environment("PTB_FAULT"));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "PTB_FAULT: %s\n", error.what());
        std::_Exit(99);
    }
}

/// The loader calls plain functions, so what they share can be nowhere else.
cl_icd_dispatch& driver() {
    static cl_icd_dispatch table{};
    return table;
}
Injector& injector() {
    static Injector only(faults_asked_for(), driver());
    return only;
}

template <class Result, class... Args>
Result failed(cl_int code, Args... args) {
    if constexpr (std::is_same_v<Result, cl_int>) {
        return code;
    } else {  // it makes an object, and its last argument takes the code
        cl_int* const error = std::get<sizeof...(Args) - 1>(std::tuple(args...));
        if (error != nullptr) *error = code;
        return nullptr;
    }
}

template <class Entry>
struct MemberOf;
template <class Function>
struct MemberOf<Function cl_icd_dispatch::*> {
    using type = Function;
};

/// A function of the same type as a call of OpenCL: `with` puts it before the driver's.
template <auto entry, class Function = typename MemberOf<decltype(entry)>::type>
struct Hook;
template <auto entry, class Result, class... Args>
struct Hook<entry, Result (*)(Args...)> {
    static inline const char* name = "";
    static Result CL_API_CALL call(Args... args) {
        const cl_int code = injector().before(name);
        return code != CL_SUCCESS ? failed<Result>(code, args...) : (driver().*entry)(args...);
    }
    static void put_into(cl_icd_dispatch& table, const char* call_name) {
        name = call_name;
        table.*entry = call;
    }
};

cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                          const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait_list,
                          cl_event* event) {
    injector().launching(kernel, dimensions, local);
    cl_int code = injector().before("clEnqueueNDRangeKernel");
    if (code == CL_SUCCESS)
        code = driver().clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local, waits,
                                               wait_list, event);
    if (code == CL_SUCCESS && event != nullptr) injector().launched(queue, *event);
    return code;
}

cl_int CL_API_CALL read(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes,
                        void* data, cl_uint waits, const cl_event* wait_list, cl_event* event) {
    cl_int code = injector().before("clEnqueueReadBuffer");
    if (code == CL_SUCCESS)
        code = driver().clEnqueueReadBuffer(queue, buffer, blocking, offset, bytes, data, waits, wait_list,
                                            event);
    if (code == CL_SUCCESS && blocking != CL_FALSE) injector().was_read(data, bytes);
    return code;
}

cl_int CL_API_CALL event_time(cl_event event, cl_profiling_info name, size_t bytes, void* value,
                              size_t* bytes_needed) {
    cl_int code = injector().before("clGetEventProfilingInfo");
    if (code == CL_SUCCESS) code = driver().clGetEventProfilingInfo(event, name, bytes, value, bytes_needed);
    if (code == CL_SUCCESS && value != nullptr)
        injector().was_timed(event, name, *static_cast<cl_ulong*>(value));
    return code;
}

cl_icd_dispatch layered() {
    cl_icd_dispatch table = driver();
#define PTB_HOOK(name) Hook<&cl_icd_dispatch::name>::put_into(table, #name)
    PTB_HOOK(clGetPlatformIDs);
    PTB_HOOK(clGetDeviceIDs);
    PTB_HOOK(clGetDeviceInfo);
    PTB_HOOK(clCreateContext);
    PTB_HOOK(clCreateCommandQueue);
    PTB_HOOK(clCreateProgramWithSource);
    PTB_HOOK(clBuildProgram);
    PTB_HOOK(clCreateKernel);
    PTB_HOOK(clGetKernelWorkGroupInfo);
    PTB_HOOK(clSetKernelArg);
    PTB_HOOK(clCreateBuffer);
    PTB_HOOK(clEnqueueFillBuffer);
    PTB_HOOK(clEnqueueWriteBuffer);
    PTB_HOOK(clFinish);
#undef PTB_HOOK
    table.clEnqueueNDRangeKernel = launch;
    table.clEnqueueReadBuffer = read;
    table.clGetEventProfilingInfo = event_time;
    return table;
}

}  // namespace

CL_API_ENTRY cl_int CL_API_CALL clGetLayerInfo(cl_layer_info name, size_t bytes, void* value,
                                               size_t* bytes_needed) {
    if (name != CL_LAYER_API_VERSION) return CL_INVALID_VALUE;
    const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
    if (value != nullptr && bytes < sizeof version) return CL_INVALID_VALUE;
    if (value != nullptr) std::memcpy(value, &version, sizeof version);
    if (bytes_needed != nullptr) *bytes_needed = sizeof version;
    return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clInitLayer(cl_uint entries, const cl_icd_dispatch* target,
                                            cl_uint* entries_here, const cl_icd_dispatch** table) {
    constexpr cl_uint all = sizeof(cl_icd_dispatch) / sizeof(void*);
    std::memcpy(&driver(), target, std::min(entries, all) * sizeof(void*));
    injector();  // a mistake in PTB_FAULT shows now
    static const cl_icd_dispatch with_faults = layered();
    *entries_here = std::min(entries, all);
    *table = &with_faults;
    return CL_SUCCESS;
}
