// A scene of the continuous model as the discrete model sees it.
#pragma once

#include "analytic/sequence.hpp"
#include "numeric/body.hpp"
#include "validation/scene/simulation_scene.hpp"

namespace clatter::validation {

/// The planar body with the same mass, the same moment of inertia about y and, as vertices, the corners of the real
/// outline in the x–z plane: a, b (below), a-top, b-top.
/// @throws analytic::OutsideModelError if the body is not symmetric about the plane y = 0 (products of inertia or
///         corners off it by more than 1e-9 of its size), or its outline has more than four corners.
[[nodiscard]] analytic::PlanarBody planar_body(const numeric::Body& body);

/// The drop of `scene` for the discrete model: real contact points and inertia, restitution from the exact map of the
/// ground's damping at each impact's own speed, Coulomb friction with the sliding coefficient.
/// @throws analytic::OutsideModelError as planar_body, and for a tilted drop or regularised friction.
[[nodiscard]] analytic::Drop discrete_drop(const SimulationScene& scene, const numeric::Body& body);

}  // namespace clatter::validation
