// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/oracles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "validation/evidence/extremes.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/impulse_path.hpp"
#include "validation/oracles/rod.hpp"

namespace clatter::validation {
namespace {

using Digits50 = oracle::Digits50;
using D = oracle::Dual<Digits50>;
using Wide = long double;
using analytic::Drop;
using analytic::FrictionKind;
using analytic::ImpactMode;
using analytic::ImpactRow;
using analytic::RestitutionLaw;
using analytic::Sequence;
using oracle::End;
using oracle::Parameter;

oracle::RodCase<Digits50> exact(const RodStart& start) {
  return {.theta = oracle::radians(Digits50(start.angle_deg)),
          .gravity_number = start.parameters.gravity_number,
          .restitution = start.parameters.restitution,
          .impulse_ratio = start.parameters.impulse_ratio};
}

/// The root next to `t` on the falling side: by bisection up to the turning point where it lies close (a graze), by
/// Newton's method elsewhere.
Digits50 arrival(const oracle::RodFlight<Digits50>& rod, End end, Digits50 t) {
  const auto bend = [&](const Digits50& at) {
    return Digits50(-rod.gravity - Digits50(0.5) * static_cast<int>(end) * rod.angular * rod.angular *
                                       sin(rod.inclination - rod.angular * at));
  };
  Digits50 low_point = t;
  for (int i = 0; i < 60 && bend(low_point) > 0; ++i) low_point -= end_velocity(rod, end, low_point) / bend(low_point);
  Digits50 before = t * (1 - Digits50(1e-4));
  if (abs(low_point - t) < Digits50(1e-3) * t && end_height(rod, end, before) > 0 &&
      end_height(rod, end, low_point) <= 0) {
    Digits50 after = low_point;
    for (int i = 0; i < 160; ++i) {
      const Digits50 middle = (before + after) / 2;
      (end_height(rod, end, middle) > 0 ? before : after) = middle;
    }
    return after;
  }
  Digits50 step = t;
  for (int i = 0; i < 60 && abs(step) > Digits50(1e-48) * t; ++i) {
    step = end_height(rod, end, t) / end_velocity(rod, end, t);
    t -= step;
  }
  return t;
}

/// The impacts with their derivatives with respect to one parameter.
struct TrueImpacts {
  int count = 0;
  D angle[3], time[3], impulse[3], velocity[3], angular[3];
  Digits50 turning[3]{};  ///< sum of the magnitudes of the terms of `angular`, where friction and reaction cancel
  oracle::RodFlight<Digits50> last{};
};

/// @param found gives the number of impacts and where to look for them
TrueImpacts solve(const oracle::RodCase<Digits50>& rod, const RodImpacts& found, Parameter parameter) {
  TrueImpacts out;
  out.count = found.count;
  oracle::RodMotion<Digits50> motion(rod, parameter);
  End end = End::a;
  Digits50 turning = 0;
  for (int i = 0; i < found.count; ++i) {
    if (i > 0) {
      end = other(end);
      out.time[i] = motion.fly(end, arrival(motion.values(), end, found.time[i]));
    }
    const D inclination = motion.flight().inclination;
    out.angle[i] = inclination.value < 0 ? -inclination : inclination;
    out.impulse[i] = motion.strike(end);
    out.velocity[i] = motion.flight().normal;
    out.angular[i] = motion.flight().angular;
    turning += 6 * out.impulse[i].value * (cos(inclination.value) + abs(rod.impulse_ratio * sin(inclination.value)));
    out.turning[i] = std::max(turning, Digits50(1e-30));  // at 90° the digits of π leave 1e-50 of a cosine that is 0
  }
  out.last = motion.values();
  return out;
}

/// visit(number found, the true one, the size that its error is relative to)
void for_each_number(const RodImpacts& found, const TrueImpacts& truth, const auto& visit) {
  const Digits50 speed = std::max(Digits50(1), Digits50(abs(truth.velocity[0].value)));
  for (int i = 0; i < truth.count; ++i) {
    if (i > 0) {
      visit(found.angle[i], truth.angle[i], truth.angle[i].value);
      visit(found.time[i], truth.time[i], truth.time[i].value);
    }
    visit(found.impulse[i], truth.impulse[i], Digits50(abs(truth.impulse[i].value)));
    visit(found.velocity[i], truth.velocity[i], speed);
    visit(found.angular[i], truth.angular[i], truth.turning[i]);
  }
}

double error(const RodImpacts& found, const TrueImpacts& truth) {
  double worst = 0;
  for_each_number(found, truth, [&](double value, const D& true_value, const Digits50& size) {
    const double off = static_cast<double>(abs(value - true_value.value) / size);
    if (!(off <= worst)) worst = off;
  });
  return worst;
}

double condition(const oracle::RodCase<Digits50>& rod, const RodImpacts& found) {
  double sum = 0;
  for (const Parameter parameter :
       {Parameter::theta, Parameter::gravity_number, Parameter::restitution, Parameter::impulse_ratio}) {
    const Digits50 value = value_of(rod, parameter);
    if (value == 0) continue;
    double worst = 0;
    for_each_number(found, solve(rod, found, parameter), [&](double, const D& true_value, const Digits50& size) {
      worst = std::max(worst, static_cast<double>(abs(value * true_value.slope) / size));
    });
    sum += worst;
  }
  return sum;
}

/// Whether the other end stays above the ground at its first turning point.
bool misses(const TrueImpacts& truth) {
  const Digits50 rounding = 64 * 0x1p-52;
  const oracle::RodFlight<Digits50>& rod = truth.last;
  const Digits50 lowest = turning_heights(rod, truth.count == 2 ? End::b : End::a).far;
  const Digits50 size = rod.centre + abs(rod.normal / rod.angular);
  return lowest > -rounding * size;
}

/// The largest residual so far.  A vanishing size belongs to a residual that vanishes too.
class Worst {
 public:
  void operator()(const char* law, std::size_t row, Wide off, Wide size) {
    double part = off == 0 ? 0 : static_cast<double>(std::fabs(off) / size);
    if (!std::isfinite(part)) part = infinite;
    if (!(part > value)) return;
    value = part;
    name = fmt::format("{}, impact {}", law, row + 1);
  }
  double value = 0;
  std::string name;
};

struct Place {
  Wide along, across;
};

class Walk {
 public:
  Walk(const Drop& drop, const Sequence& sequence) : drop_(drop), rows_(sequence.rows) {}

