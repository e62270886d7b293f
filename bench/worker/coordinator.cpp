#include "bench/worker/coordinator.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <future>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/image/image_io.h"

namespace ptb {
namespace {

constexpr auto interrupted_reason = "interrupted";

Record record(const Case& c, Status status, std::string reason) {
    Record made;
    made.params = c;
    made.status = status;
    made.reason = std::move(reason);
    return made;
}

Record record_of(const Case& c, Reply reply) {
    switch (reply.end) {
        case Reply::End::crashed:
        case Reply::End::not_started:
            return record(c, Status::crash, reply.reason);
        case Reply::End::timed_out:
            return record(c, Status::timeout, reply.reason);
        case Reply::End::interrupted:
            return record(c, Status::skipped, interrupted_reason);
        case Reply::End::answered:
            break;
    }
    if (!reply.response.record) {
        const std::string& why = reply.response.reason;
        return record(c, Status::runtime, why.empty() ? "the worker answered without a record" : why);
    }
    if (reply.response.record->params != c)
        return record(c, Status::crash, "the worker answered for another case");
    return std::move(*reply.response.record);
}

/// A quarter of the budget is for repetitions, shared by all cases, whatever samples are still to come.
double repetitions_s(const RunPlan& plan) {
    return plan.max_total_time_s / 4 / static_cast<double>(plan.cases.size());
}

/// Of a budget, how much may go into estimates before the first case: each of them compiles a kernel.
constexpr double most_estimating = 0.25;

/// Devices of the cases from the i-th on, which come device by device.
std::size_t devices_from(const RunPlan& plan, std::size_t i) {
    std::set<std::string> devices;
    for (; i < plan.cases.size(); ++i) devices.insert(plan.cases[i].device);
    return devices.size();
}

/// Seconds that one sample of each case after the i-th takes on the same device: no case's repetitions may
/// use them up. What does not fit into the device's share anyway has no part in it; what is not known yet has
/// as much as for repetitions.
std::vector<double> samples_to_come(const RunPlan& plan, const Forecast& forecast) {
    std::vector<double> reserved(plan.cases.size(), 0.0);
    const double share_s = plan.max_total_time_s / static_cast<double>(devices_from(plan, 0));
    for (std::size_t i = plan.cases.size(); i-- > 1;) {
        if (plan.cases[i].device != plan.cases[i - 1].device) continue;
        const double sum_s = reserved[i] + forecast.sample_s(plan.cases[i]).value_or(repetitions_s(plan));
        reserved[i - 1] = sum_s <= share_s ? sum_s : reserved[i];
    }
    return reserved;
}

Request to_validate(const Case& c) {
    Request request;
    request.kind = Request::Kind::run;
    request.params = c;
    request.validate_only = true;
    return request;
}

/// Counts who has measured, of all that measure at once.
class Measuring {
  public:
    explicit Measuring(std::size_t count) : left_(count) {}
    /// Called by each as often as it likes.
    void done(std::size_t who) {
        const std::lock_guard lock(mutex_);
        if (done_.insert(who).second) --left_;
    }
    bool is_over() const { return left_ == 0; }
    /// Tells one after the other.
    void tell(const Channel::Progress& progress, const Response& response) {
        const std::lock_guard lock(mutex_);
        progress(response);
    }

