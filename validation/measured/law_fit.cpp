// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/law_fit.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "analytic/base/errors.hpp"
#include "analytic/space/impulse/impact.hpp"

namespace clatter::validation {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr int most_steps = 2000, most_idle = 200;
constexpr double shrunk = 1e-6, derivative_step = 0.05;

using Vector = Eigen::VectorXd;

/// The loss of each item (a drop, say) for given parameters.
using Losses = std::function<Eigen::VectorXd(const Eigen::VectorXd& parameters)>;

struct FitStart {
  std::vector<double> value;
  std::vector<double> step;  ///< size of the first simplex, and twenty times the step of derivatives
};

using GslVector = std::unique_ptr<gsl_vector, void (*)(gsl_vector*)>;

GslVector gsl_constant(std::size_t count, double value) {
  GslVector all(gsl_vector_alloc(count), gsl_vector_free);
  gsl_vector_set_all(all.get(), value);
  return all;
}

Vector eigen_copy(const gsl_vector* values) {
  return Eigen::Map<const Vector>(values->data, static_cast<Eigen::Index>(values->size));  // of stride 1
}

double mean_loss(const gsl_vector* point, void* losses) {
  return (*static_cast<const Losses*>(losses))(eigen_copy(point)).mean();
}

/// Parameters in units of their first steps, so that one tolerance serves all.
Vector least_point(const Losses& losses, const FitStart& start) {
  gsl_set_error_handler_off();  // each status is looked at
  const std::size_t count = start.value.size();
  const Eigen::Map<const Vector> value(start.value.data(), static_cast<Eigen::Index>(count)),
      unit(start.step.data(), static_cast<Eigen::Index>(count));
  const auto at = [&](const Vector& point) -> Vector { return value + unit.cwiseProduct(point); };
  const Losses scaled = [&](const Vector& point) { return losses(at(point)); };
  gsl_multimin_function function{&mean_loss, count, const_cast<Losses*>(&scaled)};
  const GslVector origin = gsl_constant(count, 0), size = gsl_constant(count, 1);
  const std::unique_ptr<gsl_multimin_fminimizer, void (*)(gsl_multimin_fminimizer*)> simplex(
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, count), gsl_multimin_fminimizer_free);
  gsl_multimin_fminimizer_set(simplex.get(), &function, origin.get(), size.get());
  int idle = 0;  // steps that did not lower the loss
  for (int step = 0; step < most_steps; ++step) {
    const double before = simplex->fval;
    if (gsl_multimin_fminimizer_iterate(simplex.get()) != 0) break;
    idle = simplex->fval < before ? 0 : idle + 1;
    // On a plain, where a parameter does not matter, the simplex turns on the spot among losses that are equal.
    if (gsl_multimin_fminimizer_size(simplex.get()) < shrunk || idle == most_idle) {
      return at(eigen_copy(simplex->x));
    }
  }
  throw analytic::NumericalError("a fit's simplex did not shrink");
}

/// First and second derivatives of the losses.
class Derivatives {
 public:
  Derivatives(const Losses& losses, const Vector& at, const std::vector<double>& steps)
      : losses_(losses), at_(at), steps_(steps), centre_(losses(at)) {}

  [[nodiscard]] Eigen::MatrixXd first() const {
    Eigen::MatrixXd gradient(centre_.size(), at_.size());
    for (Eigen::Index i = 0; i < at_.size(); ++i)
      gradient.col(i) = (losses_(moved({{i, 1}})) - losses_(moved({{i, -1}}))) / (2 * step(i));
    return gradient;
  }

