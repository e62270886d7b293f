#include "bench/report/formats/passed.h"

#include <fmt/format.h>

#include "bench/compare/row.h"
#include "bench/compare/session.h"
#include "bench/report/words.h"
#include "core/input/printable.h"

namespace ptb {

std::string passed_name(const ResultFile& result, const Record& record) {
    return printable(
        fmt::format("{}: {}", device_label(result, record.params.device), case_text(record.params)));
}

std::optional<Noise> Passed::noise() const {
    const auto& e = record.efficiency;
    return e && e->all && e->all->efficiency ? e->all : std::nullopt;
}

std::vector<Passed> passed(const ResultFile& result) {
    const Session session = session_of(result, "");
    std::vector<Passed> all;
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
        const Record& record = result.cases[i];
        if (!timed(record) || session.cases[i].times_ns.empty()) continue;
        all.push_back({record, passed_name(result, record), session.cases[i].times_ns});
    }
    return all;
}

}  // namespace ptb
