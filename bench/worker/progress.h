#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "bench/worker/coordinator.h"

namespace ptb {

/// What the live line shows.
struct ProgressView {
    std::size_t number = 1, total = 1;  ///< this case, counted from 1
    Case params;
    std::string stage;  ///< "build", "validate", "warmup", "sample", or empty
    double done = 0;    ///< share of the stage
    std::optional<double> eta_s;
};

/// Of the terminal that `out` is, or 80.
std::size_t columns_of(std::FILE* out);

/// "[17/48] pocl:0  pt spp 100 16x16   sample 40 %   ETA 1:10", cut to `columns`.
std::string live_line(const ProgressView& view, std::size_t columns);

/// "[17/48] pocl:0  pt spp 100 16x16   412 ms +- 0.4 %", or the status and the reason.
std::string finished_line(std::size_t number, std::size_t total, const Record& record);

/// "1:10", "2:05:00"
std::string eta_text(double seconds);

/// "41.2 ms": three digits and a unit.
std::string time_text(double ns);

/// How long the rest of a plan takes: the forecast, plus what finished cases took beyond theirs on average
/// (builds, validation).
class Eta {
  public:
    Eta(const std::vector<Case>& cases, const Forecast& forecast);
    void finished(std::size_t index, double actual_s);
    double left_s(std::size_t next) const;

  private:
    std::vector<double> predicted_s_;
    double overhead_s_ = 0;
    std::size_t finished_ = 0;
};

enum class ProgressStyle { silent, lines, live };

/// `line` in red when the case failed.
std::string coloured(const std::string& line, Status status);

/// Writes progress to a stream: one line kept up to date on a terminal, else a line for each finished case.
class ProgressPrinter : public RunObserver {
  public:
    ProgressPrinter(std::FILE* out, ProgressStyle style, const RunPlan& plan, const Forecast& forecast,
                    bool colour = false, SecondsNow now_s = steady_seconds);
    void started(std::size_t index, const Case& c) override;
    void progressed(std::size_t index, const Case& c, const Response& response) override;
    void finished(std::size_t index, const Record& record) override;

  private:
    void show(const ProgressView& view);
    void write(const std::string& text);
    double eta_s(std::size_t index) const;

    std::FILE* out_;
    ProgressStyle style_;
    bool colour_;
    std::size_t total_;
    Eta eta_;
    double budget_s_;
    SecondsNow now_s_;
    double run_start_s_, case_start_s_;
};

}  // namespace ptb
