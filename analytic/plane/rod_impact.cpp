// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/rod_impact.hpp"

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

RodImpact rod_impact(const Angle& theta, const RodApproach& before, double restitution, double impulse_ratio) {
  const double c = theta.cosine;
  const double s = theta.sine;
  const double friction = 3 * impulse_ratio * s * c;
  const double denominator = 1 + 3 * c * c - friction;
  if (!(denominator > 0)) throw OutsideModelError("jamming: 1 + 3c² − 3 μ_i s c is not positive");
  const double scale = -(1 + restitution) * before.normal / denominator;
  return {.after = {.normal = -(restitution - 3 * c * c + friction) * before.normal / denominator,
                    .tangential = before.tangential + impulse_ratio * scale,
                    .angular = 6 * (c - impulse_ratio * s) * scale},
          .normal_impulse = scale};
}

RodImpact flat_rod_impact(const RodApproach& before, double restitution, double impulse_ratio) {
  const double impulse = -(1 + restitution) * before.normal;
  return {.after = {.normal = -restitution * before.normal,
                    .tangential = before.tangential + impulse_ratio * impulse,
                    .angular = 0},
          .normal_impulse = impulse};
}

}  // namespace clatter::analytic
