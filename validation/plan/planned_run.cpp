// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/planned_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/drop/error_estimates.hpp"
#include "numeric/motion/free_flight.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/cost_table.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/run/states.hpp"
#include "validation/scene/facet_words.hpp"
#include "validation/scene/names.hpp"
#include "validation/scene/pad.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Method methods[] = {Method::rkck, Method::rk8pd};
constexpr double guess_margin = 3;     // the table's medians are off by this on many scenes
constexpr double worth_trying = 2;     // a method predicted to cost this much more than the other is left
constexpr double decades_apart = 1.5;  // of tolerance, to see how an error falls with it
constexpr int finer_steps = 4;         // the reference is two decades of tolerance finer

std::size_t index_of(Method method) { return method == Method::rkck ? 0 : 1; }

}  // namespace

double half_decade(int index) { return std::max(1e-4 * std::pow(10.0, -0.5 * index), numeric::least_tolerance); }

/// A method and tolerance that the measured table predicts to serve.
struct PredictedSetting {
  Method method = Method::rkck;
  int index = 0;           ///< of half_decade
  double evaluations = 0;  ///< over those of rkck at CostTable::pilot_tolerance
};

namespace {

/// The loosest tolerance of a method whose predicted error is a third of `asked`, or the smallest tolerance.
/// @param error_constant of the scene: error over tolerance of rkck
PredictedSetting predicted_setting(Method method, double error_constant, double asked) {
  const CostTable& table = CostTable::measured();
  int index = 0;
  const auto error = [&](int i) { return error_constant * half_decade(i) * table.error(method, half_decade(i)); };
  while (index < tolerance_steps - 1 && !(guess_margin * error(index) <= asked)) ++index;
  return {method, index, table.evaluations(method, half_decade(index))};
}

/// The cheaper one of rkck and rk8pd.
PredictedSetting cheapest_by_table(double error_constant, double asked) {
  const PredictedSetting low = predicted_setting(methods[0], error_constant, asked);
  const PredictedSetting high = predicted_setting(methods[1], error_constant, asked);
  return high.evaluations < low.evaluations ? high : low;
}

}  // namespace

ToleranceSearch::ToleranceSearch(const ModelHierarchy& hierarchy, ModelLevel level, int impacts,
                                 const MotionNumbers& sizes, double error_constant, double pilot_evaluations)
    : hierarchy_(hierarchy), level_(level), impacts_(impacts), sizes_(sizes), error_constant_(error_constant),
      pilot_evaluations_(pilot_evaluations) {}

/// The finer run; at least as fine as any trial.
void ToleranceSearch::find_reference(double asked, int index) {
  const int finest = tolerance_steps - 1;
  const PredictedSetting start = predicted_setting(Method::rk8pd, error_constant_, asked / 100);
  const LevelSetting setting{.level = level_,
                             .method = Method::rk8pd,
                             .tolerance = half_decade(std::min(finest, std::max(start.index, index + finer_steps)))};
  const LevelResult result = hierarchy_.run(setting, impacts_);
  spent_ += result.evaluations;
  reference_ = result.rows;
  reference_errors_.assign(reference_.size(), 0);
  if (setting.tolerance > half_decade(finest)) return;
  // There is none two decades finer than the finest trial, so the reference's own error counts too.
  LevelSetting coarser = setting;
  coarser.tolerance *= std::pow(10.0, decades_apart);
  const LevelResult other = hierarchy_.run(coarser, impacts_);
  spent_ += other.evaluations;
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    const bool is_there = i < other.rows.size();
    const double apart = is_there ? row_distance(other.rows[i], reference_[i], sizes_) : infinity;
    reference_errors_[i] = guess_margin * apart / std::pow(10.0, decades_apart);
  }
}

