#include "bench/fleet/fleet.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/fleet/merge.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// Numbers the works as they come.
class Works {
  public:
    std::size_t number_of(const Record& record) {
        Case work = without_device(record.params);
        if (record.work) work.lanes = record.work->lanes;
        const auto [entry, is_new] = numbers_.try_emplace(work, works_.size());
        if (is_new) works_.push_back(work);
        return entry->second;
    }
    std::vector<Case> taken() { return std::move(works_); }

  private:
    std::map<Case, std::size_t> numbers_;
    std::vector<Case> works_;
};

CardCase card_case(const Record& record, Works& works) {
    CardCase c{works.number_of(record), record.status, {}, {}};
    if (timed(record)) c.log_ns = std::log(record.statistics->median_ns);
    if (record.work) c.film_hash = record.work->film_hash;
    return c;
}

void add_cards(const ResultFile& run, const FleetPlan& plan, Works& works, std::vector<Card>& cards) {
    std::map<std::string, std::size_t> card_of;
    for (const DeviceInfo& device : run.devices) {
        Card card{run.host.node, device, {}, plan.cases({device}).size(), {}};
        card_of[device.key] = cards.size();
        const auto has_record = [&](const Record& record) { return record.params.device == device.key; };
        if (device.excluded.empty() || std::any_of(run.cases.begin(), run.cases.end(), has_record))
            cards.push_back(std::move(card));
    }
    for (const Record& record : run.cases) {
        Card& card = cards.at(card_of.at(record.params.device));
        card.cases.push_back(card_case(record, works));
        if (record.gpu) card.state = record.gpu;
    }
}

FleetNode node_of(const ResultFile& run, const FleetPlan& plan) {
    FleetNode node{run.host.node, run.host, plan.cases(run.devices).size(), 0, {}, run.run.lease, {}, true};
    node.finished = !run.run.finished_at.empty();
    for (const Record& record : run.cases)
        node.recorded += std::any_of(run.devices.begin(), run.devices.end(),
                                     [&](const DeviceInfo& device) {
                                         return device.excluded.empty() && device.key == record.params.device;
                                     })
                             ? 1
                             : 0;
    return node;
}

/// Those that were refused, or never came.
void add_others(const FleetFolder& folder, const std::vector<ResultFile>& headers, Fleet& fleet) {
    std::map<std::string, FleetNode> nodes;
    for (const std::string& name : expected_nodes(fleet.plan, headers)) nodes[name].name = name;
    for (const std::string& name : folder.refused()) {
        nodes[name].name = name;
        nodes[name].refused = folder.reason_of_refusal(name);
    }
    for (FleetNode& node : fleet.nodes) {
        node.refused = nodes[node.name].refused;
        nodes[node.name] = node;
    }
    fleet.nodes.clear();
    for (const auto& [name, node] : nodes) fleet.nodes.push_back(node);
}

}  // namespace

Fleet read_fleet(const FleetFolder& folder, const NodeRead& also) {
    Fleet fleet;
    fleet.plan = read_plan(folder);
    Works works;
    std::vector<ResultFile> headers;
    for (const std::string& name : folder.with_journal()) {
        ResultFile run = read_node(folder, fleet.plan, name);
        add_cards(run, fleet.plan, works, fleet.cards);
        fleet.nodes.push_back(node_of(run, fleet.plan));
        if (also) also(name, run);
        run.cases.clear();
        headers.push_back(std::move(run));
    }
    fleet.works = works.taken();
    add_others(folder, headers, fleet);
    return fleet;
}

std::string label(const Card& card) { return card.node + "/" + card.device.key; }

}  // namespace ptb
