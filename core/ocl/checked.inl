#pragma once

#include "core/ocl/error.h"

namespace ptb::ocl {

template <class Call>
auto checked(const std::string& arguments, const std::string& device, Call&& call) {
    try {
        return call();
    } catch (const cl::Error& e) {
        throw Error(std::string(e.what()) + "(" + arguments + ")", e.err(), device);
    }
}

}  // namespace ptb::ocl
