// Error bars of the discrete model, and the ends of its sequences, against event simulations of 80
// digits and more.
//
// CLATTER_BARS_SCENES sets another number of random scenes, CLATTER_BARS_FAMILY others.

#include "validation/verify/discrete_bars.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>

namespace {

using namespace clatter;
using analytic::Outcome;
using validation::BarCoverage;
using validation::BarScene;
using validation::BarShape;

constexpr int to_rest = 3000;  // impacts; the longest of the scenes below ends before

int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

void report(const BarCoverage& c) {
  for (const std::string& line : c.outside) std::cout << line << '\n';
  std::cout << c.scenes << " scenes: " << c.rows_inside << " of " << c.predictable
            << " predictable rows (of " << c.rows << ") and " << c.numbers_inside << " of "
            << c.numbers << " numbers inside, bar/error " << c.median_ratio() << " in the median; "
            << c.certain_ends_right << " of " << c.certain_ends << " certain ends right, "
            << c.not_judged << " not judged; " << c.sums_inside << " of " << c.sums
            << " sums inside\n";
}

analytic::Sequence sequence_of(const BarScene& scene, int impacts = to_rest) {
  return impact_sequence(scene.drop(), {.impacts = impacts, .digits = scene.digits});
}

BarScene sensitive_box(double degrees, double restitution) {
  return {.shape = BarShape::box,
          .mass = 1,
          .length = 0.10566,
          .half_thickness = 0.02,
          .degrees = degrees,
          .velocity = {.normal = -4.4},
          .gravity = 9.81,
          .law = {.restitution = restitution},
          .digits = 6};
}

}  // namespace

BOOST_AUTO_TEST_CASE(
    of_100_rows_99_lie_within_bars_that_are_less_than_100_errors_wide_and_every_certain_end_is_the_true_one) {
  const int scenes = setting("CLATTER_BARS_SCENES", 120);
  BarCoverage coverage;
  for (int i = 0; coverage.scenes < scenes; ++i) {
    validation::judge_bars(
        validation::random_bar_scene(static_cast<unsigned>(setting("CLATTER_BARS_FAMILY", 1)), i),
        to_rest, coverage);
  }
  report(coverage);
  BOOST_TEST(static_cast<double>(coverage.rows_inside) >=
             0.995 * static_cast<double>(coverage.predictable));
  BOOST_TEST(static_cast<double>(coverage.sums_inside) >=
             0.99 * static_cast<double>(coverage.sums));
  BOOST_TEST(coverage.median_ratio() <= 100);
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
  BOOST_TEST(coverage.not_judged <= scenes / 50);
  BOOST_TEST(static_cast<double>(coverage.certain_ends) >=
             0.85 * static_cast<double>(coverage.scenes));
}

/// Errors of these grow 10⁵ times from the fourth impact to the sixth; bars used to fall back to
/// rounding there.
BOOST_AUTO_TEST_CASE(
    where_errors_have_outgrown_the_motion_a_row_is_not_predictable_and_its_bars_are_infinite) {
  BarCoverage coverage;
  const BarScene elastic = sensitive_box(73.7020660990234, 1),
                 damped = sensitive_box(75.2937, 0.834);
  validation::judge_bars(elastic, 6, coverage);
  validation::judge_bars(damped, to_rest, coverage);
  report(coverage);
  BOOST_TEST(coverage.rows_inside == coverage.predictable);
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
  const analytic::Sequence s = sequence_of(elastic, 40);
  BOOST_TEST(s.rows[5].error.normal_impulse > 1e-5 * s.rows[5].impact.normal_impulse);
  BOOST_TEST(!s.rows.back().error.predictable);
  BOOST_TEST(std::isinf(s.rows.back().error.start));
  BOOST_TEST(std::isnan(s.rows.back().amplification));
  BOOST_TEST(std::isinf(s.total_normal_impulse_error));
  BOOST_TEST(!sequence_of(damped).end_predictable);
  BOOST_TEST(std::isinf(sequence_of(damped).tail.value().end_time_error));
}

