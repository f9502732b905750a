// SPDX-License-Identifier: GPL-3.0-or-later
// What small tilts make of a level landing, as a ring: each direction in the colour of its outcome.
#pragma once

#include <optional>
#include <span>

#include "analytic/space/impact_rows.hpp"
#include "validation/output/picture.hpp"

namespace clatter::validation {

/// The ring of the first landing of several corners, or of a level rim, that tilts decide; nothing if there is none.
/// Directions are those in which the tilted corners lie higher, counter-clockwise from x, the view from above.  The
/// seven outcomes with the largest shares have a colour of their own; where they vary with the direction (level rim),
/// seven classes of equal range of the body's rebound speed.
[[nodiscard]] std::optional<PicturePanel> tilt_panel(const analytic::space::Drop& drop,
                                                     std::span<const analytic::space::ImpactRow> rows);

}  // namespace clatter::validation
