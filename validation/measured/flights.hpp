// SPDX-License-Identifier: GPL-3.0-or-later
// A free flight fitted to tracked poses: a parabola and a free rotation, robust, with covariance.
//
// Position   x(t) = x₀ + v t − g t²/2 z,                                                           (1)
// attitude   A(t) = exp(ω t) A₀,   t from the middle of the flight.                                (2)
// (2) holds for bodies whose moments of inertia are alike; those of others go through Euler's equations, in closed form
// (free_flight.hpp), with the principal axes as they are described.  Errors of the pose are independent from frame to
// frame.  Frames far off count less (Huber's weights); gravity g comes with what other flights say of it, since walls
// may slow the fall.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "analytic/space/flight/free_flight.hpp"
#include "validation/measured/track.hpp"

namespace clatter::validation {

/// Covariance of a state: position [m], attitude (rotation vector in the world frame) [rad], velocity [m/s], angular
/// velocity [rad/s], world frame, in this order.
using StateCovariance = Eigen::Matrix<double, 12, 12>;
using StateVector = Eigen::Matrix<double, 12, 1>;

/// The fall's acceleration as it is known before a flight is fitted.
struct FallGravity {
  double mean = 9.81;   ///< [m/s²]
  double spread = 0.5;  ///< standard deviation between flights [m/s²]
};

struct MeasuredState {
  analytic::space::State state;
  StateCovariance covariance = StateCovariance::Zero();
};

/// Inertia over mass of a body whose moments differ [m²].
struct UnlikeMoments {
  explicit UnlikeMoments(const Matrix3& per_mass) : gyration(per_mass), principal(per_mass) {}
  Matrix3 gyration;
  analytic::space::PrincipalAxes principal;
};
/// Nothing for a body whose moments are alike.
[[nodiscard]] std::optional<UnlikeMoments> unlike_moments(const TrackedBody& body);

/// What a flight is fitted with.
struct FlightModel {
  PoseNoise noise;
  FallGravity gravity;
  bool planar = false;
  std::optional<UnlikeMoments> moments = {};
};

class FlightFit {
 public:
  /// Fits the frames.  @pre two frames at least
  FlightFit(std::span<const Frame> frames, const FlightModel& model);

  /// The motion at a time of the file's clock, with covariance.
  [[nodiscard]] MeasuredState at(double time) const;
  [[nodiscard]] analytic::space::State state_at(double time) const;
  [[nodiscard]] double gravity() const { return gravity_; }
  [[nodiscard]] double gravity_error() const { return std::sqrt(position_covariance_(4, 4)); }
  [[nodiscard]] double first() const { return first_; }
  [[nodiscard]] double last() const { return last_; }
  [[nodiscard]] int frames() const { return frames_; }
  /// Root of the mean square residual over its expectation; 1: noise alone.
  [[nodiscard]] double misfit() const { return misfit_; }
  /// Residual of a frame, position and rotation vector, in standard deviations of the noise.
  [[nodiscard]] Eigen::Matrix<double, 6, 1> standard_residual(const Frame& frame) const {
    return residuals(frame).head<6>();
  }
  /// Largest component of a frame's residual, in standard deviations.
  [[nodiscard]] double residual(const Frame& frame) const;

 private:
  /// Attitude and angular velocity at a time, and what they change by with those at the middle, world frame.
  struct Turned {
    Quaternion attitude;
    Vector3 angular_velocity;
    Matrix3 attitude_by_attitude, attitude_by_velocity;
    Matrix3 velocity_by_attitude = Matrix3::Zero(), velocity_by_velocity = Matrix3::Identity();
  };
  /// @param t  since the middle [s]
  [[nodiscard]] Turned turned(double t) const;
  /// Makes the rotation that starts with `state_`.
  void start_rotation();
  void fit_position(std::span<const Frame> frames, const FlightModel& model);
  void fit_rotation(std::span<const Frame> frames, const FlightModel& model);
  void settle_misfit(std::span<const Frame> frames);
  [[nodiscard]] StateVector residuals(const Frame& frame) const;

  PoseNoise noise_;
  double middle_ = 0, first_ = 0, last_ = 0, gravity_ = 0, misfit_ = 0;
  int frames_ = 0;
  analytic::space::State state_;  ///< at middle_
  /// The covariance of a horizontal coordinate and its velocity, both alike, and of height, its velocity and gravity.
  Eigen::Matrix<double, 5, 5> position_covariance_ = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 6, 6> rotation_covariance_ = Eigen::Matrix<double, 6, 6>::Zero();
  bool planar_ = false;
  std::optional<UnlikeMoments> moments_;
  /// From the middle on and, with the angular velocity turned round, back: of a body whose moments differ.
  std::optional<analytic::space::FreeFlight> ahead_, back_;
};

// A track taken apart: the flights between its impacts, and the frames that belong to none.

/// Indices of a track's frames that one flight explains, in order.
using FlightFrames = std::vector<std::size_t>;

struct TrackFlights {
  std::vector<FlightFrames> flights;
  std::vector<std::size_t> torn;     ///< frames inside a flight that lie off it: outliers of the tracking
  std::vector<std::size_t> contact;  ///< frames between two flights: in contact, or in a flight of fewer than 4 frames
  bool rests = false;                ///< the last frames do not move
};

/// Flights are grown from four frames that one motion explains within 5 standard deviations, a frame at a time: a
/// frame belongs if the fit with it and its neighbours before still explains all of them.  One or two frames that lie
/// off while the next two go on are torn.  From where the body rests nothing is a flight.
[[nodiscard]] TrackFlights find_flights(const Track& track, const FlightModel& model);

/// The flight of these frames, of the first or the last `most` of them.
enum class FlightSide { first, last };
[[nodiscard]] FlightFit fit_flight(const Track& track, const FlightFrames& frames, const FlightModel& model,
                                   FlightSide side, std::size_t most);

/// Noise from what flights of 8 frames or more leave unexplained, of the noisiest axis; the model's own without any.
/// Better than pose_noise(), which impacts and torn frames enlarge.
[[nodiscard]] PoseNoise flight_noise(const TrackFile& file, const std::vector<TrackFlights>& flights,
                                     const FlightModel& model);

/// Gravity along the falls: the middle of all first flights of 8 frames or more, and its spread beyond their own
/// errors; where there are fewer than 5 of those the description's, known to 5 %.
[[nodiscard]] FallGravity fall_gravity(const TrackFile& file, const PoseNoise& noise);

}  // namespace clatter::validation
