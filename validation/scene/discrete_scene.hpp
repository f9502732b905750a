// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the discrete model sees it: by the real body and ground, or by sizes and the impact.* keys alone.
#pragma once

#include "analytic/plane/sequence.hpp"
#include "numeric/body.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline scene {

/// Why the drop moves in space and not in the plane y = 0, as its keys say; empty: in the plane.  The one place that
/// decides so; planar_body refuses meshes whose shape or mass is not symmetric about that plane.
[[nodiscard]] std::string reason_in_space(const Scene& scene);

/// The planar body with the same mass, the same moment of inertia about y and, as vertices, the corners of the real
/// outline in the x–z plane: a, b (below), a-top, b-top.
/// @throws analytic::OutsideModelError if the body is not symmetric about the plane y = 0 (products of inertia or
///         corners off it by more than 1e-9 of its size), or its outline has more than four corners.
[[nodiscard]] analytic::PlanarBody planar_body(const numeric::Body& body);

/// The drop of `scene` for the discrete model: real contact points and inertia, restitution from the exact map of the
/// ground's damping at each impact's own speed, Coulomb friction with the sliding coefficient.
/// @throws analytic::OutsideModelError as planar_body, for a drop in space and for regularised friction.
[[nodiscard]] analytic::Drop discrete_drop(const Scene& scene, const numeric::Body& body);

/// The body of `scene` by its sizes alone, as `clatter sequence` has it: a rod is a cylinder (radius 0: a thin rod), a
/// box its outline, with body.centre and body.inertia; a mesh as planar_body.  @throws as planar_body, numeric::Body
/// and nominal_properties.
[[nodiscard]] analytic::PlanarBody nominal_body(const Scene& scene);

/// The drop of `scene` with restitution and friction as its impact.* keys give them.
/// @throws analytic::OutsideModelError for a drop in space; BadInput if drop.height is not above the centre of mass at
///         the touch.
[[nodiscard]] analytic::Drop impact_drop(const Scene& scene, const analytic::PlanarBody& body);
[[nodiscard]] analytic::Drop impact_drop(const Scene& scene);

/// Restitution and friction as the scene's impact.* keys give them.
[[nodiscard]] analytic::ImpactLaw impact_law(const Scene& scene);

/// A scene for `sequence` and `explain`: `speed` is that of the fall, where a height is given.
/// @throws BadInput as read_scene, and for a scene that sweeps its angle.
[[nodiscard]] Scene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides);

}  // namespace clatter::validation::inline scene
