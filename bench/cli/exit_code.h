#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// Exit codes, the same for every command.
namespace exit_codes {
inline constexpr int done = 0;
inline constexpr int failed = 1;  ///< internal error, or a case that crashed, hung, or did not build or run
inline constexpr int usage = 2;
inline constexpr int regressed = 3;
inline constexpr int wrong_image = 4;
inline constexpr int inconclusive = 5;
inline constexpr int coverage_lost = 6;
inline constexpr int not_comparable = 7;
inline constexpr int no_device = 77;  ///< the skip code of CTest and automake
inline constexpr int interrupted = 130;
}  // namespace exit_codes

struct ExitCodeMeaning {
    int code;
    std::string_view meaning;
};
inline constexpr std::array exit_code_meanings{
    ExitCodeMeaning{exit_codes::done, "done"},
    ExitCodeMeaning{exit_codes::failed, "a case failed"},
    ExitCodeMeaning{exit_codes::usage, "usage"},
    ExitCodeMeaning{exit_codes::regressed, "regressed"},
    ExitCodeMeaning{exit_codes::wrong_image, "a wrong image"},
    ExitCodeMeaning{exit_codes::inconclusive, "inconclusive"},
    ExitCodeMeaning{exit_codes::coverage_lost, "coverage lost"},
    ExitCodeMeaning{exit_codes::not_comparable, "not comparable"},
    ExitCodeMeaning{exit_codes::no_device, "no OpenCL device"},
    ExitCodeMeaning{exit_codes::interrupted, "interrupted"},
};

/// What a finished run is judged by.
struct Outcome {
    bool interrupted = false, no_device = false;
    bool failed = false, wrong_image = false, not_comparable = false, coverage_lost = false,
         regressed = false, inconclusive = false;
    /// Adds the other's reasons; how often a reason comes does not count.
    Outcome& operator|=(const Outcome& other);
    bool operator==(const Outcome&) const = default;
};

Outcome outcome_of(const std::vector<Record>& records);

/// Interruption and a missing device end a run by themselves; among the rest 1 > 4 > 7 > 6 > 3 > 5.
int exit_code(const Outcome& outcome);

}  // namespace ptb
