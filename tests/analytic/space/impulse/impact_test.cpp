// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impact.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"
#include "analytic/law/impact_law.hpp"
#include "analytic/plane/impact.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::Collision;
using clatter::oracle::Random;
using space::Impact;

double kinetic_energy(const Body& body, const Quaternion& attitude, const Vector3& v, const Vector3& spin) {
  const Vector3 own = attitude.conjugate() * spin;
  return (body.mass * v.squaredNorm() + own.dot(body.inertia * own)) / 2;
}

/// Size of the velocities of a collision [m/s].
double speed_of(const Collision& c) {
  return c.before.velocity.norm() + c.before.angular_velocity.norm() * c.place.norm();
}

Collision turned(Collision c, const Quaternion& turn) {
  c.before.attitude = turn * c.before.attitude;
  c.before.velocity = turn * c.before.velocity;
  c.before.angular_velocity = turn * c.before.angular_velocity;
  return c;
}

Impact strike(const Collision& c, const ImpactLaw& law) { return space::strike(c.body, c.before, c.place, law); }

BOOST_AUTO_TEST_CASE(friction_stays_within_coulombs_cone_and_stronges_law_creates_no_energy) {
  constexpr double tolerance = 1e-13;
  Random random(21);
  for (int i = 0; i < 4000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    const ImpactLaw law = clatter::oracle::random_law(random, 3);
    const Impact impact = strike(c, law);
    BOOST_CHECK_LE(impact.impulse.head<2>().norm(), law.friction_value * impact.impulse.z() * (1 + tolerance));
    if (law.law == RestitutionLaw::newton || law.law == RestitutionLaw::poisson) continue;
    const double before = kinetic_energy(c.body, c.before.attitude, c.before.velocity, c.before.angular_velocity);
    const double after =
        kinetic_energy(c.body, c.before.attitude, impact.velocity_after, impact.angular_velocity_after);
    BOOST_CHECK_LE(after - before, tolerance * before);
    BOOST_CHECK_GE(impact.energy_loss, -tolerance * before);
  }
}

BOOST_AUTO_TEST_CASE(the_work_of_the_impulse_is_the_change_of_energy_and_momentum_about_the_corner_is_kept) {
  Random random(22);
  for (int i = 0; i < 4000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    const Impact impact = strike(c, clatter::oracle::random_law(random, 3));
    const Matrix3 axes = c.before.attitude.toRotationMatrix();
    const Vector3 arm = axes * c.place;
    const double before = kinetic_energy(c.body, c.before.attitude, c.before.velocity, c.before.angular_velocity);
    const double after =
        kinetic_energy(c.body, c.before.attitude, impact.velocity_after, impact.angular_velocity_after);
    const double work = impact.impulse.dot(impact.contact_before + impact.contact_after) / 2;
    BOOST_CHECK_LE(std::fabs(after - before - work), 1e-12 * (before + after));
    BOOST_CHECK_LE(std::fabs(work + impact.energy_loss), 1e-13 * before);
    const Matrix3 inertia = axes * c.body.inertia * axes.transpose();
    const Vector3 gained = inertia * (impact.angular_velocity_after - c.before.angular_velocity) -
                           arm.cross(c.body.mass * (impact.velocity_after - c.before.velocity));
    BOOST_CHECK_LE(gained.norm(), 1e-13 * c.body.mass * c.place.norm() * speed_of(c) * 10);
    // The velocity of the corner as reported is that of the body.
    const Vector3 corner = impact.velocity_after + impact.angular_velocity_after.cross(arm);
    BOOST_CHECK_LE((corner - impact.contact_after).norm(), 1e-12 * speed_of(c));
  }
}

