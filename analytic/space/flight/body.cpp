// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/body.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"

namespace clatter::analytic::space {

namespace {

bool is_diagonal(const Matrix3& m) { return m(0, 1) == 0 && m(0, 2) == 0 && m(1, 2) == 0; }

}  // namespace

PrincipalAxes::PrincipalAxes(const Matrix3& inertia) {
  if (is_diagonal(inertia)) {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return inertia(i, i) < inertia(j, j); });
    for (int k = 0; k < 3; ++k) {
      const int from = order[k];
      moments[k] = inertia(from, from);
      axes.col(k) = Matrix::Identity().col(from);
    }
  } else {
    const Matrix symmetric = inertia.cast<long double>().selfadjointView<Eigen::Lower>();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
    for (int k = 0; k < 3; ++k) moments[k] = solver.eigenvalues()[k];
    axes = solver.eigenvectors();
  }
  if (axes.determinant() < 0) axes.col(1) = -axes.col(1);
}

using detail::require;
namespace {

void require_finite(const Vector3& v, const std::string& field) {
  for (int i = 0; i < 3; ++i) require(std::isfinite(v[i]), field, v[i], "finite");
}

/// Rounding of the principal moments, relative to the largest.
constexpr double slack = 16 * std::numeric_limits<double>::epsilon();

void validate_inertia(const Matrix3& inertia) {
  for (int i = 0; i < 3; ++i) require_finite(inertia.col(i), "inertia");
  const double size = inertia.cwiseAbs().maxCoeff();
  const double skew = (inertia - inertia.transpose()).cwiseAbs().maxCoeff();
  require(skew <= slack * size, "inertia minus its transpose", skew, "zero: the tensor is symmetric");
  const PrincipalAxes principal(inertia);
  const auto [a, b, c] = principal.moments;
  require(a > 0, "smallest principal moment of inertia", static_cast<double>(a), "above 0");
  require(a + b >= c * (1 - slack), "sum of the two smaller principal moments of inertia less the largest",
          static_cast<double>(a + b - c), "at least 0 (triangle inequality)");
}

}  // namespace

Vector3 Ellipsoid::axis() const {
  if (is_sphere()) return centre.norm() > 0 ? centre.normalized() : centre;
  for (int k = 0; k < 3; ++k) {
    if (semiaxes[(k + 1) % 3] == semiaxes[(k + 2) % 3]) return Vector3::Unit(k);
  }
  return Vector3::Zero();
}

const Ellipsoid* Body::sphere(int point) const {
  const std::size_t before = vertices.size() + rims.size(), index = static_cast<std::size_t>(point);
  return index >= before && ellipsoids[index - before].is_sphere() ? &ellipsoids[index - before] : nullptr;
}

Round Body::round(int point) const {
  const std::size_t index = static_cast<std::size_t>(point) - vertices.size();
  if (index < rims.size()) {
    const auto& [centre, axis, radius] = rims[index];
    return {.centre = centre, .axis = axis, .shares = Vector3::Ones(), .radius = radius};
  }
  const auto& [centre, semiaxes] = ellipsoids[index - rims.size()];
  const double radius = semiaxes.maxCoeff();
  return {.centre = centre, .axis = Vector3::Zero(), .shares = semiaxes / radius, .radius = radius};
}

bool Body::is_flat() const {
  return rims.empty() && ellipsoids.empty() &&
         std::ranges::all_of(vertices, [](const Vector3& v) { return v.y() == 0; });
}

bool Body::is_centred_sphere() const {
  return points() == 1 && sphere(0) != nullptr && sphere(0)->centre == Vector3::Zero();
}

bool Body::is_ball() const { return is_centred_sphere() && inertia == inertia(0, 0) * Matrix3::Identity(); }

double Body::reach() const {
  double reach = 0;
  for (const Vector3& vertex : vertices) reach = std::fmax(reach, vertex.norm());
  for (const Rim& rim : rims) {
    const double along = rim.centre.dot(rim.axis);
    const double across = (rim.centre - along * rim.axis).norm();
    reach = std::fmax(reach, std::hypot(along, across + rim.radius));
  }
  for (const Ellipsoid& part : ellipsoids) reach = std::fmax(reach, part.centre.norm() + part.semiaxes.maxCoeff());
  return reach;
}

std::optional<double> Body::transverse_moment() const {
  if (!vertices.empty() || points() == 0) return {};
  const Vector3 axis = rims.empty() ? ellipsoids.front().axis() : rims.front().axis;
  if (axis == Vector3::Zero()) return {};
  const double rounding = 4 * std::numeric_limits<double>::epsilon();
  for (const Rim& rim : rims) {
    if (!(rim.axis.cross(axis).norm() <= rounding && rim.centre.cross(axis).norm() <= rounding * reach())) return {};
  }
  for (const Ellipsoid& part : ellipsoids) {
    const bool is_round = part.is_sphere() || part.axis().cross(axis).norm() <= rounding * part.axis().norm();
    if (!(is_round && (part.is_sphere() || part.axis() != Vector3::Zero()) &&
          part.centre.cross(axis).norm() <= rounding * reach())) {
      return {};
    }
  }
  const double along = axis.dot(inertia * axis), across = (inertia.trace() - along) / 2;
  const Matrix3 revolved = across * Matrix3::Identity() + (along - across) * axis * axis.transpose();
  if (!((inertia - revolved).cwiseAbs().maxCoeff() <= rounding * inertia.cwiseAbs().maxCoeff())) return {};
  return across;
}

