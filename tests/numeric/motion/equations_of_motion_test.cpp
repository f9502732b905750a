// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/equations_of_motion.hpp"

#include "numeric/contact/contact_system.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Eight unit masses about their centre.
std::array<Vector3, 8> random_cloud(Random& random) {
  std::array<Vector3, 8> points;
  Vector3 centre = Vector3::Zero();
  for (Vector3& point : points) centre += (point = random.vector()) / 8;
  for (Vector3& point : points) point -= centre;
  return points;
}
BodyInertia inertia_of(const std::array<Vector3, 8>& points) {
  BodyInertia body{.mass = 8};
  for (const Vector3& u : points) body.inertia += u.squaredNorm() * Matrix3::Identity() - u * u.transpose();
  return body;
}

MotionState random_state(Random& random) {
  return {.centre = random.vector(),
          .attitude = random.attitude(),
          .velocity = random.vector(),
          .angular_velocity = random.vector(10)};
}

BOOST_AUTO_TEST_CASE(the_matrices_of_the_euler_parameters_have_their_properties) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond attitude = random.attitude();
    const Vector4 beta = euler_parameters(attitude);
    const Matrix3 a = rotation_matrix(beta);
    const Matrix34 g = rate_matrix(beta);
    BOOST_REQUIRE((a * a.transpose() - Matrix3::Identity()).norm() <= 10 * eps);
    BOOST_REQUIRE(a.determinant() > 0);
    const Vector3 point = random.vector();
    BOOST_REQUIRE((a * point - attitude * point).norm() <= 10 * eps);
    BOOST_REQUIRE((g * beta).norm() <= 4 * eps);
    BOOST_REQUIRE((g * g.transpose() - 4 * Matrix3::Identity()).norm() <= 40 * eps);
    const Vector3 omega = random.vector();
    const Vector4 rate = euler_parameter_rates(beta, omega);
    const Eigen::Quaterniond product = attitude * Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z());
    BOOST_REQUIRE((rate - euler_parameters(product) / 2).norm() <= 10 * eps);
    BOOST_REQUIRE((g * rate - omega).norm() <= 20 * eps);
  }
}

BOOST_AUTO_TEST_CASE(the_attitude_changes_at_the_rate_of_the_angular_velocity) {
  // Central difference of A: Ȧ = A ω̃′.
  Random random(5);
  const double step = 1e-5, tolerance = 1e-9;  // step² and eps/step
  const Vector4 beta = euler_parameters(random.attitude());
  const Vector3 omega = random.vector();
  const Vector4 rate = euler_parameter_rates(beta, omega);
  const Matrix3 difference = (rotation_matrix(beta + step * rate) - rotation_matrix(beta - step * rate)) / (2 * step);
  BOOST_TEST((difference - rotation_matrix(beta) * skew(omega)).norm() <= tolerance);
}

BOOST_AUTO_TEST_CASE(the_paper_s_equations_are_those_of_newton_and_euler) {
  constexpr double tolerance = 1e-12;
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    BodyInertia body = inertia_of(random_cloud(random));
    const MotionState state = random_state(random);
    const double size = i % 4 == 0 ? 1e-13 : 1;  // a light and small body is solved as well
    body.mass *= size;
    body.inertia *= size;
    const WorldWrench wrench{random.vector(100 * size), random.vector(100 * size)};
    const LagrangeAcceleration lagrange = solve(lagrange_system(body, state, wrench));
    const NewtonEuler newton(body.mass, body.inertia);
    const Vector3 linear = newton.linear(wrench.force);
    const Vector3 angular = newton.angular(state.angular_velocity, state.attitude.conjugate() * wrench.moment);
    const double condition = body.inertia.norm() * body.inertia.inverse().norm();
    BOOST_REQUIRE((lagrange.coordinates.head<3>() - linear).norm() <= tolerance * linear.norm());
    BOOST_REQUIRE((lagrange.angular - angular).norm() <= tolerance * std::fmax(1.0, condition / 100) * angular.norm());
    // β̈ is what differentiating β̇ = ½ β ω′ once more gives.
    const Vector4 beta = euler_parameters(state.attitude);
    const Vector4 second = euler_parameter_rates(beta, angular) - state.angular_velocity.squaredNorm() / 4 * beta;
    BOOST_REQUIRE((lagrange.coordinates.tail<4>() - second).norm() <=
                  tolerance * std::fmax(1.0, condition / 100) * second.norm());
  }
}

