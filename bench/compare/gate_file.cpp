#include "bench/compare/gate_file.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bench/compare/gate_json.h"
#include "bench/record/file.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr const char* schema = "ptbench.ab.v1";
constexpr std::size_t rounds_a_block = 4;
constexpr double long_sample_ns = 100e6;

bool all_positive(const std::vector<std::int64_t>& times) {
    return !times.empty() && std::all_of(times.begin(), times.end(), [](auto ns) { return ns > 0; });
}

void check_blocks(const std::vector<Block>& blocks, int most, const std::string& timer, const Where& where) {
    if (std::cmp_greater(blocks.size(), most))
        where.fail(fmt::format("found {} blocks; allowed: at most {}", blocks.size(), most));
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Where block(where, i), at(block, "rounds");
        const auto& rounds = blocks[i].rounds;
        if (rounds.size() != rounds_a_block)
            at.fail(fmt::format("found {} rounds; allowed: {}, of base, new, new, base", rounds.size(),
                                rounds_a_block));
        for (std::size_t r = 0; r < rounds.size(); ++r)
            if (!all_positive(timer == "host" ? rounds[r].host_ns : rounds[r].kernel_ns))
                Where(at, r).fail("allowed: at least one time, all above 0");
    }
}

void check_cases(const GateFile& gate, const Where& root) {
    const Where cases(root, "cases");
    for (std::size_t i = 0; i < gate.cases.size(); ++i) {
        const GateCase& c = gate.cases[i];
        const Where at(cases, i);
        if (c.timer != "event" && c.timer != "host") Where(at, "timer").refuse(c.timer, "event, host");
        if (!(c.tolerance > 0)) Where(at, "tolerance").refuse(c.tolerance, "a number above 0");
        check_blocks(c.screen, screen_blocks, c.timer, Where(at, "screen"));
        check_blocks(c.confirm, confirm_blocks, c.timer, Where(at, "confirm"));
    }
    for (const auto count : {gate.findings.size(), gate.base_records.size(), gate.now_records.size()})
        if (count != gate.cases.size())
            root.fail("findings, base_records and new_records must have one entry for each case");
}

Row row_of(const GateFile& gate, std::size_t i) {
    const GateCase& c = gate.cases[i];
    Row row;
    row.device = c.base.device;
    row.name = case_text(c.base);
    if (c.base != c.now) row.name += " -> " + case_text(c.now);
    row.tolerance = c.tolerance;
    row.finding = gate.findings[i];
    row.note = c.not_measured;
    if (c.timer == "host" && row.note.empty()) row.note = "timer: host";
    if (row.note.empty() && std::max(row.finding.base_ns, row.finding.now_ns) > long_sample_ns)
        row.note = "samples over 100 ms: fewer spp see more";
    return row;
}

}  // namespace

Json encode(State state) { return to_string(state); }

void decode(const Json& json, const Where& where, State& state) {
    const auto parsed = json.is_string() ? parse_state(json.get_ref<const std::string&>()) : std::nullopt;
    if (!parsed) where.refuse(json, "regressed, improved, same, inconclusive, missing, unmeasured");
    state = *parsed;
}

void write_gate(const std::filesystem::path& file, const GateFile& gate) {
    Json json = Json::object();
    json["schema"] = schema;
    json.update(encode(gate));
    write_file(file, dump_json(json, 1) + "\n");
}

GateFile read_gate(const std::filesystem::path& file) { return parse_gate(read_text(file), file.string()); }

GateFile parse_gate(std::string_view text, const std::string& origin) {
    const Json json = parse_json(text, origin);
    const Where root(origin);
    if (!json.is_object() || json.value("schema", Json()) != schema)
        root.fail(fmt::format("not a decision of `ptbench ab`: \"schema\" is not \"{}\"", schema));
    GateFile gate;
    decode(json, root, gate);
    check_cases(gate, root);
    return gate;
}

std::vector<Row> rows_of(const GateFile& gate) {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < gate.cases.size(); ++i) rows.push_back(row_of(gate, i));
    return rows;
}

}  // namespace ptb
