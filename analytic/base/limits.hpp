// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of double precision, under the names that the discrete model's formulas use.
#pragma once

#include <limits>

namespace clatter::analytic::detail {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();  ///< 2⁻⁵², twice the rounding of 1
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double never = infinite;                                    ///< the time of what does not happen
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();  ///< a number that nothing has given

}  // namespace clatter::analytic::detail
