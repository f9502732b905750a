// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, size, centre and inertia of a scene's body, and whether a body can have those that the scene gives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/space/flight/body.hpp"
#include "numeric/body/mass_properties.hpp"
#include "numeric/surface/repair.hpp"
#include "numeric/surface/smooth_shape.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// The vector of a key's three components.
[[nodiscard]] inline numeric::Vector3 vector_of(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// Axes and origin of the body frame: the geometric centre, the origin of a mesh's file.
struct BodyProperties {
  double mass = 0;                                              ///< [kg]
  numeric::Vector3 extents = numeric::Vector3::Zero();          ///< largest less smallest coordinates [m]
  numeric::Vector3 centre = numeric::Vector3::Zero();           ///< of mass [m]
  numeric::Matrix3 gyration_square = numeric::Matrix3::Zero();  ///< inertia about the centre of mass over mass [m²]

  /// Principal moments of inertia about the centre of mass, ascending [kg·m²].
  [[nodiscard]] numeric::Vector3 principal_inertia() const;
};

/// A body with its mesh, of a smooth shape for pictures alone.  Mass, centre and inertia are those of the shape as
/// given, of a file's mesh its own where the scene gives none; the mesh is the surface only.
struct SolidBody {
  numeric::MassProperties properties;
  numeric::Surface surface;
  std::optional<numeric::SmoothShape> smooth;
  std::optional<numeric::Repairs> repairs;  ///< of a file of triangles
  double unit = 1;                          ///< of a file's coordinates [m]
};
/// @throws MeshError for a file that cannot be used; BadInput naming body.inertia or body.centre if no body of this
///         hull can have them: principal moments not positive, larger than the sum of the other two or than m R² (R the
///         largest distance of the hull from the centre of mass), a centre outside the hull.
[[nodiscard]] SolidBody solid_body(const Scene& scene);

/// Begins with a file that has not been read.
[[nodiscard]] std::shared_ptr<MeshFile> unread_mesh();

/// A sphere, ellipsoid or capsule by its sizes alone, uniform.
[[nodiscard]] analytic::space::Body round_body(const BodyScene& body);
/// The properties of the body that the model drops: a shape by its sizes alone, a rod as a round cylinder.  A rod of
/// radius 0 is thin in the discrete model and has the radius of its mesh in the continuous one.  @throws as solid_body.
[[nodiscard]] BodyProperties body_properties(const Scene& scene, Model model);

/// "mass", "extents", "centre", "principal_inertia" (ascending), "inertia" (xx, yy, zz, xy, xz, yz), SI.
[[nodiscard]] Value body_value(const Scene& scene, Model model = Model::continuous);
/// The same for a reader: "body: mass … kg, extents …".
[[nodiscard]] std::string body_words(const Scene& scene, Model model);

/// What a body's file of triangles has and what was repaired, for a reader: "mesh: 12 triangles, nothing repaired;
/// volume … m³ ± …, inertia ± … kg·m²", the bars bounds of what rounding and repair leave; empty for other bodies.
[[nodiscard]] std::string mesh_words(const Scene& scene);

/// A question to whoever typed sizes or masses that no dropped thing has, "mm typed?": larger than 20 m, heavier than
/// 1 t, or ten times as dense as any metal; of a mesh's file also smaller than 1e-5 m; empty: none.
[[nodiscard]] std::string unit_doubts(const Scene& scene, const BodyProperties& body);

}  // namespace clatter::validation