BOOST_AUTO_TEST_CASE(turning_a_scene_about_the_vertical_turns_its_impulse) {
  constexpr double tolerance = 1e-13;
  Random random(23);
  for (int i = 0; i < 2000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    const ImpactLaw law = clatter::oracle::random_law(random, 3);
    const Quaternion turn(Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitZ()));
    const Impact impact = strike(c, law), other = strike(turned(c, turn), law);
    // A path whose slip nearly stops, or that leaves an invariant direction, amplifies the rounding of the scene.
    const Contact contact = clatter::oracle::contact_of(c);
    Contact nudged = contact;
    nudged.velocity += 1e-10 * contact.velocity_scale * Vector3(0.6, -0.8, 0);
    const double sensitivity =
        (contact_impulse(nudged, law).impulse - contact_impulse(contact, law).impulse).norm() / 1e-10;
    const double allowed = tolerance * impact.impulse.norm() + 2e-15 * sensitivity;
    BOOST_CHECK_LE((turn * impact.impulse - other.impulse).norm(), allowed);
    BOOST_CHECK(impact.path == other.path || impact.is_path_ambiguous);
  }
}

BOOST_AUTO_TEST_CASE(a_mirrored_scene_gets_the_mirrored_impulse) {
  constexpr double tolerance = 1e-13;
  Random random(24);
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  for (int i = 0; i < 2000; ++i) {
    const Contact contact = clatter::oracle::contact_of(clatter::oracle::random_collision(random));
    const ImpactLaw law = clatter::oracle::random_law(random, 3);
    Contact mirrored = contact;
    mirrored.inverse_inertia = mirror * contact.inverse_inertia * mirror;
    mirrored.velocity = mirror * contact.velocity;
    const Vector3 impulse = contact_impulse(contact, law).impulse;
    BOOST_CHECK_LE((mirror * impulse - contact_impulse(mirrored, law).impulse).norm(), tolerance * impulse.norm());
  }
}

BOOST_AUTO_TEST_CASE(units_that_differ_by_powers_of_two_change_no_bit_of_an_impact) {
  Random random(25);
  for (int i = 0; i < 2000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    ImpactLaw law = clatter::oracle::random_law(random, 3);
    const double length = std::ldexp(1, random.whole(-20, 20)), time = std::ldexp(1, random.whole(-20, 20)),
                 mass = std::ldexp(1, random.whole(-20, 20)), speed = length / time;
    Collision scaled = c;
    scaled.body.mass *= mass, scaled.body.inertia *= mass * length * length, scaled.place *= length;
    scaled.before.velocity *= speed, scaled.before.angular_velocity /= time;
    const Impact impact = strike(c, law);
    law.damping_per_stiffness /= speed;
    const Impact other = strike(scaled, law);
    BOOST_CHECK(other.impulse == mass * speed * impact.impulse);
    BOOST_CHECK(other.velocity_after == speed * impact.velocity_after);
    BOOST_CHECK(other.angular_velocity_after == impact.angular_velocity_after / time);
    BOOST_CHECK(other.contact_after == speed * impact.contact_after);
    BOOST_CHECK_EQUAL(other.energy_loss, mass * speed * speed * impact.energy_loss);
    BOOST_CHECK(other.path == impact.path);
  }
}

