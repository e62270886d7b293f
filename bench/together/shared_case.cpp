#include "bench/together/shared_case.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/measure/method.h"
#include "bench/measure/statistics.h"
#include "bench/together/picture_crew.h"
#include "core/input/usage_error.h"
#include "core/render/render.h"

namespace ptb {
namespace {

void end_shared(Record& record, Status status, const std::string& reason) {
    record.status = status;
    record.reason = reason;
    if (status == Status::unstable) return;
    record.samples.clear();
    record.statistics.reset();
    record.work.reset();
    record.shared.reset();
}

/// By the host's clock, since each device has one of its own; beside it the longest time of a device by its
/// own, and the sum of all.
void add_time(TimeSample& sample, const SharedPicture& picture) {
    double longest_s = 0;
    for (const DeviceParts& each : picture.by) {
        longest_s = std::max(longest_s, each.device_s);
        sample.sum_ns += static_cast<std::int64_t>(each.device_s * 1e9);
    }
    sample.kernel_ns += static_cast<std::int64_t>(longest_s * 1e9);
    sample.host_ns += static_cast<std::int64_t>(picture.wall_s * 1e9);
}

Work work_of(const Case& c, const DeviceInfo& first, const Film& film) {
    Work work;
    work.samples = film.samples.value_or(0);
    work.segments = film.segments;
    work.shadow_rays = film.shadow_rays;
    work.light_segments = film.light_segments;
    work.full_length_paths = film.full_length_paths.value_or(0);
    work.lanes = c.lanes == 0 ? std::max(first.default_lanes, 1) : c.lanes;
    work.passes = 1;
    work.film_hash = film.hash;
    return work;
}

SharedWork shared_work_of(const SharedPicture& picture) {
    SharedWork work;
    for (const DeviceParts& each : picture.by) {
        work.devices.push_back(each.device);
        work.device_ms.push_back(each.device_s * 1e3);
    }
    work.speedup = picture.speedup();
    work.efficiency = picture.efficiency();
    return work;
}

/// One case, and the pictures that are made of it.
class SharedMeasurement {
  public:
    SharedMeasurement(const SharedJob& job, const OpenChannel& open, const Stopped& stopped,
                      const Channel::Progress& progress)
        : job_(job), stopped_(stopped), progress_(progress), crew_(job, open, stopped) {}

    /// Into a record; returns the picture, where it came to one.
    std::optional<Image> measure_into(Record& record) {
        const TimedRender first = sample("warmup", 1);
        const Method method{{job_.measure.min_samples, job_.measure.max_samples, job_.measure.max_time_s,
                             job_.measure.max_time_s},
                            job_.measure.warmup,
                            static_cast<double>(first.time.host_ns) * 1e-9,
                            1000};
        TimerWatch timer("host");
        const auto take = [&](const std::string& stage, int renders) { return sample(stage, renders); };
        const Measurement measurement = measure(method, timer, take, steady_seconds);
        if (!stopped_()) return describe_in(record, measurement, timer);
        end_shared(record, Status::skipped, "interrupted");
        return std::nullopt;
    }

  private:
    TimedRender sample(const std::string& stage, int renders) {
        TimedRender timed;
        for (int i = 0; i < renders && !stopped_(); ++i) {
            last_ = crew_.make({{0, crew_.part_count()}}, [&](double done) {
                progress_(progress_response(stage, (i + done) / renders));
            });
            last_.check();
            add_time(timed.time, last_);
        }
        return timed;
    }

    std::optional<Image> describe_in(Record& record, const Measurement& measurement,
                                     const TimerWatch& timer) const {
        Film film = film_of(*last_.sums);
        record.work = work_of(job_.params, job_.devices.front(), film);
        record.work->renders = measurement.renders;
        record.samples = measurement.samples;
        record.shared = shared_work_of(last_);
        const std::uint64_t samples = job_.params.size.pixels() * static_cast<std::uint64_t>(job_.params.spp);
        if (film.samples != samples) {
            end_shared(record, Status::invalid,
                       fmt::format("the shared image: found {} samples instead of {}",
                                   film.samples.value_or(0), samples));
            return std::nullopt;
        }
        Statistics statistics = describe(measurement, timer);
        const std::string unstable = unstable_reason(measurement, timer, {});
        if (!unstable.empty()) end_shared(record, Status::unstable, unstable);
        add_rates(statistics, *record.work);
        record.statistics = statistics;
        return std::move(film.mean);
    }

    SharedJob job_;
    Stopped stopped_;
    Channel::Progress progress_;
    PictureCrew crew_;
    SharedPicture last_;
};

}  // namespace

MeasureShared shared_measurer(const MeasureOptions& options, const OpenChannel& open,
                              const Stopped& stopped) {
    return [=](const Case& c, const std::vector<DeviceInfo>& devices, Record validated,
               const Channel::Progress& progress) {
        Measured measured{std::move(validated), std::nullopt};
        Record& record = measured.record;
        try {
            SharedMeasurement shared({c, devices, options, {}}, open, stopped, progress);
            measured.picture = shared.measure_into(record);
        } catch (const UsageError& error) {
            end_shared(record, Status::unsupported, error.what());
        } catch (const std::exception& error) {
            end_shared(record, stopped() ? Status::skipped : Status::crash, error.what());
        }
        return measured;
    };
}

}  // namespace ptb
