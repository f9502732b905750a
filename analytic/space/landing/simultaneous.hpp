// SPDX-License-Identifier: GPL-3.0-or-later
// Several corners that strike the ground at once: an edge, a face.
//
// The body rebounds as a whole, every corner that approaches leaving at e times its approach speed, if pushes alone
// can do it:
//   edge   the frictionless impulses of its two corners from the normal inverse inertias G,
//              G p = (1+e) u,   u the approach speeds,                                                (1)
//          must not pull.  Their resultant acts at one point of the edge, which does not depend on e; the edge strikes
//          with that point as a corner would, friction and law included.  If friction then leaves one of the two
//          approaching, the edge does not rebound as a whole.
//   face   V_z, ω_x, ω_y → −e times themselves (Eq. 10 in space); ω_z changes through the inertia's off-diagonal
//          elements and by friction, which acts all over the polygon of the corners under a linear pressure.
//          The pressure point (−N_y, N_x)/P_z from the centre of mass, N the moment of the
//          normal impulses, must lie inside the polygon.  Where friction alone asks for pushes outside it, they act
//          at the polygon's boundary, and the rest of their moment tilts the body; what then still approaches strikes
//          as it would on its own; so do edges (edge_friction.hpp) and rims.  A face that slides straight inside
//          (slides_straight()) has no couple: friction acts at the point below the centre of mass (FaceContact). (2)
// The viscoelastic law takes e at the approach speed of the edge's point, and of the pressure point that a face has
// without friction, −V_z + ω·Mω/(m (−V_z)) with M the inverse of the horizontal part of I⁻¹: there the landing is that
// of one contact.
// Otherwise corners strike one after the other, the fastest approach first; those equally fast to rounding strike as an
// edge or a face if they can.  If they cannot, the end of an edge that is nearest to its pressure point is first; which
// corner of a face is, the law leaves open under friction: the lowest index is, and GroupImpact::is_open says so.  A
// corner whose approach is below the rounding of its velocity is at rest.
//
// What small tilts make of it: tilted_outcomes.hpp.
//
// The rim of a round end that lies level is a face with a full circle of touching points.
#pragma once

#include <optional>
#include <span>

#include "analytic/space/landing/striking_body.hpp"

namespace clatter::analytic::space {

/// The rebound as a whole of the corners that approach, or what friction that tilts the body makes of it, after which
/// some may still approach; nothing if pushes alone cannot do it, or if none approaches.
/// @param touching corners at one height; a single one strikes as in impact.hpp; a level rim touches alone
/// @throws as strike(); std::domain_error for a level rim beside another corner
[[nodiscard]] std::optional<GroupImpact> rebound_as_a_whole(const Body& body, const State& before,
                                                            std::span<const Corner> touching, const ImpactLaw& law);

/// The impact of a set of touching corners by the rules above.  No impulse if none approaches.
/// @throws as strike(); NumericalError if 40 000 strikes do not end it
[[nodiscard]] GroupImpact strike_together(const Body& body, const State& before, std::span<const Corner> touching,
                                          const ImpactLaw& law);

/// The impact of corners that arrive while others of the body, `held`, are at rest on the ground: those that arrive
/// strike, then all by the rules of strike_together() as far as they approach thereafter.
/// @throws as strike_together()
[[nodiscard]] GroupImpact strike_beside(const Body& body, const State& before, std::span<const Corner> arriving,
                                        std::span<const Corner> held, const ImpactLaw& law);

}  // namespace clatter::analytic::space
