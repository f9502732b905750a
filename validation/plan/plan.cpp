// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "validation/compare/discrete_side.hpp"
#include "validation/output/number.hpp"
#include "validation/output/report.hpp"
#include "validation/plan/cost_table.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;
using numeric::Simulation;
using Rows = std::vector<MotionNumbers>;

constexpr double finest_pilot_tolerance = 1e-8;
constexpr double share_of_parts = 0.25;  // of what is asked, for all that is left out
constexpr double margin = 1.1;           // what an error measured against a run two decades finer may be wrong by
constexpr int timings = 2;               // of a continuous run; the first one also warms up
constexpr int timings_of_a_formula = 5;

double least_seconds_of(int repeats, const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

/// One plan in the making.
class Planner {
 public:
  Planner(const Scene& scene, const PlanTarget& target, const numeric::Observer& observer)
      : given_(scene), ladder_(limited(without(scene, Part::unmerged_faces)), observer), full_(ladder_.full()) {
    plan_.target = target;
    plan_.asked = std::pow(10.0, -target.digits);
    plan_.scene = scene;
  }

  Plan make() {
    run_pilots();
    if (truth_.empty()) return std::move(plan_);
    weigh_parts();
    weigh_continuous();
    weigh_the_rest();
    choose();
    price_estimates();
    measure();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] int impacts() const { return static_cast<int>(truth_.size()); }

  void run_pilots() {
    const int wanted = ladder_.scene().request.impacts;
    Simulation finest;
    LevelSetting setting{.level = full_, .method = Method::rkck, .tolerance = finest_pilot_tolerance};
    const auto run_finest = [&] { finest = ladder_.simulate(setting, wanted); };
    double seconds = least_seconds_of(timings, run_finest);
    // A switch between slip and stick may be met in a step that cannot be made small enough; another method meets it
    // at another place.
    if (finest.outcome == numeric::Outcome::step_too_small) {
      setting = {.level = full_, .method = Method::rk8pd, .tolerance = finest_pilot_tolerance / 10};
      seconds = least_seconds_of(timings, run_finest);
    }
    plan_.planning_evaluations = timings * finest.force_evaluations;
    plan_.pilot_ending = finest.message;
    plan_.cut_short = is_cut_short(finest.outcome);
    seconds_per_evaluation_ = seconds / static_cast<double>(finest.force_evaluations);
    if (finest.impacts.empty()) return;
    truth_ = motion_rows(run_of(finest));
    plan_.impacts = impacts();
    sizes_ = motion_sizes(finest, finest.impacts.size(), ladder_.body());
    for (const numeric::ImpactRecord& row : finest.impacts) contact_times_.push_back(row.value.duration);
    const LevelResult loose = pilot(CostTable::loose_tolerance), middle = pilot(CostTable::pilot_tolerance);
    pilot_base_ = static_cast<double>(middle.evaluations);
    const double error = distance(middle.rows, truth_, sizes_), loose_error = distance(loose.rows, truth_, sizes_);
    plan_.error_constant =
        std::isfinite(loose_error) ? CostTable::error_constant(loose_error, error) : error / CostTable::pilot_tolerance;
    watch_the_plane();
  }

  LevelResult pilot(double tolerance) {
    const LevelResult result = ladder_.run({.level = full_, .method = Method::rkck, .tolerance = tolerance}, impacts());
    plan_.planning_evaluations += result.evaluations;
    return result;
  }

  /// How long the planar level's motion is that of a body in space.
  void watch_the_plane() {
    plan_.predictable_impacts = impacts();
    if (full_ != ModelLevel::planar || plan_.scene.world.planar) return;
    const Scene& scene = ladder_.scene();
    const numeric::Request request{.impacts = impacts(), .error_estimates = false, .amplification = true};
    numeric::Accuracy accuracy = scene.accuracy;
    accuracy.method = Method::rkck;
    accuracy.tolerance = CostTable::pilot_tolerance;
    accuracy.step = 0;
    const Simulation run = numeric::simulate(ladder_.body(), scene.world, scene.start(ladder_.body()), request,
                                             accuracy, ladder_.observer());
    plan_.planning_evaluations += run.force_evaluations;
    plan_.predictable_impacts = 0;
    for (const numeric::ImpactRecord& row : run.impacts) {
      plan_.growth_out_of_plane = row.amplification;
      if (!(row.amplification * std::numeric_limits<double>::epsilon() <= plan_.asked)) break;
      ++plan_.predictable_impacts;
    }
  }

  /// Leaves out what changes little enough and saves evaluations.
  void weigh_parts() {
    double spent = 0;
    for (const Part part : all_parts) {
      if (!has_part(plan_.scene, part)) continue;
      WeighedPart weighed{.part = part};
      if (part == Part::unmerged_faces) {
        weighed.left_out = true;
      } else {
        const ModelHierarchy reduced(without(ladder_.scene(), part), ladder_.observer());
        const LevelResult result =
            reduced.run({.level = full_, .method = Method::rkck, .tolerance = finest_pilot_tolerance}, impacts());
        plan_.planning_evaluations += result.evaluations;
        weighed.error = distance(result.rows, truth_, sizes_);
        const double known_to = weighed.error + plan_.error_constant * finest_pilot_tolerance;
        weighed.left_out = part != Part::gravity_in_contact && spent + known_to <= share_of_parts * plan_.asked;
        if (weighed.left_out) spent += known_to;
      }
      if (weighed.left_out) plan_.scene = without(plan_.scene, part);
      plan_.parts.push_back(weighed);
    }
    budget_ = plan_.asked - spent;
    ladder_ = ModelHierarchy(limited(plan_.scene), ladder_.observer());
  }

  void weigh_continuous() {
    WeighedLevel weighed{.level = full_};
    ToleranceSearch search(ladder_, full_, impacts(), sizes_, plan_.error_constant, pilot_base_);
    const FoundSetting found = search.cheapest(budget_ / margin);
    plan_.planning_evaluations += search.evaluations_spent();
    if (found.reference.size() == truth_.size()) truth_ = found.reference;  // else it ended early, and nothing serves
    plan_.known_impacts = known_impacts(found);
    weighed.setting = found.setting;
    weighed.error = found.error;
    weighed.evaluations = static_cast<double>(found.evaluations);
    weighed.serves = found.serves;
    weighed.seconds = weighed.evaluations * seconds_per_evaluation_;
    continuous_ = weighed;
  }

  [[nodiscard]] int known_impacts(const FoundSetting& found) const {
    int count = 0;
    for (std::size_t i = 0; i < found.errors.size() && found.errors[i] <= plan_.asked; ++i) ++count;
    return count;
  }

  void weigh_the_rest() {
    for (const ModelLevel level : all_levels) {
      WeighedLevel weighed{.level = level};
      weighed.against = ladder_.against(level);
      weighed.setting = {.level = level};
      if (level == full_) weighed = continuous_;
      else if (weighed.against.empty()) run_rung(weighed);
      if (weighed.against.empty()) weigh_assumption(weighed);
      plan_.levels.push_back(weighed);
    }
  }

  void run_rung(WeighedLevel& weighed) {
    if (is_continuous(weighed.level)) {
      weighed.setting = continuous_.setting;
      weighed.setting.level = weighed.level;
    }
    LevelResult result;
    try {
      weighed.seconds = least_seconds_of(is_continuous(weighed.level) ? timings : timings_of_a_formula,
                                         [&] { result = ladder_.run(weighed.setting, impacts()); });
    } catch (const analytic::OutsideModelError& error) {  // from the first impact on
      weighed.against = error.what();
      return;
    } catch (const analytic::NumericalError& error) {
      weighed.against = error.what();
      return;
    }
    weighed.error = distance(result.rows, truth_, sizes_);
    weighed.serves = margin * weighed.error <= budget_;
    if (weighed.level == ModelLevel::closed_form) closed_form_rows_ = result.rows;
    if (!is_continuous(weighed.level)) return;
    weighed.evaluations = static_cast<double>(result.evaluations);
    plan_.planning_evaluations += timings * result.evaluations;
  }

  void weigh_assumption(WeighedLevel& weighed) const {
    if (weighed.level == ModelLevel::closed_form) weighed.assumption_error = thinness();
    if (weighed.level == ModelLevel::discrete) weighed.assumption_error = contact_effects(*ladder_.drop());
    if (weighed.level == ModelLevel::discrete_in_space)
      weighed.assumption_error = contact_effects(*ladder_.space_drop());
    if (weighed.level == ModelLevel::planar)
      weighed.assumption_error = plan_.growth_out_of_plane * std::numeric_limits<double>::epsilon();
  }

  /// What the rod's radius changes: closed form against the discrete model at the rod's real corners.
  [[nodiscard]] double thinness() const {
    return distance(closed_form_rows_, ladder_.run({.level = ModelLevel::discrete}, impacts()).rows, sizes_);
  }

  /// What gravity, turning, indentation and delay of the contacts change, carried on by the discrete model.
  [[nodiscard]] double contact_effects(const auto& drop) const {
    const auto sequence = impact_sequence(drop, {.impacts = impacts(), .amplification = false});
    double worst = 0;
    for (const PredictedSize& row : predicted_sizes(drop, sequence, contact_times_)) {
      const MotionNumbers total = row.total();
      for (std::size_t q = 0; q < motion_number_count; ++q) worst = std::max(worst, total[q] / sizes_[q]);
    }
    return worst;
  }

  [[nodiscard]] bool fits(double seconds) const {
    return !plan_.target.within_ms || 1e3 * seconds <= *plan_.target.within_ms;
  }

  void take(const WeighedLevel& weighed) {
    plan_.choice = weighed.setting;
    plan_.error = weighed.error;
    plan_.evaluations = weighed.evaluations;
    plan_.seconds = weighed.seconds;
    plan_.serves = weighed.serves;
  }

  void choose() {
    for (const WeighedLevel& weighed : plan_.levels) {
      if (!plan_.target.most_accurate && weighed.serves && fits(weighed.seconds)) return take(weighed);
    }
    if (plan_.target.within_ms) choose_most_accurate();
    else take(continuous_);
  }

  /// The most accurate level of all that fit into the time by the table is taken.
  void choose_most_accurate() {
    WeighedLevel best;
    for (const WeighedLevel& weighed : plan_.levels) {
      const bool better = std::isnan(best.error) || weighed.error < best.error;
      if (weighed.against.empty() && fits(weighed.seconds) && better) best = weighed;
    }
    const CostTable& table = CostTable::measured();
    for (const Method method : {Method::rkck, Method::rk8pd}) {
      for (int i = 0; i < tolerance_steps; ++i) {
        WeighedLevel weighed{.level = full_};
        weighed.setting = {.level = full_, .method = method, .tolerance = half_decade(i)};
        weighed.error = plan_.error_constant * half_decade(i) * table.error(method, half_decade(i));
        weighed.evaluations = pilot_base_ * table.evaluations(method, half_decade(i));
        weighed.seconds = weighed.evaluations * seconds_per_evaluation_;
        weighed.serves = margin * weighed.error <= budget_;
        if (fits(weighed.seconds) && (std::isnan(best.error) || weighed.error < best.error)) best = weighed;
      }
    }
    take(best);
  }

  void price_estimates() {
    numeric::Request request = plan_.scene.request;
    const bool asks = request.error_estimates || request.amplification;
    if (!asks || !is_continuous(plan_.choice.level) || !std::isfinite(plan_.error)) return;
    request.impacts = impacts();
    const long evaluations = ladder_.simulate(plan_.choice, request).force_evaluations;
    plan_.planning_evaluations += evaluations;
    plan_.evaluations_with_estimates = static_cast<double>(evaluations);
    plan_.seconds_with_estimates = plan_.seconds * static_cast<double>(evaluations) / plan_.evaluations;
  }

  void measure() {
    Scene scene = given_;
    scene.accuracy.digits = plan_.target.digits;
    const numeric::Body body = scene.make_body();
    PlannedRun run;
    plan_.simulate_seconds = least_seconds_of(1, [&] { run = run_to_digits(scene, body, ladder_.observer()); });
    plan_.simulate_evaluations = run.run.force_evaluations;
  }

  const Scene& given_;
  ModelHierarchy ladder_;
  ModelLevel full_;
  Plan plan_;
  Rows truth_, closed_form_rows_;
  MotionNumbers sizes_{};
  std::vector<double> contact_times_;
  double pilot_base_ = 0, seconds_per_evaluation_ = 0, budget_ = 0;
  WeighedLevel continuous_;
};

}  // namespace

