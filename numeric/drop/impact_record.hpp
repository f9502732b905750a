// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulation says of each impact, and how it ended.
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "numeric/base/linear_algebra.hpp"
#include "numeric/body/body.hpp"
#include "numeric/stepping/contact_result.hpp"

namespace clatter::numeric {

/// The numbers of an impact.  The same struct holds their error estimates.
struct ImpactNumbers {
  double start = 0;                   ///< touch-down, after that of impact 1 [s]
  double duration = 0;                ///< until nothing touches any more [s]
  double inclination = 0;             ///< of the body's x axis at touch-down, > 0: end a lower [rad]
  double contact_angle = 0;           ///< acute angle between that axis and the ground [rad]
  double approach_speed = 0;          ///< of the touching point, downward [m/s]
  double restitution = 0;             ///< its speed of separation over that of approach; NaN with several touches
  Vector3 impulse = Vector3::Zero();  ///< of the contact force, world [N·s]
  double peak_force = 0;              ///< largest normal force [N]
  double peak_time = 0;               ///< when, after this touch-down [s]
  double indentation = 0;             ///< greatest depth of a point of the body below the ground [m]
  Vector3 velocity_after = Vector3::Zero();          ///< world [m/s]
  Vector3 angular_velocity_after = Vector3::Zero();  ///< world [rad/s]
  double energy_before = 0;                          ///< translational + rotational + potential (m g z) [J]
  double energy_after = 0;                           ///< [J]
  double energy_loss = 0;                            ///< [J]
  double work_damping = 0;                           ///< dissipated by the ground's dampers [J], >= 0
  double work_friction = 0;                          ///< dissipated by friction [J]
  double work_released = 0;  ///< elastic energy left in the ground where the clamp let go [J], >= 0
};

struct ImpactRecord {
  ImpactNumbers value;
  ImpactNumbers error;  ///< estimates; NaN if there is none
  ContactEnd end = ContactEnd::a;
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< at touch-down, body to world
  Vector3 place = Vector3::Zero();  ///< of the vertex that touches, or the mean of several; body frame [m]
  int touches = 1;                  ///< separate places that came down during this impact
  FrictionMode mode = FrictionMode::frictionless;
  /// Whether the whole body lay below the ground for a time: the foundation, a bed below the body, is then pressed from
  /// within, and its law stands for nothing real.
  bool submerged = false;
  /// What FrictionLaw::local would change in the tangential impulse of this contact, estimated to a factor of about 3;
  /// 0 for the other laws, where it is not asked for, and where a bound says that it cannot matter [N·s].
  double local_slip = 0;
  /// Error of the velocities before and after this contact that runs to any tolerance near this one make alike, by
  /// taking patches that spin slowly as stuck (FrictionPhases::left_out), grown since [m/s].
  double left_out_before = 0, left_out = 0;
  /// Growth of a relative error of the start until the end of this impact; NaN if not asked for.  Contacts after one
  /// that is not predictable count as if they let errors be.
  double amplification = 0;
  /// Whether rounding errors, so grown, stay below one part in a hundred, and a second run, if errors were asked for,
  /// has not gone another way before.
  bool predictable = true;
  /// At the end of a body that comes to rest but for rocking (GroundMotion::rocks): speeds of that [m/s], [rad/s], and
  /// by how much it may shift the end of a slide [s].
  double left_speed = 0, left_turning = 0, left_time = 0;
  /// Force of the ground on a body that lies still from then on, which lets the impulse depend on when it is said to.
  Vector3 carried = Vector3::Zero();  ///< [N]
  double energy_stored = 0;           ///< left in the ground's springs: 0 after a lift-off, not at rest [J]
  /// energy_loss − work_damping − work_friction − work_released − energy_stored, over the energy at the start or
  /// that stored, whichever is larger: the ledger's gap.
  double ledger_gap = 0;
};

/// Whether rounding errors of double precision, grown by `amplification`, spare the second digit; so does one not
/// known.
[[nodiscard]] inline bool is_predictable(double amplification) {
  return !(amplification >= 0.01 / std::numeric_limits<double>::epsilon());
}

enum class Outcome {
  no_further_impact,  ///< nothing reaches the ground any more
  impact_limit,       ///< as many impacts as asked for
  at_rest,            ///< the body lies still on the ground
  sustained_contact,  ///< it slides or spins on there steadily, and no friction stops it
  evaluation_limit,   ///< contact goes on; the last row is unfinished and not listed
  step_too_small,     ///< the integrator cannot reach the tolerance; the last row is not listed
  not_representable,  ///< numbers of this scene leave the range or resolution of doubles
  flight_undecided,   ///< the next touch-down could not be decided within the work allowed
  interrupted,        ///< by `progress`
  time_limit,         ///< Request::until; an impact that goes on then is not listed
};

}  // namespace clatter::numeric
