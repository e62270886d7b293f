#include "bench/cli/device_gate.h"

#include <fmt/format.h>

#include "bench/cli/tell.h"

namespace ptb {
namespace {

class DeviceGate {
  public:
    DeviceGate(PairedRun& run, const std::string& key, const CommonFlags& flags, std::uint64_t seed)
        : run_(run), key_(key), flags_(flags), seed_(seed) {}

    void measure(std::vector<PairedCase>& cases) {
        say(fmt::format("validating {} cases on both sides", cases.size()));
        for (PairedCase& c : cases) {
            if (run_.stopped()) return;
            run_.validate(c);
        }
        take(cases, false);
        take(cases, true);
    }

  private:
    void take(std::vector<PairedCase>& all, bool confirm) {
        std::vector<PairedCase*> cases;
        for (PairedCase& c : all)
            if (c.gate.not_measured.empty() && (!confirm || suspect(c.gate))) cases.push_back(&c);
        if (cases.empty()) return;
        const char* const name = confirm ? "confirm" : "screen";
        const int blocks = confirm ? confirm_blocks : screen_blocks;
        const double start_s = steady_seconds();
        const auto told = [&](int done) {
            const double left_s = (steady_seconds() - start_s) / done * (blocks - done);
            if (done == 1 || done == blocks)
                say(fmt::format("{}: block {} of {}, {} cases, {} left", name, done, blocks, cases.size(),
                                duration_text(left_s)));
        };
        take_blocks(run_, cases, confirm ? &GateCase::confirm : &GateCase::screen, blocks,
                    seed_ + (confirm ? 1 : 0), told);
    }

    void say(const std::string& what) const { tell(flags_, fmt::format("[{}] {}", key_, what)); }

    PairedRun& run_;
    std::string key_;
    const CommonFlags& flags_;
    std::uint64_t seed_;
};

}  // namespace

void measure_pairs(PairedRun& run, const std::string& key, const CommonFlags& flags,
                   std::uint64_t shuffle_seed, std::vector<PairedCase>& cases) {
    DeviceGate(run, key, flags, shuffle_seed).measure(cases);
}

}  // namespace ptb
