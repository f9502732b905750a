// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/base/angle.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;

constexpr double degrees = analytic::degrees_per_radian;

EntryVector entry(const numeric::Vector3& v) { return {v.x(), v.y(), v.z()}; }
EntryParameters entry(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
/// A vector's error is a bound on its length, and so on each of its parts.
EntryVector each(double bound) { return {bound, bound, bound}; }
EntryVector velocity(const analytic::PlanarVelocity& v) { return {v.tangential, 0, v.normal}; }
EntryVector rotation(const analytic::PlanarVelocity& v) { return {0, v.angular, 0}; }
double speed(const analytic::PlanarVelocity& v) { return std::hypot(v.normal, v.tangential); }

FirstTouch first_touch(const Estimated& time, const space::State& state) {
  return {time, entry(state.attitude), entry(state.velocity), entry(state.angular_velocity)};
}

/// The inclination of the body's x axis [rad], positive with end a lower.
double inclination_of(const Eigen::Quaterniond& attitude) {
  const numeric::Vector3 axis = attitude * numeric::Vector3::UnitX();
  return std::atan2(axis.z(), std::hypot(axis.x(), axis.y()));
}

Numbers values_of(const analytic::ImpactRow& row) {
  const analytic::Impact& impact = row.impact;
  return {.start = row.start,
          .inclination_deg = row.inclination * degrees,
          .contact_angle_deg = row.contact_angle * degrees,
          .approach_speed = impact.approach_speed,
          .restitution = impact.restitution(),
          .impulse_ratio = impact.impulse_ratio(),
          .impulse = {impact.tangential_impulse, 0, impact.normal_impulse},
          .velocity_after = velocity(impact.after),
          .angular_velocity_after = rotation(impact.after),
          .energy_before = row.energy_before,
          .energy_after = row.energy_after,
          .energy_loss = impact.energy_loss};
}

Numbers errors_of(const analytic::RowErrors& error) {
  return {.start = error.start,
          .inclination_deg = error.inclination * degrees,
          .contact_angle_deg = error.contact_angle * degrees,
          .approach_speed = error.approach_speed,
          .restitution = error.restitution,
          .impulse_ratio = error.impulse_ratio,
          .impulse = {error.tangential_impulse, 0, error.normal_impulse},
          .velocity_after = {error.tangential_velocity_after, 0, error.normal_velocity_after},
          .angular_velocity_after = {0, error.angular_velocity_after, 0},
          .energy_before = error.energy_before,
          .energy_after = error.energy_after,
          .energy_loss = error.energy_loss};
}

Numbers values_of(const space::ImpactRow& row) {
  const double inclination = inclination_of(row.before.attitude) * degrees;
  const space::Impact& impact = row.impact;
  return {.start = row.start,
          .inclination_deg = inclination,
          .contact_angle_deg = std::fabs(inclination),
          .approach_speed = impact.approach_speed,
          .restitution = impact.restitution(),
          .impulse_ratio = impact.impulse.x() / impact.impulse.z(),
          .impulse = entry(impact.impulse),
          .velocity_after = entry(impact.velocity_after),
          .angular_velocity_after = entry(impact.angular_velocity_after),
          .energy_before = row.energy_before,
          .energy_after = row.energy_after,
          .energy_loss = impact.energy_loss,
          .attitude = entry(row.before.attitude)};
}

Numbers errors_of(const space::ImpactRow& row, double ratio) {
  const space::RowErrors& error = row.error;
  const double half = error.attitude / 2;  // a turn by a small angle changes the parameters by half of it
  return {.start = error.start,
          .inclination_deg = error.attitude * degrees,
          .contact_angle_deg = error.attitude * degrees,
          .approach_speed = error.approach_speed,
          .restitution = unknown_error,
          .impulse_ratio = error.impulse * (1 + std::fabs(ratio)) / std::fabs(row.impact.impulse.z()),
          .impulse = each(error.impulse),
          .velocity_after = each(error.velocity_after),
          .angular_velocity_after = each(error.angular_velocity_after),
          .energy_before = error.energy_before,
          .energy_after = error.energy_after,
          .energy_loss = error.energy_before + error.energy_after,
          .attitude = {half, half, half, half}};
}

/// The numbers that the simulator states, or their errors; without the ratio of impulses.
Numbers numbers_of(const numeric::ImpactNumbers& numbers) {
  return {.start = numbers.start,
          .duration = numbers.duration,
          .inclination_deg = numbers.inclination * degrees,
          .contact_angle_deg = numbers.contact_angle * degrees,
          .approach_speed = numbers.approach_speed,
          .restitution = numbers.restitution,
          .impulse = entry(numbers.impulse),
          .peak_force = numbers.peak_force,
          .peak_time = numbers.peak_time,
          .indentation = numbers.indentation,
          .velocity_after = entry(numbers.velocity_after),
          .angular_velocity_after = entry(numbers.angular_velocity_after),
          .energy_before = numbers.energy_before,
          .energy_after = numbers.energy_after,
          .energy_loss = numbers.energy_loss,
          .work_damping = numbers.work_damping,
          .work_friction = numbers.work_friction,
          .work_released = numbers.work_released};
}

/// Nothing is known but how it was found.
RunTail begun_tail(bool closed_form) {
  RunTail tail{.closed_form = closed_form};
  tail.sum.is_tail = true;
  tail.sum.value = tail.sum.error = Numbers::unknown();
  return tail;
}

RunTail tail_of(const analytic::Tail& tail) {
  RunTail found = begun_tail(tail.closed_form);
  Numbers &value = found.sum.value, &error = found.sum.error;
  found.sum.end = analytic::PlanarBody::vertex_set_name(tail.vertices);
  value.start = tail.end_time;
  error.start = tail.end_time_error;
  value.impulse = {tail.tangential_impulse.x(), 0, tail.normal_impulse};
  error.impulse = {tail.tangential_impulse_error, 0, tail.normal_impulse_error};
  value.velocity_after = entry(tail.velocity_after);
  error.velocity_after = {tail.tangential_velocity_error, 0, tail.normal_velocity_error};
  value.angular_velocity_after = entry(tail.angular_velocity_after);
  error.angular_velocity_after = {0, tail.angular_velocity_error, 0};
  return found;
}

RunTail tail_of(const space::Tail& tail) {
  RunTail found = begun_tail(tail.closed_form);
  Numbers &value = found.sum.value, &error = found.sum.error;
  value.start = tail.end_time;
  error.start = tail.end_time_error;
  value.impulse = {tail.tangential_impulse.x(), tail.tangential_impulse.y(), tail.normal_impulse};
  error.impulse = {tail.tangential_impulse_error, tail.tangential_impulse_error, tail.normal_impulse_error};
  value.velocity_after = entry(tail.velocity_after);
  error.velocity_after = each(tail.velocity_error);
  value.angular_velocity_after = entry(tail.angular_velocity_after);
  error.angular_velocity_after = each(tail.angular_velocity_error);
  return found;
}

double relative_error(const analytic::Sequence& sequence) {
  double worst = 0;
  for (const analytic::ImpactRow& row : sequence.rows) worst = std::max(worst, row.error.relative);
  if (!sequence.tail) return worst;
  const analytic::Tail& tail = *sequence.tail;
  if (tail.end_time > 0) worst = std::max(worst, tail.end_time_error / tail.end_time);
  if (tail.normal_impulse > 0) worst = std::max(worst, tail.normal_impulse_error / sequence.total_normal_impulse);
  return worst;
}

double relative_error(const space::Sequence& sequence) {
  double time = 0, speed = 0, rate = 0, impulse = 0, worst = 0;
  for (const space::ImpactRow& row : sequence.rows) {
    time = std::max(time, row.start);
    speed = std::max({speed, row.before.velocity.norm(), row.impact.velocity_after.norm()});
    rate = std::max({rate, row.before.angular_velocity.norm(), row.impact.angular_velocity_after.norm(),
                     row.impact.velocity_after.norm() / row.corners.front().place.norm()});
    impulse = std::max(impulse, row.impact.impulse.norm());
  }
  const auto take = [&](double error, double size) {
    if (error > 0) worst = std::max(worst, size > 0 ? error / size : unknown_error);
  };
  for (const space::ImpactRow& row : sequence.rows) {
    const space::RowErrors& error = row.error;
    if (!error.predictable) return unknown_error;
    take(row.start > 0 ? error.start : 0, time);
    take(error.attitude, 1);
    take(error.impulse, impulse);
    take(error.velocity_after, speed);
    take(error.angular_velocity_after, rate);
  }
  return worst;
}

/// What the sequences of the discrete model have in common.
Run begun_run(RunModel model, const auto& sequence, long evaluations) {
  Run run{.model = model,
          .outcome = outcome_name(sequence.outcome),
          .message = sequence.message,
          .warnings = sequence.warnings,
          .is_cut_short = is_cut_short(sequence.outcome),
          .leaves_model = sequence.outcome == analytic::Outcome::outside_model,
          .moves_on = sequence.moves_on,
          .relative_error = relative_error(sequence),
          .total_normal_impulse = Estimated{sequence.total_normal_impulse, sequence.total_normal_impulse_error},
          .evaluations = evaluations};
  if (sequence.outcome == analytic::Outcome::no_further_impact) run.near_miss = sequence.near_miss;
  if (sequence.tail) run.tail = tail_of(*sequence.tail);
  run.impacts.reserve(sequence.rows.size());
  return run;
}

EndMotion end_motion(const space::LastMotion& motion) {
  const char* const kinds[] = {"rests", "slides", "spins", "rolls"};
  return {.kind = kinds[static_cast<std::size_t>(motion.kind)],
          .begin = motion.begin,
          .duration = motion.duration,
          .distance = motion.distance,
          .velocity = entry(motion.state.velocity),
          .angular_velocity = entry(motion.state.angular_velocity),
          .velocity_after = entry(motion.velocity_after),
          .angular_velocity_after = entry(motion.angular_velocity_after)};
}

EndMotion end_motion(const analytic::LastSlide& slide) {
  const EntryVector velocity{slide.speed, 0, 0};
  return {.kind = "slides",
          .begin = slide.begin,
          .duration = slide.duration,
          .distance = slide.distance,
          .velocity = velocity,
          .velocity_after = std::isfinite(slide.duration) ? EntryVector{} : velocity};
}

EndMotion end_motion(const numeric::Simulation& simulation) {
  const numeric::GroundMotion& motion = *simulation.on_ground;
  const bool stops = motion.kind == numeric::GroundMotionKind::rests;
  EndMotion end{.kind = "rests",
                .begin = simulation.on_ground_from,
                .duration = motion.stops_after,
                .velocity = entry(motion.from.velocity),
                .angular_velocity = entry(motion.from.attitude * motion.from.angular_velocity)};
  if (!stops) end.velocity_after = end.velocity, end.angular_velocity_after = end.angular_velocity;
  if (simulation.rest) end.distance = simulation.rest->slid;
  switch (motion.kind) {
    case numeric::GroundMotionKind::rests:
      if (motion.stops_after > 0) end.kind = motion.from.velocity.norm() > 0 ? "slides" : "spins";
      break;
    case numeric::GroundMotionKind::slides: end.kind = "slides"; break;
    case numeric::GroundMotionKind::spins: end.kind = "spins"; break;
    case numeric::GroundMotionKind::rolls:
      end.kind = "rolls";
      end.duration = 0;
      break;
  }
  return end;
}

double length(const EntryVector& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

MotionAt motion_at(const space::StateAt& at) {
  const double inclination = inclination_of(at.state.attitude);
  return {.time = at.time,
          .impacts = static_cast<int>(at.rows),
          .touches = at.touches,
          .is_known = at.is_known,
          .beside = static_cast<int>(at.beside),
          .position = entry(at.state.position),
          .velocity = entry(at.state.velocity),
          .angular_velocity = entry(at.state.angular_velocity),
          .attitude = entry(at.state.attitude),
          .inclination_deg = inclination * degrees,
          .energy = at.energy,
          .position_error = at.position_error,
          .attitude_error = at.error.attitude,
          .velocity_error = at.error.velocity,
          .angular_velocity_error = at.error.angular_velocity,
          .energy_error = at.energy_error,
          .inclination_error_deg = at.tilt_error * degrees};
}

MotionAt motion_at(const numeric::StateRecord& at) {
  const numeric::MotionState& state = at.state;
  const numeric::StateErrors& error = at.error;
  const auto bound = [](double value) { return std::isnan(value) ? unknown_error : value; };
  // An axis that is turned by a small angle changes its inclination by that at most.
  return {.time = at.time,
          .impacts = at.impacts,
          .touches = at.in_contact,
          .is_known = at.known,
          .position = entry(state.centre),
          .velocity = entry(state.velocity),
          .angular_velocity = entry(state.attitude * state.angular_velocity),
          .attitude = entry(state.attitude),
          .inclination_deg = inclination_of(state.attitude) * degrees,
          .energy = at.energy,
          .position_error = bound(error.position),
          .attitude_error = bound(error.angle),
          .velocity_error = bound(error.velocity),
          .angular_velocity_error = bound(error.angular_velocity),
          .energy_error = bound(error.energy),
          .inclination_error_deg = bound(error.angle) * degrees};
}

std::string words_of(const EndMotion& motion) {
  const auto number = [](double value) { return significant(value, 6); };
  const double begin = length(motion.velocity), end = length(motion.velocity_after);
  if (motion.kind == "rests") return "";
  if (motion.kind == "rolls") {
    return motion.duration > 0 ? fmt::format("it slips for {} s and {} m, then rolls on at {} m/s",
                                             number(motion.duration), number(motion.distance), number(end))
                               : fmt::format("it rolls on at {} m/s", number(end));
  }
  if (motion.kind == "spins") {
    return motion.ends() ? fmt::format("friction stops its spin {} s later", number(motion.duration))
                         : fmt::format("it spins on at {} rad/s", number(length(motion.angular_velocity)));
  }
  if (!motion.ends()) return fmt::format("it slides on at {} m/s, which no friction stops", number(begin));
  return fmt::format("friction stops its slide {} s and {} m later", number(motion.duration), number(motion.distance));
}

Value fields_of(const EndMotion& motion) {
  return Value::Fields{{"kind", motion.kind},
                       {"start", motion.begin},
                       {"duration", motion.duration},
                       {"distance", motion.distance},
                       {"velocity", motion.velocity},
                       {"angular_velocity", motion.angular_velocity},
                       {"velocity_after", motion.velocity_after},
                       {"angular_velocity_after", motion.angular_velocity_after}};
}

namespace {

/// The models' words of an end, before it is known how the body goes on.
void say_instead(std::string& message, std::string_view words, std::string_view better) {
  if (const std::size_t at = message.find(words); at != std::string::npos) message.replace(at, words.size(), better);
}

}  // namespace

void settle_outcome(bool followed, bool stops, Run& run) {
  if (!run.end_motion) {
    if (run.moves_on && followed && stops)
      say_instead(run.message, "the body slides on", "the body slides until friction stops it");
    else if (run.moves_on) run.outcome = "slides-on";
    return;
  }
  const EndMotion& motion = *run.end_motion;
  if (motion.kind == "slides" && !(followed && motion.ends())) run.outcome = "slides-on";
  if (motion.kind == "spins" && !(followed && motion.ends())) run.outcome = "spins-on";
  if (motion.kind == "rolls") run.outcome = "rolls-on";
  if (motion.kind == "rests" || (motion.kind != "rolls" && followed && motion.ends())) run.outcome = "at-rest";
  const std::string words = words_of(motion);
  if (words.empty()) return;
  say_instead(run.message, "; the body slides and turns on its round surface, which impacts do not describe", "");
  run.message += "; " + words;
}

Numbers Numbers::unknown() {
  constexpr double x = unknown_error;
  constexpr EntryVector each{x, x, x};
  return {.start = x,
          .duration = x,
          .inclination_deg = x,
          .contact_angle_deg = x,
          .approach_speed = x,
          .restitution = x,
          .impulse_ratio = x,
          .impulse = each,
          .peak_force = x,
          .peak_time = x,
          .indentation = x,
          .velocity_after = each,
          .angular_velocity_after = each,
          .energy_before = x,
          .energy_after = x,
          .energy_loss = x,
          .work_damping = x,
          .work_friction = x,
          .work_released = x,
          .attitude = {x, x, x, x}};
}

Impact impact_of(const analytic::ImpactRow& row, int n, double drop_deg) {
  Impact impact{.n = n,
                .end = analytic::PlanarBody::vertex_set_name(row.vertices),
                .value = values_of(row),
                .error = errors_of(row.error),
                .mode = mode_name(row.impact.mode),
                .amplification = row.amplification,
                .predictable = row.error.predictable,
                .largest_speed = std::max(speed(row.before), speed(row.impact.after)),
                .largest_rate = std::max(std::fabs(row.before.angular), std::fabs(row.impact.after.angular))};
  if (n == 1 && std::fabs(drop_deg) <= 90) {  // not of a drop that was turned beyond the upright
    impact.value.inclination_deg = std::copysign(drop_deg, row.inclination);
    impact.value.contact_angle_deg = std::copysign(drop_deg, row.contact_angle);
  }
  return impact;
}

Impact impact_of(const space::ImpactRow& row, int n) {
  return {.n = n,
          .value = values_of(row),
          .error = errors_of(row, row.impact.impulse.x() / row.impact.impulse.z()),
          .touches = static_cast<int>(row.corners.size()),
          .mode = mode_name(row.impact.path),
          .amplification = row.amplification,
          .predictable = row.error.predictable,
          .largest_speed = std::max(row.before.velocity.norm(), row.impact.velocity_after.norm()),
          .largest_rate = std::max(row.before.angular_velocity.norm(), row.impact.angular_velocity_after.norm())};
}

Impact impact_of(const numeric::ImpactRecord& row, int n) {
  Impact impact{.n = n,
                .end = end_name(row.end),
                .value = numbers_of(row.value),
                .error = numbers_of(row.error),
                .touches = row.touches,
                .mode = mode_name(row.mode),
                .submerged = row.submerged,
                .local_slip = row.local_slip,
                .energy_stored = row.energy_stored,
                .ledger_gap = row.ledger_gap,
                .amplification = row.amplification,
                .predictable = row.predictable,
                .largest_speed = std::max(row.value.velocity_after.norm(), row.value.approach_speed),
                .largest_rate = row.value.angular_velocity_after.norm()};
  const double ratio = row.value.impulse.x() / row.value.impulse.z();
  impact.value.impulse_ratio = ratio;
  impact.error.impulse_ratio = row.error.impulse.norm() * (1 + std::fabs(ratio)) / std::fabs(row.value.impulse.z());
  impact.value.attitude = entry(row.attitude);
  return impact;
}

Run run_of(const analytic::Sequence& sequence, double drop_deg) {
  Run run = begun_run(RunModel::plane, sequence, sequence.root_evaluations);
  if (sequence.slide) run.end_motion = end_motion(*sequence.slide);
  for (const analytic::ImpactRow& row : sequence.rows)
    run.impacts.push_back(impact_of(row, static_cast<int>(run.impacts.size()) + 1, drop_deg));
  return run;
}

Run run_of(const space::Sequence& sequence) {
  Run run = begun_run(RunModel::space, sequence, sequence.root_evaluations);
  if (sequence.last_motion) run.end_motion = end_motion(*sequence.last_motion);
  for (const space::StateAt& state : sequence.states) run.states.push_back(motion_at(state));
  for (const space::ImpactRow& row : sequence.rows)
    run.impacts.push_back(impact_of(row, static_cast<int>(run.impacts.size()) + 1));
  if (!sequence.rows.empty() && sequence.rows.front().flight.time > 0) {
    const space::ImpactRow& first = sequence.rows.front();
    run.first_touch = first_touch({sequence.first_flight, sequence.first_flight_error}, first.before);
  }
  return run;
}

Run run_of(const numeric::Simulation& simulation) {
  Run run{.model = RunModel::continuous,
          .outcome = outcome_name(simulation),
          .message = simulation.message,
          .is_cut_short = is_cut_short(simulation.outcome)};
  if (simulation.on_ground) run.end_motion = end_motion(simulation);
  for (const numeric::StateRecord& state : simulation.states) run.states.push_back(motion_at(state));
  run.impacts.reserve(simulation.impacts.size());
  for (const numeric::ImpactRecord& row : simulation.impacts)
    run.impacts.push_back(impact_of(row, static_cast<int>(run.impacts.size()) + 1));
  return run;
}

FirstTouch first_touch_of(const analytic::Drop& drop) {
  const double half = drop.inclination.radians / 2;
  return {{drop.fall->time, drop.fall->time_error},
          {std::cos(half), 0, -std::sin(half), 0},
          velocity(drop.velocity),
          rotation(drop.velocity)};
}

FirstTouch first_touch_of(double time, const numeric::MotionState& state) {
  return {{time, unknown_error},
          entry(state.attitude),
          entry(state.velocity),
          entry(state.attitude * state.angular_velocity)};
}

Value fields_of(const FirstTouch& touch) {
  return Value::Fields{{"time", touch.time.value},
                       {"time_error", error_or_nothing(touch.time)},
                       {"attitude", touch.attitude},
                       {"velocity", touch.velocity},
                       {"angular_velocity", touch.angular_velocity}};
}

std::string words_of(const FirstTouch& touch) {
  const auto vector = [](const EntryVector& v) {
    return fmt::format("({}, {}, {})", significant(v[0], 6), significant(v[1], 6), significant(v[2], 6));
  };
  return fmt::format("first touch {} s after the release, at {} m/s and {} rad/s", significant(touch.time.value, 6),
                     vector(touch.velocity), vector(touch.angular_velocity));
}

Totals totals(const Run& run) {
  Totals sums;
  sums.impacts = static_cast<int>(run.impacts.size());
  for (const Impact& impact : run.impacts) {
    const Numbers &value = impact.value, &error = impact.error;
    const Estimated peak{value.peak_force, impact.predictable ? error.peak_force : unknown_error};
    const bool is_first = &impact == &run.impacts.front();
    sums.predictable = sums.predictable && impact.predictable;
    sums.normal_impulse += {value.impulse[2], error.impulse[2]};
    sums.energy_loss += {value.energy_loss, error.energy_loss};
    sums.last_start = {value.start, error.start};
    if (is_first) sums.first_peak = peak;
    sums.largest_peak = is_first ? peak : larger(sums.largest_peak, peak);
    const Estimated depth{value.indentation, error.indentation};
    sums.largest_depth = is_first ? depth : larger(sums.largest_depth, depth);
  }
  if (run.total_normal_impulse) sums.normal_impulse = *run.total_normal_impulse;
  if (sums.predictable) return sums;
  if (!run.total_normal_impulse) sums.normal_impulse.error = unknown_error;
  for (Estimated* sum : {&sums.energy_loss, &sums.last_start, &sums.largest_peak, &sums.largest_depth})
    sum->error = unknown_error;
  return sums;
}

void add_totals(const Totals& sums, Value& fields) {
  fields["total_normal_impulse"] = sums.normal_impulse.value;
  fields["total_normal_impulse_error"] = error_or_nothing(sums.normal_impulse);
  fields["predictable"] = sums.predictable;
}

std::string totals_line(const Totals& sums) {
  const auto text = [](const Value& number) { return number.is_nothing() ? "unknown" : number.text(); };
  return "total_normal_impulse: " + text(sums.normal_impulse.value) +
         "; total_normal_impulse_error: " + text(error_or_nothing(sums.normal_impulse));
}

}  // namespace clatter::validation
