// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a point lies within the convex hull of others.
#include "validation/scene/hull.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

namespace {

using clatter::numeric::Vector3;
using clatter::validation::is_outside_hull;

class Draw {
 public:
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vector3 direction() {
    std::normal_distribution<double> normal;
    return Vector3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  std::vector<Vector3> points(int count, const Vector3& size) {
    std::vector<Vector3> list;
    for (int i = 0; i < count; ++i)
      list.emplace_back(size.cwiseProduct(Vector3((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1))));
    return list;
  }

 private:
  std::mt19937 random_{7};
};

}  // namespace

BOOST_AUTO_TEST_CASE(means_of_points_lie_within_their_hull_and_points_beyond_a_supporting_plane_do_not) {
  Draw draw;
  for (int i = 0; i < 3000; ++i) {
    // Bodies, plates and needles, of four points and of many.
    const Vector3 size(1, i % 3 == 0 ? 1 : 0.01, i % 3 == 2 ? 0.01 : 1);
    const std::vector<Vector3> points = draw.points(4 + i % 40, size);
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
