// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/flights.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "analytic/space/flight/flight_derivatives.hpp"

namespace clatter::validation {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double huber = 2.5;  // standard deviations beyond which a frame counts less
constexpr int reweightings = 4;
constexpr int gauss_newton_steps = 12;
constexpr double settled = 1e-11;  // change of the rotation [rad]

/// Weight of a residual that is `size` expected ones long.
double weight_of(double size) { return size > huber ? huber / size : 1; }

/// The inverse of a positive definite matrix, by blocks.
Matrix6 inverse_of(const Matrix6& m) {
  const Matrix3d first = m.topLeftCorner<3, 3>().inverse(), side = first * m.topRightCorner<3, 3>();
  const Matrix3d last = (m.bottomRightCorner<3, 3>() - m.bottomLeftCorner<3, 3>() * side).inverse();
  Matrix6 inverse;
  inverse << first + side * last * side.transpose(), -side * last, -last * side.transpose(), last;
  return inverse;
}

/// Left Jacobian of the rotation exp(v): exp(v + δ) = exp(J δ) exp(v) to first order.
Matrix3d left_jacobian(const Vector3& v) {
  const double angle = v.norm();
  const Matrix3d k = cross_matrix(v);
  if (angle < 1e-4) return Matrix3d::Identity() + k / 2 + k * k / 6;
  const double square = angle * angle;
  return Matrix3d::Identity() + (1 - std::cos(angle)) / square * k +
         (angle - std::sin(angle)) / (square * angle) * k * k;
}

/// The median of the turns from frame to frame as a first angular velocity.
Vector3 first_angular_velocity(std::span<const Frame> frames) {
  std::vector<double> parts[3];
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Vector3 turn = rotation_vector(frames[i].attitude * frames[i - 1].attitude.conjugate());
    for (int axis = 0; axis < 3; ++axis) parts[axis].push_back(turn[axis] / (frames[i].time - frames[i - 1].time));
  }
  return {median(parts[0]), median(parts[1]), median(parts[2])};
}

constexpr double explained = 5;  // standard deviations
constexpr std::size_t seed_frames = 4;
constexpr std::size_t window = 12;  // frames that a new one is fitted with
constexpr std::size_t rest_frames = 5;
constexpr std::size_t gravity_frames = 8, noise_frames = 16;
constexpr std::size_t gravity_flights = 5;
constexpr std::size_t most_torn = 2;  // in a row
constexpr double unknown_gravity = 0.05, least_spread = 1e-3;

/// Grows flights through the frames of a track up to `end`.
class FlightSearch {
 public:
  FlightSearch(const Track& track, const FlightModel& model, std::size_t end)
      : track_(track), model_(model), end_(end) {}

  TrackFlights run() {
    std::size_t start = 0;
    while (start + seed_frames <= end_) {
      FlightFrames flight;
      for (std::size_t i = 0; i < seed_frames; ++i) flight.push_back(start + i);
      if (!explains(flight)) {
        result_.contact.push_back(start++);
        continue;
      }
      grow(flight);
      start = flight.back() + 1;
      result_.flights.push_back(std::move(flight));
    }
    for (; start < end_; ++start) result_.contact.push_back(start);
    return std::move(result_);
  }

 private:
  void grow(FlightFrames& flight) {
    for (std::size_t next = flight.back() + 1; next < end_;) {
      const std::size_t step = step_to(flight, next);
      if (step == 0) return;
      for (std::size_t torn = next; torn < next + step - 1; ++torn) result_.torn.push_back(torn);
      flight.push_back(next + step - 1);
      next += step;
    }
  }

  /// 1 if the next frame belongs; more if that many but one are torn; 0 if the flight has ended.
  std::size_t step_to(const FlightFrames& flight, std::size_t next) {
    if (explains_with(flight, {next})) return 1;
    for (std::size_t torn = 1; torn <= most_torn; ++torn) {
      const std::size_t after = next + torn;
      if (after + 1 < end_ && explains_with(flight, {after, after + 1})) return torn + 1;
    }
    return 0;
  }

  bool explains_with(const FlightFrames& flight, std::initializer_list<std::size_t> more) {
    FlightFrames last(flight.end() - static_cast<std::ptrdiff_t>(std::min(flight.size(), window)), flight.end());
    last.insert(last.end(), more);
    return explains(last);
  }

