// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/impulse_path.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/analytic/space/impulse/random_contact.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::contact_of;
using clatter::oracle::Random;
using clatter::oracle::random_collision;
using clatter::oracle::random_law;

constexpr int corners = CLATTER_TEST_SLOW_BUILD ? 300 : 10000;

BOOST_AUTO_TEST_CASE(random_corners_with_friction_and_any_law_agree_with_stepping_in_long_double) {
  constexpr double tolerance = 1e-11;
  Random random(11);
  int unlike = 0;
  double worst = 0;
  for (int i = 0; i < corners; ++i) {
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

}  // namespace