void Body::validate() const {
  require(mass > 0 && std::isfinite(mass), "mass", mass, "above 0 and finite");
  validate_inertia(inertia);
  require(points() > 0, "number of vertices, rims and ellipsoids", 0, "at least 1");
  for (const Vector3& vertex : vertices) require_finite(vertex, "vertex");
  for (const Rim& rim : rims) {
    require_finite(rim.centre, "centre of a rim");
    require_finite(rim.axis, "axis of a rim");
    require(std::fabs(rim.axis.norm() - 1) <= slack, "length of a rim's axis", rim.axis.norm(), "1");
    require(rim.radius > 0 && std::isfinite(rim.radius), "radius of a rim", rim.radius, "above 0 and finite");
  }
  for (const Ellipsoid& part : ellipsoids) {
    require_finite(part.centre, "centre of an ellipsoid");
    require_finite(part.semiaxes, "semiaxis of an ellipsoid");
    const double least = part.semiaxes.minCoeff();
    require(least > 0, "semiaxis of an ellipsoid", least, "above 0");
    require(least >= 1e-9 * part.semiaxes.maxCoeff(), "least semiaxis of an ellipsoid", least,
            "at least 1e-9 of the largest");
  }
  require(reach() > 0, "reach of the body", reach(), "above 0");
}

Body box(double mass, const Box& shape) {
  Body body;
  body.mass = mass;
  for (int i = 0; i < 3; ++i) {
    require(shape.size[i] > 0 && std::isfinite(shape.size[i]), "size of the box", shape.size[i], "above 0 and finite");
  }
  const Vector3 squares = shape.size.cwiseAbs2();
  const Vector3 sums(squares[1] + squares[2], squares[0] + squares[2], squares[0] + squares[1]);
  body.inertia = (mass / 12 * sums).asDiagonal();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 side((corner & 4) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5, (corner & 1) != 0 ? 0.5 : -0.5);
    body.vertices.push_back(side.cwiseProduct(shape.size) - shape.centre);
  }
  body.validate();
  return body;
}

Body cylinder(double mass, const Cylinder& shape) {
  require(shape.length > 0 && std::isfinite(shape.length), "length of the cylinder", shape.length,
          "above 0 and finite");
  require(shape.radius >= 0 && std::isfinite(shape.radius), "radius of the cylinder", shape.radius,
          "at least 0 and finite");
  const double square = shape.radius * shape.radius;
  const double across = mass * (3 * square + shape.length * shape.length) / 12;
  Body body;
  body.mass = mass;
  body.inertia = Vector3(shape.radius > 0 ? mass * square / 2 : across, across, across).asDiagonal();
  for (const double side : {-0.5, 0.5}) {
    const Vector3 end(side * shape.length, 0, 0);
    if (shape.radius > 0) body.rims.push_back({.centre = end, .axis = Vector3::UnitX(), .radius = shape.radius});
    else body.vertices.push_back(end);
  }
  body.validate();
  return body;
}

Body ellipsoid(double mass, const Vector3& semiaxes) {
  const Vector3 squares = semiaxes.cwiseAbs2();
  Body body;
  body.mass = mass;
  body.inertia = (mass / 5 * (Vector3::Constant(squares.sum()) - squares)).asDiagonal();
  if (semiaxes == Vector3::Constant(semiaxes.x())) body.inertia = 0.4 * mass * squares.x() * Matrix3::Identity();
  body.ellipsoids.push_back({.centre = Vector3::Zero(), .semiaxes = semiaxes});
  body.validate();
  return body;
}

Body capsule(double mass, const Cylinder& shape) {
  const double r = shape.radius, l = shape.length - 2 * r, square = r * r, part = l / (l + 4 * r / 3), caps = 1 - part;
  require(r > 0 && std::isfinite(r), "radius of the capsule", r, "above 0 and finite");
  require(l >= 0 && std::isfinite(l), "length of the capsule less two radii", l, "at least 0 and finite");
  if (l == 0) return ellipsoid(mass, Vector3::Constant(r));
  const double across = part * (l * l / 12 + square / 4) + caps * (0.4 * square + l * l / 4 + 3 * l * r / 8);
  Body body;
  body.mass = mass;
  body.inertia = (mass * Vector3(square * (part / 2 + 0.4 * caps), across, across)).asDiagonal();
  for (const double side : {-0.5, 0.5}) {
    body.ellipsoids.push_back({.centre = {side * l, 0, 0}, .semiaxes = Vector3::Constant(r)});
  }
  body.validate();
  return body;
}

Body outline(const PlanarBody& planar) {
  Body body;
  body.mass = planar.mass;
  body.inertia = planar.mass * planar.gyration_square * Matrix3::Identity();
  for (int i = 0; i < planar.vertex_count; ++i) {
    const Vertex& vertex = planar.vertices[i];
    body.vertices.emplace_back(vertex.x, 0, vertex.z);
  }
  return body;
}

Body polyhedron(const std::vector<Vector3>& vertices, const MassProperties& properties) {
  Body body;
  body.mass = properties.mass;
  body.inertia = properties.inertia;
  for (const Vector3& vertex : vertices) body.vertices.push_back(vertex - properties.centre);
  body.validate();
  return body;
}

double touch_height(const Body& body, const Quaternion& attitude) {
  const double length = attitude.norm();
  constexpr double rounding = 1e-6;
  require(std::fabs(length - 1) <= rounding, "length of the attitude's Euler parameters", length, "1 to within 1e-6");
  const Vector3 up = attitude.normalized().conjugate() * Vector3::UnitZ();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3& vertex : body.vertices) lowest = std::fmin(lowest, up.dot(vertex));
  for (const Rim& rim : body.rims)
    lowest = std::fmin(lowest, up.dot(rim.centre) - rim.radius * up.cross(rim.axis).norm());
  for (const auto& [centre, semiaxes] : body.ellipsoids)
    lowest = std::fmin(lowest, up.dot(centre) - semiaxes.cwiseProduct(up).norm());
  return -lowest;
}

}  // namespace clatter::analytic::space
