#include "bench/report/ladder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "bench/plan/config.h"
#include "bench/plan/tuned.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// One kernel's cases of a work, by their places.
struct Climb {
    std::string kernel;
    std::vector<std::size_t> cases;
};

struct Climbers {
    Case shared;
    std::vector<Climb> kernels;
};

bool climbs(const Record& record) {
    const auto& e = record.efficiency;
    return timed(record) && e && e->all && e->best_99 && e->all->efficiency &&
           as_asked(record.params).work_group.implicit();
}

Case shared_work(const Record& record) {
    Case c = as_asked(record.params);
    c.kernel = default_case().kernel;
    c.spp = default_case().spp;
    return c;
}

void append(Climbers& work, const std::string& kernel, std::size_t place) {
    const auto found = std::find_if(work.kernels.begin(), work.kernels.end(),
                                    [&](const Climb& climb) { return climb.kernel == kernel; });
    if (found == work.kernels.end())
        work.kernels.push_back({kernel, {place}});
    else
        found->cases.push_back(place);
}

std::vector<Climbers> shared_works(const std::vector<Record>& records) {
    std::vector<Climbers> works;
    std::map<Case, std::size_t> place;
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (!climbs(records[i])) continue;
        const Case shared = shared_work(records[i]);
        const auto [found, added] = place.emplace(shared, works.size());
        if (added) works.push_back({shared, {}});
        append(works[found->second], records[i].params.kernel, i);
    }
    return works;
}

double time_ns(const std::vector<Record>& records, std::size_t i) { return records[i].statistics->median_ns; }

double equal_time_ns(const std::vector<Record>& records, const Climbers& work) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Climb& climb : work.kernels) {
        double longest = 0;
        for (const std::size_t i : climb.cases) longest = std::max(longest, time_ns(records, i));
        shortest = std::min(shortest, longest);
    }
    return shortest;
}

std::size_t nearest(const std::vector<Record>& records, const Climb& climb, double time) {
    const auto distance = [&](std::size_t i) { return std::abs(std::log(time_ns(records, i) / time)); };
    return *std::min_element(climb.cases.begin(), climb.cases.end(),
                             [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
}

}  // namespace

std::vector<Ladder> ladders(const std::vector<Record>& records) {
    std::vector<Ladder> all;
    for (const Climbers& work : shared_works(records)) {
        Ladder& ladder = all.emplace_back(Ladder{work.shared, equal_time_ns(records, work), {}});
        for (const Climb& climb : work.kernels)
            ladder.cases.push_back(nearest(records, climb, ladder.time_ns));
    }
    return all;
}

}  // namespace ptb
