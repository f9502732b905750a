// SPDX-License-Identifier: GPL-3.0-or-later
// A rebound as a whole that does not gain energy.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

#include "analytic/base/limits.hpp"

namespace clatter::analytic {

/// The largest restitution up to e with which a landing as a whole loses energy or none: e itself, unless `loss` is
/// less than zero there.  A smaller e ends the same path in impulse space earlier, so that the loss is a continuous
/// function of it, and so is what is found of the motion before.  0 if nothing is lost then, either.
/// Accuracy: the loss is between zero and 1e-13 of `energy`, or rounding of `loss`.
/// @param energy  before the landing; a gain of its rounding is none
/// @param loss  of energy, as a function of the restitution
[[nodiscard]] double restitution_without_gain(double e, double energy, const auto& loss) {
  constexpr double rounding = 8 * detail::epsilon;
  const double at_law = loss(e);
  if (!(at_law < -rounding * energy)) return e;
  const double without_rebound = loss(0);
  if (!(without_rebound > 0)) return 0;
  std::uintmax_t most = 100;
  return boost::math::tools::toms748_solve(loss, 0.0, e, without_rebound, at_law,
                                           boost::math::tools::eps_tolerance<double>(50), most)
      .first;
}

}  // namespace clatter::analytic
