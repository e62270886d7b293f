#pragma once

#include <string>
#include <vector>

#include "bench/fleet/judged.h"
#include "bench/report/grid.h"

namespace ptb {

/// A fleet on one screen: classes of equal devices, the devices to look at, and what to do. `folder` as the
/// user would name it in a command.
std::vector<Section> fleet_sections(const Judged& judged, const std::string& folder);

std::string fleet_text(const Judged& judged, const std::string& folder, const TextStyle& style);
std::string fleet_markdown(const Judged& judged, const std::string& folder);

/// A line for each card (RFC 4180).
std::string fleet_csv(const Judged& judged);

/// The page: a strip chart a class, a dot a card, and a table of all cards.
std::string fleet_page(const Judged& judged, const std::string& folder);

/// All cards in the order of nodes; what each is found to be stands in the last column.
Section cards_section(const Judged& judged);

/// "slow", "wrong image", "suspect", "ok", ...; of the card with this number.
std::string finding_text(const Judged& judged, std::size_t card);

/// "+3.2 %" of a difference of log times; "-" where there is none.
std::string slower_text(double log_ratio);

/// "1410 MHz, 81 C, 690 W, held back by power cap", or nothing.
std::string state_text(const Card& card);

}  // namespace ptb
