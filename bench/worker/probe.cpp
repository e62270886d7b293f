#include "bench/worker/probe.h"

#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/record/json.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// One driver being asked.
struct Asked {
    Icd icd;
    IcdFolder folder;
    std::string nonce = drawn_nonce();
    WorkerProcess process;
    std::optional<WorkerIdentity> worker;  ///< once it has started
    Waiting waiting;
    Asked(const Icd& asked, const WorkerLaunch& launch)
        : icd(asked),
          folder(asked),
          process(worker_command(launch, folder, nonce, {"--probe"})),
          waiting(launch.waiting) {}
};

/// How a probe waits.
struct Patience {
    const WorkerLaunch& launch;
    Clock::time_point deadline;  ///< of all that no launcher starts
    milliseconds of_a_driver;
    const Stopped& stopped;
};

std::string with_last_words(const std::string& ending, const WorkerProcess& process) {
    const std::string words = printable(last_line(process.stderr_tail()));
    return words.empty() ? ending : fmt::format("{}: {}", ending, words);
}

milliseconds time_left(const Asked& asked, const Patience& patience) {
    if (!patience.launch.launcher.empty())
        return asked.worker ? patience.of_a_driver : patience.launch.start_timeout;
    const auto left = std::chrono::duration_cast<milliseconds>(patience.deadline - Clock::now());
    return std::max(left, milliseconds(0));
}

std::string next_line(Asked& asked, const Patience& patience) {
    const bool waits_for_launcher = !patience.launch.launcher.empty() && !asked.worker;
    const Stopped looking = [&] {
        if (waits_for_launcher) asked.waiting.look(printable(last_line(asked.process.stderr_tail())));
        return patience.stopped && patience.stopped();
    };
    std::string line;
    const ReadStatus status = asked.process.read_line(line, time_left(asked, patience), looking);
    if (status == ReadStatus::line) return line;
    if (status == ReadStatus::interrupted) throw std::runtime_error("interrupted");
    if (status == ReadStatus::ended) {
        const std::string how = with_last_words(asked.process.ending(), asked.process);
        if (waits_for_launcher) throw NoWorker("--launcher: no worker: " + how);
        throw std::runtime_error(how);
    }
    if (waits_for_launcher) throw NoWorker(with_last_words(no_start_text(patience.launch), asked.process));
    throw std::runtime_error(
        fmt::format("no answer within {:g} s", double(patience.of_a_driver.count()) / 1000));
}

std::vector<DeviceInfo> answer(Asked& asked, const Patience& patience) {
    for (;;) {
        const std::string line = next_line(asked, patience);
        const auto started = parse_started_line(line);
        if (!started) return parse_probe_line(line);
        if (!asked.worker) asked.worker = started;
        check_one(*asked.worker, *started);
    }
}

bool same_device(const DeviceInfo& a, const DeviceInfo& b) {
    const bool uuids_agree = a.uuid.empty() || b.uuid.empty() || a.uuid == b.uuid;
    return a.platform == b.platform && a.platform_version == b.platform_version && a.name == b.name &&
           a.driver_version == b.driver_version && a.device_index == b.device_index && uuids_agree;
}

/// "pocl:0" of the n-th driver that calls itself pocl: "pocl@n:0".
std::string numbered_key(const std::string& key, int n) {
    const auto colon = key.rfind(':');
    return fmt::format("{}@{}{}", key.substr(0, colon), n,
                       colon == std::string::npos ? std::string() : key.substr(colon));
}

std::string unique_key(const std::string& key, const std::set<std::string>& taken) {
    std::string unique = key;
    for (int n = 2; taken.contains(unique); ++n) unique = numbered_key(key, n);
    return unique;
}

void exclude_if_known(DeviceInfo& device, const std::vector<DeviceInfo>& known) {
    if (!device.excluded.empty()) return;
    for (const DeviceInfo& other : known) {
        if (other.icd == device.icd || !other.excluded.empty() || !same_device(other, device)) continue;
        device.excluded = fmt::format("the same device as {}, found again through {}", other.key, device.icd);
        return;
    }
}

/// Null for what is no JSON.
Json json_of_answer(const std::string& line) {
    try {
        return parse_json(line, "answer");
    } catch (const UsageError&) {
        return nullptr;
    }
}