ToleranceSearch::Trial& ToleranceSearch::trial(Method method, int index) {
  Trial& trial = trials_[index_of(method)][index];
  if (trial.known) return trial;
  trial.result = hierarchy_.run({.level = level_, .method = method, .tolerance = half_decade(index)}, impacts_);
  const std::vector<MotionNumbers>& rows = trial.result.rows;
  trial.error = reference_.size() < static_cast<std::size_t>(impacts_) ? infinity : 0;  // the reference ended early
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    const double apart = i < rows.size() ? row_distance(rows[i], reference_[i], sizes_) : infinity;
    trial.errors.push_back(apart + reference_errors_[i]);
    trial.error = std::max(trial.error, trial.errors.back());
  }
  trial.known = true;
  spent_ += trial.result.evaluations;
  return trial;
}

void ToleranceSearch::take(Method method, int index, double asked, FoundSetting& best) {
  const Trial& found = trial(method, index);
  const bool serves = found.error <= asked;
  const bool better = serves ? !best.serves || found.result.evaluations < best.evaluations
                             : !best.serves && (best.evaluations == 0 || found.error < best.error);
  if (!better) return;
  best.setting = {.level = level_, .method = method, .tolerance = half_decade(index)};
  best.error = found.error;
  best.evaluations = found.result.evaluations;
  best.serves = serves;
  best.errors = found.errors;
}

/// From the predicted tolerance to tighter ones until it serves, or to looser ones as long as it does.
void ToleranceSearch::descend(const PredictedSetting& start, double asked, FoundSetting& best) {
  int index = start.index;
  while (!(trial(start.method, index).error <= asked) && index < tolerance_steps - 2) ++index;
  take(start.method, index, asked, best);
  while (index > 0 && trial(start.method, index - 1).error <= asked) take(start.method, --index, asked, best);
}

FoundSetting ToleranceSearch::cheapest(double asked) {
  PredictedSetting starts[] = {predicted_setting(methods[0], error_constant_, asked),
                               predicted_setting(methods[1], error_constant_, asked)};
  find_reference(asked, std::max(starts[0].index, starts[1].index));
  if (starts[1].evaluations < starts[0].evaluations) std::swap(starts[0], starts[1]);
  FoundSetting best;
  descend(starts[0], asked, best);
  if (!best.serves ||
      pilot_evaluations_ * starts[1].evaluations <= worth_trying * static_cast<double>(best.evaluations)) {
    descend(starts[1], asked, best);
  }
  best.reference = reference_;
  return best;
}

namespace {

using numeric::Accuracy;
using numeric::Method;
using numeric::Outcome;
using numeric::Simulation;

constexpr int most_repeats = 3;
constexpr long evaluations_of_a_pilot = 200'000;
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
constexpr double estimate_margin = 4;  // what error estimates exceed errors by; a first run that they accept is cheaper
constexpr double different_ways = 0.1;
constexpr double power_of_tolerance = 0.9;  // with which errors fall
constexpr double usual_error_constant = 1;  // median over many scenes, for one whose pilots go different ways

/// Largest error of an impact over the sequence's sizes.
double relative_error(const numeric::ImpactRecord& row, const MotionNumbers& sizes) {
  return row_distance(motion_numbers(impact_of(row).error), {}, sizes);
}

/// Whether errors have grown so far at row i that the digits asked are lost: by amplification, or where that is not
/// known, by the errors of an adaptive method themselves, which then say nothing of what a repeated run would reach.
bool has_outgrown(const PlannedRun& planned, std::size_t i) {
  const numeric::ImpactRecord& row = planned.run.impacts[i];
  if (!row.predictable) return true;
  if (!std::isnan(row.amplification)) return rounding * row.amplification > planned.asked;
  const bool estimated = planned.run.tolerance > 0 && !std::isnan(planned.run.impacts[0].error.impulse.z());
  return i > 0 && estimated && !(relative_error(row, planned.sizes) <= planned.asked);
}

/// Fills in what was achieved.
void judge(const numeric::Body& body, PlannedRun& planned) {
  const std::vector<numeric::ImpactRecord>& rows = planned.run.impacts;
  if (!rows.empty()) planned.sizes = motion_sizes(planned.run, rows.size(), body);
  std::size_t count = 0;
  while (count < rows.size() && !has_outgrown(planned, count)) ++count;
  planned.known_impacts = static_cast<int>(count);
  planned.achieved = std::numeric_limits<double>::quiet_NaN();
  if (count == 0 || std::isnan(rows[0].error.impulse.z())) return;
  const MotionNumbers sizes = motion_sizes(planned.run, count, body);
  planned.achieved = 0;
  for (std::size_t i = 0; i < count; ++i) planned.achieved = std::max(planned.achieved, relative_error(rows[i], sizes));
}

/// Largest error of the first impacts, those that the least tolerance would bring to half of what is asked.
/// No more than `count` of them, which becomes how many they are.
double error_within_reach(const numeric::Body& body, const PlannedRun& planned, std::size_t& count) {
  const std::vector<numeric::ImpactRecord>& rows = planned.run.impacts;
  const double gain = std::pow(numeric::least_tolerance / planned.run.tolerance, power_of_tolerance);
  double worst = 0;
  for (std::size_t i = 0; i < std::min(count, rows.size()); ++i) {
    numeric::ImpactRecord rounded = rows[i];
    rounded.error = numeric::rounding_errors(body, rows[i]);
    const double error = relative_error(rows[i], planned.sizes), floor = relative_error(rounded, planned.sizes);
    const double growth = rows[i].amplification;
    const double least = std::isfinite(error) ? (error - floor) * gain : numeric::least_tolerance * growth;
    const bool is_lost = std::isnan(growth) && has_outgrown(planned, i);
    if (is_lost || !(estimate_margin * floor + least <= planned.asked / 2)) {
      count = i;
      break;
    }
    worst = std::max(worst, error);
  }
  return worst;
}

/// One run after another of the same drop.
class Runner {
 public:
  Runner(const numeric::Body& body, const numeric::World& world, const numeric::MotionState& start,
         const numeric::Request& request, const Accuracy& accuracy, const numeric::Observer& observer)
      : body_(body), world_(world), start_(start), request_(request), accuracy_(accuracy), observer_(observer) {}