  private:
    std::mutex mutex_;
    std::set<std::size_t> done_;
    std::atomic<std::size_t> left_;
};

/// Times beside somebody who dropped out are not what they are said to be.
void judge_together(std::vector<Measured>& all) {
    const auto fell = std::find_if(all.begin(), all.end(), [](const Measured& each) {
        return !each.record.statistics && each.record.status != Status::skipped;
    });
    if (fell == all.end()) return;
    for (Measured& each : all) {
        if (each.record.status != Status::ok && each.record.status != Status::unstable) continue;
        each.record.status = Status::unstable;
        each.record.reason =
            fmt::format("together {}: {} dropped out: {}", case_value(each.record.params, "together"),
                        fell->record.params.device, fell->record.reason);
    }
}

}  // namespace

Measured ask_with_picture(DeviceWorker& worker, const Request& request, const Channel::Progress& progress,
                          const Stopped& enough) {
    if (worker.ready()) {
        Reply reply = worker.request(request, progress, enough);
        auto picture = std::move(reply.picture);
        return {record_of(request.params, std::move(reply)), std::move(picture)};
    }
    const std::string& why = worker.given_up();
    return {record(request.params, Status::skipped, why.empty() ? interrupted_reason : why), std::nullopt};
}

Record ask(DeviceWorker& worker, const Request& request, const Channel::Progress& progress) {
    return ask_with_picture(worker, request, progress).record;
}

DevicePeaks ask_peaks(DeviceWorker& worker, const std::string& device) {
    DevicePeaks found{device, interrupted_reason, {}};
    if (!worker.given_up().empty() || !worker.ready()) {
        if (!worker.given_up().empty()) found.reason = worker.given_up();
        return found;
    }
    Request request;
    request.kind = Request::Kind::peaks;
    const Reply reply = worker.request(request, [](const Response&) {});
    if (reply.end != Reply::End::interrupted)
        found.reason = reply.end == Reply::End::answered ? reply.response.reason : reply.reason;
    found.peaks = reply.response.peaks;
    return found;
}

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Coordinator::Coordinator(RunPlan plan, OpenChannel open, Stopped stopped, SecondsNow now_s,
                         MeasureShared shared)
    : plan_(std::move(plan)),
      stopped_(std::move(stopped)),
      now_s_(std::move(now_s)),
      end_s_(now_s_() + plan_.max_total_time_s),
      share_end_s_(end_s_),
      shared_(std::move(shared)) {
    for (const DeviceInfo& device : plan_.devices) {
        workers_.try_emplace(device.key, device, open, plan_.measure);
    }
}

Forecast Coordinator::estimate() {
    return estimated([] { return false; });
}

Forecast Coordinator::estimate_within_budget() {
    return estimated([&] {
        const auto left_s = budget_left_s();
        return left_s && *left_s < (1 - most_estimating) * plan_.max_total_time_s;
    });
}

Forecast Coordinator::estimated(const Stopped& enough) {
    Forecast forecast(plan_.measure);
    for (const Case& c : plan_.cases)
        if (!stopped_() && !enough()) estimate(c, forecast);
    return forecast;
}

/// Asks once what such a case costs.
void Coordinator::estimate(const Case& c, Forecast& forecast) {
    if (forecast.knows(c) || !asked_.insert(cost_key(c)).second) return;
    DeviceWorker& worker = worker_of(c.device);
    if (!worker.ready()) return;
    Request request;
    request.kind = Request::Kind::estimate;
    request.params = c;
    const Reply reply = worker.request(request, [](const Response&) {});
    const bool known = reply.end == Reply::End::answered && reply.response.kind == Response::Kind::estimate;
    if (known) forecast.learn(c, reply.response.ns_per_sample);
}

std::vector<DevicePeaks> Coordinator::peaks() {
    std::vector<DevicePeaks> all;
    for (const DeviceInfo& device : plan_.devices)
        if (!stopped_()) all.push_back(ask_peaks(worker_of(device.key), device.key));
    return all;
}

std::vector<Record> Coordinator::run(Forecast forecast, const std::vector<RunObserver*>& observers) {
    std::vector<Record> records;
    reserved_s_ = samples_to_come(plan_, forecast);
    for (std::size_t i = 0; i < plan_.cases.size(); ++i) {
        const Case& c = plan_.cases[i];
        if (i == 0 || plan_.cases[i - 1].device != c.device) share_budget(i);
        if (const auto left_s = budget_left_s(); left_s && *left_s > 0 && !stopped_()) estimate(c, forecast);
        for (RunObserver* observer : observers) observer->started(i, c);
        records.push_back(run_case(i, forecast, [&](const Response& progress) {
            for (RunObserver* observer : observers) observer->progressed(i, c, progress);
        }));
        for (RunObserver* observer : observers) observer->finished(i, records.back());
        if (forecast.learn(records.back())) reserved_s_ = samples_to_come(plan_, forecast);
    }
    close_live();
    for (const auto& [device, worker] : workers_)
        if (!worker.given_up().empty()) remarks_.push_back(worker.given_up());
    assert(records.size() == plan_.cases.size());
    return records;
}

Record Coordinator::run_case(std::size_t index, const Forecast& forecast, const Channel::Progress& progress) {
    const Case& c = plan_.cases[index];
    const std::string reason = beside_others_.contains(c) ? "" : not_to_try(c, forecast);
    if (!reason.empty()) return record(c, Status::skipped, reason);
    const Measured result = measured(index, progress);
    keep_picture(c, result);
    return result.record;
}

Measured Coordinator::measured(std::size_t index, const Channel::Progress& progress) {
    const Case& c = plan_.cases[index];
    if (c.devices > 1) return shared(index, progress);
    if (c.together == Together::no)
        return ask_with_picture(worker_of(c.device), run_request(index), progress);
    if (!beside_others_.contains(c)) run_beside_others(index, progress);
    return std::exchange(beside_others_.at(c), {});
}

Measured Coordinator::shared(std::size_t index, const Channel::Progress& progress) {
    const Case& c = plan_.cases[index];
    if (c.together != Together::no)
        return {record(c, Status::unsupported,
                       fmt::format("devices {}: all of them work on one picture; allowed: together no",
                                   c.devices)),
                std::nullopt};
    std::vector<DeviceInfo> devices;
    for (const DeviceInfo& each : plan_.devices)
        if (each.type == info_of(c.device).type && devices.size() < static_cast<std::size_t>(c.devices))
            devices.push_back(each);
    if (devices.size() < static_cast<std::size_t>(c.devices))
        return {record(c, Status::unsupported,
                       fmt::format("devices {}: there are {} {}s in this run", c.devices, devices.size(),
                                   info_of(c.device).type)),
                std::nullopt};
    const Record valid = ask(worker_of(c.device), to_validate(c), progress);
    close_live();
    if (valid.status != Status::ok || plan_.measure.skip_time) return {valid, std::nullopt};
    return shared_(c, devices, valid, progress);
}

const DeviceInfo& Coordinator::info_of(const std::string& device) const {
    return *std::find_if(plan_.devices.begin(), plan_.devices.end(),
                         [&](const DeviceInfo& each) { return each.key == device; });
}

/// The case on each device that works at the same time.
std::vector<Case> Coordinator::with_companions(const Case& c) const {
    std::vector<Case> cases;
    for (const DeviceInfo& each : plan_.devices) {
        if (c.together == Together::gpus && each.type != "GPU") continue;
        cases.push_back(c);
        cases.back().device = each.key;
    }
    return cases;
}

/// Kernels are found right one after the other; then all measure at the same time. Keeps what comes of it for
/// those whose turn is later.
void Coordinator::run_beside_others(std::size_t index, const Channel::Progress& progress) {
    const Case& c = plan_.cases[index];
    const std::vector<Case> cases = with_companions(c);
    if (std::find(cases.begin(), cases.end(), c) == cases.end()) {
        beside_others_[c].record =
            record(c, Status::unsupported,
                   fmt::format("together gpus: {} is a {}; all: every device of the run", c.device,
                               info_of(c.device).type));
        return;
    }
    close_live();
    std::vector<Measured> all;
    std::vector<Request> requests;
    for (const Case& each : cases) {
        all.push_back({ask(workers_.at(each.device), to_validate(each), progress), std::nullopt});
        if (all.back().record.status != Status::ok || plan_.measure.skip_time) continue;
        Request request = run_request(index);
        request.params = each;
        request.picture = wants_picture(each);
        request.beside_others = true;
        requests.push_back(request);
    }
    for (Measured& measured : at_once(requests, progress))
        for (Measured& each : all)
            if (each.record.params == measured.record.params) each = std::move(measured);
    if (!plan_.measure.skip_time) judge_together(all);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        workers_.at(cases[i].device).close();
        beside_others_[cases[i]] = std::move(all[i]);
    }
}

