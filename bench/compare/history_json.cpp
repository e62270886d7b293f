#include "bench/compare/gate_json.h"
#include "bench/compare/history.h"

namespace ptb {

template <>
inline constexpr auto fields<HistoryRun> = std::make_tuple(field("file", &HistoryRun::file),
                                                           field("started_at", &HistoryRun::started_at),
                                                           field("revision", &HistoryRun::revision));
template <>
inline constexpr auto fields<HistoryPoint> = std::make_tuple(
    field("run", &HistoryPoint::run), field("median_ns", &HistoryPoint::median_ns),
    field("interval_ns", &HistoryPoint::interval_ns), field("kernel_hash", &HistoryPoint::kernel_hash));
template <>
inline constexpr auto fields<Step> = std::make_tuple(field("at", &Step::at), field("shift", &Step::shift),
                                                     field("p", &Step::p),
                                                     field("suspected", &Step::suspected));
template <>
inline constexpr auto fields<HistoryLine> = std::make_tuple(field("device", &HistoryLine::device),
                                                            field("case", &HistoryLine::name),
                                                            field("where", &HistoryLine::where),
                                                            field("tolerance", &HistoryLine::tolerance),
                                                            field("points", &HistoryLine::points),
                                                            field("steps", &HistoryLine::steps));
template <>
inline constexpr auto fields<LeftOut> = std::make_tuple(field("file", &LeftOut::file),
                                                        field("why", &LeftOut::why));

std::string history_text(const History& history) {
    Json json = Json::object();
    json["schema"] = "ptbench.history.v1";
    json["runs"] = encode(history.runs);
    json["lines"] = encode(history.lines);
    json["apart"] = history.apart;
    json["left_out"] = encode(history.left_out);
    return dump_json(json, 2) + "\n";
}

}  // namespace ptb
