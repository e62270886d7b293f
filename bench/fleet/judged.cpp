#include "bench/fleet/judged.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/record/journal.h"
#include "bench/record/seen_from.h"
#include "bench/report/words.h"
#include "core/source/text_hash.h"

namespace ptb {
namespace {

std::vector<std::string> nodes_of(const Fleet& fleet, const DeviceClass& of) {
    std::vector<std::string> nodes;
    for (const std::size_t i : of.cards) nodes.push_back(fleet.cards[i].node);
    return nodes;
}

std::vector<JudgedClass> judged_classes(const Fleet& fleet) {
    std::vector<JudgedClass> classes;
    for (const DeviceClass& of : classes_of(fleet)) {
        JudgedClass judged{of, screen(fleet, of), {}, wrong_bits(fleet, of), drift_in(fleet, of)};
        if (!judged.screened.candidates.empty())
            judged.controls = controls_of(judged.screened, nodes_of(fleet, of), fleet.plan.run.seed);
        classes.push_back(std::move(judged));
    }
    return classes;
}

Confirmation confirmation_of(const Fleet& fleet, const std::vector<JudgedClass>& classes) {
    Confirmation confirmation;
    for (const JudgedClass& judged : classes)
        for (const auto* places : {&judged.screened.candidates, &judged.controls})
            for (const std::size_t place : *places) confirmation.cards.push_back(judged.of.cards[place]);
    std::sort(confirmation.cards.begin(), confirmation.cards.end());
    std::string names;
    for (const std::size_t card : confirmation.cards) names += label(fleet.cards[card]) + "\n";
    if (!names.empty()) confirmation.id = text_hash(names);
    return confirmation;
}

/// Of one finished session, by the fleet's works.
std::optional<std::vector<double>> session_times(const std::filesystem::path& file, const Fleet& fleet) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    ResultFile run = read_run(file);
    if (run.run.finished_at.empty()) return std::nullopt;
    see_from(fleet.plan.run.folder, run, data_dir());
    std::vector<double> times(fleet.works.size(), std::numeric_limits<double>::quiet_NaN());
    for (const Record& record : run.cases) {
        Case work = without_device(record.params);
        if (record.work) work.lanes = record.work->lanes;
        const auto found = std::find(fleet.works.begin(), fleet.works.end(), work);
        if (found != fleet.works.end() && timed(record))
            times[static_cast<std::size_t>(found - fleet.works.begin())] =
                std::log(record.statistics->median_ns);
    }
    return times;
}

/// All finished sessions of a card.
LogTimes sessions_of(const FleetFolder& folder, const Fleet& fleet, const Confirmation& confirmation,
                     std::size_t card) {
    LogTimes sessions;
    for (int session = 1; session <= confirm_sessions; ++session)
        if (auto times = session_times(session_file(folder, confirmation, fleet.cards[card], session), fleet))
            sessions.push_back(std::move(*times));
    return sessions;
}

void add_suspects(const FleetFolder& folder, Judged& judged) {
    std::vector<std::vector<double>> deviations;
    for (const JudgedClass& each : judged.classes) {
        LogTimes controls;
        for (const std::size_t place : each.controls)
            for (auto& session : sessions_of(folder, judged.fleet, judged.confirmation, each.of.cards[place]))
                controls.push_back(std::move(session));
        judged.sessions += static_cast<int>(controls.size());
        for (const std::size_t place : each.screened.candidates) {
            const std::size_t card = each.of.cards[place];
            const LogTimes own = sessions_of(folder, judged.fleet, judged.confirmation, card);
            const int n = static_cast<int>(own.size());
            judged.sessions += n;
            judged.suspects.push_back({card, each.screened.deviation[place], n, {}});
            deviations.push_back(session_deviations(own, controls));
        }
    }
    judged.sessions_to_come =
        confirm_sessions * static_cast<int>(judged.confirmation.cards.size()) - judged.sessions;
    if (judged.sessions_to_come > 0) return;
    const std::vector<Confirmed> found = confirmed(deviations);
    for (std::size_t i = 0; i < found.size(); ++i) judged.suspects[i].confirmed = found[i];
}

void sort_suspects(std::vector<Suspect>& suspects) {
    const auto rank = [](const Suspect& s) {
        return std::pair(s.confirmed && s.confirmed->speed == Speed::slow, s.deviation);
    };
    std::stable_sort(suspects.begin(), suspects.end(),
                     [&](const Suspect& a, const Suspect& b) { return rank(a) > rank(b); });
}

bool is_failure(Status status) {
    return status != Status::ok && status != Status::unstable && status != Status::unsupported &&
           status != Status::skipped;
}

std::map<std::size_t, Status> failed_cards(const Fleet& fleet) {
    std::map<std::size_t, Status> failed;
    for (std::size_t i = 0; i < fleet.cards.size(); ++i)
        for (const CardCase& c : fleet.cards[i].cases)
            if (is_failure(c.status) && (!failed.contains(i) || c.status == Status::invalid))
                failed[i] = c.status;
    return failed;
}

}  // namespace

bool Judged::is_slow(std::size_t card) const {
    return std::any_of(suspects.begin(), suspects.end(), [card](const Suspect& suspect) {
        return suspect.card == card && suspect.confirmed && suspect.confirmed->speed == Speed::slow;
    });
}

std::filesystem::path session_file(const FleetFolder& folder, const Confirmation& confirmation,
                                   const Card& card, int session) {
    std::string key = card.device.key;
    std::replace(key.begin(), key.end(), ':', '-');
    return folder.path / "confirm" / confirmation.id / fmt::format("{}.{}.{}.jsonl", card.node, key, session);
}

Judged judged(const FleetFolder& folder, Fleet fleet) {
    Judged found;
    found.fleet = std::move(fleet);
    found.classes = judged_classes(found.fleet);
    found.confirmation = confirmation_of(found.fleet, found.classes);
    add_suspects(folder, found);
    sort_suspects(found.suspects);
    found.failed = failed_cards(found.fleet);
    for (const FleetNode& node : found.fleet.nodes)
        if (!node.finished) found.missing.push_back(node.name);
    return found;
}

}  // namespace ptb
