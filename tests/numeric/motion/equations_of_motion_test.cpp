// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>
#include <stdexcept>

#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/equations_of_motion.hpp"
#include "tests/numeric/bodies.hpp"

namespace {

using namespace clatter::numeric;

constexpr double eps = 2.2e-16;

class Random {
 public:
  double number() { return uniform_(engine_); }
  Vector3 vector() { return {number(), number(), number()}; }
  Eigen::Quaterniond attitude() {
    return Eigen::Quaterniond(number(), number(), number(), 1 + number() / 2).normalized();
  }
  /// Inertia of a cloud of eight points about their centre.
  BodyInertia body() {
    Vector3 points[8], centre = Vector3::Zero();
    for (Vector3& point : points) centre += (point = vector()) / 8;
    BodyInertia result;
    for (const Vector3& point : points) {
      const Matrix3 arm = skew(point - centre);
      result.inertia += arm.transpose() * arm;
      result.mass += 1;
    }
    return result;
  }

 private:
  std::mt19937_64 engine_{5};
  std::uniform_real_distribution<> uniform_{-1, 1};
};

MotionState random_state(Random& random) {
  return {.centre = random.vector(),
          .attitude = random.attitude(),
          .velocity = random.vector(),
          .angular_velocity = 10 * random.vector()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_matrices_of_the_euler_parameters_have_their_properties) {
  Random random;
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
  Random random;
  const double step = 1e-5, tolerance = 1e-9;  // step² and eps/step
  const Vector4 beta = euler_parameters(random.attitude());
  const Vector3 omega = random.vector();
  const Vector4 rate = euler_parameter_rates(beta, omega);
  const Matrix3 difference = (rotation_matrix(beta + step * rate) - rotation_matrix(beta - step * rate)) / (2 * step);
  BOOST_TEST((difference - rotation_matrix(beta) * skew(omega)).norm() <= tolerance);
}

BOOST_AUTO_TEST_CASE(the_paper_s_equations_are_those_of_newton_and_euler) {
  constexpr double tolerance = 1e-12;
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const BodyInertia body = random.body();
    const MotionState state = random_state(random);
    const WorldWrench wrench{100 * random.vector(), 100 * random.vector()};
    const LagrangeAcceleration lagrange = solve(lagrange_system(body, state, wrench));
    const Acceleration newton =
        NewtonEuler(body.mass, body.inertia)
            .acceleration(state.angular_velocity,
                          {.force = wrench.force, .moment = state.attitude.conjugate() * wrench.moment});
    const double condition = body.inertia.norm() * body.inertia.inverse().norm();
    BOOST_REQUIRE((lagrange.coordinates.head<3>() - newton.linear).norm() <= tolerance * newton.linear.norm());
    BOOST_REQUIRE((lagrange.angular - newton.angular).norm() <=
                  tolerance * std::fmax(1.0, condition / 100) * newton.angular.norm());
    // β̈ is what differentiating β̇ = ½ β ω′ once more gives.
    const Vector4 beta = euler_parameters(state.attitude);
    const Vector4 second =
        euler_parameter_rates(beta, newton.angular) - state.angular_velocity.squaredNorm() / 4 * beta;
    BOOST_REQUIRE((lagrange.coordinates.tail<4>() - second).norm() <=
                  tolerance * std::fmax(1.0, condition / 100) * second.norm());
  }
}

/// A frictionless box that turns while its corner is pressed: force and moment come from the load, Eqs. 1 and 2 from
/// their printed form.
BOOST_AUTO_TEST_CASE(a_body_in_contact_is_accelerated_as_the_paper_s_equations_say) {
  constexpr double tolerance = 1e-12, gravity = 9.81;
  const Body body = test::box_body({0.3, 0.2, 0.1}, 2);
  const Ground ground{.stiffness = 1e7, .damping = 1e5};
  ContactSystem system(body, ground, gravity, false);
  system.begin(touching_state(body, {.inclination = 0.5, .out_of_plane_tilt = 0.3}));
  Random random;
  for (int i = 0; i < 100; ++i) {
    ContactState state = system.initial(), rate;
    displacement(state) = Vector3(0, 0, -2e-3);
    velocity(state) = random.vector();
    angular_velocity(state) = 10 * random.vector();
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
  Random random;
  Vector3 points[8], centre = Vector3::Zero();
  for (Vector3& point : points) centre += (point = random.vector()) / 8;
  BodyInertia body;
  const MotionState state = random_state(random);
  const Vector4 beta = euler_parameters(state.attitude);
  const Matrix3 a = state.attitude.toRotationMatrix(), w = skew(state.angular_velocity);
  Matrix7 mass_matrix = Matrix7::Zero();
  Vector7 velocity_force = Vector7::Zero();
  for (const Vector3& point : points) {
    const Vector3 u = point - centre;
    body.mass += 1;
    body.inertia += u.squaredNorm() * Matrix3::Identity() - u * u.transpose();
    Eigen::Matrix<double, 3, 7> row;
    row << Matrix3::Identity(), -a * skew(u) * rate_matrix(beta);
    mass_matrix += row.transpose() * row;
    velocity_force -= row.transpose() * (a * w * w * u);
  }
  const LagrangeSystem system = lagrange_system(body, state, {});
  BOOST_TEST((system.mass_matrix - mass_matrix).norm() <= 50 * eps * mass_matrix.norm());
  BOOST_TEST((system.velocity_force - velocity_force).norm() <= 50 * eps * velocity_force.norm());
}

BOOST_AUTO_TEST_CASE(without_the_constraint_the_mass_matrix_is_singular) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const MotionState state = random_state(random);
    const LagrangeSystem system = lagrange_system(random.body(), state, {});
    Vector7 stretch = Vector7::Zero();
    stretch.tail<4>() = euler_parameters(state.attitude);
    BOOST_TEST((system.mass_matrix * stretch).norm() <= 20 * eps * system.mass_matrix.norm());
    BOOST_TEST(Eigen::FullPivLU<Matrix7>(system.mass_matrix).setThreshold(1e-12).rank() == 6);
  }
}

