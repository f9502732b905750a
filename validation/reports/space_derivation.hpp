// SPDX-License-Identifier: GPL-3.0-or-later
// How an impact in space came about, as equations with their numbers put in.
#pragma once

#include <string>
#include <vector>

#include "analytic/space/sequence.hpp"
#include "validation/reports/step_writer.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline reports {

/// Impact n of a sequence, counted from 1, and what it was computed from.
struct ImpactInSpace {
  const Scene& scene;
  const analytic::space::Drop& drop;
  const analytic::space::Sequence& sequence;
  int n = 1;

  [[nodiscard]] const analytic::space::ImpactRow& row() const { return rows_at(n); }
  /// The impact before; n > 1.
  [[nodiscard]] const analytic::space::ImpactRow& previous() const { return rows_at(n - 1); }
  /// Names of corners by their indices.
  [[nodiscard]] std::string corner_names(const std::vector<int>& corners) const;
  /// Largest error of the row's numbers, relative to their sizes; infinite where it cannot be predicted.
  [[nodiscard]] double relative_error() const;

 private:
  [[nodiscard]] const analytic::space::ImpactRow& rows_at(int i) const {
    return sequence.rows[static_cast<std::size_t>(i - 1)];
  }
};

/// Steps that lead to an impact that happens: flight, corner, impulse, energy.
[[nodiscard]] std::vector<Step> derive_impact(const Scene& scene, const analytic::space::Drop& drop,
                                              const analytic::space::Sequence& sequence, int n);

/// The flight to the impact: parabola, torque-free rotation, the corner that arrives first.  Needs n > 1.
void write_flight(const ImpactInSpace& impact, StepWriter& writer);
/// The impact of one corner: contact inertia, path of friction in impulse space, restitution.
void write_corner_impact(const ImpactInSpace& impact, StepWriter& writer);
/// The impact of several corners at once, and what small tilts would make of them.
void write_group_impact(const ImpactInSpace& impact, StepWriter& writer);

}  // namespace clatter::validation::inline reports
