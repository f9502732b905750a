// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of impacts and flights in space against differences of motions stepped in long double.
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "analytic/space/flight_derivatives.hpp"
#include "analytic/space/point_height.hpp"
#include "analytic/space/slip_field.hpp"
#include "analytic/space/strike_derivatives.hpp"
#include "tests/analytic/space/random_contact.hpp"
#include "tests/oracles/stepped_impact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::Collision;
using clatter::oracle::Random;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;
using RealMatrix = Eigen::Matrix<Real, 3, 3>;

#ifdef CLATTER_TEST_SLOW_BUILD
constexpr int corners = 10;
#else
constexpr int corners = 60;
#endif

RealMatrix rotation(const RealVector& angle) {
  const Real size = angle.norm();
  return size > 0 ? Eigen::AngleAxis<Real>(size, angle / size).toRotationMatrix() : RealMatrix(RealMatrix::Identity());
}

/// Fourth-order differences of f(h).
template <class Function>
auto difference(const Function& f, Real h) {
  return ((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)).eval();
}

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

using Rows = Eigen::Matrix<Real, 9, 1>;

/// P, V′, ω′ of a corner after a shift of the state, by stepping.
Rows stepped(const Collision& c, const Law& law, int variable, Real shift) {
  const RealVector along = shift * RealVector::Unit(variable % 3), none = RealVector::Zero();
  const RealMatrix axes =
      rotation(variable < 3 ? along : none) * c.before.attitude.cast<Real>().normalized().toRotationMatrix();
  const RealMatrix inverse = axes * c.body.inertia.cast<Real>().inverse() * axes.transpose();
  const RealVector arm = axes * c.place.cast<Real>(), zero = RealVector::Zero();
  const RealVector velocity = c.before.velocity.cast<Real>() + (variable / 3 == 1 ? along : zero);
  const RealVector turning = c.before.angular_velocity.cast<Real>() + (variable / 3 == 2 ? along : zero);
  RealMatrix cross;
  cross << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
  const RealMatrix w = RealMatrix::Identity() / Real(c.body.mass) + cross * inverse * cross.transpose();
  const RealVector v = velocity + turning.cross(arm);
  const Contact contact{.inverse_inertia = w.cast<double>(), .velocity = v.cast<double>(), .velocity_scale = 0};
  const RealVector impulse = clatter::oracle::SteppedImpact(contact, law.law).impulse();
  Rows rows;
  rows << impulse, velocity + impulse / Real(c.body.mass), turning + inverse * arm.cross(impulse);
  return rows;
}

double error_of_strike(const Collision& c, const Law& law, Real step) {
  const double speed = contact_velocity(c.before, c.place).value.norm(), reach = c.place.norm();
  StrikeDerivatives found, expected;
  Body body = c.body;
  body.vertices = {c.place};
  const Corner corner{.index = 0, .place = c.place};
  (void)strike(body, c.before, contact_velocity(c.before, c.place), corner, law, found);
  for (int k = 0; k < 9; ++k) {
    const Real h = step * (k < 3 ? 1 : k < 6 ? speed : speed / reach);
    expected.col(k) = difference([&](Real shift) { return stepped(c, law, k, shift); }, h).cast<double>();
  }
  return block_error(found, expected);
}