/// Impact 16 had an error of 1e-8 under a bar of 2e-14: V_n − Ω d_t cancels where a bounce is
/// small.
BOOST_AUTO_TEST_CASE(bounces_that_shrink_towards_an_accumulation_keep_their_digits) {
  constexpr double least = 1e-12;  // relative; 16 impacts with some 50 eps each, and their growth
  for (const double degrees : {20.0, 45.0, 60.0, 75.0}) {
    for (const BarShape shape : {BarShape::thin_rod, BarShape::rod, BarShape::box}) {
      BarCoverage coverage;
      const BarScene scene{.shape = shape,
                           .mass = 1,
                           .length = 1,
                           .half_thickness = shape == BarShape::thin_rod ? 0 : 0.05,
                           .degrees = degrees,
                           .velocity = {.normal = -1},
                           .gravity = 9.81,
                           .law = {.restitution = 0.3},
                           .digits = 15};
      validation::judge_bars(scene, to_rest, coverage);
      BOOST_TEST_CONTEXT(scene.words()) BOOST_TEST(coverage.rows_inside == coverage.predictable);
      BOOST_TEST_CONTEXT(scene.words()) BOOST_TEST(coverage.predictable >= 5);
      for (const analytic::ImpactRow& row : sequence_of(scene).rows) {
        BOOST_TEST_CONTEXT(scene.words())
        BOOST_TEST(row.error.approach_speed <= least * row.impact.approach_speed);
      }
    }
  }
}

/// 0.276594238713 s and 0.625978274 N·s are of an exact event simulation; the sequence went on for
/// ever.
BOOST_AUTO_TEST_CASE(a_box_that_rattles_on_alternating_corners_comes_to_rest) {
  const BarScene scene{.shape = BarShape::box,
                       .mass = 0.088,
                       .length = 0.10566,
                       .half_thickness = 0.009525,
                       .degrees = 45,
                       .velocity = {.normal = -4.4},
                       .gravity = 9.81,
                       .law = {.restitution = 0.3},
                       .digits = 12};
  const analytic::Sequence s = sequence_of(scene);
  BOOST_CHECK(s.outcome == Outcome::at_rest);
  BOOST_TEST(s.end_predictable);
  BOOST_TEST(std::fabs(s.tail.value().end_time - 0.276594238713) <= 1e-12);
  BOOST_TEST(std::fabs(s.total_normal_impulse - 0.625978274) <= 1e-9);
  // At rest all momentum is gone: ΣP = m (v + g t).
  const double momentum = 0.088 * (4.4 + 9.81 * s.tail.value().end_time);
  BOOST_TEST(std::fabs(s.total_normal_impulse - momentum) <= s.total_normal_impulse_error + 1e-15);
}

BOOST_AUTO_TEST_CASE(with_next_to_no_rebound_a_sequence_ends_as_it_does_in_80_digits) {
  BarCoverage coverage;
  for (const double e : {1e-10, 1e-6, 1e-4, 0.001, 0.003, 0.02, 0.05}) {
    for (const double gravity : {0.0, 9.81}) {
      if (gravity == 0 && e < 0.02)
        continue;  // heights shrink beyond the simulation's digits before speeds do
      for (const BarShape shape : {BarShape::thin_rod, BarShape::box}) {
        const BarScene scene{.shape = shape,
                             .mass = 1,
                             .length = 1,
                             .half_thickness = shape == BarShape::box ? 0.1 : 0,
                             .degrees = 30,
                             .velocity = {.normal = -2},
                             .gravity = gravity,
                             .law = {.restitution = e},
                             .digits = 9};
        validation::judge_bars(scene, to_rest, coverage);
      }
    }
  }
  report(coverage);
  BOOST_TEST(coverage.certain_ends == coverage.scenes);
  BOOST_TEST(coverage.certain_ends_right == coverage.scenes);
  BOOST_TEST(coverage.rows_inside == coverage.predictable);
}

/// The squares of speeds underflowed: "no convergence", or a rod that rests was said to turn.
BOOST_AUTO_TEST_CASE(
    a_flat_body_bounces_on_until_its_speeds_are_no_doubles_any_more_and_is_then_at_rest) {
  for (const double degrees : {0.0, 90.0}) {
    for (const auto& [restitution, impacts] : {std::pair{0.6, 800}, std::pair{0.3, 2000}}) {
      for (const BarShape shape : {BarShape::thin_rod, BarShape::box}) {
        const BarScene scene{.shape = shape,
                             .mass = 1,
                             .length = 1,
                             .half_thickness = shape == BarShape::box ? 0.1 : 0,
                             .degrees = degrees,
                             .velocity = {.normal = -1},
                             .gravity = 9.81,
                             .law = {.restitution = restitution},
                             .digits = 6};
        const analytic::Sequence s = sequence_of(scene, impacts);
        BOOST_CHECK(s.outcome == Outcome::at_rest);
        BOOST_TEST(s.end_predictable);
        BOOST_TEST(s.tail.has_value());
        double speed = 1, time = 0;
        for (const analytic::ImpactRow& row : s.rows) {
          BOOST_TEST(std::fabs(row.impact.approach_speed - speed) <=
                     row.error.approach_speed + 1e-12 * speed);
          BOOST_TEST(std::fabs(row.start - time) <= row.error.start);
          speed *= restitution;
          time += 2 * speed / 9.81;
        }
        BOOST_TEST(s.rows.size() >= 500u);
      }
    }
  }
}
