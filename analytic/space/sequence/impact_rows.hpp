// SPDX-License-Identifier: GPL-3.0-or-later
// A drop in space, the rows of its impact sequence, and the units in which that is computed.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analytic/base/limits.hpp"
#include "analytic/plane/impact_rows.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "analytic/space/landing/simultaneous.hpp"

namespace clatter::analytic::space {

/// The body as it touches the ground for the first time; its lowest vertex or rim is put on z = 0, its centre of mass
/// on x = y = 0.  With a release height, the body as it is let go to fly freely until then.
struct Drop {
  Body body;
  Quaternion attitude = Quaternion::Identity();  ///< body to world, of length 1 to within 1e-6
  Vector3 velocity = Vector3::Zero();            ///< of the centre of mass, world frame, before the first impact [m/s]
  Vector3 angular_velocity = Vector3::Zero();    ///< world frame [rad/s]
  double gravity = 0;                            ///< towards the ground, >= 0 [m/s²]
  double gravity_along = 0;                      ///< along x, where the ground slopes [m/s²]
  /// Height of the centre of mass above the ground [m]; for a fall of h until the lowest point touches
  /// h + touch_height(body, attitude).
  std::optional<double> release_height{};
  ImpactLaw law;

  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const;
};

/// A drop of the plane as one in space: the inclination α is a turn by −α about y, V_t, V_n and Ω are V_x, V_z and ω_y.
/// @param body  in space, with the planar one as its outline in the plane y = 0: make_box() and make_rod() of one size.
///   A box has two corners at each end that touch at once, and which of them leads is known to no digit: its bounds end
///   there; those of outline(), which cannot leave the plane, do not.
[[nodiscard]] inline Drop in_space(const analytic::Drop& drop, Body body) {
  const double half = drop.inclination.radians / 2;
  return {.body = std::move(body),
          .attitude = {std::cos(half), 0, -std::sin(half), 0},
          .velocity = {drop.velocity.tangential, 0, drop.velocity.normal},
          .angular_velocity = {0, drop.velocity.angular, 0},
          .gravity = drop.gravity,
          .gravity_along = drop.gravity_along,
          .release_height = drop.release_height,
          .law = drop.law};
}
[[nodiscard]] inline Drop in_space(const analytic::Drop& drop) { return in_space(drop, outline(drop.body)); }

/// Translational, rotational and potential energy, zero at the ground below the first touch's centre of mass [J].
[[nodiscard]] double mechanical_energy(const Drop& drop, const State& state);

/// Bounds on the errors of an impact's numbers, each in the unit of its number (of a vector: on the length of its
/// error); infinite in a row that cannot be predicted.
struct RowErrors {
  bool predictable = false;                  ///< errors have not grown so far that another sequence may follow
  double start = detail::infinite;           ///< [s]
  double attitude = detail::infinite;        ///< angle of the rotation between the attitude and the true one [rad]
  double approach_speed = detail::infinite;  ///< [m/s]
  double impulse = detail::infinite;         ///< [N·s]
  double velocity_after = detail::infinite;  ///< [m/s]
  double angular_velocity_after = detail::infinite;                          ///< [rad/s]
  double energy_before = detail::infinite, energy_after = detail::infinite;  ///< [J]
};

/// One impact.
struct ImpactRow {
  double start = 0;             ///< time since the first impact [s]
  std::vector<Corner> corners;  ///< that arrived, then those held; the first is the one that `impact` is of
  State before;                 ///< height of the centre of mass in position.z
  /// Impact of the corner, or of several corners or a level rim together: then the contact velocities are those of the
  /// first corner, path and energy those of the group, p_c and what describes slip are not known (NaN).
  Impact impact;
  std::optional<GroupImpact> group;  ///< if several corners arrived, or all of a rim that lies level
  std::size_t held = 0;              ///< how many of the corners, the last ones, were on the ground already
  double energy_before = 0;          ///< translational + rotational + potential (z = 0 at the ground) [J]
  double energy_after = 0;
  /// Relative change of this row's quantities (attitude in radians, time, impulse) per relative change of the drop's
  /// velocities or change of its attitude: the largest.  NaN if the row cannot be predicted.
  double amplification = 0;
  RowErrors error;      ///< all unknown without SequenceOptions::amplification
  FirstContact flight;  ///< that led here; empty for the first row of a drop without a release

