// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/error_growth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "analytic/base/limits.hpp"

namespace clatter::analytic {

using detail::epsilon;

namespace {

/// Numbers that a processor computes side by side.
constexpr std::size_t lanes = 4;
using Lanes = std::array<double, lanes>;

double sum(const Lanes& parts) { return (parts[0] + parts[1]) + (parts[2] + parts[3]); }

/// Σ aᵢ bᵢ of as many numbers as fill lanes.
double product(std::span<const double> a, std::span<const double> b) {
  Lanes parts{};
  for (std::size_t k = 0; k < a.size(); k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) parts[lane] += a[k + lane] * b[k + lane];
  }
  return sum(parts);
}

/// √Σ values², also where squares would leave the doubles; infinite for NaN.
/// @param values as many as fill lanes
double norm(std::span<const double> values) {
  constexpr double least = 1e-280, most = 1e280;  // of a sum whose small terms may underflow
  const double squares = product(values, values);
  if (squares >= least && squares <= most) return std::sqrt(squares);
  if (std::isnan(squares)) return detail::infinite;
  Lanes sizes{};
  for (std::size_t k = 0; k < values.size(); k += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) sizes[lane] = std::max(sizes[lane], std::fabs(values[k + lane]));
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  if (largest == 0 || largest == detail::infinite) return largest;
  double scaled = 0;
  for (const double value : values) scaled += (value / largest) * (value / largest);
  return largest * std::sqrt(scaled);
}

/// Four columns of the rows.
using Block = std::array<Lanes, state_size>;

/// factorsᵀ block.
Lanes combined(const StateVector& factors, const Block& block) {
  Lanes result{};
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t lane = 0; lane < lanes; ++lane) result[lane] += factors[i] * block[i][lane];
  }
  return result;
}

/// From column k on.
Block block_of(const auto& rows, std::size_t k) {
  Block block;
  for (std::size_t i = 0; i < state_size; ++i) std::copy_n(&rows[i][k], lanes, block[i].begin());
  return block;
}

constexpr double unknown = std::numeric_limits<double>::infinity();
/// Beyond this share of the second order beside the first, the first no longer tells how errors
/// grow.
constexpr double largest_curvature = 0.25;

bool holds(const VertexSet set, int vertex) { return (set >> vertex & 1) != 0; }

/// The other outermost vertex of a flat landing.
ContactPoint partner(const BodyMotion& motion, VertexSet vertices, int reference) {
  const double x = motion.contact_point(reference).tangential;
  ContactPoint farthest = motion.contact_point(reference);
  for (int i = 0; i < motion.body().vertex_count; ++i) {
    const ContactPoint d = motion.contact_point(i);
    if ((vertices >> i & 1) != 0 && std::fabs(d.tangential - x) > std::fabs(farthest.tangential - x)) farthest = d;
  }
  return farthest;
}

/// Relative rounding of P_n from that of A − (P_t/P_n) B.
double impulse_rounding(const StruckState& struck, const Impact& impact) {
  if (struck.flat) return 2 * epsilon;
  const ContactInertia inertia = contact_inertia(struck.body.gyration_square, struck.place);
  const double coupled = inertia.coupling * impact.impulse_ratio();
  return 2 * epsilon * (inertia.normal + std::fabs(coupled)) / std::fabs(inertia.normal - coupled);
}

/// Size of the parts that make up P_t: with Coulomb's law those before and after slip has stopped.
double tangential_size(const StruckState& struck, const Impact& impact) {
  const bool parts = struck.law.has_cone();
  return std::fmax(std::fabs(impact.tangential_impulse), parts ? struck.law.friction_value * impact.normal_impulse : 0);
}

}  // namespace

