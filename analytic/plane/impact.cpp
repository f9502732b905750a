// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/impact.hpp"

#include <array>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/law/coulomb_path.hpp"

namespace clatter::analytic {

double Impact::impulse_ratio() const { return normal_impulse > 0 ? tangential_impulse / normal_impulse : 0; }

double Impact::restitution() const { return approach_speed > 0 ? separation_speed / approach_speed : 0; }

ContactInertia contact_inertia(double gyration_square, const ContactPoint& d) {
  const double per_tangential = d.tangential / gyration_square;
  const double per_normal = d.normal / gyration_square;
  return {.normal = std::fma(per_tangential, d.tangential, 1.0),
          .coupling = per_tangential * d.normal,
          .tangential = std::fma(per_normal, d.normal, 1.0)};
}

double normal_velocity(const PlanarVelocity& v, const ContactPoint& d) {
  return std::fma(-v.angular, d.tangential, v.normal);
}

double slip_velocity(const PlanarVelocity& v, const ContactPoint& d) {
  return std::fma(v.angular, d.normal, v.tangential);
}

Impact strike(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& contact,
              const ImpactLaw& given) {
  return strike(body, before, {normal_velocity(before, contact), slip_velocity(before, contact)}, contact, given);
}

Impact strike(const PlanarBody& body, const PlanarVelocity& before, const ContactVelocity& velocity,
              const ContactPoint& contact, const ImpactLaw& law) {
  law.validate();
  const auto [u, s] = velocity;
  Impact impact{.approach_speed = -u, .separation_speed = u, .slip_before = s, .slip_after = s, .after = before};
  if (!(u < 0)) return impact;

  const ContactInertia inertia = contact_inertia(body.gyration_square, contact);
  const PathCoefficients<> path{.normal = inertia.normal,
                                .normal_coupling = inertia.coupling,
                                .slip_drift = inertia.coupling,
                                .tangential = inertia.tangential};
  const PathStart<> start{.approach_speed = -u, .slip = s, .restitution = restitution_at(law, -u)};
  const auto [normal, tangential, separation, mode] = point_impulse(path, start, law);
  impact.normal_impulse = body.mass * normal;
  impact.tangential_impulse = body.mass * tangential;
  impact.mode = mode;
  const double turning = (tangential * contact.normal - normal * contact.tangential) / body.gyration_square;
  impact.after = {.normal = before.normal + normal,
                  .tangential = before.tangential + tangential,
                  .angular = before.angular + turning};
  if (!std::isfinite(impact.after.angular) || !std::isfinite(impact.after.tangential)) {
    throw NumericalError("the impulse overflows: the impulse ratio is too near the jamming limit");
  }
  impact.separation_speed = separation;
  const double turned = impact.after.angular * contact.tangential;
  if (2 * std::fabs(turned) <= impact.separation_speed) {  // near upright: no cancellation
    impact.after.normal = impact.separation_speed + turned;
  }
  impact.slip_after = mode == ImpactMode::stick || mode == ImpactMode::slip_stick
                          ? 0
                          : s + (inertia.tangential * tangential - inertia.coupling * normal);
  impact.energy_loss = (0 - impact.normal_impulse * (u + impact.separation_speed) -
                        impact.tangential_impulse * (s + impact.slip_after)) /
                       2;
  return impact;
}

namespace {

/// A flat landing while friction is `ratio` of the normal impulse: the pressure point d_t, dλ/dP and ds/dP, per unit
/// mass.
struct FlatPhase {
  double ratio = 0, place = 0, rate = 0, slip_rate = 0;
  bool whole = true;
};

/// (3) of a flat landing.
class FlatLanding {
 public:
  FlatLanding(double square, const PlanarVelocity& before, const ContactPoint& first, const ContactPoint& second)
      : square_(square), depth_(first.normal), before_(before),
        ends_{std::fmin(first.tangential, second.tangential), std::fmax(first.tangential, second.tangential)} {}

