// SPDX-License-Identifier: GPL-3.0-or-later
// Runs over ever stiffer grounds: which of their impacts are single, short contacts that all of them have.
#pragma once

#include <string>
#include <vector>

#include "numeric/body.hpp"
#include "numeric/simulate.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Against what contacts are short, and how their ground is damped.
struct ContactSizes {
  const numeric::Body& body;
  double feature = 0;  ///< length below which the contact of a planar run sees the shape that it has in the limit [m]
  double gravity = 0;  ///< [m/s²]
  bool planar = true;
  double damping_per_stiffness = 0;  ///< c_G/k_G, the same for all runs [s/m]

  [[nodiscard]] static ContactSizes of(const Scene& scene, const numeric::Body& body, bool planar);
};

/// The first impacts of a ladder of runs, and why there are no more.
struct CommonRows {
  std::size_t count = 0;
  std::string ended;  ///< one clause; empty: all that were asked for are there
};

/// Rows that all runs have, with the same places and the same course of friction, and whose contacts are single and
/// short in the softest of them.
[[nodiscard]] CommonRows common_rows(const std::vector<numeric::Simulation>& ladder, const ContactSizes& sizes);

/// Whether two places of touch-down (body frame) are the same corner, or end of a smooth shape, on which the place
/// moves with the attitude.
[[nodiscard]] bool is_same_place(const numeric::Body& body, const numeric::Vector3& one, const numeric::Vector3& other);

}  // namespace clatter::validation
