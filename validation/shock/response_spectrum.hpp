// SPDX-License-Identifier: GPL-3.0-or-later
// The shock response spectrum of a point of the body: what an oscillator mounted there goes through, by its natural
// frequency.
#pragma once

#include <span>
#include <vector>

#include "validation/shock/oscillator.hpp"
#include "validation/shock/point_motion.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {

/// Specific force along an axis over a piece of the drop.
struct BasePiece {
  int impact = 0;
  bool in_contact = false;
  double begin = 0, length = 0;      ///< [s]
  ChebyshevPolynomial acceleration;  ///< [m/s²]
};
/// Acceleration of the point r along a unit vector of the body, from the first touch-down to the end of the last
/// impact; before and after it the base counts as unaccelerated.
[[nodiscard]] std::vector<BasePiece> base_pieces(const MotionRecorder& motion, const Vector3& r, double mass,
                                                 const Vector3& axis);
/// The pulses of impact 1 alone, or to the end of impact `last`.
[[nodiscard]] std::vector<BasePiece> first_pieces(const std::vector<BasePiece>& pieces, int last);

/// A sudden change of the base's velocity: an impact of the discrete model.
struct VelocityStep {
  double time = 0;     ///< [s]
  double delta_v = 0;  ///< [m/s]
  double delta_v_error = 0, time_error = 0;
};

/// Response at one natural frequency.  Errors are of the maximax.
struct ResponsePoint {
  double frequency = 0;         ///< [Hz]
  ResponseExtremes primary{};   ///< while the base is accelerated
  ResponseExtremes residual{};  ///< after that
  double acceleration_error = 0, pseudo_velocity_error = 0;

  [[nodiscard]] ResponseExtremes whole() const;
};

/// By the exact solution on the polynomials.  The error is that of the polynomials: |δz| ω_d <= ∫|δs| dt, δs up to
/// their tails.
[[nodiscard]] ResponsePoint response(std::span<const BasePiece> pieces, double frequency, double quality);
/// In closed form: largest over all partial sums of the train and over the turns between and after its steps.  The
/// error is that of the steps, and of their times by a turn ω δt of the response so far.
[[nodiscard]] ResponsePoint response(std::span<const VelocityStep> steps, double frequency, double quality);

/// Largest pseudo-velocity and acceleration over ω after two steps, whatever the time between them [m/s]: a bound for
/// flights that are not known well.
struct Envelope {
  double pseudo_velocity = 0, acceleration_over_omega = 0;
};
[[nodiscard]] Envelope envelope(double first, double second, double quality);

/// From `low` to `high`, both included, at equal ratios.
[[nodiscard]] std::vector<double> frequencies(double low, double high, int count);

}  // namespace clatter::validation