  /// Second derivatives of each item's loss.
  [[nodiscard]] std::vector<Eigen::MatrixXd> second() const {
    std::vector<Eigen::MatrixXd> all(static_cast<std::size_t>(centre_.size()),
                                     Eigen::MatrixXd::Zero(at_.size(), at_.size()));
    const auto put = [&](Eigen::Index i, Eigen::Index j, const Vector& values) {
      for (Eigen::Index k = 0; k < values.size(); ++k) {
        Eigen::MatrixXd& matrix = all[static_cast<std::size_t>(k)];
        matrix(i, j) = matrix(j, i) = values[k];
      }
    };
    const auto at = [&](const Moves& moves) { return losses_(moved(moves)); };
    for (Eigen::Index i = 0; i < at_.size(); ++i) {
      put(i, i, (at({{i, 1}}) - 2 * centre_ + at({{i, -1}})) / (step(i) * step(i)));
      for (Eigen::Index j = 0; j < i; ++j) {
        put(i, j,
            (at({{i, 1}, {j, 1}}) - at({{i, 1}, {j, -1}}) - at({{i, -1}, {j, 1}}) + at({{i, -1}, {j, -1}})) /
                (4 * step(i) * step(j)));
      }
    }
    return all;
  }

 private:
  using Moves = std::vector<std::pair<Eigen::Index, double>>;
  [[nodiscard]] double step(Eigen::Index i) const { return derivative_step * steps_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Vector moved(const Moves& moves) const {
    Vector point = at_;
    for (const auto& [i, sign] : moves) point[i] += sign * step(i);
    return point;
  }

  const Losses& losses_;
  const Vector& at_;
  const std::vector<double>& steps_;
  Vector centre_;
};

bool is_positive(const Eigen::LDLT<Eigen::MatrixXd>& factors) {
  return factors.isPositive() && factors.vectorD().minCoeff() > 0;
}

Eigen::MatrixXd jackknife(const Losses& losses, const Vector& at, const std::vector<double>& steps) {
  const Derivatives derivatives(losses, at, steps);
  const Eigen::MatrixXd first = derivatives.first();
  const std::vector<Eigen::MatrixXd> second = derivatives.second();
  const Eigen::Index n = first.rows(), p = first.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p), covariance = sum;
  for (const Eigen::MatrixXd& one : second) sum += one;
  const Eigen::LDLT<Eigen::MatrixXd> all(sum);
  if (!is_positive(all) || n <= p) return Eigen::MatrixXd::Constant(p, p, missing);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::LDLT<Eigen::MatrixXd> others(sum - second[static_cast<std::size_t>(i)]);
    const Vector gradient = first.row(i).transpose();
    const Vector moved = is_positive(others) ? others.solve(gradient) : all.solve(gradient);
    covariance += moved * moved.transpose();
  }
  return covariance * static_cast<double>(n - 1) / static_cast<double>(n);
}

/// Least mean loss by the simplex of Nelder and Mead (GSL).  Losses need no derivatives: friction's have kinks.
/// @throws NumericalError if the simplex does not shrink to 1e-6 of its first size in 2000 steps, but where 200 steps
/// do
///         not lower the loss, as on a plain.
RobustFit fit_robustly(const Losses& losses, const FitStart& start) {
  RobustFit fit;
  fit.value = least_point(losses, start);
  fit.losses = losses(fit.value);
  fit.covariance = jackknife(losses, fit.value, start.step);
  return fit;
}

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
  if (body.faces().empty()) return;
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
/// flights meet best.  Of a ball first impacts alone count: pieces of its rolling look like weak ones.
void calibrate_ground(const MeasuredFile& file, const TrackPart& part, CalibrationResult& result) {
  const double stated = file.file.description.ground;
  Calibration calibration = result.calibration;
  calibration.ground = stated;
  const TrackedBody body(file.file.description, calibration);
  std::vector<double> heights, distances, own;
  const auto counts = [&](const Meeting& meeting) { return !body.is_ball() || meeting.number == 1; };
  for (const std::size_t index : part) {
    for (const Meeting& meeting : file.tracks[index].meetings) {
      if (counts(meeting)) distances.push_back(meeting.distance);
    }
  }
  const double clean = median(distances);
  for (const std::size_t index : part) {
    for (const Meeting& meeting : file.tracks[index].meetings) {
      if (!counts(meeting) || meeting.distance > clean) continue;
      const analytic::space::State met = meeting.before.state_at(meeting.time);
      const Quaternion attitude = body.attitude(met.attitude);
      own.push_back(meeting.low_error);
      heights.push_back(met.position.z() + body.arm(attitude, body.lowest(attitude)).z());
    }
  }
  result.touches = heights.size();
  result.calibration.ground = stated;
  if (heights.empty()) return;
  const Middle middle = middle_of(heights, own);
  result.calibration.ground = middle.value;
  result.ground_spread = std::max(least_ground_error, middle.spread);
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

/// Inertia alone, then of a box rounding, too: each is kept if it lowers the loss clearly.
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
  if (file.file.description.is_box()) {
    keep(fit_robustly([&](const Eigen::VectorXd& p) { return turning.losses(p[0], half * p[1]); },
                      {{result.calibration.inertia_factor, 0.05}, {0.1, 0.05}}),
         0, 1);
  }
  result.lever_after = middle_of_points(turning.misses(result.calibration.inertia_factor, result.calibration.rounding));
}

