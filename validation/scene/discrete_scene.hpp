// A scene as the discrete model sees it: by the real body and ground, or by sizes and the impact.* keys alone.
#pragma once

#include "analytic/sequence.hpp"
#include "numeric/body.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// The planar body with the same mass, the same moment of inertia about y and, as vertices, the corners of the real
/// outline in the x–z plane: a, b (below), a-top, b-top.
/// @throws analytic::OutsideModelError if the body is not symmetric about the plane y = 0 (products of inertia or
///         corners off it by more than 1e-9 of its size), or its outline has more than four corners.
[[nodiscard]] analytic::PlanarBody planar_body(const numeric::Body& body);

/// The drop of `scene` for the discrete model: real contact points and inertia, restitution from the exact map of the
/// ground's damping at each impact's own speed, Coulomb friction with the sliding coefficient.
/// @throws analytic::OutsideModelError as planar_body, and for a tilted drop or regularised friction.
[[nodiscard]] analytic::Drop discrete_drop(const Scene& scene, const numeric::Body& body);

/// The body of `scene` by its sizes alone, as `clatter sequence` has it: a rod is a cylinder (radius 0: a thin rod), a
/// box its outline; a mesh as planar_body.  @throws as planar_body and numeric::Body.
[[nodiscard]] analytic::PlanarBody nominal_body(const Scene& scene);

/// The drop of `scene` with restitution and friction as its impact.* keys give them.
/// @throws analytic::OutsideModelError for a tilted drop; BadInput if drop.height is not above the centre of mass at
///         the touch.
[[nodiscard]] analytic::Drop impact_drop(const Scene& scene, const analytic::PlanarBody& body);
[[nodiscard]] analytic::Drop impact_drop(const Scene& scene);

/// Restitution and friction as the scene's impact.* keys give them.
[[nodiscard]] analytic::ImpactLaw impact_law(const Scene& scene);

/// A scene for `sequence` and `explain`: `speed` is that of the fall, where a height is given.
/// @throws BadInput as read_scene, and for a scene that sweeps its angle.
[[nodiscard]] Scene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides);

}  // namespace clatter::validation
