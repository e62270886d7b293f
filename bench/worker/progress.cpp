#include "bench/worker/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <sys/ioctl.h>

#include "bench/record/status.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

std::string headline(std::size_t number, std::size_t total, const Case& c) {
    const std::string several = of_several_devices(c);
    return fmt::format("[{}/{}] {}  {} spp {} {}{}{}", number, total, c.device, c.kernel, c.spp,
                       to_string(c.work_group), several.empty() ? "" : " ", several);
}

/// " +- 0.4 %", half the width of the median's interval, or nothing when there is none.
std::string spread_text(const Statistics& statistics) {
    if (!statistics.ci_low_ns || !statistics.ci_high_ns || statistics.median_ns <= 0) return {};
    const double half = (*statistics.ci_high_ns - *statistics.ci_low_ns) / 2;
    return fmt::format(" +- {:.1f} %", 100 * half / statistics.median_ns);
}

std::string outcome_text(const Record& record) {
    const bool timed =
        record.statistics && (record.status == Status::ok || record.status == Status::unstable);
    const std::string status =
        record.reason.empty() ? to_string(record.status) : to_string(record.status) + ": " + record.reason;
    if (!timed) return status;
    const std::string time = time_text(record.statistics->median_ns) + spread_text(*record.statistics);
    return record.status == Status::ok ? time : time + "  " + status;
}

}  // namespace

std::size_t columns_of(std::FILE* out) {
    winsize size{};
    const bool known = ::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

std::string eta_text(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::max(seconds, 0.0)));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string time_text(double ns) {
    constexpr std::array<const char*, 4> units{"ns", "us", "ms", "s"};
    std::size_t unit = 0;
    while (unit + 1 < units.size() && ns >= 999.5) {
        ns /= 1000;
        ++unit;
    }
    const int decimals = ns < 9.995 ? 2 : ns < 99.95 ? 1 : 0;
    return fmt::format("{:.{}f} {}", ns, decimals, units[unit]);
}

std::string live_line(const ProgressView& view, std::size_t columns) {
    std::string line = headline(view.number, view.total, view.params);
    if (!view.stage.empty()) line += fmt::format("   {} {:.0f} %", view.stage, 100 * view.done);
    if (view.eta_s) line += fmt::format("   ETA {}", eta_text(*view.eta_s));
    return shortened(line, columns);
}

std::string finished_line(std::size_t number, std::size_t total, const Record& record) {
    return headline(number, total, record.params) + "   " + outcome_text(record);
}

std::string coloured(const std::string& line, Status status) {
    const bool harmless = status == Status::ok || status == Status::skipped || status == Status::unsupported;
    return harmless ? line : "\033[31m" + line + "\033[0m";
}

Eta::Eta(const std::vector<Case>& cases, const Forecast& forecast) {
    for (const Case& c : cases) predicted_s_.push_back(forecast.case_s(c).value_or(0));
}

void Eta::finished(std::size_t index, double actual_s) {
    overhead_s_ += std::max(0.0, actual_s - predicted_s_.at(index));
    ++finished_;
}

double Eta::left_s(std::size_t next) const {
    const auto first = predicted_s_.begin() + static_cast<std::ptrdiff_t>(next);
    const double predicted_s = std::accumulate(first, predicted_s_.end(), 0.0);
    const double mean_overhead_s = finished_ == 0 ? 0 : overhead_s_ / static_cast<double>(finished_);
    return predicted_s + mean_overhead_s * static_cast<double>(predicted_s_.end() - first);
}

ProgressPrinter::ProgressPrinter(std::FILE* out, ProgressStyle style, const RunPlan& plan,
                                 const Forecast& forecast, bool colour, SecondsNow now_s)
    : out_(out),
      style_(style),
      colour_(colour),
      total_(plan.cases.size()),
      eta_(plan.cases, forecast),
      budget_s_(plan.max_total_time_s),
      now_s_(std::move(now_s)),
      run_start_s_(now_s_()),
      case_start_s_(run_start_s_) {}

void ProgressPrinter::started(std::size_t index, const Case& c) {
    case_start_s_ = now_s_();
    show({index + 1, total_, c, {}, 0, eta_s(index)});
}

void ProgressPrinter::progressed(std::size_t index, const Case& c, const Response& response) {
    show({index + 1, total_, c, response.stage, response.done, eta_s(index)});
}

void ProgressPrinter::finished(std::size_t index, const Record& record) {
    if (record.status != Status::skipped) eta_.finished(index, now_s_() - case_start_s_);
    if (style_ == ProgressStyle::silent) return;
    const std::string line = finished_line(index + 1, total_, record);
    write((style_ == ProgressStyle::live ? "\r\033[K" : "") +
          (colour_ ? coloured(line, record.status) : line) + "\n");
}

double ProgressPrinter::eta_s(std::size_t index) const {
    const double left_s = eta_.left_s(index) - (now_s_() - case_start_s_);
    if (budget_s_ <= 0) return left_s;
    return std::min(left_s, budget_s_ - (now_s_() - run_start_s_));
}

void ProgressPrinter::show(const ProgressView& view) {
    if (style_ != ProgressStyle::live) return;
    write(fmt::format("\r{}\033[K", live_line(view, columns_of(out_) - 1)));
}

/// Never throws: a run goes on when nobody reads its progress any more.
void ProgressPrinter::write(const std::string& text) {
    std::fputs(text.c_str(), out_);
    std::fflush(out_);
}

}  // namespace ptb
