// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/discrete_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "validation/compare/random_scenes.hpp"
#include "validation/evidence/check.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/event_oracle.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/motion_numbers.hpp"

namespace clatter::validation {
namespace {

using analytic::FrictionKind;
using analytic::Impact;
using analytic::ImpactRow;
using analytic::Outcome;
using analytic::RowErrors;
using analytic::Sequence;
using analytic::Tail;

/// Bounces that have shrunk to 1e-26 leave 28 of these digits to heights.
using Real = oracle::Decimal<80>;
/// Where gravity has no time to act between bounces, heights shrink much faster than speeds.
using LongReal = oracle::Decimal<240>;

/// Uniform solids: k² = (3r² + L²)/12 for the cylinder, (L² + T²)/12 for the box.
template <class R>
oracle::EventBody<R> simulated_body(const BarScene& scene) {
  const R L = scene.length, h = scene.half_thickness;
  const R thickness_part = scene.shape == BarShape::box ? R(4 * h * h) : R(3 * h * h);
  oracle::EventBody<R> body{scene.mass, (L * L + thickness_part) / 12, {{-L / 2, -h}, {L / 2, -h}}};
  if (scene.shape != BarShape::thin_rod) {
    body.vertices.push_back({-L / 2, h});
    body.vertices.push_back({L / 2, h});
  }
  return body;
}

template <class To, class From>
oracle::EventState<To> converted(const oracle::EventState<From>& s) {
  return {To(s.inclination), To(s.normal), To(s.tangential), To(s.angular)};
}

template <class R>
oracle::EventSequence<Real> simulated(const BarScene& scene, std::size_t impacts) {
  const oracle::EventLaw<R> law{scene.law.restitution,
                                static_cast<oracle::EventRestitution>(scene.law.law),
                                static_cast<oracle::EventFriction>(scene.law.friction),
                                scene.law.friction_value,
                                scene.gravity,
                                scene.law.damping_per_stiffness};
  const oracle::EventBody<R> body = simulated_body<R>(scene);
  const R angle = oracle::radians(R(scene.degrees));
  const analytic::PlanarVelocity& v = scene.velocity;
  oracle::EventSimulation<R> simulation(body, {angle, v.normal, v.tangential, v.angular}, law);
  const oracle::EventSequence<R> found = simulation.run(impacts, R(1e-18));
  oracle::EventSequence<Real> sequence{{}, found.end};
  for (const auto& i : found.impacts) {
    sequence.impacts.push_back({i.vertex, Real(i.time), converted<Real>(i.before), converted<Real>(i.after),
                                Real(i.approach), Real(i.separation), Real(i.normal_impulse),
                                Real(i.tangential_impulse), Real(i.energy_before), Real(i.energy_after)});
  }
  return sequence;
}

/// How far the simulation must go to judge a sequence: as far as rows are said to be known, and to
/// the end where that is said to be certain, since a sequence may see it long before.
std::size_t impacts_to_simulate(const Sequence& sequence) {
  constexpr std::size_t longest = 20'000;
  if (!sequence.end_predictable) {
    const auto known = std::count_if(sequence.rows.begin(), sequence.rows.end(),
                                     [](const ImpactRow& row) { return row.error.predictable; });
    return std::max<std::size_t>(1, static_cast<std::size_t>(known));
  }
  return sequence.outcome == Outcome::impact_limit ? sequence.rows.size() : longest;
}

oracle::EventSequence<Real> exact(const BarScene& scene, std::size_t impacts) {
  const bool slow = scene.gravity > 0 && scene.law.restitution > 0.2;
  return slow ? simulated<Real>(scene, impacts) : simulated<LongReal>(scene, impacts);
}

Outcome outcome_of(oracle::EventEnd end) {
  switch (end) {
    case oracle::EventEnd::no_further: return Outcome::no_further_impact;
    case oracle::EventEnd::limit: return Outcome::impact_limit;
    case oracle::EventEnd::one_vertex_rests: return Outcome::sustained_contact;
    default: return Outcome::at_rest;
  }
}

/// A face that rattles less than doubles can tell from rest may have one vertex at rest first.
bool same_end(Outcome outcome, const oracle::EventSequence<Real>& truth) {
  if (outcome == outcome_of(truth.end)) return true;
  const oracle::EventImpact<Real>&first = truth.impacts.front(), &last = truth.impacts.back();
  const bool faint = last.after.angular * last.after.angular < 1e-30 * first.after.angular * first.after.angular;
  return faint && outcome == Outcome::at_rest && truth.end == oracle::EventEnd::one_vertex_rests;
}

/// The bars of one row.
class RowJudge {
 public:
  explicit RowJudge(BarCoverage& coverage) : coverage_(coverage) {}
  void operator()(const char* name, double value, double bar, const Real& truth) {
    const double error = static_cast<double>(abs(Real(value) - truth));
    ++coverage_.numbers;
    if (error <= bar) ++coverage_.numbers_inside;
    else {
      outside_ += fmt::format(" {} {} +- {} off {}", name, value, bar, error);
    }
    if (error > 0) coverage_.ratios.push_back(bar / error);
  }
  [[nodiscard]] const std::string& outside() const { return outside_; }

