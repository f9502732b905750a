// SPDX-License-Identifier: GPL-3.0-or-later
// How many impacts happen, over a parameter of the rod, as a picture.
#pragma once

#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/figures/picture.hpp"

namespace clatter::validation::inline reports {

/// One value of the parameter.
struct Regimes {
  double value;
  analytic::RegimeBoundary second, third;
};

struct RegimesAxis {
  std::string name, words;  ///< in JSON; for readers
  bool logarithmic;         ///< a value that is not positive is then left out, and the axis says so
};

/// θ₂ and θ₃ over the parameter, and the areas of one, two and three impacts.
[[nodiscard]] Picture regimes_picture(const std::vector<Regimes>& all, const RegimesAxis& axis, const std::string& rod);

}  // namespace clatter::validation::inline reports
