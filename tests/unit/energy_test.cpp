#include "bench/measure/energy.h"

#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "tests/support/variable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A powercap tree of files.
struct Rapl : testing::Test {
    fs::path root = fs::path(testing::TempDir()) / ("ptb-powercap-" + std::to_string(::getpid()));
    Rapl() { fs::create_directories(root); }
    ~Rapl() override { fs::remove_all(root); }
    void write(const std::string& file, const std::string& text) const {
        fs::create_directories((root / file).parent_path());
        std::ofstream(root / file) << text << '\n';
    }
    void domain(const std::string& folder, const std::string& name, const std::string& energy_uj) const {
        write(folder + "/name", name);
        write(folder + "/max_energy_range_uj", "262143000000");
        write(folder + "/energy_uj", energy_uj);
    }
};

TEST_F(Rapl, packages_are_summed_and_their_parts_are_not) {
    domain("intel-rapl:1", "package-1", "5000000");
    domain("intel-rapl:0", "package-0", "1000000");
    domain("intel-rapl:0:0", "core", "1000000");
    domain("intel-rapl:2", "psys", "1000000");
    domain("intel-rapl-mmio:0", "package-0", "1000000");
    write("intel-rapl/enabled", "1");
    const EnergyCounter counter = rapl_counter(root);
    EXPECT_EQ(counter.reason, "");
    EXPECT_EQ(counter.source, "RAPL package-0 + package-1");
    const double before = counter.joules();
    for (const char* const folder :
         {"intel-rapl:0", "intel-rapl:1", "intel-rapl:0:0", "intel-rapl:2", "intel-rapl-mmio:0"})
        write(std::string(folder) + "/energy_uj", "7500000");
    EXPECT_DOUBLE_EQ(counter.joules() - before, 6.5 + 2.5);
}

TEST_F(Rapl, a_counter_that_wraps_around_goes_on) {
    domain("intel-rapl:0", "package-0", "262142000000");
    const EnergyCounter counter = rapl_counter(root);
    const double before = counter.joules();
    write("intel-rapl:0/energy_uj", "500000");
    EXPECT_DOUBLE_EQ(counter.joules() - before, 1.5);
    write("intel-rapl:0/energy_uj", "262142000000");
    counter.joules();
    write("intel-rapl:0/energy_uj", "1000000");
    EXPECT_DOUBLE_EQ(counter.joules() - before, 262143 + 2);
}

TEST_F(Rapl, what_cannot_be_read_has_a_reason) {
    EXPECT_THAT(rapl_counter(root / "none").reason, HasSubstr("no RAPL package in"));
    EXPECT_EQ(rapl_counter(root / "none").source, "");
    domain("intel-rapl:0", "package-0", "unreadable");
    EXPECT_THAT(rapl_counter(root).reason, HasSubstr("cannot read " + root.string()));
}

constexpr auto gpu = "00112233445566778899aabbccddeeff";

TEST(Nvml, the_gpu_is_found_by_its_uuid) {
    const EnergyCounter counter = nvml_counter(gpu, PTB_FAKE_NVML);
    ASSERT_EQ(counter.reason, "");
    EXPECT_EQ(counter.source, "NVML");
    const double before = counter.joules();
    EXPECT_DOUBLE_EQ(counter.joules() - before, 1.5);
}

TEST(Nvml, what_cannot_be_read_has_a_reason) {
    EXPECT_THAT(nvml_counter(gpu, "libno-such-nvml.so.1").reason, HasSubstr("cannot load NVML: libno-such"));
    EXPECT_THAT(nvml_counter("", PTB_FAKE_NVML).reason, HasSubstr("UUID"));
    EXPECT_THAT(nvml_counter(std::string(32, 'f'), PTB_FAKE_NVML).reason,
                HasSubstr("nvmlDeviceGetHandleByUUID says 6 (Not Found)"));
    const Variable error("FAKE_NVML_ERROR", "3");
    EXPECT_THAT(nvml_counter(gpu, PTB_FAKE_NVML).reason,
                HasSubstr("nvmlDeviceGetTotalEnergyConsumption says 3 (Not Supported)"));
}

