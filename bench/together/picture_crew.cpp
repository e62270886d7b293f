#include "bench/together/picture_crew.h"

#include <algorithm>
#include <exception>
#include <future>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/measure/clock.h"
#include "bench/together/crew_member.h"
#include "bench/together/film_total.h"
#include "bench/together/hand_out.h"
#include "core/input/usage_error.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

/// While one process is started, no other one may be: it would inherit the pipes.
OpenChannel one_at_a_time(const OpenChannel& open) {
    return [open, mutex = std::make_shared<std::mutex>()](const DeviceInfo& device) {
        const std::lock_guard lock(*mutex);
        return open(device);
    };
}

Request request_of(Request::Kind kind, const Case& params = {}) {
    Request request;
    request.kind = kind;
    request.params = params;
    return request;
}

using ComingTotal = std::shared_future<std::unique_ptr<FilmTotal>>;

/// Memory is not had at once, and devices need it late.
ComingTotal coming_total(Size size) {
    return std::async(std::launch::async, [size] { return std::make_unique<FilmTotal>(size); });
}

/// Waits for all, then throws what went wrong first.
void wait_for(std::vector<std::future<void>>& all) {
    for (auto& each : all) each.wait();
    for (auto& each : all) each.get();
}

}  // namespace

void SharedPicture::check() const {
    if (!failure.empty()) throw std::runtime_error(failure);
}

double SharedPicture::parts_per_s() const {
    return wall_s > 0 ? static_cast<double>(parts_made(by)) / wall_s : 0;
}

double SharedPicture::efficiency() const {
    double all = idle_parts_per_s;
    for (const DeviceParts& each : by) all += each.parts_per_s();
    return all > 0 ? parts_per_s() / all : 0;
}

double SharedPicture::speedup() const {
    double fastest = 0;
    for (const DeviceParts& each : by) fastest = std::max(fastest, each.parts_per_s());
    return fastest > 0 ? parts_per_s() / fastest : 0;
}

struct PictureCrew::Impl {
    SharedJob job;
    Stopped stopped;
    std::optional<RunCut> cut;
    std::uint64_t part_count = 0;
    std::mutex mutex;  ///< of what follows, which threads share
    std::vector<std::string> remarks;
    std::vector<std::unique_ptr<CrewMember>> members;  ///< the last: their threads use the others

    Impl(const SharedJob& its_job, const OpenChannel& open, Stopped is_stopped)
        : job(its_job), stopped(std::move(is_stopped)), cut(its_job.cut) {
        if (const std::string reason = integrator(job.params.kernel).parts_refusal(); !reason.empty())
            throw UsageError(reason);
        const OpenChannel alone = one_at_a_time(open);
        for (const DeviceInfo& device : job.devices)
            members.push_back(std::make_unique<CrewMember>(device, alone, job.measure));
        on_all([this](CrewMember& member, std::size_t) { build(member); });
        for (auto& member : members)
            if (!cut) member->start([this, &m = *member] { begin(m); }).get();
        on_all([this](CrewMember& member, std::size_t) { begin(member); });
        if (const std::string nobody_left = failure(); !nobody_left.empty())
            throw std::runtime_error(nobody_left);
    }

    template <class Work>
    void on_all(Work work) {
        std::vector<std::future<void>> all;
        for (std::size_t i = 0; i < members.size(); ++i)
            all.push_back(members[i]->start([&work, &m = *members[i], i] { work(m, i); }));
        wait_for(all);
    }

    /// Why no device is left; empty while there is one.
    std::string failure() const {
        const auto is_gone = [](const auto& member) { return !member->gone.empty(); };
        if (!std::all_of(members.begin(), members.end(), is_gone) || stopped()) return {};
        return fmt::format("{}: {}", members.front()->device.key, members.front()->gone);
    }

    /// The answer, or nothing where the worker is lost. Throws UsageError for what a device cannot do.
    std::optional<Response> ask(CrewMember& member, const Request& request) {
        if (!member.worker.ready()) {
            member.gone = member.worker.given_up().empty() ? "interrupted" : member.worker.given_up();
            return std::nullopt;
        }
        const Reply reply = member.worker.request(request, [](const Response&) {});
        if (reply.end != Reply::End::answered) {
            lose_worker(member, reply);
            return std::nullopt;
        }
        if (reply.response.kind == Response::Kind::refused)
            throw UsageError(fmt::format("{}: {}", member.device.key, reply.response.reason));
        if (reply.response.kind == Response::Kind::failed) {
            lose_worker(member, reply);
            return std::nullopt;
        }
        return reply.response;
    }

    void lose_worker(CrewMember& member, const Reply& reply) {
        member.worker.close();
        member.is_sharing = false;
        member.kept_s = member.kept_device_s = 0;
        const std::string& reason = reply.end == Reply::End::answered ? reply.response.reason : reply.reason;
        if (reply.end == Reply::End::interrupted || --member.workers_left == 0) member.gone = reason;
        if (reply.end == Reply::End::interrupted) return;
        const std::lock_guard lock(mutex);
        remarks.push_back(fmt::format("{}: {}; what it made is made again", member.device.key, reason));
    }

    Case params_of(const CrewMember& member) const {
        Case params = job.params;
        params.device = member.device.key;
        return params;
    }

    /// Makes room for its film, compiles, and learns how fast the device is.
    void build(CrewMember& member) {
        member.film.emplace(job.params.size);
        while (member.gone.empty())
            if (ask(member, request_of(Request::Kind::estimate, params_of(member)))) return;
    }