/// By workers that are ready; who has measured stays busy until all have.
std::vector<Measured> Coordinator::at_once(std::vector<Request> requests, const Channel::Progress& progress) {
    Measuring measuring(requests.size());
    std::vector<std::future<Measured>> running;
    for (std::size_t i = 0; i < requests.size(); ++i)
        running.push_back(std::async(std::launch::async, [&, i] {
            const auto listen = [&](const Response& response) {
                if (response.stage == "beside") measuring.done(i);
                measuring.tell(progress, response);
            };
            const Measured measured = ask_with_picture(workers_.at(requests[i].params.device), requests[i],
                                                       listen, [&] { return measuring.is_over(); });
            measuring.done(i);
            return measured;
        }));
    std::vector<Measured> all;
    for (auto& each : running) all.push_back(each.get());
    return all;
}

void Coordinator::close_live() {
    if (live_ != nullptr) live_->close();
    live_ = nullptr;
}

bool Coordinator::wants_picture(const Case& c) const {
    const auto file = plan_.image_files.find(c);
    if (file == plan_.image_files.end()) return false;
    const auto written = written_.find(file->second.path);
    return written == written_.end() || file->second.rank >= written->second;
}

/// A picture that cannot be kept costs no time.
void Coordinator::keep_picture(const Case& c, const Measured& measured) {
    const bool timed = measured.record.work && measured.record.work->segments > 0;
    if (!timed || !wants_picture(c)) return;
    const ImageFile& file = plan_.image_files.at(c);
    try {
        if (!measured.picture) throw std::runtime_error("it did not arrive whole");
        write_image(file.path, *measured.picture);
        written_[file.path] = file.rank;
    } catch (const std::exception& error) {
        remarks_.push_back(fmt::format("no picture of {}: {}", c.device, error.what()));
    }
}