/// At most `state_size` columns with the same F Fᵀ, unless there is room: Householder's reflection
/// of the columns from `first` on leaves the norm of row i in column `first` alone; rows above have
/// nothing in these columns.  Rounding of a row is relative to the row's own norm.
void ErrorFactor::make_room(std::size_t columns) {
  if (columns_ + columns <= capacity) return;
  std::size_t first = 0;
  for (std::size_t i = 0; i < state_size; ++i) {
    Row mirror = rows_[i];
    std::fill_n(mirror.begin(), first, 0.0);
    const double length = norm(mirror);
    if (!(length > 0)) continue;
    for (double& entry : mirror) entry *= 1 / length;
    const double sign = std::copysign(1.0, mirror[first]);
    const double scale = 1 + std::fabs(mirror[first]);
    mirror[first] += sign;
    std::fill(rows_[i].begin() + static_cast<std::ptrdiff_t>(first), rows_[i].end(), 0.0);
    rows_[i][first] = -sign * length;
    for (std::size_t below = i + 1; below < state_size; ++below) {
      const double along = product(mirror, rows_[below]) / scale;
      for (std::size_t k = 0; k < capacity; ++k) rows_[below][k] -= along * mirror[k];
    }
    ++first;
  }
  columns_ = first;
}

void ErrorFactor::add(const StateVector& column) {
  if (column == StateVector{}) return;
  for (const double entry : column) known_ = known_ && std::isfinite(entry);
  make_room(1);
  for (std::size_t i = 0; i < state_size; ++i) rows_[i][columns_] = column[i];
  ++columns_;
}

void ErrorFactor::add(std::size_t number, double size) {
  alone_[number] = alone_[number] == 0 ? std::fabs(size) : norm(std::array{alone_[number], size, 0.0, 0.0});
  known_ = known_ && std::isfinite(alone_[number]);
}

void ErrorFactor::append_alone() {
  make_room(
      static_cast<std::size_t>(std::count_if(alone_.begin(), alone_.end(), [](double size) { return size != 0; })));
  for (std::size_t i = 0; i < state_size; ++i) {
    if (alone_[i] != 0) rows_[i][columns_++] = alone_[i];
  }
  alone_ = {};
}

void ErrorFactor::advance(const StateMatrix& jacobian) {
  append_alone();
  Lanes zero{};
  for (std::size_t k = 0; k < columns_; k += lanes) {
    const Block old = block_of(rows_, k);
    for (std::size_t i = 0; i < state_size; ++i) {
      const Lanes sums = combined(jacobian[i], old);
      for (std::size_t lane = 0; lane < lanes; ++lane) zero[lane] += 0 * sums[lane];
      std::copy(sums.begin(), sums.end(), &rows_[i][k]);
    }
  }
  known_ = known_ && sum(zero) == 0;
}

double ErrorFactor::deviation_of(std::size_t number) const {
  std::array<double, capacity + lanes> parts{};
  parts[capacity] = alone_[number];
  std::copy(rows_[number].begin(), rows_[number].end(), parts.begin());
  return known_ ? norm(parts) : detail::infinite;
}

double ErrorFactor::deviation(const StateVector& gradient) const {
  if (!known_) return detail::infinite;
  std::array<double, capacity + 2 * lanes> parts;  // not filled first, which took longer than the products
  std::size_t size = 2 * lanes;
  for (std::size_t i = 0; i < size; ++i) parts[i] = i < state_size ? gradient[i] * alone_[i] : 0;
  for (std::size_t k = 0; k < columns_; k += lanes, size += lanes) {
    const Lanes sums = combined(gradient, block_of(rows_, k));
    std::copy(sums.begin(), sums.end(), &parts[size]);
  }
  return norm(std::span(parts).first(size));
}

