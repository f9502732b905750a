// SPDX-License-Identifier: GPL-3.0-or-later
// The shock response spectrum of a point of the body: what an oscillator mounted there goes through, by its natural
// frequency.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "validation/output/estimated.hpp"
#include "validation/shock/point_motion.hpp"

namespace clatter::validation {

// The response of a damped oscillator on a moving base, in closed form where the base's acceleration is a polynomial, a
// step of velocity, or nothing.

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
  /// Under an acceleration that runs straight from one value to another [m/s²], as between the samples of a record;
  /// with φ₁(x) = (e^x − 1)/x, φ₂(x) = (φ₁(x) − 1)/x and h = time,
  ///     q(h) = e^{λh} q(0) − h (φ₁(λh) s(0) + φ₂(λh) (s(h) − s(0))),                                         (3)
  /// the ramp-invariant filter of ISO 18431-4.  Extremes between the samples count, too.
  void ramp(double from, double to, double time);

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
  /// (3) of a part of a ramp.
  struct Ramp {
    double time = 0;  ///< [s]
    std::complex<double> turn, level, slope;
    [[nodiscard]] std::complex<double> after(std::complex<double> q, double from, double to) const {
      return turn * q - time * (level * from + slope * (to - from));
    }
  };
  [[nodiscard]] Ramp ramp_of(double time) const;
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
  Ramp ramp_;  ///< of the last part: samples are often at equal distances
  ResponseExtremes extremes_;
};

/// Specific force along an axis over a piece of the drop.
struct BasePiece {
  int impact = 0;
  bool in_contact = false;
  double begin = 0, length = 0;      ///< [s]
  ChebyshevPolynomial acceleration;  ///< [m/s²]
};
/// Acceleration of the point r along a unit vector of the body over the pieces; before and after them the base counts
/// as unaccelerated.
[[nodiscard]] std::vector<BasePiece> base_pieces(std::span<const MotionPiece> motion, const Vector3& r, double mass,
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
/// Largest absolute acceleration of an undamped oscillator at the point r, whichever axis of the body it has, while the
/// pieces last and after them [m/s²]:
///     R = √(R_x² + R_y² + R_z²),   R_i the exact response along axis i.
/// No axis has more; that of a force which keeps its direction in the body has as much.  The error is that of R_i.
[[nodiscard]] Estimated undamped_response(std::span<const MotionPiece> motion, const Vector3& r, double mass,
                                          double frequency);
/// Acceleration along an axis at an instant.
struct BaseSample {
  double time = 0;          ///< [s]
  double acceleration = 0;  ///< [m/s²]
};
/// By the exact solution of straight lines between samples; before the first and after the last the base counts as
/// unaccelerated.  The error is ∫|δs| dt of the lines, h |δ²s|/12 for each step whose second difference is more than
/// noise, and twice the standard deviation that independent noise gives |q|, at most √(Σ h² e^{−2ζω(t − t_i)}) times
/// its own: it grows by the root of their number, not by the number.
/// @param noise  standard deviation of a sample [m/s²]
[[nodiscard]] ResponsePoint response(std::span<const BaseSample> samples, double frequency, double quality,
                                     double noise = 0);
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
