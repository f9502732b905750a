// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/detail/log1p_minus.hpp"

#include <boost/math/special_functions/log1p.hpp>
#include <cmath>

namespace clatter::analytic::detail {

double log1p_minus(double x) { return std::fabs(x) < 0.5 ? boost::math::log1pmx(x) : std::log1p(x) - x; }

}  // namespace clatter::analytic::detail
