#include "bench/worker/device_worker.h"

#include <filesystem>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "core/scene/content.h"

namespace ptb {
namespace {

constexpr int tries_to_open = 2;

std::string hash_of_scene(const std::string& scene) {
    const std::filesystem::path file = scene_file(scene, data_dir());
    return std::filesystem::is_regular_file(file) ? scene_hash(file) : std::string();
}

bool is_ready(const Reply& reply) {
    return reply.end == Reply::End::answered && reply.response.kind == Response::Kind::ready;
}

void check_version(const Response& answer) {
    if (answer.protocol == protocol_version) return;
    throw VersionMismatch(
        fmt::format("the worker speaks protocol {}, this ptbench speaks {}; use the same version",
                    answer.protocol, protocol_version));
}

}  // namespace

bool DeviceWorker::ready() {
    while (!channel_ && given_up_.empty()) {
        const Reply reply = open();
        if (reply.end == Reply::End::answered) check_version(reply.response);
        if (is_ready(reply)) {
            check_facts(reply.response);
            return true;
        }
        close();
        if (reply.end == Reply::End::interrupted) return false;
        if (given_up_.empty()) judge(reply);
    }
    return channel_ != nullptr;
}

Reply DeviceWorker::open() {
    try {
        channel_ = open_(device_);
    } catch (const std::exception& error) {
        return {Reply::End::crashed, {}, error.what(), {}};
    }
    Request request;
    request.kind = Request::Kind::open;
    request.measure = measure_;
    return channel_->request(request, [](const Response&) {}, {});
}

void DeviceWorker::check_facts(const Response& ready) {
    if (!facts_) facts_ = ready.facts;
    if (ready.facts == *facts_) return;
    throw VersionMismatch(
        fmt::format("the worker of {} is of something else: {}; use the same build and kernels", device_.key,
                    fmt::join(differences(ready.facts.facts, "there", facts_->facts, "here"), "; ")));
}

void DeviceWorker::judge(const Reply& reply) {
    if (reply.end == Reply::End::answered) {
        given_up_ = fmt::format("{} cannot be opened: {}", device_.key, reply.response.reason);
    } else if (++failed_opens_ == tries_to_open || reply.end == Reply::End::not_started) {
        given_up_ = fmt::format("the worker of {} fails to start: {}", device_.key, reply.reason);
    }
}

/// A compiler prints when a kernel is built, which an estimate may do before the first record.
void DeviceWorker::keep_printed(const std::string& kernel, Reply& reply) {
    std::string& printed = printed_[kernel];
    if (!reply.printed.empty()) printed += (printed.empty() ? "" : "\n") + reply.printed;
    if (printed.empty() || !reply.response.record || !reply.response.record->build) return;
    std::string& log = reply.response.record->build->log;
    log += fmt::format("{}printed by the driver:\n{}", log.empty() ? "" : "\n", printed);
    printed.clear();
}

Reply DeviceWorker::request(const Request& request, const Channel::Progress& progress,
                            const Stopped& enough) {
    Request complete = request;
    if (is_as_here_ && !request.params.scene.empty())
        complete.scene_hash = hash_of_scene(request.params.scene);
    Reply reply = channel_->request(complete, progress, enough);
    keep_printed(request.params.kernel, reply);
    if (reply.end != Reply::End::answered || reply.response.device_failed) close();
    return reply;
}

void DeviceWorker::close() {
    if (channel_ && !channel_->end())
        given_up_ = fmt::format("an earlier worker of {} may still run and would disturb", device_.key);
    channel_.reset();
}

}  // namespace ptb
