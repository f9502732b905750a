// SPDX-License-Identifier: GPL-3.0-or-later
// A body that turns on while one or two of its corners stay on the ground.
//
// With f_i the force of the ground on the corner at r_i from the centre of mass, W_ij = 1/m − [r_i]× I⁻¹ [r_j]× and
//     a_i⁰ = −g ẑ + [I⁻¹ (Iω × ω)] × r_i + ω × (ω × r_i),
// the corners accelerate with
//     a_i = a_i⁰ + Σ_j W_ij f_j.                                                                        (1)
// A corner that sticks has a_i = 0.  One that slips in direction s_i has a_i·ẑ = 0 and f_i = N_i (ẑ − μ s_i).  That
// gives the forces, but for the part along an edge both corners of which stick: there only its sum is known.
//     corner sticks   while |f_t| <= μ N; an edge while some division of that sum holds both corners so; slip that
//                     begins there is not followed: its direction settles in no time beside that in which it grows
//     corner slips    until its velocity is zero; thereafter it sticks if it can, else goes on in the direction in
//                     which (1) then accelerates it, if there is one such direction only
//     lift-off        N_i <= 0
// Slip has one solution if the normal inverse inertias G_ij = ẑ·W_ij (ẑ − μ s_j) are a P-matrix; where not (Painlevé),
// the law leaves open what happens, as where the friction of an edge gives way.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analytic/space/impact_rows.hpp"

namespace clatter::analytic::space {

/// Bounds on the errors of a state and its time; infinite where not known.
struct StateErrors {
  double time = std::numeric_limits<double>::infinity();              ///< [s]
  double attitude = std::numeric_limits<double>::infinity();          ///< [rad]
  double velocity = std::numeric_limits<double>::infinity();          ///< [m/s]
  double angular_velocity = std::numeric_limits<double>::infinity();  ///< [rad/s]
};

enum class ContactEnd {
  arrival,   ///< other corners come down: the next impact
  lift_off,  ///< the ground no longer pushes: a flight begins
  open,      ///< the law leaves open how it goes on, or friction no longer holds a corner that stuck
};

struct SustainedContact {
  double begin = 0;          ///< time since the first impact [s]
  double duration = 0;       ///< [s]
  std::vector<int> corners;  ///< that stay at its beginning (Corner::index)
  std::vector<int> pivots;   ///< that still do at its end
  bool slips = false;        ///< with friction, at times
  bool sticks = false;       ///< at times
  ContactEnd end = ContactEnd::open;
  std::string reason;         ///< why the law leaves it open
  std::vector<int> arriving;  ///< that come down at the end
  double approach_speed = 0;  ///< of the fastest of these [m/s]
  State after;                ///< at the end
  StateErrors error;          ///< of `after`, and of its time
  double normal_impulse = 0;  ///< of the ground meanwhile [N·s]
  double energy_loss = 0;     ///< by friction [J]
};

/// The motion with `corners` on the ground, until others come down, the ground no longer pushes, or the law leaves it
/// open.  Without error bars.
/// Accuracy: 1e-11 of angle and velocities while no slip begins or ends near an instability.
/// @param now  the corners at height 0 and without normal velocity, to rounding: what is left of those is taken away
/// @param corners  one or two vertices
/// @throws NumericalError if 20 000 steps do not end it
[[nodiscard]] SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners);

/// The same with error bars: first order, by differences in each direction that the contact leaves free; infinite where
/// a neighbour within 1e-8 ends otherwise.
/// @param errors  of `now`, bounds
[[nodiscard]] SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners,
                                              const StateErrors& errors);

/// How a body goes on whose sequence ends with a corner or an edge that stays on the ground
/// (Outcome::sustained_contact); nothing for rims and round surfaces, an impulse ratio, or a ground whose slow contacts
/// lose nothing.
/// @throws as follow_contact()
[[nodiscard]] std::optional<SustainedContact> contact_after(const Drop& drop, const Sequence& sequence);

}  // namespace clatter::analytic::space