  Retrace run() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (i > 0) flight(i);
      place(i);
      impact(i);
      energy(i);
      momentum(i);
    }
    out_.residual = worst_.value;
    out_.worst = worst_.name;
    return out_;
  }

 private:
  /// Inclination at the impact, whole turns of the flight included.
  [[nodiscard]] Wide inclination(std::size_t i) const {
    return i == 0 ? rows_[0].inclination : rows_[i].flight.arrival.inclination;
  }

  [[nodiscard]] Place place_of(int vertex, std::size_t i) const {
    const analytic::Vertex& v = drop_.body.vertices[static_cast<std::size_t>(vertex)];
    // An inclination that came in degrees has its own sine and cosine, exact at 90°.
    const Wide sine = i == 0 ? Wide(drop_.inclination.sine) : std::sin(inclination(i));
    const Wide cosine = i == 0 ? Wide(drop_.inclination.cosine) : std::cos(inclination(i));
    return {v.x * cosine - v.z * sine, v.x * sine + v.z * cosine};
  }

  void flight(std::size_t i) {
    const ImpactRow &last = rows_[i - 1], &row = rows_[i];
    const Wide t = row.flight.arrival.time, g = drop_.gravity;
    const analytic::PlanarVelocity &from = last.impact.after, &to = row.before;
    worst_("start", i, row.start - last.start - t, Wide(row.start) + last.start);
    worst_("fall", i, to.normal - (from.normal - g * t), std::fabs(from.normal) + g * t);
    worst_("tangential flight", i, Wide(to.tangential) - from.tangential, speed(last));
    worst_("turning", i, Wide(to.angular) - from.angular, speed(last) / drop_.body.reach());
    rise_ = std::fabs(from.normal) * t + g * t * t / 2 + last.centre_height;
    turn_ = std::fabs(from.angular * t) + std::fabs(Wide(last.inclination));
    worst_("turn", i, inclination(i) - (last.inclination - from.angular * t), turn_);
    worst_("parabola", i, row.centre_height - (last.centre_height + from.normal * t - g * t * t / 2), rise_);
  }

