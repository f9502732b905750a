// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "numeric/base/errors.hpp"
#include "validation/evidence/extreme_cases.hpp"
#include "validation/evidence/oracles.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {
namespace {

/// A discrete scene's laws of motion hold if they do to this: rounding, grown by sizes that differ by tens of decades.
constexpr double laws_hold = 1e-9;
/// This part of the first energy may be missing.  A body that falls deep into a soft ground trades a hundred times that
/// with it, at a tolerance that keeps 10⁻⁶ of what is traded.
constexpr double ledger_bound = 1e-4;
constexpr long evaluations_per_scene = 4'000;

/// The numbers of one scene of a family, one after the other.
class Draw {
 public:
  Draw(std::uint64_t seed, int scene) : seed_(seed), scene_(static_cast<std::uint64_t>(scene)) {}
  double operator()(double low, double high) { return low + (high - low) * uniform_at(seed_, scene_, column_++); }
  double decades(double low, double high) { return std::pow(10, (*this)(low, high)); }
  bool one_in(double n) { return (*this)(0, n) < 1; }
  double sign() { return one_in(2) ? -1 : 1; }

 private:
  std::uint64_t seed_, scene_;
  std::uint32_t column_ = 0;
};

double any_angle(Draw& draw) {
  if (draw.one_in(8)) return 0;
  if (draw.one_in(8)) return 90;
  if (draw.one_in(4)) return 90 * draw.decades(-300, 0);
  if (draw.one_in(4)) return 90 - 90 * draw.decades(-16, 0);
  return draw(0, 90);
}

double any_restitution(Draw& draw) {
  if (draw.one_in(4)) return 1;
  if (draw.one_in(6)) return 0;
  if (draw.one_in(4)) return draw.decades(-300, 0);
  if (draw.one_in(4)) return 1 - draw.decades(-16, 0);
  return draw(0, 1);
}

analytic::ImpactLaw any_law(Draw& draw) {
  using analytic::RestitutionLaw;
  constexpr std::array laws{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge,
                            RestitutionLaw::viscoelastic};
  analytic::ImpactLaw law;
  law.law = laws[static_cast<std::size_t>(draw(0, 4))];
  if (law.law == RestitutionLaw::viscoelastic) law.damping_per_stiffness = draw.decades(-100, 100);
  else law.restitution = any_restitution(draw);
  if (draw.one_in(3)) return law;
  const bool ratio = draw.one_in(3);
  law.friction = ratio ? analytic::FrictionKind::impulse_ratio : analytic::FrictionKind::coulomb;
  law.friction_value = draw.one_in(2) ? draw(0, 2) : draw.decades(-100, 100);
  if (ratio) law.friction_value *= draw.sign();
  return law;
}

analytic::Drop any_drop(Draw& draw) {
  const double length = draw.one_in(3) ? 1 : draw.decades(-140, 140), mass = draw.decades(-140, 140);
  const double thickness = length * (draw.one_in(3) ? 0.1 : draw.decades(-9, 0));
  const double speed = draw.one_in(3) ? 1 : draw.decades(-140, 140);
  analytic::Drop drop;
  if (draw.one_in(3)) drop.body = analytic::make_rod({.mass = mass, .length = length});
  else if (draw.one_in(2)) drop.body = analytic::make_rod({.mass = mass, .length = length, .radius = thickness});
  else drop.body = analytic::make_box({.mass = mass, .length = length, .width = length, .thickness = thickness});
  drop.inclination = analytic::Angle::from_degrees(any_angle(draw));
  drop.velocity.normal = -speed;
  if (draw.one_in(2)) drop.velocity.tangential = draw.sign() * speed * draw.decades(-12, 6);
  if (draw.one_in(2)) drop.velocity.angular = draw.sign() * speed / length * draw.decades(-12, 6);
  if (!draw.one_in(3)) drop.gravity = speed * speed / length * draw.decades(-12, 12);
  drop.law = any_law(draw);
  return drop;
}

ContinuousCase any_case(Draw& draw) {
  ContinuousCase scene;
  const double size = draw.decades(-6, 6);
  scene.size = size * numeric::Vector3(1, draw.decades(-3, 0), draw.decades(-3, 0));
  scene.mass = draw.decades(-9, 9);
  scene.ground.stiffness = draw.decades(-6, 25);
  scene.ground.damping = draw.one_in(3) ? 0 : scene.ground.stiffness * draw.decades(-12, 12);
  const double friction = draw.one_in(3) ? 0 : draw.decades(-9, 9);
  scene.ground.sliding_friction = friction;
  scene.ground.static_friction = draw.one_in(2) ? friction : friction * draw.decades(0, 3);
  scene.ground.area = draw.one_in(2) ? numeric::AreaMeasure::surface : numeric::AreaMeasure::projected;
  if (draw.one_in(4)) scene.ground.friction = numeric::FrictionLaw::regularised;
  scene.angle_deg = any_angle(draw);
  const double speed = draw.decades(-9, 6);
  scene.velocity = {draw.one_in(2) ? 0 : draw.sign() * speed * draw.decades(-6, 3), 0, -speed};
  scene.gravity = draw.one_in(3) ? 0 : speed * speed / size * draw.decades(-9, 9);
  scene.impacts = 3;
  scene.evaluation_limit = evaluations_per_scene;
  return scene;
}

/// "1e5" for a power of ten.
std::string count_label(int count) {
  const double exponent = std::log10(count);
  return exponent == std::round(exponent) ? fmt::format("1e{:.0f}", exponent) : std::to_string(count);
}

/// How often each way of ending came, and what was worst.
class Tally {
 public:
  void count(const std::string& outcome) { ++counts_[outcome]; }
  void note(double error, int scene, const std::string& what) {
    if (error <= worst_) return;
    worst_ = std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
    where_ = fmt::format("worst in scene {}: {}", scene, what);
  }
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] std::string words() const {
    std::string text;
    for (const auto& [outcome, count] : counts_)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, outcome);
    return text + (where_.empty() ? "" : "; " + where_);
  }

 private:
  std::map<std::string, int> counts_;
  double worst_ = 0;
  std::string where_;
};

