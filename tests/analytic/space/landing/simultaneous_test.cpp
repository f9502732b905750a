// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/simultaneous.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/analytic/space/impulse/random_contact.hpp"
#include "tests/analytic/space/impulse/reference_impact.hpp"
#include "tests/analytic/space/landing/flat_landing.hpp"
#include "validation/oracles/impulse_path.hpp"
#include "validation/oracles/reference_table.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using namespace clatter::oracle;

double kinetic_energy(const Body& body, const Matrix3& axes, const Vector3& v, const Vector3& spin) {
  const Vector3 own = axes.transpose() * spin;
  return (body.mass * v.squaredNorm() + own.dot(body.inertia * own)) / 2;
}

BOOST_AUTO_TEST_CASE(every_reference_edge_and_face_rebounds_as_a_whole_if_pushes_alone_can_do_it) {
  const auto rows = clatter::oracle::read_reference_table(CLATTER_TEST_DATA_DIR "/space_flat.csv");
  BOOST_REQUIRE_GE(rows.size(), 9u);
  constexpr double tolerance = 5e-12;
  for (const auto& row : rows) {
    const clatter::oracle::ReferenceFields fields(row);
    const Body body{.mass = fields.number("mass"), .inertia = fields.symmetric("I"), .vertices = {}, .rims = {}};
    State before;
    before.attitude = Quaternion(fields.number("q0"), fields.number("q1"), fields.number("q2"), fields.number("q3"));
    before.velocity = fields.vector("V");
    before.angular_velocity = fields.vector("O");
    std::vector<Vector3> places;
    for (int i = 1; i <= static_cast<int>(fields.number("corners")); ++i) {
      places.push_back(fields.vector("r" + std::to_string(i)));
    }
    BOOST_TEST_CONTEXT(fields.text("scene")) {
      const auto whole =
          rebound_as_a_whole(body, before, corners_of(places), frictionless(fields.number("restitution")));
      BOOST_REQUIRE_EQUAL(whole.has_value(), fields.number("feasible") == 1);
      if (!whole) continue;
      const double speed = before.velocity.norm(), reach = places.front().norm();
      BOOST_CHECK_LE(std::fabs(whole->impulse.z() / fields.number("impulse_z") - 1), tolerance);
      BOOST_CHECK_LE((whole->moment - fields.vector("M")).norm(), tolerance * reach * whole->impulse.norm());
      BOOST_CHECK_LE((whole->velocity_after - fields.vector("V_after")).norm(), tolerance * speed);
      BOOST_CHECK_LE((whole->angular_velocity_after - fields.vector("O_after")).norm() * reach, tolerance * speed);
      const double before_energy = fields.number("energy_before");
      BOOST_CHECK_LE(std::fabs(whole->energy_loss - (before_energy - fields.number("energy_after"))),
                     tolerance * before_energy);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rocking_block_without_rebound_keeps_housners_part_of_its_spin) {
  constexpr double tolerance = 1e-14;
  for (const double slenderness : {0.05, 0.2, 0.4, 0.6}) {  // tan α = width over height
    const FlatBox block(slenderness, 0.3, 1, 2.5);
    State before;
    before.angular_velocity = {0, -0.7, 0};  // about the corners at x > 0; those at x < 0 come down
    const Vector3 pivot = block.bottom[1].place;
    before.velocity = -before.angular_velocity.cross(pivot);
    before.velocity.y() = 0;
    const GroupImpact impact = strike_together(block.body, before, block.bottom, coulomb(0, 10));
    const double sine = std::sin(std::atan(slenderness));
    BOOST_CHECK_LE(std::fabs(impact.angular_velocity_after.y() / before.angular_velocity.y() - (1 - 1.5 * sine * sine)),
                   tolerance);
    BOOST_CHECK_LE(std::fabs(impact.angular_velocity_after.x()) + std::fabs(impact.angular_velocity_after.z()),
                   tolerance);
    BOOST_REQUIRE_EQUAL(impact.order.size(), 1u);
    BOOST_CHECK((impact.order[0] == std::vector<int>{0, 3}));
  }
}

BOOST_AUTO_TEST_CASE(corners_of_a_face_or_an_edge_that_rebounds_as_a_whole_leave_at_e_times_their_approach) {
  constexpr double tolerance = 1e-12;
  constexpr int scenes = CLATTER_TEST_SLOW_BUILD ? 300 : 3000;
  Random random(5);
  int faces = 0, edges = 0;
  for (int i = 0; i < scenes; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.2, 3));
    const bool is_edge = i % 2 == 0;
    State before;
    before.attitude = Quaternion(Eigen::AngleAxisd(random.uniform(0, 6), Vector3::UnitZ()));
    if (is_edge) before.attitude = before.attitude * Eigen::AngleAxisd(random.uniform(0.1, 1.4), Vector3::UnitY());
    before.velocity = random.vector(1) - Vector3(0, 0, 1);
    before.angular_velocity = random.vector(1);
    auto touching = box.bottom;
    if (is_edge) touching = {box.bottom[1], box.bottom[2]};
    // Friction does not act on the normal motion of a face that it does not tilt.
    const ImpactLaw law =
        is_edge ? frictionless(random.uniform(0, 1)) : coulomb(random.uniform(0, 1), random.uniform(0, 2));
    const auto whole = rebound_as_a_whole(box.body, before, touching, law);
    if (!whole || whole->tilts) continue;
    bool all_approach = true;
    for (const Corner& corner : touching) {
      const Vector3 arm = before.attitude * corner.place;
      const double u = normal_velocity(before.velocity, before.angular_velocity, arm);
      all_approach = all_approach && u < 0;
      if (u < 0 && whole->order[0].size() == touching.size()) {
        const double after = normal_velocity(whole->velocity_after, whole->angular_velocity_after, arm);
        BOOST_CHECK_LE(std::fabs(after + law.restitution * u), tolerance * 4);
      }
    }
    if (all_approach) ++(is_edge ? edges : faces);
  }
  BOOST_CHECK_GT(faces, scenes / 15);
  BOOST_CHECK_GT(edges, scenes / 15);
}

