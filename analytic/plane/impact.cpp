// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/impact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// While the slip of a flat landing has one direction, or none: all per unit of P_n/m.
struct FlatPhase {
  double ratio;      ///< P_t/P_n
  double turn_rate;  ///< dΩ
  double slip_rate;  ///< ds
  bool tilts;
};

/// Phases of a flat landing under Coulomb's law.
class FlatLanding {
 public:
  FlatLanding(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
              const ContactPoint& second)
      : square_(body.gyration_square), depth_(first.normal), turn_rate_(before.angular / before.normal),
        ends_(std::minmax<double>({first.tangential, second.tangential})) {}

  [[nodiscard]] bool pushes_without_friction() const { return clamped(-square_ * turn_rate_) == -square_ * turn_rate_; }
  [[nodiscard]] FlatPhase sliding(double ratio) const {
    const double asked = ratio * depth_ - square_ * turn_rate_, place = clamped(asked);
    const double turn_rate = place == asked ? turn_rate_ : (ratio * depth_ - place) / square_;
    return {ratio, turn_rate, ratio + depth_ * turn_rate, place != asked};
  }
  /// Without slip, or, where that takes too much friction, with slip that begins.
  [[nodiscard]] FlatPhase from_rest(double friction) const {
    const double inertia = square_ + depth_ * depth_, asked = -inertia * turn_rate_, place = clamped(asked);
    const double turn_rate = place == asked ? turn_rate_ : -place / inertia, ratio = -depth_ * turn_rate;
    if (std::fabs(ratio) <= friction) return {ratio, turn_rate, 0, place != asked};
    return sliding(std::copysign(friction, ratio));
  }

 private:
  [[nodiscard]] double clamped(double place) const { return std::clamp(place, ends_.first, ends_.second); }

  double square_, depth_, turn_rate_;
  std::pair<double, double> ends_;
};

/// What a flat landing by Coulomb's law comes to.
struct FlatPath {
  double normal = 0, tangential = 0, turned = 0;  ///< P_n/m, P_t/m, the change of Ω
  bool tilts = false, sticks = false;
  ImpactMode mode = ImpactMode::slip;
};

FlatPath follow(const FlatLanding& landing, double normal, double slip, double friction) {
  FlatPath path{.normal = normal};
  double left = normal;
  const auto go_on = [&](const FlatPhase& phase, double length) {
    path.tangential += phase.ratio * length;
    path.turned += phase.turn_rate * length;
    path.tilts = path.tilts || phase.tilts;
    left -= length;
  };
  if (slip != 0) {
    const FlatPhase begin = landing.sliding(-std::copysign(friction, slip));
    const double stop = begin.slip_rate * slip < 0 ? -slip / begin.slip_rate : normal;
    go_on(begin, std::fmin(stop, normal));
    if (!(stop < normal)) return path;
  }
  const FlatPhase rest = landing.from_rest(friction);
  path.sticks = rest.slip_rate == 0;
  path.mode = slip == 0 ? (path.sticks ? ImpactMode::stick : ImpactMode::slip)
                        : (path.sticks ? ImpactMode::slip_stick
                                       : (rest.slip_rate * slip < 0 ? ImpactMode::reverse_slip : ImpactMode::slip));
  go_on(rest, left);
  return path;
}

Impact tilted_impact(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
                     double restitution, const FlatPath& path) {
  Impact impact{.normal_impulse = body.mass * path.normal,
                .tangential_impulse = body.mass * path.tangential,
                .approach_speed = -before.normal,
                .separation_speed = -restitution * before.normal,
                .slip_before = slip_velocity(before, first),
                .mode = path.mode,
                .after = {.normal = -restitution * before.normal,
                          .tangential = before.tangential + path.tangential,
                          .angular = before.angular + path.turned},
                .tilts = true};
  impact.slip_after = path.sticks ? 0 : slip_velocity(impact.after, first);
  impact.energy_loss = -(impact.normal_impulse * (before.normal + impact.after.normal) +
                         impact.tangential_impulse * (before.tangential + impact.after.tangential) +
                         body.mass * body.gyration_square * path.turned * (before.angular + impact.after.angular)) /
                       2;
  return impact;
}

double energy_of_motion(const PlanarBody& body, const PlanarVelocity& v) {
  return body.mass *
         (v.normal * v.normal + v.tangential * v.tangential + body.gyration_square * (v.angular * v.angular)) / 2;
}

/// strike_flat() with a given restitution.
std::optional<Impact> landed_flat(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
                                  const ContactPoint& second, const ImpactLaw& law, double e) {
  const double depth = first.normal;
  const PathStart<> start{.approach_speed = -before.normal, .slip = slip_velocity(before, first), .restitution = e};
  const PathEnd<> path = flat_impulse(start, before.angular * depth, law);
  const double normal = path.normal_impulse, tangential = path.tangential_impulse;
  if (law.rubs()) {
    const FlatLanding landing(body, before, first, second);
    const FlatPath tilting = follow(landing, normal, start.slip, law.friction_value);
    if (tilting.tilts) {
      if (!landing.pushes_without_friction()) return {};
      return tilted_impact(body, before, first, e, tilting);
    }
  }

  // Shares of the two vertices, from the angular momentum that they must supply together.
  const double moment = tangential * depth + body.gyration_square * (1 + e) * before.angular;
  const double of_first = (moment - normal * second.tangential) / (first.tangential - second.tangential);
  if (!(of_first >= 0 && of_first <= normal)) return {};

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

}  // namespace

std::optional<Impact> strike_flat(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& first,
                                  const ContactPoint& second, const ImpactLaw& law) {
  law.validate();
  if (!(normal_velocity(before, first) < 0 && normal_velocity(before, second) < 0)) return {};
  if (!(-before.normal > 0)) return {};
  const double e = restitution_at(law, pressure_centre_speed(-before.normal, before.angular, body.gyration_square));
  auto impact = landed_flat(body, before, first, second, law, e);
  if (!impact || !law.rubs() || may_gain_energy(law.law)) return impact;
  const double energy = energy_of_motion(body, before);
  const double least = restitution_without_gain(e, energy, [&](double some) {
    const auto landed = some == e ? impact : landed_flat(body, before, first, second, law, some);
    return landed ? landed->energy_loss : energy;
  });
  if (!(least < e)) return impact;
  impact = landed_flat(body, before, first, second, law, least);
  if (impact) impact->is_limited = true;
  return impact;
}

}  // namespace clatter::analytic
