// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/free_rotation.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/support.hpp"
#include "validation/oracles/free_top.hpp"

namespace {

using namespace clatter::numeric;
using clatter::oracle::Top;
using clatter::test::eps, clatter::test::Random;
using Exact = boost::multiprecision::cpp_bin_float_50;

constexpr double turn = 2 * std::numbers::pi;

struct Body {
  std::string name;
  Vector3 moments;
  Vector3 omega;
};

Matrix3 diagonal(const Vector3& moments) { return moments.asDiagonal(); }

FreeRotation free_rotation(const Body& body) { return {diagonal(body.moments), {.angular_velocity = body.omega}}; }

/// Largest difference of a component, velocities in units of |ω|.
template <typename Real>
double distance(const Rotation& rotation, const Top<Real>& exact, double speed) {
  const auto& q = rotation.attitude;
  const double computed[4] = {q.w(), q.x(), q.y(), q.z()};
  Real dot = 0;
  for (int i = 0; i < 4; ++i) dot += computed[i] * exact.q[i];
  double result = 0;
  for (int i = 0; i < 4; ++i) {
    const Real difference = computed[i] - (dot < 0 ? Real(-exact.q[i]) : exact.q[i]);
    result = std::fmax(result, std::fabs(static_cast<double>(difference)));
  }
  for (int i = 0; i < 3; ++i) {
    const Real difference = rotation.angular_velocity[i] - exact.w[i];
    result = std::fmax(result, std::fabs(static_cast<double>(difference)) / speed);
  }
  return result;
}

/// Largest distance from the integrated motion over `turns`, looked at after every step of a power of two,
/// so that all times are exact.
template <typename Real, int order>
double worst_distance(const Body& body, double turns) {
  const FreeRotation rotation = free_rotation(body);
  const double speed = body.omega.norm();
  const double step = std::exp2(std::floor(std::log2(0.5 / rotation.largest_speed())));
  clatter::oracle::TopSeries<Real> series(order);
  Top<Real> top;
  for (int i = 0; i < 3; ++i) {
    top.moments[i] = body.moments[i];
    top.w[i] = body.omega[i];
  }
  double worst = 0;
  for (int k = 1; k * step * speed <= turns * turn; ++k) {
    series.step(top, Real(step));
    worst = std::fmax(worst, distance(rotation.at(k * step), top, speed));
  }
  return worst;
}

Vector3 box_moments(double a, double b, double c) { return Vector3(b * b + c * c, c * c + a * a, a * a + b * b) / 12; }

const Vector3 phone = box_moments(0.10566, 0.04394, 0.01905);

Vector3 world_momentum(const Matrix3& inertia, const Rotation& r) {
  return r.attitude * (inertia * r.angular_velocity);
}

}  // namespace

BOOST_AUTO_TEST_CASE(free_rotation_solves_euler_s_equations_over_200_turns) {
  constexpr double turns = CLATTER_TEST_SLOW_BUILD ? 20 : 200;
  constexpr double tolerance = 2e-12;  // 7 eps for each of the 1257 radians
  const Body bodies[] = {
      {"phone about its long axis", phone, {20, 0.5, -0.3}},
      {"phone about its middle axis", phone, {1, 20, 3}},
      {"phone about its short axis", phone, {-1, 2, -15}},
      {"asymmetrical, about the largest", {1, 2, 2.5}, {0.5, -0.4, 0.7}},
      {"asymmetrical, about the smallest", {1, 2, 2.5}, {0.9, 0.2, -0.3}},
      {"axes in another order", {2.5, 1, 2}, {-0.6, 0.5, 0.7}},
      {"axes in reversed order", {2.5, 2, 1}, {0.6, 0.5, -0.7}},
      {"one component zero", {2, 1, 2.5}, {0, -0.6, 0.2}},
      {"plate", {1, 2, 3}, {0.5, -0.5, 0.7}},
      {"thin plate almost a rod", {1e-6, 1, 1 + 1e-6}, {1, 0.5, 0.7}},
      {"rod of aspect ratio 1e6", {1e-12, 1, 1 + 0.5e-12}, {1, 0.5, 0.7}},
      {"the same, hardly spinning", {1e-12, 1, 1 + 0.5e-12}, {1e-6, 0.5, 0.7}},
      {"the same, spinning fast", {1e-12, 1, 1 + 0.5e-12}, {1000, 0.5, 0.7}},
      {"almost oblate", {1, 1 + 1e-14, 1.5}, {0.5, 0.5, 0.7}},
      {"almost oblate, tumbling", {1, 1 + 1e-14, 1.5}, {0.5, 0.5, 1e-8}},
      {"almost oblate, tumbling, circling the other axis", {1, 1 + 1e-9, 1.5}, {0.5, 0.5, 1e-4}},
      {"almost prolate", {0.5, 1, 1 + 1e-14}, {0.5, 0.5, 0.7}},
      {"almost prolate, tumbling", {0.5, 1, 1 + 1e-14}, {1e-8, 0.5, 0.7}},
      {"almost spherical", {1, 1 + 1e-14, 1 + 2e-14}, {0.3, 0.5, 0.7}},
      {"oblate", {1, 1, 1.5}, {0.4, 0.5, -0.1}},
      {"prolate", {2, 0.1, 2}, {0.4, 0.5, -0.1}},
      {"spherical", {2, 2, 2}, {0.4, 0.5, -0.1}},
      {"fixed axis", {1, 2, 3}, {0, 0.5, 0}},
      {"close to the separatrix", {1, 2, 3}, {0.03, 1, 0.03}},
  };
  for (const Body& body : bodies) {
    BOOST_TEST_CONTEXT(body.name) { BOOST_TEST((worst_distance<long double, 26>(body, turns)) <= tolerance); }
  }
}