  void place(std::size_t i) {
    for (int v = 0; v < drop_.body.vertex_count; ++v) {
      const Place d = place_of(v, i);
      const Wide height = rows_[i].centre_height + d.across;
      const Wide size = (i > 0 ? rise_ + turn_ * std::fabs(d.along) : Wide(0)) + std::fabs(d.across);
      const bool arrives = rows_[i].vertices >> v & 1;
      if (!arrives && height >= 0) continue;
      worst_(arrives ? "arriving vertex" : "vertex below the ground", i, height, size);
      const double off = static_cast<double>(std::fabs(height) / drop_.body.reach());
      if (!(off <= out_.placement)) out_.placement = off;
    }
  }

  [[nodiscard]] Wide speed(const ImpactRow& row) const {
    const Wide reach = drop_.body.reach();
    return std::fabs(Wide(row.impact.after.normal)) + std::fabs(Wide(row.impact.after.tangential)) +
           std::fabs(reach * row.impact.after.angular) + std::fabs(Wide(row.before.normal)) +
           std::fabs(Wide(row.before.tangential)) + std::fabs(reach * row.before.angular);
  }

  void impact(std::size_t i) {
    const ImpactRow& row = rows_[i];
    const analytic::Impact& hit = row.impact;
    const Wide m = drop_.body.mass, total = speed(row);
    worst_("normal momentum", i, Wide(hit.normal_impulse) / m - (Wide(hit.after.normal) - row.before.normal), total);
    worst_("tangential momentum", i,
           Wide(hit.tangential_impulse) / m - (Wide(hit.after.tangential) - row.before.tangential), total);
    if (!(hit.normal_impulse >= 0)) worst_("pulling impulse", i, 1, 0);
    if (std::popcount(row.vertices) != 1) return;
    const Place d = place_of(std::countr_zero(row.vertices), i);
    const Wide k = drop_.body.gyration_square, reach = drop_.body.reach();
    const Wide twist = (hit.tangential_impulse * d.across - hit.normal_impulse * d.along) / m / k;
    worst_("angular momentum", i, reach * (twist - (Wide(hit.after.angular) - row.before.angular)), total);
    worst_("approach", i, hit.approach_speed + (row.before.normal - row.before.angular * d.along), total);
    worst_("separation", i, hit.separation_speed - (hit.after.normal - hit.after.angular * d.along), total);
    if (drop_.law.law == RestitutionLaw::newton)
      worst_("restitution", i, hit.separation_speed - Wide(drop_.law.restitution) * hit.approach_speed, total);
    friction(i, d);
  }

  void friction(std::size_t i, const Place& d) {
    const ImpactRow& row = rows_[i];
    const analytic::Impact& hit = row.impact;
    // Products below the smallest double are rounded to a multiple of it.
    const Wide least = 4 * std::numeric_limits<double>::denorm_min();
    const Wide value = drop_.law.friction_value, normal = hit.normal_impulse, along = hit.tangential_impulse;
    const Wide slip = hit.after.tangential + hit.after.angular * d.across;
    if (drop_.law.friction == FrictionKind::none) worst_("friction", i, along, normal);
    if (drop_.law.friction == FrictionKind::impulse_ratio)
      worst_("impulse ratio", i, along - value * normal, std::fabs(value * normal));
    if (drop_.law.friction != FrictionKind::coulomb) return;
    const Wide beyond = std::fabs(along) - value * normal;
    if (std::fabs(beyond) <= least) return;
    if (beyond > 0) worst_("Coulomb's bound", i, beyond, value * normal);
    if (hit.mode == ImpactMode::stick || hit.mode == ImpactMode::slip_stick) worst_("sticking", i, slip, speed(row));
    if (hit.mode == ImpactMode::slip) worst_("slipping", i, beyond, value * normal);
  }

