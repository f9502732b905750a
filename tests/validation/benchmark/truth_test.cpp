// SPDX-License-Identifier: GPL-3.0-or-later
// The truth of the benchmark's problems, computed again by another route: the discrete model, the simulator.
#include <fmt/ranges.h>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/simulate.hpp"
#include "tests/support.hpp"
#include "validation/benchmark/reference.hpp"
#include "validation/run/discrete_scene.hpp"

namespace {

using namespace clatter;
using namespace clatter::validation;
using Vector3 = analytic::space::Vector3;

constexpr double agreement = 1e-12;  // of the sequence's sizes, as the benchmark promises

/// Largest sizes of a sequence.
struct Sizes {
  double impulse = 0, velocity = 0, angular = 0, time = 0;
};

Sizes sizes_of(const std::vector<TruthRow>& truth) {
  const auto largest = [&](const auto& size) { return std::ranges::max(truth, {}, size); };
  const auto of = [&](const auto& size) { return size(largest(size)); };
  return {.impulse = of([](const TruthRow& row) { return row.impulse.norm(); }),
          .velocity = of([](const TruthRow& row) { return row.velocity.norm(); }),
          .angular = of([](const TruthRow& row) { return row.angular_velocity.norm(); }),
          .time = of([](const TruthRow& row) { return row.time; })};
}

void check_close(const std::string& what, double difference, double size) {
  BOOST_TEST_CONTEXT(what) { BOOST_TEST((difference <= agreement * size), difference << " of " << size); }
}

void check_row(const std::string& what, const TruthRow& truth, const TruthRow& other, const Sizes& sizes) {
  BOOST_TEST_CONTEXT(what) { BOOST_TEST(truth.place == other.place); }
  check_close(what + " time", std::fabs(truth.time - other.time), sizes.time);
  check_close(what + " impulse", (truth.impulse - other.impulse).norm(), sizes.impulse);
  check_close(what + " velocity", (truth.velocity - other.velocity).norm(), sizes.velocity);
  // A rod that lands flat does not turn: the size of its rates is that of its speed over half its length.
  check_close(what + " turning", (truth.angular_velocity - other.angular_velocity).norm(),
              std::max(sizes.angular, sizes.velocity));
}

analytic::ImpactLaw with_law(analytic::ImpactLaw law, const std::string& name) {
  if (name.starts_with("poisson")) law.law = analytic::RestitutionLaw::poisson;
  if (name.starts_with("stronge")) law.law = analytic::RestitutionLaw::stronge;
  if (name.ends_with("moreau")) law.friction = analytic::FrictionKind::moreau;
  return law;
}

std::string place_of(const Problem&, const Reference& reference, const analytic::ImpactRow& row) {
  std::vector<int> group;
  for (int i = 0; i < static_cast<int>(reference.points.size()); ++i) {
    if (row.vertices >> i & 1) group.push_back(i);
  }
  return reference.place_name(group);
}

std::string place_of(const Problem& problem, const Reference&, const analytic::space::ImpactRow& row) {
  BOOST_TEST((row.corners.size() == 1U || row.group.has_value()));
  std::vector<std::string> names;
  for (const analytic::space::Corner& corner : row.corners) names.push_back(corner_name(problem.scene, corner));
  std::sort(names.begin(), names.end(), std::greater<>());
  return fmt::format("{}", fmt::join(names, " "));
}

/// What the discrete model makes of a problem.
std::vector<TruthRow> rows_of(const Problem& problem, const Reference& reference, const std::string& law, int impacts) {
  std::vector<TruthRow> rows;
  const auto run = [&](auto drop) {
    drop.law = with_law(drop.law, law);
    for (const auto& row : impact_sequence(drop, {.impacts = impacts}).rows) {
      const Numbers found = impact_of(row).value;
      rows.push_back({.place = place_of(problem, reference, row),
                      .time = row.start,
                      .impulse = Vector3(found.impulse.data()),
                      .velocity = Vector3(found.velocity_after.data()),
                      .angular_velocity = Vector3(found.angular_velocity_after.data())});
    }
  };
  std::visit(run, reference.drop);
  return rows;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_discrete_model_confirms_the_truth_of_every_rigid_problem_to_1e_12) {
  int compared = 0;
  for (const Problem& problem : benchmark_problems()) {
    if (problem.is_compliant) continue;
    const Reference reference = reference_of(problem);
    for (const ReferenceSequence& sequence : reference.sequences) {
      const int count = static_cast<int>(sequence.truth.size());
      const std::vector<TruthRow> rows = rows_of(problem, reference, sequence.law.name, count);
      BOOST_TEST_REQUIRE(rows.size() == sequence.truth.size());
      for (std::size_t i = 0; i < rows.size(); ++i, ++compared)
        check_row(problem.id + " " + sequence.law.name, sequence.truth[i], rows[i], sizes_of(sequence.truth));
    }
  }
  BOOST_TEST(compared >= 60);
}

BOOST_AUTO_TEST_CASE(no_impact_comes_before_the_time_until_which_a_problem_says_that_there_is_none) {
  for (const Problem& problem : benchmark_problems()) {
    if (!problem.until || problem.energy_alone) continue;
    const std::size_t asked = truth_of(problem, "any").size();
    const std::vector<TruthRow> rows = rows_of(problem, reference_of(problem), "any", static_cast<int>(asked) + 1);
    BOOST_TEST_CONTEXT(problem.id) {
      BOOST_TEST((rows.size() == asked || rows[asked].time > *problem.until));
      BOOST_TEST(rows[asked - 1].time < *problem.until);
    }
  }
}

/// Bounce by bounce of the discrete model, then the slide with what gravity gives and friction takes.
BOOST_AUTO_TEST_CASE(the_discrete_model_confirms_the_energy_at_the_end_of_a_slide_down_a_slope_to_1e_12) {
  int compared = 0;
  for (const Problem& problem : benchmark_problems()) {
    if (!problem.end_energy) continue;
    const auto drop = std::get<analytic::Drop>(discrete_drop(problem.scene));
    const analytic::Sequence sequence = impact_sequence(drop, {.impacts = 45});
    BOOST_TEST_REQUIRE(sequence.tail.has_value());
    double way = 0, time = 0, along = 0;
    for (const analytic::ImpactRow& row : sequence.rows) {
      const double flight = row.start - time;
      way += flight * (along + drop.gravity_along / 2 * flight);
      along = row.impact.after.tangential;
      time = row.start;
    }
    const double gain = drop.gravity_along - drop.law.friction_value * drop.gravity;
    const double slip = sequence.tail->velocity_after.x(), left = *problem.until - sequence.tail->end_time;
    const double slides = gain < 0 ? std::min(left, -slip / gain) : left;
    way += slides * (slip + gain / 2 * slides);
    const double end = slides < left ? 0 : slip + gain * left;
    const double energy = drop.body.mass * (end * end / 2 + drop.gravity * sequence.rows.front().centre_height -
                                            drop.gravity_along * way);
    check_close(problem.id + " energy", std::fabs(energy - *problem.end_energy), sequence.rows.front().energy_before);
    ++compared;
  }
  BOOST_TEST(compared == 2);
}

BOOST_AUTO_TEST_CASE(the_simulator_confirms_the_truth_of_the_damped_phone_to_1e_12) {
  const Problem& problem = problem_named("test", "phone-damped");
  Scene scene = problem.scene;
  scene.world.planar = true;
  scene.accuracy.digits = 12;
  const std::vector<TruthRow> truth = truth_of(problem, "any");
  const Sizes sizes = sizes_of(truth);
  const numeric::Body body = scene.make_body();
  const numeric::Simulation run =
      numeric::simulate(body, scene.world, scene.start(body), scene.request, scene.accuracy);
  BOOST_TEST_REQUIRE(run.impacts.size() == truth.size());
  const double g = scene.world.gravity;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const numeric::ImpactNumbers& impact = run.impacts[i].value;
    check_close("duration", std::fabs(impact.duration - truth[i].duration), truth[i].duration);
    check_close("impulse", std::fabs(impact.impulse.z() - truth[i].impulse.z()), sizes.impulse);
    // The truth follows the flight after the contact back to its own time.
    const double since = impact.start + impact.duration - truth[i].time;
    check_close("velocity", std::fabs(impact.velocity_after.z() + g * since - truth[i].velocity.z()), sizes.velocity);
    check_close("turning", std::fabs(impact.angular_velocity_after.y() - truth[i].angular_velocity.y()), sizes.angular);
  }
}

BOOST_AUTO_TEST_CASE(each_problem_has_starting_gaps_from_which_its_body_flies_to_the_first_touch) {
  for (const Problem& problem : benchmark_problems()) {
    BOOST_TEST_CONTEXT(problem.id) {
      // A block that rocks is on the ground before.
      const bool rocks = problem.id == "rock" || problem.id == "overhang";
      BOOST_TEST(problem.gaps.size() >= (rocks ? 1U : 3U));
      BOOST_TEST(std::is_sorted(problem.tolerances.begin(), problem.tolerances.end()));
      const Reference reference = reference_of(problem);
      for (const double gap : problem.gaps) {
        const auto [state, time] = reference.release(gap);
        const auto touch = reference.flight(state).at(time);
        BOOST_TEST((touch.velocity - reference.start.velocity).norm() <= 1e-13 * reference.speed());
        BOOST_TEST(std::fabs(touch.position.z() - reference.start.position.z()) <= 1e-13 * reference.reach());
        const double lowest = reference.height(state, reference.lowest(state.attitude));
        BOOST_TEST(std::fabs(lowest - gap) <= 1e-13 * reference.reach());
      }
    }
  }
}
