// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <numbers>

#include "analytic/space/sequence/sequence.hpp"
#include "validation/evidence/extreme_cases.hpp"
#include "validation/oracles/free_top.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::Vector3;
using Wide = Eigen::Matrix<long double, 3, 1>;
using RoundTop = oracle::Top<long double>;

/// A law of motion has some ten roundings on the way to the row, and a flight one more for each radian.
constexpr double ulps_of_laws = 64;
/// Sequences extrapolate the end of an accumulation to these digits of what is left.
constexpr int digits_of_end = 6;

/// Lowest point of a rim above the ground, for the vertical in body axes and the height of the centre of mass.
long double rim_height(const space::Rim& rim, const Wide& up, long double centre) {
  const Wide axis = rim.axis.cast<long double>();
  return centre + up.dot(rim.centre.cast<long double>()) - rim.radius * up.cross(axis).norm();
}

/// A flight of a round body by Taylor series of Euler's equations at 64 bits.
class RoundFlight {
 public:
  RoundFlight(const space::Drop& drop, const space::State& from) : drop_(drop), from_(from) {
    const Vector3 w = from.attitude.conjugate() * from.angular_velocity;
    const space::Quaternion& q = from.attitude;
    top_.q = {q.w(), q.x(), q.y(), q.z()};
    for (std::size_t k = 0; k < 3; ++k) {
      top_.w[k] = w[static_cast<int>(k)];
      top_.moments[k] = drop.body.inertia(static_cast<int>(k), static_cast<int>(k));
    }
  }

  [[nodiscard]] double turned(double time) const { return from_.angular_velocity.norm() * time; }
  /// Height of the lower rim after `time`, and in `lowest` the least of it on the way, in steps of a fiftieth radian.
  [[nodiscard]] long double height_at(double time, long double& lowest) const {
    RoundTop top = top_;
    oracle::TopSeries<long double> series(24);
    const int steps = 1 + static_cast<int>(3 * turned(time)), parts = 16;
    const long double part = static_cast<long double>(time) / steps / parts;
    long double height = 0;
    for (int i = 0; i < steps * parts; ++i) {
      if (i % parts == 0) {
        if (i > 0) series.evaluate(top, part * parts);
        series.expand(top);
      }
      RoundTop then = top;
      series.evaluate(then, part * (i % parts + 1));
      height = lower_rim(then, part * (i + 1));
      lowest = std::fmin(lowest, height);
    }
    return height;
  }

 private:
  [[nodiscard]] long double lower_rim(const RoundTop& top, long double t) const {
    const Eigen::Quaternion<long double> q(top.q[0], top.q[1], top.q[2], top.q[3]);
    const Wide up = q.normalized().conjugate() * Wide(0, 0, 1);
    const long double centre = from_.position.z() + t * (from_.velocity.z() - drop_.gravity / 2 * t);
    return std::fmin(rim_height(drop_.body.rims[0], up, centre), rim_height(drop_.body.rims[1], up, centre));
  }

  const space::Drop& drop_;
  const space::State from_;
  RoundTop top_;
};

/// Largest residual of a law of motion, relative to the sizes of its terms: both momentum balances, and at the end of
/// each flight the lower rim on the ground, before it none below.
double round_residual(const space::Drop& drop, const std::vector<space::ImpactRow>& rows) {
  const double mass = drop.body.mass, reach = drop.body.reach();
  double worst = 0;
  const auto take = [&](double residual) { worst = residual <= worst ? worst : residual; };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const space::ImpactRow& row = rows[i];
    const space::State after = state_after(row);
    const Vector3 &impulse = row.impact.impulse, change = after.angular_velocity - row.before.angular_velocity;
    const space::Matrix3 axes = row.before.attitude.toRotationMatrix();
    const Vector3 arm = axes * row.corners.front().place;
    const double speed = row.before.velocity.norm() + after.velocity.norm() +
                         reach * (row.before.angular_velocity.norm() + after.angular_velocity.norm());
    take((after.velocity - row.before.velocity - impulse / mass).norm() / speed);
    const Vector3 moment = row.group ? row.group->moment : Vector3(arm.cross(impulse));
    take((axes * (drop.body.inertia * (axes.transpose() * change)) - moment).norm() / (mass * reach * speed));
    if (i + 1 == rows.size()) break;
    const RoundFlight flight(drop, after);
    const double time = rows[i + 1].flight.time, share = 1 + flight.turned(time);
    long double lowest = 0;
    const long double height = flight.height_at(time, lowest);
    take(static_cast<double>(std::fabs(height) / reach) / share);
    take(static_cast<double>(-lowest / reach) / share);
  }
  return worst;
}

