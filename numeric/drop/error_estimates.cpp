// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/error_estimates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "numeric/drop/error_growth.hpp"

namespace clatter::numeric {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

constexpr double finer = 0.1;   ///< tolerance of the second run, over that of the main one
constexpr double coarser = 10;  ///< the same where a finer one is not to be had
/// The tolerance of the second run's later contacts over the relative distance of the runs, and the largest.
constexpr double tolerance_per_distance = 0.1, loosest = 1e-5;
constexpr double least_grown = 0.01;  ///< of the root of the tolerance, with which friction of slow slip errs
/// Longest step of the second run, over that of the main one: where steps are as long as they may be, the tolerance
/// changes nothing.
constexpr double shorter_steps = 0.7;
/// Errors of single numbers scatter about the power of the tolerance: of random drops 95 of 100 lie within these.
constexpr double error_per_distance_of_finer = 4;
constexpr double error_per_distance_of_coarser = 4;
constexpr double another_way = 0.1;  ///< relative distance of impulses: what follows such impacts differs altogether
constexpr double of_a_graze = 0.01;  ///< the same, below which a touch that one run alone has changes nothing else
constexpr double step_part = 0.5;
/// What SmoothContact::slip_load leaves of the friction at most where a body rolls and hardly spins, as seen.
constexpr double local_rule = 2e-8;
constexpr double error_per_distance_of_steps = 3;  ///< 8/7 where the step is short enough for the order to show

/// Single numbers agree by chance in two runs that differ: of a vector's distance, at least, for each component, and of
/// the impulse's relative distance for what the same steps yield; energies and works take the latter of the energy
/// before.
constexpr double least_part = 0.1;

constexpr Vector3 ImpactNumbers::*vectors[] = {&ImpactNumbers::impulse, &ImpactNumbers::velocity_after,
                                               &ImpactNumbers::angular_velocity_after};

void for_each_number(const ImpactNumbers& a, const ImpactNumbers& b, ImpactNumbers& out, auto&& use) {
  using Numbers = ImpactNumbers;
  for (const auto member :
       {&Numbers::start, &Numbers::duration, &Numbers::inclination, &Numbers::contact_angle, &Numbers::approach_speed,
        &Numbers::restitution, &Numbers::peak_force, &Numbers::peak_time, &Numbers::indentation,
        &Numbers::energy_before, &Numbers::energy_after, &Numbers::energy_loss, &Numbers::work_damping,
        &Numbers::work_friction, &Numbers::work_released}) {
    out.*member = use(a.*member, b.*member);
  }
  for (const auto member : vectors) {
    for (int i = 0; i < 3; ++i) (out.*member)[i] = use((a.*member)[i], (b.*member)[i]);
  }
}

/// Against agreement by chance.  Components that are 0 in both runs, out of the plane of motion, stay known.
void widen(const ImpactNumbers& a, const ImpactNumbers& b, ImpactNumbers& error) {
  using Numbers = ImpactNumbers;
  const double relative = least_part * error.impulse.norm() / a.impulse.norm();
  for (const auto member : {&Numbers::duration, &Numbers::restitution, &Numbers::peak_force, &Numbers::indentation}) {
    const double least = relative * std::fabs(a.*member);
    if (error.*member < least) error.*member = least;
  }
  for (const auto member : {&Numbers::energy_after, &Numbers::energy_loss, &Numbers::work_damping,
                            &Numbers::work_friction, &Numbers::work_released}) {
    if (a.*member != 0 || b.*member != 0) error.*member = std::max(error.*member, relative * a.energy_before);
  }
  for (const auto member : vectors) {
    Vector3& of = error.*member;
    const double least = least_part * of.norm();
    for (int i = 0; i < 3; ++i) {
      if ((a.*member)[i] != 0 || (b.*member)[i] != 0) of[i] = std::max(of[i], least);
    }
  }
}

/// What rounding, grown since, leaves uncertain even where two runs happen to agree; numbers that are differences take
/// it from what they are differences of.
void add_rounding(const Body& body, const ImpactRecord& row, ImpactNumbers& error) {
  const double growth = std::isfinite(row.amplification) ? row.amplification : 1;
  const double part = 4 * epsilon * (1 + growth);
  const ImpactNumbers& n = row.value;
  const auto add = [&](double& to, double size) { to += part * std::fabs(size); };
  for_each_number(n, error, error, [&](double value, double so_far) {
    add(so_far, value);
    return so_far;
  });
  for (double* work : {&error.energy_loss, &error.work_damping, &error.work_friction, &error.work_released}) {
    add(*work, n.energy_before);
  }
  for (double* angle : {&error.inclination, &error.contact_angle}) add(*angle, 1);  // from direction cosines
  // The velocity of a point of the body is what V and ω × u leave, about as large as afterwards.
  add(error.approach_speed, n.velocity_after.norm() + body.radius() * n.angular_velocity_after.norm());
  // Heights are known to the rounding of the body's size, and touch-down and lift-off to that over the speed.
  const double separation = n.approach_speed * (n.restitution > 0 ? std::min(n.restitution, 1.0) : 1);
  // A body that began in the ground, or let down on it without a speed, has not come by.
  if (n.approach_speed > 0) add(error.duration, body.radius() / separation);
  add(error.indentation, body.radius());
  if (n.start > 0) add(error.start, body.radius() / n.approach_speed);
  // The time of a flat maximum is known to the root of what its height is known to.
  error.peak_time += std::sqrt(part) * n.duration;
  for (int i = 0; i < 3; ++i) {
    add(error.impulse[i], n.impulse.norm());
    error.impulse[i] += 4 * epsilon * body.mass() * n.velocity_after.norm();
    add(error.velocity_after[i], n.velocity_after.norm());
    add(error.angular_velocity_after[i], n.angular_velocity_after.norm() + n.approach_speed / body.radius());
  }
  if (row.mode == FrictionMode::local && body.smooth()) {
    // Both runs take the same rules around places where a round face does not slip.
    const double friction = local_rule * (1 + growth) * n.impulse.head<2>().norm();
    error.impulse.array() += friction;
    error.velocity_after.array() += friction / body.mass();
    error.angular_velocity_after.array() += friction * body.radius() * body.inverse_inertia().norm();
    for (double* energy : {&error.energy_after, &error.energy_loss, &error.work_friction})
      *energy += local_rule * (1 + growth) * std::fabs(n.work_friction);
  }
  if (!(row.left_speed > 0)) return;
  // What a closed form at the end leaves out is no smaller where steps are.
  error.duration += row.left_time;
  error.impulse += n.impulse.cwiseAbs() * (row.left_time / n.duration);
  error.velocity_after.array() += row.left_speed;
  error.angular_velocity_after.array() += row.left_turning;
}

/// What both runs leave out alike, before and in the row's contact.
void add_left_out(const Body& body, const ImpactRecord& row, ImpactNumbers& error) {
  const double before = row.left_out_before, after = row.left_out;
  if (!(after > 0)) return;
  const ImpactNumbers& n = row.value;
  const double radius = body.radius();
  const double size = n.approach_speed + n.velocity_after.norm() + radius * n.angular_velocity_after.norm();
  error.start += before / size * n.start;
  for (double* angle : {&error.inclination, &error.contact_angle}) *angle += before / size;
  error.approach_speed += before;
  error.energy_before += body.mass() * before * size;
  // Friction's spin hardly changes the normal force and its work.
  const double aside = before + least_part * (after - before);
  for (const auto member : {&ImpactNumbers::duration, &ImpactNumbers::restitution, &ImpactNumbers::peak_force,
                            &ImpactNumbers::peak_time, &ImpactNumbers::indentation}) {
    error.*member += aside / size * std::fabs(n.*member);
  }
  for (double* energy :
       {&error.energy_after, &error.energy_loss, &error.work_damping, &error.work_friction, &error.work_released}) {
    *energy += body.mass() * aside * size;
  }
  const Vector3 errors(after, after, aside);
  error.velocity_after += errors;
  error.impulse += body.mass() * errors;
  error.angular_velocity_after.array() += after / radius;
}

/// Relative, of the impulses.
double distance_of(const ImpactRecord& row, const ImpactRecord& second) {
  return (second.value.impulse - row.value.impulse).norm() / row.value.impulse.norm();
}

/// The second row, its impulse until the time at which the first run says that the body lies still.
ImpactRecord until_the_same_rest(const ImpactRecord& row, ImpactRecord second) {
  if (row.carried.isZero(0) || second.carried.isZero(0)) return second;
  second.value.impulse += (row.value.duration - second.value.duration) * row.carried;
  return second;
}

/// A part of a contact's time from its beginning or its end changes at most this part of what the contact does, over
/// the part: of half a sine of force it is π/2 in the middle and less at the ends.
constexpr double steepest = 2;
/// A state has the errors of all impacts before it: 95 of 100 lie within bars that are so much wider.
constexpr double wider_of_states = 1.5;

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::fabs(turn.w()));
}

