// SPDX-License-Identifier: GPL-3.0-or-later
// One page to hand in: what was dropped, what happened, what a part inside feels, and how far to trust it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

struct HandoutPart {
  std::string title;
  std::string html;
};

/// A page with all that it shows in itself: it asks for nothing from anywhere, and prints.
[[nodiscard]] std::string handout_page(const std::string& title, const std::vector<std::string>& lines,
                                       const std::vector<HandoutPart>& parts);

// Pieces of parts.

/// The table of a report with its notes, without its head.
[[nodiscard]] std::string handout_table(Report report);
[[nodiscard]] std::string handout_list(const std::vector<std::string>& items);
/// Commands, each on a line of its own.
[[nodiscard]] std::string handout_commands(const std::vector<std::string>& commands);
/// Drawn by gnuplot, as SVG in the page.  @throws as run_gnuplot
[[nodiscard]] std::string handout_picture(const Picture& picture, const std::string& caption);

/// Size of the specific force at the probes over time: the first two impacts, then each of the first three in a panel
/// of its own, from its touch-down on; none without a contact.
[[nodiscard]] std::optional<Picture> probe_history_picture(const ShockRun& run);

}  // namespace clatter::validation
