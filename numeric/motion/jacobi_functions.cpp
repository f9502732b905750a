// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/jacobi_functions.hpp"

#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

namespace clatter::numeric {
namespace {

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

JacobiFunctions::JacobiFunctions(double complementary_parameter) : complement_(complementary_parameter) {
  assert(complement_ >= 1e-200 && complement_ <= 1);
  // The means agree to eps one step after they agree to its square root.
  constexpr double agreement = 1e-8;
  arithmetic_[0] = 1;
  geometric_[0] = std::sqrt(complement_);
  int n = 0;
  while (std::fabs(arithmetic_[n] - geometric_[n]) > agreement * arithmetic_[n] && n + 2 < most_means) {
    arithmetic_[n + 1] = (arithmetic_[n] + geometric_[n]) / 2;
    geometric_[n + 1] = std::sqrt(arithmetic_[n] * geometric_[n]);
    ++n;
  }
  means_ = n + 1;
  arithmetic_[n + 1] = (arithmetic_[n] + geometric_[n]) / 2;
  quarter_period_ = std::numbers::pi / (2 * arithmetic_[means_]);
}

JacobiFunctions::Values JacobiFunctions::at(double u) const {
  if (std::fabs(u) < 1e-9) return {.sn = u};  // terms of order u² are below rounding
  const double angle = arithmetic_[means_] * u;
  const double sine = std::sin(angle);
  double t = arithmetic_[means_] * (std::cos(angle) / sine);
  double dn = 1;
  for (int n = means_ - 1; n >= 0; --n) {
    const double z = t * t / arithmetic_[n + 1];
    t *= dn;
    dn = (geometric_[n] + z) / (arithmetic_[n] + z);
  }
  const double sn = std::copysign(1 / std::sqrt(1 + t * t), sine);
  return {.sn = sn, .cn = t * sn, .dn = dn};
}

double JacobiFunctions::argument(const Amplitude& amplitude) const {
  const double s = amplitude.sine, c = amplitude.cosine;
  return s * boost::math::ellint_rf(c * c, c * c + complement_ * s * s, 1.0, Policy());
}

double JacobiFunctions::remaining_integral(const Values& values, double h) const {
  const auto [sn, cn, dn] = values;
  return cn * cn * cn / (3 * (1 + h) * std::sqrt(complement_)) *
         boost::math::ellint_rj(sn * sn, 1.0, dn * dn / complement_, (1 + h * sn * sn) / (1 + h), Policy());
}

}  // namespace clatter::numeric