BOOST_AUTO_TEST_CASE(three_corners_rebound_as_a_whole_exactly_where_their_three_impulses_all_push) {
  Random random(9);
  int whole_ones = 0, others = 0;
  for (int i = 0; i < 3000; ++i) {
    auto c = clatter::oracle::random_collision(random);
    const double depth = random.uniform(0.1, 1);
    std::vector<Vector3> feet;
    for (int k = 0; k < 3; ++k) feet.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), -depth);
    c.before.attitude = Quaternion::Identity();
    c.before.angular_velocity = random.vector(0.5);
    c.before.velocity = random.vector(1) - Vector3(0, 0, 2.2);  // every corner approaches
    const double e = random.uniform(0, 1);
    const Matrix3 inverse = c.body.inertia.inverse();
    Matrix3 g;
    Vector3 approach;
    for (int row = 0; row < 3; ++row) {
      const Vector3& r = feet[row];
      approach[row] = -normal_velocity(c.before.velocity, c.before.angular_velocity, r);
      for (int column = 0; column < 3; ++column) {
        const Vector3& other = feet[column];
        g(row, column) = 1 / c.body.mass + r.cross(Vector3::UnitZ()).dot(inverse * other.cross(Vector3::UnitZ()));
      }
    }
    const Vector3 pushes = (1 + e) * g.inverse() * approach;
    if (pushes.cwiseAbs().minCoeff() < 1e-9 * pushes.cwiseAbs().maxCoeff()) continue;
    const auto whole = rebound_as_a_whole(c.body, c.before, corners_of(feet), frictionless(e));
    BOOST_CHECK_EQUAL(whole.has_value(), pushes.minCoeff() > 0);
    if (whole) BOOST_CHECK_CLOSE_FRACTION(whole->impulse.z(), pushes.sum(), 1e-8);
    ++(whole ? whole_ones : others);
  }
  BOOST_CHECK_GT(whole_ones, 100);
  BOOST_CHECK_GT(others, 100);
}

