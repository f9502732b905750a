// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/mesh/element_geometry.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "numeric/base/errors.hpp"

namespace clatter::numeric {
namespace {

constexpr Face tetrahedron_faces[] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {1, 2, 3, -1}};
constexpr Face prism_faces[] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr Face hexahedron_faces[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                     {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Product of one function for each of two or three variables, as (value, derivative).
struct Factor {
  double value;
  double derivative;
};

Eigen::Vector4d product(const Factor& a, const Factor& b, const Factor& c) {
  return {a.derivative * b.value * c.value, a.value * b.derivative * c.value, a.value * b.value * c.derivative,
          a.value * b.value * c.value};
}

Factor linear(double end, double at) { return {(1 + end * at) / 2, end / 2}; }

ReferencePoint tetrahedron_point(const Vector3& at, double weight) {
  ReferencePoint point{.weight = weight};
  point.shape.col(0) << -1, -1, -1, 1 - at.sum();
  for (int i = 0; i < 3; ++i) {
    point.shape(i, i + 1) = 1;
    point.shape(3, i + 1) = at[i];
  }
  return point;
}

ReferencePoint prism_point(const Vector3& at, double weight) {
  ReferencePoint point{.weight = weight};
  const Eigen::Vector3d triangle[] = {{-1, -1, 1 - at.x() - at.y()}, {1, 0, at.x()}, {0, 1, at.y()}};
  for (int i = 0; i < 6; ++i) {
    const Factor along = linear(i < 3 ? -1 : 1, at.z());
    const Eigen::Vector3d& across = triangle[i % 3];
    point.shape.col(i) << across[0] * along.value, across[1] * along.value, across[2] * along.derivative,
        across[2] * along.value;
  }
  return point;
}

constexpr double hexahedron_corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

ReferencePoint hexahedron_point(const Vector3& at, double weight) {
  ReferencePoint point{.weight = weight};
  for (int i = 0; i < 8; ++i) {
    const auto& end = hexahedron_corners[i];
    point.shape.col(i) = product(linear(end[0], at.x()), linear(end[1], at.y()), linear(end[2], at.z()));
  }
  return point;
}

struct Abscissa {
  double at;
  double weight;
};

/// Gauss's rule of three points, exact to degree 5.
std::array<Abscissa, 3> gauss() {
  const double at = std::sqrt(0.6);
  return {{{-at, 5. / 9}, {0, 8. / 9}, {at, 5. / 9}}};
}

/// Exact to degree 2: det J is constant.
ReferenceElement make_tetrahedron() {
  ReferenceElement element{"tetrahedron", 4, tetrahedron_faces, {}, {}};
  const double near = (5 - std::sqrt(5.)) / 20, far = (5 + 3 * std::sqrt(5.)) / 20;
  for (int i = 0; i < 4; ++i) {
    Vector3 corner = Vector3::Zero(), at = Vector3::Constant(near);
    if (i > 0) corner[i - 1] = 1;
    if (i > 0) at[i - 1] = far;
    element.corners.push_back(tetrahedron_point(corner, 0));
    element.quadrature.push_back(tetrahedron_point(at, 1. / 24));
  }
  return element;
}

/// det J has degree 1 on the triangle and 2 along the prism, so 3 and 4 are needed: the triangle's
/// rule is exact to degree 4 (Dunavant 1985, six points; closed form of its two orbits).
ReferenceElement make_prism() {
  ReferenceElement element{"prism", 6, prism_faces, {}, {}};
  for (const double z : {-1., 1.}) {
    element.corners.push_back(prism_point({0, 0, z}, 0));
    element.corners.push_back(prism_point({1, 0, z}, 0));
    element.corners.push_back(prism_point({0, 1, z}, 0));
  }
  const double root = std::sqrt(10.);
  const double inner = std::sqrt(38 - 44 * std::sqrt(0.4));
  const double outer = std::sqrt(213125 - 53320 * root);
  const Abscissa orbits[] = {{(8 - root + inner) / 18, (620 + outer) / 7440},
                             {(8 - root - inner) / 18, (620 - outer) / 7440}};
  for (const auto& [a, weight] : orbits) {
    for (const auto& [z, along] : gauss()) {
      element.quadrature.push_back(prism_point({a, a, z}, weight * along));
      element.quadrature.push_back(prism_point({1 - 2 * a, a, z}, weight * along));
      element.quadrature.push_back(prism_point({a, 1 - 2 * a, z}, weight * along));
    }
  }
  return element;
}

/// det J has degree 2 in each variable, so 4 is needed.
ReferenceElement make_hexahedron() {
  ReferenceElement element{"hexahedron", 8, hexahedron_faces, {}, {}};
  for (const auto& end : hexahedron_corners) element.corners.push_back(hexahedron_point({end[0], end[1], end[2]}, 0));
  for (const auto& x : gauss()) {
    for (const auto& y : gauss()) {
      for (const auto& z : gauss()) {
        element.quadrature.push_back(hexahedron_point({x.at, y.at, z.at}, x.weight * y.weight * z.weight));
      }
    }
  }
  return element;
}

[[noreturn]] void refuse_element(const Mesh& mesh, int index, const std::string& what) {
  throw MeshError(element_name(mesh, index) + ": " + what);
}

void check_node(const Mesh& mesh, int index, int position) {
  const auto& nodes = mesh.elements[index].nodes;
  const int node = nodes[position];
  const std::string name = "node " + std::to_string(node);
  if (!(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size())) {
    refuse_element(mesh, index, name + " is not one of the " + std::to_string(mesh.nodes.size()) + " nodes");
  }
  for (int i = 0; i < position; ++i) {
    if (nodes[i] == node) refuse_element(mesh, index, name + " is repeated");
  }
  if (!mesh.nodes[node].allFinite()) refuse_element(mesh, index, name + " has a coordinate that is not finite");
}

/// Rows that are nearly parallel, as in a rotated needle, would cancel in the plain formula;
/// without their parts along the first row only the rounding of the coordinates is left.
double determinant(const Matrix3& rows) {
  const Vector3 a = rows.row(0), b = rows.row(1), c = rows.row(2);
  const double square = std::fmax(a.squaredNorm(), std::numeric_limits<double>::min());
  return a.dot((b - a.dot(b) / square * a).cross(c - a.dot(c) / square * a));
}

}  // namespace

const ReferenceElement& reference_element(ElementShape shape) {
  static const ReferenceElement elements[] = {make_tetrahedron(), make_prism(), make_hexahedron()};
  return elements[static_cast<int>(shape)];
}

std::string element_name(const Mesh& mesh, int index) {
  const Element& element = mesh.elements[index];
  return "element " + std::to_string(index) + " (" + reference_element(element.shape).name + ")";
}

ElementMap::ElementMap(const Mesh& mesh, int index) : mesh_(mesh), index_(index) {
  const Element& element = mesh.elements[index];
  const int count = reference_element(element.shape).node_count;
  for (int i = 0; i < count; ++i) {
    check_node(mesh, index, i);
    const Vector3& node = mesh.nodes[element.nodes[i]];
    if (i == 0) origin_ = node;
    corners_.row(i) = node - origin_;
  }
}

ElementMap::Point ElementMap::at(const ReferencePoint& point) const {
  const Eigen::Matrix<double, 4, 3> mapped = point.shape.lazyProduct(corners_);
  const Matrix3 jacobian = mapped.topRows<3>();
  const double volume = determinant(jacobian);
  const Vector3 size = jacobian.cwiseAbs().rowwise().maxCoeff();
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * size.prod();
  if (!(volume > rounding)) {
    std::ostringstream text;
    text << (volume < -rounding ? "inverted" : "degenerate") << ", its Jacobian determinant is " << volume << " at "
         << (point.weight > 0 ? "a quadrature point" : "a corner");
    refuse_element(mesh_, index_, text.str());
  }
  return {mapped.row(3).transpose(), volume};
}

void check_element(const Mesh& mesh, int index) {
  const ElementMap map(mesh, index);
  const ReferenceElement& reference = reference_element(mesh.elements[index].shape);
  for (const ReferencePoint& point : reference.corners) static_cast<void>(map.at(point));
  for (const ReferencePoint& point : reference.quadrature) static_cast<void>(map.at(point));
}

}  // namespace clatter::numeric