  bool explains(const FlightFrames& indices) {
    frames_.clear();
    for (const std::size_t i : indices) frames_.push_back(track_.frames[i]);
    const FlightFit fit(frames_, model_);
    return std::all_of(frames_.begin(), frames_.end(),
                       [&](const Frame& frame) { return fit.residual(frame) <= explained; });
  }

  const Track& track_;
  const FlightModel& model_;
  std::size_t end_;
  std::vector<Frame> frames_;
  TrackFlights result_;
};

/// Frames at the end during which the body does not move: their position and attitude stay within 5 standard
/// deviations; 0 if fewer than 5.
std::size_t resting_frames(const Track& track, const PoseNoise& noise) {
  const std::vector<Frame>& f = track.frames;
  if (f.empty()) return 0;
  std::size_t count = 0;
  for (; count < f.size(); ++count) {
    const Frame &frame = f[f.size() - 1 - count], &last = f.back();
    const double moved = (frame.position - last.position).cwiseAbs().maxCoeff() / noise.position;
    const double turned =
        rotation_vector(frame.attitude * last.attitude.conjugate()).cwiseAbs().maxCoeff() / noise.rotation;
    if (!(std::max(moved, turned) <= std::sqrt(2.0) * explained)) break;
  }
  return count >= rest_frames ? count : 0;
}

}  // namespace

std::optional<UnlikeMoments> unlike_moments(const TrackedBody& body) {
  if (body.turns_steadily()) return std::nullopt;
  return UnlikeMoments(body.core().inertia / body.core().mass);
}

FlightFit::FlightFit(std::span<const Frame> frames, const FlightModel& model)
    : noise_(model.noise), frames_(static_cast<int>(frames.size())), planar_(model.planar), moments_(model.moments) {
  first_ = frames.front().time;
  last_ = frames.back().time;
  middle_ = (first_ + last_) / 2;
  fit_position(frames, model);
  fit_rotation(frames, model);
  settle_misfit(frames);
}

void FlightFit::fit_position(std::span<const Frame> frames, const FlightModel& model) {
  std::vector<double> weights(frames.size(), 1);
  const double per_noise = 1 / (noise_.position * noise_.position);
  for (int pass = 0; pass < reweightings; ++pass) {
    Matrix2d level = Matrix2d::Zero();
    Matrix3d fall = Matrix3d::Zero();
    Eigen::Matrix2d level_right = Matrix2d::Zero();  // columns: x, y
    Vector3 fall_right = Vector3::Zero();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double t = frames[i].time - middle_, w = weights[i] * per_noise;
      const Eigen::Vector2d row(1, t);
      const Vector3 fall_row(1, t, -t * t / 2);
      level += w * row * row.transpose();
      level_right += w * row * frames[i].position.head<2>().transpose();
      fall += w * fall_row * fall_row.transpose();
      fall_right += w * fall_row * frames[i].position.z();
    }
    const double prior = 1 / (model.gravity.spread * model.gravity.spread);
    fall(2, 2) += prior;
    fall_right.z() += prior * model.gravity.mean;
    const Matrix2d level_inverse = level.inverse();
    const Matrix3d fall_inverse = fall.inverse();
    const Matrix2d xy = level_inverse * level_right;
    const Vector3 z = fall_inverse * fall_right;
    state_.position = {xy(0, 0), xy(0, 1), z.x()};
    state_.velocity = {xy(1, 0), xy(1, 1), z.y()};
    gravity_ = z.z();
    position_covariance_.topLeftCorner<2, 2>() = level_inverse;
    position_covariance_.bottomRightCorner<3, 3>() = fall_inverse;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Vector3 off = frames[i].position - state_at(frames[i].time).position;
      weights[i] = weight_of(off.cwiseAbs().maxCoeff() / noise_.position);
    }
  }
}

void FlightFit::fit_rotation(std::span<const Frame> frames, const FlightModel& model) {
  state_.angular_velocity = first_angular_velocity(frames);
  const Frame& central = frames[frames.size() / 2];
  state_.attitude = rotation_of((middle_ - central.time) * state_.angular_velocity) * central.attitude;
  const double per_noise = 1 / (model.noise.rotation * model.noise.rotation);
  start_rotation();
  for (int step = 0; step < gauss_newton_steps; ++step) {
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (const Frame& frame : frames) {
      const Turned now = turned(frame.time - middle_);
      const Vector3 off = rotation_vector(frame.attitude * now.attitude.conjugate());
      Eigen::Matrix<double, 3, 6> row;
      row.leftCols<3>() = now.attitude_by_attitude;
      row.rightCols<3>() = now.attitude_by_velocity;
      const double w = weight_of(off.cwiseAbs().maxCoeff() / noise_.rotation) * per_noise;
      normal += w * row.transpose() * row;
      right += w * row.transpose() * off;
    }
    rotation_covariance_ = inverse_of(normal);
    const Vector6 change = rotation_covariance_ * right;
    state_.attitude = (rotation_of(change.head<3>()) * state_.attitude).normalized();
    state_.angular_velocity += change.tail<3>();
    start_rotation();
    if (change.head<3>().norm() + change.tail<3>().norm() * (last_ - first_) < settled) break;
  }
}

