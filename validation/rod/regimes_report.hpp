// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter angles --regimes` says, in words and as a picture: how many impacts happen, over a parameter of the
// rod.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/rod/rod_parameters.hpp"

namespace clatter::validation {

/// What is asked for.
struct RegimesRequest {
  std::size_t over = 0;  ///< the quantity that varies: gravity number, restitution, impulse ratio
  RangeRequest range;
  bool logarithmic = false;
  RodRequest rod;
  int digits = 8;
};
[[nodiscard]] Arguments regimes_arguments(RegimesRequest& request);

/// One value of the parameter.
struct Regimes {
  double value;
  analytic::RegimeBoundary second, third;
};

/// The regimes over the values of a quantity.
struct FoundRegimes {
  const char* name = "";     ///< of the quantity
  const char* words = "";    ///< for an axis of a picture
  bool logarithmic = false;  ///< that axis; a value that is not positive is then left out, and the axis says so
  std::vector<double> values;
  std::vector<Regimes> all;
  std::function<std::vector<Regimes>()> curve;  ///< as many values from the least to the greatest as a picture needs
  std::string rod_words;                        ///< the parameters that all rows share
  std::vector<std::string> script_head;         ///< of a picture's script
  Report report;
};
/// @throws BadInput as the command.
[[nodiscard]] FoundRegimes find_regimes(const RegimesRequest& request);

[[nodiscard]] std::vector<Column> regimes_columns();

/// θ₂ and θ₃ over the parameter, and the areas of one, two and three impacts: curves through many values, and marks at
/// those of the table.
[[nodiscard]] Picture regimes_picture(const FoundRegimes& found);

}  // namespace clatter::validation