using analytic::RestitutionLaw;
using analytic::space::State;

constexpr double quadratic_below = 0.05;  // relative error
constexpr double larger_friction = 1.5;   // over the fitted one: what must fit worse
constexpr double level_loss = 1e-3;       // rise over the loss below which it is level
constexpr int floor_iterations = 2000;
constexpr double floor_settled = 1e-12;
constexpr std::size_t least_points = 5;

Matrix3 world_inverse_inertia(const TrackedBody& body, const Quaternion& attitude) {
  const Matrix3 axes = attitude.toRotationMatrix();
  return axes * body.core().inertia.inverse() * axes.transpose();
}

/// s² (√(1 + (r/s)²) − 1): r²/2 for small r, s |r| for large ones.
double pseudo_huber(double r, double s) {
  const double q = r / s;
  return s * s * q * q / (std::sqrt(1 + q * q) + 1);
}

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

}  // namespace

double RobustFit::half_width(int parameter) const {
  const auto freedom = static_cast<double>(losses.size() - value.size());
  if (!(freedom > 0)) return std::numeric_limits<double>::infinity();
  return gsl_cdf_tdist_Pinv(0.975, freedom) * std::sqrt(covariance(parameter, parameter));
}

PairedDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Vector difference = a - b;
  const auto n = static_cast<double>(difference.size());
  const double mean = difference.mean();
  const double spread = std::sqrt((difference.array() - mean).square().sum() / std::max(1.0, n - 1));
  return {mean, spread / std::sqrt(n)};
}

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

double FittedLaw::restitution_at(double effective_mass) const {
  return std::clamp(restitution + slope * effective_mass, 0.0, 1.0);
}

double effective_mass(const TrackedBody& body, const State& state, int corner) {
  const Matrix3 w = analytic::space::inverse_contact_inertia(
      body.core().mass, world_inverse_inertia(body, state.attitude), body.arm(state.attitude, corner));
  return 1 / (body.core().mass * w(2, 2));
}