space::Drop round_drop(const space::Cylinder& shape, double elevation) {
  const space::Body body = space::cylinder(1, shape);
  return {.body = body,
          .attitude = space::Quaternion(Eigen::AngleAxisd(-elevation, Vector3::UnitY())),
          .velocity = {0.1, 0.05, -1},
          .angular_velocity = Vector3(0.3, 0.2, 2) / body.reach(),
          .gravity = 9.81,
          .law = {.restitution = 0.7,
                  .law = analytic::RestitutionLaw::stronge,
                  .friction = analytic::FrictionKind::coulomb,
                  .friction_value = 0.2}};
}

CellMeasure by_flights(const space::Drop& drop) {
  CellMeasure measure{.bound = ulps_of_laws * eps, .oracle = "laws of motion and flights by Taylor series at 64 bits"};
  measure.error = round_residual(drop, timed_sequence(drop, {.impacts = 6, .amplification = false}, measure).rows);
  return measure;
}

/// Level bounces of a disc without spin: T = 2 e u/(g (1 − e)), P = m (u + g T); with e = 1 those of the rows.  Errors
/// are relative to an elastic hop at least: speeds below the rounding of the first one are none.
CellMeasure by_geometric_series(double restitution) {
  space::Drop drop = round_drop({.length = 0.2, .radius = 1}, std::numbers::pi / 2);
  drop.angular_velocity.setZero();
  drop.law = {.restitution = restitution};
  CellMeasure measure{.bound = ulps_of_laws * eps, .oracle = "sum of the geometric series"};
  const space::Sequence sequence = timed_sequence(drop, {.impacts = 4, .amplification = false}, measure);
  const auto e = static_cast<long double>(restitution), hop = 2 / static_cast<long double>(drop.gravity);
  const long double time = restitution < 1 ? hop * e / (1 - e) : 3 * hop;
  const long double impulse = restitution < 1 ? 1 + drop.gravity * time : 8;
  const double end = sequence.tail ? sequence.tail->end_time : sequence.rows.back().start;
  const auto off = [&](double found, long double exact) {
    return static_cast<double>(std::fabs(found - exact) / std::fmax(exact, hop));
  };
  measure.error = std::fmax(off(end, time), off(sequence.total_normal_impulse, impulse));
  return measure;
}

/// A tilted disc that rattles on its rim: its end, extrapolated early, against the one that many more hops give.
CellMeasure by_more_hops(double restitution) {
  space::Drop drop = round_drop({.length = 0.2, .radius = 1}, std::numbers::pi / 2 - 0.3);
  drop.law.restitution = restitution;
  CellMeasure measure{.bound = std::pow(10.0, -digits_of_end), .oracle = "the same after as many hops as doubles tell"};
  constexpr int hops = 4000;
  const auto early = timed_sequence(drop, {.impacts = hops, .digits = digits_of_end, .amplification = false}, measure);
  CellMeasure late_measure;
  const auto late = timed_sequence(drop, {.impacts = hops, .digits = 13, .amplification = false}, late_measure);
  if (early.tail.has_value() != late.tail.has_value()) throw analytic::NumericalError("only one of two runs ends");
  if (!early.tail) throw analytic::OutsideModelError("its hops come to no end: " + early.message);
  measure.error = std::fabs(early.tail->end_time / late.tail->end_time - 1);
  return measure;
}

CellMeasure rim_cell(const std::string& axis, double value) {
  if (axis == "disc") return by_flights(round_drop({.length = 0.2, .radius = 1}, std::numbers::pi / 2 - value));
  if (axis == "needle") return by_flights(round_drop({.length = 1, .radius = 0.01}, value));
  if (axis == "slenderness") return by_flights(round_drop({.length = 2 * value, .radius = 1}, 0.5));
  return axis == "bounces" ? by_geometric_series(value) : by_more_hops(value);
}

}  // namespace

std::vector<ExtremeCase> rim_cases(const MapAxis& axis) {
  std::vector<ExtremeCase> cases;
  add_cases(cases, axis, ModelLevel::discrete_in_space,
            [name = axis.name](double value, const CellClock&) { return rim_cell(name, value); });
  return cases;
}

}  // namespace clatter::validation
