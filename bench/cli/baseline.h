#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/cli/exit_code.h"
#include "bench/cli/options.h"
#include "bench/compare/session.h"

namespace ptb {

/// What a run is compared with, and the name that it is kept under.
class Baseline {
  public:
    /// Reads the baseline of --baseline (a file, a name in --baseline-dir, or one that ships), and makes sure
    /// that the one of --save-baseline can be written. Throws UsageError.
    explicit Baseline(const RunFlags& flags);

    /// Keeps the result and compares it, as asked; adds what changed to `outcome`. The table goes to `out`.
    void conclude(const ResultFile& result, const Config& config, const CommonFlags& common, std::FILE* out,
                  Outcome& outcome) const;

  private:
    std::optional<Session> base_;
    std::filesystem::path save_as_;
};

}  // namespace ptb