BOOST_AUTO_TEST_CASE(a_light_and_small_body_is_solved_as_well_as_a_large_one) {
  Random random;
  const MotionState state = random_state(random);
  const BodyInertia body{1e-3, Vector3(1e-12, 2e-12, 2.5e-12).asDiagonal()};
  const Acceleration newton = NewtonEuler(body.mass, body.inertia).acceleration(state.angular_velocity, {});
  const LagrangeAcceleration lagrange = solve(lagrange_system(body, state, {}));
  BOOST_TEST((lagrange.angular - newton.angular).norm() <= 1e-13 * newton.angular.norm());
}

BOOST_AUTO_TEST_CASE(a_million_renormalised_steps_leave_a_unit_attitude_and_the_energy) {
  // Midpoint rule, third-order in the norm, h |ω| = 0.01: local error (h |ω|)³/24 a step before renormalisation.
  const Matrix3 inertia = Vector3(1, 2, 2.5).asDiagonal();
  const NewtonEuler equations(1, inertia);
  const double step = 0.01;
  Vector3 omega(0.6, 0.5, -0.6);
  const double energy = omega.dot(inertia * omega);
  Vector4 beta(1, 0, 0, 0);
  double drift = 0, before = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Vector3 middle = omega + step / 2 * equations.acceleration(omega, {}).angular;
    const Vector4 half = beta + step / 2 * euler_parameter_rates(beta, omega);
    omega += step * equations.acceleration(middle, {}).angular;
    beta += step * euler_parameter_rates(half, middle);
    before = std::fmax(before, std::fabs(beta.norm() - 1));
    beta.normalize();
    drift = std::fmax(drift, std::fabs(beta.norm() - 1));
  }
  BOOST_TEST(drift <= 2 * eps);
  BOOST_TEST(before <= step * step * step);
  // (h |ω|)⁴ of growth in 10⁶ steps is 1e-2 at most.
  BOOST_TEST(std::fabs(omega.dot(inertia * omega) / energy - 1) <= 1e-2);
}

BOOST_AUTO_TEST_CASE(a_body_without_mass_or_inertia_is_refused) {
  const Matrix3 unit = Matrix3::Identity();
  for (const double mass : {0.0, -1.0, double(NAN), double(INFINITY)}) {
    BOOST_CHECK_THROW(NewtonEuler(mass, unit), std::domain_error);
  }
  BOOST_CHECK_THROW(NewtonEuler(1, -unit), std::domain_error);
  BOOST_CHECK_THROW(NewtonEuler(1, Matrix3::Zero()), std::domain_error);
  BOOST_CHECK_THROW(NewtonEuler(1, Matrix3(unit * NAN)), std::domain_error);
}
