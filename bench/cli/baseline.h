#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/cli/exit_code.h"
#include "bench/cli/options.h"
#include "bench/compare/sessions.h"

namespace ptb {

/// What a run is compared with, and the name that it is kept under.
class Baseline {
  public:
    /// Reads the baseline of --baseline (a file, a name in --baseline-dir, or one that ships), and makes sure
    /// that the one of --save-baseline can be written. Throws UsageError.
    explicit Baseline(const RunFlags& flags);

    /// Compares the result, unless it was interrupted, and notes the verdict in it.
    void judge(ResultFile& result, const Config& config);

    /// Keeps the result, shows the comparison on `out` and adds what changed to `outcome`, as asked.
    void conclude(const ResultFile& result, const CommonFlags& common, std::FILE* out,
                  Outcome& outcome) const;

  private:
    std::optional<Session> base_;
    std::optional<Comparison> comparison_;
    std::filesystem::path save_as_;
};

}  // namespace ptb
