// SPDX-License-Identifier: GPL-3.0-or-later
// Each level of the hierarchy tends to the one above it where its assumption becomes true.
#include "validation/plan/model_hierarchy.hpp"
#include "tests/support.hpp"

using namespace clatter;
using namespace clatter::validation;

namespace {

constexpr LevelSetting fine(ModelLevel level) {
  return {.level = level, .method = numeric::Method::rk8pd, .tolerance = 1e-12};
}

/// How far two levels are apart on a scene.
double apart(const Scene& scene, ModelLevel level, ModelLevel other) {
  const ModelHierarchy hierarchy(scene);
  const int impacts = scene.request.impacts;
  const numeric::Simulation run = hierarchy.simulate(fine(ModelLevel::planar), impacts);
  const MotionNumbers sizes = motion_sizes(run, run.impacts.size(), hierarchy.body());
  return distance(hierarchy.run(fine(level), impacts).rows, hierarchy.run(fine(other), impacts).rows, sizes);
}

/// d ln(values)/d ln(parameters) between two points.
double order(double first, double second, double factor) { return std::log(first / second) / std::log(factor); }

/// What a scene's run changes by without a part.
double change_without(const Scene& scene, Part part) {
  const ModelHierarchy with(scene), reduced(without(scene, part));
  const numeric::Simulation run = with.simulate(fine(ModelLevel::planar), scene.request.impacts);
  const MotionNumbers sizes = motion_sizes(run, run.impacts.size(), with.body());
  return distance(reduced.run(fine(ModelLevel::planar), scene.request.impacts).rows, motion_rows(run_of(run)), sizes);
}

bool is_mirrored(const Scene& scene) {
  const numeric::Body body = scene.make_body();
  return is_mirror_image(body, scene.start(body));
}

}  // namespace

BOOST_AUTO_TEST_CASE(closed_form_is_the_discrete_rung_for_a_rod_that_becomes_thin) {
  double before = 0;
  for (const char* radius : {"1e-3", "1e-4", "1e-5"}) {
    const double now = apart(case_scene("rod-10", {{"body.radius", "--radius", radius}}), ModelLevel::closed_form,
                             ModelLevel::discrete);
    // The rim lies r sin θ and r cos θ off the axis: the numbers change in proportion to r.
    if (before > 0) BOOST_TEST(std::fabs(order(before, now, 10) - 1) <= 0.05);
    before = now;
  }
  BOOST_TEST(before <= 1e-4);
}

BOOST_AUTO_TEST_CASE(closed_form_and_discrete_model_agree_on_a_thin_rod_to_rounding) {
  for (double degrees = 1; degrees < 58; degrees += 1.5) {
    for (const double gravity : {0.0, 0.3}) {
      const analytic::Drop drop{.body = analytic::make_rod({.mass = 2, .length = 0.5, .radius = 0}),
                                .inclination = analytic::Angle::from_degrees(degrees),
                                .velocity = {.normal = -3},
                                .gravity = gravity,
                                .law = {.restitution = 0.9}};
      const analytic::Sequence model = impact_sequence(drop, {.impacts = 3});
      const analytic::Sequence formula = closed_form_sequence(drop, 3);
      const std::size_t common = std::min(model.rows.size(), formula.rows.size());
      BOOST_TEST(common >= 1);
      for (std::size_t i = 0; i < common; ++i) {
        // Rounding grows with the condition number of each row: bounds of contact_angles() and sequence, e < 1.
        const double tolerance = 12 * (2 + 2 * model.rows[i].amplification) * test::eps;
        BOOST_TEST(model.rows[i].vertices == formula.rows[i].vertices);
        const MotionNumbers sizes =
            motion_sizes(run_of(model).impacts, {.reach = drop.body.reach(), .mass = drop.body.mass});
        BOOST_TEST(row_distance(motion_numbers(impact_of(formula.rows[i]).value),
                                motion_numbers(impact_of(model.rows[i]).value), sizes) <= tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(closed_form_refuses_what_its_equations_do_not_have) {
  const analytic::Drop drop{.body = analytic::make_rod({}),
                            .inclination = analytic::Angle::from_degrees(10),
                            .velocity = {.normal = -1},
                            .gravity = 0,
                            .law = {}};
  BOOST_TEST(reason_against_closed_form(drop).empty());
  analytic::Drop spins = drop, rubs = drop, flat = drop, thick = drop;
  spins.velocity.angular = 1;
  rubs.law.friction = analytic::FrictionKind::coulomb;
  flat.inclination = analytic::Angle::from_degrees(0);
  thick.body = analytic::make_box({});
  for (const analytic::Drop& other : {spins, rubs, flat, thick}) BOOST_TEST(!reason_against_closed_form(other).empty());
}

BOOST_AUTO_TEST_CASE(planar_rung_is_the_spatial_one_for_a_body_that_is_its_own_mirror_image) {
  for (const char* name : {"rod-10", "rod-45", "rod-friction-03", "rod-damped"}) {
    // Rounding, which leaves the plane, grows by less than 1e3 in these scenes.
    BOOST_TEST(apart(case_scene(name), ModelLevel::planar, ModelLevel::spatial) <= 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(planar_rung_is_refused_to_a_body_that_is_not) {
  struct Case {
    bool mirrored;
    const char *name, *key, *value;
  };
  for (const Case& c : {Case{true, "phone-damped", "drop.tilt_deg", "0"},
                        {true, "phone-damped", "drop.tilt_deg", "90"},
                        {false, "phone-corner", "drop.tilt_deg", "30"},
                        {true, "rod-45", "drop.tilt_deg", "22.5"},
                        {false, "rod-45", "drop.tilt_deg", "5"},
                        {true, "phone-damped", "drop.velocity", "0.5,0,-1"},
                        {false, "phone-damped", "drop.velocity", "0.5,1e-6,-1"}}) {
    BOOST_TEST(is_mirrored(case_scene(c.name, {{c.key, "--set", c.value}})) == c.mirrored, c.name << ' ' << c.value);
  }
  BOOST_TEST(!ModelHierarchy(case_scene("phone-corner")).against(ModelLevel::planar).empty());
  BOOST_TEST((ModelHierarchy(case_scene("phone-corner")).full() == ModelLevel::spatial));
}

BOOST_AUTO_TEST_CASE(what_is_left_out_changes_the_less_the_less_there_is_of_it) {
  struct Row {
    Part part;
    const char *key, *first, *second;
  };
  // A tenth of the parameter, a tenth of the change: each enters linearly.
  for (const Row& row : {Row{Part::friction, "ground.sliding_friction", "1e-5", "1e-6"},
                         Row{Part::damping, "ground.damping", "1e6", "1e5"},
                         Row{Part::gravity_in_contact, "world.gravity", "1e-2", "1e-3"}}) {
    const auto change = [&](const char* value) {
      return change_without(case_scene("rod-45", {{row.key, "--x", value}}), row.part);
    };
    const double first = change(row.first), second = change(row.second);
    BOOST_TEST(first <= 1e-3);
    BOOST_TEST(first > 0);
    BOOST_TEST(std::fabs(order(first, second, 10) - 1) <= 0.01);
  }
}

BOOST_AUTO_TEST_CASE(merged_faces_change_nothing) {
  Scene scene = case_scene("phone-damped", {{"run.impacts", "--impacts", "2"}});
  scene.body.nx = scene.body.ny = scene.body.nz = 4;
  scene.body.merge = false;
  // Steps differ by rounding: the error per step of rk8pd at 1e-12, over two contacts.
  BOOST_TEST(change_without(scene, Part::unmerged_faces) <= 1e-9);
}
