// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of the thin rod whose contact angles are asked for, as flags give them.
#pragma once

#include <optional>
#include <string>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/argument.hpp"

namespace clatter::validation {

// Values of a swept quantity: from, to, and a step or a count.

/// What is asked of a swept quantity.
struct RangeRequest {
  std::optional<double> from, to, step;
  std::optional<int> count;
};
/// @param what  the quantity, in words
[[nodiscard]] Arguments range_arguments(RangeRequest& request, const std::string& what);

struct Sweep {
  double from = 0;
  double to = 0;
  long long count = 0;
  double step = 0;  ///< 0: equal parts of [from, to]
  bool logarithmic = false;
  /// Value i.  With a step, from + i·step is rounded to 15 digits, so that steps that are decimal
  /// fractions give clean decimals; with a count, the last value is `to` exactly.
  [[nodiscard]] double value(long long i) const;
};
struct SweepDefault {
  double from, to, step;
};
/// @throws BadInput where an end lies outside `allowed`, or step and count are both given
[[nodiscard]] Sweep sweep_of(const RangeRequest& request, const SweepDefault& fallback, const Range& allowed);

struct RodRequest {
  std::optional<double> gravity_number;
  std::optional<double> gravity;  ///< [m/s²], with the next two in place of the gravity number
  double length = 1, speed = 1;   ///< [m], [m/s]
  double restitution = 1, impulse_ratio = 0;
};
[[nodiscard]] Arguments rod_arguments(RodRequest& request);
/// @throws BadInput where gravity is given twice, or the gravity number overflows
[[nodiscard]] analytic::RodParameters rod_parameters(const RodRequest& request);
/// The parameters under their names in JSON.
[[nodiscard]] Value rod_fields(const analytic::RodParameters& parameters);
/// "thin rod, m = L = |vₙ| = 1, G = …, e = …, μᵢ = …"; of a gravity in m/s² with what G comes from.
[[nodiscard]] std::string rod_summary(const RodRequest& request);
/// Where an impulse ratio pushes along the slip of impact 1, as no friction does; empty: no ratio.
[[nodiscard]] std::string ratio_warning(const analytic::RodParameters& parameters);

}  // namespace clatter::validation