/// A frictionless box that turns while its corner is pressed: force and moment come from the load, Eqs. 1 and 2 from
/// their printed form.
BOOST_AUTO_TEST_CASE(a_body_in_contact_is_accelerated_as_the_paper_s_equations_say) {
  constexpr double tolerance = 1e-12, gravity = 9.81;
  const Body body = box_body({0.3, 0.2, 0.1}, 2);
  const Ground ground{.stiffness = 1e7, .damping = 1e5};
  ContactSystem system(body, ground, gravity, false);
  system.begin(touching_state(body, {.inclination = 0.5, .out_of_plane_tilt = 0.3}));
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    ContactState state = system.initial(), rate;
    displacement(state) = Vector3(0, 0, -2e-3);
    velocity(state) = random.vector();
    angular_velocity(state) = random.vector(10);
    const ContactDiagnosis at = system.diagnose(state, rate);
    const MotionState motion = system.motion(state);
    const Vector3 up = motion.attitude.conjugate() * Vector3::UnitZ();
    const WorldWrench wrench{.force = {0, 0, at.load.force - body.mass() * gravity},
                             .moment = motion.attitude * at.load.first_moment.cross(up)};
    BOOST_REQUIRE(at.load.force > 0);
    const LagrangeAcceleration paper = solve(lagrange_system({body.mass(), body.inertia()}, motion, wrench));
    BOOST_TEST((velocity(rate) - paper.coordinates.head<3>()).norm() <=
               tolerance * gravity + tolerance * velocity(rate).norm());
    BOOST_TEST((angular_velocity(rate) - paper.angular).norm() <= tolerance * paper.angular.norm());
  }
}

BOOST_AUTO_TEST_CASE(the_mass_matrix_and_velocity_force_are_the_paper_s_integrals) {
  // The integrals over a cloud of unit masses, summed as they are printed (with ω̃′ω̃′ for ω̃′ω̃′ᵀ).
  Random random(5);
  const std::array<Vector3, 8> points = random_cloud(random);
  const BodyInertia body = inertia_of(points);
  const MotionState state = random_state(random);
  const Vector4 beta = euler_parameters(state.attitude);
  const Matrix3 a = state.attitude.toRotationMatrix(), w = skew(state.angular_velocity);
  Matrix7 mass_matrix = Matrix7::Zero();
  Vector7 velocity_force = Vector7::Zero();
  for (const Vector3& u : points) {
    Eigen::Matrix<double, 3, 7> row;
    row << Matrix3::Identity(), -a * skew(u) * rate_matrix(beta);
    mass_matrix += row.transpose() * row;
    velocity_force -= row.transpose() * (a * w * w * u);
  }
  const LagrangeSystem system = lagrange_system(body, state, {});
  BOOST_TEST((system.mass_matrix - mass_matrix).norm() <= 50 * eps * mass_matrix.norm());
  BOOST_TEST((system.velocity_force - velocity_force).norm() <= 50 * eps * velocity_force.norm());
}

BOOST_AUTO_TEST_CASE(a_body_without_mass_or_inertia_is_refused) {
  const Matrix3 unit = Matrix3::Identity();
  for (const double mass : {0.0, -1.0, not_a_number, infinite})
    BOOST_CHECK_THROW(NewtonEuler(mass, unit), std::domain_error);
  for (const Matrix3& inertia : {Matrix3(-unit), Matrix3(0 * unit), Matrix3(unit * not_a_number)})
    BOOST_CHECK_THROW(NewtonEuler(1, inertia), std::domain_error);
}

}  // namespace