 private:
  BarCoverage& coverage_;
  std::string outside_;
};

void judge_row(const ImpactRow& row, const oracle::EventImpact<Real>& truth, RowJudge& judge) {
  const RowErrors& e = row.error;
  const Impact& i = row.impact;
  using boost::multiprecision::sin, boost::multiprecision::asin;
  judge("start", row.start, e.start, truth.time);
  judge("angle", row.contact_angle, e.contact_angle, asin(abs(sin(truth.before.inclination))));
  judge("approach", i.approach_speed, e.approach_speed, truth.approach);
  judge("restitution", i.restitution(), e.restitution, truth.separation / truth.approach);
  judge("Pn", i.normal_impulse, e.normal_impulse, truth.normal_impulse);
  judge("Pt", i.tangential_impulse, e.tangential_impulse, truth.tangential_impulse);
  judge("Vn", i.after.normal, e.normal_velocity_after, truth.after.normal);
  judge("Vt", i.after.tangential, e.tangential_velocity_after, truth.after.tangential);
  judge("Omega", i.after.angular, e.angular_velocity_after, truth.after.angular);
  judge("E", row.energy_before, e.energy_before, truth.energy_before);
  judge("E'", row.energy_after, e.energy_after, truth.energy_after);
  judge("loss", i.energy_loss, e.energy_loss, truth.energy_before - truth.energy_after);
}

/// Bound on the impulses after the last simulated one of an accumulation, in units of that one.
/// They shrink like e, or on damped ground as they did in the second half.
double left_out(const oracle::EventSequence<Real>& truth, const BarScene& scene) {
  double shrinks = scene.law.restitution;
  if (scene.law.law == analytic::RestitutionLaw::viscoelastic) {
    const std::size_t last = truth.impacts.size() - 1, half = last / 2;
    const Real ratio = truth.impacts[last].normal_impulse / truth.impacts[half].normal_impulse;
    shrinks = std::pow(static_cast<double>(ratio), 1 / static_cast<double>(last - half));
  }
  return 4 / (1 - shrinks);
}

void judge_tail(const Sequence& sequence, const oracle::EventSequence<Real>& truth, const BarScene& scene,
                RowJudge& judge) {
  // What the simulation has left out after its last impact.
  const double left = left_out(truth, scene);
  const auto& last = truth.impacts.back();
  const double impulse_left = left * static_cast<double>(last.normal_impulse);
  const double time_left = left * static_cast<double>(last.time - truth.impacts[truth.impacts.size() - 2].time);
  const Tail& tail = *sequence.tail;
  Real normal = 0, tangential = 0;
  for (std::size_t i = sequence.rows.size(); i < truth.impacts.size(); ++i) {
    normal += truth.impacts[i].normal_impulse;
    tangential += truth.impacts[i].tangential_impulse;
  }
  judge("tail end", tail.end_time, tail.end_time_error + time_left, truth.impacts.back().time);
  judge("tail Pn", tail.normal_impulse, tail.normal_impulse_error + impulse_left, normal);
  judge("tail Pt", tail.tangential_impulse.x(), tail.tangential_impulse_error + impulse_left, tangential);
  const double speed_left = impulse_left / scene.mass, reach = scene.length;
  judge("tail Vt", tail.velocity_after.x(), tail.tangential_velocity_error + speed_left, last.after.tangential);
  judge("tail Omega", tail.angular_velocity_after.y(), tail.angular_velocity_error + 20 * speed_left / reach,
        last.after.angular);
}

void judge_end(const Sequence& sequence, const oracle::EventSequence<Real>& truth, const BarScene& scene,
               BarCoverage& coverage) {
  if (!sequence.end_predictable) return;
  if (truth.end == oracle::EventEnd::out_of_digits) {
    ++coverage.not_judged;
    return;
  }
  const bool right = same_end(sequence.outcome, truth);
  ++coverage.certain_ends;
  coverage.certain_ends_right += right ? 1 : 0;
  if (!right)
    coverage.outside.push_back(fmt::format("ends after {} as {}, not after {} as {}: {}", sequence.rows.size(),
                                           static_cast<int>(sequence.outcome), truth.impacts.size(),
                                           static_cast<int>(truth.end), scene.words()));
  if (!right || sequence.rows.size() > truth.impacts.size()) return;
  Real sum = 0;
  for (const auto& impact : truth.impacts) sum += impact.normal_impulse;
  RowJudge judge(coverage);
  ++coverage.sums;
  judge("total", sequence.total_normal_impulse,
        sequence.total_normal_impulse_error +
            (sequence.tail ? left_out(truth, scene) * static_cast<double>(truth.impacts.back().normal_impulse) : 0),
        sum);
  if (sequence.tail) judge_tail(sequence, truth, scene, judge);
  if (judge.outside().empty()) ++coverage.sums_inside;
  else coverage.outside.push_back("sums:" + judge.outside() + ": " + scene.words());
}

void judge_rows(const Sequence& sequence, const oracle::EventSequence<Real>& truth, const BarScene& scene,
                BarCoverage& coverage) {
  // The simulation stops within an accumulation, the sequence perhaps later.
  const Outcome end = outcome_of(truth.end);
  const bool accumulates = end == Outcome::at_rest || end == Outcome::sustained_contact;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const ImpactRow& row = sequence.rows[i];
    ++coverage.rows;
    if (!row.error.predictable || (accumulates && i >= truth.impacts.size())) continue;
    ++coverage.predictable;
    RowJudge judge(coverage);
    const bool same = i < truth.impacts.size() && std::popcount(row.vertices) == 1 &&
                      std::countr_zero(row.vertices) == static_cast<int>(truth.impacts[i].vertex);
    if (same) judge_row(row, truth.impacts[i], judge);
    const std::string wrong = same ? judge.outside() : " another vertex";
    if (wrong.empty()) ++coverage.rows_inside;
    else coverage.outside.push_back(fmt::format("impact {}{}: {}", i + 1, wrong, scene.words()));
  }
}

// The checks: how many errors lie within their bars, and how much wider these are than the errors.

constexpr int bar_family = 9;
constexpr int scene_count = 60;
constexpr int discrete_impacts = 400;  ///< of a sequence that does not end before
constexpr double least_covered = 0.95;
constexpr double widest_median = 10;
/// Bars of the discrete model hold an ulp of each number given, too, which the drop of the check does not have.
constexpr double least_covered_discrete = 0.995, widest_discrete_median = 100;
/// Errors of single numbers below this part of the number's size are those of the truth too.
constexpr double truth_error = 1e-12;

/// Errors and bars of numbers, over the sizes of their sequence.
class BarSample {
 public:
  void take(double error, double bar) {
    ++count_;
    if (error <= bar + truth_error) ++covered_;
    if (error > truth_error) ratios_.push_back(bar / error);
  }

