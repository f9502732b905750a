// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/free_rotation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace clatter::numeric {

namespace {

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

JacobiFunctions::JacobiFunctions(double complementary_parameter) : complement_(complementary_parameter) {
  assert(complement_ >= 1e-200 && complement_ <= 1);
  // The means agree to eps one step after they agree to its square root.
  constexpr double agreement = 1e-8;
  arithmetic_[0] = 1;
  geometric_[0] = std::sqrt(complement_);
  int n = 0;
  while (std::fabs(arithmetic_[n] - geometric_[n]) > agreement * arithmetic_[n] && n + 2 < most_means) {
    arithmetic_[n + 1] = (arithmetic_[n] + geometric_[n]) / 2;
    geometric_[n + 1] = std::sqrt(arithmetic_[n] * geometric_[n]);
    ++n;
  }
  means_ = n + 1;
  arithmetic_[n + 1] = (arithmetic_[n] + geometric_[n]) / 2;
  quarter_period_ = std::numbers::pi / (2 * arithmetic_[means_]);
}

JacobiFunctions::Values JacobiFunctions::at(double u) const {
  if (std::fabs(u) < 1e-9) return {.sn = u};  // terms of order u² are below rounding
  const double angle = arithmetic_[means_] * u;
  const double sine = std::sin(angle);
  double t = arithmetic_[means_] * (std::cos(angle) / sine);
  double dn = 1;
  for (int n = means_ - 1; n >= 0; --n) {
    const double z = t * t / arithmetic_[n + 1];
    t *= dn;
    dn = (geometric_[n] + z) / (arithmetic_[n] + z);
  }
  const double sn = std::copysign(1 / std::sqrt(1 + t * t), sine);
  return {.sn = sn, .cn = t * sn, .dn = dn};
}

double JacobiFunctions::argument(const Amplitude& amplitude) const {
  const double s = amplitude.sine, c = amplitude.cosine;
  return s * boost::math::ellint_rf(c * c, c * c + complement_ * s * s, 1.0, Policy());
}

double JacobiFunctions::remaining_integral(const Values& values, double h) const {
  const auto [sn, cn, dn] = values;
  return cn * cn * cn / (3 * (1 + h) * std::sqrt(complement_)) *
         boost::math::ellint_rj(sn * sn, 1.0, dn * dn / complement_, (1 + h * sn * sn) / (1 + h), Policy());
}

namespace {

// Quadrature over a fine mesh leaves this much, relative to the largest moment.
constexpr double input_rounding = 1e-10;

[[noreturn]] void refuse(const Matrix3& inertia, const std::string& constraint) {
  const Eigen::IOFormat row_by_row(6, Eigen::DontAlignCols, ", ", "; ", "", "", "[", "]");
  std::ostringstream message;
  message << "inertia = " << inertia.format(row_by_row) << ": " << constraint;
  throw std::domain_error(message.str());
}

PrincipalAxes of_diagonal(const Vector3& moments) {
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return moments[i] < moments[j]; });
  PrincipalAxes result;
  for (int i = 0; i < 3; ++i) {
    result.moments[i] = moments[order[i]];
    result.axes.col(i) = Vector3::Unit(order[i]);
  }
  return result;
}

/// The power of two keeps products of the tensor's elements within range, and costs no rounding.
PrincipalAxes of_full(const Matrix3& inertia, double largest) {
  const int exponent = std::ilogb(largest);
  const Matrix3 scaled = inertia.unaryExpr([&](double x) { return std::ldexp(x, -exponent); });
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver((scaled + scaled.transpose()) / 2);
  return {.moments = solver.eigenvalues().unaryExpr([&](double x) { return std::ldexp(x, exponent); }),
          .axes = solver.eigenvectors()};
}

}  // namespace

