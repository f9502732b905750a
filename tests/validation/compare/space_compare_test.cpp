// SPDX-License-Identifier: GPL-3.0-or-later
// Both models side by side in space.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include "validation/compare/prediction.hpp"
#include "validation/compare/random_space_scenes.hpp"
#include "validation/run/discrete_scene.hpp"

namespace {

using namespace clatter;
using namespace clatter::validation;

constexpr int random_scene_count = CLATTER_TEST_SLOW_BUILD ? 8 : 48;  // sanitizers cost a factor of ten

/// A phone on a corner, without the error estimates of the single runs.
Scene corner_scene() {
  Scene scene = case_scene("phone-corner");
  scene.request.error_estimates = false;
  return scene;
}

Comparison compared(const Scene& scene) { return compare_models(scene, scene.make_body()); }

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_CASE(a_phone_on_its_corner_agrees_impact_by_impact_in_space_with_friction_and_damping) {
  Scene scene = corner_scene();
  scene.request.impacts = 8;
  const Comparison comparison = compared(scene);
  BOOST_REQUIRE_GE(comparison.impacts.size(), 8u);
  BOOST_TEST(comparison.agrees());
  BOOST_TEST(comparison.discrete.in_space);
  for (std::size_t i = 0; i < 8; ++i) {
    const ComparedImpact& impact = comparison.impacts[i];
    BOOST_TEST_CONTEXT("impact " << impact.n) {
      BOOST_REQUIRE(impact.has_landing());
      BOOST_TEST(impact.bars_off() <= 1);
      BOOST_TEST(impact.explanation == "");
      for (const auto& [name, heading, q] : comparison.discrete.quantities) {
        BOOST_TEST(impact.limit->error[q] <= 1e-3 * comparison.discrete.scales[q]);  // a bar that says something
      }
    }
  }
  // The body leaves its plane: the numbers out of it are numbers, too.
  BOOST_TEST(std::fabs((*comparison.impacts[0].discrete)[3]) > 0.01);
  BOOST_TEST(std::fabs((*comparison.impacts[0].discrete)[8]) > 1);
}

BOOST_AUTO_TEST_CASE(the_stiff_limit_holds_95_of_100_impacts_of_random_drops_in_space_and_each_other_is_explained) {
  const RandomSpaceResult result = run_random_space_scenes({.seed = 77, .count = random_scene_count, .impacts = 4});
  BOOST_TEST(result.impacts >= 2 * random_scene_count);
  BOOST_TEST(result.share() >= 0.95);
  BOOST_TEST(result.median_bar <= 50);
  for (const UnsettledImpact& impact : result.unsettled) {
    BOOST_TEST_CONTEXT("scene " << impact.scene << ", impact " << impact.n) BOOST_TEST(!impact.explanation.empty());
    BOOST_TEST_MESSAGE("scene " << impact.scene << ", impact " << impact.n << ": " << impact.explanation);
  }
  BOOST_TEST_MESSAGE(result.within << " of " << result.impacts << " within, median bar " << result.median_bar
                                   << ", farthest " << result.farthest << ", largest bar " << result.largest_bar);
}

/// On the scene's own ground no contact ends at 12 digits; the limit does not depend on that.
BOOST_AUTO_TEST_CASE(a_ground_too_soft_for_a_run_of_12_digits_has_its_limit_in_space_too) {
  SpaceScene drop = random_space_scene(5, 62);
  drop.scene.request.impacts = 1;
  drop.scene.request.error_estimates = false;
  drop.scene.accuracy.evaluation_limit = 100'000;
  drop.scene.world.ground.stiffness *= 16;
  drop.scene.world.ground.damping *= 16;
  const Comparison comparison = compare_models(drop.scene, drop.body);
  BOOST_REQUIRE(!comparison.impacts.empty());
  BOOST_REQUIRE(comparison.impacts[0].has_landing());
  BOOST_TEST(comparison.impacts[0].lands());
}

/// The families are what they say: their bodies differ, and none is refused.
BOOST_AUTO_TEST_CASE(random_drops_in_space_are_boxes_off_centre_boxes_tetrahedra_and_ls) {
  const std::size_t corners[] = {8, 8, 4, 10};
  for (int index = 0; index < 16; ++index) {
    const SpaceScene drop = random_space_scene(3, index);
    const analytic::space::Body body = space_body(drop.body);
    BOOST_TEST(body.vertices.size() == corners[index % 4]);
    BOOST_TEST(std::holds_alternative<analytic::space::Drop>(DiscreteBody(drop.body).drop(drop.scene)));
    numeric::Vector3 sum = numeric::Vector3::Zero();
    for (const numeric::Vector3& vertex : body.vertices) sum += vertex;
    // A uniform box and a uniform tetrahedron have their mass in the middle of their corners.
    BOOST_TEST((sum.norm() <= 1e-9 * drop.body.radius()) == (index % 2 == 0));
  }
}

/// A deliberate disagreement: the limit is that of another coefficient of friction.
BOOST_AUTO_TEST_CASE(a_limit_in_space_that_misses_the_discrete_value_is_found_and_said) {
  Scene scene = corner_scene();
  scene.request.impacts = 1;
  Comparison comparison = compared(scene);
  BOOST_TEST(comparison.agrees());
  ComparedImpact& impact = comparison.impacts.at(0);
  for (const std::size_t q : {std::size_t{3}, std::size_t{8}, std::size_t{10}}) {
    const double was = (*impact.discrete)[q];
    (*impact.discrete)[q] *= 1 + 1e-6;
    BOOST_TEST(!impact.lands());
    BOOST_TEST(!(impact.bars_off() <= 5));
    (*impact.discrete)[q] = std::nan("");
    BOOST_TEST(!comparison.agrees());
    (*impact.discrete)[q] = was;
  }
  BOOST_TEST(comparison.agrees());
}

/// In the limit the patch is a point: leaving out how slip varies over it changes nothing there.
BOOST_AUTO_TEST_CASE(a_patch_taken_as_a_point_changes_the_numbers_by_less_and_less_on_stiffer_ground) {
  Scene scene = corner_scene();
  scene.angular_velocity = {3, -2, 25};  // spin that a patch feels
  scene.world.ground.static_friction = scene.world.ground.sliding_friction = 0.4;
  scene.request.impacts = 1;
  scene.request.amplification = false;
  scene.accuracy.digits = 12;
  const numeric::Body body = scene.make_body();
  double before = 0;
  for (const double stiffer : {1e6, 1.6e7, 2.56e8}) {
    numeric::World world = scene.world;
    world.ground.stiffness *= stiffer;
    world.ground.damping *= stiffer;
    const auto impulse = [&](bool point) {
      world.point_friction = point;
      return numeric::simulate(body, world, scene.start(body), scene.request, scene.accuracy)
          .impacts.at(0)
          .value.impulse;
    };
    const numeric::Vector3 point = impulse(true);
    const double change = (impulse(false) - point).norm() / point.norm();
    BOOST_TEST(change > 0);                              // the option does something
    if (before > 0) BOOST_TEST(change <= 0.6 * before);  // of the order of the patch's size, which halves
    before = change;
  }
  BOOST_TEST(before <= 1e-4);
}

BOOST_AUTO_TEST_CASE(corners_that_land_at_once_are_said_with_the_outcomes_of_small_tilts) {
  Scene scene = corner_scene();
  scene.height.reset();
  scene.angle_deg = 0;
  scene.tilt_deg = 0;
  scene.angular_velocity = {4, 3, 0};  // the whole face touches at once while it turns
  const Comparison comparison = compared(scene);
  const ComparedImpact& impact = comparison.impacts.at(0);
  BOOST_TEST(!impact.has_landing());
  BOOST_TEST(mentions(impact.explanation, "4 corners land at once"));
  BOOST_TEST(mentions(impact.explanation, "outcomes"));
  BOOST_TEST(mentions(comparison.impacts.at(1).explanation, "rounding decides"));
}

/// Level and without turning both corners of an edge do the same on any ground.
BOOST_AUTO_TEST_CASE(an_edge_that_lands_level_agrees_in_space) {
  Scene scene = corner_scene();
  scene.height.reset();
  scene.angle_deg = 0;
  scene.tilt_deg = 30;
  scene.request.impacts = 1;
  const ComparedImpact impact = compared(scene).impacts.at(0);
  BOOST_TEST(impact.discrete_end == "-x-y-z +x-y-z");
  BOOST_REQUIRE(impact.has_landing());
  BOOST_TEST(impact.lands());
}

BOOST_AUTO_TEST_CASE(deviations_in_space_have_the_predicted_size_and_fall_with_the_contact_time) {
  double before = 0;
  for (const double stiffer : {1e6, 1.6e7, 2.56e8}) {
    Scene scene = corner_scene();
    scene.request.impacts = 1;
    scene.accuracy.digits = 10;
    scene.world.ground.stiffness *= stiffer;
    scene.world.ground.damping *= stiffer;
    const ComparedImpact impact = compared(scene).impacts.at(0);
    BOOST_TEST(impact.reason == "");
    const MotionNumbers predicted = impact.predicted.total();
    double deviation = 0;
    for (std::size_t q = 2; q < motion_number_count; ++q) {
      const double here = std::fabs((*impact.continuous)[q] - (*impact.discrete)[q]);
      BOOST_TEST(here <= predicted[q] + 1e-9);
      if (q == normal_impulse_place) deviation = here;
    }
    BOOST_TEST(deviation >= predicted[normal_impulse_place] / 100);        // a size, not a bound without content
    if (before > 0) BOOST_TEST(std::fabs(before / deviation - 2) <= 0.1);  // T ∝ k^(−1/4)
    before = deviation;
  }
}

BOOST_AUTO_TEST_CASE(a_drop_in_space_that_begins_with_a_row_goes_on_like_the_sequence) {
  const Scene scene = corner_scene();
  const analytic::space::Drop drop = std::get<analytic::space::Drop>(discrete_drop(scene));
  const analytic::space::Sequence whole = impact_sequence(drop, {.impacts = 4, .amplification = false});
  for (std::size_t from = 1; from < 3; ++from) {
    const auto rest = impact_sequence(drop_at(drop, whole.rows[from]), {.impacts = 2, .amplification = false});
    for (std::size_t i = 0; i < 2; ++i) {
      const analytic::space::ImpactRow &a = whole.rows[from + i], &b = rest.rows[i];
      BOOST_TEST(b.corners.front().index == a.corners.front().index);
      // Rounding of the state, grown over a flight.
      BOOST_TEST((b.impact.impulse - a.impact.impulse).norm() <= 1e-10 * a.impact.impulse.norm());
      BOOST_TEST(std::fabs(b.start - (a.start - whole.rows[from].start)) <= 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_ends_the_limit_of_a_drop_in_space_is_said_for_each_impact_after_it) {
  Scene scene = corner_scene();
  scene.request.impacts = 40;
  const Comparison comparison = compared(scene);
  bool lands = true;
  int explained = 0;
  for (const ComparedImpact& impact : comparison.impacts) {
    if (impact.has_landing()) BOOST_TEST(lands);  // none after the first without a limit
    lands = impact.has_landing();
    if (!lands) BOOST_TEST(!impact.explanation.empty());
    explained += lands ? 0 : 1;
  }
  BOOST_TEST(explained > 0);
}
