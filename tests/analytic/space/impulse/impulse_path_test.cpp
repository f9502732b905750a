// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impulse_path.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "analytic/law/coulomb_path.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "tests/support.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::contact_of;
using clatter::oracle::Random;
using clatter::oracle::random_collision;
using clatter::oracle::random_law;

constexpr int random_corners = CLATTER_TEST_SLOW_BUILD ? 300 : 10000;

BOOST_AUTO_TEST_CASE(random_corners_with_friction_and_any_law_agree_with_stepping_in_long_double) {
  constexpr double tolerance = 1e-11;
  Random random(11);
  int unlike = 0;
  double worst = 0;
  for (int i = 0; i < random_corners; ++i) {
    const Contact contact = contact_of(random_collision(random));
    const ImpactLaw law = random_law(random, 3);
    const ContactImpulse impact = contact_impulse(contact, law);
    const clatter::oracle::SteppedImpact<long double> stepped(contact, law);
    const double of_impulse =
        (impact.impulse - stepped.impulse().cast<double>()).norm() / stepped.impulse().cast<double>().norm();
    const double of_velocity =
        (impact.velocity_after - stepped.velocity().cast<double>()).norm() / contact.velocity.norm();
    worst = std::fmax(worst, std::fmax(of_impulse, of_velocity));
    if (impact.is_path_ambiguous) continue;
    unlike += std::isnan(impact.slip_stop_impulse) == stepped.slip_stopped();
    BOOST_TEST_CONTEXT("corner " << i << " law " << static_cast<int>(law.law) << " friction " << law.friction_value) {
      BOOST_CHECK_LE(of_impulse, tolerance);
      BOOST_CHECK_LE(of_velocity, tolerance);
    }
  }
  BOOST_CHECK_EQUAL(unlike, 0);
  BOOST_TEST_MESSAGE("largest relative error " << worst);
}

/// Newton's impulse of slip that begins at rest: −μ s P_n along the ground, s = (μA + f)⁻¹ b with the f > 0 that makes
/// it a unit vector, by halving.  Nothing where friction can hold the corner.
std::optional<Vector3> impulse_from_rest(const Contact& contact, double friction, double restitution) {
  const Matrix2 a = contact.inverse_inertia.topLeftCorner<2, 2>();
  const Vector2 b = contact.inverse_inertia.block<2, 1>(0, 2);
  const auto direction = [&](double f) -> Vector2 { return (friction * a + f * Matrix2::Identity()).inverse() * b; };
  if (!(direction(0).norm() > 1)) return {};
  double low = 0, high = b.norm();
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (direction(middle).norm() > 1 ? low : high) = middle;
  }
  const Vector2 s = direction(low);
  const double normal =
      -(1 + restitution) * contact.velocity.z() / (contact.inverse_inertia(2, 2) - friction * b.dot(s));
  return Vector3(-friction * s.x() * normal, -friction * s.y() * normal, normal);
}

BOOST_AUTO_TEST_CASE(slip_of_roundings_size_in_any_direction_grows_as_slip_that_begins_at_rest) {
  constexpr double tolerance = 1e-11;  // what a slip of 1e-14 does
  constexpr int contacts = 100, directions = 36;
  Random random(12);
  int slipping = 0;
  for (int i = 0; i < contacts; ++i) {
    Contact contact = contact_of(random_collision(random));
    ImpactLaw law = random_law(random, 1);
    law.law = RestitutionLaw::newton;
    law.restitution = random.uniform(0, 1);
    const auto wanted = impulse_from_rest(contact, law.friction_value, law.restitution);
    if (!wanted) continue;
    const double outwards = std::atan2(-wanted->y(), -wanted->x());
    for (const double part : {1e-17, 1e-16, 1e-15, 1e-14}) {
      for (int k = 0; k < directions; ++k) {
        const double angle = outwards + std::pow(k / (directions / 2.0) - 1, 3) * std::acos(-1.0);
        const double slip = part * contact.velocity_scale;
        contact.velocity.head<2>() << slip * std::cos(angle), slip * std::sin(angle);
        const ContactImpulse impact = contact_impulse(contact, law);
        BOOST_TEST_CONTEXT("contact " << i << " slip " << part << " angle from outwards " << angle - outwards) {
          BOOST_CHECK_LE((impact.impulse - *wanted).norm(), tolerance * wanted->norm());
        }
      }
    }
    ++slipping;
  }
  BOOST_TEST(slipping > contacts / 10);
}

