#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/compare/verdict.h"
#include "bench/plan/case.h"

namespace ptb {

/// One case of a comparison, as it is shown.
struct Row {
    std::string device, name;
    double tolerance = 0;
    Finding finding;
    std::string advisory;  ///< why the state cannot gate ("single-session"), or empty
    std::string note;      ///< what else there is to say, e.g. why there is no time
    std::optional<double>
        efficiency_ratio{};  ///< new / base; a change of time alone is in it, one of noise too
    bool operator==(const Row&) const = default;
    bool compared() const { return finding.base_ns > 0 && finding.now_ns > 0; }
};

/// What a comparison is held to, beside tolerances.
struct Rules {
    double require_mde = 0;  ///< the smallest effect must not be larger; 0: it may
    bool strict = false;     ///< what is inconclusive or only advisory does not pass
    bool allow_missing = false;
    bool operator==(const Rules&) const = default;
};

/// What the rows come to.
struct Change {
    bool regressed = false, inconclusive = false, coverage_lost = false;
    bool nothing_compared = true;
};
Change change_of(const std::vector<Row>& rows, const Rules& rules);

/// "pt thesis 64x64 spp 4 length 128", then the work-group and the lane width where they were asked for.
std::string case_text(const Case& c);

}  // namespace ptb
