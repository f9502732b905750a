// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "analytic/space/flight/body.hpp"

namespace {

using namespace clatter::analytic::space;

/// What validate() says of a body.
std::string refusal(const Body& body) {
  try {
    body.validate();
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_has_the_inertia_of_eight_corners_weighted_by_gauss_quadrature) {
  // Two-point Gauss rules are exact for x², so that eight points of m/8 at ±L/√12 have the box's inertia.
  const Vector3 size(0.14, 0.07, 0.008);
  const Body body = box(0.18, {.size = size});
  Matrix3 inertia = Matrix3::Zero();
  for (const Vector3& vertex : body.vertices) {
    const Vector3 r = vertex / std::sqrt(3.0);
    inertia += 0.18 / 8 * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  BOOST_TEST((inertia - body.inertia).norm() <= 1e-15 * inertia.norm());
  BOOST_TEST((body.vertices[5] - Vector3(0.07, -0.035, 0.004)).norm() == 0);
}

BOOST_AUTO_TEST_CASE(a_box_whose_centre_of_mass_lies_aside_has_vertices_counted_from_that_centre) {
  const Body body = box(1, {.size = {2, 2, 2}, .centre = {0.25, -0.5, 0.125}});
  BOOST_TEST((body.vertices[0] - Vector3(-1.25, -0.5, -1.125)).norm() == 0);
  BOOST_TEST((body.vertices[7] - Vector3(0.75, 1.5, 0.875)).norm() == 0);
}

BOOST_AUTO_TEST_CASE(a_cylinder_touches_with_two_rims_and_a_thin_rod_with_two_vertices) {
  const Body thick = cylinder(2, {.length = 1, .radius = 0.5});
  BOOST_TEST(thick.vertices.empty());
  BOOST_TEST(thick.rims.size() == 2);
  BOOST_TEST(std::fabs(thick.reach() - std::hypot(0.5, 0.5)) <= 1e-15);
  BOOST_TEST((thick.inertia.diagonal() - Vector3(0.25, 3.5 / 12, 3.5 / 12)).norm() <= 1e-15);
  const Body thin = cylinder(2, {.length = 1, .radius = 0});
  BOOST_TEST(thin.rims.empty());
  BOOST_TEST(thin.vertices.size() == 2);
  BOOST_TEST(thin.reach() == 0.5);
}

BOOST_AUTO_TEST_CASE(the_reach_of_a_rim_aside_of_its_axis_is_that_of_its_farthest_point) {
  Body body = cylinder(1, {.length = 1, .radius = 0.25});
  body.rims = {{.centre = {0.5, 0.25, 0}, .axis = Vector3::UnitX(), .radius = 0.25}};
  BOOST_TEST(std::fabs(body.reach() - std::hypot(0.5, 0.5)) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(a_body_that_cannot_be_is_refused_by_the_name_of_its_field) {
  const Body good = box(1, {.size = {1, 2, 3}});
  BOOST_TEST(refusal(good).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Body body = good;
  body.mass = nan;
  BOOST_TEST(refusal(body).starts_with("mass = nan"));
  body = good;
  body.inertia = Vector3(1, 1, 2.5).asDiagonal();
  BOOST_TEST(refusal(body).find("triangle inequality") != std::string::npos);
  body.inertia = Vector3(0, 1, 1).asDiagonal();
  BOOST_TEST(refusal(body).starts_with("smallest principal moment of inertia = 0"));
  body.inertia = good.inertia;
  body.inertia(0, 1) = 0.1;
  BOOST_TEST(refusal(body).find("symmetric") != std::string::npos);
  body = good;
  body.vertices[3].y() = nan;
  BOOST_TEST(refusal(body).starts_with("vertex = nan"));
  body.vertices.clear();
  BOOST_TEST(refusal(body).starts_with("number of vertices, rims and ellipsoids = 0"));
  body.rims = {{.centre = Vector3::Zero(), .axis = {1, 1, 0}, .radius = 1}};
  BOOST_TEST(refusal(body).find("axis") != std::string::npos);
  body.rims[0] = {.centre = Vector3::Zero(), .axis = Vector3::UnitX(), .radius = 0};
  BOOST_TEST(refusal(body).starts_with("radius of a rim = 0"));
  BOOST_CHECK_THROW((void)box(1, {.size = {1, -1, 1}}), std::domain_error);
  BOOST_CHECK_THROW((void)cylinder(1, {.length = 1, .radius = -1}), std::domain_error);
}

BOOST_AUTO_TEST_CASE(a_flat_plate_and_a_needle_hold_the_triangle_inequality_to_rounding) {
  BOOST_TEST(refusal(box(0.1, {.size = {0.3, 0.7, 1e-9}})).empty());
  BOOST_TEST(refusal(box(3.3, {.size = {1, 1e-7, 1e-7}})).empty());
}

BOOST_AUTO_TEST_CASE(the_shortest_turn_takes_one_direction_into_another_about_what_both_are_normal_to) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Vector3 from(part(draw), part(draw), part(draw)), to(part(draw), part(draw), part(draw));
    const double near_opposite = (from.normalized() + to.normalized()).norm();
    const Quaternion turn = turn_between(from, to);
    const double rounding = 1e-15 / near_opposite;
    BOOST_TEST(std::fabs(turn.norm() - 1) <= rounding);
    BOOST_TEST((turn * from.normalized() - to.normalized()).norm() <= 4 * rounding);
    BOOST_TEST(std::fabs(turn.vec().dot(from.normalized())) <= rounding);
  }
  const Quaternion little = turn_between({2, 0, 0}, {3, 3e-9, 0});  // sin(θ/2) = 5e-10 to 20 digits
  BOOST_TEST((little.vec() - Vector3(0, 0, 5e-10)).norm() <= 1e-25);
}