bool Coordinator::has_given_up() const {
    return std::any_of(workers_.begin(), workers_.end(),
                       [](const auto& worker) { return !worker.second.given_up().empty(); });
}

/// Only one device's worker lives at a time: an idle one still holds memory, threads and clocks.
DeviceWorker& Coordinator::worker_of(const std::string& device) {
    DeviceWorker& worker = workers_.at(device);
    if (live_ != nullptr && live_ != &worker) live_->close();
    live_ = &worker;
    return worker;
}

/// Of what is left, the device of this case and of those after it has as much as each one to come; what it
/// leaves is theirs.
void Coordinator::share_budget(std::size_t index) {
    const double now_s = now_s_();
    share_end_s_ = now_s + (end_s_ - now_s) / static_cast<double>(devices_from(plan_, index));
}

std::optional<double> Coordinator::budget_left_s() const {
    if (plan_.max_total_time_s <= 0) return std::nullopt;
    return share_end_s_ - now_s_();
}

/// Why a case is skipped without being tried, or empty. A budget cuts repetitions, never work: what cannot be
/// rendered once in what is left is not begun.
std::string Coordinator::not_to_try(const Case& c, const Forecast& forecast) const {
    if (stopped_()) return interrupted_reason;
    const auto left_s = budget_left_s();
    const double sample_s = forecast.sample_s(c).value_or(0);
    if (!left_s || (*left_s > 0 && sample_s <= *left_s)) return {};
    const std::string budget =
        fmt::format("{}the budget of {}", plan_.devices.size() > 1 ? c.device + "'s share of " : "",
                    duration_text(plan_.max_total_time_s));
    if (*left_s <= 0) return fmt::format("{} is used up (--max-total-time)", budget);
    return fmt::format("predicted {} a sample, {} are left of {} (--max-total-time)", duration_text(sample_s),
                       duration_text(*left_s), budget);
}

Request Coordinator::run_request(std::size_t index) const {
    const Case& c = plan_.cases[index];
    Request request;
    request.kind = Request::Kind::run;
    request.params = c;
    if (const auto left_s = budget_left_s())
        request.time_left_s = std::min(*left_s, std::max(repetitions_s(plan_), *left_s - reserved_s_[index]));
    request.picture = wants_picture(c);
    return request;
}

}  // namespace ptb
