#include "bench/fleet/confirm.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <boost/math/distributions/students_t.hpp>

#include "bench/compare/evidence.h"

namespace ptb {
namespace {

/// Of one candidate, before it is known beside how many others it stands.
struct Mean {
    double mean = 0, standard_error = 0, degrees = 0;

    double statistic() const { return (mean - std::log1p(slow_by)) / standard_error; }
    double lower_bound(double alpha) const {
        const boost::math::students_t t(degrees);
        return mean - boost::math::quantile(boost::math::complement(t, alpha)) * standard_error;
    }
};

/// That have an error; of fewer nothing can be said.
constexpr std::size_t fewest_sessions = 2;

/// Sessions that agree to the last bit would have no error.
constexpr double least_error = 1e-9;

Mean mean_of(std::span<const double> deviations) {
    const auto [mean, sd] = moments(deviations);
    const double n = static_cast<double>(deviations.size());
    return {mean, std::max(sd / std::sqrt(n), least_error), n - 1};
}

/// From random bits alone, since the library's shuffle is another one elsewhere.
void shuffle(std::vector<std::size_t>& places, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random() % i]);
}

}  // namespace

std::vector<std::size_t> controls_of(const Screened& screened, const std::vector<std::string>& node_of_card,
                                     std::uint64_t seed) {
    const std::set<std::size_t> candidates(screened.candidates.begin(), screened.candidates.end());
    std::set<std::string> suspected;
    for (const std::size_t i : screened.candidates) suspected.insert(node_of_card[i]);
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < node_of_card.size(); ++i)
        if (!candidates.contains(i) && !std::isnan(screened.deviation[i])) others.push_back(i);
    shuffle(others, seed);
    std::stable_partition(others.begin(), others.end(),
                          [&](std::size_t i) { return !suspected.contains(node_of_card[i]); });
    others.resize(std::min(others.size(), most_controls));
    std::sort(others.begin(), others.end());
    return others;
}

std::vector<double> session_deviations(const LogTimes& candidate, const LogTimes& controls) {
    std::vector<double> found;
    for (const auto& session : candidate) {
        std::vector<double> of_works;
        for (std::size_t work = 0; work < session.size(); ++work) {
            std::vector<double> reference;
            for (const auto& control : controls)
                if (!std::isnan(control[work])) reference.push_back(control[work]);
            const double deviation = session[work] - median_of(std::move(reference));
            if (!std::isnan(deviation)) of_works.push_back(deviation);
        }
        if (!of_works.empty()) found.push_back(median_of(std::move(of_works)));
    }
    return found;
}

std::vector<Confirmed> confirmed(const std::vector<std::vector<double>>& deviations) {
    std::vector<Mean> means(deviations.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        if (deviations[i].size() < fewest_sessions) continue;
        means[i] = mean_of(deviations[i]);
        order.push_back(i);
    }
    std::sort(order.begin(), order.end(),
              [&](auto a, auto b) { return means[a].statistic() > means[b].statistic(); });
    std::vector<Confirmed> found(means.size());
    bool all_before = true;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Mean& mean = means[order[k]];
        const double bound = mean.lower_bound(confirm_alpha / static_cast<double>(order.size() - k));
        all_before = all_before && bound > std::log1p(slow_by);
        found[order[k]] = {all_before ? Speed::slow : Speed::suspect, mean.mean, bound};
    }
    return found;
}

}  // namespace ptb
