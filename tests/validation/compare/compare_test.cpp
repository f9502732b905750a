// SPDX-License-Identifier: GPL-3.0-or-later
// Both models side by side, in the plane and in space: the bodies, the predicted sizes, the stiff limit, and what
// cannot be compared.
#include "analytic/base/errors.hpp"
#include "tests/support.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/compare/discrete_side.hpp"
#include "validation/compare/random_scenes.hpp"
#include "validation/run/discrete_scene.hpp"

namespace {

using namespace clatter;
using namespace clatter::validation;
using test::eps;

constexpr int random_scene_count = CLATTER_TEST_SLOW_BUILD ? 8 : 16;  // sanitizers cost a factor of ten

/// A case without the error estimates of the single runs.
Scene bare_case(const char* name, int impacts) {
  Scene scene = case_scene(name);
  scene.request.error_estimates = false;
  scene.request.impacts = impacts;
  return scene;
}

Scene box_scene(double angle_deg, int impacts = 6) {
  Scene scene = bare_case("phone-elastic", impacts);
  scene.angle_deg = angle_deg;
  return scene;
}

/// A phone on a corner.
Scene corner_scene(int impacts = 6) { return bare_case("phone-corner", impacts); }

Comparison compared(const Scene& scene) { return compare_models(scene, scene.make_body()); }

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_CASE(the_planar_body_of_a_box_has_its_corners_and_inertia) {
  const analytic::PlanarBody planar = planar_body(box_scene(10).make_body());
  const analytic::PlanarBody exact = analytic::make_box({0.08814, 0.10566, 0.04394, 0.01905});
  BOOST_TEST(planar.vertex_count == 4);
  BOOST_TEST(planar.gyration_square == exact.gyration_square, boost::test_tools::tolerance(20 * eps));
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(std::fabs(planar.vertices[i].x - exact.vertices[i].x) <= eps);
    BOOST_TEST(std::fabs(planar.vertices[i].z - exact.vertices[i].z) <= eps);
  }
}