BOOST_AUTO_TEST_CASE(corners_that_cannot_rebound_as_a_whole_strike_one_after_the_other_until_none_approaches) {
  Random random(6);
  int several = 0;
  for (int i = 0; i < 1000; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 4), random.uniform(0.2, 3));
    State before;
    before.velocity = random.vector(1) - Vector3(0, 0, 0.5);
    before.angular_velocity = random.vector(6);
    const ImpactLaw law = coulomb(random.uniform(0, 1), random.uniform(0, 1), RestitutionLaw::stronge);
    const GroupImpact impact = strike_together(box.body, before, box.bottom, law);
    const double scale = before.velocity.norm() + before.angular_velocity.norm() * 3;
    double fastest = 0;
    int first = -1;
    for (const Corner& corner : box.bottom) {
      BOOST_CHECK_GE(normal_velocity(impact.velocity_after, impact.angular_velocity_after, corner.place),
                     -1e-13 * scale);
      const double approach = -normal_velocity(before.velocity, before.angular_velocity, corner.place);
      if (approach > fastest) fastest = approach, first = corner.index;
    }
    if (!impact.is_whole && !impact.tilts && !impact.order.empty()) {
      BOOST_CHECK_EQUAL(impact.order[0][0], first);
      ++several;
    }
    BOOST_CHECK_CLOSE_FRACTION(impact.approach_speed, fastest, 1e-12);
    const Matrix3 axes = Matrix3::Identity();
    const double energy = kinetic_energy(box.body, axes, before.velocity, before.angular_velocity);
    const double after = kinetic_energy(box.body, axes, impact.velocity_after, impact.angular_velocity_after);
    BOOST_CHECK_LE(std::fabs(energy - after - impact.energy_loss), 1e-12 * energy);
    BOOST_CHECK_GE(impact.energy_loss, -1e-13 * energy);
  }
  BOOST_CHECK_GT(several, 100);
}

BOOST_AUTO_TEST_CASE(a_planar_flat_landing_with_friction_agrees_with_the_planar_model) {
  constexpr double tolerance = 1e-13;
  Random random(7);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.2, 3));
    const double gyration = (box.length * box.length + box.height * box.height) / 12;
    const PlanarBody body{.mass = box.body.mass, .gyration_square = gyration};
    const PlanarVelocity v{
        .normal = random.uniform(-2, -0.1), .tangential = random.uniform(-1, 1), .angular = random.uniform(-2, 2)};
    const ContactPoint left{-box.length / 2, -box.height / 2}, right{box.length / 2, -box.height / 2};
    ImpactLaw law = coulomb(random.uniform(0, 1), random.uniform(0, 1));
    if (i % 5 == 0) law.law = RestitutionLaw::viscoelastic, law.restitution = 1, law.damping_per_stiffness = 0.3;
    const auto planar = strike_flat(body, v, left, right, law);
    State before;
    before.velocity = {v.tangential, 0, v.normal};
    before.angular_velocity = {0, v.angular, 0};
    const auto whole = rebound_as_a_whole(box.body, before, box.bottom, law);
    if (!planar) continue;
    BOOST_REQUIRE(whole.has_value());
    ++compared;
    const double speed = std::fabs(v.normal) + std::fabs(v.tangential) + std::fabs(v.angular);
    BOOST_CHECK_LE(std::fabs(whole->impulse.x() - planar->tangential_impulse), tolerance * box.body.mass * speed);
    BOOST_CHECK_LE(std::fabs(whole->impulse.z() - planar->normal_impulse), tolerance * box.body.mass * speed);
    BOOST_CHECK_LE(std::fabs(whole->angular_velocity_after.y() - planar->after.angular), 10 * tolerance * speed);
    BOOST_CHECK_LE(std::fabs(whole->velocity_after.z() - planar->after.normal), tolerance * speed);
    BOOST_CHECK_LE(std::fabs(whole->velocity_after.x() - planar->after.tangential), tolerance * speed);
  }
  BOOST_CHECK_GT(compared, 500);
}

