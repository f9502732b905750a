// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/error_growth.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/flight/flight_derivatives.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

namespace {

/// Relative step of central differences: rounding leaves ten digits, the second order twelve.
constexpr double relative_step = 1e-6;
/// Largest error of an attitude [rad], and share of a velocity, that counts as first order.
constexpr double first_order = 0.02;

Quaternion turned(const Vector3& angle, const Quaternion& attitude) {
  return (Quaternion(1, angle[0] / 2, angle[1] / 2, angle[2] / 2) * attitude).normalized();
}

State shifted(const State& state, int number, double step) {
  State s = state;
  const int axis = number % 3;
  if (number < 3) s.attitude = turned(step * Vector3::Unit(axis), s.attitude);
  else if (number < 6) s.velocity[axis] += step;
  else s.angular_velocity[axis] += step;
  return s;
}

/// A factor of errors that are independent.
auto diagonal(const Eigen::Matrix<double, 10, 1>& deviations) -> Eigen::Matrix<double, 10, 10> {
  return deviations.asDiagonal();
}

/// Bounds are this many standard deviations of the errors assumed.
constexpr double deviations = 3;
/// A factor of errors in each direction with these bounds.
Eigen::Matrix<double, 10, 10> factor_of(const StateErrors& errors) {
  return diagonal(errors.in_each_direction() / deviations);
}

/// Rounding of an impulse with friction, relative: half of what impact.hpp promises, as a standard deviation.
constexpr double friction_rounding = 5e-14;
/// The same for what face_friction.hpp promises.
constexpr double face_rounding = 5e-13;

/// Bound on the length of a vector whose errors are these combinations of independent ones.
double bound(const auto& image) {
  const double value = deviations * image.norm();
  return std::isfinite(value) ? value : infinite;
}

/// Rounding of the row's impulse by its path, relative, as a standard deviation.
double path_rounding(const ImpactRow& row) {
  if (row.impact.path == PathKind::frictionless) return 8 * epsilon;
  return row.group ? std::fmax(face_rounding, row.group->path_error) : friction_rounding;
}

/// Whether the row's corner has returned from a hop with an approach speed of relative accuracy.
bool is_hop(const ImpactRow& row) {
  return !row.group && row.flight.is_hop && row.impact.contact_before.z() == row.flight.normal_velocity;
}

}  // namespace

ErrorGrowth::ErrorGrowth(const Body& body, const State& start, double gravity, double gravity_along)
    : body_(body), gravity_(gravity), gravity_along_(gravity_along), inverse_inertia_(body.inertia.inverse()),
      factor_(size, 0), arriving_(size, 0), leaving_(size, 0) {
  Deviations d;
  d << 0, Vector3::Constant(epsilon), epsilon * start.velocity.cwiseAbs(), epsilon * start.angular_velocity.cwiseAbs();
  append(diagonal(d));
  of_drop_.setZero();
  for (int k = 0; k < 3; ++k) {
    of_drop_(1 + k, k) = 1;
    of_drop_(4 + k, 3 + k) = start.velocity.norm();
    of_drop_(7 + k, 6 + k) = start.angular_velocity.norm();
  }
}

/// L of F = L Qᵀ, Q orthogonal, so that L Lᵀ = F Fᵀ: by reflections of the rows of F, which lie in memory as columns.
ErrorGrowth::Factor ErrorGrowth::triangular(const Factor& factor) {
  Eigen::Matrix<double, Eigen::Dynamic, size, Eigen::ColMajor, most_columns, size> rows = factor.transpose();
  for (int k = 0; k < size; ++k) {
    auto row = rows.col(k).tail(rows.rows() - k);
    const double largest = row.cwiseAbs().maxCoeff();  // squares of the rest would underflow without it
    if (!(largest > 0)) continue;
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_columns, 1> mirror = row / largest;
    const double length = std::copysign(mirror.norm(), mirror[0]);
    mirror[0] += length;
    const double twice = 2 / mirror.squaredNorm();
    for (int j = k + 1; j < size; ++j) {
      auto other = rows.col(j).tail(rows.rows() - k);
      other -= twice * mirror.dot(other) * mirror;
    }
    row.setZero();
    row[0] = -length * largest;
  }
  return rows.topRows<size>().transpose();
}

