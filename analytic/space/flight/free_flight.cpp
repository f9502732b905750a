// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/free_flight.hpp"

#include <algorithm>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

namespace {

using Extended = long double;
constexpr Extended extended_pi = std::numbers::pi_v<Extended>;
/// Below this k′² the body stays near its intermediate axis for hundreds of time constants; it keeps K finite.
constexpr Extended smallest_complement = 1e-500L;

/// π/(2 AGM(1, x)): K of the modulus whose complement is x.
Extended quarter_period(Extended x) {
  if (x == 0) return std::numeric_limits<Extended>::infinity();
  Extended a = 1, b = x;
  while (std::fabs(a - b) > 4 * std::numeric_limits<Extended>::epsilon() * a) {
    const Extended mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return extended_pi / (a + b);
}

Extended square(Extended x) { return x * x; }

/// xⁿ by squaring: the nomes' series need small n alone, and std::pow of long double took half the time of a flight.
Extended power(Extended x, int n) {
  Extended result = n % 2 == 1 ? x : 1;
  while (n /= 2) {
    x *= x;
    if (n % 2 == 1) result *= x;
  }
  return result;
}

/// ϑ₂(0)/2q^¼, ϑ₃(0), ϑ₄(0) of a nome q <= e^−π.
struct ThetaConstants {
  Extended two, three, four;

  explicit ThetaConstants(Extended q) {
    const Extended even = 1 + 2 * power(q, 4), odd = 2 * (q + power(q, 9));
    two = 1 + q * q + power(q, 6) + power(q, 12);
    three = even + odd;
    four = even - odd;
  }
};

/// Place of the axis that the momentum circles, as the ends of the order of the moments.
bool circles_largest(const std::array<Extended, 3>& moments, const PrincipalVelocity& w) {
  const auto [a, b, c] = moments;
  return c * (c - b) * square(w[2]) >= a * (b - a) * square(w[0]);
}

}  // namespace

/// (1) and what follows from it.
struct ThetaRotation::Constants {
  std::array<Extended, 3> i{}, w{};
  Extended d12 = 0, d13 = 0, d23 = 0, x = 0, y = 0, s = 0;
  Extended energy = 0, momentum = 0;         ///< 2T, |L|
  Extended modulus = 0, complement = 0;      ///< k², k′²
  Extended quarter = 0, complementary = 0;   ///< K, K′
  Extended third = 0, third_complement = 0;  ///< M₃, 1 − M₃²
  Extended first_rate = 0;                   ///< dΦ/dt at u = 0

