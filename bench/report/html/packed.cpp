#include "bench/report/html/packed.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <zlib.h>

#include "bench/record/result_file.h"
#include "bench/report/html/html.h"
#include "core/input/json.h"

namespace ptb {
namespace {

std::string deflated(const std::string& text) {
    std::string bytes(compressBound(text.size()), '\0');
    uLongf size = bytes.size();
    if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                  text.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("zlib could not deflate a result");
    bytes.resize(size);
    return bytes;
}

/// Appends values less the smallest of them, their low bytes first, then their second ones, and so on: bytes
/// that are alike lie together. What is returned tells how to read them.
Json append_column(std::string& bytes, const std::vector<std::int64_t>& values) {
    const std::int64_t from = values.empty() ? 0 : *std::min_element(values.begin(), values.end());
    std::uint64_t most = 0;
    for (const std::int64_t value : values) most = std::max(most, static_cast<std::uint64_t>(value - from));
    int planes = 0;
    for (; most > 0; most >>= 8, ++planes)
        for (const std::int64_t value : values)
            bytes += static_cast<char>((value - from) >> (8 * planes) & 0xff);
    return {{"from", from}, {"planes", planes}};
}

using Value = std::int64_t (*)(const TimeSample&);

std::vector<std::int64_t> values_of(const std::vector<TimeSample>& samples, Value value) {
    std::vector<std::int64_t> values;
    for (const TimeSample& s : samples) values.push_back(value(s));
    return values;
}

std::int64_t spread(const std::vector<std::int64_t>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return values.empty() ? 0 : *most - *least;
}

/// A column of its values, or, with "kernel", of what they are longer than the kernel's time, whichever is
/// shorter: a launch that waits for the one before it waits nearly as long as that takes.
Json append_time(std::string& bytes, const std::vector<TimeSample>& samples, Value value) {
    const auto plain = values_of(samples, value);
    auto longer = plain;
    for (std::size_t i = 0; i < plain.size(); ++i) longer[i] -= samples[i].kernel_ns;
    const bool kernel = spread(longer) < spread(plain);
    Json json = append_column(bytes, kernel ? longer : plain);
    json["kernel"] = kernel;
    return json;
}

Json append_samples(std::string& bytes, const std::vector<TimeSample>& samples) {
    using S = const TimeSample&;
    Json json = {{"cause", Json::array()}};
    for (const TimeSample& s : samples) json["cause"].push_back(s.cause);
    json["kernel_ns"] = append_column(bytes, values_of(samples, [](S s) { return s.kernel_ns; }));
    json["sum_ns"] = append_time(bytes, samples, [](S s) { return s.sum_ns; });
    json["host_ns"] = append_time(bytes, samples, [](S s) { return s.host_ns; });
    json["queued_ns"] = append_time(bytes, samples, [](S s) { return s.queued_ns; });
    json["submit_ns"] = append_time(bytes, samples, [](S s) { return s.submit_ns; });
    json["probe_ns"] = append_time(bytes, samples, [](S s) { return s.probe_ns; });
    return json;
}

std::string packed_all(const Json& json, const std::string& bytes) {
    return base64(deflated(dump_json(json) + "\n" + bytes));
}

}  // namespace

std::string packed_text(const std::string& text) {
    return packed_all({{"text", text}, {"samples", Json::array()}}, "");
}

std::string packed(const ResultFile& result, const std::string& name) {
    ResultFile bare = result;
    Json samples = Json::array();
    std::string bytes;
    for (Record& record : bare.cases) {
        samples.push_back(append_samples(bytes, record.samples));
        record.samples.clear();
    }
    return packed_all({{"name", name}, {"text", result_text(bare)}, {"samples", samples}}, bytes);
}

}  // namespace ptb
