// SPDX-License-Identifier: GPL-3.0-or-later
// Which checks to run.
#pragma once

#include <string>
#include <vector>

#include "validation/verify/check.hpp"

namespace clatter::validation::inline verify {

struct CheckSelection {
  std::vector<const Check*> checks;  ///< in the order of the table
  std::string words;                 ///< "quick set: 77 checks of 78"
};

/// All checks; `quick`: without those that take long; or those named in `only`.
/// @throws BadInput for an unknown name, with the nearest, or if both are given.
[[nodiscard]] CheckSelection select_checks(bool quick, const std::vector<std::string>& only);

}  // namespace clatter::validation::inline verify
