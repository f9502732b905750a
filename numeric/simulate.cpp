#include "numeric/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "numeric/detail/require.hpp"
#include "numeric/drop_run.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// How the second run differs, and what its distance from the main one says about that one's error: with a tolerance
/// it is coarser, with a fixed step finer, so that a step that is long for the contact cannot be compared with itself.
constexpr double other_tolerance = 30;
constexpr double other_step = 0.5;
constexpr double error_per_distance = 0.5;
constexpr double error_per_distance_of_steps = 1.2;  // 8/7 for order three
constexpr double error_per_tolerance = 2;
/// Beyond this growth the distance of the two runs tells more: truncation errors keep a scene's symmetry and may not
/// grow with the rest.
constexpr double largest_growth_of_tolerance = 100;

bool is_adaptive(Method method) { return method != Method::tvd_rk3; }

/// The cheapest that serves: a fifth-order method for few digits, one of eighth order for more.
Method chosen_method(const Options& options) {
  if (options.step > 0) return Method::tvd_rk3;
  return options.digits <= 4 ? Method::rkck : Method::rk8pd;
}

/// The local error that gives `digits` digits of velocities and energies after tens of steps.
Accuracy accuracy_for(const Options& options) {
  Accuracy accuracy;
  accuracy.method = options.method;
  if (options.method == Method::automatic) accuracy.method = chosen_method(options);
  accuracy.step = options.step;
  accuracy.tolerance = options.tolerance > 0 ? options.tolerance
                                             : std::max(std::pow(10.0, -options.digits - 4), least_tolerance);
  accuracy.steps_per_contact = 10 * std::pow(10.0, std::min(options.digits, 9) / 3.0);
  return accuracy;
}

Accuracy second_accuracy(Accuracy accuracy, double used_step) {
  accuracy.tolerance *= other_tolerance;
  accuracy.steps_per_contact /= other_step;
  if (accuracy.step > 0) accuracy.step = used_step * other_step;
  return accuracy;
}

template <class Use>
void for_each_number(const ImpactNumbers& a, const ImpactNumbers& b, ImpactNumbers& out, Use&& use) {
  using Numbers = ImpactNumbers;
  for (const auto member :
       {&Numbers::start, &Numbers::duration, &Numbers::inclination, &Numbers::contact_angle, &Numbers::approach_speed,
        &Numbers::restitution, &Numbers::peak_force, &Numbers::peak_time, &Numbers::energy_before,
        &Numbers::energy_after, &Numbers::energy_loss, &Numbers::work_damping, &Numbers::work_friction,
        &Numbers::work_released}) {
    out.*member = use(a.*member, b.*member);
  }
  for (const auto member : {&Numbers::impulse, &Numbers::velocity_after, &Numbers::angular_velocity_after}) {
    for (int i = 0; i < 3; ++i) (out.*member)[i] = use((a.*member)[i], (b.*member)[i]);
  }
}

/// What the tolerance and rounding, grown since, leave uncertain even where two runs happen to agree; numbers that are
/// differences take it from what they are differences of.
void add_floor(const Body& body, double tolerance, const ImpactRecord& row, ImpactNumbers& error) {
  const double growth = std::isfinite(row.amplification) ? row.amplification : 1;
  const double part = error_per_tolerance * tolerance * (1 + std::min(growth, largest_growth_of_tolerance)) +
                      4 * epsilon * (1 + growth);
  const ImpactNumbers& n = row.value;
  const auto add = [&](double& to, double size) { to += part * std::fabs(size); };
  for_each_number(n, error, error, [&](double value, double so_far) {
    add(so_far, value);
    return so_far;
  });
  for (double* work : {&error.energy_loss, &error.work_damping, &error.work_friction, &error.work_released}) {
    add(*work, n.energy_before);
  }
  // The time of a flat maximum is known to the root of what its height is known to.
  error.peak_time += 0.3 * std::sqrt(part) * n.duration;
  for (int i = 0; i < 3; ++i) {
    add(error.impulse[i], n.impulse.norm());
    error.impulse[i] += 4 * epsilon * body.mass() * n.velocity_after.norm();
    add(error.velocity_after[i], n.velocity_after.norm());
    add(error.angular_velocity_after[i], n.angular_velocity_after.norm() + n.approach_speed / body.radius());
  }
}

