#include <fmt/format.h>

#include "bench/compare/row.h"
#include "bench/record/status.h"
#include "bench/report/formats/formats.h"
#include "bench/report/html/html.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// A wrong image or an unstable time fails, what broke is an error, what was not tried is skipped.
std::string kind_of(Status status) {
    switch (status) {
        case Status::ok:
            return "";
        case Status::invalid:
        case Status::unstable:
            return "failure";
        case Status::unsupported:
        case Status::skipped:
            return "skipped";
        default:
            return "error";
    }
}

double seconds(const Record& record) { return timed(record) ? record.statistics->median_ns / 1e9 : 0; }

std::string outcome(const Record& record) {
    const std::string kind = kind_of(record.status);
    if (kind.empty()) return "";
    const std::string log = record.build ? record.build->log : "";
    return fmt::format("<{0} type=\"{1}\" message=\"{2}\">{3}</{0}>", kind, to_string(record.status),
                       html_text(record.reason), html_text(log));
}

std::string test_case(const ResultFile& result, const Record& record) {
    return fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.9f}\">{}</testcase>\n",
                       html_text(device_label(result, record.params.device)),
                       html_text(case_text(record.params)), seconds(record), outcome(record));
}

std::size_t count(const ResultFile& result, const std::string& kind) {
    std::size_t n = 0;
    for (const Record& record : result.cases) n += kind_of(record.status) == kind ? 1 : 0;
    return n;
}

}  // namespace

std::string junit(const ResultFile& result) {
    std::string cases;
    for (const Record& record : result.cases) cases += test_case(result, record);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"ptbench {}\" timestamp=\"{}\" hostname=\"{}\" tests=\"{}\" failures=\"{}\" "
        "errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n</testsuites>\n",
        html_text(result.run.config), html_text(result.run.started_at), html_text(result.host.hostname),
        result.cases.size(), count(result, "failure"), count(result, "error"), count(result, "skipped"),
        result.run.wall_s, cases);
}

}  // namespace ptb
