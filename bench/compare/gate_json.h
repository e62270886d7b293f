#pragma once

#include "bench/compare/gate_file.h"
#include "bench/record/json.h"

namespace ptb {

// The mapping of a gate to JSON; see record/json.h.

Json encode(State state);
void decode(const Json& json, const Where& where, State& state);

template <>
inline constexpr auto fields<Interval> = std::make_tuple(required("low", &Interval::low),
                                                         required("high", &Interval::high));
template <>
inline constexpr auto fields<Shift> = std::make_tuple(required("value", &Shift::value),
                                                      field("interval", &Shift::interval));
template <>
inline constexpr auto fields<Evidence> = std::make_tuple(
    required("shift", &Evidence::shift), required("p", &Evidence::p), required("holm_p", &Evidence::holm_p),
    required("standard_error", &Evidence::standard_error));
template <>
inline constexpr auto fields<Finding> = std::make_tuple(required("state", &Finding::state),
                                                        required("evidence", &Finding::evidence),
                                                        field("base_ns", &Finding::base_ns),
                                                        field("new_ns", &Finding::now_ns),
                                                        field("smallest_effect", &Finding::smallest_effect),
                                                        field("n", &Finding::n));
template <>
inline constexpr auto fields<Round> = std::make_tuple(required("kernel_ns", &Round::kernel_ns),
                                                      required("host_ns", &Round::host_ns));
template <>
inline constexpr auto fields<Block> = std::make_tuple(required("rounds", &Block::rounds));
template <>
inline constexpr auto fields<GateCase> = std::make_tuple(
    required("base", &GateCase::base), required("new", &GateCase::now), required("timer", &GateCase::timer),
    required("tolerance", &GateCase::tolerance), field("not_measured", &GateCase::not_measured),
    field("without_times", &GateCase::without_times), required("screen", &GateCase::screen),
    required("confirm", &GateCase::confirm));
template <>
inline constexpr auto fields<GateSide> = std::make_tuple(field("binary", &GateSide::binary),
                                                         field("kernel_dir", &GateSide::kernel_dir),
                                                         field("config", &GateSide::config));
template <>
inline constexpr auto fields<Rules> = std::make_tuple(field("require_mde", &Rules::require_mde),
                                                      field("strict", &Rules::strict),
                                                      field("allow_missing", &Rules::allow_missing));
template <>
inline constexpr auto fields<GateFile> = std::make_tuple(
    required("run", &GateFile::run), required("host", &GateFile::host),
    required("devices", &GateFile::devices), field("base", &GateFile::base), field("new", &GateFile::now),
    field("shuffle_seed", &GateFile::shuffle_seed), field("rules", &GateFile::rules),
    required("cases", &GateFile::cases), required("base_records", &GateFile::base_records),
    required("new_records", &GateFile::now_records), required("findings", &GateFile::findings));

}  // namespace ptb
