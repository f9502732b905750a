// SPDX-License-Identifier: GPL-3.0-or-later
// Impact sequences of a body in space: strike, fly, strike, ... until it ends.
#pragma once

#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// Impact sequence of a drop in space.
///
/// Corners that reach the ground together strike by the rules of strike_together(); at the first touch those that are
/// within 32ε of the reach at one height, and where they are tilted by more than 8ε nothing is predictable.  With e < 1
/// and gravity, infinitely many impacts in a finite time are recognised: in closed form where a body that does not turn
/// bounces, otherwise by extrapolation of the flight times and impulses of corners that strike in turn;
/// there is no velocity threshold.  Extrapolation goes no further than rounding of heights lets
/// corners that strike in turn be told apart.  Where the energy that is left cannot lift the body off its lowest face,
/// it must settle there (settles()), whatever the order of the last impacts.  With e = 0 the sign of the corner's
/// acceleration decides whether the corner stays on the ground. Errors are propagated to first order, with derivatives
/// of each impact and flight by central differences, and bounded by three standard deviations. A
/// number that cannot be had after the first impact ends the sequence as not_computed, an impact after the first that
/// jams as outside_model; so do more than a million evaluations of the rotation. Results scale exactly with powers of
/// two of every unit.
/// @param times  ascending, since the first impact, at which the state is wanted (Sequence::states): not before the
///   release or, without one, that impact [s]
/// @throws std::domain_error for a drop whose first contact does not approach the ground, or whose parameters are out
///         of range; OutsideModelError if the first impact jams; NumericalError if the first impact cannot be computed.
[[nodiscard]] Sequence impact_sequence(const Drop& drop, const SequenceOptions& options = {},
                                       const std::vector<double>& times = {});

}  // namespace clatter::analytic::space
