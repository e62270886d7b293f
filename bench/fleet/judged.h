#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/fleet/confirm.h"

namespace ptb {

/// What is found of one class of equal devices.
struct JudgedClass {
    DeviceClass of;
    Screened screened;
    std::vector<std::size_t> controls;  ///< places in its cards: beside whom candidates are to be confirmed
    std::vector<WrongBits> wrong;
    std::vector<Drift> drift;
};

/// Candidates and controls of a fleet, in sessions of their own. Of other candidates it is another one.
struct Confirmation {
    std::string id;                  ///< empty: nobody is to be confirmed
    std::vector<std::size_t> cards;  ///< of Fleet::cards: candidates and controls, sorted
};

/// A slow card, or one that may be.
struct Suspect {
    std::size_t card = 0;
    double deviation = 0;                ///< of log time, as screened
    int sessions = 0;                    ///< that it was confirmed in, so far
    std::optional<Confirmed> confirmed;  ///< once all are there, also of its controls
};

/// A fleet, and what is to be said of it.
struct Judged {
    Fleet fleet;
    std::vector<JudgedClass> classes;
    Confirmation confirmation;
    std::vector<Suspect> suspects;           ///< the slowest first
    int sessions = 0, sessions_to_come = 0;  ///< of the confirmation
    std::map<std::size_t, Status> failed;    ///< cards with cases that failed or have a wrong image, and how
    std::vector<std::string> missing;        ///< nodes that never came, were refused or have not finished

    bool is_slow(std::size_t card) const;
};

/// Judges a fleet, with what there is of its confirmation. Throws UsageError.
Judged judged(const FleetFolder& folder, Fleet fleet);

/// The file of one session of a card, as a journal of its own.
std::filesystem::path session_file(const FleetFolder& folder, const Confirmation& confirmation,
                                   const Card& card, int session);

}  // namespace ptb
