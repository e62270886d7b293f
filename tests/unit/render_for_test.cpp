#include <gmock/gmock.h>

#include "bench/measure/sampler.h"

namespace ptb {
namespace {

/// Renders nothing, at once; `most` samples a pass, as a device's memory may ask for.
class FakeRender : public Render {
  public:
    FakeRender(std::uint64_t all, std::uint64_t most) : all_(all), most_(most) {}
    void restart() override { done_ = 0; }
    std::uint64_t samples_left() const override { return all_ - done_; }
    std::vector<LaunchTimes> advance(std::uint64_t samples) override {
        done_ += std::min({samples, most_, samples_left()});
        return {LaunchTimes{1, 2, 3, 1003}};
    }
    Film read_film() override { return {}; }
    ocl::KernelFacts facts() const override { return {}; }
    std::uint64_t device_bytes() const override { return 0; }
    std::uint64_t done() const { return done_; }

  private:
    std::uint64_t all_, most_, done_ = 0;
};

constexpr std::uint64_t round_samples = 1000, endless = 1'000'000'000'000'000;

std::uint64_t samples_in(double time_s, FakeRender render) {
    PassCutter cutter;
    render_for(render, time_s, round_samples, {cutter, 1, [](double) { return true; }});
    return render.done();
}

TEST(RenderFor, a_time_that_is_over_at_once_still_gives_every_pixel_its_samples) {
    EXPECT_EQ(samples_in(1e-9, {endless, endless}), round_samples);
}

TEST(RenderFor, ends_with_a_round_however_passes_are_cut) {
    for (const std::uint64_t most : {std::uint64_t{1}, std::uint64_t{7}, std::uint64_t{999}, endless}) {
        const std::uint64_t done = samples_in(0.01, {endless, most});
        EXPECT_EQ(done % round_samples, 0u) << most << " samples a pass";
        EXPECT_GE(done, round_samples);
    }
}

TEST(RenderFor, ends_when_nothing_is_left) { EXPECT_EQ(samples_in(1e9, {5000, 900}), 5000u); }

TEST(RenderFor, whoever_watches_can_end_it) {
    FakeRender render(endless, 10);
    PassCutter cutter;
    int passes = 0;
    render_for(render, 1e9, round_samples, {cutter, 1, [&](double) { return ++passes < 3; }});
    EXPECT_EQ(render.done(), 30u);
}

}  // namespace
}  // namespace ptb
