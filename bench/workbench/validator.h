#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bench/validate/passes.h"
#include "bench/workbench/pace.h"
#include "bench/workbench/stage.h"
#include "core/oracle/reference.h"

namespace ptb {

/// Decides whether the kernels of one device are right, once for all cases that give the same image.
class Validator {
  public:
    /// `references`: the folder of stored ones. `seed`: of the runs.
    Validator(Builds& builds, Pace& pace, std::filesystem::path references, std::uint64_t seed);

    /// What a job's kernel is worth, by a render of its own. Throws what goes wrong in it.
    const Validation& verdict(const CaseJob& job, const Stage& stage);

    /// The timed render's own picture must pass what any picture of this work must.
    void check_timed_film(const CaseJob& job, const Film& film, Validation& validation) const;

    /// The stored truth of a job's image, if there is one.
    std::optional<Reference> stored_reference(const CaseJob& job) const;

  private:
    Validation judged(const CaseJob& plain, const Stage& stage);
    Validation judged_by_rays(CaseJob job, const Stage& stage);
    Film rendered(const CaseJob& plain, CaseJob& job, const Stage& stage);
    Validation judged_by(const std::optional<Reference>& stored, const CaseJob& job, const Film& film) const;
    const Passes* passes_of(const CaseJob& job) const;

    Builds& builds_;
    Pace& pace_;
    std::filesystem::path references_;
    std::uint64_t seed_;
    std::map<std::string, Validation> verdicts_;  ///< by `CaseJob::key` of plain jobs
    std::map<std::string, Passes> passes_;        ///< likewise, of kernels whose pixels share paths
};

}  // namespace ptb
