// SPDX-License-Identifier: GPL-3.0-or-later
// Both models side by side: the planar body, the predicted sizes, the stiff limit, and what cannot be compared.
#include <boost/test/unit_test.hpp>

#include <cmath>

#include "analytic/base/errors.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/compare/random_scenes.hpp"
#include "validation/run/discrete_scene.hpp"

namespace {

using namespace clatter;
using namespace clatter::validation;

constexpr double epsilon = 2.2e-16;
constexpr int random_scene_count = CLATTER_TEST_SLOW_BUILD ? 40 : 200;  // the sanitizers cost a factor of ten

Scene box_scene(double angle_deg) {
  Scene scene = case_scene("phone-elastic");
  scene.angle_deg = angle_deg;
  scene.request.error_estimates = false;
  return scene;
}

Comparison compared(const Scene& scene) { return compare_models(scene, scene.make_body()); }

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

auto says(const std::string& part) {
  return [part](const std::exception& error) { return mentions(error.what(), part); };
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_planar_body_of_a_box_has_its_corners_and_inertia) {
  const analytic::PlanarBody planar = planar_body(box_scene(10).make_body());
  const analytic::PlanarBody exact = analytic::make_box({0.08814, 0.10566, 0.04394, 0.01905});
  BOOST_TEST(planar.vertex_count == 4);
  BOOST_TEST(planar.gyration_square == exact.gyration_square, boost::test_tools::tolerance(20 * epsilon));
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(std::fabs(planar.vertices[i].x - exact.vertices[i].x) <= epsilon);
    BOOST_TEST(std::fabs(planar.vertices[i].z - exact.vertices[i].z) <= epsilon);
  }
}