TEST(Nvml, what_it_tells_of_the_board_is_a_fact_of_the_device) {
    DeviceInfo device;
    device.vendor = "NVIDIA Corporation";
    device.uuid = gpu;
    describe_board(device, PTB_FAKE_NVML);
    EXPECT_EQ(device.serial, "1650522012345");
    EXPECT_EQ(device.vbios, "") << "it does not tell";
    EXPECT_EQ(device.ecc, true) << "as it is, not as it will be";
    EXPECT_EQ(device.max_clock_mhz, 1980);
    EXPECT_EQ(device.max_memory_clock_mhz, 2619);
    EXPECT_EQ(device.power_limit_w, 700);
    DeviceInfo other;
    other.vendor = "AMD";
    other.uuid = gpu;
    describe_board(other, PTB_FAKE_NVML);
    EXPECT_EQ(other.serial, "");
}

TEST(Nvml, the_state_names_what_holds_the_clock_back) {
    DeviceInfo device;
    device.vendor = "NVIDIA Corporation";
    device.uuid = gpu;
    const auto board = nvml_gpu(device, PTB_FAKE_NVML);
    ASSERT_TRUE(board);
    const GpuState state = board->state();
    EXPECT_EQ(state.clock_mhz, 1410);
    EXPECT_EQ(state.memory_clock_mhz, std::nullopt);
    EXPECT_EQ(state.temperature_c, 81);
    EXPECT_EQ(state.power_w, std::nullopt);
    EXPECT_THAT(state.throttle, testing::ElementsAre("power cap", "software thermal"));
    device.uuid = std::string(32, 'f');
    EXPECT_FALSE(nvml_gpu(device, PTB_FAKE_NVML));
}

/// 5 W when idle, 100 W in samples; the clock is the test's.
struct Meter : testing::Test {
    double now_s = 10, joules = 1000;
    std::string fails;
    EnergyCounter counter{"fake", "",
                          [this] {
                              if (!fails.empty()) throw std::runtime_error(fails);
                              return joules;
                          },
                          2};
    void pass(double s, double watts) {
        now_s += s;
        joules += s * watts;
    }
    EnergyMeter meter() {
        return {counter, [this] { return now_s; }, [this](double s) { pass(s, 5); }};
    }
};

TEST_F(Meter, energy_is_that_of_the_timed_samples) {
    EnergyMeter meter = this->meter();
    pass(100, 300);  // builds and warm-ups
    meter.restart();
    for (int i = 0; i < 4; ++i) {
        pass(1, 100);
        meter.add(5);
    }
    pass(100, 300);
    const Energy energy = meter.spent(1000);
    EXPECT_EQ(energy.reason, "");
    EXPECT_DOUBLE_EQ(energy.window_s, 4);
    EXPECT_DOUBLE_EQ(energy.joules.value(), 20);
    EXPECT_DOUBLE_EQ(energy.samples_per_joule.value(), 50);
    EXPECT_DOUBLE_EQ(energy.idle_w.value(), 5);
}

TEST_F(Meter, what_is_too_short_or_unreadable_has_no_joules) {
    EnergyMeter meter = this->meter();
    meter.restart();
    pass(1, 100);
    meter.add(1);
    EXPECT_EQ(meter.spent(1).joules, std::nullopt);
    EXPECT_THAT(meter.spent(1).reason, HasSubstr("timed for 1 s, this counter needs 2 s"));
    pass(9, 100);
    fails = "the GPU is lost";
    meter.add(1);
    EXPECT_EQ(meter.spent(1).joules, std::nullopt);
    EXPECT_EQ(meter.spent(1).reason, "the GPU is lost");
    counter.reason = "no counter";
    EXPECT_EQ(this->meter().spent(1).reason, "no counter");
    EXPECT_EQ(this->meter().spent(1).idle_w, std::nullopt);
}

}  // namespace
}  // namespace ptb