BOOST_AUTO_TEST_CASE(a_drop_that_stays_in_its_plane_agrees_with_the_planar_model) {
  constexpr double tolerance = 1e-13;
  Random random(26);
  for (int i = 0; i < 10000; ++i) {
    Collision c = clatter::oracle::random_collision(random);
    const double gyration = random.uniform(0.01, 1);
    c.body.inertia = (c.body.mass * gyration * Vector3(random.uniform(0.5, 1), 1, random.uniform(0.5, 1))).asDiagonal();
    c.place = {random.uniform(-1, 1), 0, random.uniform(-1, -0.01)};
    c.before.attitude = Quaternion::Identity();
    const ContactPoint d{c.place.x(), c.place.z()};
    PlanarVelocity v;
    do v = {.normal = random.uniform(-2, 0.5), .tangential = random.uniform(-2, 2), .angular = random.uniform(-3, 3)};
    while (!(normal_velocity(v, d) < -0.01));
    if (i % 10 == 0) v.tangential = v.angular = 0, v.normal -= 0.5;  // no slip before
    c.before.velocity = {v.tangential, 0, v.normal};
    c.before.angular_velocity = {0, v.angular, 0};
    ImpactLaw law = clatter::oracle::random_law(random, 2);
    if (i % 11 == 0) law.friction = FrictionKind::none, law.friction_value = 0;
    const clatter::analytic::Impact planar =
        clatter::analytic::strike({.mass = c.body.mass, .gyration_square = gyration}, v, d, law);
    const double heading = random.uniform(-3, 3);
    const Quaternion turn(Eigen::AngleAxisd(i % 2 == 0 ? 0 : heading, Vector3::UnitZ()));
    const Impact impact = strike(turned(c, turn), law);
    const Vector3 expected = turn * Vector3(planar.tangential_impulse, 0, planar.normal_impulse);
    const Vector3 after = turn * Vector3(planar.after.tangential, 0, planar.after.normal);
    // A stick slope 1/(W⁻¹)_nn small beside W_nn amplifies the rounding of W.
    const ContactInertia inertia = contact_inertia(gyration, d);
    const double condition = inertia.normal * inertia.tangential /
                             (inertia.normal * inertia.tangential - inertia.coupling * inertia.coupling);
    const double allowed = tolerance * (1 + condition / 10);
    BOOST_CHECK_LE((impact.impulse - expected).norm(), allowed * expected.norm());
    BOOST_CHECK_LE((impact.velocity_after - after).norm(), allowed * speed_of(c));
    BOOST_CHECK_LE((impact.angular_velocity_after - Vector3(turn * Vector3(0, planar.after.angular, 0))).norm(),
                   allowed * (c.before.angular_velocity.norm() + impact.impulse.norm() * 1.5 / c.body.mass / gyration));
    const bool reverses = planar.mode == ImpactMode::reverse_slip;
    if (!impact.is_path_ambiguous) {
      BOOST_CHECK_EQUAL(reverses, impact.path == PathKind::slip_reslip);
      BOOST_CHECK_EQUAL(planar.mode == ImpactMode::slip, impact.path == PathKind::slip);
      BOOST_CHECK_EQUAL(planar.mode == ImpactMode::slip_stick, impact.path == PathKind::slip_stick);
      BOOST_CHECK_EQUAL(planar.mode == ImpactMode::stick, impact.path == PathKind::stick);
    }
  }
}

BOOST_AUTO_TEST_CASE(slip_of_a_cube_with_its_centre_above_the_corner_is_straight_and_stops_as_in_closed_form) {
  constexpr double tolerance = 1e-13;
  const double mass = 0.35, side = 0.1, inertia = mass * side * side / 6, distance = side * std::sqrt(3) / 2;
  const double a = 1 / mass + distance * distance / inertia;
  const Body cube{.mass = mass, .inertia = inertia * Matrix3::Identity(), .vertices = {}, .rims = {}};
  const Vector3 place = Vector3::Constant(-side / 2);
  Random random(27);
  for (int i = 0; i < 1000; ++i) {
    State before;
    before.attitude = Quaternion(Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitZ())) *
                      Quaternion::FromTwoVectors(place, -Vector3::UnitZ());
    before.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-2, -0.1)};
    ImpactLaw law = clatter::oracle::random_law(random, 0.5);
    law.law = static_cast<RestitutionLaw>(i % 3), law.restitution = random.uniform(0, 1);
    law.damping_per_stiffness = 0;
    const Impact impact = space::strike(cube, before, place, law);
    const double normal = (1 + law.restitution) * mass * -before.velocity.z();
    const Vector2 slip = before.velocity.head<2>();
    const bool stops = slip.norm() < law.friction_value * normal * a;
    const double friction = stops ? slip.norm() / a : law.friction_value * normal;
    BOOST_CHECK_CLOSE_FRACTION(impact.impulse.z(), normal, tolerance);
    BOOST_CHECK_LE((impact.impulse.head<2>() + friction * slip.normalized()).norm(), tolerance * normal);
    BOOST_CHECK(impact.path == (stops ? PathKind::slip_stick : PathKind::slip));
    if (stops) BOOST_CHECK_CLOSE_FRACTION(impact.slip_stop_impulse, slip.norm() / a / law.friction_value, tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_frictionless_impulse_is_one_plus_e_times_approach_over_the_normal_inverse_inertia) {
  Random random(28);
  for (int i = 0; i < 1000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    ImpactLaw law;
    law.restitution = random.uniform(0, 1);
    const Impact impact = strike(c, law);
    const Vector3 arm = c.before.attitude * c.place;
    const Vector3 bent = c.before.attitude.conjugate() * arm.cross(Vector3::UnitZ());
    const double inverse = 1 / c.body.mass + bent.dot(c.body.inertia.inverse() * bent);
    BOOST_CHECK_CLOSE_FRACTION(impact.impulse.z(), -(1 + law.restitution) * impact.contact_before.z() / inverse, 1e-13);
    BOOST_CHECK_EQUAL(impact.impulse.head<2>().norm(), 0);
    BOOST_CHECK_CLOSE_FRACTION(impact.restitution(), law.restitution, 1e-14);
    BOOST_CHECK(impact.path == PathKind::frictionless);
  }
}