void ErrorGrowth::append(const Factor& columns) {
  Factor wider(size, factor_.cols() + columns.cols());
  wider << factor_, columns;
  factor_ = wider.cols() > 2 * size ? triangular(wider) : wider;
}

/// What rounding of the impulse, δP in each direction, does to the state: δV = δP/m, δω = I⁻¹ (r × δP).
ErrorGrowth::Factor ErrorGrowth::impulse_rounding(const ImpactRow& row) const {
  double speed = row.before.velocity.norm() + row.before.angular_velocity.norm() * body_.reach();
  // P is of degree one in the velocity of the corner, the normal part of which is a hop's.
  if (is_hop(row)) speed *= std::fmin(1, row.impact.impulse.norm() / (body_.mass * row.impact.contact_before.norm()));
  const double rounding = path_rounding(row) * row.impact.impulse.norm() + 8 * epsilon * body_.mass * speed;
  const Matrix3 axes = row.before.attitude.toRotationMatrix();
  const Matrix3 lever = axes * inverse_inertia_ * axes.transpose() * cross_matrix(axes * row.corners.front().place);
  // The inverse inertia in world axes errs by its largest element.
  const double turning =
      2 * epsilon * inverse_inertia_.norm() * (axes * row.corners.front().place).cross(row.impact.impulse).norm();
  Factor columns = Factor::Zero(size, 6);
  columns.block<3, 3>(4, 0) = rounding / body_.mass * Matrix3::Identity();
  columns.block<3, 3>(7, 0) = rounding * lever;
  columns.block<3, 3>(7, 3) = turning * Matrix3::Identity();
  return columns;
}

double ErrorGrowth::approach_rounding(const ImpactRow& row) const {
  if (is_hop(row)) return row.flight.velocity_error;
  return 4 * epsilon * (row.before.velocity.norm() + row.before.angular_velocity.norm() * body_.reach());
}

/// Takes from errors of the state what they do to the corner's normal velocity, which is carried beside the state and
/// errs by `rounding` instead.
ErrorGrowth::Factor ErrorGrowth::without_approach(Factor columns, const Gradient& approach, double rounding) {
  columns.row(6) -= approach.lazyProduct(columns).eval();
  columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
  columns.rightCols<1>().setZero();
  columns(6, columns.cols() - 1) = rounding;
  return columns;
}

/// δu, u = V_z + (ω × r)_z at the row's corner, for the angular velocity before or after; a turn moves the lowest point
/// of a rim along the rim as well.
ErrorGrowth::Gradient ErrorGrowth::approach_gradient(const Quaternion& attitude, const Corner& corner,
                                                     const Vector3& turning) const {
  Matrix3 arm = -cross_matrix(attitude * corner.place);
  Gradient approach = Gradient::Zero();
  approach[6] = 1;
  approach.tail<3>() = arm.row(2);
  if (!(corner.radius > 0)) arm += shift_of_lowest_point(body_, attitude, corner.index);
  approach.segment<3>(1) = cross_matrix(turning).row(2) * arm;
  return approach;
}

/// P is differentiated by the corner's velocity and the attitude, each on its own scale, so that small hops lose
/// nothing.
StrikeDerivatives ErrorGrowth::corner_differences(const Strike& strike, const ImpactRow& row) const {
  const Vector3& v = row.impact.contact_before;
  const Corner& corner = row.corners.front();
  State at_corner = row.before;  // of a body that moves with the corner's velocity and does not turn
  at_corner.velocity = v;
  at_corner.angular_velocity.setZero();
  const double room = relative_step * steepness(body_, row.before.attitude, corner.index);
  const double along = relative_step * v.norm(), across = relative_step * std::fabs(v.z());
  const auto slope = [&](int number, double step) -> Vector3 {
    return (strike(shifted(at_corner, number, step)).impulse - strike(shifted(at_corner, number, -step)).impulse) /
           (2 * step);
  };
  ImpulseSlopes slopes;
  slopes.of_turns << slope(0, room), slope(1, room), slope(2, room);
  slopes.of_velocity << slope(3, along), slope(4, along), slope(5, across);
  return strike_derivatives(body_, row.before, corner, row.impact.impulse, slopes);
}

