// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/calibration.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace clatter::validation {
namespace {

constexpr double least_ground_error = 1e-6;  // [m]
constexpr std::size_t enough = 3;            // resting poses to calibrate on
constexpr Eigen::Index enough_points = 5;    // impacts, likewise

/// The shortest x with N x = right for N of a least-squares problem: 0 in directions that N leaves open.
Vector3 least_solution(const Matrix3& N, const Vector3& right) {
  constexpr double open = 1e-9;  // of the largest eigenvalue
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(N);
  Vector3 x = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = axes.eigenvectors().col(i);
    if (axes.eigenvalues()[i] > open * axes.eigenvalues()[2]) x += axis * (axis.dot(right) / axes.eigenvalues()[i]);
  }
  return x;
}

/// The body's true axes: a small turn δ for which each resting face's normal n looks straight down,
///     δ × n = d − n,   d the downward vertical in the tracked axes,
/// as the middle over the poses on each face, then least squares over the faces.
void calibrate_axes(const MeasuredFile& file, const TrackPart& part, CalibrationResult& result) {
  const TrackedBody body(file.file.description, {});
  std::vector<std::vector<Vector3>> down(body.faces().size());
  for (const std::size_t index : part) {
    if (!file.tracks[index].rest) continue;
    const Quaternion& attitude = *file.tracks[index].rest;
    const std::size_t face = body.down_face(attitude);
    const Vector3 d = attitude.conjugate() * Vector3(0, 0, -1);
    if (d.dot(body.faces()[face]) < 0.97) continue;  // leans on something
    down[face].push_back(d);
    ++result.resting;
  }
  if (result.resting < enough) return;
  Matrix3 normal = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  double spread = 0;
  for (std::size_t face = 0; face < down.size(); ++face) {
    if (down[face].empty()) continue;
    Vector3 middle;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> parts;
      for (const Vector3& d : down[face]) parts.push_back(d[axis]);
      middle[axis] = median(parts);
      for (double& value : parts) value = std::fabs(value - middle[axis]);
      spread = std::max(spread, deviation_of_median * median(parts));
    }
    const Matrix3 map = -cross_matrix(body.faces()[face]);
    const auto weight = static_cast<double>(down[face].size());
    normal += weight * map.transpose() * map;
    right += weight * map.transpose() * (middle - body.faces()[face]);
  }
  result.calibration.turn = least_solution(normal, right);
  result.turn_error = spread / std::sqrt(static_cast<double>(result.resting));
}

/// Height of the ground: the middle of the lowest points where two flights meet, of that half of the impacts whose
/// flights meet best.
void calibrate_ground(const MeasuredFile& file, const TrackPart& part, CalibrationResult& result) {
  const double stated = file.file.description.ground;
  Calibration calibration = result.calibration;
  calibration.ground = stated;
  const TrackedBody body(file.file.description, calibration);
  std::vector<double> heights, distances, own;
  for (const std::size_t index : part) {
    for (const Meeting& meeting : file.tracks[index].meetings) distances.push_back(meeting.distance);
  }
  const double clean = median(distances);
  for (const std::size_t index : part) {
    for (const Meeting& meeting : file.tracks[index].meetings) {
      if (meeting.distance > clean) continue;
      const analytic::space::State met = meeting.before.state_at(meeting.time);
      const Quaternion attitude = body.attitude(met.attitude);
      own.push_back(meeting.low_error);
      heights.push_back(met.position.z() + body.arm(attitude, body.lowest(attitude)).z());
    }
  }
  result.touches = heights.size();
  result.calibration.ground = heights.empty() ? stated : median(heights);
  for (double& height : heights) height = std::fabs(height - result.calibration.ground);
  if (heights.empty()) return;
  const double spread = deviation_of_median * median(heights), noise = median(own);
  result.ground_spread =
      std::sqrt(std::max(0.0, spread * spread - noise * noise) + spread * spread / static_cast<double>(heights.size()));
  result.ground_spread = std::max(least_ground_error, result.ground_spread);
}

/// How far an impulse at the touching point fails to explain the change of turning: with k² = I/m of the uniform body,
///     k |ΔΩ − m I⁻¹ (r × ΔV)| / √(|V|² + k² |Ω|²),                                                (1)
/// in the unit of velocities, so that a small body with a small inertia gains nothing.
class TurningLosses {
 public:
  TurningLosses(const MeasuredFile& file, const TrackPart& part, const CalibrationResult& result)
      : description_(file.file.description), calibration_(result.calibration),
        impacts_(impacts_of(file, part, TrackedBody(description_, calibration_), result.ground_spread, 1)),
        gyration_(std::sqrt(TrackedBody(description_, {}).gyration_square())) {}