    /// False where the device is gone.
    bool begin(CrewMember& member) {
        Request request = request_of(Request::Kind::share_picture, params_of(member));
        request.cut = cut;
        request.film_file = member.film->file.path().string();
        while (member.gone.empty() && !member.is_sharing) {
            const auto sharing = ask(member, request);
            if (!sharing) continue;
            member.is_sharing = true;
            member.ns_per_sample = sharing->ns_per_sample;
            const std::lock_guard lock(mutex);
            if (!cut) cut = sharing->cut;
            part_count = sharing->part_count;
        }
        return member.gone.empty();
    }

    /// As they showed before the picture; of those that are gone, none.
    std::vector<double> speeds() const {
        const double samples = static_cast<double>(job.params.size.pixels()) * job.params.spp;
        std::vector<double> parts_per_s;
        for (const auto& member : members)
            parts_per_s.push_back(member->gone.empty() ? static_cast<double>(part_count) /
                                                             (samples * member->ns_per_sample * 1e-9)
                                                       : 0);
        return parts_per_s;
    }

    SharedPicture make(HandOut& hand_out, const SharedProgress& progress);
    void work(CrewMember& member, std::size_t index, HandOut& hand_out, const SharedProgress& progress,
              ComingTotal total);
    void make_parts(CrewMember& member, std::size_t index, HandOut& hand_out, const SharedProgress& progress);
    void deliver(CrewMember& member, std::size_t index, HandOut& hand_out, FilmTotal& total);
};

SharedPicture PictureCrew::Impl::make(HandOut& hand_out, const SharedProgress& progress) {
    SharedPicture picture;
    for (auto& member : members)
        member->kept_s = member->busy_s = member->kept_device_s = member->device_s = 0;
    const std::int64_t begin_ns = now_ns();
    const ComingTotal total = coming_total(job.params.size);
    on_all([&](CrewMember& member, std::size_t i) { work(member, i, hand_out, progress, total); });
    picture.sums = total.get()->take();
    picture.wall_s = seconds_since(begin_ns);
    picture.part_count = part_count;
    const std::vector<double> parts_per_s = speeds();
    for (std::size_t i = 0; i < members.size(); ++i) {
        const DeviceInfo& device = members[i]->device;
        picture.by.push_back({device.key, device.name, device.driver_version, hand_out.delivered_by(i),
                              members[i]->busy_s, members[i]->device_s});
        if (picture.by.back().count() == 0) picture.idle_parts_per_s += parts_per_s[i];
    }
    picture.remarks = std::exchange(remarks, {});
    if (!picture.whole()) picture.failure = failure();
    return picture;
}

void PictureCrew::Impl::work(CrewMember& member, std::size_t index, HandOut& hand_out,
                             const SharedProgress& progress, ComingTotal total) {
    try {
        do {
            make_parts(member, index, hand_out, progress);
            if (hand_out.has_to_deliver(index)) deliver(member, index, hand_out, *total.get());
        } while (member.gone.empty() && hand_out.wait_for_more(index));
    } catch (...) {
        hand_out.stop();
        throw;
    }
}

void PictureCrew::Impl::make_parts(CrewMember& member, std::size_t index, HandOut& hand_out,
                                   const SharedProgress& progress) {
    Request request = request_of(Request::Kind::render_parts);
    while (begin(member)) {
        if (stopped()) hand_out.stop();
        const auto parts = hand_out.next(index);
        if (!parts) return;
        request.parts = *parts;
        const auto done = ask(member, request);
        if (!done) {
            hand_out.lost(index);
            continue;
        }
        hand_out.made(index, done->parts.end, done->seconds);
        member.kept_s += done->seconds;
        member.kept_device_s += done->device_s;
        const std::lock_guard lock(mutex);
        progress(static_cast<double>(hand_out.made_so_far()) / static_cast<double>(part_count));
    }
}

void PictureCrew::Impl::deliver(CrewMember& member, std::size_t index, HandOut& hand_out, FilmTotal& total) {
    const auto given = ask(member, request_of(Request::Kind::give_film));
    if (!given) {
        hand_out.lost(index);
        return;
    }
    total.add(given->film.value(), member.film->pixels.all(), index);
    member.busy_s += std::exchange(member.kept_s, 0);
    member.device_s += std::exchange(member.kept_device_s, 0);
    hand_out.delivered(index);
}

PictureCrew::PictureCrew(const SharedJob& job, const OpenChannel& open, const Stopped& stopped)
    : impl_(std::make_unique<Impl>(job, open, stopped)) {}
PictureCrew::~PictureCrew() = default;

RunCut PictureCrew::cut() const { return impl_->cut.value_or(RunCut{}); }
std::uint64_t PictureCrew::part_count() const { return impl_->part_count; }

SharedPicture PictureCrew::make(const std::vector<PartRange>& parts, const SharedProgress& progress,
                                const MoreParts& more) {
    HandOut hand_out(parts, impl_->job.params.size.pixels(), impl_->speeds(), more);
    return impl_->make(hand_out, progress);
}

SharedPicture PictureCrew::repeat(const std::vector<DeviceParts>& by, const SharedProgress& progress) {
    std::vector<std::vector<PartRange>> own;
    for (const DeviceParts& each : by) own.push_back(each.parts);
    HandOut hand_out(std::move(own));
    return impl_->make(hand_out, progress);
}

}  // namespace ptb