StrikeDerivatives ErrorGrowth::group_differences(const Strike& strike, const ImpactRow& row) const {
  const double reach = body_.reach();
  const double speed = row.impact.contact_before.norm();
  const double turning = row.before.angular_velocity.norm() * reach;
  const double steps[3] = {relative_step * std::fmin(1, speed / std::fmax(turning, speed)), relative_step * speed,
                           relative_step * speed / reach};
  StrikeDerivatives derivatives = StrikeDerivatives::Zero();
  for (int k = 0; k < 9; ++k) {
    // What neither errs nor is varied, as the spin of a drop without any, needs no impacts beside this one.
    if (factor_.row(1 + k).isZero(0) && of_drop_.row(1 + k).isZero(0)) continue;
    const double step = steps[k / 3];
    const Impact plus = strike(shifted(row.before, k, step)), minus = strike(shifted(row.before, k, -step));
    derivatives.col(k) << plus.impulse - minus.impulse, plus.velocity_after - minus.velocity_after,
        plus.angular_velocity_after - minus.angular_velocity_after;
    derivatives.col(k) /= 2 * step;
  }
  return derivatives;
}

/// Beside corners on the ground, which errors leave there, an impact is smooth in those directions only.
ErrorGrowth::Struck ErrorGrowth::differences_along_errors(const Strike& strike, const ImpactRow& row) const {
  const double reach = body_.reach(), speed = row.before.velocity.norm() + row.before.angular_velocity.norm() * reach;
  Struck struck = Struck::Zero(9, factor_.cols());
  for (Eigen::Index k = 0; k < factor_.cols(); ++k) {
    const Eigen::Matrix<double, 9, 1> error = factor_.col(k).tail<9>();
    const double length =
        error.head<3>().norm() + (error.segment<3>(3).norm() + reach * error.tail<3>().norm()) / speed;
    if (!(length > 0)) continue;
    const double step = relative_step / length;
    const auto struck_at = [&](double by) {
      State s = row.before;
      s.attitude = turned(by * error.head<3>(), s.attitude);
      s.velocity += by * error.segment<3>(3);
      s.angular_velocity += by * error.tail<3>();
      const Impact impact = strike(s);
      Eigen::Matrix<double, 9, 1> all;
      all << impact.impulse, impact.velocity_after, impact.angular_velocity_after;
      return all;
    };
    struck.col(k) = (struck_at(step) - struck_at(-step)) / (2 * step);
  }
  return struck;
}

ErrorGrowth::EnergyGradients ErrorGrowth::energy_gradients(const ImpactRow& row, const Matrix3& inertia) const {
  const State& before = row.before;
  const Vector3 arm = before.attitude * row.corners.front().place;
  const Vector3 &w = before.angular_velocity, &w_after = row.impact.angular_velocity_after;
  const Vector3 momentum = inertia * w;
  EnergyGradients e;
  e.before.segment<3>(1) = momentum.cross(w).transpose() + body_.mass * gravity_ * cross_matrix(arm).row(2);
  e.before.segment<3>(4) = body_.mass * before.velocity.transpose();
  e.before.segment<3>(7) = momentum.transpose();
  e.after.segment<3>(1) =
      (inertia * w_after).cross(w_after).transpose() + body_.mass * gravity_ * cross_matrix(arm).row(2);
  return e;
}