  [[nodiscard]] double half_side() const { return description_.size.minCoeff() / 2; }
  /// (1) of each impact for a body of other inertia and rounding.
  [[nodiscard]] Eigen::VectorXd misses(double inertia_factor, double rounding) const {
    Calibration trial = calibration_;
    trial.inertia_factor = inertia_factor;
    trial.rounding = rounding;
    const TrackedBody body(description_, trial);
    Eigen::VectorXd all(static_cast<Eigen::Index>(impacts_.size()));
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
      const analytic::space::State &before = impacts_[i].impact.before.state, &after = impacts_[i].impact.after.state;
      const Matrix3 axes = before.attitude.toRotationMatrix();
      const Vector3 arm = body.arm(before.attitude, impacts_[i].impact.corner);
      const Vector3 turning = body.core().mass * axes * body.core().inertia.inverse() * axes.transpose() *
                              arm.cross(after.velocity - before.velocity);
      const double size = std::hypot(before.velocity.norm(), gyration_ * before.angular_velocity.norm());
      all[static_cast<Eigen::Index>(i)] =
          gyration_ * (after.angular_velocity - before.angular_velocity - turning).norm() / size;
    }
    return all;
  }
  /// Squares of (1), no larger than where an impact is no point impact.
  [[nodiscard]] Eigen::VectorXd losses(double inertia_factor, double rounding) const {
    return (misses(inertia_factor, rounding) / not_a_point).array().square().min(1.0);
  }

 private:
  static constexpr double not_a_point = 0.2;
  const TrackDescription& description_;
  Calibration calibration_;
  std::vector<PartImpact> impacts_;
  double gyration_;
};

/// Middle of those impacts that some body would have as point impacts.
double middle_of_points(const Eigen::VectorXd& misses) {
  std::vector<double> points;
  for (const double miss : misses) {
    if (miss < 0.2) points.push_back(miss);
  }
  return median(points);
}

/// Inertia alone, then rounding, too: each is kept if it lowers the loss clearly.
void calibrate_inertia(const MeasuredFile& file, const TrackPart& part, CalibrationResult& result) {
  const TurningLosses turning(file, part, result);
  if ((turning.losses(1, 0).array() < 1).count() < enough_points) return;
  const double half = turning.half_side();
  Eigen::VectorXd best = turning.losses(1, 0);
  result.lever_before = middle_of_points(turning.misses(1, 0));
  const auto keep = [&](const RobustFit& fit, int inertia, int rounding) {
    const double radius = rounding < 0 ? 0 : half * fit.value[rounding];
    if (!(radius >= 0 && paired_difference(best, fit.losses).mean > 1.96 * paired_difference(best, fit.losses).error))
      return;
    best = fit.losses;
    result.calibration.inertia_factor = inertia < 0 ? 1 : fit.value[inertia];
    result.inertia_half_width = inertia < 0 ? 0 : fit.half_width(inertia);
    result.calibration.rounding = radius;
    result.rounding_half_width = rounding < 0 ? 0 : half * fit.half_width(rounding);
  };
  keep(fit_robustly([&](const Eigen::VectorXd& p) { return turning.losses(p[0], 0); }, {{1}, {0.1}}), 0, -1);
  keep(fit_robustly([&](const Eigen::VectorXd& p) { return turning.losses(p[0], half * p[1]); },
                    {{result.calibration.inertia_factor, 0.05}, {0.1, 0.05}}),
       0, 1);
  result.lever_after = middle_of_points(turning.misses(result.calibration.inertia_factor, result.calibration.rounding));
}

}  // namespace

CalibrationResult calibrate(const MeasuredFile& file, const TrackPart& part, const CalibrationParts& parts) {
  CalibrationResult result;
  if (parts.axes) calibrate_axes(file, part, result);
  calibrate_ground(file, part, result);
  if (parts.inertia) {
    calibrate_inertia(file, part, result);
    calibrate_ground(file, part, result);  // with rounded corners
  }
  return result;
}

std::vector<PartImpact> impacts_of(const MeasuredFile& file, const TrackPart& part, const TrackedBody& body,
                                   double ground_error, int number) {
  std::vector<PartImpact> impacts;
  for (const std::size_t index : part) {
    const std::vector<Meeting>& meetings = file.tracks[index].meetings;
    if (static_cast<int>(meetings.size()) < number) continue;
    impacts.push_back({index, measured_impact(meetings[static_cast<std::size_t>(number - 1)], body, ground_error,
                                              file.file.description.lever_tolerance)});
  }
  return impacts;
}

}  // namespace clatter::validation