  [[nodiscard]] FlatPhase sliding(double ratio) const {
    const double of_whole = whole_turn() * square_;
    for (const double end : ends_) {
      if (is_nearest(end, ratio)) return pushed_at(end, ratio);
    }
    return {.ratio = ratio,
            .place = ratio * depth_ - of_whole,
            .rate = -1 / before_.normal,
            .slip_rate = ratio + depth_ * whole_turn()};
  }
  /// Without slip, however much friction that takes.
  [[nodiscard]] FlatPhase sticking() const {
    for (const double end : ends_) {
      const double ratio = depth_ * end / (square_ + depth_ * depth_);
      if (!is_nearest(end, ratio)) continue;
      FlatPhase phase = pushed_at(end, ratio);
      phase.slip_rate = 0;
      return phase;
    }
    FlatPhase phase = sliding(-depth_ * whole_turn());
    phase.slip_rate = 0;
    return phase;
  }
  /// After slip has stopped, or without any.
  [[nodiscard]] FlatPhase from_rest(double friction) const {
    const FlatPhase held = sticking();
    return std::fabs(held.ratio) <= friction ? held : sliding(std::copysign(friction, held.ratio));
  }
  /// φ at d_t.
  [[nodiscard]] double approach(double place) const { return before_.angular * place - before_.normal; }

 private:
  /// dΩ/dP of the rebound as a whole.
  [[nodiscard]] double whole_turn() const { return before_.angular / before_.normal; }
  [[nodiscard]] double turn(double place, double ratio) const { return (ratio * depth_ - place) / square_; }
  [[nodiscard]] FlatPhase pushed_at(double end, double ratio) const {
    const double turning = turn(end, ratio);
    return {.ratio = ratio,
            .place = end,
            .rate = (1 - end * turning) / approach(end),
            .slip_rate = ratio + depth_ * turning,
            .whole = false};
  }
  /// Whether the other end, pushed at this one, rises faster than in step.
  [[nodiscard]] bool is_nearest(double end, double ratio) const {
    const double other = end == ends_[0] ? ends_[1] : ends_[0], turning = turn(end, ratio);
    return (1 - other * turning) * approach(end) > (1 - end * turning) * approach(other);
  }

