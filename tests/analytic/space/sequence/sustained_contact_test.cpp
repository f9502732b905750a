// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that turn on a corner or an edge, against quadratures of their energy, conserved quantities and the equation
// of motion of a rod in its plane.
#include "analytic/space/sequence/sustained_contact.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "analytic/space/sequence/sequence.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::FrictionKind;

constexpr double g = 9.81;

double integral(const auto& f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(f, from, to, 12, 1e-14);
}

Drop drop_of(const Body& body, double friction) {
  Drop drop;
  drop.body = body;
  drop.gravity = g;
  drop.law.restitution = 0.5;
  if (friction > 0) drop.law.friction = FrictionKind::coulomb, drop.law.friction_value = friction;
  return drop;
}

/// The state in which the vertex is at rest but for the slip.
State standing(const Body& body, const Quaternion& attitude, int vertex, const Vector3& turning,
               const Vector3& slip = Vector3::Zero()) {
  const Vector3 arm = attitude * body.vertices[vertex];
  return {.position = {0, 0, -arm.z()},
          .attitude = attitude,
          .velocity = slip - turning.cross(arm),
          .angular_velocity = turning};
}

int lowest_vertex(const Body& body, const Quaternion& attitude) {
  const auto height = [&](const Vector3& place) { return (attitude * place).z(); };
  return static_cast<int>(std::ranges::min_element(body.vertices, {}, height) - body.vertices.begin());
}

double energy(const Drop& drop, const State& s) {
  const Vector3 w = s.attitude.conjugate() * s.angular_velocity;
  return drop.body.mass * (s.velocity.squaredNorm() / 2 + g * s.position.z()) + w.dot(drop.body.inertia * w) / 2;
}

Vector3 angular_momentum(const Drop& drop, const State& s) {
  return s.attitude * (drop.body.inertia * (s.attitude.conjugate() * s.angular_velocity));
}

/// A thin rod at this inclination, its lower end, vertex 0, on the ground; it falls over with ω_y < 0.
constexpr double length = 0.4;
Body rod() { return cylinder(0.3, {.length = length}); }
Quaternion inclined(double angle) { return Quaternion(Eigen::AngleAxisd(-angle, Vector3::UnitY())); }

/// A box that turns about its edge at −x, −z, vertices 0 and 2, without slip: its rate by its energy.
struct RockingBox {
  double lifted, spin;  ///< at the beginning
  Drop drop = drop_of(box(1, {.size = {0.3, 0.2, 0.1}}), 1000);
  double d = std::hypot(0.15, 0.05), inertia = (0.09 + 0.01) / 12 + d * d;
  double rest = std::atan2(0.05, 0.15), begin = rest + lifted;  ///< of the centre, above the edge