BOOST_AUTO_TEST_CASE(a_body_leaves_its_intermediate_axis_when_a_cross_component_of_1e_17_says_so) {
  // The first flip comes after 40 time constants, each of which costs a few eps in the phase.
  constexpr double tolerance = 1e-12;
  const Body bodies[] = {
      {"the larger axis alone", {1, 2, 3}, {0, -1, 1e-17}},
      {"approaching first", {1, 2, 3}, {1e-9, 1, -0.577e-9}},
      {"phone", phone, {-3e-17, 1, 2e-16}},
  };
  for (const Body& body : bodies) {
    BOOST_TEST_CONTEXT(body.name) {
      const double worst = worst_distance<Exact, 60>(body, 18);
      BOOST_TEST(worst <= tolerance);
    }
  }
}

/// At rest, too.
BOOST_AUTO_TEST_CASE(rotation_about_a_principal_axis_is_a_uniform_turn) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double speed : {-3.0, 0.0}) {
      const Vector3 omega = speed * Vector3::Unit(axis);
      const FreeRotation rotation(diagonal(phone), {.angular_velocity = omega});
      for (const double time : {0.0, 0.3, -1.7, 2000.0}) {
        const Rotation r = rotation.at(time);
        BOOST_CHECK(r.angular_velocity == omega);
        Eigen::Vector4d expected = Eigen::Vector4d::Zero();
        expected[axis] = std::sin(speed / 2 * time);
        expected[3] = std::cos(speed / 2 * time);
        BOOST_TEST((r.attitude.coeffs() - expected).norm() <= 4 * eps);
      }
      BOOST_TEST(rotation.largest_acceleration() == 0);
      BOOST_TEST(rotation.largest_speed() <= std::fabs(speed) * (1 + 1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_planar_motion_stays_planar_to_the_last_bit) {
  Matrix3 inertia;
  inertia << 2, 0, 0.3, 0, 2.5, 0, 0.3, 0, 1;
  const Rotation start{Eigen::Quaterniond(0.6, 0, 0.8, 0), {0, 1.3, 0}}, r = FreeRotation(inertia, start).at(123.4);
  BOOST_CHECK(r.angular_velocity == start.angular_velocity);
  BOOST_TEST((r.attitude.x() == 0 && r.attitude.z() == 0));
}

BOOST_AUTO_TEST_CASE(the_choice_of_body_axes_does_not_matter) {
  constexpr double tolerance = 1e-12;  // 600 radians, moments to a few eps
  const Eigen::Quaterniond axes = Eigen::Quaterniond(1, -2, 0.5, 3).normalized();
  const Matrix3 inertia = axes.toRotationMatrix() * diagonal({1, 2, 2.6}) * axes.toRotationMatrix().transpose();
  const Vector3 omega(0.4, 0.3, -0.9);
  const FreeRotation along(diagonal({1, 2, 2.6}), {.angular_velocity = omega});
  const FreeRotation across(inertia, {axes.conjugate(), axes * omega});
  for (double time = 0; time < 600; time += 13.7) {
    BOOST_TEST((axes * along.at(time).angular_velocity - across.at(time).angular_velocity).norm() <= tolerance);
    const Eigen::Quaterniond attitude = across.at(time).attitude * axes;
    BOOST_TEST(1 - std::fabs(attitude.dot(along.at(time).attitude)) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(the_bounds_hold_and_the_speed_s_is_attained) {
  for (const Body& body : {Body{"phone", phone, {1, 20, 3}}, Body{"plate", {1, 2, 3}, {0.5, 0.5, 0.7}},
                           Body{"disc", {1, 1, 2}, {0.5, 0.5, 0.7}}, Body{"slow", {1, 2, 2.5}, {0.9, 0.2, -0.3}}}) {
    const FreeRotation rotation = free_rotation(body);
    const Matrix3 inertia = diagonal(body.moments);
    double speed = 0, acceleration = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3 w = rotation.at(i * 0.01 / body.omega.norm()).angular_velocity;
      speed = std::fmax(speed, w.norm());
      acceleration = std::fmax(acceleration, (inertia.inverse() * w.cross(inertia * w)).norm());
    }
    BOOST_TEST(speed <= rotation.largest_speed());
    BOOST_TEST(speed >= (1 - 1e-4) * rotation.largest_speed());
    BOOST_TEST(acceleration <= rotation.largest_acceleration());
    BOOST_TEST(acceleration >= 0.5 * rotation.largest_acceleration());
  }
}

BOOST_AUTO_TEST_CASE(whatever_the_size_shape_and_speed_the_result_is_finite_and_conserves_the_momentum) {
  constexpr double tolerance = 20 * eps;
  Random random(11);
  const auto power = [&](double low, double high) { return random.decades(low, high); };
  for (int i = 0; i < 4000; ++i) {
    const double size = power(-30, 30), speed = power(-12, 8);
    const double a = i % 2 == 0 ? power(-12, 0) : 1 + power(-16, 0);
    const double difference = std::fmin(a, 1) * (i % 3 == 0 ? 1 : power(-17, 0));
    Vector3 moments = size * Vector3(a, 1, std::fmax(a, 1) + difference);
    Vector3 omega = speed * Vector3(power(-20, 0), power(-20, 0), power(i % 5 == 0 ? -320 : -20, 0));
    if (i % 7 == 0) omega[i % 3] = 0;
    std::swap(moments[0], moments[i % 3]);
    const Matrix3 inertia = diagonal(moments);
    const Rotation start{.angular_velocity = omega};
    const FreeRotation rotation(inertia, start);
    for (const double turns : {0.0, 0.3, -1e3, 1e18}) {
      const Rotation r = rotation.at(turns * turn / omega.norm());
      BOOST_REQUIRE(r.angular_velocity.norm() <= rotation.largest_speed());
      BOOST_REQUIRE(std::fabs(r.attitude.norm() - 1) <= 2 * eps);
      const Vector3 momentum = inertia * omega, w = r.angular_velocity;
      const double energy = omega.dot(momentum);
      if (std::isnormal(energy)) BOOST_REQUIRE(std::fabs(w.dot(inertia * w) / energy - 1) <= 2 * tolerance);
      BOOST_REQUIRE((world_momentum(inertia, r) - momentum).stableNorm() <= tolerance * momentum.stableNorm());
    }
    BOOST_REQUIRE(rotation.at(1e300).attitude.coeffs().allFinite());
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_inertia_or_no_number_is_refused) {
  Matrix3 skewed = Matrix3::Identity();
  skewed(0, 1) = 0.1;
  for (const Matrix3& inertia :
       {diagonal({1, 2, 3.1}), diagonal({0, 1, 1}), diagonal({-1, 1, 1}), diagonal({1, NAN, 1}), skewed}) {
    BOOST_CHECK_THROW(FreeRotation(inertia, {}), std::domain_error);
  }
  const Matrix3 ball = Matrix3::Identity();
  for (const Rotation& start : {Rotation{.angular_velocity = {0, INFINITY, 0}},
                                {.attitude = Eigen::Quaterniond(0, 0, 0, 0)},
                                {.attitude = Eigen::Quaterniond(NAN, 0, 0, 0)}}) {
    BOOST_CHECK_THROW(FreeRotation(ball, start), std::domain_error);
  }
  CHECK_REFUSED(FreeRotation(ball, {}).at(NAN), std::domain_error);
}

using clatter::numeric::JacobiFunctions;
using clatter::test::eps;

BOOST_AUTO_TEST_CASE(where_the_modulus_tells_enough_the_functions_are_those_of_boost) {
  for (const double complement : {0.1, 0.3, 0.5, 0.75, 0.96, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const long double k = std::sqrt(1 - static_cast<long double>(complement));
    const double quarter = jacobi.quarter_period();
    BOOST_TEST(std::fabs(quarter - static_cast<double>(boost::math::ellint_1(k))) <= 4 * eps * quarter);
    for (double u = -quarter; u <= quarter; u += quarter / 64) {
      long double cn = 0, dn = 0;
      const long double sn = boost::math::jacobi_elliptic(k, static_cast<long double>(u), &cn, &dn);
      const auto values = jacobi.at(u);
      BOOST_TEST(std::fabs(values.sn - static_cast<double>(sn)) <= 4 * eps);
      BOOST_TEST(std::fabs(values.cn - static_cast<double>(cn)) <= 4 * eps);
      // Boost forms dn as a quotient of two cosines that vanish at K; the identity holds everywhere.
      if (std::fabs(values.cn) > 0.01) BOOST_TEST(std::fabs(values.dn - static_cast<double>(dn)) <= 4 * eps);
      const double square = values.cn * values.cn + complement * values.sn * values.sn;
      BOOST_TEST(std::fabs(values.dn * values.dn - square) <= 4 * eps * square);
    }
  }
}

BOOST_AUTO_TEST_CASE(next_to_the_separatrix_the_functions_are_hyperbolic_up_to_the_quarter_period) {
  // Corrections are of order k'² e^(2u); K = ln(4/k').
  for (const double complement : {1e-34, 1e-60, 1e-120, 1e-200}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = std::log(4) - std::log(complement) / 2;
    BOOST_TEST(std::fabs(jacobi.quarter_period() - quarter) <= 4 * eps * quarter);
    for (double u = -quarter / 2; u <= quarter / 2; u += quarter / 37) {
      const double tolerance = 4 * eps * quarter + complement * std::exp(2 * std::fabs(u));
      const auto values = jacobi.at(u);
      BOOST_TEST(std::fabs(values.sn - std::tanh(u)) <= tolerance);
      BOOST_TEST(std::fabs(values.cn * std::cosh(u) - 1) <= tolerance);
      BOOST_TEST(std::fabs(values.dn * std::cosh(u) - 1) <= tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_argument_is_the_inverse_of_the_functions) {
  for (const double complement : {1e-200, 1e-34, 1e-8, 0.3, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = jacobi.quarter_period();
    for (double u = -quarter; u <= quarter; u += quarter / 50) {
      const auto values = jacobi.at(u);
      const double back = jacobi.argument({.sine = values.sn, .cosine = values.cn});
      BOOST_TEST(std::fabs(back - u) <= 8 * eps * quarter);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_remaining_integral_is_that_of_its_integrand) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (const double complement : {1e-34, 1e-4, 0.3, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = jacobi.quarter_period();
    for (const double h : {0.0, 0.4, 50.0, 1e12}) {
      const auto integrand = [&](double u) {
        const auto v = jacobi.at(u);
        return v.cn * v.cn / (1 + h * v.sn * v.sn);
      };
      for (const double part : {0.0, 1e-3, 0.3, 0.9}) {
        if (h > 1e6 && part == 0) continue;  // a peak of width 1e-6, too sharp for the rule
        const double u = part * quarter;
        const double expected = Rule::integrate(integrand, u, quarter, 15, 1e-13);
        const double tolerance = 1e-12 * expected;  // of the quadrature
        BOOST_TEST(std::fabs(jacobi.remaining_integral(jacobi.at(u), h) - expected) <= tolerance);
        BOOST_TEST(jacobi.remaining_integral(jacobi.at(-u), h) == jacobi.remaining_integral(jacobi.at(u), h));
      }
    }
  }
}
