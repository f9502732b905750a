// SPDX-License-Identifier: GPL-3.0-or-later
// A body that turns on while one or two of its corners stay on the ground.
//
// ground_forces.hpp has the forces.
//     corner sticks   while |f_t| <= μ N; where that ends, slip begins against the friction that held it
//                     (slip_start.hpp).  An edge sticks while some division of the friction along it holds both
//                     corners; then one slips across it, or both slip
//     corner slips    until its velocity is zero; thereafter it sticks if it can, else goes on in the direction in
//                     which its acceleration then is, if there is one such direction only
//     lift-off        N_i <= 0
// Where slip has not one solution (Painlevé), the law leaves open what happens.
//
// An edge that stays is held and rubbed at its two corners, which gives each its own slip or hold and needs no rule for
// the pressure between them.  Where it strikes, friction acts all along it (edge_friction.hpp): straight slip is the
// same, but a staying edge that turns about the vertical is braked up to twice as much.
#pragma once

#include <optional>
#include <vector>

#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// The motion with `corners` on the ground, until others come down, the ground no longer pushes, or the law leaves it
/// open.  Without error bars.
/// Accuracy: 1e-12 of angle and velocities, also where slip begins or ends, while not near an instability.
/// @param now  the corners at height 0 and without normal velocity, to rounding: what is left of those is taken away
/// @param corners  one or two vertices
/// @throws NumericalError if 5 000 steps do not end it
[[nodiscard]] SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners);

/// How a contact's end changes with its beginning, to first order.
struct ContactDerivatives {
  /// Changes of time, attitude (rotation vector, world frame), velocity and angular velocity at the end for those at
  /// the beginning: the end shifts so that what ends the contact is zero there.
  Eigen::Matrix<double, 10, 10> of_state = Eigen::Matrix<double, 10, 10>::Zero();
  double bend = 0;       ///< |h″/h′| of the corner that comes down [1/s]
  double clearance = 0;  ///< least height of others that come down later [m]

  /// Whether the first order serves, and no other corner comes down first, with these bounds.
  /// @param late  on the error of the contact's end, beside that of its beginning [s]
  /// @param turned  on that of the attitude then [rad]
  [[nodiscard]] bool hold(const Body& body, double late, double turned) const {
    return late * bend <= 0.02 && clearance > 2 * body.reach() * turned;
  }
};

/// By central differences over a fixed time, however little of a height is left.  Nothing where a neighbour ends
/// otherwise, as where corners that come down at once do not in a neighbour.
/// @param contact  what follow_contact() has found
/// @param errors  of `now`, bounds, for which the first order has to serve
[[nodiscard]] std::optional<ContactDerivatives> contact_derivatives(const Drop& drop, const State& now,
                                                                    const SustainedContact& contact,
                                                                    const StateErrors& errors);

/// What computing a contact may add to the errors: what its steps err by, and what is taken from its beginning.  It
/// adds to those at the beginning, which the contact carries on, and once more to those at the end.
[[nodiscard]] StateErrors contact_rounding(const Drop& drop, const State& now, const SustainedContact& contact);

/// The same with error bars, by contact_derivatives(); infinite where those are not known.
/// @param errors  of `now`, bounds
[[nodiscard]] SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners,
                                              const StateErrors& errors);

/// The state at `time` after the beginning of a contact, and bounds on the errors that it has at exactly that time;
/// nothing where it could not be computed.
/// @param errors  of `now`, bounds
struct StateInContact {
  State state;
  StateErrors error;
};
[[nodiscard]] std::optional<StateInContact> contact_at(const Drop& drop, const State& now,
                                                       const SustainedContact& contact, double time,
                                                       const StateErrors& errors);

/// Sets normal_impulse_error from the errors of the states at its beginning and end.
void add_impulse_error(const Drop& drop, const StateErrors& before, SustainedContact& contact);

/// Whether corners that stay are followed: one or two vertices, Coulomb's law or none, and a ground whose slow contacts
/// lose something.
[[nodiscard]] bool can_follow(const Drop& drop, const std::vector<int>& corners);

/// How a body goes on whose sequence ends with a corner or an edge that stays on the ground (Sequence::standing), where
/// that can be followed.
/// @throws as follow_contact()
[[nodiscard]] std::optional<SustainedContact> contact_after(const Drop& drop, const Sequence& sequence);

}  // namespace clatter::analytic::space