/// What the rows say of an instant's time.
struct TimeErrors {
  double beside = 0;                     ///< by which an impact's beginning or end may lie on the other side of it [s]
  const ImpactRecord* impact = nullptr;  ///< that one
};

/// Errors of the impact before the state, or that it is in, and of the one after it.
TimeErrors time_errors(const StateRecord& at, std::span<const ImpactRecord> impacts) {
  TimeErrors errors;
  const auto look = [&](std::size_t i) {
    if (i >= impacts.size()) return;
    const ImpactNumbers &row = impacts[i].value, &error = impacts[i].error;
    // A body that stays on the ground leaves it with no change.
    const bool lifts = impacts[i].energy_stored == 0;
    const double begin = error.start, end = lifts ? error.start + error.duration : 0;
    const double from_begin = std::fabs(at.time - row.start), from_end = std::fabs(at.time - row.start - row.duration);
    const double beside = !(from_begin > begin) ? begin : !(from_end > end) ? end : 0;
    if (beside > errors.beside) errors = {beside, &impacts[i]};
  };
  if (at.impacts > 0) look(static_cast<std::size_t>(at.impacts) - 1);
  look(static_cast<std::size_t>(at.impacts));
  return errors;
}

/// The change that the impact makes within `time`.
StateErrors change_within(const Body& body, const ImpactRecord& impact, double time) {
  const ImpactNumbers& n = impact.value;
  const double part = std::min(steepest * time / n.duration, 1.0), speed = n.impulse.norm() / body.mass();
  const double turning = speed * body.radius() * body.mass() * body.inverse_inertia().norm();
  return {.position = part * speed * time,
          .angle = part * turning * time,
          .velocity = part * speed,
          .angular_velocity = part * turning,
          .energy = part * (std::fabs(n.energy_loss) + n.peak_force * n.indentation)};
}

