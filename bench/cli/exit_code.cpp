#include "bench/cli/exit_code.h"

namespace ptb {

namespace {

Outcome outcome_of(Status status) {
    switch (status) {
        case Status::crash:
        case Status::timeout:
        case Status::runtime:
        case Status::compile:
            return {.failed = true};
        case Status::invalid:
            return {.wrong_image = true};
        case Status::ok:
        case Status::unsupported:
        case Status::skipped:
        case Status::unstable:
            break;
    }
    return {};
}

}  // namespace

Outcome& Outcome::operator|=(const Outcome& other) {
    for (const auto reason :
         {&Outcome::interrupted, &Outcome::no_device, &Outcome::failed, &Outcome::wrong_image,
          &Outcome::not_comparable, &Outcome::coverage_lost, &Outcome::regressed, &Outcome::inconclusive})
        this->*reason |= other.*reason;
    return *this;
}

Outcome outcome_of(const std::vector<Record>& records) {
    Outcome outcome;
    for (const Record& record : records) outcome |= outcome_of(record.status);
    return outcome;
}

int exit_code(const Outcome& outcome) {
    if (outcome.interrupted) return exit_codes::interrupted;
    if (outcome.no_device) return exit_codes::no_device;
    if (outcome.failed) return exit_codes::failed;
    if (outcome.wrong_image) return exit_codes::wrong_image;
    if (outcome.not_comparable) return exit_codes::not_comparable;
    if (outcome.coverage_lost) return exit_codes::coverage_lost;
    if (outcome.regressed) return exit_codes::regressed;
    if (outcome.inconclusive) return exit_codes::inconclusive;
    return exit_codes::done;
}

}  // namespace ptb
