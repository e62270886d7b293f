#include "bench/report/fleet.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "bench/fleet/nodes.h"
#include "bench/measure/statistics.h"
#include "bench/record/status.h"
#include "bench/report/csv.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

constexpr std::size_t most_rows = 12, most_lines = 4;  ///< of a screen

/// Finite deviations, sorted.
std::vector<double> known(std::vector<double> deviations) {
    std::erase_if(deviations, [](double d) { return std::isnan(d); });
    std::sort(deviations.begin(), deviations.end());
    return deviations;
}

std::string worst_text(const Judged& judged, const JudgedClass& each) {
    const auto& deviation = each.screened.deviation;
    std::size_t worst = 0;
    for (std::size_t i = 1; i < deviation.size(); ++i)
        if (std::isnan(deviation[worst]) || deviation[i] > deviation[worst]) worst = i;
    return fmt::format("{} {}", slower_text(deviation[worst]),
                       label(judged.fleet.cards[each.of.cards[worst]]));
}

std::vector<std::string> class_cells(const Judged& judged, const JudgedClass& each) {
    const DeviceInfo& device = judged.fleet.cards[each.of.cards.front()].device;
    const std::vector<double> deviations = known(each.screened.deviation);
    const auto at = [&](double share) {
        return deviations.empty() ? std::string("-") : slower_text(quantile(deviations, share));
    };
    const bool says = deviations.size() >= fewest_cards;
    return {device.name,
            device.driver_version,
            std::to_string(each.of.cards.size()),
            number_text(ms(std::exp(each.screened.typical_log_ns))),
            says ? at(0.05) : "-",
            says ? at(0.95) : "-",
            deviations.empty() ? "-" : worst_text(judged, each)};
}

std::size_t measured_cases(const Fleet& fleet) {
    std::size_t cases = 0;
    for (const Card& card : fleet.cards) cases += card.cases.size();
    return cases;
}

std::size_t planned_cases(const Fleet& fleet) {
    std::size_t cases = 0;
    for (const Card& card : fleet.cards) cases += card.planned;
    return cases;
}

std::string title_of(const Judged& judged) {
    const Fleet& fleet = judged.fleet;
    return fmt::format("fleet: config {}, {} of {} nodes, {} devices, {} of {} cases", fleet.plan.run.config,
                       fleet.nodes.size() - judged.missing.size(), fleet.nodes.size(), fleet.cards.size(),
                       measured_cases(fleet), planned_cases(fleet));
}

Section classes_section(const Judged& judged) {
    Section section{title_of(judged), {}, {}};
    section.grid.columns = {{"device", false, 40}, {"driver", false, 24}, {"n", true},
                            {"typical ms", true},  {"5 %", true},         {"95 %", true},
                            {"slowest", false}};
    for (const JudgedClass& each : judged.classes) section.grid.rows.push_back(class_cells(judged, each));
    for (const JudgedClass& each : judged.classes)
        if (each.screened.too_few)
            section.notes.push_back(fmt::format(
                "{}: {} of a kind are too few to say which is slow; {} are needed",
                judged.fleet.cards[each.of.cards.front()].device.name, each.of.cards.size(), fewest_cards));
    return section;
}

/// Cards with a finding, the gravest first.
std::vector<std::size_t> cards_to_look_at(const Judged& judged) {
    std::vector<std::size_t> cards;
    const auto add = [&](std::size_t card) {
        if (std::find(cards.begin(), cards.end(), card) == cards.end()) cards.push_back(card);
    };
    for (const JudgedClass& each : judged.classes)
        for (const WrongBits& wrong : each.wrong) add(wrong.card);
    for (const auto& [card, status] : judged.failed) add(card);
    for (const Suspect& suspect : judged.suspects) add(suspect.card);
    for (std::size_t i = 0; i < judged.fleet.cards.size(); ++i)
        if (!judged.fleet.cards[i].device.excluded.empty()) add(i);
    return cards;
}

/// Of a suspect, what is known of it; else empty.
const Suspect* suspect_of(const Judged& judged, std::size_t card) {
    for (const Suspect& suspect : judged.suspects)
        if (suspect.card == card) return &suspect;
    return nullptr;
}

std::string at_least_text(const Suspect* suspect) {
    if (suspect == nullptr) return "-";
    if (!suspect->confirmed)
        return suspect->sessions == 0 ? "-" : fmt::format("{} sessions", suspect->sessions);
    return slower_text(suspect->confirmed->at_least);
}

double deviation_of(const Judged& judged, std::size_t card) {
    for (const JudgedClass& each : judged.classes)
        for (std::size_t i = 0; i < each.of.cards.size(); ++i)
            if (each.of.cards[i] == card) return each.screened.deviation[i];
    return std::nan("");
}

