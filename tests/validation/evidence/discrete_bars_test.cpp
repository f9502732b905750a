// SPDX-License-Identifier: GPL-3.0-or-later
// Error bars of the discrete model, and the ends of its sequences, against event simulations of 80
// digits and more.
//
// CLATTER_BARS_SCENES sets another number of random scenes, CLATTER_BARS_FAMILY others.

#include "validation/evidence/discrete_bars.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include "validation/oracles/impulse_path.hpp"

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
  std::cout << c.scenes << " scenes: " << c.rows_inside << " of " << c.predictable << " predictable rows (of " << c.rows
            << ") and " << c.numbers_inside << " of " << c.numbers << " numbers inside, bar/error " << c.median_ratio()
            << " in the median; " << c.certain_ends_right << " of " << c.certain_ends << " certain ends right, "
            << c.not_judged << " not judged; " << c.sums_inside << " of " << c.sums << " sums inside\n";
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

/// A contact point on a spring and damper, f = (1 − τu) δ, with Coulomb friction.
struct DampedContact {
  double A, B, C, friction, damping;
  double u, s, depth = 0, normal = 0, tangential = 0;

  [[nodiscard]] double ratio() const {
    const double stick = B / C;
    if (s != 0) return s > 0 ? -friction : friction;
    return std::fabs(stick) <= friction ? stick : std::copysign(friction, stick);
  }
  [[nodiscard]] DampedContact moved(const DampedContact& rate, double time) const {
    DampedContact next = *this;
    next.u += rate.u * time;
    next.s += rate.s * time;
    next.depth += rate.depth * time;
    next.normal += rate.normal * time;
    next.tangential += rate.tangential * time;
    return next;
  }
  [[nodiscard]] DampedContact rate(double r) const {
    const double force = (1 - damping * u) * depth;
    DampedContact d = *this;
    d.u = (A - B * r) * force;
    d.s = (C * r - B) * force;
    d.depth = -u;
    d.normal = force;
    d.tangential = r * force;
    return d;
  }
  /// Runge and Kutta's step.
  [[nodiscard]] DampedContact after(double time, double r) const {
    const DampedContact a = rate(r), b = moved(a, time / 2).rate(r), c = moved(b, time / 2).rate(r),
                        d = moved(c, time).rate(r);
    return moved(a, time / 6).moved(b, time / 3).moved(c, time / 3).moved(d, time / 6);
  }
  /// Until the depth is 0 again; steps end where slip stops.
  void run(double step) {
    for (bool ended = false; !ended;) {
      const double r = ratio(), sense = s;
      const auto passed = [&](const DampedContact& x) { return x.depth <= 0 || (sense != 0 && x.s * sense <= 0); };
      DampedContact next = after(step, r);
      if (passed(next)) {
        double low = 0, high = step;
        for (int i = 0; i < 60; ++i) {
          const double middle = (low + high) / 2;
          (passed(after(middle, r)) ? high : low) = middle;
        }
        next = after(high, r);
        ended = next.depth <= 0;
        if (!ended) next.s = 0;
      }
      *this = next;
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(
    of_100_rows_99_lie_within_bars_that_are_less_than_100_errors_wide_and_every_certain_end_is_the_true_one) {
  const int scenes = setting("CLATTER_BARS_SCENES", 50);
  BarCoverage coverage;
  for (int i = 0; coverage.scenes < scenes; ++i) {
    validation::judge_bars(validation::random_bar_scene(static_cast<unsigned>(setting("CLATTER_BARS_FAMILY", 1)), i),
                           to_rest, coverage);
  }
  report(coverage);
  BOOST_TEST(static_cast<double>(coverage.rows_inside) >= 0.995 * static_cast<double>(coverage.predictable));
  BOOST_TEST(static_cast<double>(coverage.sums_inside) >= 0.99 * static_cast<double>(coverage.sums));
  BOOST_TEST(coverage.median_ratio() <= 100);
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
  BOOST_TEST(coverage.not_judged <= scenes / 50);
  BOOST_TEST(static_cast<double>(coverage.certain_ends) >= 0.85 * static_cast<double>(coverage.scenes));
}

BOOST_AUTO_TEST_CASE(on_damped_ground_99_of_100_rows_lie_within_their_bars_and_every_certain_end_is_the_true_one) {
  const int scenes = setting("CLATTER_BARS_SCENES", 20);
  const auto family = static_cast<unsigned>(setting("CLATTER_BARS_FAMILY", 1));
  BarCoverage coverage;
  for (int i = 0; coverage.scenes < scenes; ++i) {
    validation::judge_bars(validation::random_damped_bar_scene(family, i), to_rest, coverage);
  }
  report(coverage);
  BOOST_TEST(static_cast<double>(coverage.rows_inside) >= 0.995 * static_cast<double>(coverage.predictable));
  BOOST_TEST(coverage.predictable >= 10 * scenes);
  BOOST_TEST(coverage.median_ratio() <= 100);
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
  BOOST_TEST(coverage.sums_inside == coverage.sums);
  BOOST_TEST(coverage.not_judged <= scenes / 20);
}

/// Errors of these grow 10⁵ times from the fourth impact to the sixth; bars used to fall back to
/// rounding there.
BOOST_AUTO_TEST_CASE(where_errors_have_outgrown_the_motion_a_row_is_not_predictable_and_its_bars_are_infinite) {
  BarCoverage coverage;
  const BarScene elastic = sensitive_box(73.7020660990234, 1), damped = sensitive_box(75.2937, 0.834);
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
      if (gravity == 0 && e < 0.02) continue;  // heights shrink beyond the simulation's digits before speeds do
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
BOOST_AUTO_TEST_CASE(a_flat_body_bounces_on_until_its_speeds_are_no_doubles_any_more_and_is_then_at_rest) {
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
          BOOST_TEST(std::fabs(row.impact.approach_speed - speed) <= row.error.approach_speed + 1e-12 * speed);
          BOOST_TEST(std::fabs(row.start - time) <= row.error.start);
          speed *= restitution;
          time += 2 * speed / 9.81;
        }
        BOOST_TEST(s.rows.size() >= 500u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_simulated_impact_on_damped_ground_is_that_of_a_point_on_a_spring_and_damper) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  constexpr double tolerance = 1e-9;  // fourth order in steps of 1/2000, some thousand of them
  std::mt19937_64 random(31);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(random() >> 11);
  };
  int stopped = 0;
  for (int i = 0; i < 40; ++i) {
    const double along = uniform(-1.5, 1.5), up = -uniform(0.1, 1.5);  // over the radius of gyration
    const double A = 1 + along * along, B = along * up, C = 1 + up * up;
    const double friction = uniform(0.05, 0.8), damping = std::pow(10, uniform(-3, 0.5));
    const double u = -uniform(0.3, 2), s = uniform(-2, 2);
    DampedContact contact{A, B, C, friction, damping, u, s};
    contact.run(1.0 / 2000);
    oracle::ImpulsePath<Real> path{A, B, C, friction, u, s};
    path.push_off(damping);
    if (contact.s * s <= 0) ++stopped;
    BOOST_TEST(std::fabs(static_cast<double>(path.u) - contact.u) <= tolerance);
    BOOST_TEST(std::fabs(static_cast<double>(path.s) - contact.s) <= tolerance);
    BOOST_TEST(std::fabs(static_cast<double>(path.normal) - contact.normal) <= tolerance);
    BOOST_TEST(std::fabs(static_cast<double>(path.tangential) - contact.tangential) <= tolerance);
  }
  BOOST_TEST(stopped >= 10);
}

/// Sequences that see their end after some 200 impacts, of which the simulation needs 1000.
BOOST_AUTO_TEST_CASE(an_end_that_is_certain_after_few_impacts_is_judged_by_the_end_after_as_many_as_it_takes) {
  BarCoverage coverage;
  for (const double degrees : {20.0, 40.0, 60.0, 80.0}) {
    const BarScene scene{.shape = BarShape::thin_rod,
                         .mass = 1,
                         .length = 1,
                         .half_thickness = 0,
                         .degrees = degrees,
                         .velocity = {.normal = -1},
                         .gravity = 9.81,
                         .law = {.restitution = 0.92},
                         .digits = 6};
    validation::judge_bars(scene, 400, coverage);
  }
  report(coverage);
  BOOST_TEST(coverage.certain_ends >= 2);
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
  BOOST_TEST(coverage.sums_inside == coverage.sums);
}

/// Friction takes the energy that the damping of ever slower impacts no longer takes.  1.2e-13 m/s
/// is where the damping is lost in rounding.
BOOST_AUTO_TEST_CASE(a_rod_that_rattles_on_damped_ground_with_friction_comes_to_rest) {
  const BarScene scene{
      .shape = BarShape::rod,
      .mass = 3.0740620976336124,
      .length = 0.082870984938126752,
      .half_thickness = 0.013318964557510781,
      .degrees = 49.434677842355953,
      .velocity = {.normal = -1.5622081983478644, .tangential = 1.2088601383115591, .angular = -2.8469536125263839},
      .gravity = 14.436523041730803,
      .law = {.restitution = 1,
              .law = analytic::RestitutionLaw::viscoelastic,
              .friction = analytic::FrictionKind::coulomb,
              .friction_value = 0.31521293908102038,
              .damping_per_stiffness = 0.0040557883706542975},
      .digits = 6};
  BarCoverage coverage;
  validation::judge_bars(scene, to_rest, coverage);
  report(coverage);
  BOOST_TEST(coverage.rows_inside == coverage.predictable);
  BOOST_TEST(coverage.certain_ends_right == 1);
  BOOST_CHECK(sequence_of(scene).outcome == Outcome::at_rest);
}

/// The fold is the last angle with a second impact, where that grazes: its speed falls with the
/// root of the distance, and so errors beside it grow without bound.
BOOST_AUTO_TEST_CASE(beside_a_graze_a_row_is_within_its_bars_or_said_to_be_unknown) {
  constexpr double first_order = 1.0 / 3;  // of the speed: beyond, a shift of the drop bends
  BarCoverage coverage;
  double degrees = 58.488442288312257;
  for (int i = 0; i < 60; ++i) {
    const BarScene scene{.shape = BarShape::thin_rod,
                         .mass = 1,
                         .length = 1,
                         .half_thickness = 0,
                         .degrees = degrees,
                         .velocity = {.normal = -1},
                         .gravity = 0,
                         .law = {},
                         .digits = 6};
    validation::judge_bars(scene, 3, coverage);
    for (const analytic::ImpactRow& row : sequence_of(scene, 3).rows) {
      if (!row.error.predictable) continue;
      BOOST_TEST_CONTEXT(scene.words())
      BOOST_TEST(row.error.approach_speed <= first_order * row.impact.approach_speed);
    }
    for (int ulps = 0; ulps <= i; ++ulps) degrees = std::nextafter(degrees, 0);
  }
  report(coverage);
  BOOST_TEST(coverage.rows_inside == coverage.predictable);
  BOOST_TEST(coverage.predictable < coverage.rows);
  BOOST_TEST(coverage.predictable > coverage.scenes);  // some second impacts are known
  BOOST_TEST(coverage.certain_ends_right == coverage.certain_ends);
}

/// Rattling that never repeats itself: followed until what remains is lost in the sums.
BOOST_AUTO_TEST_CASE(a_rod_that_rattles_without_a_period_comes_to_rest) {
  const BarScene scene{.shape = BarShape::thin_rod,
                       .mass = 0.26071795632854405,
                       .length = 0.13769364136090528,
                       .half_thickness = 0,
                       .degrees = 89.023913789935236,
                       .velocity = {.normal = -1.0011175892480295, .tangential = 1.4967006908761809},
                       .gravity = 4.5773864741884269,
                       .law = {.restitution = 0.95512805442050897},
                       .digits = 6};
  BarCoverage coverage;
  validation::judge_bars(scene, to_rest, coverage);
  report(coverage);
  BOOST_TEST(coverage.certain_ends_right == 1);
  BOOST_TEST(coverage.sums_inside == 1);
  BOOST_CHECK(sequence_of(scene).outcome == Outcome::at_rest);
}

/// The bounces of one end shrink as if to stay on the ground; before they have, the other end
/// strikes.
BOOST_AUTO_TEST_CASE(an_accumulation_that_another_end_breaks_into_is_not_cut_short) {
  const BarScene scene{.shape = BarShape::thin_rod,
                       .mass = 2.2275380999336853,
                       .length = 0.256163070044582,
                       .half_thickness = 0,
                       .degrees = 47.788458928754956,
                       .velocity = {.normal = -3.5923154100186983},
                       .gravity = 14.649765816402557,
                       .law = {.restitution = 0.80793098866059099,
                               .friction = analytic::FrictionKind::coulomb,
                               .friction_value = 0.025576248789107539},
                       .digits = 3};
  BarCoverage coverage;
  validation::judge_bars(scene, to_rest, coverage);
  report(coverage);
  BOOST_TEST(coverage.certain_ends_right == 1);
  BOOST_TEST(coverage.sums_inside == 1);
}
