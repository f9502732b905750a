// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/slip_field.hpp"

#include <cmath>
#include <limits>

#include "analytic/base/angle.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

struct Quadratic {
  double b1, b2, d;
  /// b₂ cos χ + b₁ sin χ + d sin χ cos χ and its derivative.
  [[nodiscard]] double value(double c, double s) const { return b2 * c + b1 * s + d * s * c; }
  [[nodiscard]] double slope(double c, double s) const { return b1 * c - b2 * s + d * (c - s) * (c + s); }
};

/// The zero of `function` between `low` and `high`, where the sign turns from that of `sign` at the low end to the
/// other: Newton's method, bisection where a step would leave the bracket.
double bracketed_zero(const Quadratic& function, double low, double high, double sign) {
  double x = low + (high - low) / 2;
  for (int i = 0; i < 200 && high > low; ++i) {
    const double c = std::cos(x), s = std::sin(x);
    const double value = sign * function.value(c, s);
    if (value == 0) return x;
    (value > 0 ? low : high) = x;
    const double next = x - value / (sign * function.slope(c, s));
    const double before = x;
    x = next >= low && next <= high ? next : low + (high - low) / 2;
    if (std::fabs(x - before) <= epsilon / 2 * std::fabs(x)) break;
  }
  return x;
}

/// Angle of the principal axis of the larger eigenvalue.
double major_axis(const Matrix2& a) { return std::atan2(a(0, 1) + a(1, 0), a(0, 0) - a(1, 1)) / 2; }

}  // namespace

Direction direction_at(double angle) { return {angle, std::cos(angle), std::sin(angle)}; }

SlipField::SlipField(const Matrix3& w, double friction, NormalCoupling coupling)
    : normal_coupling_(coupling == NormalCoupling::none ? 0 : 1), friction_(friction) {
  const Matrix2 a = w.topLeftCorner<2, 2>() / w(2, 2);
  const Vector2 b = w.block<2, 1>(0, 2) / w(2, 2);
  const double axis = major_axis(a);
  axes_ << std::cos(axis), -std::sin(axis), std::sin(axis), std::cos(axis);
  const Vector2 along = axes_.transpose() * b;
  for (int i = 0; i < 2; ++i) {
    if (along[i] < 0) axes_.col(i) *= -1;
  }
  b1_ = std::fabs(along[0]);
  b2_ = std::fabs(along[1]);
  const double half = std::hypot((a(0, 0) - a(1, 1)) / 2, a(0, 1));
  a1_ = (a(0, 0) + a(1, 1)) / 2 + half;
  a2_ = a.determinant() / a1_;
  anisotropy_ = 2 * friction * half;
  find_zeros();
}

bool SlipField::is_straight() const { return turning_bound() <= 8 * epsilon * rounding_scale(); }

double SlipField::astroid_excess() const {
  const double c1 = std::cbrt(b1_), c2 = std::cbrt(b2_);
  const double sum = c1 * c1 + c2 * c2;
  const double astroid = sum * std::sqrt(sum);
  if (astroid == 0) return anisotropy_ > 0 ? std::numeric_limits<double>::infinity() : -1;
  return anisotropy_ / astroid - 1;
}

void SlipField::find_zeros() {
  const auto add = [&](double angle, bool attracts) { zeros_[count_++] = {direction_at(angle), attracts}; };
  add(pi + bracketed_zero({b1_, -b2_, anisotropy_}, 0, pi / 2, -1), false);
  if (astroid_excess() > 0) {
    const double c1 = std::cbrt(b1_), c2 = std::cbrt(b2_);
    const double least = c1 == 0 && c2 == 0 ? pi / 4 : std::atan2(c2, c1);
    const Quadratic fourth{b1_, b2_, -anisotropy_};
    add(2 * pi - bracketed_zero(fourth, least, pi / 2, -1), true);
    add(2 * pi - bracketed_zero(fourth, 0, least, 1), false);
  }
  add(2 * pi + bracketed_zero({-b1_, b2_, anisotropy_}, 0, pi / 2, 1), true);
}

SlipFieldSlopes::SlipFieldSlopes(const SlipField& field, const Matrix3& w, const std::array<Matrix3, 3>& turns)
    : friction_(field.friction()) {
  Matrix2 axes;
  axes << field.to_frame(Vector2::UnitX()), field.to_frame(Vector2::UnitY());
  for (int k = 0; k < 2; ++k) {
    const Matrix3& turn = turns[k];
    unit[k] = turn(2, 2) / w(2, 2);
    const Matrix3 change = turn / w(2, 2) - unit[k] / w(2, 2) * w;
    const Matrix2 a = axes * change.topLeftCorner<2, 2>() * axes.transpose();
    const Vector2 b = axes * change.block<2, 1>(0, 2);
    a11[k] = a(0, 0), a12[k] = a(0, 1), a22[k] = a(1, 1);
    b1[k] = b[0], b2[k] = b[1];
  }
}

InvariantDirections invariant_directions(const Matrix3& w, double friction) {
  const SlipField field(w, friction);
  InvariantDirections all;
  for (all.count = 0; all.count < field.zero_count(); ++all.count) {
    const auto& [at, attracts] = field.zero(all.count);
    all.list[all.count] = {.direction = field.to_world({at.cosine, at.sine}),
                           .slip_rate = w(2, 2) * field.slip_rate(at),
                           .normal_rate = w(2, 2) * field.normal_rate(at),
                           .attracts = attracts};
  }
  return all;
}

}  // namespace clatter::analytic::space
