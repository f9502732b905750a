// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of impacts in space against differences of motions stepped in 50 digits, of flights in long double.
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/flight/flight_derivatives.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::Collision;
using clatter::oracle::Random;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;

constexpr int corners = CLATTER_TEST_SLOW_BUILD ? 10 : 30, strikes = CLATTER_TEST_SLOW_BUILD ? 1 : 2;

/// Fourth-order differences of f(h).
auto difference(const auto& f, Real h) { return ((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)).eval(); }

/// Largest error of a 3 × 3 block beside its row of blocks.
template <class Matrix>
double block_error(const Matrix& found, const Matrix& expected) {
  double worst = 0;
  for (int row = 0; row < found.rows(); row += 3) {
    for (int column = 0; column < found.cols(); column += 3) {
      const Matrix3 e = expected.template block<3, 3>(row, column);
      const double size = std::fmax(e.norm(), 1e-3 * expected.middleRows(row, 3).norm());
      worst = std::fmax(worst, (found.template block<3, 3>(row, column) - e).norm() / size);
    }
  }
  return worst;
}

using Many = clatter::oracle::Digits50;
using ManyVector = Eigen::Matrix<Many, 3, 1>;
using ManyMatrix = Eigen::Matrix<Many, 3, 3>;
using Rows = Eigen::Matrix<Many, 9, 1>;

ManyMatrix cross_of(const ManyVector& u) {
  ManyMatrix m;
  m << 0, -u[2], u[1], u[2], 0, -u[0], -u[1], u[0], 0;
  return m;
}

/// P, V′, ω′ of a corner after a shift of the state, by stepping.  The state is that of `c` to its last digit.
Rows stepped(const Collision& c, const ImpactLaw& law, int variable, const Many& shift) {
  const ManyVector along = shift * ManyVector::Unit(variable % 3), none = ManyVector::Zero();
  // By Rodrigues's formula for a turn so small that its cube is beyond 30 digits.
  const ManyMatrix turn = cross_of(variable < 3 ? along : none);
  const ManyMatrix axes =
      (ManyMatrix::Identity() + turn + turn * turn / 2) * c.before.attitude.toRotationMatrix().cast<Many>();
  const ManyMatrix inverse = axes * c.body.inertia.inverse().cast<Many>() * axes.transpose();
  const ManyVector arm = axes * c.place.cast<Many>();
  const ManyVector velocity = c.before.velocity.cast<Many>() + (variable / 3 == 1 ? along : none);
  const ManyVector turning = c.before.angular_velocity.cast<Many>() + (variable / 3 == 2 ? along : none);
  const ManyMatrix cross = cross_of(arm);
  const ManyMatrix w = ManyMatrix::Identity() / Many(c.body.mass) + cross * inverse * cross.transpose();
  const ManyVector impulse = clatter::oracle::SteppedImpact<Many>(w, velocity + turning.cross(arm), law).impulse();
  Rows rows;
  rows << impulse, velocity + impulse / Many(c.body.mass), turning + inverse * arm.cross(impulse);
  return rows;
}

/// Central differences over `step`, part of the state's own scales: in 50 digits they err by its square, or by itself
/// where second derivatives jump.
double error_of_strike(const Collision& c, const ImpactLaw& law, double step = 1e-14) {
  const double speed = contact_velocity(c.before, c.place).value.norm(), reach = c.place.norm();
  StrikeDerivatives found, expected;
  Body body = c.body;
  body.vertices = {c.place};
  const Corner corner{.index = 0, .place = c.place};
  (void)strike(body, c.before, contact_velocity(c.before, c.place), corner, law, found);
  for (int k = 0; k < 9; ++k) {
    const Many h = step * (k < 3 ? 1 : k < 6 ? speed : speed / reach);
    expected.col(k) = ((stepped(c, law, k, h) - stepped(c, law, k, -h)) / (2 * h)).cast<double>();
  }
  return block_error(found, expected);
}

constexpr double tolerance_of_strikes = 1e-9;

BOOST_AUTO_TEST_CASE(derivatives_where_slip_turns_stops_or_goes_on_anew_are_those_of_stepped_impacts) {
  Random random(23);
  for (const PathKind path : {PathKind::turning_slip, PathKind::slip_stick, PathKind::slip_reslip}) {
    for (int i = 0; i < strikes;) {
      const Collision c = clatter::oracle::random_collision(random);
      const ImpactLaw law = clatter::oracle::random_law(random, 1.5);
      if (contact_impulse(clatter::oracle::contact_of(c), law).path != path) continue;
      ++i;
      BOOST_TEST_CONTEXT("path " << static_cast<int>(path) << " corner " << i) {
        BOOST_CHECK_LE(error_of_strike(c, law), tolerance_of_strikes);
      }
    }
  }
}

