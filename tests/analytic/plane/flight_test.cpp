// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/flight.hpp"

#include "analytic/base/angle.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::test;

/// Height by the plain definition in long double, to check the rewritten one.
long double plain_height(const VertexHeight& h, long double t) {
  const long double turned = static_cast<long double>(h.rate) * t;
  return h.height + h.velocity * t - h.gravity * t * t / 2 + h.versine * (1 - std::cos(turned)) +
         h.sine * (turned - std::sin(turned));
}

VertexHeight random_height(Random& random) {
  return {.height = random(0, 1),
          .velocity = random(-3, 3),
          .gravity = random.one_in(3) ? 0 : random(0.01, 20),
          .rate = random(0.1, 10),
          .versine = random(-0.5, 0.5),
          .sine = random(-0.5, 0.5)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_height_keeps_the_digits_that_its_terms_have) {
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const VertexHeight h = random_height(random);
    const double t = std::exp(random(-6, 1));
    const auto [height, velocity, scale] = h.at(t);
    BOOST_REQUIRE(std::fabs(static_cast<double>(height - plain_height(h, t))) <= 4 * 2.2e-16 * scale);
  }
}

BOOST_AUTO_TEST_CASE(the_first_root_is_the_first_on_a_fine_grid) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const VertexHeight h = random_height(random);
    const FirstRoot found = first_root(h, 4);
    constexpr int points = 20000;
    double grid = infinite;
    for (int k = 1; k <= points && grid == infinite; ++k) {
      if (plain_height(h, 4.0L * k / points) <= 0) grid = 4.0 * k / points;
    }
    if (found.time && grid == infinite) {  // a dip between two grid points
      BOOST_REQUIRE(std::fabs(h.at(*found.time).height) <= 1e-14);
      continue;
    }
    BOOST_REQUIRE(found.time.has_value() == (grid < infinite));
    if (found.time) BOOST_REQUIRE(*found.time <= grid + 1e-12 && *found.time >= 0);
    if (found.time && *found.time < grid - 4.0 / points) BOOST_REQUIRE(std::fabs(h.at(*found.time).height) <= 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_vertex_that_the_ends_of_a_flight_keep_above_the_ground_has_no_root_and_no_turning_point_there) {
  Random random(3);
  int kept = 0;
  for (int i = 0; i < 20000; ++i) {
    VertexHeight h = random_height(random);
    if (random.one_in(3)) h.height = 0;
    const double end = std::exp(random(-6, 2));
    if (!stays_above(h, end, detail::Turn(h.rate * end))) continue;
    ++kept;
    const FirstRoot found = first_root(h, end);
    BOOST_REQUIRE(!found.time);
    BOOST_REQUIRE(found.near_miss.clearance == infinite);
    for (int k = 1; k <= 100; ++k) BOOST_REQUIRE(plain_height(h, static_cast<long double>(end) * k / 100) > 0);
  }
  BOOST_TEST(kept >= 3000);
}

BOOST_AUTO_TEST_CASE(a_million_turns_in_one_flight_cost_no_more_than_a_few) {
  const PlanarBody rod = make_rod({});
  const Angle angle = Angle::from_degrees(90);
  Departure departure{.inclination = angle.radians, .sine = angle.sine, .cosine = angle.cosine};
  departure.angular = 4e6;
  departure.gravity = 9.81;
  departure.normal = departure.rebound_speed = 9.81 / 2 * 1.6;  // airborne for 1.6 s: 10⁶ turns
  departure.touching = 1;
  const Flight flight = fly(rod, departure);
  BOOST_REQUIRE(flight.end == FlightEnd::contact);
  const double turns = departure.angular * flight.arrival.time / (2 * pi);
  BOOST_TEST(turns > 0.9e6);
  BOOST_TEST(flight.evaluations < 60);
  const VertexHeight height = vertex_height(rod, departure, flight.arrival.vertex);
  BOOST_TEST(std::fabs(height.at(flight.arrival.time).height) <= 1e-8);  // ε·10⁶ turns × length
  // An end points down every half turn, so the first contact comes within one of the moment at which
  // the centre is down to the rod's reach, where it was at the start.
  BOOST_TEST(flight.arrival.time >= 1.6 - 1e-12);
  BOOST_TEST(flight.arrival.time <= 1.6 + pi / departure.angular);
}

BOOST_AUTO_TEST_CASE(a_vertex_without_rebound_stays_only_if_gravity_beats_the_turning) {
  const PlanarBody rod = make_rod({});
  const Angle angle = Angle::from_degrees(30);
  const double spin = 1 / (0.5 * angle.cosine), centripetal = spin * spin * 0.5 * angle.sine;
  for (const auto& [part, end] : {std::pair{1.01, FlightEnd::stays_touching}, {0.99, FlightEnd::contact}}) {
    Departure departure{.inclination = angle.radians, .sine = angle.sine, .cosine = angle.cosine, .normal = -1};
    departure.angular = spin;
    departure.touching = 1;
    departure.gravity = part * centripetal;
    BOOST_CHECK(fly(rod, departure).end == end);
  }
}
