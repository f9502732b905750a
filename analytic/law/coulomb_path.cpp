// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/coulomb_path.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/impact_law.hpp"
#include "analytic/law/viscoelastic.hpp"

namespace clatter::analytic {

namespace {

using detail::value_of;

/// A straight stretch of the path.
template <class Number>
struct Phase {
  Number ratio{};   ///< r = dP_t/dP_n
  Number slope{};   ///< du/dP
  Number length{};  ///< in P; infinite for the last phase
};

template <class Number>
struct Phases {
  Phase<Number> first;
  Phase<Number> second;  ///< meaningful if first.length is finite
  ImpactMode mode_first;
  ImpactMode mode_second;
};

constexpr double endless = std::numeric_limits<double>::infinity();

template <class Number>
Phase<Number> phase(const PathCoefficients<Number>& path, const Number& ratio, const Number& length) {
  return {ratio, path.normal - path.normal_coupling * ratio, length};
}

/// Without slip at the start: stick, or slip the way the drift pushes.
Phases<double> from_rest(const PathCoefficients<>& path, double friction) {
  const double sticking = path.slip_drift / path.tangential;
  if (friction >= std::fabs(sticking)) {
    return {phase(path, sticking, endless), {}, ImpactMode::stick, ImpactMode::stick};
  }
  const double ratio = std::copysign(friction, path.slip_drift);
  return {phase(path, ratio, endless), {}, ImpactMode::slip, ImpactMode::slip};
}

/// @param sense of the slip, 1 or −1
template <class Number>
Phases<Number> from_slip(const PathCoefficients<Number>& path, const Number& slip, double sense, double friction) {
  const Number ratio = -sense * friction;
  // Rate at which |s| falls with P.
  const Number slowing = path.tangential * friction + sense * path.slip_drift;
  const Number length = slowing > 0 ? sense * slip / slowing : Number(endless);
  const Phase<Number> first = phase(path, ratio, length);
  const Number sticking = path.slip_drift / path.tangential;
  if (friction >= std::fabs(value_of(sticking))) {
    return {first, phase(path, sticking, Number(endless)), ImpactMode::slip, ImpactMode::slip_stick};
  }
  return {first, phase(path, -ratio, Number(endless)), ImpactMode::slip, ImpactMode::reverse_slip};
}

Phases<double> phases_of(const PathCoefficients<>& path, double slip, double friction) {
  if (slip == 0) return from_rest(path, friction);
  return from_slip(path, slip, std::copysign(1.0, slip), friction);
}

template <std::size_t size>
Phases<detail::Dual<size>> phases_of(const PathCoefficients<detail::Dual<size>>& path, const detail::Dual<size>& slip,
                                     double friction) {
  const double sense = slip.value == 0 ? path.slip_drift.value : slip.value;
  return from_slip(path, slip, std::copysign(1.0, sense), friction);
}

/// Impulse after which u has risen by `rise` > 0.
template <class Number>
Number impulse_for_rise(const Phases<Number>& phases, const Number& rise) {
  const Number in_first = phases.first.slope * phases.first.length;
  if (phases.first.length == endless || (phases.first.slope > 0 && rise <= in_first)) return rise / phases.first.slope;
  return phases.first.length + (rise - in_first) / phases.second.slope;
}

/// −∫ u dP from the start to the end of compression, for approach speed v.
template <class Number>
Number compression_work(const Phases<Number>& phases, const Number& v, const Number& compression) {
  if (!(phases.first.length < compression)) return v * compression / 2;
  const Number length = phases.first.length;
  const Number speed = v - phases.first.slope * length;  // of approach, where slip stops
  return (v + speed) / 2 * length + speed * (compression - length) / 2;
}

/// Impulse after compression that returns the work `work` of the normal force (Stronge).
template <class Number>
Number impulse_for_work(const Phases<Number>& phases, const Number& compression, const Number& work) {
  using std::sqrt;
  if (!(phases.first.length > compression)) return sqrt(2 * work / phases.second.slope);
  if (phases.first.length == endless) return sqrt(2 * work / phases.first.slope);
  const Number left = phases.first.length - compression;
  const Number speed = phases.first.slope * left;
  const Number rest = work - speed * left / 2;
  if (rest <= 0) return sqrt(2 * work / phases.first.slope);
  return left + 2 * rest / (speed + sqrt(speed * speed + 2 * phases.second.slope * rest));
}

/// Rise of u by `impulse` after compression.
template <class Number>
Number rise_after(const Phases<Number>& phases, const Number& compression, const Number& impulse) {
  const Number left = phases.first.length > compression ? phases.first.length - compression : Number(0);
  if (!(impulse > left)) return phases.first.slope * impulse;
  const Number of_first = left > 0 ? phases.first.slope * left : Number(0);
  return of_first + phases.second.slope * (impulse - left);
}

/// Impulse and separation speed.
template <class Number>
struct Ending {
  Number impulse, separation;
};

/// Viscoelastic ground: if slip stops before the ground has given back what it stored, the rest is
/// given back along the second phase; otherwise the velocities are those of the restitution e.
template <class Number>
Ending<Number> viscoelastic_ending(const Phases<Number>& phases, const PathStart<Number>& start,
                                   double damping_per_stiffness) {
  const Number &v = start.approach_speed, &e = start.restitution;
  const Number single = impulse_for_rise<Number>(phases, (1 + e) * v);
  if (!(phases.first.length < endless)) return {single, e * v};
  const Number speed = phases.first.slope * phases.first.length - v;  // where slip stops
  if (!(speed < e * v)) return {single, e * v};
  const Number work = stored_work(damping_per_stiffness,
                                  ImpulseStretch<Number>{.from = -v, .to = speed, .length = phases.first.length});
  const Unloading<Number> rest{.from = speed, .slope = phases.second.slope, .work = work};
  // Work that rounding alone has made negative would slow the body down again, by an impulse that
  // pulls.
  const Number given = separation_speed(damping_per_stiffness, rest);
  const Number separation = given > speed ? given : speed;
  return {phases.first.length + (separation - speed) / phases.second.slope, separation};
}

template <class Number>
Ending<Number> ending(const Phases<Number>& phases, const PathStart<Number>& start, const ImpactLaw& law) {
  const Number &v = start.approach_speed, &e = start.restitution;
  switch (law.law) {
    case RestitutionLaw::newton: return {impulse_for_rise<Number>(phases, (1 + e) * v), e * v};
    case RestitutionLaw::viscoelastic: return viscoelastic_ending(phases, start, law.damping_per_stiffness);
    case RestitutionLaw::poisson:
    case RestitutionLaw::stronge: break;
  }
  const Number compression = impulse_for_rise(phases, v);
  if (law.law == RestitutionLaw::poisson) {
    return {(1 + e) * compression, rise_after<Number>(phases, compression, e * compression)};
  }
  // Work is taken in units of v² so that speeds of any magnitude can be squared.
  const Number work = e * e * (compression_work(phases, v, compression) / v / v);
  const Phases<Number> scaled{{phases.first.ratio, phases.first.slope, phases.first.length / v},
                              phases.second,
                              phases.mode_first,
                              phases.mode_second};
  const Number restitution = v * impulse_for_work<Number>(scaled, compression / v, work);
  return {compression + restitution, rise_after(phases, compression, restitution)};
}

}  // namespace

template <class Number>
PathEnd<Number> coulomb_path(const PathCoefficients<Number>& path, const PathStart<Number>& start,
                             const ImpactLaw& law) {
  const double friction = law.friction_value;
  const Phases<Number> phases = phases_of(path, start.slip, friction);
  const auto [impulse, separation] = ending(phases, start, law);
  if (friction == 0) return {impulse, 0, separation, ImpactMode::frictionless};
  if (!(impulse > phases.first.length)) return {impulse, phases.first.ratio * impulse, separation, phases.mode_first};
  const Number second = impulse - phases.first.length;
  return {impulse, phases.first.ratio * phases.first.length + phases.second.ratio * second, separation,
          phases.mode_second};
}

template PathEnd<double> coulomb_path(const PathCoefficients<double>&, const PathStart<double>&, const ImpactLaw&);
template PathEnd<ImpactDual> coulomb_path(const PathCoefficients<ImpactDual>&, const PathStart<ImpactDual>&,
                                          const ImpactLaw&);

namespace {

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

/// Moreau's impulse per unit mass.  As P_t grows along the line on which u rises by (1+e) v, so does the slip after:
/// stick, or slip one way, whichever the cone allows, is the one solution.
template <class Number>
PathEnd<Number> moreau_impulse(const PathCoefficients<Number>& path, const PathStart<Number>& start, double friction) {
  const Number rise = (1 + start.restitution) * start.approach_speed,
               separation = start.restitution * start.approach_speed;
  const Number coupled = path.normal_coupling / path.tangential;
  const Number sticking = (rise - coupled * start.slip) / (path.normal - coupled * path.slip_drift);
  const Number holding = (path.slip_drift * sticking - start.slip) / path.tangential;
  const bool slipped = value_of(start.slip) != 0;
  if (sticking >= Number(0) && std::fabs(value_of(holding)) <= friction * value_of(sticking)) {
    return {sticking, holding, separation, slipped ? ImpactMode::slip_stick : ImpactMode::stick};
  }
  const double against = sticking >= Number(0) ? value_of(holding) : -value_of(path.normal_coupling);
  const double sense = against < 0 ? 1 : -1;
  const Number impulse = rise / (path.normal + sense * friction * path.normal_coupling);
  const bool goes_on = sense * value_of(start.slip) >= 0;
  return {impulse, -sense * friction * impulse, separation,
          friction == 0 ? ImpactMode::frictionless
          : goes_on     ? ImpactMode::slip
                        : ImpactMode::reverse_slip};
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
  if (!law.has_cone()) return ratio_impulse(path, start, law);
  if (law.friction == FrictionKind::moreau) return moreau_impulse(path, start, law.friction_value);
  return coulomb_path(path, start, law);
}

template <class Number>
PathEnd<Number> flat_impulse(const PathStart<Number>& start, const Number& turning, const ImpactLaw& law) {
  if (!law.has_cone()) return ratio_impulse(PathCoefficients<Number>{}, start, law);
  const Number impulse = (1 + start.restitution) * start.approach_speed;
  const PathCoefficients<Number> path{
      .normal = 1, .normal_coupling = 0, .slip_drift = (1 + start.restitution) * turning / impulse, .tangential = 1};
  if (law.friction == FrictionKind::moreau) return moreau_impulse(path, start, law.friction_value);
  ImpactLaw whole = law;  // e, which slip does not change here, is already that of the pressure centre
  if (law.law == RestitutionLaw::viscoelastic) whole.law = RestitutionLaw::newton;
  return coulomb_path(path, start, whole);
}

template double restitution_at(const ImpactLaw&, const double&);
template ImpactDual restitution_at(const ImpactLaw&, const ImpactDual&);
template detail::Dual<1> restitution_at(const ImpactLaw&, const detail::Dual<1>&);
template PathEnd<double> point_impulse(const PathCoefficients<double>&, const PathStart<double>&, const ImpactLaw&);
template PathEnd<ImpactDual> point_impulse(const PathCoefficients<ImpactDual>&, const PathStart<ImpactDual>&,
                                           const ImpactLaw&);
template PathEnd<detail::Dual<2>> point_impulse(const PathCoefficients<detail::Dual<2>>&,
                                                const PathStart<detail::Dual<2>>&, const ImpactLaw&);
template PathEnd<detail::Dual<2>> flat_impulse(const PathStart<detail::Dual<2>>&, const detail::Dual<2>&,
                                               const ImpactLaw&);
template PathEnd<double> flat_impulse(const PathStart<double>&, const double&, const ImpactLaw&);
template PathEnd<ImpactDual> flat_impulse(const PathStart<ImpactDual>&, const ImpactDual&, const ImpactLaw&);

double restitution_without_gain(double e, double energy, const std::function<double(double)>& loss) {
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