std::string one_line(const Json& json) { return dump_json(json) + "\n"; }

}  // namespace

ChildCommand worker_command(const WorkerLaunch& launch, const IcdFolder& icd_folder, const std::string& nonce,
                            std::vector<std::string> arguments) {
    ChildCommand command;
    command.argv = launch.launcher;
    command.argv.push_back(launch.executable);
    command.argv.push_back("worker");
    for (auto& argument : arguments) command.argv.push_back(std::move(argument));
    command.argv.insert(command.argv.end(), {"--nonce", nonce});
    command.environment = icd_folder.environment();
    command.nonce = nonce;
    command.by_launcher = !launch.launcher.empty();
    return command;
}

std::string no_start_text(const WorkerLaunch& launch) {
    return fmt::format("--launcher: no worker within {:g} s (--start-timeout)",
                       double(launch.start_timeout.count()) / 1000);
}

DeviceList probe(const std::vector<Icd>& icds, const WorkerLaunch& launch, milliseconds patience,
                 const Stopped& stopped) {
    const Patience how{launch, Clock::now() + patience, patience, stopped};
    std::vector<std::unique_ptr<Asked>> all;
    for (const Icd& icd : icds) all.push_back(std::make_unique<Asked>(icd, launch));
    DeviceList list;
    std::vector<std::vector<DeviceInfo>> by_icd;
    for (const auto& asked : all) {
        try {
            by_icd.push_back(answer(*asked, how));
            for (DeviceInfo& device : by_icd.back()) device.icd = asked->icd.file;
        } catch (const NoWorker&) {
            throw;
        } catch (const TwoWorkers&) {
            throw;
        } catch (const std::exception& error) {
            list.broken.push_back({asked->icd == any_icd ? "any driver" : asked->icd.file, error.what()});
        }
    }
    list.devices = join_devices(by_icd);
    return list;
}

std::vector<DeviceInfo> join_devices(const std::vector<std::vector<DeviceInfo>>& by_icd) {
    std::vector<DeviceInfo> joined;
    std::set<std::string> taken;
    int platforms = 0;
    for (const auto& devices : by_icd) {
        std::map<int, int> renumbered;  // platform_index within the driver -> in the list
        for (DeviceInfo device : devices) {
            const auto [entry, is_new] = renumbered.try_emplace(device.platform_index, platforms);
            platforms += is_new ? 1 : 0;
            device.platform_index = entry->second;
            exclude_if_known(device, joined);
            device.key = unique_key(device.key, taken);
            taken.insert(device.key);
            joined.push_back(std::move(device));
        }
    }
    return joined;
}

std::string local_key(const std::string& key) {
    const auto at = key.rfind('@');
    const auto colon = key.rfind(':');
    if (at == std::string::npos || colon == std::string::npos || colon < at) return key;
    return key.substr(0, at) + key.substr(colon);
}

std::string started_line(const WorkerIdentity& worker) { return one_line({{"started", worker}}); }

std::optional<WorkerIdentity> parse_started_line(const std::string& line) {
    const std::string origin = "answer";
    const Json json = json_of_answer(line);
    if (!json.is_object() || !json.contains("started")) return std::nullopt;
    WorkerIdentity worker;
    decode(json["started"], Where(Where(origin), "started"), worker);
    return worker;
}

std::string probe_line(const std::vector<DeviceInfo>& devices) { return one_line({{"devices", devices}}); }

std::string probe_error_line(const std::string& reason) { return one_line({{"error", reason}}); }

std::vector<DeviceInfo> parse_probe_line(const std::string& line) {
    const Json json = json_of_answer(line);
    if (!json.is_object())
        throw std::runtime_error(fmt::format("garbled answer \"{}\"", shortened(printable(line), 60)));
    const std::string origin = "answer";
    const Where where(origin);
    if (json.contains("error")) {
        std::string reason;
        decode(json["error"], Where(where, "error"), reason);
        throw std::runtime_error(reason);
    }
    std::vector<DeviceInfo> devices;
    decode(member(json, where, "devices"), Where(where, "devices"), devices);
    return devices;
}

}  // namespace ptb
