#include "bench/fleet/merge.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/measure/fit.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"
#include "core/file/replace_file.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::string key_in_fleet(const std::string& node, const std::string& key) { return node + "/" + key; }

std::vector<ResultFile> headers_of(const FleetFolder& folder) {
    std::vector<ResultFile> headers;
    for (const std::string& node : folder.with_journal())
        headers.push_back(read_header(folder.journal(node)));
    return headers;
}

/// The fleet's result, less what is long.
ResultFile frame_of(const FleetPlan& plan, const std::vector<ResultFile>& headers) {
    ResultFile frame;
    frame.run = plan.run;
    frame.run.expected = expected_nodes(plan, headers);
    for (const ResultFile& node : headers) {
        const std::string& name = node.host.node;
        frame.hosts.push_back(node.host);
        for (DeviceInfo device : node.devices) {
            device.node = name;
            device.key = key_in_fleet(name, device.key);
            frame.devices.push_back(device);
        }
        for (DevicePeaks peaks : node.peaks) {
            peaks.device = key_in_fleet(name, peaks.device);
            frame.peaks.push_back(peaks);
        }
        frame.broken_icds.insert(frame.broken_icds.end(), node.broken_icds.begin(), node.broken_icds.end());
        for (const std::string& warning : node.warnings)
            frame.warnings.push_back(fmt::format("{}: {}", name, warning));
        frame.run.wall_s = std::max(frame.run.wall_s, node.run.wall_s);
    }
    if (!headers.empty()) frame.host = headers.front().host;
    return frame;
}

/// Writes a result file whose cases are too many to be held at once: they come after all else. Beside the
/// file, until it is whole.
class ResultWriter {
  public:
    ResultWriter(const fs::path& file, const ResultFile& frame)
        : beside_(file), out_(beside_.path(), std::ios::binary | std::ios::trunc) {
        Json json = result_to_json(frame);
        json.erase("cases");
        json.erase("fits");
        const std::string text = dump_json(json, 1);
        out_ << text.substr(0, text.rfind("\n}")) << ",\n \"cases\": [";
    }

    void add(const std::string& node, std::vector<Record> records) {
        for (Record& record : records) {
            record.params.device = key_in_fleet(node, record.params.device);
            out_ << (first_ ? "\n" : ",\n") << dump_json(encode(record));
            first_ = false;
        }
        const std::vector<SppFit> fits = fits_over_spp(records);
        fits_.insert(fits_.end(), fits.begin(), fits.end());
    }

    /// Puts the file in place, or says why not.
    std::error_code end() {
        out_ << "\n ],\n \"fits\": " << dump_json(encode(fits_)) << "\n}\n";
        out_.close();
        return out_.good() ? beside_.put_in_place() : std::make_error_code(std::errc::io_error);
    }

  private:
    FileBeside beside_;
    std::ofstream out_;
    std::vector<SppFit> fits_;
    bool first_ = true;
};

}  // namespace

std::vector<std::string> expected_nodes(const FleetPlan& plan, const std::vector<ResultFile>& headers) {
    std::set<std::string> nodes(plan.run.expected.begin(), plan.run.expected.end());
    for (const ResultFile& header : headers) {
        nodes.insert(header.host.node);
        nodes.insert(header.run.expected.begin(), header.run.expected.end());
    }
    return {nodes.begin(), nodes.end()};
}

bool is_whole(const FleetFolder& folder, const FleetPlan& plan) {
    const std::vector<ResultFile> headers = headers_of(folder);
    const auto finished = std::count_if(headers.begin(), headers.end(), [](const ResultFile& header) {
        return !header.run.finished_at.empty();
    });
    return static_cast<std::size_t>(finished) == expected_nodes(plan, headers).size();
}

Fleet merge(const FleetFolder& folder) {
    ResultWriter writer(folder.result(), frame_of(read_plan(folder), headers_of(folder)));
    Fleet fleet = read_fleet(
        folder, [&](const std::string& node, const ResultFile& run) { writer.add(node, run.cases); });
    if (const std::error_code error = writer.end())
        throw std::runtime_error(
            fmt::format("cannot write {}: {}", folder.result().string(), error.message()));
    return fleet;
}

}  // namespace ptb