BOOST_AUTO_TEST_CASE(faces_and_edges_on_damped_ground_bounce_as_a_mass_at_their_pressure_centre_does) {
  constexpr double tolerance = 1e-9;  // integrated_restitution()
  Random random(9);
  int faces = 0, edges = 0;
  for (int i = 0; i < 400; ++i) {
    const FlatBox box(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.1, 0.4), random.uniform(0.2, 3));
    State before;
    before.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), -random.uniform(0.5, 1.5)};
    before.angular_velocity = random.vector(0.8);
    const bool is_edge = i % 2 == 0;
    if (is_edge) before.attitude = Eigen::AngleAxisd(random.uniform(0.2, 1), Vector3::UnitY());
    const std::vector<Corner> touching = is_edge ? std::vector{box.bottom[1], box.bottom[2]} : box.bottom;
    ImpactLaw law = frictionless(1);
    law.law = RestitutionLaw::viscoelastic;
    law.damping_per_stiffness = random.uniform(0.05, 1);
    const auto whole = rebound_as_a_whole(box.body, before, touching, law);
    if (!whole || whole->order.front().size() != touching.size()) continue;  // one corner alone approaches
    ++(is_edge ? edges : faces);
    // Without friction the impulses, all upwards, have their resultant at (−M_y, M_x)/P_z.
    const Vector3 centre(-whole->moment.y() / whole->impulse.z(), whole->moment.x() / whole->impulse.z(), 0);
    const double approach = -normal_velocity(before.velocity, before.angular_velocity, centre);
    const double e = clatter::oracle::integrated_restitution(law.damping_per_stiffness, approach);
    for (const Corner& corner : touching) {
      const Vector3 arm = before.attitude * corner.place;
      BOOST_TEST(std::fabs(normal_velocity(whole->velocity_after, whole->angular_velocity_after, arm) +
                           e * normal_velocity(before.velocity, before.angular_velocity, arm)) <= tolerance);
    }
  }
  BOOST_TEST(faces > 100);
  BOOST_TEST(edges > 100);
}

BOOST_AUTO_TEST_CASE(an_edge_that_lands_level_strikes_as_the_corner_of_the_planar_model) {
  constexpr double tolerance = 1e-13;
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.2, 3));
    State before;
    before.attitude = Eigen::AngleAxisd(random.uniform(0.05, 1.5), Vector3::UnitY());
    const PlanarVelocity v{
        .normal = random.uniform(-2, -1), .tangential = random.uniform(-1, 1), .angular = random.uniform(-0.5, 0.5)};
    before.velocity = {v.tangential, 0, v.normal};
    before.angular_velocity = {0, v.angular, 0};
    const ImpactLaw law =
        coulomb(random.uniform(0, 1), random.uniform(0, 2), static_cast<RestitutionLaw>(random.whole(0, 2)));
    const Vector3 arm = before.attitude * box.bottom[1].place;
    const double gyration = (box.length * box.length + box.height * box.height) / 12;
    const auto planar = strike({.mass = box.body.mass, .gyration_square = gyration}, v, {arm.x(), arm.z()}, law);
    const auto whole = rebound_as_a_whole(box.body, before, std::vector{box.bottom[1], box.bottom[2]}, law);
    BOOST_REQUIRE(whole.has_value());
    const double size = std::hypot(planar.normal_impulse, planar.tangential_impulse);
    BOOST_CHECK_LE((whole->impulse - Vector3(planar.tangential_impulse, 0, planar.normal_impulse)).norm(),
                   tolerance * size * 3);
    BOOST_CHECK_LE(std::fabs(whole->angular_velocity_after.x()) + std::fabs(whole->angular_velocity_after.z()), 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(touching_corners_of_which_none_approaches_get_no_impulse) {
  const FlatBox box(1, 1, 1, 1);
  State before;
  before.velocity = {0.3, 0, 0.1};
  BOOST_CHECK(!rebound_as_a_whole(box.body, before, box.bottom, frictionless(1)));
  const GroupImpact impact = strike_together(box.body, before, box.bottom, frictionless(1));
  BOOST_CHECK(impact.order.empty());
  BOOST_CHECK_EQUAL(impact.impulse.norm(), 0);
  BOOST_CHECK(impact.velocity_after == before.velocity);
}

/// A box with any centre of mass that turns about the lower edge at x > 0, which slides and spins on the ground, while
/// the other lower edge comes down.
struct BoxBesideEdge {
  FlatBox box;
  State before;

  explicit BoxBesideEdge(Random& random)
      : box(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 3)) {
    const Vector3 centre = random.vector(0.08).cwiseProduct(Vector3(box.length, box.width, box.height));
    for (Corner& corner : box.bottom) corner.place -= centre;
    before.angular_velocity = {0, -random.uniform(0.5, 5), random.uniform(-5, 5)};
    before.velocity = random.vector(2);
    before.velocity.z() = 0;
    before.velocity.z() = -normal_velocity(before.velocity, before.angular_velocity, box.bottom[1].place);
  }
};

