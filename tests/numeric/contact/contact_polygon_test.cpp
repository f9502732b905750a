// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_polygon.hpp"

#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using Points = std::vector<std::array<double, 2>>;
/// Corners in the plane z = 0 whose depths are given: a surface element seen from its outside.
std::vector<ContactCorner> element(const Points& points, const std::vector<double>& depths) {
  std::vector<ContactCorner> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    corners.push_back({Vector3(points[i][0], points[i][1], 0), depths[i], 0});
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

const Points triangle{{0, 0}, {1, 0}, {0, 1}}, square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr double rounding = 1e-15;

/// Depth that falls along a direction: contact where x·a + y·b < c.
std::vector<double> depths(const Points& points, double a, double b, double c) {
  std::vector<double> out;
  for (const auto& point : points) out.push_back(c - a * point[0] - b * point[1]);
  return out;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_left_of_an_element_is_a_polygon_below_the_ground_with_its_corners_and_area) {
  struct Row {
    const char* name;
    const Points& points;
    std::vector<double> depths;
    std::size_t corners;
    double area;
  };
  for (const Row& row : {Row{"a triangle by one node", triangle, depths(triangle, 1, 1, 0.5), 3, 0.125},
                         {"a triangle by two nodes", triangle, depths(triangle, 0, 1, 0.5), 4, 0.375},
                         {"a whole triangle", triangle, {1, 2, 3}, 3, 0.5},
                         {"a quadrilateral by one node", square, depths(square, 1, 1, 0.5), 3, 0.125},
                         {"by two neighbouring nodes", square, depths(square, 1, 0, 0.25), 4, 0.25},
                         {"by two, askew", square, depths(square, 2, 1, 1.5), 4, 0.5},
                         {"a quadrilateral by three nodes", square, depths(square, 1, 1, 1.5), 5, 0.875},
                         {"a whole quadrilateral", square, {1, 2, 3, 4}, 4, 1},
                         {"a quadrilateral above the ground", square, {-1, -1, -1, -1}, 0, 0},
                         {"a triangle just on the ground", triangle, {0, 0, 0}, 0, 0},
                         {"a triangle on it by one node", triangle, {0, -1, -2}, 0, 0},
                         {"two nodes exactly on the ground", square, {0, 1, 0, -1}, 3, 0.5},
                         {"an edge exactly on the ground", triangle, {1, 0, 0}, 3, 0.5}}) {
    BOOST_TEST_CONTEXT(row.name) {
      const auto polygon = below(element(row.points, row.depths));
      BOOST_TEST(polygon.size() == row.corners);
      BOOST_TEST(std::fabs(area(polygon) - row.area) <= rounding);
      for (const ContactCorner& corner : polygon) BOOST_TEST(corner.depth >= -rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_element_that_is_not_convex_keeps_its_area) {
  // A U whose two arms reach into the ground separately.
  const Points u{{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 3}, {0, 3}};
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
  constexpr double xx = 1.0 / 12, xy = 1.0 / 24, x = 1.0 / 6, xxy = 1.0 / 60, xyy = 1.0 / 60, xxx = 1.0 / 20;
  const RateIntegrals rates = rate_integrals(polygon);
  const Matrix3& squares = rates.depth_position_squared;
  const std::pair<double, double> pairs[] = {{load.depth, x},
                                             {load.depth_rate, xy},
                                             {load.depth_squared, xx},
                                             {load.depth_rate_squared, xyy},
                                             {load.depth_position.x(), xx + 10 * x},
                                             {load.depth_position.y(), xy + 20 * x},
                                             {load.depth_rate_position.x(), xxy + 10 * xy},
                                             {load.depth_rate_position.y(), xyy + 20 * xy},
                                             {rates.rate, x},
                                             {rates.rate_squared, xx},
                                             {rates.rate_position.x(), xy + 10 * x},
                                             {rates.rate_squared_position.y(), xxx + 20 * xx},
                                             {squares(0, 0), xxx + 20 * xx + 100 * x},
                                             {squares(0, 1), xxy + 10 * xy + 20 * xx + 200 * x},
                                             {squares(1, 1), xyy + 40 * xy + 400 * x}};
  for (const auto& [value, expected] : pairs) BOOST_TEST(value == expected, boost::test_tools::tolerance(1e-14));
}