BOOST_AUTO_TEST_CASE(derivatives_of_any_corner_with_friction_are_those_of_stepped_impacts) {
  // Stepping errs by 1e-15 and the differences by the fourth power of their step, near a change of path by more.
  constexpr double tolerance = 1e-9;
  Random random(23);
  std::vector<double> errors;
  for (int i = 0; i < corners; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    errors.push_back(error_of_strike(c, clatter::oracle::random_law(random, 1.5), 2e-4L));
    BOOST_TEST_CONTEXT("corner " << i) { BOOST_CHECK_LE(errors.back(), tolerance); }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_slip_that_starts_beside_a_direction_it_leaves_are_those_of_stepped_impacts) {
  Random random(31);
  for (int i = 0; i < corners / 3; ++i) {
    Collision c = clatter::oracle::random_collision(random);
    const Law law = clatter::oracle::random_law(random, 1.5);
    const Contact contact = clatter::oracle::contact_of(c);
    const InvariantDirections directions = invariant_directions(contact.inverse_inertia, law.law.friction_value);
    const auto leaves = std::find_if(directions.list.begin(), directions.list.end(),
                                     [](const InvariantDirection& d) { return !d.attracts; });
    const double distance = i % 2 == 0 ? 1e-3 : 1e-5;
    const Vector2 slip = Eigen::Rotation2Dd(distance) * leaves->direction * random.uniform(0.5, 2);
    c.before.velocity += Vector3(slip.x(), slip.y(), contact.velocity.z()) - contact.velocity;
    // The differences' error is (step/distance)⁴ and the rounding of the state over the step.
    const double tolerance = i % 2 == 0 ? 1e-9 : 1e-7;
    BOOST_TEST_CONTEXT("corner " << i) { BOOST_CHECK_LE(error_of_strike(c, law, 2e-3L * distance), tolerance); }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_in_a_plane_of_symmetry_are_those_of_stepped_impacts) {
  // From rest the second derivatives jump where slip changes its sense, which leaves differences the step as error.
  constexpr double tolerance = 1e-9, from_rest = 3e-7;
  Random random(5);
  for (int i = 0; i < corners / 2;) {
    Collision c = clatter::oracle::random_collision(random);
    c.body.inertia = (0.02 * c.body.mass * Vector3(1, 2, 2.3)).asDiagonal();
    c.place = {random.uniform(-0.3, 0.3), 0, random.uniform(-0.3, 0.3)};
    c.before.attitude = Quaternion::Identity();
    c.before.velocity = {i % 3 == 0 ? 0 : random.uniform(-1, 1), 0, -3};
    c.before.angular_velocity = {0, i % 3 == 0 ? 0 : random.uniform(-3, 3), 0};
    const Law law = clatter::oracle::random_law(random, 0.6);
    const Contact contact = clatter::oracle::contact_of(c);
    const double slope = std::fabs(contact.inverse_inertia(0, 2) / contact.inverse_inertia(0, 0));
    if (!(contact.velocity.z() < -0.5) || law.law.friction_value < slope + 0.05) continue;
    const bool rests = i++ % 3 == 0;
    BOOST_TEST_CONTEXT("corner " << i) {
      BOOST_CHECK_LE(error_of_strike(c, law, rests ? 3e-7L : 1e-4L), rests ? from_rest : tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_without_friction_and_at_an_impulse_ratio_are_those_of_the_impact) {
  constexpr double tolerance = 1e-8;  // rounding over the step of the differences, which are of strike() itself
  Random random(7);
  for (int i = 0; i < corners; ++i) {
    const Collision c = clatter::oracle::random_collision(random);
    Law law = clatter::oracle::random_law(random, 1);
    law.law.friction = i % 2 == 0 ? FrictionKind::none : FrictionKind::impulse_ratio;
    law.law.friction_value = 0.1, law.ratio_direction = {0.6, 0.8};
    Body body = c.body;
    body.rims = {{.centre = c.place, .axis = random.vector(1).normalized(), .radius = 0.3 * c.place.norm()}};
    const Corner corner = touching_corner(body, c.before.attitude, 0);
    const ContactVelocity velocity = contact_velocity(c.before, corner.place);
    if (!(velocity.value.z() < -0.01)) continue;
    StrikeDerivatives found, expected;
    (void)strike(body, c.before, velocity, corner, law, found);
    for (int k = 0; k < 9; ++k) {
      const auto rows = [&](Real shift) {
        State s = c.before;
        const double h = static_cast<double>(shift);
        if (k < 3) s.attitude = Quaternion(Eigen::AngleAxisd(h, Vector3::Unit(k))) * s.attitude;
        else (k < 6 ? s.velocity : s.angular_velocity)[k % 3] += h;
        const Impact impact = strike(body, s, touching_place(body, s.attitude, 0), law);
        Rows all;
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