  PlannedRun run() {
    Accuracy accuracy = accuracy_;
    take_cheapest(accuracy);
    PlannedRun planned{.run = {}, .planned = true, .asked = std::pow(10.0, -accuracy.digits), .warnings = {}};
    planned.run = simulate(request_, accuracy);
    std::size_t within_reach = planned.run.impacts.size();
    for (int repeat = 0;; ++repeat) {
      judge(body_, planned);
      if (repeat == most_repeats) break;
      const double error = std::isnan(planned.achieved) ? 0 : error_within_reach(body_, planned, within_reach);
      if (planned.run.outcome == Outcome::step_too_small) {  // as in Planner::run_pilots
        accuracy.method = Method::rk8pd;
        accuracy.tolerance = std::max(0.01 * accuracy.tolerance, numeric::least_tolerance);
        planned.run = simulate(request_, accuracy);
      } else if (error > planned.asked && accuracy.tolerance > numeric::least_tolerance) {
        const double part = std::clamp(0.5 * planned.asked / error, 1e-3, 0.3);
        const double before = accuracy.tolerance;
        accuracy.tolerance = std::max(part * before, numeric::least_tolerance);
        Simulation tighter = simulate(request_, accuracy);
        // A limit on the work can leave a tighter run, or its errors, untold: then the looser one tells more.
        const bool tells = tighter.impacts.size() >= planned.run.impacts.size() || !is_cut_short(tighter.outcome);
        if (!tells || tighter.impacts.empty() || std::isnan(tighter.impacts[0].error.impulse.z())) {
          accuracy.tolerance = before;
          break;
        }
        planned.run = std::move(tighter);
      } else {
        break;
      }
    }
    if (observer_.history && planned.run.outcome != Outcome::interrupted) record(accuracy, planned);
    planned.run.force_evaluations = evaluations_;
    return planned;
  }

 private:
  Simulation simulate(const numeric::Request& request, const Accuracy& accuracy) {
    Simulation run = numeric::simulate(body_, world_, start_, request, accuracy, {.progress = observer_.progress});
    evaluations_ += run.force_evaluations;
    return run;
  }

  /// The same run again, without errors: what recording costs does not count.
  void record(const Accuracy& accuracy, PlannedRun& planned) const {
    numeric::Request alone = request_;
    alone.error_estimates = alone.amplification = false;
    Simulation again = numeric::simulate(body_, world_, start_, alone, accuracy, observer_);
    if (again.outcome == Outcome::interrupted) planned.run = std::move(again);
  }

