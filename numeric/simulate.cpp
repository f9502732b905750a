#include "numeric/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "numeric/detail/require.hpp"
#include "numeric/drop_run.hpp"
#include "numeric/error_estimates.hpp"
#include "numeric/errors.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

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
  accuracy.tolerance =
      options.tolerance > 0 ? options.tolerance : std::max(std::pow(10.0, -options.digits - 4), least_tolerance);
  accuracy.steps_per_contact = 10 * std::pow(10.0, std::min(options.digits, 9) / 3.0);
  return accuracy;
}

std::string words_for(const Simulation& run, const Options& options, double time) {
  std::ostringstream text;
  switch (run.outcome) {
    case Outcome::no_further_impact: text << "nothing reaches the ground any more"; break;
    case Outcome::impact_limit: text << "stopped after the " << options.impacts << " impacts asked for"; break;
    case Outcome::at_rest: text << "the body lies still on the ground from " << time << " s"; break;
    case Outcome::sustained_contact:
      text << "from " << time << " s the body slides or spins on the ground steadily, and no friction stops it";
      break;
    case Outcome::evaluation_limit:
      text << "the contact after " << time << " s had not ended after " << options.evaluation_limit
           << " force evaluations";
      break;
    case Outcome::step_too_small:
      text << "the contact after " << time << " s needs steps too small for the tolerance; ask for fewer digits";
      break;
    case Outcome::not_representable:
      text << "the contact after " << time << " s is too shallow, too deep or too large for double precision";
      break;
    case Outcome::flight_undecided: text << "no touch-down found after " << time << " s within the work allowed"; break;
    case Outcome::interrupted: text << "stopped on request after " << time << " s of motion"; break;
  }
  return text.str();
}

/// The input has been checked: a value that leaves the domain of a formula during the run is no fault of the input.
DropRun run_checked(const Body& body, const Ground& ground, const MotionState& start, const Options& options,
                    const Accuracy& accuracy, const RunExtras& extras) {
  try {
    return run_drop(body, ground, start, options, accuracy, extras);
  } catch (const std::domain_error& error) {
    throw NumericalError(std::string("the drop cannot be computed in double precision: ") + error.what());
  }
}

}  // namespace

double Simulation::total_normal_impulse() const {
  double sum = 0;
  for (const ImpactRecord& row : impacts) sum += row.value.impulse.z();
  return sum;
}

Eigen::Quaterniond attitude_of(const Drop& drop) {
  return Eigen::AngleAxisd(-drop.inclination, Vector3::UnitY()) *
         Eigen::AngleAxisd(drop.out_of_plane_tilt, Vector3::UnitX());
}

MotionState on_ground(const Body& body, MotionState state) {
  state.centre.setZero();
  state.centre.z() = -lowest_height(body, state);
  return state;
}

MotionState touching_state(const Body& body, const Drop& drop) {
  MotionState state;
  state.attitude = attitude_of(drop);
  state.velocity = drop.velocity;
  state.angular_velocity = state.attitude.conjugate() * Vector3(0, drop.spin, 0);
  return on_ground(body, state);
}

Simulation simulate(const Body& body, const Ground& ground, const MotionState& start, const Options& options) {
  options.validate();
  ground.validate();
  const bool finite = start.centre.allFinite() && start.attitude.coeffs().allFinite() && start.velocity.allFinite() &&
                      start.angular_velocity.allFinite();
  if (!finite) throw std::domain_error("the start: every number of the state must be finite");
  const double low = lowest_height(body, start);
  detail::require(low >= -1e-12 * body.radius(), "height of the lowest point", low, "at least 0");
  const Accuracy accuracy = accuracy_for(options);
  DropRun main = run_checked(
      body, ground, start, options, accuracy,
      {.amplification = options.amplification,
       .local_slip = options.error_estimates && ground.has_friction() && ground.friction == FrictionLaw::coulomb,
       .history = options.history,
       .progress = options.progress ? &options.progress : nullptr});
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
    const SecondRun second = second_run(accuracy, main.step);
    const DropRun other = run_checked(body, ground, start, fewer, second.accuracy, {});
    simulation.force_evaluations += other.force_evaluations;
    simulation.root_evaluations += other.root_evaluations;
    estimate_errors(body, second.error_per_distance, simulation.impacts, other.impacts);
  } else {
    forget_errors(simulation.impacts);
  }
  return simulation;
}

}  // namespace clatter::numeric
