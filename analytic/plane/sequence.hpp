// SPDX-License-Identifier: GPL-3.0-or-later
// Impact sequences of a planar body: strike, fly, strike, ... until it ends.
#pragma once

#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// Impact sequence of a drop.
///
/// Several vertices that reach the ground together (the body lands flat) are one row by the rule of
/// strike_flat.  With e < 1 and gravity, infinitely many impacts in a finite time are recognised: in
/// closed form for flat and upright bouncing, where the times form a geometric series ending
/// 2w/(g(1−e)) after an impact with rebound speed w, otherwise by extrapolation of the flight times of one vertex or of
/// two in turn, accepted when its error meets `digits`; there is no velocity threshold.
/// Results scale exactly with powers of two of every unit.
/// A number that cannot be had after the first impact (a flight so long that its end has no digit, say) ends the
/// sequence as not_computed, an impact after the first that jams as outside_model.
/// @throws std::domain_error for a drop whose first contact does not approach the ground, or whose
///         parameters are out of range; OutsideModelError if the first impact jams; NumericalError if gravity,
///         tangential velocity or spin in units of the body's length and downward speed, or results in SI units, are
///         beyond the doubles, or the first impact cannot be computed.
[[nodiscard]] Sequence impact_sequence(const Drop& drop, const SequenceOptions& options = {});

/// impact_sequence() without what no sum over the rows needs: their amplification and all errors
/// but `predictable`, `relative` and those of start, contact angle, normal impulse and energy loss.
[[nodiscard]] Sequence summed_sequence(const Drop& drop, const SequenceOptions& options);

}  // namespace clatter::analytic
