// SPDX-License-Identifier: GPL-3.0-or-later
// Which blow of a drop is the worst for a probe, and what a report says of it in a sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/run/run.hpp"
#include "validation/scene/scene.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {

/// What a part answers with where it has this margin [g].
[[nodiscard]] double response_in_g(const FragilePart& part, double margin);

/// By what the blows of a drop, and so drops, are ranked.
struct Ranking {
  enum class By { margin, response, peak, velocity };
  By by = By::peak;
  std::size_t probe = 0;
  /// Blows that follow a bounce are left out: on a ground without loss they stay as hard for ever.
  bool landing_alone = false;
  std::optional<FragilePart> part{};
  bool has_peaks = true;  ///< of the continuous model

  /// A margin, or what a part without a limit answers with [g], a peak [g] or change of velocity [m/s] at the probe.
  [[nodiscard]] double value_of(const ShockRow& row) const;
  [[nodiscard]] bool is_worse(double one, double other) const { return by == By::margin ? one < other : one > other; }
};

/// Whether a contact of the model gives back all that it takes: e = 1.
[[nodiscard]] bool is_lossless(const Scene& scene, Model model);

/// What one impact does to a probe.
struct Blow {
  int impact = 0;  ///< from 1
  bool predictable = true;
  double peak_g = 0;    ///< [g]; 0: the discrete model's
  double velocity = 0;  ///< |ΔV| [m/s]
  double peak_g_error = 0, velocity_error = 0, margin_error = 0;
  double width = 0;  ///< above a tenth of the peak [s]
  double value = 0;  ///< that it is ranked by
  std::optional<BlowMargin> margin{};
  std::optional<double> response_g{};  ///< of a part without a limit, in place of its margin
  std::optional<double> depth{};       ///< of the deepest point [m]
};
/// The worst of a drop's blows; none: nothing struck.
/// @param run  that the rows are of
[[nodiscard]] std::optional<Blow> worst_blow(const std::vector<ShockRow>& rows, const Run& run, const Scene& scene,
                                             const Ranking& ranking);

/// "delta_v", "peak" or "history", which tables call "|ΔV|", "peak" and "humps".
[[nodiscard]] Cell deciding_cell(BlowMargin::By by);

/// How long the half sine of a blow's peak and change of velocity is, in a table of blows.
[[nodiscard]] Column pulse_column();

/// Three digits, as one says them: 39000, not 39027.
[[nodiscard]] std::string said(double value, int digits = 3);
/// The number with all its digits, of which a reader sees three, or as few as its error leaves, "?" where it leaves
/// none.
[[nodiscard]] Cell said_cell(double value, double error = 0);
/// "camera takes 2660 g in impact 1, 7.52 m/s, as a half sine of 0.45 ms does; the part of 500 Hz answers with ...".
[[nodiscard]] std::string blow_words(const Blow& blow, const std::string& probe, const Ranking& ranking);
/// "19.5 mm deep, 244 % of the pad": empty without a pad.
[[nodiscard]] std::string depth_words(const Scene& scene, double depth);
/// What of the ground and the body was assumed, and is decisive: a ground without loss, a material that nobody named, a
/// restitution that the model leaves alone.
/// @param blow  the worst
[[nodiscard]] std::vector<std::string> assumed_words(const Scene& scene, Model model, const Blow& blow);

}  // namespace clatter::validation
