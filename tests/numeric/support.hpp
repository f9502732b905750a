// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes and checks that the tests of the numeric module share.
#pragma once

#include <array>
#include <vector>

#include "numeric/base/errors.hpp"
#include "numeric/mesh/generators.hpp"
#include "numeric/surface/surface.hpp"
#include "tests/support.hpp"

namespace clatter::numeric::test {

using namespace clatter::test;

/// A rotation about an axis off every coordinate plane.
inline Matrix3 rotation() { return Eigen::AngleAxisd(0.7, Vector3(1, -2, 3).normalized()).toRotationMatrix(); }

inline Mesh moved(Mesh mesh, const Matrix3& turn, const Vector3& shift) {
  for (Vector3& node : mesh.nodes) node = turn * node + shift;
  return mesh;
}

/// The same body with nodes and elements in another order.
inline Mesh renumbered(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> place(mesh.nodes.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<int>(i);
  std::shuffle(place.begin(), place.end(), random);
  Mesh other = mesh;
  for (std::size_t i = 0; i < place.size(); ++i) other.nodes[place[i]] = mesh.nodes[i];
  for (Element& element : other.elements) {
    for (int& node : element.nodes) {
      if (node >= 0) node = place[node];
    }
  }
  std::shuffle(other.elements.begin(), other.elements.end(), random);
  return other;
}

inline Mesh single(ElementShape shape, std::vector<Vector3> nodes, double density = 1) {
  Element element{.shape = shape, .density = density};
  for (std::size_t i = 0; i < nodes.size(); ++i) element.nodes[i] = static_cast<int>(i);
  return {std::move(nodes), {element}};
}

/// Without the elements whose centre `removed` says yes to.
inline Mesh without(Mesh mesh, const std::function<bool(const Vector3&)>& removed) {
  std::erase_if(mesh.elements, [&](const Element& element) {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const int node : element.nodes) {
      if (node < 0) continue;
      sum += mesh.nodes[node];
      ++count;
    }
    return removed(sum / count);
  });
  return mesh;
}

/// Enclosed volume by the divergence theorem, ∮ x·n dA / 3, which no inner face enters.  A quadrilateral is the mean of
/// its two triangulations: exact for a bilinear patch.
inline double enclosed(const Surface& surface) {
  double sum = 0;
  for (const SurfaceElement& element : surface.elements) {
    const auto det = [&](int i, int j, int k) {
      return surface.nodes[element.nodes[i]].dot(
          surface.nodes[element.nodes[j]].cross(surface.nodes[element.nodes[k]]));
    };
    sum += element.nodes[3] < 0 ? det(0, 1, 2) / 6 : (det(0, 1, 2) + det(0, 2, 3) + det(1, 2, 3) + det(1, 3, 0)) / 12;
  }
  return sum;
}

inline std::vector<Vector3> unit_cube() {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
}

using Triangle = std::array<Vector3, 3>;

/// A box as twelve outward triangles.
inline std::vector<Triangle> box_of_triangles(const Vector3& low, const Vector3& high) {
  std::vector<Vector3> corner = unit_cube();
  for (Vector3& c : corner) c = low + c.cwiseProduct(high - low);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] :
       {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
    triangles.push_back({corner[a], corner[b], corner[c]});
    triangles.push_back({corner[a], corner[c], corner[d]});
  }
  return triangles;
}

/// A hexahedron all of whose faces are warped.
inline std::vector<Vector3> warped_cube() {
  return {{0, 0, 0.1},    {1.2, 0.1, -0.2}, {0.9, 1.1, 0.3},  {-0.2, 0.8, 0},
          {0.1, -0.1, 1}, {1, 0.2, 1.3},    {1.25, 1, 0.875}, {0, 0.9, 1.2}};
}

}  // namespace clatter::numeric::test