PrincipalAxes principal_axes(const Matrix3& inertia) {
  if (!inertia.allFinite()) refuse(inertia, "must be finite");
  const double largest = inertia.cwiseAbs().maxCoeff();
  if (!((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= input_rounding * largest)) {
    refuse(inertia, "must be symmetric");
  }
  PrincipalAxes result = inertia.isDiagonal(0) ? of_diagonal(inertia.diagonal()) : of_full(inertia, largest);
  const Vector3& moments = result.moments;
  if (!(moments[0] > 0)) refuse(inertia, "must be positive definite");
  if (!(moments[2] - moments[1] <= moments[0] + input_rounding * moments[2])) {
    refuse(inertia, "largest principal moment must not exceed the sum of the others");
  }
  if (result.axes.determinant() < 0) result.axes.col(1) *= -1;
  return result;
}

namespace {

Eigen::Quaterniond turn(const Vector3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace

SteadyPrecession::SteadyPrecession(const Rotation& start, const Rates& rates)
    : start_(start), precession_(rates.precession.norm()), spin_axis_(rates.spin_axis), spin_(rates.spin) {
  if (precession_ > 0) precession_axis_ = rates.precession / precession_;
}

Rotation SteadyPrecession::at(double time) const {
  const Eigen::Quaterniond precessed = start_.attitude * turn(precession_axis_, precession_ * time);
  if (spin_ == 0) return {precessed.normalized(), start_.angular_velocity};
  const Eigen::Quaterniond spin = turn(spin_axis_, spin_ * time);
  return {(precessed * spin).normalized(), spin.conjugate() * start_.angular_velocity};
}

double SteadyPrecession::largest_speed() const { return start_.angular_velocity.norm(); }

double SteadyPrecession::largest_acceleration() const {
  return std::fabs(spin_) * spin_axis_.cross(start_.angular_velocity).norm();
}

namespace {

// Below this k'² the body stays near its intermediate axis for more than 200 time constants, and a
// perturbation of one part in 1e100 changes that; it keeps K finite.
constexpr double smallest_complement = 1e-200;

/// Columns 3, −2, 1: the reversed order, right-handed again.
Matrix3 reversed(const Matrix3& axes) {
  Matrix3 result;
  result << axes.col(2), -axes.col(1), axes.col(0);
  return result;
}

/// Rotation about e₃ applied to a frame: F R₃(ψ).
Matrix3 turned(const Matrix3& frame, double psi) {
  const double s = std::sin(psi), c = std::cos(psi);
  Matrix3 result;
  result << c * frame.col(0) + s * frame.col(1), c * frame.col(1) - s * frame.col(0), frame.col(2);
  return result;
}

}  // namespace

EllipticRotation::Constants EllipticRotation::constants(const PrincipalAxes& principal,
                                                        const Vector3& angular_velocity) {
  const double a = principal.moments[0], b = principal.moments[1], c = principal.moments[2];
  assert(0 < a && a < b && b < c);
  const Vector3 along = principal.axes.transpose() * angular_velocity;
  const bool circles_largest = c * (c - b) * along[2] * along[2] >= a * (b - a) * along[0] * along[0];

  Constants k;
  k.moments = circles_largest ? principal.moments : principal.moments.reverse().eval();
  k.axes = circles_largest ? principal.axes : reversed(principal.axes);
  const Vector3 w = k.axes.transpose() * angular_velocity;
  const Vector3 squares = w.cwiseAbs2();
  const Vector3& i = k.moments;
  const double d12 = std::fabs(i[0] - i[1]), d13 = std::fabs(i[0] - i[2]), d23 = std::fabs(i[1] - i[2]);
  const double x = i[0] * d13 * squares[0] + i[1] * d23 * squares[1];
  const double y = i[1] * d12 * squares[1] + i[2] * d13 * squares[2];
  const double s = i[2] * d23 * squares[2] - i[0] * d12 * squares[0];

  const Vector3 sizes(std::sqrt(x / (i[0] * d13)), std::sqrt(x / (i[1] * d23)), std::sqrt(y / (i[2] * d13)));
  // From I₂ ω̇₂ = (I₃ − I₁) ω₃ ω₁ at u = 0.
  const double order = circles_largest ? 1 : -1;
  k.amplitudes = {std::copysign(sizes[0], w[0]), std::copysign(sizes[1], order * std::copysign(1.0, w[0]) * w[2]),
                  std::copysign(sizes[2], w[2])};
  k.rate = std::sqrt(d23 * y / (i[0] * i[1] * i[2]));
  k.complement = std::clamp(d13 * s / (d23 * y), smallest_complement, 1.0);
  k.ratio = circles_largest ? x / y : d12 / d23;
  k.start = {.sine = w[1] / k.amplitudes[1], .cosine = w[0] / k.amplitudes[0]};
  return k;
}

EllipticRotation::EllipticRotation(const PrincipalAxes& principal, const Rotation& start)
    : EllipticRotation(constants(principal, start.angular_velocity), start.attitude) {}

EllipticRotation::EllipticRotation(const Constants& constants, const Eigen::Quaterniond& attitude)
    : c_(constants), jacobi_(constants.complement), start_attitude_(attitude),
      reference_(constants.moments[0] < constants.moments[2] ? 0 : 2),
      start_argument_(jacobi_.argument(constants.start)) {
  const double smallest = c_.moments[reference_], largest = c_.moments[2 - reference_];
  const auto [sine, cosine] = c_.start;
  const JacobiFunctions::Values start{
      .sn = sine, .cn = cosine, .dn = std::sqrt(cosine * cosine + c_.complement * sine * sine)};
  const Vector3 momentum = c_.moments.cwiseProduct(c_.amplitudes.cwiseProduct(Vector3(start.cn, start.sn, start.dn)));
  start_frame_ = c_.axes * momentum_frame(momentum);

  modulation_ = c_.ratio * smallest / largest;
  quarter_integral_ = jacobi_.remaining_integral({}, modulation_);
  start_integral_ = integral(start);
  const double slowest = momentum.norm() / largest;
  const double swing = c_.ratio / (1 + modulation_) * (largest - smallest) / largest;
  fastest_precession_ = slowest * (1 + swing);
  precession_swing_ = slowest * swing / c_.rate;
}

Matrix3 EllipticRotation::momentum_frame(const Vector3& momentum) const {
  const Vector3 e3 = momentum.normalized();
  const Vector3 e2 = Vector3::Unit(reference_).cross(e3).normalized();
  Matrix3 frame;
  frame << e2.cross(e3), e2, e3;
  return frame;
}

double EllipticRotation::integral(const JacobiFunctions::Values& values) const {
  const double size = quarter_integral_ - jacobi_.remaining_integral(values, modulation_);
  return std::copysign(size, values.sn);
}

Rotation EllipticRotation::at(double time) const {
  const double half_period = 2 * jacobi_.quarter_period();
  const double u = start_argument_ + c_.rate * time;
  const double halves = std::nearbyint(u / half_period);
  const JacobiFunctions::Values jacobi = jacobi_.at(std::fma(-halves, half_period, u));
  const double sign = std::fmod(halves, 2) == 0 ? 1 : -1;
  const Vector3 velocity(c_.amplitudes[0] * sign * jacobi.cn, c_.amplitudes[1] * sign * jacobi.sn,
                         c_.amplitudes[2] * jacobi.dn);

  const double swung = 2 * halves * quarter_integral_ + (integral(jacobi) - start_integral_);
  const double psi = fastest_precession_ * time - precession_swing_ * swung;
  const Matrix3 frame = c_.axes * momentum_frame(c_.moments.cwiseProduct(velocity));
  const Matrix3 change = turned(start_frame_, psi) * frame.transpose();
  return {(start_attitude_ * Eigen::Quaterniond(change)).normalized(), c_.axes * velocity};
}

double EllipticRotation::largest_speed() const {
  // |ω|²/2T is a mean of 1/I with weights I_i ω_i²/2T that keep the mean of I.  As 1/I is convex, it is
  // largest where the middle moment takes no part, sn = 0.
  return std::hypot(c_.amplitudes[0], c_.amplitudes[2]);
}

double EllipticRotation::largest_acceleration() const {
  // ω̇ = λ (−W₁ sn dn, W₂ cn dn, −k² W₃ sn cn), with dn <= 1 and |sn cn| <= 1/2.
  const double across = std::fmax(std::fabs(c_.amplitudes[0]), std::fabs(c_.amplitudes[1]));
  return c_.rate * std::hypot(across, (1 - c_.complement) * c_.amplitudes[2] / 2);
}

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double equal_moments = 4 * eps;        // relative to the larger one
constexpr double negligible = 1e-120;            // part of |ω| whose square might underflow
constexpr double bound_rounding = 1 + 16 * eps;  // what the bounds and at() may be off
constexpr double largest_phase = 1e300;          // keeps angles finite

/// Largest power of two <= size; 1 for zero.
double power_of_two(double size) { return size > 0 ? std::ldexp(1.0, std::ilogb(size)) : 1; }

/// Unit attitude, and the velocity in units of `rate`.
Rotation scaled(const Rotation& start, double rate) {
  if (!start.angular_velocity.allFinite()) throw std::domain_error("angular velocity must be finite");
  const double norm = start.attitude.coeffs().stableNorm();
  if (!(norm > 0 && std::isfinite(norm))) {
    throw std::domain_error("attitude must be a finite quaternion other than zero");
  }
  return {Eigen::Quaterniond(start.attitude.coeffs() / norm), start.angular_velocity / rate};
}

/// Rotation of a body whose moments other than `distinct` are equal.  The precession is the momentum divided
/// by their moment: as ω − σ s it would lose what a thin rod's fast spin leaves of it.
SteadyPrecession symmetric(const PrincipalAxes& body, const Rotation& start, int distinct) {
  const double across = (body.moments.sum() - body.moments[distinct]) / 2;
  const double ratio = body.moments[distinct] / across;
  const double difference = (across - body.moments[distinct]) / across;
  const Vector3 along = body.axes.transpose() * start.angular_velocity;
  Vector3 precession = along;
  precession[distinct] *= ratio;
  return SteadyPrecession(start, {.precession = body.axes * precession,
                                  .spin_axis = body.axes.col(distinct),
                                  .spin = difference * along[distinct]});
}

std::variant<SteadyPrecession, EllipticRotation> solve(PrincipalAxes body, const Rotation& start) {
  const Vector3 along = body.axes.transpose() * start.angular_velocity;
  if ((along.array().abs() > negligible).count() < 2) return SteadyPrecession(start);
  body.moments /= power_of_two(body.moments[2]);
  const auto equal = [&](int i, int j) { return body.moments[j] - body.moments[i] <= equal_moments * body.moments[j]; };
  if (equal(0, 1)) return symmetric(body, start, 2);
  if (equal(1, 2)) return symmetric(body, start, 0);
  return EllipticRotation(body, start);
}

}  // namespace

FreeRotation::FreeRotation(const Matrix3& inertia, const Rotation& start)
    : rate_(power_of_two(start.angular_velocity.cwiseAbs().maxCoeff())),
      rotation_(solve(principal_axes(inertia), scaled(start, rate_))) {}

Rotation FreeRotation::at(double time) const {
  if (std::isnan(time)) throw std::domain_error("time is not a number");
  const double phase = std::clamp(rate_ * time, -largest_phase, largest_phase);
  Rotation result = std::visit([&](const auto& rotation) { return rotation.at(phase); }, rotation_);
  result.angular_velocity *= rate_;
  return result;
}

double FreeRotation::largest_speed() const {
  return rate_ * bound_rounding * std::visit([](const auto& rotation) { return rotation.largest_speed(); }, rotation_);
}

double FreeRotation::largest_acceleration() const {
  return rate_ * rate_ * bound_rounding *
         std::visit([](const auto& rotation) { return rotation.largest_acceleration(); }, rotation_);
}

}  // namespace clatter::numeric
