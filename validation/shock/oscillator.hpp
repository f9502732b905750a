// SPDX-License-Identifier: GPL-3.0-or-later
// The response of a damped oscillator on a moving base, in closed form where the base's acceleration is a polynomial, a
// step of velocity, or nothing.
#pragma once

#include <complex>
#include <vector>

#include "validation/shock/chebyshev.hpp"

namespace clatter::validation {

/// The largest and the least value of a response that begins at 0.
struct Extremes {
  double high = 0, low = 0;
  void note(double value);
  void note(const Extremes& other);
  [[nodiscard]] double maximax() const { return high > -low ? high : -low; }
};

/// Values of the two quantities of a shock response spectrum.
struct ResponseExtremes {
  Extremes acceleration;     ///< absolute, of the oscillator's mass: −2ζω ż − ω² z [m/s²]
  Extremes pseudo_velocity;  ///< −ω z [m/s]
  void note(const ResponseExtremes& other);
};

/// z̈ + 2ζω ż + ω² z = −s(t), z the displacement relative to the base, s the acceleration of the base, by one complex
/// number:
///     q = ż + ζω z + i ω_d z,   q̇ = λ q − s,   λ = −ζω + i ω_d,   ω_d = ω √(1 − ζ²)                     (1)
/// Begins at rest.  Source: eigenvector form of the equation of motion; ISO 18431-4 names the quantities.
class Oscillator {
 public:
  /// @param frequency  undamped natural frequency ω/2π [Hz], > 0
  /// @param quality  Q = 1/(2ζ), > 1/2; infinite: undamped
  /// @throws std::domain_error
  Oscillator(double frequency, double quality);

  /// A step of the base's velocity [m/s]: q → q − ΔV.
  void step(double delta_v);
  /// Without acceleration of the base for `time` [s], which may be infinite: q → q e^{λt}.
  void rest(double time);
  /// Under the acceleration p(x) [m/s²] for `time` [s], x from 0 to 1.  With P = Σ p^{(k)}/λ^{k+1}, derivatives by
  /// time,
  ///     q(t) = P(t) + e^{λt} (q(0) − P(0)),                                                                   (2)
  /// where |λ| time is large; else the convolution of (1) with a Gauss rule over parts of at most one radian, which is
  /// exact to rounding too.
  void drive(const ChebyshevPolynomial& p, double time);

  /// Since the last call, or the beginning.
  [[nodiscard]] ResponseExtremes take_extremes();
  /// By how much extremes may be off: in a long drive of an oscillator with little damping they are not sought one by
  /// one.
  [[nodiscard]] double acceleration_slack() const { return slack_ * omega_; }
  [[nodiscard]] double pseudo_velocity_slack() const { return slack_; }
  [[nodiscard]] double omega() const { return omega_; }

 private:
  struct Response;
  struct Part;
  struct Turning;
  class LongDrive;
  [[nodiscard]] Response response(std::complex<double> q, double s) const;
  void note(const Response& at);
  void note_turns(const Turning& part, const Response& from, const Response& to);
  void note_free(std::complex<double> factor, double time, Extremes& extremes) const;
  void drive_in_parts(const ChebyshevPolynomial& p, double time);
  void drive_at_once(const ChebyshevPolynomial& p, double time);
  void note_rest_of(const LongDrive& drive, const ChebyshevPolynomial& p, double from);

  double omega_, zeta_, omega_d_;
  std::complex<double> lambda_;
  std::complex<double> q_ = 0;
  double slack_ = 0;
  ResponseExtremes extremes_;
};

}  // namespace clatter::validation