/// 4 ε (1 + amplification) × the size of what a number is computed from; in a contact also the way of 4 ε × time.
StateErrors rounding_of(const Body& body, const StateRecord& at, double approach_speed) {
  const MotionState& s = at.state;
  const double radius = body.radius(), turning = s.angular_velocity.norm(), force = at.force.norm();
  const double speed = s.velocity.norm() + radius * turning + approach_speed;
  const double part = 4 * epsilon * (1 + (std::isfinite(at.amplification) ? at.amplification : 1));
  const double time = 4 * epsilon * std::fabs(at.time) + (at.in_contact && speed > 0 ? part * radius / speed : 0);
  const double acceleration = force / body.mass(), twist = force * radius * body.inverse_inertia().norm();
  return {.position = part * (s.centre.norm() + radius) + time * speed,
          .angle = part + time * (turning + speed / radius),
          .velocity = part * speed + time * acceleration,
          .angular_velocity = part * speed / radius + time * twist,
          .energy = part * (std::fabs(at.energy) + body.mass() * speed * speed) + time * force * speed};
}

/// The local error of a step, which began `since` [s] ago at most.
StateErrors step_errors(const Body& body, const StateRecord& at, double approach_speed, double tolerance,
                        double since) {
  const double radius = body.radius();
  const double speed =
      tolerance * (at.state.velocity.norm() + radius * at.state.angular_velocity.norm() + approach_speed);
  return {.position = speed * since,
          .angle = speed / radius * since,
          .velocity = speed,
          .angular_velocity = speed / radius,
          .energy = body.mass() * speed * (at.state.velocity.norm() + approach_speed)};
}

/// Velocities that all runs leave out alike since an impact `since` [s] ago.
StateErrors left_out_errors(const Body& body, const StateRecord& at, const ImpactRecord& impact, double since) {
  const double speed = grown(impact.left_out, impact.amplification, at.amplification), turning = 1 / body.radius();
  return {.position = speed * since,
          .angle = speed * turning * since,
          .velocity = speed,
          .angular_velocity = speed * turning,
          .energy = body.mass() * speed * (at.state.velocity.norm() + speed)};
}

StateErrors sum(const StateErrors& a, const StateErrors& b) {
  return {a.position + b.position, a.angle + b.angle, a.velocity + b.velocity, a.angular_velocity + b.angular_velocity,
          a.energy + b.energy};
}

StateErrors distance(const StateRecord& a, const StateRecord& b, double factor) {
  return {.position = factor * (a.state.centre - b.state.centre).norm(),
          .angle = factor * angle_between(a.state.attitude, b.state.attitude),
          .velocity = factor * (a.state.velocity - b.state.velocity).norm(),
          .angular_velocity = factor * (a.state.angular_velocity - b.state.angular_velocity).norm(),
          .energy = factor * std::fabs(a.energy - b.energy)};
}

}  // namespace

SecondRun second_run(const Integration& main, double used_step) {
  SecondRun second{.integration = main, .error_per_distance = error_per_distance_of_steps};
  StepSettings& steps = second.integration.steps;
  steps.steps_per_contact /= step_part;
  if (main.steps.step > 0) steps.step = used_step * step_part;
  if (main.method == Method::tvd_rk3) return second;
  steps.step_cap *= shorter_steps;
  const bool can_be_finer = finer * main.steps.tolerance >= least_tolerance;
  steps.tolerance *= can_be_finer ? finer : coarser;
  second.error_per_distance = can_be_finer ? error_per_distance_of_finer : error_per_distance_of_coarser;
  return second;
}

