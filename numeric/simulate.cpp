// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/simulate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>

#include "numeric/base/errors.hpp"
#include "numeric/drop/drop_run.hpp"
#include "numeric/drop/error_estimates.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

bool is_adaptive(Method method) { return method != Method::tvd_rk3; }

/// The cheapest that serves: a fifth-order method for few digits, one of eighth order for more.
Method chosen_method(const Accuracy& accuracy) {
  if (accuracy.step > 0) return Method::tvd_rk3;
  return accuracy.digits <= 4 ? Method::rkck : Method::rk8pd;
}

/// The local error that gives `digits` digits of velocities and energies after tens of steps.
Integration integration_for(const Accuracy& accuracy) {
  Integration integration;
  integration.method = accuracy.method == Method::automatic ? chosen_method(accuracy) : accuracy.method;
  integration.steps.step = accuracy.step;
  integration.steps.tolerance =
      accuracy.tolerance > 0 ? accuracy.tolerance : std::max(std::pow(10.0, -accuracy.digits - 4), least_tolerance);
  integration.steps.steps_per_contact = 10 * std::pow(10.0, std::min(accuracy.digits, 9) / 3.0);
  integration.evaluation_limit = accuracy.evaluation_limit;
  integration.least_local_slip = std::pow(10.0, -accuracy.digits);
  return integration;
}

/// A motion that goes on.
std::string words_for(const GroundMotion& motion) {
  std::ostringstream text;
  const double speed = motion.from.velocity.norm(), turning = motion.from.angular_velocity.norm();
  switch (motion.kind) {
    case GroundMotionKind::rests: break;
    case GroundMotionKind::slides:
      text << "slides on at " << speed << " m/s";
      if (motion.acceleration.norm() > 0) text << ", ever faster";
      text << ", and no friction stops it";
      break;
    case GroundMotionKind::spins: text << "spins on at " << turning << " rad/s, and no friction stops it"; break;
    case GroundMotionKind::rolls:
      text << "rolls on at " << speed << " m/s";
      if (motion.decay > 0) text << ", which the ground's damping slows by " << 100 * motion.decay << " % a second";
      break;
  }
  return text.str();
}

/// Where the run has come to rest.
Rest rest_of(const DropRun& run) {
  const GroundMotion& motion = *run.on_ground;
  Rest rest{.time = run.end_time, .place = run.final_state.centre};
  if (motion.stops_after > 0) rest.slid = motion.from.velocity.norm() * motion.stops_after / 2;
  rest.distance = (rest.place - run.last_touch.centre).head<2>().norm();
  return rest;
}

/// What the run says of its end at `time` [s].
std::string words_for(const Simulation& run, const Request& request, const Accuracy& accuracy, const DropRun& end) {
  const double time = end.end_time;
  std::ostringstream text;
  switch (run.outcome) {
    case Outcome::no_further_impact: text << "nothing reaches the ground any more"; break;
    case Outcome::impact_limit: text << "stopped after the " << request.impacts << " impacts asked for"; break;
    case Outcome::at_rest:
      if (run.rest->slid > 0) {
        text << "the body slides " << run.rest->distance << " m and stops at " << time << " s";
      } else {
        text << "the body lies still on the ground from " << time << " s";
      }
      if (run.on_ground->rocks) text << ", but for rocking at up to " << run.on_ground->left_speed << " m/s";
      break;
    case Outcome::sustained_contact: text << "from " << time << " s the body " << words_for(*run.on_ground); break;
    case Outcome::evaluation_limit:
      text << "the contact after " << time << " s had not ended after " << accuracy.evaluation_limit
           << " force evaluations; at " << end.reached_time << " s the body moves along the ground at "
           << end.reached.velocity.head<2>().norm() << " m/s and turns at " << end.reached.angular_velocity.norm()
           << " rad/s";
      break;
    case Outcome::step_too_small:
      text << "the contact after " << time << " s needs steps too small for the tolerance; ask for fewer digits";
      break;
    case Outcome::not_representable:
      text << "the contact after " << time << " s is too shallow, too deep or too large for double precision";
      break;
    case Outcome::flight_undecided: text << "no touch-down found after " << time << " s within the work allowed"; break;
    case Outcome::interrupted: text << "stopped on request after " << time << " s of motion"; break;
    case Outcome::time_limit:
      text << "stopped at the time asked for, " << request.until << " s";
      if (end.impact_goes_on) text << "; the impact that goes on then, since " << time << " s, is not listed";
      break;
  }
  return text.str();
}