void FlightFit::start_rotation() {
  if (!moments_) return;
  analytic::space::State start = state_;
  ahead_.emplace(moments_->principal, start, 0);
  start.angular_velocity *= -1;
  back_.emplace(moments_->principal, start, 0);
}

FlightFit::Turned FlightFit::turned(double t) const {
  if (!moments_) {
    const Vector3 vector = t * state_.angular_velocity;
    const Quaternion turn = rotation_of(vector);
    return {.attitude = turn * state_.attitude,
            .angular_velocity = state_.angular_velocity,
            .attitude_by_attitude = turn.toRotationMatrix(),
            .attitude_by_velocity = t * left_jacobian(vector)};
  }
  // A motion backwards in time is one with the opposite angular velocity.
  const double sense = t < 0 ? -1 : 1;
  const analytic::space::FreeFlight& flight = t < 0 ? *back_ : *ahead_;
  const auto& rotation = flight.rotation();
  const auto [of_attitude, of_velocity] =
      analytic::space::rotation_derivatives(flight, moments_->gyration, std::fabs(t));
  Turned now{.attitude = rotation.attitude(std::fabs(t)),
             .angular_velocity = {},
             .attitude_by_attitude = {},
             .attitude_by_velocity = sense * of_attitude};
  now.angular_velocity = sense * (now.attitude * rotation.angular_velocity(std::fabs(t)));
  // A turn of attitude and angular velocity together turns the whole motion.
  const Matrix3 spin = cross_matrix(state_.angular_velocity);
  now.attitude_by_attitude = Matrix3::Identity() + now.attitude_by_velocity * spin;
  now.velocity_by_attitude = of_velocity * spin - cross_matrix(now.angular_velocity);
  now.velocity_by_velocity = of_velocity;
  return now;
}

void FlightFit::settle_misfit(std::span<const Frame> frames) {
  double sum = 0;
  for (const Frame& frame : frames) {
    const double size = residuals(frame).head<6>().norm();
    sum += std::min(size * size, 6 * huber * huber);
  }
  const double per_frame = planar_ ? 3 : 6, parameters = planar_ ? 6 : 12;
  const double freedom = per_frame * frames_ - parameters;
  misfit_ = freedom > 0 ? std::sqrt(sum / freedom) : 1;
  // Residuals beyond what chance leaves say that the noise is larger here.
  const double chance = freedom > 0 ? 1 + 2 / std::sqrt(2 * freedom) : misfit_;
  const double scale = misfit_ > chance ? misfit_ * misfit_ : 1;
  position_covariance_ *= scale;
  rotation_covariance_ *= scale;
}

analytic::space::State FlightFit::state_at(double time) const {
  const double t = time - middle_;
  analytic::space::State state = state_;
  state.position += t * state_.velocity - gravity_ * t * t / 2 * Vector3::UnitZ();
  state.velocity.z() -= gravity_ * t;
  if (!moments_) {
    state.attitude = (rotation_of(t * state_.angular_velocity) * state_.attitude).normalized();
    return state;
  }
  const auto& rotation = (t < 0 ? *back_ : *ahead_).rotation();
  state.attitude = rotation.attitude(std::fabs(t));
  state.angular_velocity = (t < 0 ? -1 : 1) * (state.attitude * rotation.angular_velocity(std::fabs(t)));
  return state;
}

