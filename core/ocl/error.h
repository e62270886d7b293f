#pragma once

#include <stdexcept>
#include <string>

namespace ptb::ocl {

/// A failed OpenCL call. `what()` is one line: call and arguments, device, error name and code, hint.
class Error : public std::runtime_error {
  public:
    Error(std::string call, int code, const std::string& device, const std::string& hint = "");
    int code() const { return code_; }
    const std::string& call() const { return call_; }

  private:
    std::string call_;
    int code_;
};

/// A kernel that does not compile. `what()` is one line; `log()` is the driver's, with file and line.
class BuildError : public std::runtime_error {
  public:
    BuildError(const std::string& what, std::string log) : std::runtime_error(what), log_(std::move(log)) {}
    const std::string& log() const { return log_; }

  private:
    std::string log_;
};

/// "CL_INVALID_WORK_GROUP_SIZE" for -54; "unknown error" for what no OpenCL header names.
const char* error_name(int code);

}  // namespace ptb::ocl