// Friction judged by the slip after the impact: what its definition asks for is checked on random corners.

ImpactLaw moreau(double friction, double restitution) {
  return {.restitution = restitution, .friction = FrictionKind::moreau, .friction_value = friction};
}

/// By how much the definition is missed, over the approach speed and over the impulse.
double miss(const Contact& contact, const ImpactLaw& law, const ContactImpulse& found) {
  const Vector3 after = contact.velocity + contact.inverse_inertia * found.impulse;
  const double speed = contact.velocity.norm() + (contact.inverse_inertia * found.impulse).norm();
  const Vector2 slip = after.head<2>(), friction = found.impulse.head<2>();
  const double most = law.friction_value * found.impulse.z();
  const bool sticks = found.path == PathKind::stick || found.path == PathKind::slip_stick;
  const double of_friction = sticks ? slip.norm() / speed : (friction + most * slip.normalized()).norm() / most;
  return std::fmax(std::fmax(std::fabs(after.z() + law.restitution * contact.velocity.z()) / speed,
                             (found.velocity_after - after).norm() / speed),
                   std::fmax(of_friction, friction.norm() / most - 1));
}

/// Directions of slip that satisfy the definition, by a scan.
int solutions(const Contact& contact, const ImpactLaw& law) {
  constexpr int parts = 7200;
  const Matrix3& w = contact.inverse_inertia;
  const auto across = [&](double angle, double& along) {
    const Vector3 s(std::cos(angle), std::sin(angle), 0);
    const Vector3 rate = w * (Vector3::UnitZ() - law.friction_value * s);
    const Vector3 after = contact.velocity - (1 + law.restitution) * contact.velocity.z() / rate.z() * rate;
    along = rate.z() > 0 ? s.dot(after) : -1;
    return s.x() * after.y() - s.y() * after.x();
  };
  int count = 0;
  for (int i = 0; i < parts; ++i) {
    double along = 0, next = 0;
    const double low = across(2 * std::numbers::pi * i / parts, along),
                 high = across(2 * std::numbers::pi * (i + 1) / parts, next);
    count += (low > 0) != (high > 0) && along > 0 && next > 0;
  }
  return count;
}

BOOST_AUTO_TEST_CASE(random_corners_end_as_the_law_asks) {
  constexpr int corners = CLATTER_TEST_SLOW_BUILD ? 300 : 20'000;
  Random random(5);
  double worst = 0;
  int stuck = 0, several = 0;
  for (int i = 0; i < corners; ++i) {
    const Contact contact = contact_of(random_collision(random));
    const ImpactLaw law = moreau(std::exp(random.uniform(-4, 1.5)), random.uniform(0, 1));
    const ContactImpulse found = contact_impulse(contact, law);
    const double off = miss(contact, law, found);
    worst = std::fmax(worst, off);
    BOOST_TEST_CONTEXT("corner " << i << " friction " << law.friction_value) BOOST_CHECK_LE(off, 1e-9);
    stuck += found.velocity_after.head<2>().isZero(0);
    several += found.is_path_ambiguous;
    if (i % 20 != 0) continue;
    const bool sticks = found.velocity_after.head<2>().isZero(0);
    BOOST_CHECK_EQUAL(solutions(contact, law) > 1 && !sticks, found.is_path_ambiguous);
  }
  BOOST_TEST_MESSAGE("largest miss " << worst << ", stuck " << stuck << ", ambiguous " << several);
  BOOST_CHECK_GT(stuck, corners / 20);
}

