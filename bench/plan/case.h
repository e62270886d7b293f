#pragma once

#include <compare>
#include <string>

#include "core/image/image.h"
#include "core/render/variant.h"

namespace ptb {

/// Work-group of a launch: 0 x 0 is implicit (the runtime chooses), y == 0 is one-dimensional.
struct WorkGroup {
    int x = 0, y = 0;
    bool implicit() const { return x == 0; }
    bool two_dimensional() const { return y != 0; }
    auto operator<=>(const WorkGroup&) const = default;
};

/// Who works at the same time as a case's device: nobody, all GPUs, or all devices, each at its own case.
enum class Together { no, gpus, all };

/// One point of the sweep. Plain data: two equal cases are the same work.
struct Case {
    std::string device;     ///< key of a DeviceInfo, "pocl:0"
    std::string kernel;     ///< id in the integrator registry, "pt"
    std::string scene;      ///< name of a shipped scene, or path of a scene file
    Size size;              ///< pixels
    int spp = 1;            ///< samples per pixel
    int path_length = 128;  ///< most segments in a path, the camera's included
    WorkGroup work_group;
    int lanes = 0;  ///< rays traced together by one work-item: 1, 4, 8, 16 or 32; 0 lets the device decide
    bool lanes_tuned = false, work_group_tuned = false;  ///< nobody named a value: `ptbench tune` found this
    Variant variant{};  ///< memory, queue, dispatch, pixel filter, random numbers, build
    int devices = 1;    ///< that make one picture: this one, and those of its type that follow; 0: all
    Together together = Together::no;
    auto operator<=>(const Case&) const = default;
};

}  // namespace ptb
