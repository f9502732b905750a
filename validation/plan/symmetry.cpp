// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/symmetry.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace clatter::validation {
namespace {

using numeric::Matrix3;
using numeric::Vector3;

constexpr double same = 1e-9;       // of the body's size: meshes from files carry the rounding of their text
constexpr double cell_size = 1e-3;  // likewise; a vertex near a wall is looked for on both sides of it

std::uint64_t key(const Eigen::Array3d& cells) {
  std::uint64_t hash = 0;
  for (const double coordinate : cells) {
    hash = hash * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate));
  }
  return hash;
}

/// Vertices by the cell that they lie in.
class VertexGrid {
 public:
  explicit VertexGrid(const std::vector<Vector3>& vertices) : vertices_(vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) cells_.emplace(key((vertices[i] / cell_size).array().floor()), i);
  }

  [[nodiscard]] bool has(const Vector3& point) const {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 shift(corner & 1 ? same : -same, corner & 2 ? same : -same, corner & 4 ? same : -same);
      const auto [first, last] = cells_.equal_range(key(((point + shift) / cell_size).array().floor()));
      for (auto found = first; found != last; ++found) {
        if ((vertices_[found->second] - point).cwiseAbs().maxCoeff() <= same) return true;
      }
    }
    return false;
  }

 private:
  const std::vector<Vector3>& vertices_;
  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

bool moves_in_plane(const numeric::MotionState& state) {
  constexpr double turn_rounding = 1e-14;  // of the turn from body to world components
  const Vector3 rate = state.attitude * state.angular_velocity;
  return std::fabs(state.velocity.y()) <= turn_rounding * state.velocity.norm() &&
         std::hypot(rate.x(), rate.z()) <= turn_rounding * rate.norm();
}

/// Whether the plane through the centre of mass with this normal (body frame) is one of symmetry of the shape.
bool is_mirrored(const numeric::SmoothShape& shape, const Vector3& normal) {
  const Vector3 squares = shape.semiaxes.cwiseProduct(shape.semiaxes).cwiseProduct(normal);
  const double size = shape.reach(), along = std::fabs(normal.x());
  return squares.cross(normal).norm() <= same * size * size && std::fabs(shape.centre.dot(normal)) <= same * size &&
         (shape.straight == 0 || along <= same || along >= 1 - same);
}

}  // namespace

bool is_mirror_image(const numeric::Body& body, const numeric::MotionState& state) {
  if (!moves_in_plane(state)) return false;
  const double size = body.radius();
  const Matrix3 turn = state.attitude.toRotationMatrix();
  const Matrix3 inertia = turn * body.inertia() * turn.transpose();
  if (!(std::hypot(inertia(0, 1), inertia(1, 2)) <= same * body.mass() * size * size)) return false;
  if (body.smooth()) return is_mirrored(*body.smooth(), turn.transpose() * Vector3::UnitY());
  std::vector<Vector3> vertices;
  for (const Vector3& vertex : body.facets().vertices) vertices.emplace_back(turn * vertex / size);
  const VertexGrid grid(vertices);
  for (const Vector3& vertex : vertices) {
    if (!grid.has({vertex.x(), -vertex.y(), vertex.z()})) return false;
  }
  return true;
}

}  // namespace clatter::validation
