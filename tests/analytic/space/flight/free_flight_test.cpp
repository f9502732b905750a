// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/free_flight.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "validation/oracles/free_top.hpp"

namespace {

using namespace clatter::analytic::space;
__extension__ typedef __float128 Quad;

struct Case {
  Vector3 moments;
  Vector3 velocity;  ///< principal axes
};

/// (1, 2, 2, 4)/5 is unit but for rounding.
const Quaternion start(0.2, 0.4, 0.4, 0.8);

clatter::oracle::Top<Quad> top_of(const Case& c) {
  clatter::oracle::Top<Quad> top;
  const Quaternion& q = start;
  const double parts[4] = {q.w(), q.x(), q.y(), q.z()};
  Quad square = 0;
  for (const double part : parts) square += Quad(part) * Quad(part);
  Quad inverse = 1;  // square is 1 to rounding: Newton for 1/√square
  for (int i = 0; i < 4; ++i) inverse = inverse * (3 - square * inverse * inverse) / 2;
  for (std::size_t k = 0; k < 4; ++k) top.q[k] = Quad(parts[k]) * inverse;
  for (int k = 0; k < 3; ++k) {
    top.moments[k] = c.moments[k];
    top.w[k] = c.velocity[k];
  }
  return top;
}

FreeRotation rotation_of(const Case& c) {
  // World components in double are not exactly A ω; the identity would be, so the attitude is applied afterwards.
  return {PrincipalAxes(Matrix3(c.moments.asDiagonal())), Quaternion::Identity(), c.velocity};
}

/// Largest difference of two attitudes' Euler parameters, the sign being free.
double difference(const Quaternion& p, const Quaternion& q) {
  return std::fmin((p.coeffs() - q.coeffs()).norm(), (p.coeffs() + q.coeffs()).norm());
}

/// Attitude by Taylor series in quadruple precision.
Quaternion series_attitude(const Case& c, double time, double turns, double step_angle, int order) {
  clatter::oracle::Top<Quad> top = top_of(c);
  clatter::oracle::TopSeries<Quad> series(order);
  const auto steps = static_cast<int>(std::ceil(turns * 2 * std::numbers::pi / step_angle));
  const Quad h = Quad(time) / steps;
  for (int i = 0; i < steps; ++i) series.step(top, h);
  const Quaternion q(static_cast<double>(top.q[0]), static_cast<double>(top.q[1]), static_cast<double>(top.q[2]),
                     static_cast<double>(top.q[3]));
  return q.normalized();
}

double time_of(const Case& c, double turns) { return turns * 2 * std::numbers::pi / c.velocity.norm(); }

double error_after(const Case& c, double turns, double step_angle, int order) {
  const double time = time_of(c, turns);
  return difference(start * rotation_of(c).attitude(time), series_attitude(c, time, turns, step_angle, order));
}

/// How far an ulp of one of the velocities moves the attitude, by the series.
double moved_by_an_ulp(const Case& c, double turns) {
  const double time = time_of(c, turns);
  const Quaternion base = series_attitude(c, time, turns, 0.5, 36);
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    Case other = c;
    other.velocity[k] *= 1 + 0x1p-52;
    most = std::fmax(most, difference(base, series_attitude(other, time, turns, 0.5, 36)));
  }
  return most;
}

const Case cases[] = {
    {{1, 2, 2.5}, {0.3, 0.2, 1}},      {{1, 2, 2.5}, {1, 0.2, 0.3}},     {{1, 2, 2.5}, {0.3, -1, -0.2}},
    {{2.5, 1, 2}, {-0.7, 0.4, 0.9}},   {{1, 1, 1.5}, {0.4, 0.1, 0.9}},   {{0.1, 1, 1}, {2, 0.3, -0.4}},
    {{0.01, 1, 1.005}, {3, 0.3, 0.4}}, {{0.4, 0.6, 1}, {0.5, 0.5, 0.5}}, {{1, 1 + 1e-9, 1 + 2e-9}, {0.4, 0.3, 0.9}},
    {{1, 1, 1}, {0.4, -0.3, 0.9}},     {{1, 2, 2.5}, {0, 0, -1.5}},      {{1, 2, 2.5}, {1e-9, 1e-8, 1}},
    {{1, 2, 2.5}, {1, 1e-8, 1e-9}},    {{1, 2, 2.5}, {1e-3, 1, 1e-3}},   {{1, 2, 2.5}, {1e-6, 1, 1e-7}},
    {{1, 1.6, 2.2}, {0.3, 0.5, 0.31}},
};

}  // namespace

BOOST_AUTO_TEST_CASE(the_attitude_after_1000_turns_is_that_of_a_taylor_series_in_quadruple_precision) {
  for (const Case& c : {cases[0], cases[6]}) BOOST_TEST(error_after(c, 1000, 0.75, 44) <= 1e-13);
}

BOOST_AUTO_TEST_CASE(for_every_inertia_ratio_and_near_the_separatrix_the_attitude_is_that_of_a_taylor_series) {
  for (const Case& c : cases) BOOST_TEST(error_after(c, 30, 0.5, 36) <= 1e-13);
}

/// There the axis falls over at a time that the last digits of the start decide.
BOOST_AUTO_TEST_CASE(closer_to_the_separatrix_than_1e_10_the_attitude_errs_less_than_an_ulp_of_the_start_moves_it) {
  const double level = 0.3 / std::sqrt(2.5 * 0.5);  // with ω₁ = 0.3, on the separatrix of moments 1, 2, 2.5 to rounding
  const Case near[] = {{{1, 2, 2.5}, {1e-11, 1, 1e-12}},
                       {{1, 2, 2.5}, {1e-12, 1, -3e-12}},
                       {{1, 2, 2.5}, {1e-15, 1, 1e-14}},
                       {{1, 2, 2.5}, {0.3, 0.4, level}},
                       {{1, 2, 2.5}, {0.3, 0.4, level * (1 + 1e-12)}}};
  for (const Case& c : near) {
    for (const double turns : {1.0, 10.0}) {
      BOOST_TEST_CONTEXT(c.velocity.transpose() << ", " << turns << " turns") {
        BOOST_TEST(error_after(c, turns, 0.5, 36) <= 1e-13 + moved_by_an_ulp(c, turns));
      }
    }
  }
}
