// SPDX-License-Identifier: GPL-3.0-or-later
// The face on which a body has to come to rest.
#pragma once

#include <optional>

#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// Energy of the vertical motion, of turning about horizontal axes, and of height above rest on the face of the lowest
/// three vertices, of a rod that has two above rest on these; infinite where three are not of one face, or the body has
/// round surfaces [J].
[[nodiscard]] double vertical_energy(const Drop& drop, const State& now);

/// The face on which a body must come to rest, because its energy keeps it there in one of two ways.
///  1. The energy E of its vertical motion and turning about horizontal axes, above that of rest on the lowest face,
///     cannot lift it off by more than
///         height of the centre of mass  E/(m g),   tilt  E/(m g ρ),                                   (1)
///     ρ the distance inside the face of the point that the resting body presses on: that below the centre of mass,
///     moved by friction, by μ times the centre's height at most, and by what products of inertia do to a spinning
///     body.  No other point comes down at such a tilt, and impacts with e < 1 take the energy away.  Rest is taken to
///     come within 8 v/(g (1 − e)), v = √(2E/m), which is not proved: a body that does not tilt needs 2, the slowest of
///     360 random boxes 3.0, or 3.4 v/g with e <= 0.3 (time-stepping of their unilateral motion).
///  2. Its energy, without that of horizontal motion that no friction can change, is less than m g H, H the height of
///     the centre of mass on the lowest edge over which it can roll from the face on which it would come to rest
///     without energy to another such face:
///         h(u) = max_i u·r_i, u the direction down: h grows towards an edge, its saddles; rolling follows −grad h. (2)
///     Newton's law with friction can create energy: it has to be less than a quarter of that, both above rest on the
///     face, which is not proved to be enough.  1500 random drops with e <= 0.95 and μ <= 1.5 gained 43 % at most.  It
///     leaves open when the body rests.
/// Nothing where neither holds.
/// @param time  of the state, since the first impact [s]
[[nodiscard]] std::optional<Rest> settles(const Drop& drop, const State& now, double time);

}  // namespace clatter::analytic::space
