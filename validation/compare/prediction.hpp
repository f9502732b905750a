// SPDX-License-Identifier: GPL-3.0-or-later
// How far the two models must differ on a ground of finite stiffness, from what the discrete model leaves out.
#pragma once

#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence.hpp"
#include "validation/run/motion_numbers.hpp"

namespace clatter::validation {

/// Sizes of the deviations of one impact's numbers; the sum over this impact and those before it, whose deviations
/// are carried along by the motion between them.
struct PredictedSize {
  MotionNumbers gravity{};      ///< g T added to the approach: gravity acts during the contact, for T
  MotionNumbers turning{};      ///< the body turns by |Ω| T/2 until the middle of the contact
  MotionNumbers indentation{};  ///< the contact point lies up to v T/π inside the corner
  MotionNumbers delay{};        ///< half the duration of each contact before
  MotionNumbers tipping{};      ///< of a face whose friction tips the body on an even bed; on any stiffness
  [[nodiscard]] MotionNumbers total() const;
};

/// One entry per row of `sequence`, as far as `contact_times` (the duration T of each contact [s]) and the rows go.
/// Each effect is put into the state before each impact in turn and carried on by the discrete model; where that leads
/// to another sequence of contacts, the sizes from there on are infinite.
[[nodiscard]] std::vector<PredictedSize> predicted_sizes(const analytic::Drop& drop, const analytic::Sequence& sequence,
                                                         const std::vector<double>& contact_times);

/// As predicted_sizes in the plane: gravity for T, a turn by |Ω| T/2 about the axis of Ω before or after, whichever is
/// faster, the corner v T/(2π) further inside along each of the body's axes, half the duration of each contact before.
/// The body has no rims.
[[nodiscard]] std::vector<PredictedSize> predicted_sizes(const analytic::space::Drop& drop,
                                                         const analytic::space::Sequence& sequence,
                                                         const std::vector<double>& contact_times);

/// How far an even bed may be from the rule of a level face that rubs, whatever its stiffness.  Friction acts at the
/// depth h below the centre of mass.  The rule's pressure leans against it, so that the body does not turn; an even bed
/// leans only as far as the body tips.
struct FaceTipping {
  double lean = 0;  ///< δω × reach / approach speed, δω the turn by friction under even pressure; 0 without friction
  /// How far the row's numbers are from a face under even pressure, δω, what it does to slip, h δω, and lean² of
  /// the approach speed for the corners that let go early.
  MotionNumbers size{};
};

/// @pre row.group->is_whole
[[nodiscard]] FaceTipping face_tipping(const analytic::space::Drop& drop, const analytic::space::ImpactRow& row);

/// The drop that begins with this row: the state before it, turned or mirrored so that the inclination lies in
/// [0°, 90°].  Speeds of tangential and angular motion may change sign with that.
[[nodiscard]] analytic::Drop drop_at(const analytic::Drop& drop, const analytic::ImpactRow& row);

/// The same in space: the state before it as it is.
[[nodiscard]] analytic::space::Drop drop_at(const analytic::space::Drop& drop, const analytic::space::ImpactRow& row);

}  // namespace clatter::validation