  /// @param scenes  in words
  [[nodiscard]] Measured measured(const std::string& scenes) {
    const double middle = upper_median(ratios_);
    const double outside = 1 - static_cast<double>(covered_) / static_cast<double>(count_);
    const bool holds = outside <= 1 - least_covered && middle <= widest_median;
    return {100 * (1 - outside), outside, holds_if(holds),
            fmt::format("% of {} numbers of {} lie within their bars; bars are {} times the error in the median",
                        count_, scenes, significant(middle, 2))};
  }

 private:
  std::size_t count_ = 0, covered_ = 0;
  std::vector<double> ratios_;
};

/// The same drop by another method, at a tolerance that is as good as none.
numeric::Simulation truth_of(const Scene& scene, const numeric::Body& body) {
  numeric::Accuracy accuracy = scene.accuracy;
  accuracy.method = numeric::Method::rkf45;
  accuracy.tolerance = 2e-13;
  const numeric::Request request{.impacts = scene.request.impacts, .error_estimates = false, .amplification = false};
  return numeric::simulate(body, scene.world, scene.start(body), request, accuracy);
}

Measured bars_of_the_simulator(CaseRuns& case_runs) {
  BarSample sample;
  for (int index = 0; index < scene_count; ++index) {
    if (!case_runs.goes_on()) throw CaseRuns::Interrupted{};
    Scene scene = random_scene(bar_family, index);
    scene.accuracy.digits = 9;
    scene.request.impacts = 2;
    scene.accuracy.evaluation_limit = 300'000;  // soft grounds may hold a body for thousands of oscillations
    const numeric::Body body = scene.make_body();
    const numeric::Simulation run = run_to_digits(scene, body).run;
    const numeric::Simulation truth = truth_of(scene, body);
    if (run.impacts.empty()) continue;
    const MotionNumbers sizes = motion_sizes(run, run.impacts.size(), body);
    for (std::size_t i = 0; i < std::min(run.impacts.size(), truth.impacts.size()); ++i) {
      const numeric::ImpactRecord& row = run.impacts[i];
      if (!row.predictable || std::isnan(row.error.start)) continue;
      const auto impact = impact_of(row);
      const MotionNumbers value = motion_numbers(impact.value), bar = motion_numbers(impact.error),
                          exact = motion_numbers(impact_of(truth.impacts[i]).value);
      for (std::size_t q = 0; q < motion_number_count; ++q) {
        if (exact[q] != 0) sample.take(std::fabs(value[q] - exact[q]) / sizes[q], bar[q] / sizes[q]);
      }
    }
  }
  return sample.measured(fmt::format("{} random scenes", scene_count));
}

Measured bars_of_the_discrete_model(CaseRuns& case_runs) {
  BarCoverage coverage;
  for (int index = 0; index < scene_count; ++index) {
    if (!case_runs.goes_on()) throw CaseRuns::Interrupted{};
    judge_bars(random_bar_scene(bar_family, index), discrete_impacts, coverage);
    judge_bars(random_damped_bar_scene(bar_family, index), discrete_impacts, coverage);
  }
  const double inside = static_cast<double>(coverage.rows_inside) / static_cast<double>(coverage.predictable);
  const bool holds = inside >= least_covered_discrete && coverage.median_ratio() <= widest_discrete_median &&
                     coverage.certain_ends_right == coverage.certain_ends;
  return {
      100 * inside, 1 - inside, holds_if(holds),
      fmt::format("% of {} predictable impacts of {} random scenes lie within their bars with all numbers; bars are {} "
                  "times the error in the median; {} of {} ends that are certain are right",
                  coverage.predictable, coverage.scenes, significant(coverage.median_ratio(), 2),
                  coverage.certain_ends_right, coverage.certain_ends)};
}

}  // namespace