BOOST_AUTO_TEST_CASE(creeping_friction_and_outlines_that_leave_the_plane_are_refused_by_name) {
  Scene creeping = box_scene(10);
  creeping.world.ground.static_friction = creeping.world.ground.sliding_friction = 0.1;
  creeping.world.ground.friction = numeric::FrictionLaw::regularised;
  CHECK_REFUSED_SAYING(compared(creeping), analytic::OutsideModelError, "regularised");
  // A cube whose centre of mass lies off its middle plane y = 0.1.
  const numeric::Vector3 h(0.5, 0.5, 0.5);
  numeric::Surface cube{.nodes = {}, .elements = {}};
  for (int i = 0; i < 8; ++i)
    cube.nodes.push_back({(i & 1 ? 1 : -1) * h.x(), (i & 2 ? 1 : -1) * h.y() + 0.1, (i & 4 ? 1 : -1) * h.z()});
  for (const auto& nodes :
       {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    cube.elements.push_back({.nodes = nodes});
  }
  const numeric::Body moved({.mass = 1, .centre = {0, 0, 0}, .inertia = numeric::Matrix3::Identity()}, cube);
  CHECK_REFUSED_SAYING(planar_body(moved), analytic::OutsideModelError, "y = 0");
}

BOOST_AUTO_TEST_CASE(gravity_alone_adds_its_momentum_to_a_flat_landing) {
  Scene scene = box_scene(0, 1);
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
  const Scene scene = box_scene(3, 2);
  const Comparison comparison = compared(scene);
  BOOST_TEST(mentions(comparison.impacts.at(0).reason, "another place touches"));
  BOOST_TEST(mentions(comparison.impacts.at(1).reason, "follows"));
  BOOST_TEST(comparison.impacts[0].has_landing());
  BOOST_TEST(comparison.impacts[1].has_landing());
  BOOST_TEST(comparison.agrees());
}

BOOST_AUTO_TEST_CASE(what_cannot_be_predicted_in_space_and_friction_beyond_the_limit_of_painleve_are_said) {
  Scene scene = box_scene(10, 4), jams = bare_case("rod-45", 1);
  scene.world.ground.stiffness = 1e9;
  const Comparison comparison = compared(scene);
  BOOST_TEST(comparison.impacts.at(2).reason.empty());
  BOOST_TEST(mentions(comparison.impacts.at(3).reason, "beyond the predictable"));
  jams.angle_deg = 63.4;  // tan θ = 2, where a thin rod jams from 4/3 on
  jams.world.ground.static_friction = jams.world.ground.sliding_friction = 1.5;
  BOOST_TEST(mentions(compared(jams).impacts.at(0).reason, "jamming"));
}

BOOST_AUTO_TEST_CASE(a_deviation_has_the_errors_of_both_models) {
  ComparedImpact one;
  one.discrete.emplace()[0] = 1;
  one.continuous.emplace()[0] = 3;
  one.discrete_error[0] = 0.25;
  one.continuous_error[0] = 0.5;
  const Estimated deviation = NumberPair{one, 0}.deviation_number();
  BOOST_TEST((deviation.value == 2 && deviation.error >= 0.75 && deviation.error < 0.75001));
}

/// The sequence that begins with a row is the rest of the sequence: mirrored or turned over, but with the same angles,
/// impulses and intervals, to the rounding of the state, grown over a flight.
BOOST_AUTO_TEST_CASE(a_drop_that_begins_with_a_row_goes_on_like_the_sequence) {
  const analytic::Drop rod = std::get<analytic::Drop>(discrete_drop(case_scene("rod-from-2m")));
  const analytic::Drop lopsided{.body = {.mass = 1,  // not its own mirror image
                                         .gyration_square = 0.06,
                                         .vertex_count = 3,
                                         .vertices = {{{-0.35, -0.1}, {0.6, -0.12}, {0.05, 0.3}}}},
                                .inclination = analytic::Angle::from_degrees(20),
                                .velocity = {.normal = -1},
                                .gravity = 9.81,
                                .law = {}};
  const auto check = [](const auto& drop, double tolerance, const auto& same) {
    const auto whole = impact_sequence(drop, {.impacts = 4, .amplification = false});
    for (std::size_t from = 1; from < 3; ++from) {
      const auto rest = impact_sequence(drop_at(drop, whole.rows.at(from)), {.impacts = 2, .amplification = false});
      for (std::size_t i = 0; i < 2; ++i) {
        const auto &a = whole.rows.at(from + i), &b = rest.rows.at(i);
        BOOST_TEST(std::fabs(b.start - (a.start - whole.rows[from].start)) <= tolerance);
        same(a, b);
      }
    }
  };
  for (const analytic::Drop& drop : {rod, lopsided}) {
    check(drop, 1e-12, [](const analytic::ImpactRow& a, const analytic::ImpactRow& b) {
      BOOST_TEST(b.contact_angle == a.contact_angle, boost::test_tools::tolerance(1e-11));
      BOOST_TEST(b.impact.normal_impulse == a.impact.normal_impulse, boost::test_tools::tolerance(1e-11));
    });
  }
  using analytic::space::ImpactRow;
  check(std::get<analytic::space::Drop>(discrete_drop(corner_scene())), 1e-11,
        [](const ImpactRow& a, const ImpactRow& b) {
          BOOST_TEST(b.corners.front().index == a.corners.front().index);
          BOOST_TEST((b.impact.impulse - a.impact.impulse).norm() <= 1e-10 * a.impact.impulse.norm());
        });
}

/// All three effects are of the order of the contact time, T ∝ k^(−1/3) for an edge and k^(−1/4) for a corner: so are
/// the deviations, and no number deviates by more than was predicted.
BOOST_AUTO_TEST_CASE(deviations_have_the_predicted_size_and_fall_with_the_contact_time) {
  struct Case {
    Scene scene;
    double first, factor, least, tolerance;  ///< grounds, each to halve the contact time; least part of the prediction
  };
  for (const Case& c : {Case{box_scene(20, 1), 1e12 / 1e8, 8, 1. / 30, 0.05}, {corner_scene(1), 1e6, 16, 0.01, 0.1}}) {
    double before = 0;
    for (int i = 0; i < 3; ++i) {
      Scene scene = c.scene;
      const double stiffer = c.first * std::pow(c.factor, i);
      scene.world.ground.stiffness *= stiffer;
      scene.world.ground.damping *= stiffer;
      scene.accuracy.digits = std::max(scene.accuracy.digits, 10);
      const ComparedImpact impact = compared(scene).impacts.at(0);
      BOOST_TEST(impact.reason == "");
      const MotionNumbers predicted = impact.predicted.total();
      double deviation = 0;
      for (std::size_t q = 2; q < motion_number_count; ++q) {
        const double here = std::fabs((*impact.continuous)[q] - (*impact.discrete)[q]);
        BOOST_TEST(here <= predicted[q] + 1e-9);
        if (q == normal_impulse_place) deviation = here;
      }
      BOOST_TEST(deviation >= c.least * predicted[normal_impulse_place]);  // a size, not a bound without content
      if (before > 0) BOOST_TEST(std::fabs(before / deviation - 2) <= c.tolerance);
      before = deviation;
    }
  }
}

BOOST_AUTO_TEST_CASE(the_stiff_limit_holds_95_of_100_impacts_of_random_drops_in_space_and_each_other_is_explained) {
  const RandomSpaceResult result = run_random_space_scenes({.seed = 77, .count = random_scene_count, .impacts = 4});
  BOOST_TEST(result.impacts >= 2 * random_scene_count);
  BOOST_TEST(result.share() >= 0.95);
  BOOST_TEST(result.median_bar <= 50);
  for (const UnsettledImpact& impact : result.unsettled) {
    BOOST_TEST_CONTEXT("scene " << impact.scene << ", impact " << impact.n) BOOST_TEST(!impact.explanation.empty());
  }
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

/// Deliberate disagreements.
BOOST_AUTO_TEST_CASE(a_limit_that_misses_the_discrete_value_is_found_in_the_plane_and_in_space) {
  for (const bool in_space : {false, true}) {
    Comparison comparison = compared(in_space ? corner_scene(1) : bare_case("phone-damped", 1));
    BOOST_TEST(comparison.agrees());
    ComparedImpact& impact = comparison.impacts.at(0);
    for (const std::size_t q : in_space ? std::vector<std::size_t>{3, 8, 10} : std::vector{normal_impulse_place}) {
      const double was = (*impact.discrete)[q];
      (*impact.discrete)[q] *= 1 + (in_space ? 1e-6 : 1e-9);  // tens of bars
      BOOST_TEST((!impact.lands() && !comparison.agrees()));
      if (in_space) BOOST_TEST(!(impact.bars_off() <= 5));
      (*impact.discrete)[q] = test::not_a_number;
      BOOST_TEST(!comparison.agrees());
      (*impact.discrete)[q] = was;
    }
    BOOST_TEST(comparison.agrees());
  }
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
  Scene scene = corner_scene(1);
  scene.height.reset();
  scene.angle_deg = 0;
  scene.tilt_deg = 30;
  const ComparedImpact impact = compared(scene).impacts.at(0);
  BOOST_TEST(impact.discrete_end == "-x-y-z +x-y-z");
  BOOST_REQUIRE(impact.has_landing());
  BOOST_TEST(impact.lands());
}
