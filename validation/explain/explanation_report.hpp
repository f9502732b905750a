// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter explain` says: an explanation as text, Markdown, LaTeX, CSV and JSON, each written from its structure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/explain/formula.hpp"
#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// How an impact came about: from a scene, its drop and the impact's number to steps of formulas with their numbers.

/// The factors by which impact n differs from the one before, of P_n = m_e (1 + e) u.
struct Factors {
  double normal_impulse = 0;        ///< of P_n
  double approach_speed = 0;        ///< of u, the contact's normal velocity before
  double effective_mass = 0;        ///< of m_e, P_n over the change of that velocity
  double one_plus_restitution = 0;  ///< of 1 + e, e: separation over approach
};

/// How impact n of a scene came about, in the plane or in space.
struct Explanation {
  Scene scene;
  int impact = 1;
  double approach_speed = 0;  ///< of the first contact [m/s]
  std::vector<Step> steps;
  std::optional<Factors> beside_last{};  ///< where impact n and the one before strike with one point each
  std::vector<std::string> warnings;
  std::string shortfall;     ///< as of the sequence up to this impact
  int shortfall_status = 0;  ///< exit status that goes with it
};

/// Steps that lead to impact n of the drop (n >= 1), or to the reason why it does not happen.  The numbers are those of
/// its sequence.
/// @throws as analytic::impact_sequence and analytic::space::impact_sequence
[[nodiscard]] Explanation explain_impact(const PreparedScene& prepared, int n);

/// A row for each equation, of a vector or matrix for each component.  In JSON `symbolic` and `numeric` of an equation
/// are text, `tex` is lines of an aligned environment; the value of a vector is a list of its components, of a matrix a
/// list of its rows.
[[nodiscard]] Report explanation_report(const Explanation& explanation);
/// In any format: tables, Markdown and LaTeX have the steps as text with equations.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const TextStyle& style);

}  // namespace clatter::validation
