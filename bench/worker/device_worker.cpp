#include "bench/worker/device_worker.h"

#include <fmt/format.h>

namespace ptb {
namespace {

constexpr int tries_to_open = 2;

bool is_ready(const Reply& reply) {
    return reply.end == Reply::End::answered && reply.response.kind == Response::Kind::ready;
}

void check_version(const Response& answer) {
    if (answer.protocol == protocol_version) return;
    throw VersionMismatch(fmt::format(
        "the worker (ptbench {}) speaks protocol {}, this ptbench speaks {}; use the same version",
        answer.tool_version.empty() ? "of another version" : answer.tool_version, answer.protocol,
        protocol_version));
}

}  // namespace

bool DeviceWorker::ready() {
    while (!channel_ && given_up_.empty()) {
        const Reply reply = open();
        if (reply.end == Reply::End::answered) check_version(reply.response);
        if (is_ready(reply)) return true;
        channel_.reset();
        if (reply.end == Reply::End::interrupted) return false;
        judge(reply);
    }
    return channel_ != nullptr;
}

Reply DeviceWorker::open() {
    try {
        channel_ = open_(device_);
    } catch (const std::exception& error) {
        return {Reply::End::crashed, {}, error.what()};
    }
    Request request;
    request.kind = Request::Kind::open;
    request.measure = measure_;
    return channel_->request(request, [](const Response&) {});
}

void DeviceWorker::judge(const Reply& reply) {
    if (reply.end == Reply::End::answered) {
        given_up_ = fmt::format("{} cannot be opened: {}", device_.key, reply.response.reason);
    } else if (++failed_opens_ == tries_to_open) {
        given_up_ = fmt::format("the worker of {} fails to start: {}", device_.key, reply.reason);
    }
}

Reply DeviceWorker::request(const Request& request, const Channel::Progress& progress) {
    Reply reply = channel_->request(request, progress);
    if (reply.end != Reply::End::answered || reply.response.device_failed) channel_.reset();
    return reply;
}

}  // namespace ptb