Plan make_plan(const Scene& scene, const PlanTarget& target, const numeric::Observer& observer) {
  return Planner(scene, target, observer).make();
}

namespace {

using Overrides = std::vector<SceneOverride>;

/// What the choice of a continuous level sets.
Overrides chosen_keys(const Plan& plan) {
  Overrides keys{{"run.method", "", method_name(plan.choice.method)},
                 {"run.tolerance", "", shortest(plan.choice.tolerance)}};
  if (plan.choice.level == ModelLevel::planar && !plan.scene.world.planar) keys.push_back({"run.planar", "", "true"});
  for (const WeighedPart& part : plan.parts) {
    if (part.left_out && part.part == Part::friction) {
      for (const char* key : {"ground.static_friction", "ground.sliding_friction"}) keys.push_back({key, "", "0"});
    }
    if (part.left_out && part.part == Part::damping) {
      const bool has_dissipation = plan.scene.world.ground.has_dissipation();
      keys.push_back({has_dissipation ? "ground.dissipation" : "ground.damping", "", "0"});
    }
  }
  return keys;
}

/// The flags that were given, but those of keys that the choice sets or that its model does not have.
Overrides kept(const Plan& plan, const Overrides& chosen) {
  const Model model = is_continuous(plan.choice.level) ? Model::continuous : Model::discrete;
  Overrides rest = plan.given;
  std::erase_if(rest, [&](const SceneOverride& given) {
    return given.key == "run.step" || !key_named(given.key).is_for(model) ||
           std::ranges::any_of(chosen, [&](const SceneOverride& set) { return set.key == given.key; });
  });
  return rest;
}

}  // namespace

std::string command_line(const Plan& plan) {
  const bool continuous = is_continuous(plan.choice.level);
  const std::string source = name_of_source(plan.scene.path);
  const Overrides chosen = continuous ? chosen_keys(plan) : Overrides{};
  return fmt::format("clatter {}{}{}{}", continuous ? "simulate" : "sequence",
                     source.empty() ? "" : " " + shell_word(source), flag_words(kept(plan, chosen)),
                     flag_words(chosen));
}

}  // namespace clatter::validation
