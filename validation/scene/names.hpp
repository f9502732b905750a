// SPDX-License-Identifier: GPL-3.0-or-later
// Names that the models' results have in tables, JSON and CSV.
#pragma once

#include "analytic/plane/sequence.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "numeric/simulate.hpp"

namespace clatter::validation {

[[nodiscard]] const char* mode_name(analytic::ImpactMode mode);
[[nodiscard]] const char* mode_name(analytic::space::PathKind path);
[[nodiscard]] const char* mode_name(numeric::FrictionMode mode);
[[nodiscard]] const char* outcome_name(analytic::Outcome outcome);
[[nodiscard]] const char* outcome_name(numeric::Outcome outcome);
/// Of a body that goes on along the ground, how: "slides-on".
[[nodiscard]] const char* outcome_name(const numeric::Simulation& run);
/// Whether rows may be missing because a number could not be computed or a limit on the work was reached, not because
/// of what the body does or how many impacts were asked for.  Exit status 3 then.
[[nodiscard]] bool is_cut_short(analytic::Outcome outcome);
[[nodiscard]] bool is_cut_short(numeric::Outcome outcome);
[[nodiscard]] const char* end_name(numeric::ContactEnd end);

/// A restitution law in words; all that this program says of it, but for its formulas in `explain`.
struct RestitutionWords {
  const char* name;         ///< in scene files, flags and JSON
  const char* coefficient;  ///< "Newton's coefficient of restitution"; empty: it takes none
  const char* ends;         ///< when an impact is over, a sentence
};
[[nodiscard]] const RestitutionWords& words_of(analytic::RestitutionLaw law);

}  // namespace clatter::validation