/// A corner whose slip starts at `distance` [rad] from the first direction that leads slip away, or towards itself.
Collision beside_a_direction(Collision c, const ImpactLaw& law, bool attracts, double distance, double speed) {
  const Contact contact = clatter::oracle::contact_of(c);
  const InvariantDirections directions = invariant_directions(contact.inverse_inertia, law.friction_value);
  const auto near = std::find_if(directions.list.begin(), directions.list.end(),
                                 [&](const InvariantDirection& d) { return d.attracts == attracts; });
  const Vector2 slip = Eigen::Rotation2Dd(distance) * near->direction * speed;
  c.before.velocity += Vector3(slip.x(), slip.y(), contact.velocity.z()) - contact.velocity;
  return c;
}

BOOST_AUTO_TEST_CASE(derivatives_of_slip_that_starts_near_a_zero_of_g_are_those_of_stepped_impacts) {
  Random random(31);
  for (int i = 0; i < 2 * strikes; ++i) {
    const ImpactLaw law = clatter::oracle::random_law(random, 1.5);
    const double distance = std::pow(10, -1 - i % 5) * (i % 2 == 0 ? 1 : -1);
    const Collision c = beside_a_direction(clatter::oracle::random_collision(random), law, i % 3 == 0, distance,
                                           random.uniform(0.5, 2));
    BOOST_TEST_CONTEXT("corner " << i << " at " << distance) {
      BOOST_CHECK_LE(error_of_strike(c, law, 1e-14 * std::fabs(distance)), tolerance_of_strikes);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_in_a_plane_of_symmetry_are_those_of_stepped_impacts) {
  Random random(5);
  for (int i = 0; i < strikes;) {
    Collision c = clatter::oracle::random_collision(random);
    c.body.inertia = (0.02 * c.body.mass * Vector3(1, 2, 2.3)).asDiagonal();
    c.place = {random.uniform(-0.3, 0.3), 0, random.uniform(-0.3, 0.3)};
    c.before.attitude = Quaternion::Identity();
    c.before.velocity = {i % 3 == 0 ? 0 : random.uniform(-1, 1), 0, -3};
    c.before.angular_velocity = {0, i % 3 == 0 ? 0 : random.uniform(-3, 3), 0};
    const ImpactLaw law = clatter::oracle::random_law(random, 0.6);
    const Contact contact = clatter::oracle::contact_of(c);
    const double slope = std::fabs(contact.inverse_inertia(0, 2) / contact.inverse_inertia(0, 0));
    if (!(contact.velocity.z() < -0.5) || law.friction_value < slope + 0.05) continue;
    ++i;
    BOOST_TEST_CONTEXT("corner " << i) { BOOST_CHECK_LE(error_of_strike(c, law), tolerance_of_strikes); }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_without_friction_and_at_an_impulse_ratio_are_those_of_the_impact) {
  constexpr double tolerance = 1e-8;  // rounding over the step of the differences, which are of strike() itself
  Random random(7);
  for (int i = 0; i < corners; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    ImpactLaw law = clatter::oracle::random_law(random, 1);
    law.friction = i % 2 == 0 ? FrictionKind::none : FrictionKind::impulse_ratio;
    law.friction_value = i % 2 == 0 ? 0 : 0.1, law.ratio_direction = {0.6, 0.8};
    Body body = c.body;
    body.rims = {{.centre = c.place, .axis = random.vector(1).normalized(), .radius = 0.3 * c.place.norm()}};
    const Corner corner = touching_corner(body, c.before.attitude, 0);
    const ContactVelocity velocity = contact_velocity(c.before, corner.place);
    if (!(velocity.value.z() < -0.01)) continue;
    StrikeDerivatives found, expected;
    (void)strike(body, c.before, velocity, corner, law, found);
    for (int k = 0; k < 9; ++k) {
      const auto rows = [&](Real shift) {
        using RealRows = Eigen::Matrix<Real, 9, 1>;
        State s = c.before;
        const double h = static_cast<double>(shift);
        if (k < 3) s.attitude = Quaternion(Eigen::AngleAxisd(h, Vector3::Unit(k))) * s.attitude;
        else (k < 6 ? s.velocity : s.angular_velocity)[k % 3] += h;
        const Impact impact = strike(body, s, touching_place(body, s.attitude, 0), law);
        RealRows all;
        all << impact.impulse.cast<Real>(), impact.velocity_after.cast<Real>(),
            impact.angular_velocity_after.cast<Real>();
        return all;
      };
      const double steep = steepness(body, c.before.attitude, 0);
      expected.col(k) = difference(rows, 2e-3L * (k < 3 ? steep : -velocity.value.z())).cast<double>();
    }
    BOOST_TEST_CONTEXT("rim " << i << " steepness " << steepness(body, c.before.attitude, 0)) {
      BOOST_CHECK_LE(block_error(found, expected), tolerance);
    }
  }
}

using Turning = std::array<Real, 4>;

/// Attitude and angular velocity of a free body by stepping q′ = ω q/2 with ω = A I⁻¹ Aᵀ L.
std::pair<RealMatrix, RealVector> flown(const Matrix3& inertia, const State& start, const RealVector& turned,
                                        Real time) {
  const RealMatrix i = inertia.cast<Real>(), inverse = i.inverse();
  const Eigen::Quaternion<Real> q = start.attitude.cast<Real>().normalized();
  const RealVector w = start.angular_velocity.cast<Real>() + turned;
  const RealVector momentum = q * RealVector(i * (q.conjugate() * w));
  const auto velocity = [&](const Eigen::Quaternion<Real>& at) {
    return RealVector(at * RealVector(inverse * (at.conjugate() * momentum)));
  };
  const auto unit = [](const Turning& x) { return Eigen::Quaternion<Real>(x[0], x[1], x[2], x[3]).normalized(); };
  const auto rates = [&](const Turning& x, Turning& rate, Real) {
    const RealVector at = velocity(unit(x)) / 2;
    const Eigen::Quaternion<Real> r =
        Eigen::Quaternion<Real>(0, at[0], at[1], at[2]) * Eigen::Quaternion<Real>(x[0], x[1], x[2], x[3]);
    rate = {r.w(), r.x(), r.y(), r.z()};
  };
  Turning x{q.w(), q.x(), q.y(), q.z()};
  boost::numeric::odeint::runge_kutta_fehlberg78<Turning, Real> stepper;
  const int steps = 1 + static_cast<int>(60 * w.norm() * time);
  for (int k = 0; k < steps; ++k) stepper.do_step(rates, x, 0, time / steps);
  return {unit(x).toRotationMatrix(), velocity(unit(x))};
}

struct FlightErrors {
  double attitude, angular_velocity;
};

FlightErrors errors_of_flight(const Matrix3& inertia, const State& start, double time) {
  const RotationDerivatives found =
      rotation_derivatives(FreeFlight(PrincipalAxes(inertia), start, 9.81), inertia, time);
  const RealMatrix now = flown(inertia, start, RealVector::Zero(), time).first;
  Matrix3 attitude, turning;
  const Real h = 1e-3L * std::fmin(start.angular_velocity.norm(), 1 / time);
  for (int k = 0; k < 3; ++k) {
    const auto rows = [&](Real shift) {
      const auto [axes, velocity] = flown(inertia, start, shift * RealVector::Unit(k), time);
      const Eigen::AngleAxis<Real> turn(RealMatrix(axes * now.transpose()));
      Eigen::Matrix<Real, 6, 1> both;
      both << turn.angle() * turn.axis(), velocity;
      return both;
    };
    const Eigen::Matrix<double, 6, 1> both = difference(rows, h).cast<double>();
    attitude.col(k) = both.head<3>(), turning.col(k) = both.tail<3>();
  }
  return {(found.attitude - attitude).norm() / attitude.norm(),
          (found.angular_velocity - turning).norm() / turning.norm()};
}

BOOST_AUTO_TEST_CASE(derivatives_of_free_rotation_are_those_of_stepped_rotation) {
  constexpr double tolerance = 1e-9;
  const Matrix3 unlike = Vector3(1, 1.5, 2).asDiagonal(), top = Vector3(1, 1, 1.6).asDiagonal();
  Random random(3);
  Quaternion attitude = Quaternion::Identity();
  const auto check = [&](const Matrix3& inertia, const Vector3& turning, double time, const std::string& what) {
    State start;
    start.attitude = attitude;
    start.angular_velocity = start.attitude * turning;
    const FlightErrors errors = errors_of_flight(inertia, start, time);
    BOOST_TEST_CONTEXT(what) {
      BOOST_CHECK_LE(errors.attitude, tolerance);
      BOOST_CHECK_LE(errors.angular_velocity, tolerance);
    }
  };
  check(unlike, {0, 1.5, 0}, 1.3, "exactly about the middle axis");
  for (int i = 0; i < corners / 3; ++i) {
    attitude = random.attitude();
    check(clatter::oracle::random_collision(random).body.inertia, random.vector(3), random.uniform(0.1, 2), "any body");
  }
  check(top, {0.3, -0.4, 2}, 1.7, "a symmetric top");
  check(top, {0, 0, -2}, 1.7, "about a top's axis");
  check(unlike, {0, 1.5, 0}, 1.3, "about the middle axis");
  check(unlike, {1e-5, 2e-5, 3}, 1.3, "almost about an axis");
  check(unlike, {1.2, 1e-3, -1e-3}, 2.1, "almost about the other axis");
  check(unlike, {0.01, 2, 0.02}, 3, "almost about the middle axis");
  check(Matrix3::Identity(), {1, 2, -1}, 1, "a ball");
  check(unlike, {1e-7, 2e-6, -1e-6}, 1, "a slow turn");
}

}  // namespace