BOOST_AUTO_TEST_CASE(an_impulse_ratio_acts_in_its_direction_and_jamming_is_refused_by_name) {
  Random random(29);
  int jams = 0;
  for (int i = 0; i < 2000; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    ImpactLaw law;
    law = {.restitution = random.uniform(0, 1),
           .friction = FrictionKind::impulse_ratio,
           .friction_value = random.uniform(-3, 3)};
    const double angle = random.uniform(-3, 3);
    law.ratio_direction = {std::cos(angle), std::sin(angle)};
    const Contact contact = clatter::oracle::contact_of(c);
    const Vector3 along(law.friction_value * law.ratio_direction.x(), law.friction_value * law.ratio_direction.y(), 1);
    const double rate = contact.inverse_inertia.row(2).dot(along);
    if (rate <= 0) {
      ++jams;
      BOOST_CHECK_EXCEPTION(strike(c, law), OutsideModelError, [](const OutsideModelError& error) {
        return std::string(error.what()).find("jamming") != std::string::npos;
      });
      continue;
    }
    const Vector3 expected = -(1 + law.restitution) * contact.velocity.z() / rate * along;
    // Near jamming the terms of `rate` cancel, and W's rounding grows by this.
    const double condition = contact.inverse_inertia.norm() * along.norm() / rate;
    BOOST_CHECK_LE((strike(c, law).impulse - expected).norm(), 1e-14 * condition * expected.norm());
  }
  BOOST_CHECK_GT(jams, 20);
}

BOOST_AUTO_TEST_CASE(a_corner_that_digs_in_while_its_slip_slows_has_a_bounded_impulse) {
  // The reference's kind: k = c − μ b·s < 0 at the start.
  Random random(30);
  int digs = 0;
  for (int i = 0; i < 20000 && digs < 100; ++i) {
    const Contact contact = clatter::oracle::contact_of(clatter::oracle::random_collision(random));
    ImpactLaw law = clatter::oracle::random_law(random, 3);
    const Matrix3& w = contact.inverse_inertia;
    const Vector2 s = contact.velocity.head<2>().normalized();
    if (w(2, 2) - law.friction_value * w.block<2, 1>(0, 2).dot(s) >= 0) continue;
    ++digs;
    const ContactImpulse impact = contact_impulse(contact, law);
    // More than what would end the approach of an unhindered corner, and no corner that goes on approaching.
    BOOST_CHECK_GT(impact.compression_impulse, -contact.velocity.z() / w(2, 2));
    BOOST_CHECK(impact.impulse.allFinite());
    BOOST_CHECK_GE(impact.velocity_after.z(), 0);
  }
  BOOST_CHECK_EQUAL(digs, 100);
}

