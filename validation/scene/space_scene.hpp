// A scene as the discrete model in space sees it.
#pragma once

#include "analytic/space/sequence.hpp"
#include "numeric/body.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Whether the planar discrete model does for the drop: it stays in its plane by symmetry, and the body has an outline
/// of at most four corners there.  Otherwise the model in space runs, which gives the same in the plane up to rounding.
[[nodiscard]] bool is_planar(const Scene& scene, const numeric::Body& body);
/// The same for the body by its sizes alone.
[[nodiscard]] bool is_planar(const Scene& scene);

/// The body with its own corners: the vertices of the hull of its surface.
[[nodiscard]] analytic::space::Body space_body(const numeric::Body& body);
/// The drop for the discrete model: real corners and inertia, restitution from the ground's damping at each impact's
/// own speed, Coulomb friction with the sliding coefficient.
/// @throws analytic::OutsideModelError for regularised friction.
[[nodiscard]] analytic::space::Drop space_drop(const Scene& scene, const numeric::Body& body);

/// The body by its sizes alone: a rod is a round cylinder with its rims (radius 0: a thin rod).
[[nodiscard]] analytic::space::Body nominal_space_body(const Scene& scene);
/// The drop with restitution and friction as its impact.* keys give them; an impulse ratio acts along x.
/// @throws BadInput if drop.height is not above the centre of mass at the touch.
[[nodiscard]] analytic::space::Drop impact_space_drop(const Scene& scene);

/// Name of a corner of the body: the signs of the coordinates of a box's corner ("+x-y+z"), "a" and "b" of a rod's
/// ends, otherwise its number from 1.
[[nodiscard]] std::string corner_name(const Scene& scene, const analytic::space::Corner& corner);

}  // namespace clatter::validation