std::vector<std::string> card_cells(const Judged& judged, std::size_t number) {
    const Card& card = judged.fleet.cards[number];
    const Suspect* const suspect = suspect_of(judged, number);
    const double deviation =
        suspect != nullptr && suspect->confirmed ? suspect->confirmed->mean : deviation_of(judged, number);
    return {label(card),
            card.device.pci.empty() ? "-" : card.device.pci,
            finding_text(judged, number),
            slower_text(deviation),
            at_least_text(suspect),
            state_text(card)};
}

const std::vector<Column>& card_columns() {
    static const std::vector<Column> columns{{"device", false},   {"PCI", false},     {"finding", false, 60},
                                             {"slower by", true}, {"at least", true}, {"state", false, 60}};
    return columns;
}

Section findings_section(const Judged& judged) {
    const std::vector<std::size_t> cards = cards_to_look_at(judged);
    Section section{"devices to look at", {card_columns(), {}}, {}};
    for (std::size_t i = 0; i < std::min(cards.size(), most_rows); ++i)
        section.grid.rows.push_back(card_cells(judged, cards[i]));
    if (cards.size() > most_rows)
        section.notes.push_back(
            fmt::format("{} more are in the page and the CSV (--html, --csv)", cards.size() - most_rows));
    return section;
}

void add_drift(const Judged& judged, std::vector<std::string>& lines) {
    std::size_t told = 0, all = 0;
    for (const JudgedClass& each : judged.classes)
        for (const Drift& drift : each.drift) {
            if (++all > most_lines) continue;
            std::set<std::string> nodes;
            for (const std::size_t card : drift.cards) nodes.insert(judged.fleet.cards[card].node);
            lines.push_back(fmt::format("drift: {} is {} on {} ({} devices), {} on most", drift.fact,
                                        drift.value.empty() ? "unknown" : drift.value,
                                        node_list({nodes.begin(), nodes.end()}), drift.cards.size(),
                                        drift.most.empty() ? "unknown" : drift.most));
            ++told;
        }
    if (all > told) lines.push_back(fmt::format("drift: {} more facts differ", all - told));
}

std::string reason_of(const FleetNode& node) {
    if (!node.refused.empty()) return node.refused;
    if (!node.has_journal) return "it never came";
    return fmt::format("{} of {} cases are measured", node.recorded, node.planned);
}

void add_missing(const Judged& judged, std::vector<std::string>& lines) {
    if (judged.missing.empty()) return;
    lines.push_back(fmt::format("missing: {}", node_list(judged.missing)));
    std::size_t told = 0;
    for (const FleetNode& node : judged.fleet.nodes)
        if (!node.finished && ++told <= most_lines)
            lines.push_back(fmt::format("  {}: {}", node.name, reason_of(node)));
    if (told > most_lines) lines.push_back(fmt::format("  and {} more", told - most_lines));
}

/// Nodes of cards that are slow or compute wrongly for sure.
std::vector<std::string> nodes_to_exclude(const Judged& judged) {
    std::set<std::string> nodes;
    for (const Suspect& suspect : judged.suspects)
        if (judged.is_slow(suspect.card)) nodes.insert(judged.fleet.cards[suspect.card].node);
    for (const JudgedClass& each : judged.classes)
        for (const WrongBits& wrong : each.wrong)
            if (!wrong.in_doubt) nodes.insert(judged.fleet.cards[wrong.card].node);
    for (const auto& [card, status] : judged.failed)
        if (status == Status::invalid) nodes.insert(judged.fleet.cards[card].node);
    return {nodes.begin(), nodes.end()};
}

std::string command(const std::vector<std::string>& nodes, const std::string& folder, const char* more) {
    return fmt::format("srun -N{} -w {} --ntasks-per-node=1 --exclusive ptbench --fleet {}{}", nodes.size(),
                       node_list(nodes), folder, more);
}

void add_what_to_do(const Judged& judged, const std::string& folder, std::vector<std::string>& lines) {
    const auto excluded = nodes_to_exclude(judged);
    if (!excluded.empty()) lines.push_back(fmt::format("exclude: {}", fmt::join(excluded, ",")));
    if (!judged.missing.empty()) lines.push_back("to go on: " + command(judged.missing, folder, ""));
    std::set<std::string> nodes;
    for (const std::size_t card : judged.confirmation.cards) nodes.insert(judged.fleet.cards[card].node);
    if (judged.sessions_to_come > 0 && judged.missing.empty())
        lines.push_back("to confirm: " + command({nodes.begin(), nodes.end()}, folder, " --confirm"));
}

