// SPDX-License-Identifier: GPL-3.0-or-later
// The ground's load on a convex body without corners, by quadrature over its true surface.
#pragma once

#include <memory>

#include "numeric/contact/contact_load.hpp"

namespace clatter::numeric {

/// The surface of a body: smooth where its shape is, else its facets.
/// @param footprint  gets all that lies below the ground, if not null.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_surface(const Body& body, const Ground& ground,
                                                              Footprint* footprint = nullptr);

}  // namespace clatter::numeric