ErrorGrowth::ErrorGrowth(const BodyMotion& motion, const Drop& drop, bool sums_only) : sums_only_(sums_only) {
  const ContactPoint d = motion.contact_point(std::countr_zero(motion.lowest_vertices()));
  const PlanarVelocity v = motion.velocity();
  const bool exact = motion.local_departure().sine == 0 || d.tangential == 0;  // 0° and 90° are what they are
  const double size = exact ? 0 : std::fabs(drop.inclination.radians);
  of_angle_[at_angle] = size;
  of_angle_[at_normal] = v.angular * d.normal * size;
  of_angle_[at_slip] = v.angular * d.tangential * size;
  of_speed_[at_normal] = v.normal;
  StateVector of_slip{}, of_turn{};
  of_slip[at_slip] = v.tangential;
  of_turn[at_turn] = v.angular;
  of_turn[at_normal] = -v.angular * d.tangential;
  of_turn[at_slip] = v.angular * d.normal;
  for (StateVector column : {of_angle_, of_speed_, of_slip, of_turn}) {
    for (double& entry : column) entry *= epsilon;
    factor_.add(column);
  }
  if (!drop.fall) return;
  const double turn = drop.fall->inclination_error / deviations;
  StateVector of_inclination{}, of_normal{};
  of_inclination[at_angle] = turn;
  of_inclination[at_normal] = v.angular * d.normal * turn;
  of_inclination[at_slip] = v.angular * d.tangential * turn;
  of_normal[at_normal] = drop.fall->normal_error / deviations;
  factor_.add(of_inclination);
  factor_.add(of_normal);
  predictable_ = std::isfinite(drop.fall->time_error);
}

void ErrorGrowth::advance(const StateMatrix& jacobian) {
  factor_.advance(jacobian);
  if (sums_only_) return;
  of_angle_ = product(jacobian, of_angle_);
  of_speed_ = product(jacobian, of_speed_);
}

/// Another vertex that is as near the ground as the error of its height might have come first.
void ErrorGrowth::check_arrival(const FlownState& flown, const Moment& touch, const Fall& fall) {
  const Arrival& arrival = flown.arrival;
  const StateVector of_first = height_gradient(flown, arrival.vertex, touch);
  for (int i = 0; i < flown.body.vertex_count; ++i) {
    if (i == arrival.vertex) continue;
    const auto [height, velocity, scale] = vertex_height(flown.body, flown.departure, i).at(touch.time, touch.turn);
    const double share = velocity / fall.velocity;
    StateVector gradient = height_gradient(flown, i, touch);
    for (std::size_t k = 0; k < state_size; ++k) gradient[k] -= share * of_first[k];
    const double propagated = alone(gradient);
    const bool together = holds(arrival.vertices, i);
    const double rounding = 4 * epsilon * scale + std::fabs(share) * fall.height_rounding;
    if (together ? !(propagated <= 0) : !(height >= propagated + rounding)) predictable_ = false;
  }
}

/// A vertex that passed the ground within the error of its height might have touched.
void ErrorGrowth::check_passes(const FlownState& flown, const Passes& passes, double until) {
  for (int i = 0; i < flown.body.vertex_count; ++i) {
    NearMiss pass = passes[i];
    if (pass.time > until) {  // the search looked beyond the arrival of another vertex
      pass = first_root(vertex_height(flown.body, flown.departure, i), until).near_miss;
    }
    if (!std::isfinite(pass.clearance) || (pass.time == 0 && pass.margin == 0)) continue;
    const double error = alone(height_gradient(flown, i, Moment(flown.departure, pass.time)));
    if (!(pass.clearance >= 2 * (error + pass.margin))) predictable_ = false;
  }
}

void ErrorGrowth::end_without_contact(const BodyMotion& motion, const FlownState& flown) {
  if (predictable_) check_passes(flown, motion.passes(), unknown);
}