constexpr double deep_part = 0.1;  ///< of the least extent: deeper, the body and not its skin is in the ground

/// Least extent of the body along its axes and the principal axes of its inertia [m].
double least_extent(const Body& body) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(body.inertia());
  double least = std::numeric_limits<double>::infinity();
  for (const Matrix3& axes : {Matrix3(Matrix3::Identity()), principal.eigenvectors()}) {
    Vector3 low = Vector3::Constant(least), high = -low;
    for (const Vector3& vertex : body.facets().vertices) {
      const Vector3 at = axes.transpose() * vertex;
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    least = std::min(least, (high - low).minCoeff());
  }
  return least;
}

/// The impacts in which the whole body sank; else the deepest one, where it is deep against the body.
std::vector<std::string> depth_warnings(const Body& body, const Ground& ground,
                                        const std::vector<ImpactRecord>& impacts) {
  std::ostringstream text;
  text.precision(3);
  std::string sunk;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    if (impacts[i].submerged) sunk += (sunk.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  const auto deepest =
      std::ranges::max_element(impacts, {}, [](const ImpactRecord& row) { return row.value.indentation; });
  const double depth = deepest == impacts.end() ? 0 : deepest->value.indentation;
  const auto impact = deepest - impacts.begin() + 1;
  if (!(depth > 0) && sunk.empty()) return {};
  if (!sunk.empty()) {
    text << "the whole body sinks below the ground in impact " << sunk << ": a foundation below it is no model of that";
  } else if (ground.is_pad()) {
    if (!(depth > ground.kinks.back().depth)) return {};
    text << "the body goes into the pad in impact " << impact << " by " << depth
         << " m, beyond the last point of its curve, " << ground.kinks.back().depth << " m";
  } else {
    const double extent = least_extent(body);
    if (!(depth > deep_part * extent)) return {};
    text << "the body goes " << depth << " m into the ground in impact " << impact
         << ", more than a tenth of its least extent, " << extent << " m: a "
         << (ground.is_half_space() ? "half-space" : "bed of springs") << " is no model of that";
  }
  return {text.str()};
}

/// The input has been checked: a value that leaves the domain of a formula during the run is no fault of the input.
DropRun run_checked(const Body& body, const World& world, const MotionState& start, const Request& request,
                    const Integration& integration, const Observer& observer) {
  try {
    return run_drop(body, world, start, request, integration, observer);
  } catch (const std::domain_error& error) {
    throw NumericalError(std::string("the drop cannot be computed in double precision: ") + error.what());
  }
}

/// The second run, until its impacts go another way than `rows` do, at the first `states` of the times.
DropRun run_again(const Body& body, const World& world, const MotionState& start, std::span<const ImpactRecord> rows,
                  std::span<const double> times, const Request& request, const Integration& main,
                  const SecondRun& second) {
  Request alone{.impacts = static_cast<int>(rows.size()), .error_estimates = false, .amplification = false};
  alone.starts_on_ground = request.starts_on_ground;
  alone.times.assign(times.begin(), times.end());
  // An impact that has just ended in the main run may end a little later here.
  alone.until = rows.empty() ? request.until
                             : std::max(request.until, rows.back().value.start + 1.1 * rows.back().value.duration);
  Integration integration = second.integration;
  std::size_t place = 0;
  if (is_adaptive(integration.method)) {
    integration.next_tolerance = [&](const ImpactRecord& row) {
      if (place >= rows.size()) return second.integration.steps.tolerance;
      const double looser = tolerance_beside(body, main.steps.tolerance, rows[place], row);
      return std::max(looser, second.integration.steps.tolerance);
    };
  }
  const auto goes_on = [&](const ImpactRecord& row) {
    return place < rows.size() && !goes_another_way(rows[place++], row);
  };
  return run_checked(body, world, start, alone, integration, {.history = nullptr, .impact = goes_on});
}

void check_start(const Body& body, const MotionState& start, bool starts_on_ground) {
  const bool finite = start.centre.allFinite() && start.attitude.coeffs().allFinite() && start.velocity.allFinite() &&
                      start.angular_velocity.allFinite();
  if (!finite) throw std::domain_error("the start: every number of the state must be finite");
  constexpr double rounding = 1e-6;
  const double length = start.attitude.norm();
  detail::require(std::fabs(length - 1) <= rounding, "length of the attitude's Euler parameters", length, "1");
  if (starts_on_ground) return;
  const double low = lowest_height(body, start);
  detail::require(low >= -1e-12 * body.radius(), "height of the lowest point", low, "at least 0");
}

}  // namespace

