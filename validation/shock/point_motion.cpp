// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/point_motion.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace clatter::validation {
namespace {

constexpr std::size_t degree = sample_count - 1;

/// cos(π j k/degree).
double cosine(std::size_t j, std::size_t k) {
  static const auto table = [] {
    std::array<double, 2 * degree> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(degree));
    return values;
  }();
  return table[j * k % table.size()];
}

}  // namespace

/// c_k = (2/d) Σ″ s_j T_k(y_j), y_j = −cos(π j/d), ends of the sum and c_0, c_d halved.
ChebyshevPolynomial::ChebyshevPolynomial(const Samples& samples) {
  for (std::size_t k = 0; k <= degree; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j <= degree; ++j) {
      const double part = samples[j] * cosine(j, k);
      sum += j == 0 || j == degree ? part / 2 : part;
    }
    const double sign = k % 2 == 0 ? 1 : -1;  // T_k(−y) = (−1)^k T_k(y)
    coefficients_[k] = sign * sum * (k == 0 || k == degree ? 1.0 : 2.0) / static_cast<double>(degree);
  }
}

ChebyshevPolynomial ChebyshevPolynomial::of_coefficients(const Samples& coefficients) {
  ChebyshevPolynomial polynomial;
  polynomial.coefficients_ = coefficients;
  return polynomial;
}

double ChebyshevPolynomial::at(double x) const {
  const double y = 2 * x - 1;
  double next = 0, after = 0;
  for (std::size_t k = degree; k > 0; --k) {
    const double now = coefficients_[k] + 2 * y * next - after;
    after = next;
    next = now;
  }
  return coefficients_[0] + y * next - after;
}

double ChebyshevPolynomial::integral() const {
  double sum = 0;
  for (std::size_t k = 0; k <= degree; k += 2) sum += coefficients_[k] / (1 - static_cast<double>(k * k));
  return sum;
}

ChebyshevPolynomial ChebyshevPolynomial::derivative() const {
  Samples rate{};
  for (std::size_t k = degree; k > 0; --k) {
    const double above = k + 1 <= degree ? rate[k + 1] : 0;
    rate[k - 1] = above + 4 * static_cast<double>(k) * coefficients_[k];  // dy/dx = 2
  }
  rate[0] /= 2;
  return of_coefficients(rate);
}

double ChebyshevPolynomial::tail() const {
  return std::fabs(coefficients_[degree - 1]) + std::fabs(coefficients_[degree]);
}

Vector3 specific_force(const numeric::PieceSample& at, const Vector3& r, double mass) {
  const Vector3& omega = at.state.angular_velocity;
  return at.state.attitude.conjugate() * at.force / mass + at.angular_acceleration.cross(r) +
         omega.cross(omega.cross(r));
}

Vector3 value_at(const VectorPolynomial& vector, double x) {
  return {vector[0].at(x), vector[1].at(x), vector[2].at(x)};
}

void MotionRecorder::operator()(const numeric::HistoryPiece& piece) {
  assert(piece.samples.size() == sample_count);
  pieces_.push_back({piece, {piece.samples.begin(), piece.samples.end()}});
  pieces_.back().piece.samples = {};
}

}  // namespace clatter::validation
