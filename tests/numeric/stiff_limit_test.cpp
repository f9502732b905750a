// SPDX-License-Identifier: GPL-3.0-or-later
// The stiff limit is the impulse of a rigid body at the real contact point.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

#include "tests/numeric/bodies.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// V_z after an elastic frictionless impulse at the point (d_t, ·) of a body that falls with −1:
///     V = −1 + P/m,   P = 2/(1/m + d_t²/I).
double rigid_velocity(double mass, double inertia, double arm) { return -1 + 2 / (1 + mass * arm * arm / inertia); }

double velocity_after(const Body& body, double angle, double stiffness) {
  const Simulation run = dropped(body, weightless({.stiffness = stiffness}), angle, 1, {.digits = 12});
  BOOST_REQUIRE(run.impacts.size() == 1);
  return run.impacts[0].value.velocity_after.z();
}

/// Neville's scheme at x = 0.
double extrapolate(std::vector<double> x, std::vector<double> y) {
  for (std::size_t level = 1; level < y.size(); ++level) {
    for (std::size_t i = 0; i + level < y.size(); ++i) {
      y[i] = (x[i + level] * y[i] - x[i] * y[i + 1]) / (x[i + level] - x[i]);
    }
  }
  return y[0];
}

struct Limit {
  double power;     ///< observed at the stiffest end
  double distance;  ///< of the extrapolated from the rigid velocity
};

/// k_G from `softest` to 1e13 in half decades, extrapolated in k^(−1/(p+1)) over the last `used`.
Limit limit(const Body& body, double angle, double rigid, double p, std::size_t used) {
  std::vector<double> x, y;
  for (double exponent = 6; exponent < 13.25; exponent += 0.5) {
    const double stiffness = std::pow(10, exponent);
    x.push_back(std::pow(stiffness, -1 / (p + 1)));
    y.push_back(velocity_after(body, angle, stiffness));
  }
  const std::size_t n = y.size();
  const double power = std::log10((y[n - 1] - rigid) / (y[n - 2] - rigid)) / 0.5;
  const auto from = static_cast<std::ptrdiff_t>(n - used);
  return {power, std::fabs(extrapolate({x.begin() + from, x.end()}, {y.begin() + from, y.end()}) - rigid)};
}

}  // namespace

/// The rim's lowest node is a corner as long as the depth stays below that of its neighbours: p = 3.  From 1e12 on it
/// does; the two stiffest runs alone extrapolate to 1e-6.
BOOST_AUTO_TEST_CASE(the_papers_rod_tends_to_the_impulse_at_its_rim) {
  const Body body = rod();
  const double angle = 45 * degree, r = 0.01;
  const double arm = 0.5 * std::cos(angle) - r * std::sin(angle);
  const Limit found = limit(body, angle, rigid_velocity(1, body.inertia()(1, 1), arm), 3, 2);
  BOOST_TEST(std::fabs(found.power + 0.25) <= 0.01);
  BOOST_TEST(found.distance <= 1e-6);
}

/// With four sectors the rim is a corner at every stiffness, and the gap a power series.
BOOST_AUTO_TEST_CASE(a_square_rod_tends_to_the_impulse_at_its_corner) {
  const Body body(rod_mesh({.sectors = 4, .rings = 1, .layers = 1}));
  const double angle = 45 * degree, r = 0.01;
  const double arm = 0.5 * std::cos(angle) - r * std::sin(angle);
  const Limit found = limit(body, angle, rigid_velocity(1, body.inertia()(1, 1), arm), 3, 6);
  BOOST_TEST(std::fabs(found.power + 0.25) <= 0.01);
  BOOST_TEST(found.distance <= 1e-11);
}

/// An edge: p = 2.
BOOST_AUTO_TEST_CASE(the_phone_tends_to_the_impulse_at_its_edge) {
  const Body body = phone();
  const double angle = 30 * degree;
  const Vector3 size = phone_size();
  const double arm = size.x() / 2 * std::cos(angle) - size.z() / 2 * std::sin(angle);
  const double inertia = phone_mass * (size.x() * size.x() + size.z() * size.z()) / 12;
  const Limit found = limit(body, angle, rigid_velocity(phone_mass, inertia, arm), 2, 6);
  BOOST_TEST(std::fabs(found.power + 1.0 / 3) <= 0.01);
  BOOST_TEST(found.distance <= 1e-11);
}