void ErrorGrowth::fill(const Struck& struck, ImpactRow& row) const {
  const State& before = row.before;
  const Vector3& w = before.angular_velocity;
  const Matrix3 axes = before.attitude.toRotationMatrix(), inertia = axes * body_.inertia * axes.transpose();
  const auto [energy, energy_of_turn] = energy_gradients(row, inertia);
  const Vector3 momentum_after = inertia * row.impact.angular_velocity_after;
  const Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most_columns> energy_after =
      energy_of_turn.lazyProduct(factor_) +
      body_.mass * row.impact.velocity_after.transpose().lazyProduct(struck.middleRows<3>(3)) +
      momentum_after.transpose().lazyProduct(struck.bottomRows<3>());
  const Factor rounding = impulse_rounding(row);
  const double in_velocity = deviations * rounding.middleRows(4, 3).norm();
  const double in_turning = deviations * rounding.bottomRows(3).norm();
  const double size_of_energy = std::fabs(row.energy_before) + std::fabs(row.energy_after);
  RowErrors& e = row.error;
  e.predictable = true;
  e.start = row.start == 0 ? 0 : bound(factor_.row(0)) + epsilon * row.start;
  e.attitude = bound(factor_.middleRows<3>(1)) + 4 * epsilon;
  e.approach_speed = bound(approach_gradient(row.before.attitude, row.corners.front(), w).lazyProduct(factor_)) +
                     approach_rounding(row);
  e.impulse = bound(struck.topRows<3>()) + body_.mass * in_velocity;
  e.velocity_after = bound(struck.middleRows<3>(3)) + in_velocity + 4 * epsilon * before.velocity.norm();
  e.angular_velocity_after = bound(struck.bottomRows<3>()) + in_turning + 4 * epsilon * w.norm();
  e.energy_before = bound(energy.lazyProduct(factor_)) + 8 * epsilon * size_of_energy;
  e.energy_after = bound(energy_after) + 8 * epsilon * size_of_energy +
                   body_.mass * in_velocity * row.impact.velocity_after.norm() + in_turning * momentum_after.norm();
}

void ErrorGrowth::strike(const Strike& strike, const StrikeDerivatives& closed, ImpactRow& row) {
  row.error = {};
  row.amplification = std::numeric_limits<double>::quiet_NaN();
  const Factor arriving = std::exchange(arriving_, Factor(size, 0));
  const bool turns = row.before.angular_velocity.norm() > 0;
  // What comes down beside corners on the ground does so in neighbours, too: stay() has seen to that.
  const bool is_given = row.start == 0 && !(row.flight.time > 0);  // in the attitude of the drop
  if (row.group && !is_given && turns && row.held == 0) predictable_ = false;
  if (row.group && row.group->is_open) predictable_ = false;
  if (!predictable_) return;
  if (!(row.impact.approach_speed > 0) || row.impact.impulse.norm() == 0) return give_up();
  append(is_hop(row)
             ? without_approach(
                   arriving, approach_gradient(row.before.attitude, row.corners.front(), row.before.angular_velocity),
                   row.flight.velocity_error)
             : arriving);
  StrikeDerivatives derivatives = closed;
  Struck struck;
  try {
    if (row.held > 0) derivatives.setZero(), struck = differences_along_errors(strike, row);
    else if (!closed.allFinite())
      derivatives = row.group ? group_differences(strike, row) : corner_differences(strike, row);
  } catch (const std::runtime_error&) {  // a neighbour jams, or cannot be computed
    return give_up();
  }
  if (row.held == 0) struck = derivatives.lazyProduct(factor_.bottomRows<9>());
  if (!derivatives.allFinite() || !struck.allFinite()) return give_up();
  fill(struck, row);
  if (gravity_along_ != 0) {  // the way along the slope is no number of the state: what is known of it, rows tell
    const double of_impact = row.error.energy_before + row.error.energy_after;
    row.error.energy_before += energy_;
    energy_ += of_impact;
    row.error.energy_after += energy_;
  }
  const Eigen::Matrix<double, 9, 9> struck_drop = derivatives.lazyProduct(of_drop_.bottomRows<9>());
  const double of_time = row.start > 0 ? of_drop_.row(0).norm() / row.start : 0;
  const double of_impulse = struck_drop.topRows<3>().norm() / row.impact.impulse.norm();
  if (!resumed_) row.amplification = std::fmax(std::fmax(of_time, of_impulse), of_drop_.middleRows<3>(1).norm());
  factor_.bottomRows<6>() = struck.bottomRows<6>();
  of_drop_.bottomRows<6>() = struck_drop.bottomRows<6>();
  leaving_ = rounding_of(row);
}

void ErrorGrowth::depart() {
  if (leaving_.cols() > 0) append(std::exchange(leaving_, Factor(size, 0)));
}

