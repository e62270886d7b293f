#pragma once

#include <string>
#include <vector>

#include "bench/doctor/remarks.h"

namespace ptb {

/// What `ptbench doctor` found.
struct Diagnosis {
    HostInfo host;
    DeviceList list;
    std::vector<SelfComparison> devices;
    std::vector<Remark> remarks;
};

/// Adds what there is to say of the devices.
void add_device_remarks(Diagnosis& diagnosis);

/// Warnings, then notes, then what is fine, each with its advice beneath.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// Schema "ptbench.doctor.v1".
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace ptb