BOOST_AUTO_TEST_CASE(slopes_are_those_of_differences) {
  Random random(6);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Contact contact = contact_of(random_collision(random));
    const ImpactLaw law = moreau(random.uniform(0.05, 0.6), random.uniform(0, 1));
    ImpulseSlopes slopes;
    Matrix3 turned = Matrix3::Zero();
    turned(0, 2) = turned(2, 0) = 0.3;
    turned(1, 1) = turned(0, 1) = turned(1, 0) = -0.2;
    slopes.turns = {contact.inverse_inertia.norm() * turned, Matrix3::Zero(), Matrix3::Zero()};
    const ContactImpulse found = contact_impulse(contact, law, &slopes);
    if (found.is_path_ambiguous) continue;
    const double size = found.impulse.norm() / contact.velocity.norm(), step = 1e-6;
    const auto changed = [&](auto&& by) {
      Contact one = contact, other = contact;
      by(one, step), by(other, -step);
      const ContactImpulse a = contact_impulse(one, law), b = contact_impulse(other, law);
      const bool alike = a.path == b.path;
      return alike ? Vector3((a.impulse - b.impulse) / (2 * step)) : Vector3::Constant(std::nan(""));
    };
    for (int k = 0; k < 3; ++k) {
      const Vector3 change = changed([&](Contact& c, double by) { c.velocity[k] += by * contact.velocity.norm(); }) /
                             contact.velocity.norm();
      if (!change.allFinite()) continue;
      ++compared;
      BOOST_CHECK_LE((change - slopes.of_velocity.col(k)).norm(), 1e-5 * size * (1 + slopes.of_velocity.norm() / size));
    }
    const Vector3 of_turn = changed([&](Contact& c, double by) { c.inverse_inertia += by * slopes.turns[0]; });
    if (of_turn.allFinite())
      BOOST_CHECK_LE((of_turn - slopes.of_turns.col(0)).norm(), 1e-5 * (found.impulse.norm() + of_turn.norm()));
  }
  BOOST_CHECK_GT(compared, 400);
}

/// The plane's closed form, and that of space for a contact that is its own mirror image: P_y is exactly zero.
BOOST_AUTO_TEST_CASE(the_plane_and_space_agree) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const double arm = random.uniform(-2, 2), height = random.uniform(0.05, 1);
    const PathCoefficients<> path{.normal = 1 + arm * arm,
                                  .normal_coupling = -arm * height,
                                  .slip_drift = -arm * height,
                                  .tangential = 1 + height * height};
    const double e = random.uniform(0, 1), slip = i % 10 == 0 ? 0 : random.uniform(-2, 2);
    const ImpactLaw law = moreau(random.uniform(0, 3), e);
    const PathEnd<> plane = point_impulse(path, PathStart<>{.approach_speed = 1, .slip = slip, .restitution = e}, law);
    Contact contact{.velocity = {slip, 0, -1}, .velocity_scale = 1};
    contact.inverse_inertia << path.tangential, 0, -path.slip_drift, 0, 1, 0, -path.slip_drift, 0, path.normal;
    const ContactImpulse space = contact_impulse(contact, law);
    const double size = space.impulse.norm();
    BOOST_CHECK_EQUAL(space.impulse.y(), 0);
    BOOST_CHECK_SMALL(plane.normal_impulse - space.impulse.z(), 1e-12 * size);
    BOOST_CHECK_SMALL(plane.tangential_impulse - space.impulse.x(), 1e-12 * size);
    BOOST_CHECK((plane.mode == ImpactMode::stick || plane.mode == ImpactMode::slip_stick) ==
                (space.path == PathKind::stick || space.path == PathKind::slip_stick));
  }
}

BOOST_AUTO_TEST_CASE(other_laws_of_restitution_are_refused) {
  ImpactLaw law = moreau(0.3, 0.5);
  law.law = RestitutionLaw::poisson;
  CHECK_REFUSED(law.validate(), std::domain_error);
}

}  // namespace
