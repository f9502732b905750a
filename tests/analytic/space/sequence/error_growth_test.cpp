// SPDX-License-Identifier: GPL-3.0-or-later
// How small changes of a drop grow until the next corner touches, against differences of flights that are stepped in
// long double.
#include "analytic/space/sequence/error_growth.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/space/flight/first_contact.hpp"

namespace {

using namespace clatter::analytic::space;

using Number = long double;
using Triple = Eigen::Matrix<Number, 3, 1>;
using Turn = Eigen::Quaternion<Number>;

constexpr double g = 9.81;
constexpr int departs = 0;

/// Attitude, velocity and angular velocity of a body that flies freely.
struct Flying {
  Turn attitude;
  Triple velocity, angular_velocity;
};

class SteppedFlight {
 public:
  explicit SteppedFlight(const Body& body) : body_(body), inertia_(body.inertia.cast<Number>()) {}

  /// The state when the vertex is on the ground, near `time`.
  [[nodiscard]] Flying at_touch(const Flying& start, int vertex, Number time) const {
    const Number begin = -height(start, departs, 0);
    for (int i = 0; i < 8; ++i) {
      const Flying s = after(start, time);
      const Triple arm = s.attitude * place(vertex);
      const Number rate = s.velocity.z() + s.angular_velocity.cross(arm).z();
      time -= (begin + rise(start, time) + height(s, vertex, 0)) / rate;
    }
    return after(start, time);
  }

 private:
  [[nodiscard]] Triple place(int vertex) const { return body_.vertices[vertex].cast<Number>(); }
  [[nodiscard]] Number height(const Flying& s, int vertex, Number centre) const {
    return centre + (s.attitude * place(vertex)).z();
  }
  static Number rise(const Flying& start, Number time) { return start.velocity.z() * time - g * time * time / 2; }

  using Rotation = Eigen::Matrix<Number, 7, 1>;
  /// q′ = (0, ω) q/2 and Euler's equations, in body axes.
  [[nodiscard]] Rotation rate(const Rotation& y) const {
    const Turn q(y[0], y[1], y[2], y[3]);
    const Triple w = y.tail<3>(), momentum = inertia_ * w;
    const Turn change = q * Turn(0, w.x(), w.y(), w.z());
    Rotation result;
    result << change.w() / 2, change.vec() / 2, inertia_.inverse() * momentum.cross(w);
    return result;
  }
  [[nodiscard]] Flying after(const Flying& start, Number time) const {
    constexpr int steps = 1500;
    const Number h = time / steps;
    Rotation y;
    y << start.attitude.w(), start.attitude.vec(), start.attitude.conjugate() * start.angular_velocity;
    for (int i = 0; i < steps; ++i) {
      const Rotation a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b), d = rate(y + h * c);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
    const Turn q = Turn(y[0], y[1], y[2], y[3]).normalized();
    return {q, start.velocity - Triple(0, 0, g * time), q * Triple(y.tail<3>())};
  }

  const Body& body_;
  Eigen::Matrix<Number, 3, 3> inertia_;
};

Flying flying(const State& s) {
  return {s.attitude.cast<Number>(), s.velocity.cast<Number>(), s.angular_velocity.cast<Number>()};
}

Flying changed(Flying s, int number, Number step) {
  const Triple along = step * Triple::Unit(number % 3);
  if (number < 3) s.attitude = (Turn(1, along.x() / 2, along.y() / 2, along.z() / 2) * s.attitude).normalized();
  else (number < 6 ? s.velocity : s.angular_velocity) += along;
  return s;
}

/// Changes at the touch per change of the drop's attitude and, relative, of its velocities: three blocks of rows.
Eigen::Matrix<double, 9, 9> differences(const Body& body, const State& start, const FirstContact& contact) {
  const SteppedFlight flight(body);
  Eigen::Matrix<double, 9, 9> result;
  const double sizes[3] = {1, start.velocity.norm(), start.angular_velocity.norm()};
  for (int k = 0; k < 9; ++k) {
    constexpr Number step = 1e-5L;
    const auto moved = [&](Number by) {
      return flight.at_touch(changed(flying(start), k, by * sizes[k / 3]), contact.point, contact.time);
    };
    const Flying more = moved(step), less = moved(-step);
    Turn turn = more.attitude * less.attitude.conjugate();
    if (turn.w() < 0) turn.coeffs() *= -1;
    result.col(k) << (2 * turn.vec() / (2 * step)).cast<double>(),
        ((more.velocity - less.velocity) / (2 * step)).cast<double>(),
        ((more.angular_velocity - less.angular_velocity) / (2 * step)).cast<double>();
  }
  return result;
}

/// An impact the impulse of which is one of the state's vectors at the touch, made so small that its relative change is
/// the row's amplification.
double amplification(ErrorGrowth growth, const FreeFlight& flight, const FirstContact& contact, int block) {
  ImpactRow row;
  row.start = contact.time;
  row.before = flight.at(contact.time);
  row.corners = {{.index = contact.point}};
  row.flight = contact;
  row.impact.approach_speed = 1;
  row.impact.impulse = {0, 0, 1e-9};
  StrikeDerivatives derivatives = StrikeDerivatives::Zero();
  derivatives.block<3, 3>(0, 3 * block).setIdentity();
  growth.strike([&](const State&) { return row.impact; }, derivatives, row);
  return row.amplification * 1e-9;
}

}  // namespace

BOOST_AUTO_TEST_CASE(changes_of_a_drop_grow_until_the_next_touch_as_flights_do_that_are_stepped) {
  // No two moments are equal: the angular velocity changes in flight, so that a later touch finds another one.
  const Body body = box(0.3, {.size = {0.3, 0.2, 0.1}, .centre = {0.01, -0.02, 0.005}});
  const std::array<Vector3, 3> turnings{Vector3(9, -7, 6), Vector3(-5, 12, -8), Vector3(14, 6, -3)};
  for (const Vector3& turning : turnings) {
    State start;
    start.attitude = Quaternion::FromTwoVectors(body.vertices[departs] + Vector3(0.03, -0.02, 0.04), -Vector3::UnitZ());
    const Vector3 arm = start.attitude * body.vertices[departs];
    start.position.z() = -arm.z();
    start.angular_velocity = turning;
    start.velocity = {0.3, -0.2, 0.8 - turning.cross(arm).z()};
    const PrincipalAxes principal(body.inertia);
    const FreeFlight flight(principal, start, g);
    const Touch touch{departs, 0.8};
    const FirstContact contact = first_contact(body, flight, {&touch, 1});
    BOOST_REQUIRE(contact.end == clatter::analytic::FlightEnd::contact);
    ErrorGrowth growth(body, start, g);
    growth.fly(flight, contact, body.vertices[departs], body.vertices[contact.point]);
    BOOST_TEST_REQUIRE(growth.predictable());
    const auto expected = differences(body, start, contact);
    for (int block = 0; block < 3; ++block) {
      BOOST_TEST_CONTEXT("turning " << turning.transpose() << ", block " << block) {
        const double size = expected.middleRows<3>(3 * block).norm();
        // The differences are of the second order in steps of 1e-5.
        BOOST_TEST(std::fabs(amplification(growth, flight, contact, block) - size) <= 1e-7 * size);
      }
    }
  }
}
