// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a contact has become a motion that goes on as it is.
#pragma once

#include <optional>

#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/ground_motion.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// The motion of a body that lies still, that slides straight on until friction stops it, or that goes on for ever;
/// nothing where the contact goes on.  Of vertical motion, tipping and accelerations other than that of the motion
/// nothing is left: to a millionth of what a fall into this contact would have, or to `kept_up` [m/s], the speed that
/// the errors of steps keep up; of a slide that friction stops to a thousandth.
/// - It rests where it neither slides nor spins, or slides at v without spin under the constant deceleration
///       a = μ_k g ∓ g_x,   for u/a over u²/(2 a),   u = v + μ_k v_z;
///   then it takes the tilt in which it is in equilibrium, and what that sets free goes to the dampers.  The
///   regularised law stops nothing in a finite time, and a slide across a slope is not straight.
/// - It slides on without friction, or down a slope that friction cannot stop it on.
/// - It spins on without friction, or about the pressure centre of a patch that counts as a point.
/// - A body whose shape and inertia are round about its axis rolls on on level ground, or turns on without friction.
///   The ground's dampers slow that in proportion to its speed.
[[nodiscard]] std::optional<GroundMotion> motion_on_the_ground(const ContactSystem& system, const ContactInstant& at,
                                                               double kept_up);

/// Watches a body that the ground carries for rocking and heaving that the dampers take away so slowly (they act in
/// proportion to the depth) that to follow it would never end.
class RockingWatch {
 public:
  /// Begins with a contact, at this count of evaluations.
  void begin(long evaluations);
  /// The rest or slide of the body about which it rocks, told after each step.  Two windows of 10,000 evaluations, each
  /// of at least half a period 2π √(depth/g) of the load that the ground carries, without which the short while in
  /// which an impact turns the body back would be one, must show that the body heaves by less than a fall into its
  /// contact and turns no faster than that allows, neither more in the second than in the first, and that it stays in
  /// place or slides all the time in a way that friction stops. `left_speed` and `left_turning` are the largest speeds
  /// of the second: observed, no bound.  The centre of mass of a body that rocks while it slides is slowed by the same
  /// impulse, μ_k (m g t − m v_z), as long as all of it slips.
  [[nodiscard]] std::optional<GroundMotion> look(const ContactSystem& system, const ContactInstant& at);

 private:
  struct Window {
    double heave = 0, sliding = 0, turning = 0, spin = 0;  ///< largest speeds [m/s], [rad/s]
    double depth = 0;                                      ///< largest [m]
    Vector3 place = Vector3::Zero();                       ///< at its end [m]
    bool slips = true;                                     ///< all the time
    std::optional<double> begin{};                         ///< after touch-down [s]
  };
  [[nodiscard]] std::optional<GroundMotion> judge(const ContactSystem& system, const ContactInstant& at) const;

  Window now_;
  std::optional<Window> before_;
  long ends_ = 0;
};

}  // namespace clatter::numeric