  [[nodiscard]] State state() const { return standing(drop.body, inclined(lifted), 0, {0, spin, 0}); }
  [[nodiscard]] double rate(double angle) const {
    return std::sqrt(spin * spin + 2 * g * d / inertia * (std::sin(begin) - std::sin(angle)));
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_that_rocks_on_an_edge_comes_down_when_the_quadrature_of_its_energy_says) {
  for (const double lifted : {0.02, 0.3, 0.9}) {
    const RockingBox b{.lifted = lifted, .spin = 0.5};
    const SustainedContact contact = follow_contact(b.drop, b.state(), {0, 2});
    BOOST_TEST_CONTEXT("lifted by " << lifted) {
      BOOST_CHECK(contact.end == ContactEnd::arrival);
      BOOST_TEST(contact.arriving == (std::vector<int>{4, 6}), boost::test_tools::per_element());
      BOOST_TEST(contact.sticks);
      const double time = integral([&](double angle) { return 1 / b.rate(angle); }, b.rest, b.begin);
      BOOST_TEST(std::fabs(contact.duration - time) <= 1e-11 * time);
      BOOST_TEST((contact.after.angular_velocity - Vector3(0, b.rate(b.rest), 0)).norm() <= 1e-10);
      BOOST_TEST(std::fabs(energy(b.drop, b.state()) - energy(b.drop, contact.after)) <= 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_landing_of_a_rocking_box_changes_with_its_start_as_its_energy_says) {
  for (const double spin : {0.2, 0.5, 3.0}) {
    const RockingBox b{.lifted = 0.3, .spin = spin};
    const auto slopes = contact_derivatives(b.drop, b.state(), follow_contact(b.drop, b.state(), {0, 2}),
                                            {.attitude = 1e-12, .velocity = 1e-12, .angular_velocity = 1e-12});
    BOOST_TEST_REQUIRE(slopes.has_value());
    constexpr int pitch = 2, turning = 8;  // about y, behind the time
    const double time = -integral([&](double angle) { return spin / std::pow(b.rate(angle), 3); }, b.rest, b.begin);
    BOOST_TEST_CONTEXT("spin " << spin) {
      BOOST_TEST(std::fabs(slopes->of_state(turning, turning) - spin / b.rate(b.rest)) <= 1e-7);
      BOOST_TEST(std::fabs(slopes->of_state(0, turning) - time) <= 1e-7 * std::fabs(time));
      BOOST_TEST(std::fabs(slopes->of_state(pitch, turning)) <= 1e-7);  // it lands flat whatever the start
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rod_that_slides_without_friction_falls_as_its_energy_says) {
  const Drop drop = drop_of(rod(), 0);
  const double m = 0.3, half = length / 2, inertia = m * length * length / 12, begin = 1.1;
  const SustainedContact contact = follow_contact(drop, standing(drop.body, inclined(begin), 0, {0, 0, 0}), {0});
  const auto rate = [&](double angle) {
    const double moving = inertia + m * half * half * std::cos(angle) * std::cos(angle);
    return std::sqrt(2 * m * g * half * (std::sin(begin) - std::sin(angle)) / moving);
  };
  BOOST_CHECK(contact.end == ContactEnd::arrival);
  // angle = begin − x²: without the root at the start.
  const double time = integral([&](double x) { return 2 * x / rate(begin - x * x); }, 1e-7, std::sqrt(begin)) +
                      1e-7 * 2 /
                          std::sqrt(2 * m * g * half * std::cos(begin) /
                                    (inertia + m * half * half * std::cos(begin) * std::cos(begin)));
  BOOST_TEST(std::fabs(contact.duration - time) <= 1e-9 * time);
  BOOST_TEST((contact.after.angular_velocity - Vector3(0, rate(0), 0)).norm() <= 1e-9);
  BOOST_TEST(contact.after.velocity.head<2>().norm() <= 1e-11);
}

BOOST_AUTO_TEST_CASE(a_rod_that_slides_with_friction_moves_by_its_equation_in_the_plane) {
  const double m = 0.3, half = length / 2, inertia = m * length * length / 12, mu = 0.2;
  const Drop drop = drop_of(rod(), mu);
  for (const double slip : {2.0, -2.0}) {
    // (angle, rate upwards, slip); with the end at (−half cos, −half sin) from the centre the ground pushes with N and
    // −μ N sgn(slip): m z″ = N − m g, z = half sin, I angle″ = −N half cos + F half sin.
    std::array<double, 4> y{1.0, 0, slip, 0};
    const double s = slip > 0 ? 1 : -1;
    const auto derivative = [&](const std::array<double, 4>& v) {
      const double c = std::cos(v[0]), n = std::sin(v[0]), w = v[1];
      const double lever = half * (c + s * mu * n);  // angle″ = −N lever/I
      const double push = m * (g - half * n * w * w) / (1 + m * half * c * lever / inertia);
      const double a = -push * lever / inertia;
      // x of the end: x_c − half cos angle.
      const double end = -s * mu * push / m + half * (n * a + c * w * w);
      return std::array<double, 4>{w, a, end, 0};
    };
    const SustainedContact contact =
        follow_contact(drop, standing(drop.body, inclined(1.0), 0, {0, 0, 0}, {slip, 0, 0}), {0});
    const int steps = 20000;
    const double h = contact.duration / steps;
    for (int i = 0; i < steps; ++i) {
      const auto along = [&](const std::array<double, 4>& k, double t) {
        std::array<double, 4> z{};
        for (std::size_t j = 0; j < 4; ++j) z[j] = y[j] + t * k[j];
        return z;
      };
      const auto k1 = derivative(y), k2 = derivative(along(k1, h / 2)), k3 = derivative(along(k2, h / 2)),
                 k4 = derivative(along(k3, h));
      for (std::size_t j = 0; j < 4; ++j) y[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
    }
    BOOST_TEST_CONTEXT("slip " << slip) {
      BOOST_CHECK(contact.end == ContactEnd::arrival);
      BOOST_TEST(contact.slips);
      BOOST_TEST(!contact.sticks);
      BOOST_TEST(std::fabs(y[0]) <= 1e-11);
      BOOST_TEST(std::fabs(y[1] + contact.after.angular_velocity.y()) <= 1e-9);
      const Vector3 end =
          contact.after.velocity + contact.after.angular_velocity.cross(contact.after.attitude * drop.body.vertices[0]);
      BOOST_TEST(std::fabs(y[2] - end.x()) <= 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_body_that_turns_on_a_corner_keeps_its_energy_and_what_no_force_has_a_couple_about) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const Body body = box(0.7, {.size = {0.3, 0.2, 0.12}});
  int arrivals = 0;
  for (int n = 0; n < 60; ++n) {
    const Drop drop = drop_of(body, n % 2 == 0 ? 0 : 1000);  // without friction, or held
    const Quaternion attitude = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
    const int lowest = lowest_vertex(body, attitude);
    const Vector3 turning(normal(random), normal(random), normal(random));
    const State s = standing(body, attitude, lowest, turning);
    const SustainedContact contact = follow_contact(drop, s, {lowest});
    const bool lifts_by_sliding = n % 2 == 1 && contact.slips;  // when next to no force is left to hold it
    if (contact.end == ContactEnd::open || lifts_by_sliding) continue;
    arrivals += contact.end == ContactEnd::arrival ? 1 : 0;
    const State& end = contact.after;
    BOOST_TEST_CONTEXT("body " << n) {
      BOOST_TEST(std::fabs(energy(drop, s) - energy(drop, end)) <= 1e-11);
      const bool held = drop.law.friction == FrictionKind::coulomb;
      const auto about_vertical = [&](const State& at) {
        const Vector3 arm = at.attitude * body.vertices[lowest];
        const Vector3 orbital = held ? Vector3(body.mass * (-arm).cross(at.velocity)) : Vector3(Vector3::Zero());
        return (angular_momentum(drop, at) + orbital).z();
      };
      BOOST_TEST(std::fabs(about_vertical(s) - about_vertical(end)) <= 1e-12);
      if (!held) BOOST_TEST((s.velocity - end.velocity).head<2>().norm() <= 1e-11);
    }
  }
  BOOST_TEST(arrivals > 40);
}

BOOST_AUTO_TEST_CASE(ends_of_contacts_change_within_their_errors_when_their_beginning_does) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal;
  const Body body = box(0.7, {.size = {0.3, 0.2, 0.12}});
  int judged = 0;
  for (int n = 0; n < 40; ++n) {
    const Drop drop = drop_of(body, n % 2 == 0 ? 0 : 0.3);
    const Quaternion attitude = Quaternion(1, 0.3 * normal(random), 0.3 * normal(random), normal(random)).normalized();
    const int lowest = lowest_vertex(body, attitude);
    const Vector3 slip(normal(random), normal(random), 0), turning(normal(random), normal(random), normal(random));
    const double size = 1e-9;
    const StateErrors errors{.time = 0, .attitude = size, .velocity = size, .angular_velocity = size};
    const State s = standing(body, attitude, lowest, turning, slip);
    const SustainedContact contact = follow_contact(drop, s, {lowest}, errors);
    if (!std::isfinite(contact.error.velocity)) continue;
    const Vector3 other = turning + size * Vector3(normal(random), normal(random), normal(random)).normalized();
    const SustainedContact near = follow_contact(drop, standing(body, attitude, lowest, other, slip), {lowest});
    ++judged;
    BOOST_TEST(std::fabs(near.duration - contact.duration) <= contact.error.time);
    BOOST_TEST((near.after.velocity - contact.after.velocity).norm() <= contact.error.velocity);
    BOOST_TEST((near.after.angular_velocity - contact.after.angular_velocity).norm() <= contact.error.angular_velocity);
    BOOST_TEST(contact.error.velocity <= 1e3 * size);
  }
  BOOST_TEST(judged > 30);
}

BOOST_AUTO_TEST_CASE(
    contacts_in_which_slip_begins_change_within_their_errors_when_their_beginning_does_by_next_to_nothing) {
  // What starts of slip compute wrong is no smooth function of the beginning, and shows between neighbours.
  constexpr int wanted = CLATTER_TEST_SLOW_BUILD ? 30 : 300;
  Matrix3 skew;
  skew << 3.5e-3, 4e-4, -3e-4, 4e-4, 6e-3, 5e-4, -3e-4, 5e-4, 8e-3;
  const Body body = polyhedron(box(1, {.size = {0.3, 0.2, 0.12}}).vertices,
                               {.mass = 0.7, .centre = {0.02, 0.03, 0.01}, .inertia = skew});
  std::mt19937_64 random(19);
  std::normal_distribution<double> normal;
  int judged = 0, known = 0, within = 0;
  for (int n = 0; judged < wanted && n < 20 * wanted; ++n) {
    const Drop drop = drop_of(body, 0.2 + 0.1 * (n % 11));
    const Quaternion attitude = Quaternion(1, 0.4 * normal(random), 0.4 * normal(random), normal(random)).normalized();
    const int lowest = lowest_vertex(body, attitude);
    const Vector3 turning(3 * normal(random), 3 * normal(random), 3 * normal(random));
    const Vector3 slip = n % 3 == 0 ? Vector3(0.3 * normal(random), 0.3 * normal(random), 0) : Vector3(0, 0, 0);
    const double size = n % 2 == 0 ? 1e-12 : 1e-13;
    const StateErrors errors{.time = 0, .attitude = size, .velocity = size, .angular_velocity = size};
    const State s = standing(body, attitude, lowest, turning, slip);
    const SustainedContact contact = follow_contact(drop, s, {lowest}, errors);
    const bool begins = contact.slips && (contact.sticks || slip == Vector3::Zero());
    if (!begins || contact.end == ContactEnd::open || !(contact.duration > 1e-3)) continue;
    ++judged;
    if (!std::isfinite(contact.error.time)) continue;
    ++known;
    const Vector3 kick = size * Vector3(normal(random), normal(random), normal(random)).normalized();
    const SustainedContact near =
        follow_contact(drop, standing(body, attitude, lowest, turning + kick, slip), {lowest});
    const bool as_said =
        near.end == contact.end && std::fabs(near.duration - contact.duration) <= contact.error.time &&
        (near.after.velocity - contact.after.velocity).norm() <= contact.error.velocity &&
        (near.after.angular_velocity - contact.after.angular_velocity).norm() <= contact.error.angular_velocity;
    within += as_said ? 1 : 0;
  }
  BOOST_TEST(judged == wanted);
  BOOST_TEST(known >= 0.8 * judged);
  BOOST_TEST(within >= 0.99 * known);
  BOOST_TEST_MESSAGE(judged << " contacts, " << known << " with errors known, " << within << " within");
}

namespace {

/// A corner on the ground by Newton's and Euler's equations, in steps of fourth order: held, or with friction against
/// its slip.
struct PlainContact {
  Body body;
  Vector3 place;
  double friction;
  Quaternion attitude;
  Vector3 turning, slip;
  bool held = true;

  struct Rates {
    Vector3 turning, slip, force;
  };
  [[nodiscard]] Rates rates(const Quaternion& q, const Vector3& w, const Vector3& u) const {
    const Matrix3 axes = q.toRotationMatrix(), inertia = axes * body.inertia * axes.transpose();
    const Matrix3 inverse = inertia.inverse();
    const Vector3 r = axes * place, free = -inverse * w.cross(inertia * w);
    const Vector3 rest = Vector3(0, 0, -g) + free.cross(r) + w.cross(w.cross(r));
    const auto gained = [&](const Vector3& f) -> Vector3 { return f / body.mass + (inverse * r.cross(f)).cross(r); };
    Vector3 force;
    if (held) {
      Matrix3 all;
      all << gained(Vector3::UnitX()), gained(Vector3::UnitY()), gained(Vector3::UnitZ());
      force = all.fullPivLu().solve(-rest);
    } else {
      const Vector3 direction = Vector3::UnitZ() - friction * u.normalized();
      force = -rest.z() / gained(direction).z() * direction;
    }
    return {free + inverse * r.cross(force), rest + gained(force), force};
  }
  [[nodiscard]] double friction_left() const {
    const Vector3 force = rates(attitude, turning, slip).force;
    return friction * force.z() - force.head<2>().norm();
  }
  void step(double h) {
    const auto turned = [](const Quaternion& q, const Vector3& w, double t) {
      Quaternion change = Quaternion(0, w.x(), w.y(), w.z()) * q;
      change.coeffs() = q.coeffs() + t / 2 * change.coeffs();
      return change.normalized();
    };
    const Rates a = rates(attitude, turning, slip);
    const Vector3 w2 = turning + h / 2 * a.turning;
    const Rates b = rates(turned(attitude, turning, h / 2), w2, slip + h / 2 * a.slip);
    const Vector3 w3 = turning + h / 2 * b.turning;
    const Rates c = rates(turned(attitude, w2, h / 2), w3, slip + h / 2 * b.slip);
    const Vector3 w4 = turning + h * c.turning;
    const Rates d = rates(turned(attitude, w3, h), w4, slip + h * c.slip);
    attitude = turned(attitude, (turning + 2 * w2 + 2 * w3 + w4) / 6, h);
    turning += h / 6 * (a.turning + 2 * b.turning + 2 * c.turning + d.turning);
    if (!held) slip += h / 6 * (a.slip + 2 * b.slip + 2 * c.slip + d.slip);
  }
};

/// Goes on to where friction gives way, and returns when that is.
double let_go(PlainContact& plain) {
  double time = 0;
  const double coarse = 1e-5;
  while (plain.friction_left() > 0) plain.step(coarse), time += coarse;
  for (double back = coarse / 2; back > 1e-15; back /= 2) {
    PlainContact earlier = plain;
    earlier.step(-back);
    if (!(earlier.friction_left() > 0)) plain = earlier, time -= back;
  }
  const Vector3 force = plain.rates(plain.attitude, plain.turning, plain.slip).force;
  plain.held = false;
  plain.slip = -1e-8 * Vector3(force.x(), force.y(), 0).normalized();
  return time;
}

/// Whether slip goes on until `end`.
bool slide_until(PlainContact& plain, double& time, double end) {
  while (time < end && plain.slip.norm() > 5e-9) {
    const double h = std::fmin(std::fmin(2e-4, 0.05 * plain.slip.norm()), end - time);
    plain.step(h);
    time += h;
  }
  return !(time < end);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_contact_that_ends_soon_after_slip_began_has_moved_as_one_that_goes_on) {
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  const Body body = box(0.7, {.size = {0.3, 0.2, 0.12}});
  int judged = 0;
  constexpr int wanted = CLATTER_TEST_SLOW_BUILD ? 15 : 150;
  for (int n = 0; n < 200 && judged < wanted; ++n) {
    const Quaternion attitude = Quaternion(1, 0.4 * normal(random), 0.4 * normal(random), normal(random)).normalized();
    const int lowest = lowest_vertex(body, attitude);
    const State s = standing(body, attitude, lowest, Vector3(normal(random), normal(random), normal(random)));
    const Vector3 place = body.vertices[lowest];
    PlainContact plain{body, place, 0.35, s.attitude, s.angular_velocity, Vector3::Zero()};
    if (!(plain.friction_left() > 0)) continue;
    const SustainedContact whole = follow_contact(drop_of(body, 0.35), s, {lowest});
    if (!whole.sticks || !whole.slips || whole.pivots.size() > 1) continue;
    const double begin = let_go(plain);
    double time = begin;
    for (double later = 1e-4; later < 0.05; later *= 1.2) {
      if (begin + later > whole.duration || !slide_until(plain, time, begin + later)) break;
      // A corner more that comes down then.
      const Vector3 aside = Vector3(plain.turning.y(), -plain.turning.x(), 0).normalized();
      Body longer = body;
      longer.vertices.push_back(place + plain.attitude.conjugate() * (0.1 * aside));
      if (!((s.attitude * (longer.vertices.back() - place)).z() > 1e-3)) continue;
      const SustainedContact contact = follow_contact(drop_of(longer, 0.35), s, {lowest});
      if (contact.arriving != std::vector<int>{8}) continue;
      ++judged;
      BOOST_TEST_CONTEXT("body " << n << ", " << later << " s after slip began") {
        BOOST_TEST(std::fabs(contact.duration - time) <= 1e-6);
        BOOST_TEST((plain.turning - contact.after.angular_velocity).norm() <= 1e-5);
      }
    }
  }
  BOOST_TEST(judged > 2 * wanted / 3);
}

BOOST_AUTO_TEST_CASE(slip_that_begins_where_friction_gives_way_is_that_of_short_steps_from_next_to_nothing) {
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  const Body body = box(0.7, {.size = {0.3, 0.2, 0.12}});
  int judged = 0;
  for (int n = 0; n < 200 && judged < 6; ++n) {
    const Drop drop = drop_of(body, 0.35);
    const Quaternion attitude = Quaternion(1, 0.4 * normal(random), 0.4 * normal(random), normal(random)).normalized();
    const int lowest = lowest_vertex(body, attitude);
    const State s = standing(body, attitude, lowest, Vector3(normal(random), normal(random), normal(random)));
    PlainContact plain{body, body.vertices[lowest], 0.35, s.attitude, s.angular_velocity, Vector3::Zero()};
    if (!(plain.friction_left() > 0)) continue;
    const SustainedContact contact = follow_contact(drop, s, {lowest});
    if (!contact.sticks || !contact.slips || contact.pivots.size() > 1) continue;
    double time = let_go(plain);
    if (!slide_until(plain, time, contact.duration)) continue;
    ++judged;
    BOOST_TEST_CONTEXT("body " << n << ", slip " << plain.slip.norm()) {
      BOOST_TEST(plain.attitude.angularDistance(contact.after.attitude) <= 1e-7);
      BOOST_TEST((plain.turning - contact.after.angular_velocity).norm() <= 1e-6);
      const Vector3 slip =
          contact.after.velocity + contact.after.angular_velocity.cross(contact.after.attitude * plain.place);
      BOOST_TEST((plain.slip - slip).norm() <= 2e-7);
    }
  }
  BOOST_TEST(judged == 6);
}

BOOST_AUTO_TEST_CASE(slip_that_begins_on_an_edge_is_the_limit_of_friction_that_grows_with_slip) {
  // Newton's and Euler's equations of two points with friction −μ N u/√(u² + δ²), by an implicit method of another
  // code, δ = 1e-6 and 1e-7 m/s extrapolated; five digits.
  const Body uniform = box(0.7, {.size = {0.3, 0.2, 0.12}});
  Matrix3 skew;
  skew << 3.5e-3, 4e-4, -3e-4, 4e-4, 6e-3, 5e-4, -3e-4, 5e-4, 8e-3;
  const Body uneven = polyhedron(box(1, {.size = {0.3, 0.2, 0.12}}).vertices,
                                 {.mass = 0.7, .centre = {0.02, 0.03, 0.01}, .inertia = skew});
  struct Row {
    const Body& body;
    double friction, spin;
    bool sticks;
    double duration;
    Vector3 turning, velocity;
  };
  const Row rows[] = {
      {uniform, 0.3, 0, false, 0.209439, {0, 6.782268, 0}, {0.311177, 0, -1.017340}},
      {uniform, 0.4, 0, true, 0.232530, {0, 6.679147, 0}, {0.460755, 0, -1.001872}},
      {uniform, 0.3, 4, true, 0.122707, {0, 7.578831, 0}, {0.616666, 0, -1.136825}},
      {uneven, 0.3, 0, false, 0.207863, {0.388391, 6.616740, -0.411670}, {0.271807, -0.027331, -1.126782}},
      {uneven, 0.4, 0, true, 0.234601, {0.317959, 6.449649, -0.198402}, {0.465443, -0.055761, -1.097772}},
      {uneven, 0.4, 4, true, 0.125247, {0.005915, 7.328203, 0.048764}, {0.698075, -0.001336, -1.245795}},
  };
  for (const Row& row : rows) {
    const Drop drop = drop_of(row.body, row.friction);
    const SustainedContact contact =
        follow_contact(drop, standing(row.body, inclined(0.7), 0, {0, row.spin, 0}), {0, 2});
    BOOST_TEST_CONTEXT("μ " << row.friction << ", spin " << row.spin) {
      BOOST_CHECK(contact.end == ContactEnd::arrival);
      BOOST_TEST(contact.slips);
      BOOST_TEST(contact.sticks == row.sticks);
      BOOST_TEST(std::fabs(contact.duration - row.duration) <= 5e-6);
      BOOST_TEST((contact.after.angular_velocity - row.turning).norm() <= 1e-4);
      BOOST_TEST((contact.after.velocity - row.velocity).norm() <= 2e-5);
    }
  }
}

namespace {

/// A box of 1 kg that turns on an edge in the plane across it, by Newton's and Euler's equations in short steps: the
/// centre at distance r and angle φ from the edge, which is held or slips at u.
struct EdgeInPlane {
  double r, inertia, friction;
  std::array<double, 3> now;  ///< φ, φ′, u
  int side = 0;               ///< of slip; 0: held
  int changes = 0;            ///< between held and slipping

  struct Pull {
    std::array<double, 3> rate;
    double normal, tangential;
  };
  [[nodiscard]] Pull pull(const std::array<double, 3>& y) const {
    const double c = std::cos(y[0]), s = std::sin(y[0]), w = y[1];
    // φ″ = −lever N/I with N = g + z″, z = r sin φ; held: about the edge.
    const double lever = r * (c + side * friction * s);
    const double a =
        side == 0 ? -g * r * c / (inertia + r * r) : -lever * (g - r * s * w * w) / (inertia + lever * r * c);
    const double normal = g + r * (c * a - s * w * w), of_centre = -r * (s * a + c * w * w);
    const double tangential = side == 0 ? of_centre : -side * friction * normal;
    return {{w, a, side == 0 ? 0 : tangential - of_centre}, normal, tangential};
  }
  /// Slips if friction cannot hold the edge.
  void hold_or_slip() {
    const Pull held = pull(now);
    if (side == 0 && std::fabs(held.tangential) > friction * held.normal) {
      side = held.tangential > 0 ? -1 : 1;
      ++changes;
    }
  }
  /// In a thousand parts where slip begins or ends.
  void step(double h) {
    EdgeInPlane fine = *this;
    part(h);
    if (changes == fine.changes) return;
    for (int i = 0; i < 1000; ++i) fine.part(h / 1000);
    *this = fine;
  }
  void part(double h) {
    const auto at = [&](const std::array<double, 3>& k, double t) {
      return std::array<double, 3>{now[0] + t * k[0], now[1] + t * k[1], now[2] + t * k[2]};
    };
    const double slip = now[2];
    const auto k1 = pull(now).rate, k2 = pull(at(k1, h / 2)).rate, k3 = pull(at(k2, h / 2)).rate,
               k4 = pull(at(k3, h)).rate;
    for (std::size_t i = 0; i < 3; ++i) now[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    if (side != 0 && slip * side >= 0 && now[2] * side < 0) now[2] = 0, side = 0, ++changes;
    hold_or_slip();
  }
};

/// How far the rate at the end is off that of the plane, and how often slip began or ended; nothing if the body does
/// not turn down on two corners.
std::optional<std::pair<double, int>> against_plane(double width, double height, double friction, double tilt,
                                                    double spin) {
  const Drop drop = drop_of(box(1, {.size = {0.2, width, height}}), friction);
  const Quaternion attitude(Eigen::AngleAxisd(tilt, Vector3::UnitX()));
  const int lowest = lowest_vertex(drop.body, attitude);
  const Vector3 arm = attitude * drop.body.vertices[lowest];
  std::vector<int> edge;
  for (int i = 0; i < 8; ++i) {
    if (std::fabs((attitude * drop.body.vertices[i] - arm).z()) < 1e-9) edge.push_back(i);
  }
  if (edge.size() != 2 || arm.y() >= 0) return {};
  const SustainedContact contact = follow_contact(drop, standing(drop.body, attitude, lowest, {spin, 0, 0}), edge);
  BOOST_TEST(contact.energy_loss >= -1e-9);
  if (contact.end != ContactEnd::arrival) return {};
  EdgeInPlane plane{.r = std::hypot(arm.y(), arm.z()),
                    .inertia = (width * width + height * height) / 12,
                    .friction = friction,
                    .now = {std::atan2(-arm.z(), -arm.y()), spin, 0}};
  plane.hold_or_slip();
  constexpr int steps = 20'000;
  for (int i = 0; i < steps; ++i) plane.step(contact.duration / steps);
  return std::pair(std::fabs(plane.now[1] - contact.after.angular_velocity.x()), plane.changes);
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_edge_that_slips_sticks_and_slips_back_moves_as_in_its_plane) {
  // Slip that turns back before it is fast.
  const std::array<double, 5> back[] = {{0.3092, 0.1, 0.412, 0.90805, -0.689999},
                                        {0.1584, 0.1, 0.403, 0.65312, -0.8},
                                        {0.3133, 0.1747, 0.3415, 1.0012, -1.7604},
                                        {0.2832, 0.2788, 0.3410, 0.5914, -1.8795}};
  constexpr double of_steps = 2e-7;  // where slip begins and ends within one of the plane's steps
  int most = 0;
  for (const auto& [width, height, friction, tilt, spin] : back) {
    const auto found = against_plane(width, height, friction, tilt, spin);
    BOOST_TEST_REQUIRE(found.has_value());
    BOOST_TEST(found->first <= of_steps, width << ": " << found->first);
    most = std::max(most, found->second);
  }
  BOOST_TEST(most >= 3);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  int judged = 0;
  for (int n = 0; n < (CLATTER_TEST_SLOW_BUILD ? 10 : 100); ++n) {
    const double width = 0.05 + 0.3 * uniform(random), height = 0.05 + 0.3 * uniform(random),
                 friction = 0.1 + 0.7 * uniform(random);
    const double tilt = 0.02 + 1.2 * uniform(random), spin = -2 * uniform(random);
    const auto found = against_plane(width, height, friction, tilt, spin);
    if (!found) continue;
    ++judged;
    BOOST_TEST(found->first <= of_steps, n << ": " << found->first);
  }
  BOOST_TEST(judged > (CLATTER_TEST_SLOW_BUILD ? 3 : 40));
}
