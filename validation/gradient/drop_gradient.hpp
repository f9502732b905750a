// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a drop's impacts with respect to the numbers of the drop, in the plane or in space as one list.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analytic/plane/gradient.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {

/// A number of an impact whose derivatives are told.
struct GradientNumber {
  const char *name, *heading, *unit, *meaning;
  bool shown;            ///< in tables
  const char* in_lists;  ///< its column in a list of impacts (benchmark); null: none
};
/// In the order of Derivatives.
[[nodiscard]] std::span<const GradientNumber> gradient_numbers(bool in_space);

/// Derivatives of an impact's numbers with respect to one of the drop, with bounds on errors.
struct Derivatives {
  std::vector<double> value, error;

  /// Adds `other` × a factor.
  void add(const Derivatives& other, double factor);
  void scale(double factor);
};

/// A number of the drop: angle, in space tilt, speed, restitution, friction.  Turns are in radians.
struct ParameterGradient {
  std::string name;
  std::vector<Derivatives> impacts{};
  analytic::GradientRefusal refused{};

  /// The derivatives of an impact, from 0; null where there are none.
  [[nodiscard]] const Derivatives* of(std::size_t impact) const {
    return impact < refused.from && impact < impacts.size() ? &impacts[impact] : nullptr;
  }
};

struct DropGradient {
  std::vector<ParameterGradient> parameters;
  std::size_t rows = 0;  ///< impacts that have derivatives
  DiscreteSequence sequence;
};

/// @throws as analytic::sequence_gradient
[[nodiscard]] DropGradient drop_gradient(const DiscreteDrop& drop, int impacts);

/// How far a turn, by its index among the parameters, brings the point that touches down, the centre at rest [m/rad].
[[nodiscard]] double arm_of_turn(const DiscreteDrop& drop, std::size_t turn);

}  // namespace clatter::validation