void ErrorGrowth::fly(const BodyMotion& motion, const FlownState& flown) {
  if (!predictable_) return;
  const Arrival& arrival = flown.arrival;
  const Departure& from = flown.departure;
  const Moment touch(from, arrival.time);
  const FlightDerivatives f = flight_derivatives(flown, touch);
  const VertexHeight height = vertex_height(flown.body, from, arrival.vertex);
  const double reach = std::fabs(height.versine) + std::fabs(height.sine);
  const double turned = touch.turn.angle;
  const double of_phase = turned > 1 ? turned * reach : 0;
  // v₀ is the difference of two parts.
  const ContactPoint offset = from.offset(flown.body, from.reference, arrival.vertex);
  const double of_start = from.rebound_speed + std::fabs(from.angular * offset.tangential);
  const VertexHeight::Value value = height.at(arrival.time, touch.turn);
  const double height_rounding = 2 * epsilon * (value.scale + of_start * arrival.time + of_phase);
  check_arrival(flown, touch, {.velocity = value.velocity, .height_rounding = height_rounding});
  check_passes(flown, motion.passes(), arrival.time);
  if (arrival.within_margin) predictable_ = false;

  StateVector of_height = f.of_time;
  for (double& entry : of_height) entry *= height_rounding / f.velocity;
  advance(f.state);
  factor_.add(of_height);
  const double roundings[] = {arrival.time + motion.time(), turned > 0 ? std::fabs(from.inclination) + turned : 0,
                              of_start + motion.normal_scale(arrival.vertex) + of_phase * std::fabs(from.angular),
                              motion.slip_scale(arrival.vertex)};
  for (std::size_t i = 0; i < 4; ++i) factor_.add(i, epsilon * roundings[i]);
  const double late = std::fmax(alone(at_normal) / std::fabs(f.velocity), alone(at_angle));
  if (!(late <= largest_curvature)) predictable_ = false;
  curvature_ = std::fmax(curvature_, late);
  if (!predictable_) factor_ = {};
}

double ErrorGrowth::total_impulse() const {
  if (!predictable_) return unknown;
  return bound(at_sum, epsilon * total_impulse_);
}

void ErrorGrowth::add_to(const BodyMotion& motion, Tail& tail) const {
  if (!predictable_) {
    tail.end_time_error = tail.normal_impulse_error = tail.tangential_impulse_error = unknown;
    tail.set_errors({.normal = unknown, .tangential = unknown, .angular = unknown});
    return;
  }
  const Departure from = motion.local_departure();
  const PlanarVelocity v = motion.velocity();
  const MotionGradients moves(motion.body(), motion.contact_point(from.reference), v, from.gravity);
  // Without rebound it is the other end that moves, in proportion to the centre of mass.
  const bool rebounds = from.rebound_speed > 0;
  const double size = rebounds ? from.rebound_speed : std::fabs(v.normal);
  const double relative =
      (rebounds ? bound(at_normal, 2 * epsilon * size) : bound(moves.normal, 2 * epsilon * size)) / size;
  tail.end_time_error += bound(at_time, epsilon * motion.time()) + relative * (tail.end_time - motion.time());
  tail.normal_impulse_error += relative * tail.normal_impulse;
  tail.tangential_impulse_error += relative * std::fabs(tail.tangential_impulse.x());
  PlanarVelocity error{.normal = tail.normal_velocity_error,
                       .tangential = tail.tangential_velocity_error,
                       .angular = tail.angular_velocity_error};
  error.tangential += bound(moves.tangential, 2 * epsilon * std::fabs(v.tangential)) +
                      relative * std::fabs(tail.velocity_after.x() - v.tangential);
  if (const double turning = tail.angular_velocity_after.y(); turning != 0) {
    error.normal += bound(moves.normal, 2 * epsilon * std::fabs(v.normal));
    error.angular += bound(at_turn, epsilon * std::fabs(v.angular)) + relative * std::fabs(turning - v.angular);
  }
  tail.set_errors(error);
}

// Errors of an impact's numbers, and what the impact adds to them (error_growth.hpp).

StruckState struck_state(const BodyMotion& motion, const ImpactLaw& law, const ImpactRow& row) {
  const int vertex = motion.local_departure().reference;
  const ContactPoint d = motion.contact_point(vertex);
  const bool flat = std::popcount(row.vertices) > 1;
  const double u = flat ? normal_velocity(row.before, d) : -row.impact.approach_speed;
  return {.body = motion.turned_body(),
          .law = law,
          .before = row.before,
          .contact = {u, row.impact.slip_before},
          .place = d,
          .second = flat ? partner(motion, row.vertices, vertex) : ContactPoint{},
          .flat = flat};
}

