#pragma once

#include <vector>

namespace ptb {

/// Draws one of n things with one number: of column i, the fraction `probability[i]` is i's own, the rest
/// `alias[i]`'s. See "A Linear Algorithm for Generating Random Numbers with a Given Distribution", by Vose.
struct AliasTable {
    std::vector<double> probability;
    std::vector<int> alias;
    std::vector<double> pdf;  ///< of each, their sum is 1
};

/// In proportion to `weights`, which are finite and not negative; empty where all of them are zero.
AliasTable make_alias_table(const std::vector<double>& weights);

}  // namespace ptb
