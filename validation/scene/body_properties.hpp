// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, size, centre and inertia of a scene's body, and whether a body can have those that the scene gives.
#pragma once

#include <string>
#include <vector>

#include "numeric/mass_properties.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline scene {

/// The vector of a key's three components.
[[nodiscard]] inline numeric::Vector3 vector_of(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// Axes and origin of the body frame: the geometric centre of a rod or box, the origin of a mesh's file.
struct BodyProperties {
  double mass = 0;                                              ///< [kg]
  numeric::Vector3 extents = numeric::Vector3::Zero();          ///< largest less smallest coordinates [m]
  numeric::Vector3 centre = numeric::Vector3::Zero();           ///< of mass [m]
  numeric::Matrix3 gyration_square = numeric::Matrix3::Zero();  ///< inertia about the centre of mass over mass [m²]

  /// Principal moments of inertia about the centre of mass, ascending [kg·m²].
  [[nodiscard]] numeric::Vector3 principal_inertia() const;
};

/// A meshed body: of the numbers that the scene does not give, the mesh's own.
struct SolidBody {
  numeric::MassProperties properties;
  numeric::Surface surface;
};
/// @throws MeshError for a file that cannot be used; BadInput naming body.inertia or body.centre if no body of this
///         hull can have them: principal moments not positive, larger than the sum of the other two or than m R² (R the
///         largest distance of the hull from the centre of mass), a centre outside the hull.
[[nodiscard]] SolidBody solid_body(const Scene& scene);

/// Of a rod (a round cylinder; radius 0: a thin rod) or box by its sizes alone.  @throws BadInput as solid_body.
/// @pre the shape is no mesh
[[nodiscard]] BodyProperties nominal_properties(const Scene& scene);

/// Of the body that the model drops.  @throws as solid_body.
[[nodiscard]] BodyProperties body_properties(const Scene& scene, Model model);

/// "mass", "extents", "centre", "principal_inertia" (ascending), "inertia" (xx, yy, zz, xy, xz, yz), SI.
[[nodiscard]] Value body_value(const Scene& scene, Model model = Model::continuous);
/// The scene's summary and a line with the same numbers for a reader: the head of a table.  It leaves out what
/// `unsettled` keys say, and the numbers where they are not those of one body.
[[nodiscard]] std::vector<std::string> scene_head(const Scene& scene, Model model = Model::continuous,
                                                  const KeyNames& unsettled = {});

}  // namespace clatter::validation::inline scene