BOOST_AUTO_TEST_CASE(poissons_impulse_goes_on_where_a_second_compression_would_leave_the_corner_approaching) {
  Random random(32);
  int second = 0;
  for (int i = 0; i < (CLATTER_TEST_SLOW_BUILD ? 6000 : 60000); ++i) {
    const Contact contact = clatter::oracle::contact_of(clatter::oracle::random_collision(random));
    ImpactLaw law = clatter::oracle::random_law(random, 3);
    law.law = RestitutionLaw::poisson, law.restitution = random.uniform(0, 1);
    law.damping_per_stiffness = 0;
    law.friction_value += 1;
    const ContactImpulse impact = contact_impulse(contact, law);
    BOOST_CHECK_GE(impact.velocity_after.z(), 0);
    const double impulse = (1 + law.restitution) * impact.compression_impulse;
    if (impact.impulse.z() <= impulse * (1 + 1e-9)) {
      BOOST_CHECK_CLOSE_FRACTION(impact.impulse.z(), impulse, 1e-13);
    } else {
      ++second;
      BOOST_CHECK_EQUAL(impact.velocity_after.z(), 0);
    }
  }
  BOOST_TEST_MESSAGE(second << " second compressions");
  BOOST_CHECK_GT(second, 0);
}

BOOST_AUTO_TEST_CASE(invariant_directions_are_all_the_directions_in_which_slip_does_not_turn) {
  Random random(31);
  for (int i = 0; i < (CLATTER_TEST_SLOW_BUILD ? 50 : 1000); ++i) {
    const Contact contact = clatter::oracle::contact_of(clatter::oracle::random_collision(random));
    const double friction = random.uniform(0, 3);
    const Matrix3& w = contact.inverse_inertia;
    const auto rates = [&](double angle) {
      const Vector2 s(std::cos(angle), std::sin(angle)), across(-s.y(), s.x());
      const Vector2 pull = w.block<2, 1>(0, 2) - friction * w.topLeftCorner<2, 2>() * s;
      return Vector2(pull.dot(s), pull.dot(across));
    };
    int zeros = 0;
    constexpr int samples = 20000;
    for (int k = 0; k < samples; ++k) {
      const double from = rates(6.283185307179586 * k / samples)[1];
      zeros += (from < 0) != (rates(6.283185307179586 * (k + 1) / samples)[1] < 0);
    }
    const InvariantDirections all = invariant_directions(w, friction);
    // A pair of zeros that nearly coincide can lie between two samples.
    BOOST_CHECK(zeros == all.count || std::fabs(SlipField(w, friction).astroid_excess()) < 1e-4);
    for (int k = 0; k < all.count; ++k) {
      const auto& invariant = all.list[k];
      const double angle = std::atan2(invariant.direction.y(), invariant.direction.x());
      const Vector2 rate = rates(angle);
      BOOST_CHECK_LE(std::fabs(rate[1]), 1e-13 * w.norm() * (1 + friction));
      BOOST_CHECK_LE(std::fabs(rate[0] - invariant.slip_rate), 1e-13 * w.norm() * (1 + friction));
      BOOST_CHECK_EQUAL(rates(angle + 1e-6)[1] < 0, invariant.attracts);
      const double normal = w(2, 2) - friction * w.block<2, 1>(0, 2).dot(invariant.direction);
      BOOST_CHECK_LE(std::fabs(normal - invariant.normal_rate), 1e-13 * w.norm() * (1 + friction));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_corner_that_separates_gets_no_impulse_and_bad_input_is_refused_by_name) {
  const Body body{.mass = 1, .inertia = Matrix3::Identity(), .vertices = {}, .rims = {}};
  State before;
  before.velocity = {0.2, 0, 0.1};
  const Impact none = space::strike(body, before, {0, 0, -1}, {});
  BOOST_CHECK_EQUAL(none.impulse.norm(), 0);
  BOOST_CHECK(none.velocity_after == before.velocity);
  BOOST_CHECK_EQUAL(none.restitution(), 0);
  ImpactLaw law;
  law.ratio_direction = {1, 1};
  const auto names_direction = [](const std::domain_error& e) {
    return std::string(e.what()).find("direction") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(static_cast<void>(space::strike(body, before, {0, 0, -1}, law)), std::domain_error,
                        names_direction);
  before.velocity.z() = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(static_cast<void>(space::strike(body, before, {0, 0, -1}, {})), NumericalError);
}

}  // namespace