bool is_finite(const analytic::Sequence& sequence) {
  for (const analytic::ImpactRow& row : sequence.rows) {
    const analytic::Impact& hit = row.impact;
    for (const double x : {row.start, row.contact_angle, row.centre_height, hit.normal_impulse, hit.tangential_impulse,
                           hit.after.normal, hit.after.tangential, hit.after.angular}) {
      if (!std::isfinite(x)) return false;
    }
    if (!(hit.normal_impulse >= 0)) return false;
  }
  return !sequence.rows.empty();
}

void run_discrete(Draw draw, int index, Tally& tally) {
  try {
    const analytic::Drop drop = any_drop(draw);
    const analytic::Sequence sequence = impact_sequence(drop, {.impacts = 12, .digits = 6, .amplification = false});
    if (!is_finite(sequence)) tally.note(1, index, "a number that is none");
    const bool hold = retrace(drop, sequence).residual <= laws_hold;
    tally.count(hold ? "keep all laws of motion to 1e-9" : "miss one by more");
    tally.count(outcome_name(sequence.outcome));
  } catch (const analytic::OutsideModelError&) {
    tally.count("outside-model");
  } catch (const analytic::NumericalError&) {
    tally.count("not-computed");
  } catch (const std::domain_error&) {
    tally.count("bad-input");
  }
}

void run_continuous(Draw draw, int index, Tally& tally) {
  try {
    const ContinuousCase scene = any_case(draw);
    const bool planar = draw.one_in(2);
    const numeric::Simulation run = run_case(scene, {.planar = planar, .estimates = false}, [] { return true; });
    tally.note(worst_ledger_gap(run), index, "energy ledger");
    for (const numeric::ImpactRecord& row : run.impacts) {
      if (!row.value.impulse.allFinite() || !row.value.velocity_after.allFinite() ||
          !row.value.angular_velocity_after.allFinite() || !std::isfinite(row.value.duration)) {
        tally.note(std::nan(""), index, "a number that is none");
      }
    }
    tally.count(outcome_name(run.outcome));
  } catch (const numeric::NumericalError&) {
    tally.count("not-computed");
  } catch (const std::domain_error&) {
    tally.count("bad-input");
  }
}

CellMeasure run_scenes(int count, double bound, const GoesOn& goes_on, const auto& run) {
  Tally tally;
  CellMeasure measure{.bound = bound};
  int done = 0;
  measure.seconds = timed([&] {
    for (; done < count && (done % 64 != 0 || goes_on()); ++done) run(done, tally);
  });
  if (done < count)
    throw EndedEarly(CellVerdict::ended_early, "interrupted", fmt::format("interrupted after {} scenes", done));
  measure.error = tally.worst();
  measure.outcome = tally.words();
  return measure;
}

}  // namespace

std::vector<ExtremeCase> long_cases(const LongRuns& runs, const GoesOn& goes_on) {
  std::vector<ExtremeCase> cases;
  const auto add = [&](int count, const char* of, ModelLevel model, auto work) {
    cases.push_back({{"long", static_cast<double>(count), count_label(count) + of, model, true},
                     [work](const CellClock&) { return work(); }});
  };
  for (const ModelLevel model : {ModelLevel::planar, ModelLevel::spatial}) {
    add(runs.impacts, " hits", model,
        [=] { return kept_energy(runs.impacts, 2000L * runs.impacts, model == ModelLevel::planar, goes_on); });
  }
  add(runs.discrete_scenes, " sc", ModelLevel::discrete, [=] {
    CellMeasure measure = run_scenes(runs.discrete_scenes, 0, goes_on,
                                     [&](int i, Tally& tally) { run_discrete(Draw(runs.seed, i), i, tally); });
    measure.oracle = "finite numbers, impulses that push";
    return measure;
  });
  add(runs.continuous_scenes, " sc", ModelLevel::spatial, [=] {
    CellMeasure measure = run_scenes(runs.continuous_scenes, ledger_bound, goes_on,
                                     [&](int i, Tally& tally) { run_continuous(Draw(runs.seed + 1, i), i, tally); });
    measure.oracle = "energy ledger";
    return measure;
  });
  return cases;
}

}  // namespace clatter::validation
