#include "bench/compare/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

namespace ptb {

Moments moments(std::span<const double> values) {
    if (values.empty()) return {};
    const double n = static_cast<double>(values.size());
    Moments m{std::accumulate(values.begin(), values.end(), 0.0) / n, 0};
    double squares = 0;
    for (const double v : values) squares += (v - m.mean) * (v - m.mean);
    if (n > 1) m.sd = std::sqrt(squares / (n - 1));
    return m;
}

std::vector<double> holm(std::span<const double> p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return p[a] < p[b]; });
    std::vector<double> adjusted(p.size());
    double so_far = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        so_far = std::max(so_far, std::min(1.0, p[order[k]] * static_cast<double>(p.size() - k)));
        adjusted[order[k]] = so_far;
    }
    return adjusted;
}

std::optional<Prediction> predict(std::span<const double> history, std::span<const double> next,
                                  double confidence) {
    if (history.size() < 2 || next.empty()) return std::nullopt;
    const auto [mean, sd] = moments(history);
    const double n = static_cast<double>(history.size()), m = static_cast<double>(next.size());
    const boost::math::students_t t(n - 1);
    Prediction p{moments(next).mean - mean, 1, 0, 0, sd * std::sqrt(1 / m + 1 / n)};
    const double reach = boost::math::quantile(t, (1 + confidence) / 2) * p.standard_error;
    p.low = p.difference - reach;
    p.high = p.difference + reach;
    if (p.standard_error > 0)
        p.p = 2 * boost::math::cdf(t, -std::abs(p.difference) / p.standard_error);
    else if (p.difference != 0)
        p.p = 0;
    return p;
}

double smallest_effect(double tolerance, double standard_error) {
    return std::max(tolerance + 0.9 * standard_error, 5 * standard_error);
}

}  // namespace ptb
