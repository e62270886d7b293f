#include "core/scene/alias_table.h"

#include <cstddef>
#include <numeric>

namespace ptb {
namespace {

/// Gives what column `poor` lacks to `rich`, of whose weight it is taken.
void fill_column(AliasTable& table, std::vector<double>& heights, int poor, int rich) {
    const auto p = static_cast<std::size_t>(poor), r = static_cast<std::size_t>(rich);
    table.probability[p] = heights[p];
    table.alias[p] = rich;
    heights[r] = (heights[r] + heights[p]) - 1;
}

int take(std::vector<int>& from) {
    const int last = from.back();
    from.pop_back();
    return last;
}

/// Every column full of itself, as the last ones stay, which rounding leaves a little short.
AliasTable full_columns(const std::vector<double>& weights, double total) {
    AliasTable table;
    table.probability.assign(weights.size(), 1);
    table.alias.resize(weights.size());
    std::iota(table.alias.begin(), table.alias.end(), 0);
    for (const double weight : weights) table.pdf.push_back(weight / total);
    return table;
}

}  // namespace

AliasTable make_alias_table(const std::vector<double>& weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (total <= 0) return {};
    AliasTable table = full_columns(weights, total);
    std::vector<double> heights;  // 1 fills a column
    std::vector<int> low, high;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        heights.push_back(table.pdf[i] * static_cast<double>(weights.size()));
        (heights[i] < 1 ? low : high).push_back(static_cast<int>(i));
    }
    while (!low.empty() && !high.empty()) {
        const int rich = high.back();
        fill_column(table, heights, take(low), rich);
        if (heights[static_cast<std::size_t>(rich)] < 1) low.push_back(take(high));
    }
    return table;
}

}  // namespace ptb
