#include "bench/worker/request_lines.h"

#include <cstdlib>
#include <istream>
#include <utility>

#include "bench/worker/protocol.h"

namespace ptb {
namespace {

/// The number of the request that a line stops, or 0.
std::int64_t stopped_by(const std::string& line) {
    try {
        const Request request = parse_request(line);
        return request.kind == Request::Kind::stop ? request.number : 0;
    } catch (const std::exception&) {
        return 0;  // whoever answers the line says what is wrong with it
    }
}

}  // namespace

RequestLines::RequestLines(std::istream& in) : reader_([this, &in] { read(in); }) {}

std::optional<std::string> RequestLines::next() {
    std::unique_lock lock(mutex_);
    is_idle_ = true;
    changed_.wait(lock, [this] { return is_ended_ || !lines_.empty(); });
    if (lines_.empty()) return std::nullopt;
    is_idle_ = false;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
}

bool RequestLines::is_stopped(std::int64_t number) const {
    const std::lock_guard lock(mutex_);
    return stopped_ >= number;
}

void RequestLines::read(std::istream& in) {
    for (std::string line; std::getline(in, line);) take(std::move(line));
    finish();
}

void RequestLines::take(std::string line) {
    const std::int64_t stopped = stopped_by(line);
    const std::lock_guard lock(mutex_);
    if (stopped > 0)
        stopped_ = stopped;
    else
        lines_.push_back(std::move(line));
    changed_.notify_one();
}

void RequestLines::finish() {
    const std::lock_guard lock(mutex_);
    if (!is_idle_ || !lines_.empty()) std::_Exit(EXIT_SUCCESS);
    is_ended_ = true;
    changed_.notify_one();
}

}  // namespace ptb