State struck(const TrackedBody& body, const State& before, int corner, const FittedLaw& law) {
  analytic::ImpactLaw impact_law;
  impact_law.restitution = law.restitution_at(law.slope == 0 ? 0 : effective_mass(body, before, corner));
  impact_law.law = law.law;
  impact_law.friction = analytic::FrictionKind::coulomb;
  impact_law.friction_value = std::max(0.0, law.friction);
  State after = before;
  try {
    const Vector3 place = before.attitude.conjugate() * body.arm(before.attitude, corner);
    const analytic::space::Impact impact = analytic::space::strike(body.core(), before, place, impact_law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  } catch (const analytic::OutsideModelError&) {
    return before;
  } catch (const analytic::NumericalError&) {
    return before;
  }
  return after;
}

double motion_size(const TrackedBody& body, const State& state) {
  return std::sqrt(state.velocity.squaredNorm() + body.gyration_square() * state.angular_velocity.squaredNorm());
}

double relative_error(const TrackedBody& body, const TrackImpact& impact, const State& predicted) {
  State apart = impact.after.state;
  apart.velocity -= predicted.velocity;
  apart.angular_velocity -= predicted.angular_velocity;
  return motion_size(body, apart) / motion_size(body, impact.before.state);
}

LawFit fit_law(const TrackedBody& body, const std::vector<PartImpact>& impacts, RestitutionLaw law, bool slope) {
  std::vector<const TrackImpact*> points;
  for (const PartImpact& item : impacts) {
    if (item.impact.is_point) points.push_back(&item.impact);
  }
  if (points.size() < least_points) {
    throw analytic::NumericalError("only " + std::to_string(points.size()) +
                                   " point impacts among the drops to fit on: restitution and friction need " +
                                   std::to_string(least_points));
  }
  LawFit result{.law = {.law = law}, .fit = {}, .slope = slope, .impacts = points.size()};
  const auto law_of = [&](const Eigen::VectorXd& p) { return FittedLaw{law, p[0], slope ? p[2] : 0, p[1]}; };
  const Losses losses = [&](const Eigen::VectorXd& p) {
    const FittedLaw trial = law_of(p);
    const double beyond = outside(p[1], 0, 2) + (slope ? 0 : outside(p[0], 0, 1));
    Eigen::VectorXd all(static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const State predicted = struck(body, points[i]->before.state, points[i]->corner, trial);
      all[static_cast<Eigen::Index>(i)] =
          pseudo_huber(relative_error(body, *points[i], predicted), quadratic_below) + beyond;
    }
    return all;
  };
  FitStart start{{0.4, 0.15}, {0.1, 0.05}};
  if (slope) start = {{0.4, 0.15, 0.0}, {0.1, 0.05, 0.1}};
  result.fit = fit_robustly(losses, start);
  // Where all impacts stick before they end, a larger friction fits as well, and μ is not settled.
  Eigen::VectorXd larger = result.fit.value;
  larger[1] = larger_friction * larger[1] + derivative_step;
  if (!(losses(larger).mean() > (1 + level_loss) * result.fit.loss())) {
    result.fit.covariance.row(1).setConstant(missing);
    result.fit.covariance.col(1).setConstant(missing);
  }
  result.law = law_of(result.fit.value);
  return result;
}

double floor_error(const TrackedBody& body, const TrackImpact& impact, double friction) {
  // Least |A P − y| over the cone by projected gradients; A maps an impulse per mass to (ΔV, k ΔΩ).
  const State &before = impact.before.state, &after = impact.after.state;
  const double k = std::sqrt(body.gyration_square());
  Eigen::Matrix<double, 6, 3> a;
  a.topRows<3>() = Matrix3::Identity();
  a.bottomRows<3>() = k * body.core().mass * world_inverse_inertia(body, before.attitude) * cross_matrix(impact.arm);
  Eigen::Matrix<double, 6, 1> y;
  y << after.velocity - before.velocity, k * (after.angular_velocity - before.angular_velocity);
  const double step = 1 / (a.transpose() * a).trace();
  Vector3 p = Vector3::Zero();
  for (int i = 0; i < floor_iterations; ++i) {
    Vector3 next = p + step * a.transpose() * (y - a * p);
    const double tangential = next.head<2>().norm();
    if (tangential > friction * next.z()) {  // the nearest point of the cone
      const double normal = std::max(0.0, (friction * tangential + next.z()) / (1 + friction * friction));
      next.head<2>() *= friction * normal / tangential;
      next.z() = normal;
    }
    const bool done = (next - p).norm() < floor_settled;
    p = next;
    if (done) break;
  }
  return (y - a * p).norm() / motion_size(body, before);
}

}  // namespace clatter::validation