MeasuredState FlightFit::at(double time) const {
  const double t = time - middle_;

  // Parameters: x, v_x, y, v_y, z, v_z, g, attitude, ω.
  Eigen::Matrix<double, 12, 13> whole = Eigen::Matrix<double, 12, 13>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    whole(axis, 2 * axis) = 1;
    whole(axis, 2 * axis + 1) = t;
    whole(6 + axis, 2 * axis + 1) = 1;
  }
  whole(2, 6) = -t * t / 2;
  whole(8, 6) = -t;
  const Turned now = turned(t);
  whole.block<3, 3>(3, 7) = now.attitude_by_attitude;
  whole.block<3, 3>(3, 10) = now.attitude_by_velocity;
  whole.block<3, 3>(9, 7) = now.velocity_by_attitude;
  whole.block<3, 3>(9, 10) = now.velocity_by_velocity;
  Eigen::Matrix<double, 13, 13> parameters = Eigen::Matrix<double, 13, 13>::Zero();
  parameters.block<2, 2>(0, 0) = parameters.block<2, 2>(2, 2) = position_covariance_.topLeftCorner<2, 2>();
  parameters.block<3, 3>(4, 4) = position_covariance_.bottomRightCorner<3, 3>();
  parameters.block<6, 6>(7, 7) = rotation_covariance_;
  MeasuredState measured{state_at(time), whole * parameters * whole.transpose()};
  if (planar_) {
    for (const int still : {1, 3, 5, 7, 9, 11}) {
      measured.covariance.row(still).setZero();
      measured.covariance.col(still).setZero();
    }
  }
  return measured;
}

StateVector FlightFit::residuals(const Frame& frame) const {
  const analytic::space::State state = state_at(frame.time);
  StateVector off = StateVector::Zero();
  off.head<3>() = (frame.position - state.position) / noise_.position;
  off.segment<3>(3) = rotation_vector(frame.attitude * state.attitude.conjugate()) / noise_.rotation;
  return off;
}

double FlightFit::residual(const Frame& frame) const { return residuals(frame).cwiseAbs().maxCoeff(); }

TrackFlights find_flights(const Track& track, const FlightModel& model) {
  const std::size_t rest = resting_frames(track, model.noise);
  TrackFlights flights = FlightSearch(track, model, track.frames.size() - rest).run();
  flights.rests = rest > 0;
  return flights;
}

FlightFit fit_flight(const Track& track, const FlightFrames& frames, const FlightModel& model, FlightSide side,
                     std::size_t most) {
  const std::size_t count = std::min(most, frames.size()), skip = side == FlightSide::last ? frames.size() - count : 0;
  std::vector<Frame> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(track.frames[frames[skip + i]]);
  return {chosen, model};
}

PoseNoise flight_noise(const TrackFile& file, const std::vector<TrackFlights>& flights, const FlightModel& model) {
  std::vector<double> parts[6];
  for (std::size_t i = 0; i < file.tracks.size(); ++i) {
    for (const FlightFrames& flight : flights[i].flights) {
      const std::size_t count = std::min(flight.size(), noise_frames);
      if (count < gravity_frames) continue;
      const FlightFit fit = fit_flight(file.tracks[i], flight, model, FlightSide::last, count);
      const double taken = std::sqrt(1 - 2.0 / static_cast<double>(count));  // by two parameters an axis
      for (std::size_t k = flight.size() - count; k < flight.size(); ++k) {
        const auto off = fit.standard_residual(file.tracks[i].frames[flight[k]]);
        for (int part = 0; part < 6; ++part) parts[part].push_back(std::fabs(off[part]) / taken);
      }
    }
  }
  if (parts[0].empty()) return model.noise;
  PoseNoise noise;
  for (int part = 0; part < 6; ++part) {
    const double deviation = deviation_of_median * median(parts[part]);
    double& size = part < 3 ? noise.position : noise.rotation;
    size = std::max(size, deviation * (part < 3 ? model.noise.position : model.noise.rotation));
  }
  return noise;
}

FallGravity fall_gravity(const TrackFile& file, const PoseNoise& noise) {
  const double stated = file.description.gravity;
  const FallGravity known{stated, unknown_gravity * stated};
  const FlightModel wide{
      noise, {stated, stated}, file.description.is_planar(), unlike_moments(TrackedBody(file.description, {}))};
  std::vector<double> falls, own;
  for (const Track& track : file.tracks) {
    const TrackFlights found = find_flights(track, {noise, {stated, 2 * known.spread}, wide.planar, wide.moments});
    if (found.flights.empty() || found.flights[0].size() < gravity_frames) continue;
    const FlightFit fall = fit_flight(track, found.flights[0], wide, FlightSide::first, track.frames.size());
    falls.push_back(fall.gravity());
    own.push_back(fall.gravity_error());
  }
  if (falls.size() < gravity_flights) return known;
  const Middle middle = middle_of(falls, own);
  return {middle.value, std::max(least_spread, middle.spread)};
}

}  // namespace clatter::validation
