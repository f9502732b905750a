// SPDX-License-Identifier: GPL-3.0-or-later
// A drop in the plane, the rows of its impact sequence, and the units in which that is computed.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analytic/base/angle.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/base/scales.hpp"
#include "analytic/law/sequence_options.hpp"
#include "analytic/plane/body.hpp"
#include "analytic/plane/flight.hpp"
#include "analytic/plane/impact.hpp"

namespace clatter::analytic {

/// Bounds on the errors of an impact's numbers, each in the unit of its number; infinite in a row
/// that cannot be predicted. They hold what errors of the start (one unit in the last place of each
/// number given) and rounding have grown to.
struct RowErrors {
  bool predictable = false;            ///< errors have not grown so far that another sequence may follow
  double relative = detail::infinite;  ///< largest of start, contact angle and normal impulse, beside the number itself
  double start = detail::infinite;     ///< [s]
  double inclination = detail::infinite, contact_angle = detail::infinite;  ///< [rad]
  double approach_speed = detail::infinite;                                 ///< [m/s]
  double restitution = detail::infinite;
  double impulse = detail::infinite;  ///< on the length of the error; then of the components [N·s]
  double normal_impulse = detail::infinite, tangential_impulse = detail::infinite;
  double impulse_ratio = detail::infinite;
  double velocity_after = detail::infinite;  ///< likewise [m/s]
  double normal_velocity_after = detail::infinite, tangential_velocity_after = detail::infinite;
  double angular_velocity_after = detail::infinite;  ///< [rad/s]
  double energy_before = detail::infinite, energy_after = detail::infinite, energy_loss = detail::infinite;  ///< [J]
};

/// The free flight from a release to the first touch, and bounds on the errors that it leaves in the drop's numbers;
/// infinite where it is not certain which vertex touches, or when.
struct FreeFall {
  double time = 0;               ///< of the touch since the release [s]
  double time_error = 0;         ///< [s]
  double inclination_error = 0;  ///< [rad]
  double normal_error = 0;       ///< of V_n [m/s]
};

/// The body as it touches the ground for the first time.  With a release height, the body as it is let go to fly
/// freely, turning, until then.
struct Drop {
  PlanarBody body;
  Angle inclination;         ///< in [−180°, 180°]; from 0° to 90° end a is low
  PlanarVelocity velocity;   ///< of the centre of mass, before the first impact
  double gravity = 0;        ///< towards the ground, >= 0 [m/s²]
  double gravity_along = 0;  ///< along x, where the ground slopes [m/s²]
  /// Height of the centre of mass above the ground, which is level then [m]; for a fall of h until the lowest point
  /// touches h + touch_height(body, inclination).
  std::optional<double> release_height{};
  ImpactLaw law;
  std::optional<FreeFall> fall{};  ///< that has ended in this touch: after_free_fall()

  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const;
};

/// One impact.
struct ImpactRow {
  double start = 0;          ///< time since the first impact [s]
  VertexSet vertices = 0;    ///< which strike
  double inclination = 0;    ///< α, reduced to (−π, π] [rad]; a lower: positive
  double contact_angle = 0;  ///< acute angle to the ground [rad]
  double centre_height = 0;  ///< z of the centre of mass [m]
  PlanarVelocity before;
  Impact impact;  ///< impulse, speeds and velocity after
  /// Translational + rotational + potential (zero at the ground, below the first touch's centre of mass) [J].
  double energy_before = 0;
  double energy_after = 0;
  /// Relative change of this row's quantities per relative change of the drop (angle, speed): the
  /// largest over contact angle, time and impulse.  NaN if it could not be had, or is so large that the row cannot be
  /// predicted.
  double amplification = 0;
  RowErrors error{};  ///< all unknown without SequenceOptions::amplification
  /// The flight that led here; for the first row all zero.
  Flight flight;
  Departure departure;  ///< how that flight began

  // As in space, world frame: x to the right, y into the page, z up.

