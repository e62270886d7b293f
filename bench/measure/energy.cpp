#include "bench/measure/energy.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ptb {
namespace {

namespace fs = std::filesystem;

constexpr double rapl_least_s = 0.1;  ///< it counts every millisecond
constexpr double nvml_least_s = 2;    ///< it advances ten times a second: 5 %

std::string text_in(const fs::path& file) {
    std::ifstream stream(file);
    std::string text;
    std::getline(stream, text);
    return text;
}

double microjoules(const fs::path& file) {
    std::ifstream stream(file);
    std::uint64_t value = 0;
    if (!(stream >> value)) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
    return static_cast<double>(value);
}

/// One package's counter, unwrapped.
struct Package {
    std::string name;
    fs::path energy;
    double range_uj, last_uj, sum_uj;

    double read_uj() {
        const double now_uj = microjoules(energy);
        sum_uj += now_uj - last_uj + (now_uj < last_uj ? range_uj : 0);
        last_uj = now_uj;
        return sum_uj;
    }
};

/// Packages alone, and once: what lies within them (core, uncore) would count twice, so would the same
/// counters under "intel-rapl-mmio", and "psys" is the whole machine.
std::vector<Package> packages_in(const fs::path& powercap) {
    std::vector<Package> packages;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(powercap, error)) {
        const std::string name = text_in(entry.path() / "name"), folder = entry.path().filename();
        if (!name.starts_with("package-") || !folder.starts_with("intel-rapl:")) continue;
        const fs::path energy = entry.path() / "energy_uj";
        packages.push_back(
            {name, energy, microjoules(entry.path() / "max_energy_range_uj"), microjoules(energy), 0});
    }
    std::sort(packages.begin(), packages.end(),
              [](const Package& a, const Package& b) { return a.name < b.name; });
    return packages;
}

}  // namespace

EnergyCounter rapl_counter(const fs::path& powercap) {
    EnergyCounter counter;
    counter.least_s = rapl_least_s;
    try {
        const auto packages = std::make_shared<std::vector<Package>>(packages_in(powercap));
        std::vector<std::string> names;
        for (const Package& package : *packages) names.push_back(package.name);
        if (!names.empty()) counter.source = fmt::format("RAPL {}", fmt::join(names, " + "));
        if (names.empty())
            counter.reason = fmt::format("no RAPL package in {}: this CPU or virtual machine has no counter",
                                         powercap.string());
        counter.joules = [packages] {
            double sum_uj = 0;
            for (Package& package : *packages) sum_uj += package.read_uj();
            return sum_uj * 1e-6;
        };
    } catch (const std::exception& error) {
        counter.reason = fmt::format("{}: root may; `sudo chmod a+r` it", error.what());
    }
    return counter;
}

EnergyCounter nvml_counter(const std::string& uuid, const std::string& library) {
    EnergyCounter counter;
    counter.source = "NVML";
    counter.least_s = nvml_least_s;
    try {
        const auto gpu = std::make_shared<NvmlGpu>(uuid, library);
        counter.joules = [gpu] { return gpu->joules(); };
        counter.joules();
    } catch (const std::exception& error) {
        counter.reason = error.what();
    }
    return counter;
}

EnergyCounter energy_counter(const DeviceInfo& device) {
    if (device.type == "CPU") return rapl_counter();
    if (device.vendor.find("NVIDIA") != std::string::npos) return nvml_counter(device.uuid);
    EnergyCounter none;
    none.reason = "no counter that ptbench knows covers this device";
    return none;
}

EnergyMeter::EnergyMeter(EnergyCounter counter, Seconds now_s, const std::function<void(double)>& wait)
    : counter_(std::move(counter)), now_s_(std::move(now_s)) {
    restart();
    if (!counter_.reason.empty()) return;
    wait(counter_.least_s);
    add(0);
    if (counter_.reason.empty()) idle_w_ = (end_j_ - begin_j_) / (end_s_ - begin_s_);
}

/// A counter that fails once is given up.
double EnergyMeter::read() {
    try {
        if (counter_.reason.empty()) return counter_.joules();
    } catch (const std::exception& error) {
        counter_.reason = error.what();
    }
    return 0;
}

void EnergyMeter::restart() {
    renders_ = 0;
    begin_j_ = end_j_ = read();
    begin_s_ = end_s_ = now_s_();
}

void EnergyMeter::add(int renders) {
    renders_ += renders;
    end_j_ = read();
    end_s_ = now_s_();
}

Energy EnergyMeter::spent(std::uint64_t samples) const {
    Energy energy{counter_.source, counter_.reason, end_s_ - begin_s_, {}, {}, idle_w_};
    if (energy.reason.empty() && energy.window_s < counter_.least_s)
        energy.reason = fmt::format("timed for {:.2g} s, this counter needs {:g} s: more --min-samples",
                                    energy.window_s, counter_.least_s);
    if (!energy.reason.empty() || renders_ == 0) return energy;
    energy.joules = (end_j_ - begin_j_) / renders_;
    if (*energy.joules > 0) energy.samples_per_joule = static_cast<double>(samples) / *energy.joules;
    return energy;
}

}  // namespace ptb