  double square_, depth_;
  PlanarVelocity before_;
  std::array<double, 2> ends_;
};

/// du/dP and ds/dP that give the two phases, or the one.
PathCoefficients<> coefficients_of(const FlatPhase& first, const FlatPhase* second, double speed) {
  PathCoefficients<> path{.normal = speed * first.rate, .slip_drift = first.ratio - first.slip_rate};
  if (second == nullptr || second->ratio == first.ratio) return path;
  const double apart = second->ratio - first.ratio;
  path.normal_coupling = speed * (first.rate - second->rate) / apart;
  path.normal += path.normal_coupling * first.ratio;
  path.tangential = (second->slip_rate - first.slip_rate) / apart;
  path.slip_drift = path.tangential * first.ratio - first.slip_rate;
  return path;
}

/// Whether the landing has a phase in which the ground pushes at one end.
bool tilts(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first, const ContactPoint& second,
           const ImpactLaw& law) {
  if (!(before.normal < 0)) return true;
  const FlatLanding landing(body.gyration_square, before, first, second);
  if (!law.rubs()) return !landing.sliding(law.friction == FrictionKind::impulse_ratio ? law.friction_value : 0).whole;
  const double slip = slip_velocity(before, first);
  const FlatPhase rest = landing.from_rest(law.friction_value);
  if (slip == 0) return !rest.whole;
  const FlatPhase begin = landing.sliding(-std::copysign(law.friction_value, slip));
  const bool stops = begin.slip_rate * slip < 0;
  return !begin.whole || (stops && !rest.whole);
}

/// Phases of one ratio are straight: Routh's path with the coefficients that they have.
Impact strike_tilting(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
                      const ContactPoint& second, const ImpactLaw& law) {
  const FlatLanding landing(body.gyration_square, before, first, second);
  const double slip = slip_velocity(before, first), depth = first.normal;
  const bool rubs = law.rubs(), stops = rubs && slip != 0;
  const double given = law.friction == FrictionKind::impulse_ratio ? law.friction_value : 0;
  const double speed = landing.approach(landing.sliding(0).place);
  const FlatPhase begin = stops  ? landing.sliding(-std::copysign(law.friction_value, slip))
                          : rubs ? landing.from_rest(law.friction_value)
                                 : landing.sliding(given);
  const FlatPhase rest = rubs ? landing.from_rest(law.friction_value) : begin;
  const bool slows = stops && begin.slip_rate * slip < 0;
  const PathStart<> start{.approach_speed = speed, .slip = slip, .restitution = restitution_at(law, speed)};
  const PathEnd<> path = point_impulse(coefficients_of(begin, slows ? &rest : nullptr, speed), start, law);
  const double until = slows ? std::fmin(-slip / begin.slip_rate, path.normal_impulse) : path.normal_impulse;
  const double centre = begin.place * until + rest.place * (path.normal_impulse - until);
  Impact impact{.normal_impulse = body.mass * path.normal_impulse,
                .tangential_impulse = body.mass * path.tangential_impulse,
                .approach_speed = speed,
                .separation_speed = path.separation_speed,
                .slip_before = slip,
                .mode = path.mode,
                .after = {.normal = before.normal + path.normal_impulse,
                          .tangential = before.tangential + path.tangential_impulse,
                          .angular = before.angular +
                                     (path.tangential_impulse * depth - centre) / body.gyration_square},
                .tilts = true};
  const bool sticks = path.mode == ImpactMode::stick || path.mode == ImpactMode::slip_stick;
  impact.slip_after = sticks ? 0 : slip_velocity(impact.after, first);
  const PlanarVelocity sum{.normal = before.normal + impact.after.normal,
                           .tangential = before.tangential + impact.after.tangential,
                           .angular = before.angular + impact.after.angular};
  const double turned = body.mass * body.gyration_square * (impact.after.angular - before.angular);
  impact.energy_loss =
      -(impact.normal_impulse * sum.normal + impact.tangential_impulse * sum.tangential + turned * sum.angular) / 2;
  return impact;
}

}  // namespace

std::optional<Impact> strike_flat(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
                                  const ContactPoint& second, const ImpactLaw& law) {
  law.validate();
  if (!(normal_velocity(before, first) < 0 && normal_velocity(before, second) < 0)) return {};
  if (tilts(body, before, first, second, law)) return strike_tilting(body, before, first, second, law);
  const double e = restitution_at(law, pressure_centre_speed(-before.normal, before.angular, body.gyration_square));
  const double depth = first.normal;
  const PathStart<> start{.approach_speed = -before.normal, .slip = slip_velocity(before, first), .restitution = e};
  const PathEnd<> path = flat_impulse(start, before.angular * depth, law);
  const double normal = path.normal_impulse, tangential = path.tangential_impulse;

  Impact impact{.normal_impulse = body.mass * normal,
                .tangential_impulse = body.mass * tangential,
                .approach_speed = start.approach_speed,
                .separation_speed = e * start.approach_speed,
                .slip_before = start.slip,
                .mode = path.mode,
                .after = {.normal = e * start.approach_speed,
                          .tangential = before.tangential + tangential,
                          .angular = 0 - e * before.angular}};
  impact.slip_after = slip_velocity(impact.after, first);
  const double turning_energy = body.gyration_square * before.angular * before.angular;
  const double normal_energy = before.normal * before.normal + turning_energy;
  impact.energy_loss = (body.mass * (1 - e) * (1 + e) * normal_energy -
                        impact.tangential_impulse * (before.tangential + impact.after.tangential)) /
                       2;
  return impact;
}

}  // namespace clatter::analytic
