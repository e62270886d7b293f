#pragma once

#include <string>

namespace ptb {

/// How far the measuring of a case has come.
struct Measured {
    int samples = 0;
    double elapsed_s = 0;      ///< since the first timed sample began
    double last_sample_s = 0;  ///< what the next one will take, as far as anybody knows
};

/// Fixed repetitions within a time for the case and a share of a time for the run. One sample is always
/// taken.
struct FixedSamples {
    int samples = 5;
    double max_time_s = 30;
    double time_left_s = 0;  ///< of the run's budget when the case begins; infinite without one

    /// Empty: go on. Else why to stop: "samples", "max_time", "max_total_time".
    std::string stop(const Measured& measured) const {
        if (measured.samples == 0) return "";
        if (measured.samples >= samples) return "samples";
        if (measured.elapsed_s + measured.last_sample_s > time_left_s) return "max_total_time";
        if (measured.elapsed_s + measured.last_sample_s > max_time_s) return "max_time";
        return "";
    }
};

/// Fewer samples than this say nothing of their spread; the record's stop reason is then "low_n".
inline constexpr int enough_samples = 3;

}  // namespace ptb
