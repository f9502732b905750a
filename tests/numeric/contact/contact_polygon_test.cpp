// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_polygon.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace clatter::numeric;

/// Corners in the plane z = 0 whose depths are given: a surface element seen from its outside.
std::vector<ContactCorner> element(const std::vector<std::array<double, 2>>& points,
                                   const std::vector<double>& depths) {
  std::vector<ContactCorner> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    corners.push_back({Vector3(points[i][0], points[i][1], 0), depths[i], 0});
  }
  return corners;
}

std::vector<ContactCorner> below(const std::vector<ContactCorner>& whole) {
  std::vector<ContactCorner> out(2 * whole.size());
  const int count = clip(whole.data(), static_cast<int>(whole.size()), out.data(),
                         [](const ContactCorner& corner) { return corner.depth; });
  out.resize(static_cast<std::size_t>(count));
  return out;
}

double area(const std::vector<ContactCorner>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 &a = polygon[i].position, &b = polygon[(i + 1) % polygon.size()].position;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

const std::vector<std::array<double, 2>> triangle{{0, 0}, {1, 0}, {0, 1}};
const std::vector<std::array<double, 2>> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr double rounding = 1e-15;

/// Depth that falls along a direction: contact where x·a + y·b < c.
std::vector<double> depths(const std::vector<std::array<double, 2>>& points, double a, double b, double c) {
  std::vector<double> out;
  for (const auto& point : points) out.push_back(c - a * point[0] - b * point[1]);
  return out;
}

void check(const std::vector<std::array<double, 2>>& points, const std::vector<double>& depths, std::size_t corners,
           double expected_area) {
  const auto polygon = below(element(points, depths));
  BOOST_TEST(polygon.size() == corners);
  BOOST_TEST(std::fabs(area(polygon) - expected_area) <= rounding);
  for (const ContactCorner& corner : polygon) BOOST_TEST(corner.depth >= -rounding);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_triangle_with_one_node_in_the_ground_gives_a_triangle) {
  check(triangle, depths(triangle, 1, 1, 0.5), 3, 0.125);
}

BOOST_AUTO_TEST_CASE(a_triangle_with_two_nodes_in_the_ground_gives_a_quadrangle) {
  check(triangle, depths(triangle, 0, 1, 0.5), 4, 0.375);
}

BOOST_AUTO_TEST_CASE(a_triangle_in_the_ground_is_kept_whole) { check(triangle, {1, 2, 3}, 3, 0.5); }

BOOST_AUTO_TEST_CASE(a_quadrilateral_with_one_node_in_the_ground_gives_a_triangle) {
  check(square, depths(square, 1, 1, 0.5), 3, 0.125);
}

BOOST_AUTO_TEST_CASE(a_quadrilateral_with_two_neighbouring_nodes_in_the_ground_gives_a_quadrangle) {
  check(square, depths(square, 1, 0, 0.25), 4, 0.25);
  check(square, depths(square, 2, 1, 1.5), 4, 0.5);
}

BOOST_AUTO_TEST_CASE(a_quadrilateral_with_three_nodes_in_the_ground_gives_a_pentagon) {
  check(square, depths(square, 1, 1, 1.5), 5, 0.875);
}

BOOST_AUTO_TEST_CASE(a_quadrilateral_in_the_ground_is_kept_whole) { check(square, {1, 2, 3, 4}, 4, 1); }

BOOST_AUTO_TEST_CASE(an_element_above_the_ground_or_just_on_it_gives_nothing) {
  check(square, {-1, -1, -1, -1}, 0, 0);
  check(triangle, {0, 0, 0}, 0, 0);
  check(triangle, {0, -1, -2}, 0, 0);
}

BOOST_AUTO_TEST_CASE(a_node_exactly_on_the_ground_adds_no_area) {
  check(square, {0, 1, 0, -1}, 3, 0.5);
  check(triangle, {1, 0, 0}, 3, 0.5);
}

BOOST_AUTO_TEST_CASE(an_element_that_is_not_convex_keeps_its_area) {
  // A U whose two arms reach into the ground separately.
  const std::vector<std::array<double, 2>> u{{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 3}, {0, 3}};
  const auto polygon = below(element(u, depths(u, 0, 1, 1.5)));
  BOOST_TEST(std::fabs(area(polygon) - 3) <= 4 * rounding);
}

BOOST_AUTO_TEST_CASE(the_crossing_of_an_edge_does_not_depend_on_its_direction) {
  const auto forward = below(element({{0.1, 0.2}, {1.3, 0.7}, {0.4, 1.9}}, {0.3, -0.7, -0.11}));
  const auto backward = below(element({{0.4, 1.9}, {1.3, 0.7}, {0.1, 0.2}}, {-0.11, -0.7, 0.3}));
  BOOST_REQUIRE(forward.size() == 3 && backward.size() == 3);
  for (const ContactCorner& corner : forward) {
    bool found = false;
    for (const ContactCorner& other : backward) found = found || other.position == corner.position;
    BOOST_TEST(found);
  }
}

/// ∫ over the triangle (0,0) (1,0) (0,1) of x^i y^j = i! j! / (i + j + 2)!.
BOOST_AUTO_TEST_CASE(integrals_over_a_triangle_are_exact_up_to_the_third_degree) {
  // δ = x, δ̇ = y; positions are x and y themselves.
  std::vector<ContactCorner> corners = element(triangle, {0, 1, 0});
  corners[2].rate = 1;
  const Vector3 normal = Vector3::UnitZ(), origin(10, 20, 0);
  const ContactPolygon polygon{corners.data(), 3, normal, origin};
  const LoadIntegrals load = load_integrals(polygon);
  constexpr double xx = 1.0 / 12, xy = 1.0 / 24, x = 1.0 / 6, xxy = 1.0 / 60, xyy = 1.0 / 60;
  constexpr double xxx = 1.0 / 20;
  constexpr double relative = 1e-14;
  BOOST_TEST(load.depth == x, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_rate == xy, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_squared == xx, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_rate_squared == xyy, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_position.x() == xx + 10 * x, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_position.y() == xy + 20 * x, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_rate_position.x() == xxy + 10 * xy, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.depth_rate_position.y() == xyy + 20 * xy, boost::test_tools::tolerance(relative));
  const RateIntegrals rates = rate_integrals(polygon);
  BOOST_TEST(rates.rate == x, boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.rate_squared == xx, boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.rate_position.x() == xy + 10 * x, boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.rate_squared_position.y() == xxx + 20 * xx, boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.depth_position_squared(0, 0) == xxx + 20 * xx + 100 * x, boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.depth_position_squared(0, 1) == xxy + 10 * xy + 20 * xx + 200 * x,
             boost::test_tools::tolerance(relative));
  BOOST_TEST(rates.depth_position_squared(1, 1) == xyy + 40 * xy + 400 * x, boost::test_tools::tolerance(relative));
}