Section remarks(const Judged& judged, const std::string& folder) {
    Section section{"", {}, {}};
    if (judged.sessions > 0)
        section.notes.push_back(fmt::format("confirmed in {} of {} sessions, of {} devices", judged.sessions,
                                            judged.sessions + judged.sessions_to_come,
                                            judged.confirmation.cards.size()));
    add_drift(judged, section.notes);
    add_missing(judged, section.notes);
    add_what_to_do(judged, folder, section.notes);
    return section;
}

std::string wrong_text(const WrongBits& wrong, const Fleet& fleet) {
    const Case& work = fleet.works[wrong.work];
    return fmt::format("{}: {} {} spp {}", wrong.in_doubt ? "image differs" : "wrong image", work.kernel,
                       work.scene, work.spp);
}

}  // namespace

std::string slower_text(double log_ratio) {
    return std::isnan(log_ratio) ? "-" : fmt::format("{:+.1f} %", 100 * std::expm1(log_ratio));
}

std::string state_text(const Card& card) {
    if (!card.state) return "";
    const GpuState& state = *card.state;
    std::vector<std::string> texts;
    if (state.clock_mhz) texts.push_back(fmt::format("{} MHz", *state.clock_mhz));
    if (state.temperature_c) texts.push_back(fmt::format("{} C", *state.temperature_c));
    if (state.power_w) texts.push_back(fmt::format("{:.0f} W", *state.power_w));
    if (!state.throttle.empty())
        texts.push_back(fmt::format("held back by {}", fmt::join(state.throttle, " and ")));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string finding_text(const Judged& judged, std::size_t card) {
    for (const JudgedClass& each : judged.classes)
        for (const WrongBits& wrong : each.wrong)
            if (wrong.card == card) return wrong_text(wrong, judged.fleet);
    if (const auto failed = judged.failed.find(card); failed != judged.failed.end())
        return failed->second == Status::invalid ? "wrong image" : to_string(failed->second);
    if (!judged.fleet.cards[card].device.excluded.empty()) return judged.fleet.cards[card].device.excluded;
    if (judged.is_slow(card)) return "slow";
    const Suspect* const suspect = suspect_of(judged, card);
    if (suspect == nullptr) return "ok";
    return suspect->confirmed ? "suspect" : "suspect, to be confirmed";
}

Section cards_section(const Judged& judged) {
    Section section{"all devices", {card_columns(), {}}, {}};
    section.grid.columns.insert(section.grid.columns.begin() + 1, Column{"name", false});
    section.grid.columns.push_back({"UUID", false});
    section.grid.columns.push_back({"serial", false});
    for (std::size_t i = 0; i < judged.fleet.cards.size(); ++i) {
        const DeviceInfo& device = judged.fleet.cards[i].device;
        auto cells = card_cells(judged, i);
        cells.insert(cells.begin() + 1, device.name);
        cells.insert(cells.end(), {device.uuid, device.serial});
        section.grid.rows.push_back(std::move(cells));
    }
    return section;
}

std::string fleet_csv(const Judged& judged) {
    const auto number = [](double value) {
        return std::isnan(value) ? std::string() : fmt::format("{:.5f}", std::expm1(value));
    };
    Grid grid;
    for (const char* const title : {"node", "device", "name", "driver", "pci", "uuid", "serial", "finding"})
        grid.columns.push_back({title, false});
    for (const char* const title : {"cases", "slower_by", "confirmed_at_least"})
        grid.columns.push_back({title, true});
    for (std::size_t i = 0; i < judged.fleet.cards.size(); ++i) {
        const Card& card = judged.fleet.cards[i];
        const Suspect* const suspect = suspect_of(judged, i);
        grid.rows.push_back(
            {card.node, card.device.key, card.device.name, card.device.driver_version, card.device.pci,
             card.device.uuid, card.device.serial, finding_text(judged, i), std::to_string(card.cases.size()),
             number(deviation_of(judged, i)),
             suspect != nullptr && suspect->confirmed ? number(suspect->confirmed->at_least) : ""});
    }
    return csv(grid);
}

std::vector<Section> fleet_sections(const Judged& judged, const std::string& folder) {
    std::vector<Section> sections;
    for (Section& section :
         std::vector{classes_section(judged), findings_section(judged), remarks(judged, folder)})
        if (!section.grid.rows.empty() || !section.notes.empty() || sections.empty())
            sections.push_back(std::move(section));
    return sections;
}

std::string fleet_text(const Judged& judged, const std::string& folder, const TextStyle& style) {
    return joined(fleet_sections(judged, folder),
                  [&](const Section& section) { return to_text(section, style); });
}

std::string fleet_markdown(const Judged& judged, const std::string& folder) {
    return joined(fleet_sections(judged, folder), to_markdown);
}

}  // namespace ptb
