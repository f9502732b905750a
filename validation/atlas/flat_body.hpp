// SPDX-License-Identifier: GPL-3.0-or-later
// What of a scene's body lands close to flat: two contacts in the plane, or the corners of a face in space.
#pragma once

#include <string>
#include <variant>

#include "analytic/near_flat/footprint.hpp"
#include "analytic/near_flat/two_contacts.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {

/// In the plane the contacts from left to right; in space the corners counter-clockwise as seen from above.
using FlatContacts = std::variant<analytic::near_flat::TwoContacts, analytic::near_flat::Footprint>;

struct FlatBody {
  FlatContacts contacts;
  std::string words;  ///< "two contacts, …", "face of 4 corners …"
  double restitution = 1;
};

/// The face of a body's hull on which it comes to lie when it is turned least about its lowest corner and then about
/// the edge that comes down: axis x along that of the body (or y where x is upright).
/// @param attitude  body to world
/// @throws OutsideModelError for a body with rims, whose footprint is no polygon, or without a face
[[nodiscard]] analytic::near_flat::Footprint landing_face(const analytic::space::Body& body,
                                                          const analytic::space::Quaternion& attitude);

/// The contacts of a scene: a rod's in the plane, and with `in_plane` those of any outline; else the landing face.
/// @throws as landing_face(), DiscreteBody; OutsideModelError for a restitution that changes with the speed
[[nodiscard]] FlatBody flat_body(const Scene& scene, bool in_plane);

/// A thin uniform plate in the form of a triangle; all of them are one and the same close to flat.
[[nodiscard]] FlatBody flat_triangle(double restitution);

}  // namespace clatter::validation