ErrorGrowth::Factor ErrorGrowth::rounding_of(const ImpactRow& row) const {
  const Factor of_impulse = impulse_rounding(row);
  Deviations d;
  d << epsilon / 4 * row.start, Vector3::Constant(epsilon),
      Vector3::Constant(epsilon * (row.before.velocity.norm() + row.impact.velocity_after.norm())),
      Vector3::Constant(std::hypot(
          of_impulse(7, 3), epsilon * (row.before.angular_velocity.norm() + row.impact.angular_velocity_after.norm())));
  Factor rounding(size, 3 + size);
  rounding << of_impulse.leftCols<3>(), diagonal(d);
  if (row.group) return rounding;
  const Impact& impact = row.impact;
  return without_approach(rounding,
                          approach_gradient(row.before.attitude, row.corners.front(), impact.angular_velocity_after),
                          path_rounding(row) * impact.impulse.norm() / body_.mass + approach_rounding(row));
}

// Growth of errors along a flight, up to the touch that ends it.

void ErrorGrowth::fly(const FreeFlight& flight, const FirstContact& contact, const Vector3& from_place,
                      const Vector3& to_place) {
  if (!predictable_) return;
  depart();
  if (!(contact.time > 0)) return strike_again(flight.start(), contact, {.index = contact.point, .place = to_place});
  const double t = contact.time;
  const State now = flight.at(t);
  const auto [j, shift] = arrival_derivatives(body_, flight, contact, now, from_place, to_place);
  const double late = bound(shift.lazyProduct(factor_)) + contact.time_error;  // beside the departure
  factor_ = j.lazyProduct(factor_).eval();
  of_drop_ = j.lazyProduct(of_drop_).eval();
  const double size_of_height = body_.reach() + t * (flight.start().velocity.norm() + gravity_ * t);
  const double turned_by = 1 + 1e-3 * flight.rotation().fastest() * t;
  Deviations d;
  d << (contact.is_hop ? contact.time_error
                       : epsilon * t + 2 * epsilon * size_of_height / std::fabs(contact.normal_velocity)),
      Vector3::Constant(2 * epsilon * turned_by),
      Vector3::Constant(epsilon * (now.velocity.norm() + (gravity_ + std::fabs(gravity_along_)) * t)),
      Vector3::Constant(2 * epsilon * now.angular_velocity.norm());
  arriving_ = diagonal(d);
  // First order holds while the shift of the touch changes h′ little.
  if (!(late * std::fabs(contact.acceleration) <= first_order * std::fabs(contact.normal_velocity)) ||
      !(bound(factor_.middleRows<3>(1)) <= first_order) || contact.within_margin) {
    predictable_ = false;
  }
  if (predictable_) check_others(flight, contact, now.attitude, now.attitude * to_place);
}

ErrorGrowth::InFlight ErrorGrowth::in_flight(const FreeFlight& flight, double time, const Vector3& from) const {
  if (!predictable_) return {};
  Factor start(size, factor_.cols() + leaving_.cols());
  start << factor_, leaving_;
  const State now = flight.at(time);
  const Gradient clock = -Gradient::Unit(0);
  const Factor then = flight_derivatives(body_, flight, time, now, clock).lazyProduct(start);
  Gradient height = now.velocity.z() * clock;
  height.segment<3>(1) = cross_matrix(flight.start().attitude * from).row(2);
  height[6] = time;
  const double turned_by = 1 + 1e-3 * flight.rotation().fastest() * time;
  return {.state = {.time = 0,
                    .attitude = bound(then.middleRows<3>(1)) + 4 * epsilon * turned_by,
                    .velocity = bound(then.middleRows<3>(4)) + 4 * epsilon * (now.velocity.norm() + gravity_ * time),
                    .angular_velocity = bound(then.bottomRows<3>()) + 4 * epsilon * now.angular_velocity.norm()},
          .height = bound(height.lazyProduct(start)) +
                    8 * epsilon * (body_.reach() + time * (flight.start().velocity.norm() + gravity_ * time))};
}