  void energy(std::size_t i) {
    const ImpactRow& row = rows_[i];
    const Wide first = rows_[0].energy_before;
    const Wide m = drop_.body.mass, v = row.before.normal;
    if (m * v * v / 2 > std::numeric_limits<double>::max()) return;  // no energy to check: it is no double
    const Wide size = Wide(row.energy_before) + row.energy_after;
    worst_("energy lost", i, Wide(row.energy_before) - row.energy_after - row.impact.energy_loss, size);
    const bool gains = drop_.law.friction == FrictionKind::impulse_ratio;
    if (!gains && row.impact.energy_loss < 0) worst_("energy gained", i, row.impact.energy_loss, size);
    lost_ += row.impact.energy_loss;
    const double drift = static_cast<double>(std::fabs(row.energy_after - (first - lost_)) / first);
    if (!(drift <= out_.energy_drift)) out_.energy_drift = std::isfinite(drift) ? drift : infinite;
  }

  void momentum(std::size_t i) {
    const ImpactRow& row = rows_[i];
    impulse_ += row.impact.normal_impulse;
    const Wide change = Wide(row.impact.after.normal) - rows_[0].before.normal + Wide(drop_.gravity) * row.start;
    out_.momentum_drift = static_cast<double>(std::fabs(impulse_ - drop_.body.mass * change) / impulse_);
  }

  const Drop& drop_;
  const std::vector<ImpactRow>& rows_;
  Worst worst_;
  Retrace out_;
  Wide rise_ = 0, turn_ = 0;  ///< sizes of the terms of the last flight
  Wide lost_ = 0, impulse_ = 0;
};

using Components = std::array<Wide, 4>;  // of a unit quaternion, scalar first
constexpr int order = 22;                // of the Taylor series

Components product(const Components& a, const Components& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3], a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]};
}