bool has_the_same_contacts(const ImpactRecord& row, const ImpactRecord& second) {
  return second.end == row.end &&
         (second.touches == row.touches || distance_of(row, until_the_same_rest(row, second)) <= of_a_graze);
}

bool goes_another_way(const ImpactRecord& row, const ImpactRecord& second) {
  return !has_the_same_contacts(row, second) || !(distance_of(row, until_the_same_rest(row, second)) <= another_way);
}

double tolerance_beside(const Body& body, double tolerance, const ImpactRecord& row, const ImpactRecord& second) {
  const ImpactNumbers &one = row.value, &other = second.value;
  const double radius = body.radius(), speed = one.velocity_after.norm() + radius * one.angular_velocity_after.norm();
  const double distance = std::max((other.velocity_after - one.velocity_after).norm(),
                                   radius * (other.angular_velocity_after - one.angular_velocity_after).norm()) /
                          speed;
  const double looser = std::min(tolerance_per_distance * distance, loosest);
  const bool has_grown = distance > least_grown * std::sqrt(tolerance) && distance <= tolerance * row.amplification;
  return has_grown && looser > coarser * tolerance ? looser : 0;
}

void estimate_errors(const Body& body, double error_per_distance, std::vector<ImpactRecord>& rows,
                     const std::vector<ImpactRecord>& second) {
  assert(error_per_distance > 0);
  bool parted = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ImpactRecord& row = rows[i];
    parted = parted || i >= second.size();
    const bool known = !parted && has_the_same_contacts(row, second[i]);
    parted = parted || goes_another_way(row, second[i]);
    const ImpactNumbers other = known ? until_the_same_rest(row, second[i]).value : row.value;
    for_each_number(row.value, other, row.error, [&](double value, double other_value) {
      return known ? error_per_distance * std::fabs(value - other_value) : not_known;
    });
    row.predictable = row.predictable && known;
    if (!known) continue;
    widen(row.value, other, row.error);
    add_rounding(body, row, row.error);
    add_left_out(body, row, row.error);
  }
}

ImpactNumbers rounding_errors(const Body& body, const ImpactRecord& row) {
  ImpactNumbers error;
  add_rounding(body, row, error);
  return error;
}

void forget_errors(std::vector<ImpactRecord>& rows) {
  for (ImpactRecord& row : rows) {
    for_each_number(row.value, row.value, row.error, [](double, double) { return not_known; });
  }
}

std::size_t states_with_errors(std::span<const StateRecord> states, std::size_t rows, std::size_t impacts) {
  std::size_t count = 0;
  for (const StateRecord& at : states) {
    const auto begun = static_cast<std::size_t>(at.impacts);
    // A contact that is not listed has no word on its own errors, but on those that it begins with.
    const bool is_before = begun <= rows || (at.in_contact && begun == rows + 1 && rows == impacts);
    if (!at.known || !is_before || !is_predictable(at.amplification)) break;
    ++count;
  }
  return count;
}

void estimate_state_errors(const Body& body, double error_per_distance, double tolerance,
                           std::span<const ImpactRecord> impacts, std::vector<StateRecord>& states,
                           std::span<const StateRecord> second) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    StateRecord& at = states[i];
    const StateErrors left_out = at.error;
    at.error = {};
    if (!at.known || i >= second.size() || !second[i].known) continue;
    const auto listed = std::min(static_cast<std::size_t>(at.impacts), impacts.size());
    if (!std::ranges::all_of(impacts.first(listed),
                             [](const ImpactRecord& row) { return std::isfinite(row.error.start); })) {
      continue;
    }
    const double approach = listed > 0 ? impacts[listed - 1].value.approach_speed : 0;
    at.error = sum(distance(at, second[i], wider_of_states * error_per_distance), rounding_of(body, at, approach));
    if (at.in_contact) {
      const double since = listed > 0 ? std::fabs(at.time - impacts[listed - 1].value.start) : 0;
      at.error = sum(at.error, step_errors(body, at, approach, tolerance, since));
    }
    if (std::isfinite(left_out.velocity)) at.error = sum(at.error, left_out);
    if (listed > 0) {
      const ImpactRecord& last = impacts[listed - 1];
      at.error = sum(at.error, left_out_errors(body, at, last, std::fabs(at.time - last.value.start)));
    }
    const TimeErrors beside = time_errors(at, impacts);
    if (beside.impact) at.error = sum(at.error, change_within(body, *beside.impact, beside.beside));
  }
}

void forget_errors(std::vector<StateRecord>& states) {
  for (StateRecord& at : states) at.error = {};
}

}  // namespace clatter::numeric
