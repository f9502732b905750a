// SPDX-License-Identifier: GPL-3.0-or-later
// The load of a ground of springs, of a pad, or of an elastic half-space.
#pragma once

#include <memory>

#include "numeric/contact/contact_load.hpp"

namespace clatter::numeric {

/// What presses on a ground: on springs, the body's surface, smooth where its shape is, else its facets; on a pad, that
/// on each of its beds; on a half-space, that over a patch of the same.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_on(const Body& body, const Ground& ground);

}  // namespace clatter::numeric
