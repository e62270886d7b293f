#pragma once

#include <cmath>
#include <cstdint>
#include <random>

/// A machine on which time passes: one sample after the other is slower or faster than it should be. Drifts
/// from the first sample of a session of measuring to its last, and has a busy neighbour now and then.
class Machine {
  public:
    Machine(double noise, int samples_in_all, unsigned seed)
        : random_(seed), noise_(0, noise), samples_in_all_(samples_in_all) {
        drift_ = uniform() < 0.5 ? drift : -drift;
    }

    std::int64_t sample_ns(double true_ns) {
        change_neighbour();
        const double slow = 1 + drift_ * taken_++ / samples_in_all_ + burst_;
        return std::llround(true_ns * slow * std::exp(noise_(random_)));
    }

  private:
    static constexpr double drift = 0.02;
    static constexpr double burst_share = 0.10;  ///< of all samples have a busy neighbour
    static constexpr double burst_samples = 20;  ///< mean length of a burst
    static constexpr double burst_most = 0.5;    ///< it slows a sample by up to this

    double uniform() { return std::uniform_real_distribution<>()(random_); }

    /// Two states that last, on average, `burst_samples` and as long as makes bursts `burst_share` of all.
    void change_neighbour() {
        const double ends = 1 / burst_samples, begins = ends * burst_share / (1 - burst_share);
        if (burst_ > 0 && uniform() < ends) {
            burst_ = 0;
        } else if (burst_ == 0 && uniform() < begins) {
            burst_ = burst_most * (0.1 + 0.9 * uniform());
        }
    }

    std::mt19937 random_;
    std::normal_distribution<> noise_;
    double drift_ = 0, burst_ = 0;
    int samples_in_all_, taken_ = 0;
};