  void complete();
};

void ThetaRotation::Constants::complete() {
  d12 = std::fabs(i[0] - i[1]);
  d13 = std::fabs(i[0] - i[2]);
  d23 = std::fabs(i[1] - i[2]);
  x = i[0] * d13 * square(w[0]) + i[1] * d23 * square(w[1]);
  y = i[1] * d12 * square(w[1]) + i[2] * d13 * square(w[2]);
  s = i[2] * d23 * square(w[2]) - i[0] * d12 * square(w[0]);
}

void ThetaRotation::order(const PrincipalAxes& principal, const PrincipalVelocity& velocity, Constants& c) {
  c.i = principal.moments;
  c.w = velocity;
  axes_ = principal.axes;
  const auto flip = [&](int axis) {
    axes_.col(axis) = -axes_.col(axis);
    c.w[axis] = -c.w[axis];
  };
  if (!circles_largest(c.i, c.w)) {
    std::swap(c.i[0], c.i[2]);
    std::swap(c.w[0], c.w[2]);
    axes_.col(0).swap(axes_.col(2));
    flip(1);
  }
  for (const int axis : {2, 0}) {
    if (!(c.w[axis] < 0)) continue;
    flip(axis);
    flip(1);
  }
  c.complete();
}

bool ThetaRotation::is_steady(const PrincipalAxes& principal, const PrincipalVelocity& velocity) {
  ThetaRotation::Constants c{.i = principal.moments, .w = velocity};
  if (!circles_largest(c.i, c.w)) {
    std::swap(c.i[0], c.i[2]);
    std::swap(c.w[0], c.w[2]);
  }
  c.complete();
  return !(c.x > 0) || !(c.d23 * c.y > 0);
}

ThetaRotation::ThetaRotation(const PrincipalAxes& principal, const PrincipalVelocity& velocity) {
  Constants c;
  order(principal, velocity, c);
  const Extended denominator = c.d23 * c.y;
  c.complement = std::fmin(std::fmax(c.d13 * c.s / denominator, smallest_complement), Extended{1});
  c.modulus = std::fmin(c.d12 * c.x / denominator, Extended{1});
  c.quarter = quarter_period(std::sqrt(c.complement));
  c.complementary = quarter_period(std::sqrt(c.modulus));
  const Extended m1 = c.i[0] * c.x / c.d13, m2 = c.i[1] * c.x / c.d23, m3 = c.i[2] * c.y / c.d13;
  c.momentum = std::sqrt(square(c.i[0] * c.w[0]) + square(c.i[1] * c.w[1]) + square(c.i[2] * c.w[2]));
  c.energy = c.i[0] * square(c.w[0]) + c.i[1] * square(c.w[1]) + c.i[2] * square(c.w[2]);
  c.third = std::sqrt(m3) / c.momentum;
  c.third_complement = m1 / square(c.momentum);
  rate_ = std::sqrt(denominator / (c.i[0] * c.i[1] * c.i[2]));
  c.first_rate = (c.energy / c.momentum + std::sqrt(c.y / (c.i[2] * c.d13))) / (1 + c.third);
  quarter_ = c.quarter;
  sense_ = c.i[2] > c.i[0] ? 1 : -1;
  const Extended sn = sense_ * c.w[1] / std::sqrt(c.x / (c.i[1] * c.d23)),
                 cn = c.w[0] / std::sqrt(c.x / (c.i[0] * c.d13));
  const Extended dn_square = square(cn) + c.complement * square(sn);
  start_ = sn * boost::math::ellint_rf(square(cn), dn_square, Extended{1});
  momentum_ = static_cast<double>(c.momentum);
  modulus_square_ = static_cast<double>(c.modulus);
  const auto amplitude = [&](Extended m) { return static_cast<double>(std::sqrt(m) / c.momentum); };
  amplitudes_ = {amplitude(m1), amplitude(m2), amplitude(m3)};
  least_third_ = static_cast<double>(std::sqrt(c.complement)) * amplitudes_[2];
  for (int k = 0; k < 3; ++k) moments_[k] = static_cast<double>(c.i[k]);
  dual_ = c.modulus > Extended{0.5};
  if (dual_) set_dual(c);
  else set_direct(c);
}

void ThetaRotation::set_direct(const Constants& c) {
  const Extended b =
      c.third * boost::math::ellint_rf(c.third_complement, c.modulus + c.complement * c.third_complement, Extended{1});
  const Extended q = std::exp(-extended_pi * c.complementary / c.quarter),
                 shift = std::exp(-extended_pi * b / c.quarter);
  Extended value = 1, slope = 0;
  for (int n = 1; n < terms; ++n) {
    const Extended sign = n % 2 == 0 ? 1 : -1;
    const Extended growing = power(q, 2 * n * n - n) * power(shift, n);
    const Extended shrinking = q > 0 ? power(q, 2 * n * n + n) / power(shift, n) : 0;
    const auto place = static_cast<std::size_t>(n);
    real_[place] = static_cast<double>(sign * (growing + shrinking));
    imaginary_[place] = static_cast<double>(-sign * (growing - shrinking));
    value += sign * (growing + shrinking);
    slope -= sign * (growing - shrinking) * n;
  }
  precession_ = c.first_rate + 2 * sense_ * rate_ * (extended_pi / c.quarter) * slope / value;
  const ThetaConstants theta(q);
  scale_ = static_cast<double>(extended_pi / (2 * c.quarter));
  nome_ = static_cast<double>(q);
  sn_ = static_cast<double>(theta.three / theta.two);
  cn_ = static_cast<double>(theta.four / theta.two);
  dn_ = static_cast<double>(theta.four / theta.three);
}

void ThetaRotation::set_dual(const Constants& c) {
  const Extended den = c.modulus + c.complement * c.third_complement;
  const Extended gap = std::sqrt(c.third_complement / den) *
                       boost::math::ellint_rf(c.modulus * square(c.third) / den, c.modulus / den, Extended{1});
  const Extended p = std::exp(-extended_pi * c.quarter / (2 * c.complementary)),
                 beta = extended_pi * gap / (4 * c.complementary);
  Extended value = 0, slope = 0, end_real = 0, end_imaginary = 0;
  for (int n = 0; n < terms; ++n) {
    const Extended odd = 2 * n + 1, cosine = std::cos(odd * beta), sine = std::sin(odd * beta);
    const Extended weight = power(p, n * (n + 1)), rest = power(p, n * n);
    const auto place = static_cast<std::size_t>(n);
    real_[place] = static_cast<double>(rest * cosine);
    imaginary_[place] = static_cast<double>(rest * sine);
    value += weight * cosine;
    slope += weight * sine * odd;
    const Extended decay = power(p, 2 * n + 1);  // e^{−2(2n+1)y} at u = K, where p e^{2y} = 1
    end_real += rest * cosine * (1 + decay);
    end_imaginary += rest * sine * (1 - decay);
  }
  precession_ = c.first_rate + 2 * sense_ * rate_ * (extended_pi / (4 * c.complementary)) * slope / value;
  half_turn_ = -4 * sense_ * std::atan2(end_imaginary, end_real);
  const ThetaConstants theta(p * p);
  scale_ = static_cast<double>(extended_pi / (2 * c.complementary));
  nome_ = static_cast<double>(p);
  sn_ = static_cast<double>(theta.three / theta.four);
  cn_ = static_cast<double>(2 * theta.two / theta.four);
  dn_ = static_cast<double>(2 * theta.two / theta.three);
}

ThetaRotation::Moment ThetaRotation::at(double time) const {
  const Extended u = start_ + rate_ * time;
  const Extended halves = std::rint(u / (2 * quarter_));
  const Extended rest = u - halves * (2 * quarter_);
  const Extended angle = std::remainder(halves * half_turn_ + precession_ * time, 2 * extended_pi);
  const double argument = scale_ * static_cast<double>(rest);
  const Functions f = dual_ ? dual(argument) : direct(argument);
  const double sign = std::rint(halves / 2) == halves / 2 ? 1 : -1;
  Moment moment;
  moment.momentum =
      Vector3(amplitudes_[0] * sign * f.cn, sense_ * amplitudes_[1] * sign * f.sn, amplitudes_[2] * f.dn).normalized();
  // e^{iΦ}, with (z/|z|)^{∓2} for the theta function z.
  const double norm = f.real * f.real + f.imaginary * f.imaginary;
  const double c = (f.real - f.imaginary) * (f.real + f.imaginary) / norm,
               s = -sense_ * 2 * f.real * f.imaginary / norm;
  const double cosine = std::cos(static_cast<double>(angle)), sine = std::sin(static_cast<double>(angle));
  moment.cosine = c * cosine - s * sine;
  moment.sine = c * sine + s * cosine;
  return moment;
}

double ThetaRotation::period() const { return static_cast<double>(4 * quarter_ / rate_); }

double ThetaRotation::square_integral(double time) const {
  const Extended u = start_ + rate_ * time;
  const Extended halves = std::rint(u / (2 * quarter_));
  const double argument = scale_ * static_cast<double>(u - halves * (2 * quarter_));
  const Functions f = dual_ ? dual(argument) : direct(argument);
  const double least = least_third_ / amplitudes_[2];
  // Both are zero only where the separatrix is nearer than doubles tell.
  const auto integral = [](double x, double y) {
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    return x + y > 0 ? boost::math::ellint_rd(x, y, 1.0, InDouble()) / 3 : std::numeric_limits<double>::infinity();
  };
  const double rest = f.sn * f.sn * f.sn * integral(f.cn * f.cn, f.dn * f.dn);
  return halves == 0 ? rest : rest + static_cast<double>(2 * halves) * integral(0, least * least);
}

/// By sines and cosines of multiples of v = πu/2K.
ThetaRotation::Functions ThetaRotation::direct(double v) const {
  const double s = std::sin(v), c = std::cos(v);
  const double s2 = 2 * s * c, c2 = (c - s) * (c + s);
  const double s3 = s * c2 + c * s2, c3 = c * c2 - s * s2;
  const double s4 = 2 * s2 * c2, c4 = (c2 - s2) * (c2 + s2);
  const double s5 = s3 * c2 + c3 * s2, c5 = c3 * c2 - s3 * s2;
  const double s6 = 2 * s3 * c3, c6 = (c3 - s3) * (c3 + s3);
  const double q = nome_, q2 = q * q, q4 = q2 * q2, q6 = q2 * q4, q9 = q4 * q4 * q;
  const double even = 2 * (q * c2 + q9 * c6), fourth = 1 + 2 * q4 * c4;
  const double denominator = fourth - even;
  return {.sn = sn_ * (s - q2 * s3 + q6 * s5) / denominator,
          .cn = cn_ * (c + q2 * c3 + q6 * c5) / denominator,
          .dn = dn_ * (fourth + even) / denominator,
          .real = 1 + real_[1] * c2 + real_[2] * c4 + real_[3] * c6,
          .imaginary = imaginary_[1] * s2 + imaginary_[2] * s4 + imaginary_[3] * s6};
}

/// By hyperbolic sines and cosines of multiples of x = πu/2K′, each divided by its largest exponential; nome p².
ThetaRotation::Functions ThetaRotation::dual(double argument) const {
  const double x = std::fabs(argument), sign = argument < 0 ? -1 : 1;
  const double e = std::exp(-x), p = nome_, q = p * p;
  const double edge = p / e;  // 1 at u = K
  const double h = p * edge, h2 = h * h, h4 = h2 * h2, h6 = h4 * h2;
  const double e2 = e * e, e4 = e2 * e2, e6 = e4 * e2, e10 = e6 * e4, e14 = e10 * e4;
  const double q2h4 = q * q * h4, q6h6 = q * q * q * q * q * q * h6;
  const double denominator = (1 + e2) + h2 * (1 + e6) + q2h4 * (1 + e10) + q6h6 * (1 + e14);
  const double odd = edge * edge * (1 + e4) + q * q * q * h6 * (1 + e6 * e6), fourth = 1 + h4 * (1 + e4 * e4);
  Functions f{.sn = sign * sn_ * ((1 - e2) - h2 * (1 - e6) + q2h4 * (1 - e10) - q6h6 * (1 - e14)) / denominator,
              .cn = cn_ * e * (fourth - odd) / denominator,
              .dn = dn_ * e * (fourth + odd) / denominator};
  double growth = 1, decay = e;
  for (std::size_t n = 0; n < terms; ++n) {
    f.real += growth * real_[n] * (1 + decay);
    f.imaginary += sign * growth * imaginary_[n] * (1 - decay);
    growth *= edge;
    decay *= e2;
  }
  return f;
}

namespace {

using ExtendedVector = Eigen::Matrix<Extended, 3, 1>;

/// World components to body axes, with an attitude that is unit to the rounding of a double only.
ExtendedVector to_body(const Quaternion& attitude, const Vector3& v) {
  const Eigen::Quaternion<Extended> q = attitude.cast<Extended>();
  const ExtendedVector u = q.vec();
  const ExtendedVector w = v.cast<Extended>();
  const ExtendedVector t = 2 * w.cross(u);
  return w + (q.w() * t + t.cross(u)) / q.squaredNorm();
}

/// The shortest rotation from the unit vector m to axis 3, m₃ > −1.
Quaternion shortest_to_third(const Vector3& m) { return Quaternion(1 + m[2], m[1], -m[0], 0).normalized(); }

/// Its inverse applied to a vector.
Vector3 from_third(const Vector3& m, const Vector3& x) {
  const Vector3 across(-m[1], m[0], 0);
  const Vector3 turned = across.cross(x);
  return x + turned + across.cross(turned) / (1 + m[2]);
}

}  // namespace

FreeRotation::FreeRotation(const PrincipalAxes& principal, const Quaternion& attitude, const Vector3& angular_velocity)
    : start_(attitude.normalized()) {
  const ExtendedVector body = to_body(attitude, angular_velocity);
  const ExtendedVector along = principal.axes.transpose() * body;
  const PrincipalVelocity velocity{along[0], along[1], along[2]};
  start_vertical_ = (start_.conjugate() * Vector3::UnitZ()).normalized();
  speed_ = body.norm();
  fastest_ = static_cast<double>(speed_);
  if (speed_ > 0) axis_ = (body / speed_).cast<double>();
  if (ThetaRotation::is_steady(principal, velocity)) return;

  theta_.emplace(principal, velocity);
  const Vector3& i = theta_->moments();
  inverse_moments_ = theta_->momentum() * i.cwiseInverse();
  coefficients_ = {(i[1] - i[2]) / i[0], (i[2] - i[0]) / i[1], (i[0] - i[1]) / i[2]};
  // γ of a symmetric bilinear ω̇(ω, ω) with these coefficients.
  acceleration_factor_ = coefficients_.cwiseAbs().maxCoeff() * std::numbers::sqrt2 / 2;
  // |ω|² is linear in sn², so that its largest value lies at an end.
  const Vector3 w = theta_->amplitudes().cwiseProduct(inverse_moments_);
  const double third = theta_->least_third() * inverse_moments_[2];
  fastest_ =
      std::fmax(std::hypot(w[0], w[2]), std::hypot(w[1], third)) * (1 + 8 * std::numeric_limits<double>::epsilon());
  axes_ = theta_->axes().cast<double>();
  axis_ = axes_.col(2);
  axis_speed_ = std::fmax(w[0], w[1]) * (1 + 8 * std::numeric_limits<double>::epsilon());
  axes_attitude_ = Quaternion(axes_).normalized();
  const ThetaRotation::Moment now = theta_->at(0);
  const Quaternion spin = Quaternion(Eigen::AngleAxisd(std::atan2(now.sine, now.cosine), Vector3::UnitZ()));
  frame_ = (start_ * axes_attitude_ * (spin * shortest_to_third(now.momentum)).conjugate()).normalized();
  frame_vertical_ = (frame_.conjugate() * Vector3::UnitZ()).normalized();
}

FreeRotation::Spin FreeRotation::spin(double time) const {
  const ThetaRotation::Moment now = theta_->at(time);
  const Vector3& g = frame_vertical_;
  const Vector3 turned(now.cosine * g[0] + now.sine * g[1], now.cosine * g[1] - now.sine * g[0], g[2]);
  return {from_third(now.momentum, turned), inverse_moments_.cwiseProduct(now.momentum)};
}

Quaternion FreeRotation::attitude(double time) const {
  if (!theta_) {
    const double half = static_cast<double>(std::remainder(speed_ * time, 4 * std::numbers::pi_v<Extended>)) / 2;
    const Vector3 v = std::sin(half) * axis_;
    return (start_ * Quaternion(std::cos(half), v[0], v[1], v[2])).normalized();
  }
  const ThetaRotation::Moment now = theta_->at(time);
  const Quaternion spin = Quaternion(Eigen::AngleAxisd(std::atan2(now.sine, now.cosine), Vector3::UnitZ()));
  return (frame_ * spin * shortest_to_third(now.momentum) * axes_attitude_.conjugate()).normalized();
}

Vector3 FreeRotation::angular_velocity(double time) const {
  if (!theta_) return static_cast<double>(speed_) * axis_;
  return axes_ * inverse_moments_.cwiseProduct(theta_->at(time).momentum);
}

Vertical FreeRotation::vertical(double time) const {
  if (!theta_) return steady_vertical(time);
  const auto [e, w] = spin(time);
  const Vector3 acceleration(coefficients_[0] * w[1] * w[2], coefficients_[1] * w[2] * w[0],
                             coefficients_[2] * w[0] * w[1]);
  const Vector3 rate = e.cross(w);
  return {axes_ * e, axes_ * rate, axes_ * (rate.cross(w) + e.cross(acceleration))};
}

/// e turns about −axis.
Vertical FreeRotation::steady_vertical(double time) const {
  const double speed = static_cast<double>(speed_);
  const double angle = static_cast<double>(std::remainder(speed_ * time, 2 * std::numbers::pi_v<Extended>));
  const double s = std::sin(angle), half = std::sin(angle / 2);
  const Vector3 across = start_vertical_.cross(axis_);
  const Vector3 e = start_vertical_ + s * across + 2 * half * half * across.cross(axis_);
  const Vector3 rate = speed * e.cross(axis_);
  return {e, rate, speed * rate.cross(axis_)};
}

double FreeRotation::depth(const Vector3& place) const {
  const double reach = place.norm();
  if (!(speed_ > 0)) return -start_vertical_.dot(place);
  double lowest, highest, vertical;  // of the cosines: r with the momentum, and the vertical with the momentum
  if (theta_) {
    const Vector3 r = axes_.transpose() * place;
    const Vector3& m = theta_->amplitudes();
    const double swing = std::hypot(r[0] * m[0], r[1] * m[1]);
    const double ends[2] = {r[2] * m[2], r[2] * theta_->least_third()};
    lowest = std::min(ends[0], ends[1]) - swing;
    highest = std::max(ends[0], ends[1]) + swing;
    vertical = frame_vertical_[2];
  } else {
    lowest = highest = place.dot(axis_);
    vertical = start_vertical_.dot(axis_);
  }
  // The lowest r·z for an angle δ between r and the momentum is |r| cos(χ + δ); χ + δ = π is the deepest.
  const double chi = std::acos(std::clamp(vertical, -1.0, 1.0));
  const auto angle = [&](double cosine) { return reach > 0 ? std::acos(std::clamp(cosine / reach, -1.0, 1.0)) : 0; };
  const double nearest = std::clamp(std::numbers::pi - chi, angle(highest), angle(lowest));
  return -reach * std::cos(chi + nearest) + 16 * std::numeric_limits<double>::epsilon() * reach;
}

using detail::never;

State FreeFlight::at(double time) const {
  State state;
  state.position = start_.position + time * start_.velocity;
  state.position.x() += gravity_along_ / 2 * time * time;
  state.position.z() = centre_height(time);
  state.velocity = start_.velocity;
  state.velocity.x() += gravity_along_ * time;
  state.velocity.z() = centre_velocity(time);
  state.attitude = rotation_.attitude(time);
  state.angular_velocity = state.attitude * rotation_.angular_velocity(time);
  return state;
}

double FreeFlight::falls_through(double height) const {
  const double above = start_.position.z() - height, velocity = start_.velocity.z();
  if (gravity_ > 0) {
    const double square = velocity * velocity + 2 * gravity_ * above;
    if (!(square > 0)) return 0;
    const double root = std::sqrt(square);
    // The one of (V + √…)/g and its conjugate that does not cancel.
    return std::fmax(velocity > 0 ? (velocity + root) / gravity_ : 2 * above / (root - velocity), 0.0);
  }
  return velocity < 0 ? std::fmax(above / -velocity, 0.0) : never;
}

double FreeFlight::rises_through(double height) const {
  const double below = height - start_.position.z(), velocity = start_.velocity.z();
  if (!(below > 0)) return 0;
  if (!(velocity > 0)) return never;
  const double square = velocity * velocity - 2 * gravity_ * below;
  return square > 0 ? 2 * below / (velocity + std::sqrt(square)) : never;
}

}  // namespace clatter::analytic::space