void estimate_errors(const Body& body, double tolerance, std::vector<ImpactRecord>& rows,
                     const std::vector<ImpactRecord>& second) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool same_kind = i < second.size() && second[i].end == rows[i].end && second[i].touches == rows[i].touches;
    const ImpactNumbers& other = same_kind ? second[i].value : rows[i].value;
    for_each_number(rows[i].value, other, rows[i].error, [&](double value, double other_value) {
      const double part = tolerance > 0 ? error_per_distance : error_per_distance_of_steps;
      return same_kind ? part * std::fabs(value - other_value) : not_known;
    });
    if (same_kind) add_floor(body, tolerance, rows[i], rows[i].error);
  }
}

void forget_errors(std::vector<ImpactRecord>& rows) {
  for (ImpactRecord& row : rows) {
    for_each_number(row.value, row.value, row.error, [](double, double) { return not_known; });
  }
}

std::string words_for(const Simulation& run, const Options& options, double time) {
  std::ostringstream text;
  switch (run.outcome) {
    case Outcome::no_further_impact: text << "nothing reaches the ground any more"; break;
    case Outcome::impact_limit: text << "stopped after the " << options.impacts << " impacts asked for"; break;
    case Outcome::at_rest: text << "the body lies still on the ground from " << time << " s"; break;
    case Outcome::evaluation_limit:
      text << "the contact after " << time << " s had not ended after " << options.evaluation_limit
           << " force evaluations";
      break;
    case Outcome::step_too_small:
      text << "the contact after " << time << " s needs steps too small for the tolerance; ask for fewer digits";
      break;
    case Outcome::not_representable:
      text << "the contact after " << time << " s is too shallow or too deep for double precision";
      break;
    case Outcome::flight_undecided:
      text << "no touch-down found after " << time << " s within the work allowed";
      break;
    case Outcome::interrupted: text << "stopped on request after " << time << " s of motion"; break;
  }
  return text.str();
}

}  // namespace

double Simulation::total_normal_impulse() const {
  double sum = 0;
  for (const ImpactRecord& row : impacts) sum += row.value.impulse.z();
  return sum;
}

MotionState touching_state(const Body& body, const Drop& drop) {
  MotionState state;
  state.attitude = Eigen::AngleAxisd(-drop.inclination, Vector3::UnitY()) *
                   Eigen::AngleAxisd(drop.out_of_plane_tilt, Vector3::UnitX());
  state.velocity = drop.velocity;
  state.angular_velocity = state.attitude.conjugate() * Vector3(0, drop.spin, 0);
  state.centre.z() = -lowest_height(body, state);
  return state;
}

Simulation simulate(const Body& body, const Ground& ground, const MotionState& start, const Options& options) {
  options.validate();
  ground.validate();
  const double low = lowest_height(body, start);
  detail::require(low >= -1e-12 * body.radius(), "height of the lowest point", low, "at least 0");
  const Accuracy accuracy = accuracy_for(options);
  DropRun main = run_drop(body, ground, start, options, accuracy,
                          {options.amplification, options.history, options.progress ? &options.progress : nullptr});
  Simulation simulation;
  simulation.outcome = main.outcome;
  simulation.method = accuracy.method;
  simulation.tolerance = is_adaptive(accuracy.method) ? accuracy.tolerance : 0;
  simulation.step = main.step;
  simulation.force_evaluations = main.force_evaluations;
  simulation.root_evaluations = main.root_evaluations;
  simulation.energy_start = main.energy_start;
  simulation.final_state = main.final_state;
  simulation.impacts = std::move(main.impacts);
  simulation.message = words_for(simulation, options, main.end_time);
  const bool wants_estimates = options.error_estimates && simulation.outcome != Outcome::interrupted;
  if (wants_estimates && !simulation.impacts.empty()) {
    Options fewer = options;
    fewer.impacts = static_cast<int>(simulation.impacts.size());
    const DropRun second = run_drop(body, ground, start, fewer, second_accuracy(accuracy, main.step), {});
    simulation.force_evaluations += second.force_evaluations;
    simulation.root_evaluations += second.root_evaluations;
    estimate_errors(body, simulation.tolerance, simulation.impacts, second.impacts);
  } else {
    forget_errors(simulation.impacts);
  }
  return simulation;
}

}  // namespace clatter::numeric