double BarCoverage::median_ratio() const { return upper_median(ratios); }

void judge_bars(const BarScene& scene, int impacts, BarCoverage& coverage) {
  Sequence sequence;
  try {
    sequence = impact_sequence(scene.drop(), {.impacts = impacts, .digits = scene.digits});
  } catch (const std::domain_error&) {
    return;  // the first contact recedes
  } catch (const analytic::OutsideModelError&) {
    return;
  } catch (const analytic::NumericalError&) {
    return;  // energy that an impulse ratio creates has carried the body off
  }
  if (sequence.outcome == Outcome::outside_model) return;  // the simulation jams as well
  ++coverage.scenes;
  const oracle::EventSequence<Real> truth = exact(scene, impacts_to_simulate(sequence));
  judge_rows(sequence, truth, scene, coverage);
  judge_end(sequence, truth, scene, coverage);
}

analytic::Drop BarScene::drop() const {
  const analytic::PlanarBody body =
      shape == BarShape::box
          ? analytic::make_box({.mass = mass, .length = length, .width = length, .thickness = 2 * half_thickness})
          : analytic::make_rod({.mass = mass, .length = length, .radius = half_thickness});
  return {.body = body,
          .inclination = analytic::Angle::from_degrees(degrees),
          .velocity = velocity,
          .gravity = gravity,
          .law = law};
}