  Simulation pilot(double tolerance) {
    Accuracy accuracy = accuracy_;
    accuracy.method = Method::rkck;
    accuracy.tolerance = tolerance;
    accuracy.evaluation_limit = std::min(accuracy.evaluation_limit, evaluations_of_a_pilot);
    numeric::Request alone{.impacts = request_.impacts, .error_estimates = false, .amplification = false};
    alone.starts_on_ground = request_.starts_on_ground;
    alone.until = request_.until;
    return simulate(alone, accuracy);
  }

  /// Over the impacts before the runs go different ways.
  [[nodiscard]] double common_distance(const Simulation& run, const Simulation& finer) const {
    const MotionNumbers sizes = motion_sizes(finer, finer.impacts.size(), body_);
    double worst = 0;
    for (std::size_t i = 0; i < std::min(run.impacts.size(), finer.impacts.size()); ++i) {
      const double apart = row_distance(motion_numbers(impact_of(run.impacts[i]).value),
                                        motion_numbers(impact_of(finer.impacts[i]).value), sizes);
      if (!(apart <= different_ways)) break;
      worst = std::max(worst, apart);
    }
    return worst;
  }

  void take_cheapest(Accuracy& accuracy) {
    const Simulation loose = pilot(CostTable::loose_tolerance), finer = pilot(CostTable::pilot_tolerance);
    double constant = usual_error_constant;
    if (!finer.impacts.empty()) {
      const double error = common_distance(loose, finer);
      if (error > 0) constant = error / CostTable::loose_tolerance;
    }
    const PredictedSetting setting = cheapest_by_table(constant, std::pow(10.0, -accuracy.digits) / estimate_margin);
    accuracy.method = setting.method;
    accuracy.tolerance = half_decade(setting.index);
  }

  const numeric::Body& body_;
  const numeric::World& world_;
  const numeric::MotionState& start_;
  const numeric::Request& request_;
  const Accuracy& accuracy_;
  const numeric::Observer& observer_;
  long evaluations_ = 0;
};

/// The state of the flight that ends in `touch`, at a time before that [s]; its errors are those of rounding.
numeric::StateRecord before_touch(const numeric::Body& body, const numeric::World& world,
                                  const numeric::MotionState& touch, double time) {
  numeric::StateRecord at;
  at.time = time;
  at.known = true;
  at.state = numeric::FreeFlight(body, touch, world.pull(), world.planar).at(time);
  at.energy = numeric::mechanical_energy(body, at.state, world.pull());
  const double turned = touch.angular_velocity.norm() * std::fabs(time), radius = body.radius();
  const double speed = std::max(at.state.velocity.norm(), touch.velocity.norm());
  const double spin = at.state.angular_velocity.norm();
  at.error = {.position = rounding * (radius + speed * std::fabs(time)),
              .angle = rounding * (1 + turned),
              .velocity = rounding * (speed + world.gravity * std::fabs(time)),
              .angular_velocity = rounding * spin * (1 + turned),
              .energy = rounding * (std::fabs(at.energy) + body.mass() * speed * speed)};
  return at;
}

/// The states at the scene's times, by one more run, which changes no other number.
/// @param fall  from the release to the touch [s]
void add_states(const Scene& scene, const numeric::Body& body, const numeric::MotionState& start, double fall,
                const numeric::Observer& observer, PlannedRun& planned) {
  Simulation& run = planned.run;
  if (!scene.has_times() || run.outcome == Outcome::interrupted) return;
  const std::vector<double> times = state_times(scene, run_of(run));
  const auto touch = std::lower_bound(times.begin(), times.end(), 0.0);
  for (auto time = times.begin(); time != touch; ++time) {
    run.states.push_back(before_touch(body, scene.world, start, *time));
    if (*time < -fall) run.states.back().known = false;  // it is not let go yet
  }
  if (touch == times.end()) return;
  Accuracy accuracy = scene.accuracy;
  accuracy.method = run.method;
  accuracy.tolerance = run.tolerance;
  accuracy.step = run.step;
  numeric::Request request = scene.request;
  request.impacts = 1;  // it goes on to the last of the times
  request.until = infinity;
  request.times.assign(touch, times.end());
  Simulation told = numeric::simulate(body, scene.world, start, request, accuracy, {.progress = observer.progress});
  add_facet_errors(scene, told);
  run.states.insert(run.states.end(), told.states.begin(), told.states.end());
}

/// A warning that tells where a body that is put down at rest lies otherwise than asked; empty: it does not.
std::string laid_warning(const Scene& scene, const numeric::MotionState& start) {
  constexpr double least = 0.5;  // [°]
  if (!scene.request.starts_on_ground) return "";
  const numeric::Vector3 asked = scene.touch_attitude().conjugate() * numeric::Vector3::UnitZ(),
                         lies = start.attitude.conjugate() * numeric::Vector3::UnitZ();
  const double off = std::atan2(asked.cross(lies).norm(), asked.dot(lies)) * analytic::degrees_per_radian;
  if (!(off > least)) return "";
  return fmt::format(
      "put down at rest, the body comes to lie {}° from the attitude asked for, where the ground carries it",
      significant(off, 3));
}

/// A warning if the motion is kept in its plane although nothing but that keeps it there; empty: none.
std::string planar_warning(const numeric::Body& body, const numeric::World& world, const numeric::MotionState& start) {
  if (!world.planar || is_mirror_image(body, start)) return "";
  return "kept in its plane, although the body as it lies or moves is not its own mirror image there: velocities, "
         "forces and moments out of the plane are left out";
}

}  // namespace

