#include "core/integrator/variant_support.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ptb {

std::string common_options(const ocl::Device& device, const RenderJob& job) {
    std::string text = "-cl-std=CL1.2";
    if (job.variant.build == BuildMode::relaxed)
        text += " -cl-fast-relaxed-math -cl-mad-enable -cl-denorms-are-zero";
    if (job.variant.build != BuildMode::strict) return text;
    text += " -DPTB_STRICT";
    const auto rounds = device.device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    if (rounds & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) text += " -cl-fp32-correctly-rounded-divide-sqrt";
    return text;
}

std::string launch_refusal(const ocl::Device& device, const RenderJob& job) {
    const auto properties = device.device.getInfo<CL_DEVICE_QUEUE_PROPERTIES>();
    if (job.variant.queue == QueueOrder::out_of_order &&
        !(properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE))
        return "queue out_of_order: this device has queues that work in order alone";
    if (job.variant.dispatch == Dispatch::tasks && job.work_group_x != 0)
        return "dispatch tasks: a task is one work-item, so work_group has to be implicit";
    return "";
}

std::string choice_refusal(const std::string& integrator, const std::string& axis, const Variant& variant,
                           const std::vector<std::string>& has) {
    const std::string& value = variant_value(axis, variant);
    if (std::find(has.begin(), has.end(), value) != has.end()) return "";
    return fmt::format("{} {}: {} has {}", axis, value, integrator, fmt::join(has, ", "));
}

}  // namespace ptb