double ErrorGrowth::amplification(const ImpactDerivatives& d, const ImpactRow& row) const {
  double largest = 0;
  for (const StateVector* of : {&of_angle_, &of_speed_}) {
    double of_impulse = 0;
    for (std::size_t i = 0; i < state_size; ++i) of_impulse += d.normal[i] * (*of)[i];
    const auto compare = [&](double change, double value) {
      if (change != 0) largest = std::fmax(largest, std::fabs(change / value));
    };
    compare((*of)[at_time], row.start);
    compare((*of)[at_angle], row.contact_angle);
    compare(of_impulse, row.impact.normal_impulse);
  }
  return largest;
}

/// What sums over the rows follow from.
void ErrorGrowth::fill_summed(const StruckState& struck, const ImpactDerivatives& d, ImpactRow& row) const {
  const Impact& impact = row.impact;
  const double u = struck.contact.normal, w = impact.separation_speed;
  const double of_impulse = impulse_rounding(struck, impact);
  StateVector loss{};
  for (std::size_t i = 0; i < state_size; ++i) {
    const double of_u = i == at_normal ? 1 : 0, of_s = i == at_slip ? 1 : 0;
    loss[i] = -(d.normal[i] * (u + w) + impact.normal_impulse * (of_u + d.state[at_normal][i]) +
                d.tangential[i] * (impact.slip_before + impact.slip_after) +
                impact.tangential_impulse * (of_s + d.state[at_slip][i])) /
              2;
  }
  RowErrors& e = row.error;
  e.start = row.start == 0 ? 0 : bound(at_time, epsilon * row.start);
  e.contact_angle = bound(at_angle, epsilon * row.contact_angle);
  e.normal_impulse = bound(d.normal, of_impulse * impact.normal_impulse);
  e.energy_loss = bound(loss, of_impulse * (impact.normal_impulse * (std::fabs(u) + w) +
                                            std::fabs(impact.tangential_impulse) *
                                                (std::fabs(impact.slip_before) + std::fabs(impact.slip_after))));
  const auto relative = [](double error, double value) { return error > 0 ? error / std::fabs(value) : 0; };
  e.relative = std::max({relative(e.start, row.start), relative(e.contact_angle, row.contact_angle),
                         relative(e.normal_impulse, impact.normal_impulse)});
}

/// The other numbers of the row, before the errors have gone through the impact.
void ErrorGrowth::fill(const BodyMotion& motion, const StruckState& struck, const ImpactDerivatives& d,
                       ImpactRow& row) const {
  const Impact& impact = row.impact;
  const double u = struck.contact.normal, w = impact.separation_speed;
  const double of_impulse = impulse_rounding(struck, impact);
  const double gravity = motion.local_departure().gravity;
  StateVector restitution{}, ratio{};
  for (std::size_t i = 0; i < state_size; ++i) {
    restitution[i] = -d.state[at_normal][i] / u + (i == at_normal ? w / (u * u) : 0);
    ratio[i] = (d.tangential[i] - impact.impulse_ratio() * d.normal[i]) / impact.normal_impulse;
  }
  RowErrors& e = row.error;
  e.inclination = bound(at_angle, epsilon * std::fabs(row.inclination));
  e.approach_speed = bound(at_normal, epsilon * std::fabs(u));
  e.tangential_impulse = bound(d.tangential, of_impulse * tangential_size(struck, impact));
  e.impulse = std::hypot(e.normal_impulse, e.tangential_impulse);
  if (impact.normal_impulse > 0) {
    e.restitution = bound(restitution, 4 * epsilon);
    e.impulse_ratio = bound(ratio, 2 * of_impulse * std::fabs(impact.impulse_ratio()));
  }
  const double size = std::fabs(row.energy_before) + std::fabs(row.energy_after);
  e.energy_before = bound(MotionGradients(struck.body, struck.place, row.before, gravity).energy, 2 * epsilon * size);
  if (motion.local_departure().gravity_along != 0)
    e.energy_before = std::fmax(e.energy_before, energy_ + epsilon * size);
}