  /// P [N·s].
  [[nodiscard]] Eigen::Vector3d impulse() const { return {impact.tangential_impulse, 0, impact.normal_impulse}; }
  /// V′ of the centre of mass [m/s].
  [[nodiscard]] Eigen::Vector3d velocity_after() const { return {impact.after.tangential, 0, impact.after.normal}; }
  /// ω′ [rad/s].
  [[nodiscard]] Eigen::Vector3d angular_velocity_after() const { return {0, impact.after.angular, 0}; }
};

/// The remaining impacts after the last row: infinitely many in a finite time.
/// Errors are bounds on those of the extrapolation, with SequenceOptions::amplification on all that the sums begin from
/// as well; infinite where the last row cannot be predicted.
struct Tail {
  double end_time = 0;        ///< time since the first impact [s]
  double end_time_error = 0;  ///< [s]
  double normal_impulse = 0;  ///< sum over the remaining impacts [N·s]
  double normal_impulse_error = 0;
  Eigen::Vector2d tangential_impulse = Eigen::Vector2d::Zero();  ///< likewise, world frame as in space
  double tangential_impulse_error = 0;                           ///< of vectors: bounds on the length of the error
  VertexSet vertices = 0;
  bool closed_form = false;
  Eigen::Vector3d velocity_after = Eigen::Vector3d::Zero();  ///< of the centre of mass at the end [m/s]
  double velocity_error = 0, normal_velocity_error = 0, tangential_velocity_error = 0;
  Eigen::Vector3d angular_velocity_after = Eigen::Vector3d::Zero();  ///< [rad/s]
  double angular_velocity_error = 0;

  /// Velocity at the end.
  void set_after(const PlanarVelocity& after);
  /// Bounds on the errors of its components.
  void set_errors(const PlanarVelocity& error);
};

/// A body that slides along the ground after its last impact.
struct LastSlide {
  double begin = 0;     ///< since the first impact [s]
  double speed = 0;     ///< to the right [m/s]
  double duration = 0;  ///< until friction has stopped it; infinite: never [s]
  double distance = 0;  ///< that it slides meanwhile; infinite likewise [m]
};

struct Sequence {
  std::vector<ImpactRow> rows;
  Outcome outcome = Outcome::no_further_impact;
  bool moves_on = false;              ///< with Outcome::at_rest: it lies on the ground, but slides there
  std::string message;                ///< why it ended, one sentence
  std::vector<std::string> warnings;  ///< such as energy created by an impulse ratio
  std::optional<Tail> tail;
  std::optional<LastSlide> slide;   ///< if at_rest, but for that
  NearMiss near_miss;               ///< of the last flight, if no_further_impact
  double total_normal_impulse = 0;  ///< rows and tail [N·s]
  /// Bound on its error; infinite without SequenceOptions::amplification or if a row cannot be predicted [N·s].
  double total_normal_impulse_error = 0;
  double first_flight = 0;        ///< time from the release to the first impact [s]
  double first_flight_error = 0;  ///< bound on its error [s]
  /// Whether the outcome is certain, and not only that of one of the sequences that the errors leave open.
  bool end_predictable = false;
  int root_evaluations = 0;
};

/// Scales a drop so that its length, speed and mass are of order 1 and its results back.  Factors are
/// powers of two, so that scaling is exact and results do not depend on the user's units.
class Units {
 public:
  explicit Units(const Drop& drop);
  [[nodiscard]] Drop to_internal(Drop drop) const;
  [[nodiscard]] SequenceOptions to_internal(SequenceOptions options) const;
  void to_si(Sequence& sequence) const;
  /// [J] of an energy in internal units.
  [[nodiscard]] double energy(double internal) const;

 private:
  detail::Scales scales_;
};

/// Height of the centre of mass above the lowest vertex [m].
[[nodiscard]] double touch_height(const PlanarBody& body, const Angle& inclination);

/// The drop as it touches for the first time: inclination α₀ − Ω t, V_n − g t, with the first root of the vertices'
/// heights and the errors that rounding of the numbers given leaves in it.
/// @param release  with a release height
/// @throws std::domain_error if a vertex is not above the ground then, or none ever reaches it; NumericalError as
///         first_root()
[[nodiscard]] Drop after_free_fall(const Drop& release);

}  // namespace clatter::analytic
