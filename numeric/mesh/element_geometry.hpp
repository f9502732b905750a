// SPDX-License-Identifier: GPL-3.0-or-later
// Faces, shape functions and quadrature of the solid elements.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "numeric/mesh/mesh.hpp"

namespace clatter::numeric {

/// Corners of a face as positions in Element::nodes, counter-clockwise seen from outside; [3] = -1
/// for a triangle.
using Face = std::array<int, 4>;

/// A point ξ of the reference element: ∂N/∂ξ, ∂N/∂η, ∂N/∂ζ and N of each node, one node a column
/// (zero where the element has fewer than eight).
struct ReferencePoint {
  Eigen::Matrix<double, 4, 8> shape = Eigen::Matrix<double, 4, 8>::Zero();
  double weight = 0;  ///< of the quadrature, summing to the volume of the reference element
};

/// The tetrahedron and the triangle of the prism have corners 0 and 1 on each axis; the other
/// coordinates run from −1 to 1.
struct ReferenceElement {
  const char* name;
  int node_count;
  std::span<const Face> faces;
  std::vector<ReferencePoint> corners;     ///< weight 0
  std::vector<ReferencePoint> quadrature;  ///< exact for det J times every quadratic polynomial of x
};

[[nodiscard]] const ReferenceElement& reference_element(ElementShape shape);

/// "element 12 (hexahedron)".
[[nodiscard]] std::string element_name(const Mesh& mesh, int index);

/// Map x(ξ) = Σ Nᵢ(ξ) xᵢ of one element.
class ElementMap {
 public:
  struct Point {
    Vector3 position;    ///< x(ξ) − origin [m]
    double determinant;  ///< of J = ∂x/∂ξ, > 0 [m³]
  };

  /// @throws MeshError naming the element: a node number out of range or repeated, a coordinate not
  /// finite.
  ElementMap(const Mesh& mesh, int index);

  /// First node of the element [m].
  [[nodiscard]] const Vector3& origin() const { return origin_; }

  /// Valid for elements of 1e-100 … 1e100 m.
  /// @throws MeshError naming the element unless det J > 32 eps ∏ᵢ maxⱼ |Jᵢⱼ|: the rounding of a
  /// determinant, far below that of a needle whose edges are in the ratio 1e6.
  [[nodiscard]] Point at(const ReferencePoint& point) const;

 private:
  const Mesh& mesh_;
  int index_;
  Vector3 origin_;
  Eigen::Matrix<double, 8, 3> corners_ = Eigen::Matrix<double, 8, 3>::Zero();  // relative to origin_
};

/// @throws MeshError as ElementMap, at every corner and quadrature point.
void check_element(const Mesh& mesh, int index);

}  // namespace clatter::numeric
