// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of points: what lies within it, and its corners against their definition.
#include "validation/scene/hull.hpp"

#include "tests/support.hpp"

namespace {

using clatter::numeric::Vector3;
using clatter::test::Random;
using clatter::validation::hull_corners;
using clatter::validation::is_outside_hull;

std::vector<Vector3> points_within(Random& random, int count, const Vector3& size) {
  std::vector<Vector3> list;
  for (int i = 0; i < count; ++i) list.emplace_back(size.cwiseProduct(random.vector()));
  return list;
}

/// By definition: each point is held against all others.
std::vector<Vector3> corners_one_by_one(const std::vector<Vector3>& points) {
  std::vector<Vector3> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Vector3> others = points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (is_outside_hull(points[i], others)) corners.push_back(points[i]);
  }
  return corners;
}

/// The nodes of a box's mesh: most lie within faces and edges, up to the rounding of a rotation.
std::vector<Vector3> lattice(const Vector3& size, const Vector3& turn) {
  const Eigen::AngleAxisd rotation(turn.norm(), turn.normalized());
  std::vector<Vector3> points;
  for (int i = 0; i < 125; ++i)
    points.emplace_back(rotation * Vector3(size.cwiseProduct(Vector3(i % 5, i / 5 % 5, i / 25) / 4)));
  return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(means_of_points_lie_within_their_hull_and_points_beyond_a_supporting_plane_do_not) {
  Random draw(7);
  for (int i = 0; i < 1000; ++i) {
    // Bodies, plates and needles, of four points and of many.
    const Vector3 size(1, i % 3 == 0 ? 1 : 0.01, i % 3 == 2 ? 0.01 : 1);
    const std::vector<Vector3> points = points_within(draw, 4 + i % 40, size);
    Vector3 mean = Vector3::Zero();
    double sum = 0;
    for (const Vector3& point : points) {
      const double weight = std::pow(draw(0, 1), 6);  // mostly near a corner or an edge
      mean += weight * point;
      sum += weight;
    }
    BOOST_TEST(!is_outside_hull(mean / sum, points));
    const Vector3 normal = draw.direction();
    Vector3 support = points[0];
    for (const Vector3& point : points) support = point.dot(normal) > support.dot(normal) ? point : support;
    BOOST_TEST(is_outside_hull(support + 1e-6 * normal, points));
    BOOST_TEST(!is_outside_hull(support, points));
  }
}

BOOST_AUTO_TEST_CASE(the_size_of_a_body_does_not_matter_to_what_is_within_it) {
  for (const double size : {1e-120, 1e-9, 1e9, 1e120}) {
    std::vector<Vector3> cube;
    for (int i = 0; i < 8; ++i) cube.emplace_back(size * Vector3(i & 1, i >> 1 & 1, i >> 2 & 1));
    BOOST_TEST(!is_outside_hull(size * Vector3(0.5, 0.5, 1), cube));
    BOOST_TEST(is_outside_hull(size * Vector3(0.5, 0.5, 1 + 1e-6), cube));
    BOOST_TEST(is_outside_hull(size * Vector3(1.001, 0.5, 0.5), cube));
  }
}

BOOST_AUTO_TEST_CASE(
    the_corners_of_a_hull_are_the_points_outside_the_hull_of_all_others_in_their_order_eight_of_a_box) {
  Random draw(7);
  for (int i = 0; i < 200; ++i) {
    const Vector3 size(1, i % 3 == 0 ? 1 : 0.01, i % 3 == 2 ? 0.01 : 1);
    std::vector<Vector3> points = points_within(draw, 4 + i % 60, size);
    if (i % 4 == 3) points = lattice(size, draw.direction());
    std::shuffle(points.begin(), points.end(), std::mt19937(static_cast<unsigned>(i)));
    BOOST_TEST((hull_corners(points, 1) == corners_one_by_one(points)));
    const Vector3 box(draw(0.1, 1), draw(0.1, 1), draw.decades(-5, 0));
    BOOST_TEST(hull_corners(lattice(box, draw.direction()), 1).size() == 8U);
  }
}

BOOST_AUTO_TEST_CASE(points_of_a_sphere_are_all_corners_and_those_within_it_none_at_any_size) {
  for (const double size : {1e-120, 1.0, 1e120}) {
    std::vector<Vector3> sphere, all;
    for (int i = 0; i < 20'000; ++i) {  // on a spiral of equal turns
      const double z = (i + 0.5) / 10'000 - 1, turn = i * std::numbers::pi * (3 - std::sqrt(5));
      sphere.push_back(size * Vector3(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z));
      all.push_back(sphere.back());
      all.push_back(sphere.back() / 2);
    }
    BOOST_TEST((hull_corners(all, size) == sphere));
  }
}

BOOST_AUTO_TEST_CASE(the_first_of_points_that_are_one_is_the_corner_and_points_in_a_plane_are_all_kept) {
  std::vector<Vector3> kept;
  for (int i = 0; i < 8; ++i) kept.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  std::vector<Vector3> points = kept;
  for (const double off : {0.0, 1e-10}) {  // of the size; counts as the same
    for (const Vector3& corner : kept) points.push_back(corner * (1 + off));
  }
  BOOST_TEST((hull_corners(points, 1) == kept));
  const std::vector<Vector3> square{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  BOOST_TEST((hull_corners(square, 1) == square));
}

BOOST_AUTO_TEST_CASE(a_body_lies_on_the_faces_that_the_foot_of_its_centre_is_in) {
  std::vector<Vector3> box = lattice({0.3, 0.2, 0.1}, {0.4, -0.7, 0.2});
  Vector3 middle = Vector3::Zero();
  for (const Vector3& point : box) middle += point / static_cast<double>(box.size());
  for (Vector3& point : box) point -= middle;
  std::vector<double> distances;
  for (const auto& face : clatter::validation::resting_faces(box)) distances.push_back(face.distance);
  std::ranges::sort(distances);
  BOOST_TEST_REQUIRE(distances.size() == 6u);
  for (std::size_t i = 0; i < 6; ++i)
    BOOST_TEST(std::fabs(distances[i] - 0.05 * static_cast<double>(i / 2 + 1)) < 1e-12);
  // Tetrahedra: the foot's barycentric coordinates in the face are positive.
  Random random(5);
  std::size_t feet = 0, found = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3> corners = points_within(random, 4, Vector3::Ones());
    const Vector3 centre = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    for (Vector3& corner : corners) corner -= centre;
    const auto faces = clatter::validation::resting_faces(corners);
    found += faces.size();
    for (std::size_t top = 0; top < 4; ++top) {
      const Vector3 &a = corners[(top + 1) % 4], &b = corners[(top + 2) % 4], &c = corners[(top + 3) % 4];
      const Vector3 area = (b - a).cross(c - a), foot = area.dot(a) / area.squaredNorm() * area;
      const auto share = [&](const Vector3& p, const Vector3& q) { return (q - p).cross(foot - p).dot(area); };
      if (!(share(a, b) > 0 && share(b, c) > 0 && share(c, a) > 0)) continue;
      ++feet;
      BOOST_TEST(std::ranges::any_of(faces, [&](const auto& face) {
        return (face.distance * face.normal - foot).norm() < 1e-9 * face.distance + 1e-12;
      }));
    }
  }
  BOOST_TEST(found == feet);
  BOOST_TEST(feet > 300u);
  BOOST_TEST(clatter::validation::resting_faces({}).empty());
}
