#include "bench/report/html/packed.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <zlib.h>

#include "bench/record/result_file.h"
#include "bench/report/html/exp_golomb.h"
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

/// a - b for any times that a file may hold; unsigned numbers may overflow.
std::uint64_t difference(std::int64_t a, std::int64_t b) {
    return static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b);
}

/// Times, each of them middle + step * difference. What noise adds to them cannot be compressed.
struct TimeColumn {
    std::int64_t middle = 0;
    std::uint64_t step = 1;                  ///< of the clock: 32 ns on NVIDIA's devices
    std::vector<std::uint64_t> differences;  ///< 0, -1, 1, -2, 2, ... as 0, 1, 2, 3, 4, ...
    ExpGolomb code;                          ///< of them
};

TimeColumn column_of(const std::vector<std::int64_t>& values) {
    TimeColumn column;
    if (values.empty()) return column;
    auto sorted = values;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    column.middle = *middle;
    const auto distance = [&](std::int64_t value) {
        const std::uint64_t above = difference(value, column.middle);
        return value < column.middle ? -above : above;
    };
    std::uint64_t step = 0;
    for (const std::int64_t value : values) step = std::gcd(step, distance(value));
    column.step = std::max<std::uint64_t>(step, 1);
    for (const std::int64_t value : values)
        column.differences.push_back(2 * (distance(value) / column.step) - (value < column.middle ? 1 : 0));
    column.code = best_code(column.differences);
    return column;
}

/// What is returned tells how to read the bits that are appended.
Json append_column(BitString& bits, const TimeColumn& column) {
    for (const std::uint64_t value : column.differences) append_exp_golomb(bits, value, column.code.order);
    return {{"middle", column.middle}, {"step", column.step}, {"order", column.code.order}};
}

using Value = std::int64_t (*)(const TimeSample&);

std::vector<std::int64_t> values_of(const std::vector<TimeSample>& samples, Value value) {
    std::vector<std::int64_t> values;
    for (const TimeSample& s : samples) values.push_back(value(s));
    return values;
}

/// A column of its values, or, with "kernel", of what they are longer than the kernel's time, whichever is
/// shorter: a launch that waits for the one before it waits nearly as long as that takes.
Json append_time(BitString& bits, const std::vector<TimeSample>& samples, Value value) {
    const auto plain = values_of(samples, value);
    auto longer = plain;
    for (std::size_t i = 0; i < plain.size(); ++i)
        longer[i] = static_cast<std::int64_t>(difference(plain[i], samples[i].kernel_ns));
    const TimeColumn columns[] = {column_of(plain), column_of(longer)};
    const bool kernel = columns[1].code.bits < columns[0].code.bits;
    Json json = append_column(bits, columns[kernel]);
    json["kernel"] = kernel;
    return json;
}

Json append_samples(BitString& bits, const std::vector<TimeSample>& samples) {
    using S = const TimeSample&;
    Json json = {{"cause", Json::array()}};
    for (const TimeSample& s : samples) json["cause"].push_back(s.cause);
    json["kernel_ns"] = append_column(bits, column_of(values_of(samples, [](S s) { return s.kernel_ns; })));
    json["sum_ns"] = append_time(bits, samples, [](S s) { return s.sum_ns; });
    json["host_ns"] = append_time(bits, samples, [](S s) { return s.host_ns; });
    json["queued_ns"] = append_time(bits, samples, [](S s) { return s.queued_ns; });
    json["submit_ns"] = append_time(bits, samples, [](S s) { return s.submit_ns; });
    json["probe_ns"] = append_time(bits, samples, [](S s) { return s.probe_ns; });
    return json;
}

/// 13 bits, the lowest first, in two digits of base 91, which are ASCII from '#' on, with '!' for '<': a
/// thirteenth shorter than base64. What is left of up to 6 bits is one digit.
std::string base91(std::string_view bytes) {
    std::string text;
    const auto append_digit = [&](unsigned digit) {
        const char c = static_cast<char>('#' + digit);
        text += c == '<' ? '!' : c;
    };
    unsigned bits = 0, count = 0;
    for (const char byte : bytes) {
        bits |= unsigned{static_cast<unsigned char>(byte)} << count;
        count += 8;
        if (count < 13) continue;
        append_digit((bits & 0x1fff) % 91);
        append_digit((bits & 0x1fff) / 91);
        bits >>= 13;
        count -= 13;
    }
    if (count > 0) append_digit(bits % 91);
    if (count > 6) append_digit(bits / 91);
    return text;
}

std::string packed_all(const Json& json, const std::string& bytes) {
    return base91(deflated(dump_json(json) + "\n" + bytes));
}

}  // namespace

std::string packed_text(const std::string& text) {
    return packed_all({{"text", text}, {"samples", Json::array()}}, "");
}

std::string packed(const ResultFile& result, const std::string& name) {
    ResultFile bare = result;
    Json samples = Json::array();
    BitString bits;
    for (Record& record : bare.cases) {
        samples.push_back(append_samples(bits, record.samples));
        record.samples.clear();
    }
    return packed_all({{"name", name}, {"text", result_text(bare)}, {"samples", samples}}, bits.bytes());
}

}  // namespace ptb
