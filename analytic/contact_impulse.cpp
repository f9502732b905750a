// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/contact_impulse.hpp"

#include <sstream>

#include "analytic/errors.hpp"
#include "analytic/impact_limits.hpp"
#include "analytic/restitution_map.hpp"

namespace clatter::analytic {
namespace {

using detail::value_of;

[[noreturn]] void jam(double ratio, double limit) {
  std::ostringstream text;
  text.precision(6);
  text << "jamming (Painlevé's paradox): the impulse ratio " << ratio << " is at or beyond the limit " << limit
       << " at which the contact point can no longer leave the ground";
  throw OutsideModelError(text.str());
}

/// e of the damping number s.
double damped_restitution(double damping_number) { return restitution_of_damping(damping_number); }
template <std::size_t size>
detail::Dual<size> damped_restitution(const detail::Dual<size>& damping_number) {
  const double s = damping_number.value;
  return damping_number.mapped(restitution_of_damping(s), restitution_slope_of_damping(s));
}

/// Eq. 8 for an impulse ratio as given, per unit mass.
template <class Number>
PathEnd<Number> ratio_impulse(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                              const ImpactLaw& law) {
  using std::fma;
  const Number ratio = law.friction == FrictionKind::none ? 0 : law.friction_value;
  const Number denominator = fma(-ratio, path.normal_coupling, path.normal);
  if (!(denominator > 0)) {
    jam(value_of(ratio), jamming_ratio({.normal = value_of(path.normal),
                                        .coupling = value_of(path.normal_coupling),
                                        .tangential = value_of(path.tangential)}));
  }
  const Number impulse = (1 + start.restitution) * start.approach_speed / denominator;
  return {impulse, ratio * impulse, start.restitution * start.approach_speed,
          ratio == 0 ? ImpactMode::frictionless : ImpactMode::slip};
}

}  // namespace

template <class Number>
Number restitution_at(const ImpactLaw& law, const Number& approach_speed) {
  if (law.law != RestitutionLaw::viscoelastic) return law.restitution;
  return damped_restitution(law.damping_per_stiffness * approach_speed);
}

template <class Number>
PathEnd<Number> point_impulse(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                              const ImpactLaw& law) {
  if (law.friction != FrictionKind::coulomb) return ratio_impulse(path, start, law);
  return coulomb_path(path, start, law);
}

template <class Number>
PathEnd<Number> flat_impulse(const PathStart<Number>& start, const Number& turning, const ImpactLaw& law) {
  if (law.friction != FrictionKind::coulomb) {
    return ratio_impulse(PathCoefficients<Number>{}, start, law);
  }
  const Number impulse = (1 + start.restitution) * start.approach_speed;
  const PathCoefficients<Number> path{
      .normal = 1, .normal_coupling = 0, .slip_drift = (1 + start.restitution) * turning / impulse, .tangential = 1};
  ImpactLaw whole = law;  // e, which slip does not change here, is already that of the pressure centre
  if (law.law == RestitutionLaw::viscoelastic) whole.law = RestitutionLaw::newton;
  return coulomb_path(path, start, whole);
}

template double restitution_at(const ImpactLaw&, const double&);
template ImpactDual restitution_at(const ImpactLaw&, const ImpactDual&);
template PathEnd<double> point_impulse(const PathCoefficients<double>&, const PathStart<double>&, const ImpactLaw&);
template PathEnd<ImpactDual> point_impulse(const PathCoefficients<ImpactDual>&, const PathStart<ImpactDual>&,
                                           const ImpactLaw&);
template PathEnd<double> flat_impulse(const PathStart<double>&, const double&, const ImpactLaw&);
template PathEnd<ImpactDual> flat_impulse(const PathStart<ImpactDual>&, const ImpactDual&, const ImpactLaw&);

}  // namespace clatter::analytic