BOOST_AUTO_TEST_CASE(edges_of_a_face_that_strike_in_turn_go_on_as_edges_until_rounding_is_left_of_them) {
  constexpr double kick = 1e-12, tolerance = 1e-9;
  Random random(6);
  int in_turn = 0;
  for (int i = 0; i < 60; ++i) {
    const BoxBesideEdge scene(random);
    const ImpactLaw law = coulomb(0, random.uniform(0.05, 1));
    const auto landed = [&](const Vector3& kicked) {
      State before = scene.before;
      before.velocity += kicked;
      return strike_together(scene.box.body, before, scene.box.bottom, law);
    };
    const GroupImpact impact = landed(Vector3::Zero());
    in_turn += impact.order.size() > 4;
    for (const Vector3& direction : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-0.6, 0.8, 0)}) {
      BOOST_TEST_CONTEXT("box " << i) {
        BOOST_CHECK_LE((landed(kick * direction).impulse - impact.impulse).norm(), tolerance * impact.impulse.norm());
      }
    }
    if (std::ranges::any_of(impact.order, [](const auto& strike) { return strike.size() != 2; })) continue;
    for (const Corner& corner : scene.box.bottom) {
      BOOST_CHECK_GE(normal_velocity(impact.velocity_after, impact.angular_velocity_after, corner.place), -1e-12);
    }
  }
  BOOST_TEST(in_turn > 5);
}

BOOST_AUTO_TEST_CASE(a_face_that_lands_gains_no_energy_but_by_newtons_law_and_is_newtons_where_that_gains_none) {
  constexpr double tolerance = 1e-11;
  Random random(9);
  int limited = 0, whole = 0;
  for (int i = 0; i < 200; ++i) {
    const FlatBox box(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1), 1);
    State before;
    before.velocity = random.vector(0.5);
    before.velocity.z() = -1;
    before.angular_velocity =
        Vector3(random.uniform(-1, 1) / box.width, random.uniform(-1, 1) / box.length, random.uniform(-3, 3));
    const double e = random.uniform(0.97, 1), friction = random.uniform(0.5, 2);
    const auto landed = [&](RestitutionLaw by) {
      return rebound_as_a_whole(box.body, before, box.bottom, coulomb(e, friction, by));
    };
    const auto energy = [&](const Vector3& v, const Vector3& w) {
      return kinetic_energy(box.body, Matrix3::Identity(), v, w);
    };
    const auto newton = landed(RestitutionLaw::newton), stronge = landed(RestitutionLaw::stronge);
    if (!newton || !stronge) continue;
    const double at_first = energy(before.velocity, before.angular_velocity);
    const double gain = energy(stronge->velocity_after, stronge->angular_velocity_after) - at_first;
    const double newtons = energy(newton->velocity_after, newton->angular_velocity_after) - at_first;
    BOOST_CHECK_LE(gain, tolerance * at_first);
    if (newtons > tolerance * at_first) {
      BOOST_CHECK_GE(gain, -std::fmax(tolerance, stronge->path_error) * at_first);
      ++limited;
    } else {
      BOOST_CHECK_LE((stronge->velocity_after - newton->velocity_after).norm(), tolerance);
      ++whole;
    }
  }
  BOOST_TEST(limited > 5);
  BOOST_TEST(whole > 50);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_face_that_slips_to_its_stop_against_much_friction_rebounds_as_a_whole) {
  const FlatBox box(0.545944, 0.455393, 0.424524, 19.3784);
  State before;
  before.attitude = Quaternion(0.1566730109646018, 0, 0, 0.9876505291019115).normalized();
  before.velocity = {0.7704, 0, -1.011};
  before.angular_velocity = {0, 0, 0.1893};
  const ImpactLaw law = clatter::oracle::coulomb(0.523, 1.38, RestitutionLaw::poisson);
  const GroupImpact stopped = strike_together(box.body, before, box.bottom, law);
  BOOST_TEST(stopped.is_whole);
  BOOST_TEST((stopped.velocity_after - Vector3(0, 0, 0.523 * 1.011)).norm() <= 1e-12);
  BOOST_TEST(stopped.angular_velocity_after.norm() <= 1e-12);
}