double ErrorGrowth::begin_time() {
  const double error = predictable_ ? bound(factor_.row(0)) + bound(arriving_.row(0)) : infinite;
  factor_.row(0).setZero();
  arriving_.row(0).setZero();
  of_drop_.row(0).setZero();
  return error;
}

/// A corner on the ground that the last impact has driven into it strikes, too, in neighbours as well.
void ErrorGrowth::strike_again(const State& now, const FirstContact& contact, const Corner& corner) {
  arriving_ = Factor(size, 0);
  const double error = bound(approach_gradient(now.attitude, corner, now.angular_velocity).lazyProduct(factor_));
  if (contact.together.size() > 1 || !(error <= first_order * -contact.normal_velocity)) predictable_ = false;
}

/// Height of a point that neither departed nor arrived: error of attitude and of the parabola.
double ErrorGrowth::height_bound(double time) const {
  return 2 * body_.reach() * (bound(factor_.middleRows<3>(1)) + 4 * epsilon) + time * bound(factor_.row(6));
}

/// No other point may be so near the ground that the errors let it arrive first.
/// @param touching  from the centre of mass to the point that does, world frame
void ErrorGrowth::check_others(const FreeFlight& flight, const FirstContact& contact, const Quaternion& attitude,
                               const Vector3& touching) {
  const double errs = height_bound(contact.time), reach = body_.reach();
  if (!(contact.near_miss.clearance > errs)) predictable_ = false;
  const PointHeights heights(body_, flight);
  const FlightMoment moment = heights.moment(contact.time);
  for (int i = 0; i < heights.count(); ++i) {
    if (std::find(contact.together.begin(), contact.together.end(), i) != contact.together.end()) continue;
    const PointHeight h = heights.at(i, moment);
    if (!(h.velocity < 0) || h.height > errs) continue;
    // With the touching point on the ground, a turn moves others by their distance from it.
    const Vector3 arm = attitude * touching_place(body_, attitude, i) - touching;
    const double turned = bound(cross_matrix(arm).row(2).lazyProduct(factor_.middleRows<3>(1)));
    if (heights.is_round(i) || !(h.height > turned + 8 * epsilon * reach)) predictable_ = false;
  }
}

void ErrorGrowth::stay(const SustainedContact& contact, const std::optional<ContactDerivatives>& derivatives,
                       const StateErrors& before, const StateErrors& rounding) {
  if (!derivatives) predictable_ = false;
  if (!predictable_) return;
  resumed_ = true;
  arriving_ = Factor(size, 0);
  depart();
  append(factor_of(before));
  append(factor_of(rounding));
  Gradient shift = derivatives->of_state.row(0);
  shift[0] = 0;
  const double late = bound(shift.lazyProduct(factor_));
  factor_ = derivatives->of_state.lazyProduct(factor_).eval();
  // The corner that stays has no normal velocity, whatever the errors.
  const State& after = contact.after;
  const auto pivot = static_cast<std::size_t>(contact.pivots.front());
  const Corner corner{.index = contact.pivots.front(), .place = body_.vertices[pivot]};
  append(without_approach(factor_of(rounding), approach_gradient(after.attitude, corner, after.angular_velocity),
                          4 * epsilon * (after.velocity.norm() + after.angular_velocity.norm() * body_.reach())));
  if (!derivatives->hold(body_, late, bound(factor_.middleRows<3>(1)))) predictable_ = false;
}

void ErrorGrowth::restart(const StateErrors& errors) {
  predictable_ = resumed_ = true;
  factor_ = arriving_ = leaving_ = Factor(size, 0);
  append(factor_of(errors));
}

StateErrors ErrorGrowth::bounds() const {
  if (!predictable_) return {};
  return {.time = bound(factor_.row(0)),
          .attitude = bound(factor_.middleRows<3>(1)),
          .velocity = bound(factor_.middleRows<3>(4)),
          .angular_velocity = bound(factor_.bottomRows<3>())};
}

void ErrorGrowth::end_without_contact(const FirstContact& contact) {
  depart();
  if (!(contact.near_miss.clearance > height_bound(contact.near_miss.time))) predictable_ = false;
}

}  // namespace clatter::analytic::space
