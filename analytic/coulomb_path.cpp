#include "analytic/coulomb_path.hpp"

#include <cmath>
#include <limits>

#include "analytic/viscoelastic_contact.hpp"

namespace clatter::analytic {
namespace {

/// A straight stretch of the path.
struct Phase {
  double ratio;   ///< r = dP_t/dP_n
  double slope;   ///< du/dP
  double length;  ///< in P; infinite for the last phase
};

struct Phases {
  Phase first;
  Phase second;  ///< meaningful if first.length is finite
  ImpactMode mode_first;
  ImpactMode mode_second;
};

constexpr double endless = std::numeric_limits<double>::infinity();

Phase phase(const PathCoefficients& path, double ratio, double length) {
  return {ratio, path.normal - path.normal_coupling * ratio, length};
}

/// Without slip at the start: stick, or slip the way the drift pushes.
Phases from_rest(const PathCoefficients& path, double friction) {
  const double sticking = path.slip_drift / path.tangential;
  if (friction >= std::fabs(sticking)) {
    return {phase(path, sticking, endless), {}, ImpactMode::stick, ImpactMode::stick};
  }
  const double ratio = std::copysign(friction, path.slip_drift);
  return {phase(path, ratio, endless), {}, ImpactMode::slip, ImpactMode::slip};
}

Phases from_slip(const PathCoefficients& path, double slip, double friction) {
  const double ratio = -std::copysign(friction, slip);
  // Rate at which |s| falls with P.
  const double slowing =
      path.tangential * friction + (slip > 0 ? path.slip_drift : -path.slip_drift);
  const double length = slowing > 0 ? std::fabs(slip) / slowing : endless;
  const Phase first = phase(path, ratio, length);
  const double sticking = path.slip_drift / path.tangential;
  if (friction >= std::fabs(sticking)) {
    return {first, phase(path, sticking, endless), ImpactMode::slip, ImpactMode::slip_stick};
  }
  return {first, phase(path, -ratio, endless), ImpactMode::slip, ImpactMode::reverse_slip};
}

/// Impulse after which u has risen by `rise` > 0.
double impulse_for_rise(const Phases& phases, double rise) {
  const double in_first = phases.first.slope * phases.first.length;
  if (phases.first.length == endless || (phases.first.slope > 0 && rise <= in_first)) {
    return rise / phases.first.slope;
  }
  return phases.first.length + (rise - in_first) / phases.second.slope;
}

/// −∫ u dP from the start to the end of compression, for approach speed v.
double compression_work(const Phases& phases, double v, double compression) {
  if (!(phases.first.length < compression)) return v * compression / 2;
  const double length = phases.first.length;
  const double speed = v - phases.first.slope * length;  // of approach, where slip stops
  return (v + speed) / 2 * length + speed * (compression - length) / 2;
}

/// Impulse after compression that returns the work `work` of the normal force (Stronge).
double impulse_for_work(const Phases& phases, double compression, double work) {
  if (!(phases.first.length > compression)) return std::sqrt(2 * work / phases.second.slope);
  if (phases.first.length == endless) return std::sqrt(2 * work / phases.first.slope);
  const double left = phases.first.length - compression;
  const double speed = phases.first.slope * left;
  const double rest = work - speed * left / 2;
  if (rest <= 0) return std::sqrt(2 * work / phases.first.slope);
  return left + 2 * rest / (speed + std::sqrt(speed * speed + 2 * phases.second.slope * rest));
}

/// Rise of u by `impulse` after compression.
double rise_after(const Phases& phases, double compression, double impulse) {
  const double left = std::fmax(phases.first.length - compression, 0.0);
  const double in_first = std::fmin(impulse, left);
  const double of_first = in_first > 0 ? phases.first.slope * in_first : 0;
  return impulse > left ? of_first + phases.second.slope * (impulse - left) : of_first;
}

/// Impulse and separation speed.
struct Ending {
  double impulse, separation;
};

/// Viscoelastic ground: if slip stops before the ground has given back what it stored, the rest is given back
/// along the second phase; otherwise the velocities are those of the restitution e.
Ending viscoelastic_ending(const Phases& phases, double v, const ImpactLaw& law) {
  const double single = impulse_for_rise(phases, (1 + law.restitution) * v);
  if (!(phases.first.length < endless)) return {single, law.restitution * v};
  const double speed = phases.first.slope * phases.first.length - v;  // where slip stops
  if (!(speed < law.restitution * v)) return {single, law.restitution * v};
  const double work = stored_work(law.damping_per_stiffness, {.from = -v, .to = speed, .length = phases.first.length});
  const Unloading rest{.from = speed, .slope = phases.second.slope, .work = work};
  // Work that rounding alone has made negative would slow the body down again, by an impulse that pulls.
  const double separation = std::fmax(separation_speed(law.damping_per_stiffness, rest), speed);
  return {phases.first.length + (separation - speed) / phases.second.slope, separation};
}

Ending ending(const Phases& phases, double v, const ImpactLaw& law) {
  const double e = law.restitution;
  if (law.law == RestitutionLaw::viscoelastic) return viscoelastic_ending(phases, v, law);
  if (law.law == RestitutionLaw::newton) return {impulse_for_rise(phases, (1 + e) * v), e * v};
  const double compression = impulse_for_rise(phases, v);
  if (law.law == RestitutionLaw::poisson) {
    return {(1 + e) * compression, rise_after(phases, compression, e * compression)};
  }
  // Work is taken in units of v² so that speeds of any magnitude can be squared.
  const double work = e * e * (compression_work(phases, v, compression) / v / v);
  const Phases scaled{{phases.first.ratio, phases.first.slope, phases.first.length / v},
                      phases.second, phases.mode_first, phases.mode_second};
  const double restitution = v * impulse_for_work(scaled, compression / v, work);
  return {compression + restitution, rise_after(phases, compression, restitution)};
}

}  // namespace

PathEnd coulomb_path(const PathCoefficients& path, const PathStart& start, const ImpactLaw& law) {
  const double friction = law.friction_value;
  const Phases phases = start.slip == 0 ? from_rest(path, friction)
                                        : from_slip(path, start.slip, friction);
  const auto [impulse, separation] = ending(phases, start.approach_speed, law);
  if (friction == 0) return {impulse, 0, separation, ImpactMode::frictionless};
  if (!(impulse > phases.first.length)) {
    return {impulse, phases.first.ratio * impulse, separation, phases.mode_first};
  }
  const double second = impulse - phases.first.length;
  return {impulse, phases.first.ratio * phases.first.length + phases.second.ratio * second, separation,
          phases.mode_second};
}

}  // namespace clatter::analytic
