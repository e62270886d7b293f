#include "bench/together/hand_out.h"

#include <algorithm>
#include <utility>

namespace ptb {
namespace {

constexpr double least_s = 0.020;  ///< of work: so much one device may end later than the others
constexpr double of_share = 0.5;
constexpr std::uint64_t growth = 8;  ///< a piece is at most so many times as large as the one before

}  // namespace

std::vector<PartRange> joined(std::vector<PartRange> ranges) {
    std::sort(ranges.begin(), ranges.end());
    std::vector<PartRange> result;
    for (const PartRange& range : ranges) {
        if (!result.empty() && result.back().end == range.first)
            result.back().end = range.end;
        else
            result.push_back(range);
    }
    return result;
}

HandOut::HandOut(std::vector<PartRange> open, std::uint64_t round_parts, std::vector<double> parts_per_s,
                 MoreParts more)
    : open_(std::move(open)),
      round_parts_(round_parts),
      more_(std::move(more)),
      devices_(parts_per_s.size()) {
    for (std::size_t i = 0; i < devices_.size(); ++i) devices_[i].parts_per_s = parts_per_s[i];
}

HandOut::HandOut(std::vector<std::vector<PartRange>> own) : is_demand_(false), devices_(own.size()) {
    for (std::size_t i = 0; i < devices_.size(); ++i) devices_[i].own = std::move(own[i]);
}

std::optional<PartRange> HandOut::next(std::size_t device) {
    const std::lock_guard lock(mutex_);
    Device& asking = devices_[device];
    if (!is_stopped_ && open_.empty() && more_)
        if (const auto more = more_()) open_.push_back(*more);
    if (is_stopped_ || !is_work_left(device)) return std::nullopt;
    if (is_demand_) {
        asking.given = cut_from_open(wanted_by(asking));
    } else {
        asking.given = asking.own.front();
        asking.own.erase(asking.own.begin());
    }
    return asking.given;
}

std::uint64_t HandOut::wanted_by(const Device& device) const {
    double all = 0;
    for (const Device& each : devices_) all += each.parts_per_s;
    const double share = all > 0 ? device.parts_per_s / all : 1;
    const double least = least_s * device.parts_per_s;
    const double of_rest = of_share * share * static_cast<double>(count_of(open_));
    const double most = device.last_parts > 0 ? static_cast<double>(growth * device.last_parts) : least;
    return static_cast<std::uint64_t>(
        std::max(1.0, std::min(std::max(least, of_rest), std::max(most, least))));
}

/// A range that goes beyond the end of a round ends there: within a round runs become ever shorter, so that
/// no lane waits long for the last one.
PartRange HandOut::cut_from_open(std::uint64_t wanted) {
    PartRange& first = open_.front();
    PartRange given{first.first, std::min(first.end, first.first + wanted)};
    const std::uint64_t round_end = given.end / round_parts_ * round_parts_;
    if (round_end > given.first) given.end = round_end;
    first.first = given.end;
    if (first.count() == 0) open_.erase(open_.begin());
    return given;
}

void HandOut::made(std::size_t device, std::uint64_t end, double seconds) {
    const std::lock_guard lock(mutex_);
    Device& by = devices_[device];
    const PartRange given = by.given.value_or(PartRange{end, end}), done{given.first, end};
    by.given.reset();
    if (done.count() > 0) by.kept.push_back(done);
    if (end < given.end) open_.insert(open_.begin(), {end, given.end});
    by.last_parts = std::max<std::uint64_t>(done.count(), 1);
    if (seconds > 0 && done.count() > 0) by.parts_per_s = static_cast<double>(done.count()) / seconds;
    changed_.notify_all();
}

void HandOut::delivered(std::size_t device) {
    const std::lock_guard lock(mutex_);
    Device& by = devices_[device];
    by.delivered.insert(by.delivered.end(), by.kept.begin(), by.kept.end());
    by.kept.clear();
    changed_.notify_all();
}

void HandOut::lost(std::size_t device) {
    const std::lock_guard lock(mutex_);
    Device& by = devices_[device];
    if (by.given) by.kept.push_back(*by.given);
    std::vector<PartRange>& again = is_demand_ ? open_ : by.own;
    again.insert(again.end(), by.kept.begin(), by.kept.end());
    if (is_demand_) open_ = joined(std::move(open_));
    by.given.reset();
    by.kept.clear();
    by.last_parts = 0;
    changed_.notify_all();
}

void HandOut::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    changed_.notify_all();
}

bool HandOut::has_to_deliver(std::size_t device) const {
    const std::lock_guard lock(mutex_);
    return !devices_[device].kept.empty();
}

bool HandOut::is_work_left(std::size_t device) const {
    return !(is_demand_ ? open_ : devices_[device].own).empty();
}

bool HandOut::may_lose_any() const {
    return is_demand_ && std::any_of(devices_.begin(), devices_.end(),
                                     [](const Device& each) { return each.given || !each.kept.empty(); });
}

bool HandOut::wait_for_more(std::size_t device) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_stopped_ || is_work_left(device) || !may_lose_any(); });
    return !is_stopped_ && is_work_left(device);
}

std::vector<PartRange> HandOut::delivered_by(std::size_t device) const {
    const std::lock_guard lock(mutex_);
    return joined(devices_[device].delivered);
}

std::uint64_t HandOut::made_so_far() const {
    const std::lock_guard lock(mutex_);
    std::uint64_t made = 0;
    for (const Device& each : devices_) made += count_of(each.kept) + count_of(each.delivered);
    return made;
}

}  // namespace ptb