BOOST_AUTO_TEST_CASE(creeping_friction_and_outlines_that_leave_the_plane_are_refused_by_name) {
  Scene creeping = box_scene(10);
  creeping.world.ground.static_friction = creeping.world.ground.sliding_friction = 0.1;
  creeping.world.ground.friction = numeric::FrictionLaw::regularised;
  BOOST_CHECK_EXCEPTION(compared(creeping), analytic::OutsideModelError, says("regularised"));
  // A cube whose centre of mass lies off its middle plane y = 0.1.
  const numeric::Vector3 h(0.5, 0.5, 0.5);
  numeric::Surface cube{.nodes = {}, .elements = {}};
  for (int i = 0; i < 8; ++i) {
    cube.nodes.push_back({(i & 1 ? 1 : -1) * h.x(), (i & 2 ? 1 : -1) * h.y() + 0.1, (i & 4 ? 1 : -1) * h.z()});
  }
  for (const auto& nodes :
       {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    cube.elements.push_back({.nodes = nodes});
  }
  const numeric::Body moved({.mass = 1, .centre = {0, 0, 0}, .inertia = numeric::Matrix3::Identity()}, cube);
  BOOST_CHECK_EXCEPTION(static_cast<void>(planar_body(moved)), analytic::OutsideModelError, says("y = 0"));
}

/// The sequence that begins with a row is the rest of the sequence: mirrored or turned over, but with the same angles,
/// impulses and intervals.
BOOST_AUTO_TEST_CASE(a_drop_that_begins_with_a_row_goes_on_like_the_sequence) {
  const Scene scene = case_scene("rod-from-2m");
  const analytic::Drop drop = std::get<analytic::Drop>(discrete_drop(scene));
  const analytic::Sequence whole = impact_sequence(drop, {.impacts = 5, .amplification = false});
  for (std::size_t from = 1; from < 4; ++from) {
    const analytic::Sequence rest =
        impact_sequence(drop_at(drop, whole.rows[from]), {.impacts = 2, .amplification = false});
    for (std::size_t i = 0; i < 2; ++i) {
      const analytic::ImpactRow &a = whole.rows[from + i], &b = rest.rows[i];
      // Rounding of the state, grown over a flight.
      BOOST_TEST(b.contact_angle == a.contact_angle, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(b.impact.normal_impulse == a.impact.normal_impulse, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(std::fabs(b.start - (a.start - whole.rows[from].start)) <= 1e-12);
    }
  }
}

/// The same for a body that is not its own mirror image.
BOOST_AUTO_TEST_CASE(a_lopsided_body_goes_on_like_its_sequence_too) {
  const analytic::Drop drop{.body = {.mass = 1,
                                     .gyration_square = 0.06,
                                     .vertex_count = 3,
                                     .vertices = {{{-0.35, -0.1}, {0.6, -0.12}, {0.05, 0.3}}}},
                            .inclination = analytic::Angle::from_degrees(20),
                            .velocity = {.normal = -1},
                            .gravity = 9.81,
                            .law = {}};
  const analytic::Sequence whole = impact_sequence(drop, {.impacts = 4, .amplification = false});
  BOOST_REQUIRE(whole.rows.size() == 4u);
  for (std::size_t from = 1; from < 3; ++from) {
    const analytic::Sequence rest =
        impact_sequence(drop_at(drop, whole.rows[from]), {.impacts = 2, .amplification = false});
    for (std::size_t i = 0; i < 2; ++i) {
      BOOST_TEST(rest.rows[i].impact.normal_impulse == whole.rows[from + i].impact.normal_impulse,
                 boost::test_tools::tolerance(1e-11));
    }
  }
}

/// All three effects are of the order of the contact time, T ∝ k^(−1/3) for an edge: so are the deviations, and no
/// number deviates by more than was predicted.
BOOST_AUTO_TEST_CASE(deviations_have_the_predicted_size_and_fall_with_the_contact_time) {
  double before = 0;
  for (const double stiffness : {1e12, 8e12, 64e12}) {
    Scene scene = box_scene(20);
    scene.request.impacts = 1;
    scene.world.ground.stiffness = stiffness;
    const ComparedImpact impact = compared(scene).impacts.at(0);
    BOOST_TEST(impact.reason.empty());
    const MotionNumbers predicted = impact.predicted.total();
    for (std::size_t q = 2; q < motion_number_count; ++q) {
      const double deviation = std::fabs((*impact.continuous)[q] - (*impact.discrete)[q]);
      BOOST_TEST(deviation <= predicted[q] + 1e-9);
      if (q != normal_impulse_place) continue;
      BOOST_TEST(deviation >= predicted[q] / 30);  // a size, not a bound without content
      if (before > 0) BOOST_TEST(std::fabs(before / deviation - 2) <= 0.05);
      before = deviation;
    }
  }
}

BOOST_AUTO_TEST_CASE(gravity_alone_adds_its_momentum_to_a_flat_landing) {
  Scene scene = box_scene(0);
  scene.request.impacts = 1;
  scene.accuracy.digits = 10;
  const Comparison comparison = compared(scene);
  const ComparedImpact& impact = comparison.impacts.at(0);
  BOOST_TEST(impact.discrete_end == "both");
  // Flat and elastic the body leaves as it came, so P − 2 m v = m g T exactly.
  const double excess = (*impact.continuous)[normal_impulse_place] - (*impact.discrete)[normal_impulse_place];
  const double weight = scene.body.mass * scene.world.gravity * impact.contact_time;
  BOOST_TEST(excess == weight, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(impact.predicted.gravity[normal_impulse_place] == 2 * weight, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(impact.predicted.turning[normal_impulse_place] == 0);
}

BOOST_AUTO_TEST_CASE(a_second_touch_before_the_first_has_ended_is_said_and_agrees_on_stiffer_ground) {
  Scene scene = box_scene(3);
  scene.request.impacts = 2;
  const Comparison comparison = compared(scene);
  BOOST_TEST(mentions(comparison.impacts.at(0).reason, "another place touches"));
  BOOST_TEST(mentions(comparison.impacts.at(1).reason, "follows"));
  BOOST_TEST(comparison.impacts[0].has_landing());
  BOOST_TEST(comparison.impacts[1].has_landing());
  BOOST_TEST(comparison.agrees());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_predicted_in_space_is_said) {
  Scene scene = box_scene(10);
  scene.world.ground.stiffness = 1e9;
  scene.request.impacts = 4;
  const Comparison comparison = compared(scene);
  BOOST_TEST(comparison.impacts.at(2).reason.empty());
  BOOST_TEST(mentions(comparison.impacts.at(3).reason, "beyond the predictable"));
}

BOOST_AUTO_TEST_CASE(friction_beyond_the_limit_of_painleve_is_named) {
  Scene scene = case_scene("rod-45");
  scene.angle_deg = 63.4;  // tan θ = 2, where a thin rod jams from 4/3 on
  scene.world.ground.static_friction = scene.world.ground.sliding_friction = 1.5;
  scene.request.error_estimates = false;
  BOOST_TEST(mentions(compared(scene).impacts.at(0).reason, "jamming"));
}

/// A deliberate disagreement: the continuous model on damped ground against an elastic discrete one.
BOOST_AUTO_TEST_CASE(a_limit_that_misses_the_discrete_value_is_found) {
  Scene scene = case_scene("phone-damped");
  scene.request.impacts = 1;
  Comparison comparison = compared(scene);
  BOOST_TEST(comparison.agrees());
  (*comparison.impacts.at(0).discrete)[normal_impulse_place] *= 1 + 1e-9;  // tens of bars
  BOOST_TEST(!comparison.impacts[0].lands());
  BOOST_TEST(!comparison.agrees());
  (*comparison.impacts[0].discrete)[normal_impulse_place] = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!comparison.agrees());
}

/// Another family than that of clatter verify.
BOOST_AUTO_TEST_CASE(the_limits_of_200_random_scenes_lie_within_honest_error_bars) {
  const RandomScenesResult result = run_random_scenes({.seed = 77, .count = random_scene_count, .impacts = 2});
  BOOST_TEST(result.with_limit >= random_scene_count * 19 / 20);
  BOOST_TEST(result.covered >= 0.95);
  BOOST_TEST(result.median_bar <= 10);
  BOOST_TEST_MESSAGE("covered " << result.covered << ", bars over gaps " << result.median_bar);
}