void ErrorGrowth::add_rounding(const StruckState& struck, const Impact& impact) {
  const double push = impact.slip_after - impact.slip_before;
  const double mass = struck.body.mass, square = struck.body.gyration_square;
  const double of_impulse = impulse_rounding(struck, impact);
  StateVector of_jump{};
  of_jump[at_normal] = impact.separation_speed;
  of_jump[at_slip] = impact.slip_after == 0 ? 0 : push;
  of_jump[at_turn] = impact.after.angular - struck.before.angular;
  of_jump[at_sum] = impact.normal_impulse;
  for (double& entry : of_jump) entry *= of_impulse;
  factor_.add(of_jump);
  const double moment = struck.flat ? std::fabs(struck.before.angular)
                                    : (tangential_size(struck, impact) * std::fabs(struck.place.normal) +
                                       std::fabs(impact.normal_impulse * struck.place.tangential)) /
                                          (mass * square);
  // Where slip stops during restitution is the difference of two impulses.
  const bool stops = impact.mode == ImpactMode::slip_stick || impact.mode == ImpactMode::reverse_slip;
  if (stops && struck.law.law != RestitutionLaw::newton && !struck.flat) {
    const ContactInertia inertia = contact_inertia(square, struck.place);
    factor_.add(at_normal, 4 * epsilon *
                               (inertia.normal * impact.normal_impulse +
                                std::fabs(inertia.coupling) * tangential_size(struck, impact)) /
                               mass);
  }
  if (impact.slip_after != 0) factor_.add(at_slip, 2 * epsilon * (std::fabs(impact.slip_before) + std::fabs(push)));
  factor_.add(at_turn, 2 * epsilon * (std::fabs(struck.before.angular) + moment));
  factor_.add(at_sum, epsilon * total_impulse_);
}

void ErrorGrowth::strike(const BodyMotion& motion, const ImpactLaw& law, ImpactRow& row) {
  row.error = {};
  total_impulse_ += row.impact.normal_impulse;
  if (!predictable_) return;
  row.error.predictable = true;
  const StruckState struck = struck_state(motion, law, row);
  if (!(row.impact.approach_speed > 0)) {  // an arrival that rounding has turned into a departure
    predictable_ = false;
    row.error = {};
    return;
  }
  const ImpactDerivatives d = impact_derivatives(struck, row.impact.mode);
  fill_summed(struck, d, row);
  if (!sums_only_) {
    fill(motion, struck, d, row);
    row.amplification = amplification(d, row);
  }
  advance(d.state);
  add_rounding(struck, row.impact);
  if (!sums_only_) fill_after(motion, struck, row);
}

void ErrorGrowth::fill_after(const BodyMotion& motion, const StruckState& struck, ImpactRow& row) {
  const PlanarVelocity& after = row.impact.after;
  const MotionGradients moves(struck.body, struck.place, after, motion.local_departure().gravity);
  RowErrors& e = row.error;
  e.normal_velocity_after = bound(moves.normal, 2 * epsilon * (std::fabs(row.before.normal) + std::fabs(after.normal)));
  e.tangential_velocity_after =
      bound(moves.tangential, 2 * epsilon * (std::fabs(row.before.tangential) + std::fabs(after.tangential)));
  e.velocity_after = std::hypot(e.normal_velocity_after, e.tangential_velocity_after);
  e.angular_velocity_after = bound(at_turn, epsilon * std::fabs(after.angular));
  e.energy_after = bound(moves.energy, 2 * epsilon * (std::fabs(row.energy_before) + std::fabs(row.energy_after)));
  if (motion.local_departure().gravity_along == 0) return;
  // The way along the slope is no number of the state: what the energy is known to, impacts alone change.
  energy_ = e.energy_before + e.energy_loss;
  e.energy_after = std::fmax(e.energy_after, energy_);
}

}  // namespace clatter::analytic
