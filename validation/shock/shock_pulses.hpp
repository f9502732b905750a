// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter shock` says of blows as test pulses, and beside the damage boundary of a part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_run.hpp"

namespace clatter::validation {

/// What one blow does to one point.
struct Pulse {
  std::string probe;
  int impact = 0;            ///< from 1
  Estimated velocity, peak;  ///< |ΔV| [m/s] and largest specific force [m/s²]
  double restitution = 0;    ///< of the impact; not finite where it is not known
  bool predictable = true;
  const ShockRow* row = nullptr;     ///< that it is of; null: of a record
  std::string model = "continuous";  ///< or "measured"
};
/// By the continuous model, in the order of probes.
[[nodiscard]] std::vector<Pulse> pulses_of(const ShockRun& run);

/// The mildest service condition that covers a blow; "?" with no value where its size is not known.
[[nodiscard]] Cell condition_cell(const Estimated& velocity, const Estimated& peak);
/// As measured_cell(), "?" with no value where nothing is known: what follows from a clipped peak is no number.
[[nodiscard]] Cell known_or_empty(const Estimated& number, int digits);

/// A row for each pulse and part.
[[nodiscard]] std::vector<Column> pulse_columns();
/// The margins are empty without a part.
[[nodiscard]] Grid pulse_grid(const std::vector<Pulse>& pulses, int digits, const std::vector<FragilePart>& parts);
/// The service conditions, the damage boundary of each part, and where the parts are of which nobody said it.
/// @param filter  of the peaks that are held against them
[[nodiscard]] std::vector<std::string> pulse_notes(const std::vector<FragilePart>& parts,
                                                   const std::vector<Probe>& probes,
                                                   const std::optional<LowPass>& filter);
/// Whether the part survives, with the least margin of all, and in which row of the grid; empty without a margin.
[[nodiscard]] std::string least_margin_words(const Grid& grid, const std::vector<FragilePart>& parts);
/// `rows` of the grid, service conditions, damage boundary: of several parts a list of them.
[[nodiscard]] Value pulse_fields(const Grid& grid, const std::vector<FragilePart>& parts);
/// The damage boundary of a part, for both pulses, and where the blows lie; none without a blow.
[[nodiscard]] std::optional<PicturePanel> boundary_panel(const std::vector<Pulse>& pulses, const FragilePart& part);

}  // namespace clatter::validation
