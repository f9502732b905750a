// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid body ready to be dropped: inertia and contact surface in its body frame.
#pragma once

#include <optional>
#include <vector>

#include "numeric/body/mass_properties.hpp"
#include "numeric/surface/facets.hpp"
#include "numeric/surface/smooth_shape.hpp"

namespace clatter::numeric {

/// Which ends of the body touched during an impact: by the sign of x′ of the vertices that went into the ground; of a
/// smooth shape, of its halves, or of the point that touched first.
enum class ContactEnd { a, b, both, middle };
[[nodiscard]] constexpr ContactEnd contact_end(bool a, bool b) {
  if (a && b) return ContactEnd::both;
  return a ? ContactEnd::a : b ? ContactEnd::b : ContactEnd::middle;
}

/// Body frame: axes of the mesh, origin at the centre of mass.
class Body {
 public:
  /// `surface` in the frame of `properties.centre`.
  /// @param smooth  the shape that touches the ground, in that frame too; `surface` is then a picture of it alone.
  /// @throws std::domain_error unless mass and inertia are finite and positive definite.
  Body(const MassProperties& properties, const Surface& surface, bool merge = true,
       const std::optional<SmoothShape>& smooth = std::nullopt);
  /// Mass, centre, inertia and surface of a mesh.  @throws MeshError (see mass_properties, boundary_surface).
  explicit Body(const Mesh& mesh, bool merge = true);

  [[nodiscard]] double mass() const { return mass_; }
  [[nodiscard]] const Matrix3& inertia() const { return inertia_; }
  [[nodiscard]] const Matrix3& inverse_inertia() const { return inverse_inertia_; }
  /// The shape that touches the ground, if it has no facets.
  [[nodiscard]] const std::optional<SmoothShape>& smooth() const { return smooth_; }
  [[nodiscard]] const Facets& facets() const { return facets_; }
  [[nodiscard]] const Hierarchy& hierarchy() const { return hierarchy_; }
  /// The facets as they are with coplanar neighbours merged: the body's shape, however its faces are meshed.
  [[nodiscard]] const Facets& outline() const { return outline_of_.empty() ? facets_ : outline_; }
  /// The outline's vertex of a vertex of the facets; −1 within a face or a straight edge.
  [[nodiscard]] int outline_vertex(int vertex) const {
    return outline_of_.empty() ? vertex : outline_of_[static_cast<std::size_t>(vertex)];
  }
  /// Largest distance of a vertex from the centre of mass, of a smooth shape SmoothShape::reach [m].
  [[nodiscard]] double radius() const { return radius_; }
  /// Half the extent along the body's x axis [m].
  [[nodiscard]] double half_length() const { return half_length_; }

 private:
  void set_up(const MassProperties& properties, const Surface& surface, bool merge);
  void find_outline(const MassProperties& properties, const Surface& surface);

  double mass_ = 0;
  double radius_ = 0;
  double half_length_ = 0;
  Matrix3 inertia_, inverse_inertia_;
  Facets facets_;
  Facets outline_;               ///< empty where the facets are merged
  std::vector<int> outline_of_;  ///< see outline_vertex; empty where the facets are merged
  Hierarchy hierarchy_;
  std::optional<SmoothShape> smooth_;
};

}  // namespace clatter::numeric
