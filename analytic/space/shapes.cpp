// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/shapes.hpp"

#include <cmath>

#include "analytic/detail/require.hpp"

namespace clatter::analytic::space {

using detail::require;
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

Body polyhedron(const std::vector<Vector3>& vertices, const MassProperties& properties) {
  Body body;
  body.mass = properties.mass;
  body.inertia = properties.inertia;
  for (const Vector3& vertex : vertices) body.vertices.push_back(vertex - properties.centre);
  body.validate();
  return body;
}

}  // namespace clatter::analytic::space