double Simulation::total_normal_impulse() const {
  double sum = 0;
  for (const ImpactRecord& row : impacts) sum += row.value.impulse.z();
  return sum;
}

Simulation simulate(const Body& body, const World& world, const MotionState& start, const Request& request,
                    const Accuracy& accuracy, const Observer& observer) {
  accuracy.validate();
  request.validate();
  world.validate();
  check_start(body, start, request.starts_on_ground);
  const Integration integration = integration_for(accuracy);
  DropRun main = run_checked(body, world, start, request, integration, observer);
  if (!request.times.empty()) {
    detail::require(request.times.front() >= main.start_time, "run.times", request.times.front(),
                    "at least the time of the start");
  }
  Simulation simulation;
  simulation.outcome = main.outcome;
  simulation.method = integration.method;
  simulation.tolerance = is_adaptive(integration.method) ? integration.steps.tolerance : 0;
  simulation.step = main.step;
  simulation.force_evaluations = main.force_evaluations;
  simulation.root_evaluations = main.root_evaluations;
  simulation.energy_start = main.energy_start;
  simulation.final_state = main.final_state;
  simulation.state_evaluations = main.state_evaluations;
  simulation.impacts = std::move(main.impacts);
  simulation.states = std::move(main.states);
  simulation.on_ground = main.on_ground;
  simulation.on_ground_from = main.on_ground_from;
  if (simulation.outcome == Outcome::at_rest) simulation.rest = rest_of(main);
  simulation.message = words_for(simulation, request, accuracy, main);
  simulation.warnings = depth_warnings(body, world.ground, simulation.impacts);
  const bool wants_estimates = request.error_estimates && simulation.outcome != Outcome::interrupted;
  const auto last = std::ranges::find(simulation.impacts, false, &ImpactRecord::predictable);
  const std::span<const ImpactRecord> known(simulation.impacts.data(),
                                            static_cast<std::size_t>(last - simulation.impacts.begin()));
  const std::size_t states = states_with_errors(simulation.states, known.size(), simulation.impacts.size());
  if (!wants_estimates || (known.empty() && states == 0)) {
    forget_errors(simulation.impacts);
    forget_errors(simulation.states);
    return simulation;
  }
  const SecondRun second = second_run(integration, main.step);
  const DropRun other =
      run_again(body, world, start, known, std::span(request.times).first(states), request, integration, second);
  simulation.force_evaluations += other.force_evaluations;
  simulation.root_evaluations += other.root_evaluations;
  simulation.state_evaluations += other.state_evaluations;
  estimate_errors(body, second.error_per_distance, simulation.impacts, other.impacts);
  estimate_state_errors(body, second.error_per_distance, simulation.tolerance, simulation.impacts, simulation.states,
                        other.states);
  return simulation;
}

}  // namespace clatter::numeric