Wide norm(const std::array<Wide, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

RodImpacts rod_impacts(const analytic::ContactAngles& angles) {
  RodImpacts out{.count = angles.impacts()};
  out.angle[0] = angles.theta.radians;
  out.angle[1] = angles.beta.angle;
  out.angle[2] = angles.gamma.angle;
  out.time[1] = angles.beta.time;
  out.time[2] = angles.gamma.time;
  for (int i = 0; i < out.count; ++i) {
    out.impulse[i] = angles.impulse[i];
    out.velocity[i] = angles.velocity[i];
    out.angular[i] = angles.angular[i];
  }
  return out;
}

RodImpacts rod_impacts(const analytic::Sequence& sequence) {
  RodImpacts out;
  for (const analytic::ImpactRow& row : sequence.rows) {
    const int i = out.count;
    if (i == 3 || row.vertices != (i == 1 ? 2 : 1)) break;
    out.angle[i] = row.contact_angle;
    out.time[i] = row.flight.arrival.time;
    out.impulse[i] = row.impact.normal_impulse;
    out.velocity[i] = row.impact.after.normal;
    out.angular[i] = row.impact.after.angular;
    ++out.count;
  }
  return out;
}

RodError rod_error(const RodStart& start, const RodImpacts& impacts) {
  const oracle::RodCase<Digits50> rod = exact(start);
  const TrueImpacts truth = solve(rod, impacts, Parameter::theta);
  const analytic::RodParameters& p = start.parameters;
  const bool elastic = p.gravity_number == 0 && p.restitution == 1 && p.impulse_ratio == 0;
  return {.error = error(impacts, truth),
          .condition = condition(rod, impacts),
          .ends_rightly = !elastic || impacts.count == 3 || misses(truth)};
}

long double exact_restitution(long double damping_number) {
  return static_cast<long double>(oracle::exact_restitution(Digits50(damping_number)));
}

Retrace retrace(const analytic::Drop& drop, const analytic::Sequence& sequence) { return Walk(drop, sequence).run(); }

PeriodicSpin::PeriodicSpin(const std::array<double, 3>& moments, const std::array<double, 3>& angular_velocity) {
  for (std::size_t i = 0; i < 3; ++i) {
    start_.moments[i] = moments[i];
    start_.w[i] = angular_velocity[i];
    axis_[i] = start_.moments[i] * start_.w[i];
  }
  const Wide momentum = norm(axis_);
  for (Wide& component : axis_) component /= momentum;
  longest_step_ = Wide(0.25) / norm(start_.w);
  find_period();
  find_angle();
}

PeriodicSpin::Top PeriodicSpin::advance(Top top, Wide time) const {
  oracle::TopSeries<Wide> series(order);
  const Wide steps = std::ceil(std::fabs(time) / longest_step_);
  for (Wide i = 0; i < steps; i += 1) series.step(top, time / steps);
  return top;
}

/// The second return of ω₂ to zero, which it then passes as at the start.
void PeriodicSpin::find_period() {
  const auto& m = start_.moments;
  oracle::TopSeries<Wide> series(order);
  Top top = start_;
  int changes = 0;
  Wide t = 0;
  while (changes < 2) {
    const bool was_positive = top.w[1] > 0;
    series.step(top, longest_step_);
    if (t > 0 && (top.w[1] > 0) != was_positive) ++changes;
    t += longest_step_;
  }
  for (int i = 0; i < 20; ++i) {
    const Wide rate = (m[2] - m[0]) / m[1] * top.w[2] * top.w[0];
    const Wide correction = -top.w[1] / rate;
    if (!(std::fabs(correction) > 1e-19L * t)) break;
    t += correction;
    top = advance(top, correction);
  }
  period_ = t;
}

/// Attitude after a period = turn by ψ about the momentum; only ψ/2 modulo 2π matters.
void PeriodicSpin::find_angle() {
  const Components after = advance(start_, period_).q;
  Wide sine = 0;
  for (std::size_t i = 0; i < 3; ++i) sine += axis_[i] * after[i + 1];
  angle_ = 2 * std::atan2(sine, after[0]);
}

double PeriodicSpin::error(const numeric::Rotation& rotation, double time) const {
  const Wide periods = std::round(time / period_);
  const Top rest = advance(start_, std::fma(-periods, period_, static_cast<Wide>(time)));
  const Wide half = std::remainder(periods * angle_ / 2, 2 * std::numbers::pi_v<Wide>);
  const Components turn{std::cos(half), std::sin(half) * axis_[0], std::sin(half) * axis_[1],
                        std::sin(half) * axis_[2]};
  const Components exact = product(turn, rest.q);
  const auto& a = rotation.attitude;
  const double found[4] = {a.w(), a.x(), a.y(), a.z()};
  Wide same = 0, other = 0, worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    same = std::fmax(same, std::fabs(found[i] - exact[i]));
    other = std::fmax(other, std::fabs(found[i] + exact[i]));
  }
  for (std::size_t i = 0; i < 3; ++i)
    worst = std::fmax(worst, std::fabs(rotation.angular_velocity[static_cast<int>(i)] - rest.w[i]) / norm(rest.w));
  if (!rotation.attitude.coeffs().allFinite() || !rotation.angular_velocity.allFinite()) return std::nan("");
  return static_cast<double>(std::fmax(worst, std::fmin(same, other)));
}

}  // namespace clatter::validation
