// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/response_spectrum.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace clatter::validation {
namespace {

constexpr double infinite_time = std::numeric_limits<double>::infinity();
constexpr double response_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Takes the residual response, and the slack and rounding into the errors.
void end(Oscillator& oscillator, ResponsePoint& point) {
  oscillator.rest(infinite_time);
  point.residual = oscillator.take_extremes();
  const ResponseExtremes whole = point.whole();
  point.acceleration_error += oscillator.acceleration_slack() + response_rounding * whole.acceleration.maximax();
  point.pseudo_velocity_error +=
      oscillator.pseudo_velocity_slack() + response_rounding * whole.pseudo_velocity.maximax();
}

}  // namespace

ResponseExtremes ResponsePoint::whole() const {
  ResponseExtremes both = primary;
  both.note(residual);
  return both;
}

std::vector<BasePiece> base_pieces(const MotionRecorder& motion, const Vector3& r, double mass, const Vector3& axis) {
  std::vector<BasePiece> pieces;
  for (const MotionPiece& piece : motion.pieces()) {
    Samples samples{};
    for (std::size_t j = 0; j < sample_count; ++j) samples[j] = axis.dot(specific_force(piece.samples[j], r, mass));
    pieces.push_back(
        {piece.piece.impact, piece.piece.in_contact, piece.begin(), piece.piece.length, ChebyshevPolynomial(samples)});
  }
  return pieces;
}

std::vector<BasePiece> first_pieces(const std::vector<BasePiece>& pieces, int last) {
  std::vector<BasePiece> first;
  for (const BasePiece& piece : pieces) {
    if (piece.impact > last || (piece.impact == last && !piece.in_contact)) break;
    first.push_back(piece);
  }
  return first;
}

ResponsePoint response(std::span<const BasePiece> pieces, double frequency, double quality) {
  Oscillator oscillator(frequency, quality);
  ResponsePoint point{.frequency = frequency};
  double left_open = 0;  // ∫|δs| dt
  for (const BasePiece& piece : pieces) {
    oscillator.drive(piece.acceleration, piece.length);
    left_open += piece.length * piece.acceleration.tail();
  }
  point.primary = oscillator.take_extremes();
  const double stretch = 1 / std::sqrt(1 - 1 / (4 * quality * quality));  // ω/ω_d
  point.pseudo_velocity_error = left_open * stretch;
  point.acceleration_error = left_open * stretch * oscillator.omega();
  end(oscillator, point);
  return point;
}

ResponsePoint response(std::span<const VelocityStep> steps, double frequency, double quality) {
  Oscillator oscillator(frequency, quality);
  ResponsePoint point{.frequency = frequency};
  double error = 0, so_far = 0, last_time_error = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const VelocityStep& step = steps[i];
    if (i > 0) oscillator.rest(step.time - steps[i - 1].time);
    error += step.delta_v_error + oscillator.omega() * (step.time_error + last_time_error) * so_far;
    oscillator.step(step.delta_v);
    so_far += std::fabs(step.delta_v);
    last_time_error = step.time_error;
  }
  point.primary = oscillator.take_extremes();
  const double stretch = 1 / std::sqrt(1 - 1 / (4 * quality * quality));
  point.pseudo_velocity_error = error * stretch;
  point.acceleration_error = error * stretch * oscillator.omega();
  end(oscillator, point);
  return point;
}

/// An oscillator of unit frequency: only ω times the time between the steps matters.
Envelope envelope(double first, double second, double quality) {
  constexpr int points = 720;
  const double frequency = 1 / (2 * std::numbers::pi);
  const double longest = 2 * std::numbers::pi;  // a turn: later, the response to the first step is smaller
  const auto of = [&](double gap) {
    const VelocityStep steps[] = {{0, first}, {gap, second}};
    return response(std::span<const VelocityStep>(steps), frequency, quality).whole();
  };
  const auto largest = [&](auto&& value) {
    double best = 0;
    int at = 0;
    for (int i = 0; i <= points; ++i) {
      const double found = value(of(1.25 * longest * i / points));
      if (found > best) {
        best = found;
        at = i;
      }
    }
    const double step = 1.25 * longest / points;
    const auto refined = boost::math::tools::brent_find_minima([&](double gap) { return -value(of(gap)); },
                                                               std::max(at - 1, 0) * step, (at + 1) * step, 40);
    return std::max(best, -refined.second);
  };
  return {largest([](const ResponseExtremes& r) { return r.pseudo_velocity.maximax(); }),
          largest([](const ResponseExtremes& r) { return r.acceleration.maximax(); })};
}

std::vector<double> frequencies(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(count == 1 ? low : low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  }
  if (count > 1) values.back() = high;
  return values;
}

}  // namespace clatter::validation