  // As in the plane.

  /// P, world frame [N·s].
  [[nodiscard]] Vector3 impulse() const { return impact.impulse; }
  /// V′ of the centre of mass, world frame [m/s].
  [[nodiscard]] Vector3 velocity_after() const { return impact.velocity_after; }
  /// ω′, world frame [rad/s].
  [[nodiscard]] Vector3 angular_velocity_after() const { return impact.angular_velocity_after; }
};

[[nodiscard]] State state_after(const ImpactRow& row);
/// The state in which a drop is given, with the release height where there is one.
[[nodiscard]] State given_state(const Drop& drop);

/// The remaining impacts after the last row: infinitely many in a finite time.
struct Tail {
  double end_time = 0;        ///< time since the first impact [s]
  double end_time_error = 0;  ///< with that of the last row; infinite where the end cannot be predicted [s]
  double normal_impulse = 0;  ///< sum over the remaining impacts [N·s]
  double normal_impulse_error = 0;
  Vector2 tangential_impulse = Vector2::Zero();  ///< likewise, world frame [N·s]
  double tangential_impulse_error = 0;           ///< of vectors: bounds on the length of the error
  std::vector<int> corners;                      ///< that strike in turn and stay on the ground (Corner::index)
  bool closed_form = false;
  double energy_loss = 0;                    ///< [J]
  Vector3 velocity_after = Vector3::Zero();  ///< of the centre of mass at the end [m/s]
  double velocity_error = 0;
  Vector3 angular_velocity_after = Vector3::Zero();  ///< [rad/s]
  double angular_velocity_error = 0;

  /// Nothing is known of the errors.
  void forget();
};

/// Bounds on the errors of a state and its time; infinite where not known.
struct StateErrors {
  double time = detail::infinite;              ///< [s]
  double attitude = detail::infinite;          ///< [rad]
  double velocity = detail::infinite;          ///< [m/s]
  double angular_velocity = detail::infinite;  ///< [rad/s]