std::string BarScene::words() const {
  return fmt::format(
      "{} {} x {} m, {} kg, {} deg, {} {} m/s, {} rad/s, g {}, e {} law {} damping {} friction {} {}, digits {}",
      shape == BarShape::box ? "box" : "rod", length, half_thickness, mass, degrees, velocity.normal,
      velocity.tangential, velocity.angular, gravity, law.restitution, static_cast<int>(law.law),
      law.damping_per_stiffness, static_cast<int>(law.friction), law.friction_value, digits);
}

BarScene random_bar_scene(unsigned family, int index) {
  std::seed_seq seed{family, static_cast<unsigned>(index)};
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11);
  };
  const auto one_of = [&](unsigned n) { return static_cast<int>(random() % n); };
  BarScene scene;
  scene.shape = static_cast<BarShape>(one_of(3));
  scene.length = std::pow(10, uniform(-1.2, 0.3));
  scene.mass = std::pow(10, uniform(-1, 1));
  scene.half_thickness = scene.shape == BarShape::thin_rod ? 0 : uniform(0.02, 0.4) * scene.length;
  scene.degrees = uniform(0.5, 89.5);
  scene.velocity.normal = -uniform(0.5, 5);
  if (one_of(2) != 0) scene.velocity.tangential = uniform(-2, 2);
  if (one_of(2) != 0) scene.velocity.angular = uniform(-5, 5);
  scene.gravity = one_of(8) != 0 ? 9.81 * std::pow(10, uniform(-1, 1)) : 0;
  scene.law.restitution = one_of(3) != 0 ? uniform(0.001, 0.98) : std::pow(10, uniform(-3, -0.01));
  scene.law.law = static_cast<analytic::RestitutionLaw>(one_of(3));
  const int friction = one_of(4);
  if (friction == 1) scene.law.friction = FrictionKind::impulse_ratio, scene.law.friction_value = uniform(-0.2, 0.2);
  if (friction > 1) scene.law.friction = FrictionKind::coulomb, scene.law.friction_value = uniform(0.01, 0.8);
  scene.digits = 3 * (1 + one_of(4));
  return scene;
}

BarScene random_damped_bar_scene(unsigned family, int index) {
  BarScene scene = random_bar_scene(family, index);
  std::seed_seq seed{family, static_cast<unsigned>(index), 1u};
  std::mt19937_64 random(seed);
  const double damping_number = std::pow(10, -3 + 3.5 * 0x1p-53 * static_cast<double>(random() >> 11));
  scene.law.law = analytic::RestitutionLaw::viscoelastic;
  scene.law.restitution = 1;
  scene.law.damping_per_stiffness = damping_number / -scene.velocity.normal;
  return scene;
}

CheckMeasures bar_measures() { return {{"B1", bars_of_the_discrete_model}, {"B2", bars_of_the_simulator}}; }

}  // namespace clatter::validation
