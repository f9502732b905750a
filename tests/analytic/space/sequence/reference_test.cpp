// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/analytic/space/impulse/reference_impact.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::oracle::ReferenceImpact;

std::vector<ReferenceImpact> rows() { return clatter::oracle::reference_impacts(CLATTER_TEST_DATA_DIR); }

/// The reference tells a path along which slip turns and one along which slip is straight by the same word.
bool same_path(PathKind kind, const ReferenceImpact& row) {
  const bool was_slipping = row.contact.velocity.head<2>().norm() > 0;
  switch (kind) {
    case PathKind::frictionless: return row.path == "frictionless";
    case PathKind::slip: return row.path == (was_slipping ? "slip" : "rest-slip");
    case PathKind::turning_slip: return row.path == "slip";
    case PathKind::stick: return row.path == "stick";
    case PathKind::slip_stick: return row.path == "slip-stick";
    case PathKind::slip_reslip: return row.path == "slip-reslip";
  }
  return false;
}

BOOST_AUTO_TEST_CASE(impulse_and_velocity_of_every_reference_impact_in_space_come_out) {
  const auto all = rows();
  BOOST_REQUIRE_GE(all.size(), 140u);
  for (const ReferenceImpact& row : all) {
    const ContactImpulse impact = contact_impulse(row.contact, row.law);
    const double size = row.impulse.norm(), speed = row.contact.velocity.norm();
    BOOST_TEST_CONTEXT(row.name) {
      BOOST_CHECK_LE((impact.impulse - row.impulse).norm(), row.tolerance * size);
      BOOST_CHECK_LE((impact.velocity_after - row.contact_after).norm(), row.tolerance * speed);
      BOOST_CHECK_LE(std::fabs(impact.compression_impulse - row.compression), row.tolerance * size);
      BOOST_CHECK_EQUAL(std::isnan(impact.slip_stop_impulse), std::isnan(row.slip_stop));
      BOOST_CHECK(!(std::fabs(impact.slip_stop_impulse - row.slip_stop) > row.tolerance * size));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_kind_of_path_of_every_reference_impact_comes_out_and_none_is_ambiguous) {
  for (const ReferenceImpact& row : rows()) {
    const ContactImpulse impact = contact_impulse(row.contact, row.law);
    BOOST_TEST_CONTEXT(row.name) {
      BOOST_CHECK(same_path(impact.path, row));
      BOOST_CHECK(!impact.is_path_ambiguous);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_body_that_strikes_as_in_the_reference_gets_its_velocities) {
  for (const ReferenceImpact& row : rows()) {
    const Matrix3 axes = row.before.attitude.toRotationMatrix();
    const Vector3 arm = axes * row.place;
    const Matrix3 inertia = axes * row.body.inertia.inverse() * axes.transpose();
    const Matrix3& expected = row.contact.inverse_inertia;
    // Rounding of the attitude given turns the inertia, which a slender body amplifies.
    const double rounding = 8 * 2.3e-16 * row.body.inertia.norm() * row.body.inertia.inverse().norm();
    BOOST_TEST_CONTEXT(row.name) {
      BOOST_CHECK_LE((inverse_contact_inertia(row.body.mass, inertia, arm) - expected).norm(),
                     rounding * expected.norm());
      const Impact impact = strike(row.body, row.before, row.place, row.law);
      const double speed = row.before.velocity.norm() + row.before.angular_velocity.norm() * arm.norm();
      BOOST_CHECK_LE((impact.contact_before - row.contact.velocity).norm(), row.tolerance * speed);
      BOOST_CHECK_LE((impact.impulse - row.impulse).norm(), row.tolerance * row.impulse.norm());
      BOOST_CHECK_LE((impact.velocity_after - row.velocity_after).norm(), row.tolerance * speed);
      BOOST_CHECK_LE((impact.angular_velocity_after - row.angular_velocity_after).norm() * arm.norm(),
                     row.tolerance * speed);
    }
  }
}

}  // namespace