  /// Errors of the time, and of the others in each direction: attitude, velocity, angular velocity.
  [[nodiscard]] Eigen::Matrix<double, 10, 1> in_each_direction() const;
};

/// A body with corners at rest on the ground, but for slip, that turns on them.
struct Standing {
  double time = 0;  ///< since the first impact [s]
  State state;
  StateErrors error;
  std::vector<int> corners;  ///< Corner::index
};

/// The body at a time that was asked for.
struct StateAt {
  double time = 0;                           ///< since the first impact [s]
  std::size_t rows = 0;                      ///< impacts until then
  bool touches = false;                      ///< some of it stays on the ground
  bool is_known = false;                     ///< else the model does not say how it moves then, and all is NaN
  State state = unknown_state();             ///< x, y from those of the first impact
  double energy = detail::missing;           ///< as mechanical_energy() [J]
  StateErrors error;                         ///< bounds, of the state at exactly that time
  double position_error = detail::infinite;  ///< on the length; infinite if the order of impacts before is open [m]
  double tilt_error = detail::infinite;      ///< part of the attitude's across the vertical [rad]
  double energy_error = detail::infinite;    ///< [J]
  /// Impact whose time is so near that errors decide on which side this is; 0: none.  The errors bear both.
  std::size_t beside = 0;
};

enum class ContactEnd {
  arrival,   ///< other corners come down: the next impact
  lift_off,  ///< the ground no longer pushes: a flight begins
  joining,   ///< another corner has come down without speed, and stays
  rest,      ///< a body that is flat (Body::is_flat()) lies on them: still, or in a motion that friction does not stop
  open,      ///< the law leaves open how it goes on, or friction no longer holds a corner that stuck
};

/// The motion of a body one or two corners of which stay on the ground.
struct SustainedContact {
  std::size_t rows = 0;      ///< that come before
  double begin = 0;          ///< time since the first impact [s]
  double duration = 0;       ///< [s]
  std::optional<Tail> tail;  ///< hops that end in it, if the sequence goes on after it
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
  double normal_impulse_error = detail::infinite;
  double energy_loss = 0;  ///< by friction, and of what normal velocity and slip hops have left [J]
};

/// The face on which a body comes to rest, still sliding and turning about the vertical there unless friction stops it.
struct Rest {
  std::vector<int> corners;  ///< of the face, in order around it, the last vertex first (Corner::index)
  /// By when nothing of the body bounces or rocks any more, since the first impact; infinite where not known [s].
  double latest = 0;
};

/// What the body does after its last impact and contact.
struct LastMotion {
  enum class Kind {
    rests,   ///< it does not move
    slides,  ///< along the ground, spinning or not
    spins,   ///< about the vertical, on the spot
    rolls,   ///< rolls on for ever, after it may have slipped
  } kind = Kind::rests;
  double begin = 0;                          ///< since the first impact [s]
  double begin_error = detail::infinite;     ///< bound on its error [s]
  State state;                               ///< then
  double duration = 0;                       ///< until it is at rest or, if it rolls, rolls; infinite: never [s]
  double distance = 0;                       ///< that the centre of mass goes meanwhile [m]
  Vector3 velocity_after = Vector3::Zero();  ///< then; if it never is, now [m/s]
  Vector3 angular_velocity_after = Vector3::Zero();  ///< likewise [rad/s]
};

struct Sequence {
  std::vector<ImpactRow> rows;
  Outcome outcome = Outcome::no_further_impact;
  bool moves_on = false;              ///< with Outcome::at_rest: it lies on the ground, but slides or spins there
  std::string message;                ///< why it ended, one sentence
  std::vector<std::string> warnings;  ///< such as energy created by Newton's law with friction
  std::optional<Tail> tail;
  std::vector<SustainedContact> contacts;  ///< that the sequence went through, with SequenceOptions::until_rest
  std::optional<Standing> standing;        ///< if sustained_contact: on which corners
  std::vector<StateAt> states;             ///< at the times asked for
  std::optional<LastMotion> last_motion;   ///< where it is known what the body does after all that
  std::optional<Rest> rest;                ///< if what is left of the motion can end on one face only
  double energy_at_end =
      0;               ///< after the last of rows, tail and contacts; energy_before of the first less all losses [J]
  NearMiss near_miss;  ///< of the last flight, if no_further_impact
  /// h″ of the corner that stays on the ground, if sustained_contact without a tail [m/s²].
  double end_acceleration = 0;
  double total_normal_impulse = 0;  ///< rows, contacts and tail [N·s]
  /// Bound on its error; infinite where errors are not followed, or a row cannot be predicted and the body does not
  /// come to rest for certain, which bounds it by m (g T + v) [N·s].
  double total_normal_impulse_error = detail::infinite;
  double first_flight = 0;        ///< time from the release to the first impact [s]
  double first_flight_error = 0;  ///< bound on its error [s]
  /// Whether the outcome is certain, and not only that of one of the sequences that the errors leave open.
  bool end_predictable = false;
  int root_evaluations = 0;  ///< of the rotation, over all flights
};

/// Exact to and fro: every scale is a power of two.
class SequenceUnits {
 public:
  explicit SequenceUnits(const Drop& drop);
  [[nodiscard]] Drop to_internal(Drop drop) const;
  [[nodiscard]] SequenceOptions to_internal(SequenceOptions options) const;
  [[nodiscard]] double to_internal(double time) const;
  void to_si(Sequence& sequence) const;
  [[nodiscard]] double energy(double internal) const;

 private:
  detail::Scales scales_;
};

/// @throws NumericalError for numbers that leave the doubles on the way back to SI units.
void require_representable(const Sequence& sequence);

// The impact of a row of a sequence: of one corner, or of a group of corners or a level rim.

/// Fills in the impact of the row's corners from the state before: one corner, or a group of corners or a level rim.
/// @param derivatives  of the impact, if asked for; NaN for a group or a level rim
/// @throws as strike() and strike_together()
void strike_row(const Body& body, const ImpactLaw& law, ImpactRow& row, StrikeDerivatives* derivatives);

/// The impact of the same corners from a neighbouring state.  @throws as strike_row()
[[nodiscard]] Impact struck_again(const Body& body, const ImpactLaw& law, const ImpactRow& row, const State& before);

}  // namespace clatter::analytic::space