PlannedRun run_to_digits(const Scene& scene, const numeric::Body& body, const numeric::Observer& observer) {
  const Accuracy& accuracy = scene.accuracy;
  const numeric::World& world = scene.world;
  double fall = 0;
  const numeric::MotionState start = scene.start(body, &fall);
  const bool plans = accuracy.method == Method::automatic && accuracy.step == 0 && accuracy.tolerance == 0;
  PlannedRun planned;
  if (plans) {
    planned = Runner(body, world, start, scene.request, accuracy, observer).run();
  } else {
    planned.run = numeric::simulate(body, world, start, scene.request, accuracy, observer);
    planned.asked = std::pow(10.0, -accuracy.digits);
  }
  if (scene.is_released()) planned.first_touch = first_touch_of(fall, start);
  add_facet_errors(scene, planned.run);
  judge(body, planned);
  add_states(scene, body, start, fall, observer, planned);
  const std::string out_of_plane = planar_warning(body, world, start);
  if (!out_of_plane.empty()) planned.warnings.push_back(out_of_plane);
  if (const std::string laid = laid_warning(scene, start); !laid.empty()) planned.warnings.push_back(laid);
  double depth = 0;
  bool sinks = false;
  for (const numeric::ImpactRecord& row : planned.run.impacts)
    depth = std::max(depth, row.value.indentation), sinks = sinks || row.submerged;
  for (const std::string& warning : planned.run.warnings) {
    planned.warnings.push_back(warning + (sinks ? "" : pad_remark(scene, depth)));
    if (!sinks && !world.ground.is_pad()) planned.deep = planned.warnings.back();
  }
  if (const std::string deep = springs_warning(scene, depth); !deep.empty()) planned.warnings.push_back(deep);
  return planned;
}

std::string shortfall(const Scene& scene, const PlannedRun& planned) {
  const numeric::Simulation& run = planned.run;
  if (is_cut_short(run.outcome)) return fmt::format("{}: {}", outcome_name(run), run.message);
  if (!scene.require_digits || run.impacts.empty()) return "";
  if (!scene.request.error_estimates) return "run.require_digits: without run.errors no digit is known";
  const int impacts = static_cast<int>(run.impacts.size());
  if (planned.known_impacts < impacts)
    return fmt::format("asked {} digits, achieved of the first {} of {} impacts only", scene.accuracy.digits,
                       planned.known_impacts, impacts);
  return digits_shortfall(scene.accuracy.digits, planned.achieved);
}

}  // namespace clatter::validation
