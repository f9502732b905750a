// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/response_spectrum.hpp"

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace clatter::validation {
namespace {

using Complex = std::complex<double>;
using Gauss = boost::math::quadrature::gauss<double, 10>;

constexpr double many_radians = 60;       ///< of λ × time, from which (2) serves: the terms of P fall
constexpr int least_parts = 4;            ///< of a drive: the response may turn in each
constexpr int most_parts_at_once = 4000;  ///< of a radian, looked through one by one where (2) serves

}  // namespace

void Extremes::note(double value) {
  high = std::max(high, value);
  low = std::min(low, value);
}

void Extremes::note(const Extremes& other) {
  note(other.high);
  note(other.low);
}

void ResponseExtremes::note(const ResponseExtremes& other) {
  acceleration.note(other.acceleration);
  pseudo_velocity.note(other.pseudo_velocity);
}

/// The two quantities and their rates at an instant.
struct Oscillator::Response {
  double acceleration, acceleration_rate, pseudo_velocity, pseudo_velocity_rate;
};

/// A part of a drive of at most a radian, from q at x on.
struct Oscillator::Part {
  const ChebyshevPolynomial& p;
  double time;  ///< of the whole drive [s]
  Complex lambda, q;
  double x;

  /// q after a length of x more:  q e^{λt} − ∫ e^{λ(t−τ)} s(τ) dτ.
  [[nodiscard]] Complex after(double length) const {
    const double half = length / 2;
    Complex sum = 0;
    const auto add = [&](double node, double weight) {
      const double at = half * (1 + node);
      sum += weight * std::exp(lambda * time * (length - at)) * p.at(x + at);
    };
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      add(Gauss::abscissa()[i], Gauss::weights()[i]);
      add(-Gauss::abscissa()[i], Gauss::weights()[i]);
    }
    return q * std::exp(lambda * time * length) - sum * half * time;
  }
};

/// (2) in its parts; x over the drive.
class Oscillator::LongDrive {
 public:
  LongDrive(ChebyshevPolynomial p, double time, Complex lambda, Complex q) : time_(time), lambda_(lambda) {
    Complex factor = 1.0 / lambda;
    for (std::size_t k = 0; k < sample_count; ++k) {
      terms_[k] = {factor, p};
      p = p.derivative();
      factor /= lambda * time;
    }
    free_ = q - slow(0);
  }

  [[nodiscard]] Complex slow(double x) const { return sum(x, 0); }
  [[nodiscard]] Complex slow_rate(double x) const { return sum(x, 1) / time_; }  ///< by time
  [[nodiscard]] Complex at(double x) const { return slow(x) + free_ * std::exp(lambda_ * time_ * x); }
  [[nodiscard]] double free_size(double x) const { return std::abs(free_) * std::exp(lambda_.real() * time_ * x); }

 private:
  struct Term {
    Complex factor;
    ChebyshevPolynomial derivative;
  };
  /// Σ factor_k p^{(k + order)}(x)
  [[nodiscard]] Complex sum(double x, std::size_t order) const {
    Complex total = 0;
    for (std::size_t k = 0; k + order < sample_count; ++k)
      total += terms_[k].factor * terms_[k + order].derivative.at(x);
    return total;
  }

  double time_;
  Complex lambda_;
  std::array<Term, sample_count> terms_;
  Complex free_ = 0;
};

/// A part of a drive in which rates may change their signs.
struct Oscillator::Turning {
  double length;
  std::function<Response(double)> at;
};

Oscillator::Oscillator(double frequency, double quality)
    : omega_(2 * std::numbers::pi * frequency), zeta_(1 / (2 * quality)),
      omega_d_(omega_ * std::sqrt(1 - zeta_ * zeta_)), lambda_(-zeta_ * omega_, omega_d_) {
  if (!(frequency > 0) || !std::isfinite(frequency))
    throw std::domain_error(fmt::format("natural frequency = {}: must be greater than 0", frequency));
  if (!(quality > 0.5)) throw std::domain_error(fmt::format("quality factor = {}: must be greater than 0.5", quality));
}

Oscillator::Response Oscillator::response(Complex q, double s) const {
  const double z = q.imag() / omega_d_, speed = q.real() - zeta_ * omega_ * z;
  const double acceleration = -2 * zeta_ * omega_ * speed - omega_ * omega_ * z;
  return {acceleration, -2 * zeta_ * omega_ * (acceleration - s) - omega_ * omega_ * speed, -omega_ * z,
          -omega_ * speed};
}

void Oscillator::note(const Response& at) {
  extremes_.acceleration.note(at.acceleration);
  extremes_.pseudo_velocity.note(at.pseudo_velocity);
}

void Oscillator::step(double delta_v) {
  q_ -= delta_v;
  note(response(q_, 0));
}

/// Im(factor q e^{λt}) = A e^{−ζωt} sin(ω_d t + φ) turns where tan(ω_d t + φ) = ω_d/(ζω); of the maxima, and of the
/// minima, the first is the largest.
void Oscillator::note_free(Complex factor, double time, Extremes& extremes) const {
  const Complex begin = factor * q_;
  const double size = std::abs(begin), phase = std::arg(begin), turn = std::acos(zeta_);
  extremes.note(begin.imag());
  for (const double sign : {1.0, -1.0}) {
    const double at = sign > 0 ? turn : turn - std::numbers::pi;  // ω_d t + φ of a maximum, of a minimum
    double angle = std::fmod(at - phase, 2 * std::numbers::pi);
    if (angle < 0) angle += 2 * std::numbers::pi;
    const double when = angle / omega_d_;
    if (when <= time) extremes.note(sign * size * std::exp(-zeta_ * omega_ * when) * std::sin(turn));
  }
  if (std::isfinite(time)) extremes.note((begin * std::exp(lambda_ * time)).imag());
}

void Oscillator::rest(double time) {
  const double w = omega_, z = zeta_;
  note_free(-w / omega_d_, time, extremes_.pseudo_velocity);
  note_free(Complex(-(1 - 2 * z * z) * w * w / omega_d_, -2 * z * w), time, extremes_.acceleration);
  q_ = std::isfinite(time) ? q_ * std::exp(lambda_ * time) : 0;
}

/// Extremes within a part: where a rate changes its sign, by the secant of the rates in a bracket.
void Oscillator::note_turns(const Turning& part, const Response& from, const Response& to) {
  constexpr int most_secants = 6;
  for (const auto rate : {&Response::acceleration_rate, &Response::pseudo_velocity_rate}) {
    double low = 0, at_low = from.*rate, high = part.length, at_high = to.*rate;
    if (!(at_low * at_high < 0)) continue;
    int side = 0;  // of the end that moved last
    for (int i = 0; i < most_secants; ++i) {
      const double x = low - at_low * (high - low) / (at_high - at_low);
      const Response found = part.at(x);
      note(found);
      if (found.*rate == 0) break;
      if ((found.*rate < 0) == (at_low < 0)) {
        low = x;
        at_low = found.*rate;
        if (side == -1) at_high /= 2;  // Illinois: the end that stays twice loses weight
        side = -1;
      } else {
        high = x;
        at_high = found.*rate;
        if (side == 1) at_low /= 2;
        side = 1;
      }
    }
  }
}

void Oscillator::drive(const ChebyshevPolynomial& p, double time) {
  if (!(time > 0)) return;
  if (std::abs(lambda_) * time >= many_radians) drive_at_once(p, time);
  else drive_in_parts(p, time);
}

void Oscillator::drive_in_parts(const ChebyshevPolynomial& p, double time) {
  const int parts = std::max(least_parts, static_cast<int>(std::ceil(std::abs(lambda_) * time)));
  const double length = 1.0 / parts;
  Response now = response(q_, p.at(0));
  note(now);
  for (int i = 0; i < parts; ++i) {
    const Part part{p, time, lambda_, q_, i * length};
    const std::complex<double> next_q = part.after(length);
    const Response next = response(next_q, p.at((i + 1) * length));
    note(next);
    note_turns({length, [&](double x) { return response(part.after(x), p.at(part.x + x)); }}, now, next);
    q_ = next_q;
    now = next;
  }
}

void Oscillator::drive_at_once(const ChebyshevPolynomial& p, double time) {
  const LongDrive drive(p, time, lambda_, q_);
  const double radians = std::abs(lambda_) * time;
  const int parts = static_cast<int>(std::min(std::ceil(radians), static_cast<double>(most_parts_at_once)));
  const double length = std::min(1.0, 1 / radians);
  const auto at = [&](double x) { return response(drive.at(x), p.at(x)); };
  Response now = at(0);
  note(now);
  for (int i = 0; i < parts; ++i) {
    const double x = i * length, end = std::min(x + length, 1.0);
    const Response next = at(end);
    note(next);
    note_turns({end - x, [&](double part) { return at(x + part); }}, now, next);
    now = next;
  }
  const double looked_through = std::min(parts * length, 1.0);
  if (looked_through < 1) note_rest_of(drive, p, looked_through);
  q_ = drive.at(1);
}

/// Behind the parts that were looked through: the extremes of the slow part with all of the free amplitude that is left
/// about them, which the response comes up to within one turn.
void Oscillator::note_rest_of(const LongDrive& drive, const ChebyshevPolynomial& p, double from) {
  constexpr int points = 64;
  const double left = drive.free_size(from), turn = 2 * std::numbers::pi / std::abs(lambda_);
  const double pseudo_velocity = left * omega_ / omega_d_, acceleration = pseudo_velocity * omega_;
  double fastest = 0;
  for (int i = 0; i <= points; ++i) {
    const double x = from + (1 - from) * i / points;
    const Response slow = response(drive.slow(x), p.at(x));
    for (const double sign : {1.0, -1.0}) {
      extremes_.acceleration.note(slow.acceleration + sign * acceleration);
      extremes_.pseudo_velocity.note(slow.pseudo_velocity + sign * pseudo_velocity);
    }
    fastest = std::max(fastest, std::abs(drive.slow_rate(x)));
  }
  slack_ += left > 0 ? turn * fastest + 2 * zeta_ * left : 0;
}

namespace {

/// φ₁ and φ₂ of (3), by their series where the closed forms cancel.
std::pair<Complex, Complex> ramp_functions(Complex x) {
  constexpr double small = 1;
  constexpr int terms = 20;
  if (std::abs(x) > small) {
    const Complex first = (std::exp(x) - 1.0) / x;
    return {first, (first - 1.0) / x};
  }
  Complex second = 1;  // Σ x^k/(k + 2)!, by Horner's rule, times 2 until the end
  for (int k = terms; k > 2; --k) second = 1.0 + second * x / static_cast<double>(k);
  second /= 2;
  return {1.0 + second * x, second};
}

}  // namespace

Oscillator::Ramp Oscillator::ramp_of(double time) const {
  const auto [level, slope] = ramp_functions(lambda_ * time);
  return {time, std::exp(lambda_ * time), level, slope};
}

void Oscillator::ramp(double from, double to, double time) {
  if (!(time > 0)) return;
  const double parts = std::fmax(1, std::ceil(std::abs(lambda_) * time)), length = time / parts;
  if (ramp_.time != length) ramp_ = ramp_of(length);
  Response now = response(q_, from);
  note(now);
  for (double i = 0; i < parts; ++i) {
    const double begin = from + (to - from) * (i / parts), end = from + (to - from) * ((i + 1) / parts);
    const Complex next_q = ramp_.after(q_, begin, end);
    const Response next = response(next_q, end);
    note(next);
    note_turns({length,
                [&](double t) {
                  const double at = begin + (end - begin) * (t / length);
                  return response(ramp_of(t).after(q_, begin, at), at);
                }},
               now, next);
    q_ = next_q;
    now = next;
  }
}

ResponseExtremes Oscillator::take_extremes() {
  const ResponseExtremes taken = extremes_;
  extremes_ = {};
  return taken;
}

namespace {

constexpr double infinite_time = std::numeric_limits<double>::infinity();
constexpr double response_rounding = 64 * std::numeric_limits<double>::epsilon();

/// Takes the primary and the residual response, and into the errors what of the base's velocity is left open, the slack
/// and rounding.
/// @param left_open  ∫|δs| dt [m/s]
void end(Oscillator& oscillator, double left_open, double quality, ResponsePoint& point) {
  const double stretch = 1 / std::sqrt(1 - 1 / (4 * quality * quality));  // ω/ω_d
  point.primary = oscillator.take_extremes();
  point.pseudo_velocity_error = left_open * stretch;
  point.acceleration_error = left_open * stretch * oscillator.omega();
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

std::vector<BasePiece> base_pieces(std::span<const MotionPiece> motion, const Vector3& r, double mass,
                                   const Vector3& axis) {
  std::vector<BasePiece> pieces;
  for (const MotionPiece& piece : motion) {
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
  end(oscillator, left_open, quality, point);
  return point;
}

Estimated undamped_response(std::span<const MotionPiece> motion, const Vector3& r, double mass, double frequency) {
  Vector3 size, error;
  for (int i = 0; i < 3; ++i) {
    const ResponsePoint along = response(base_pieces(motion, r, mass, Vector3::Unit(i)), frequency, infinite_time);
    size[i] = along.whole().acceleration.maximax();
    error[i] = along.acceleration_error;
  }
  return {size.norm(), error.norm()};
}

ResponsePoint response(std::span<const BaseSample> samples, double frequency, double quality, double noise) {
  Oscillator oscillator(frequency, quality);
  ResponsePoint point{.frequency = frequency};
  const double noisy_bend = 3 * std::sqrt(6) * noise;  // δ²s of noise has 1 + 4 + 1 times its variance
  const double decay = oscillator.omega() / quality;   // 2ζω
  double left_open = 0, squares = 0, most_squares = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const BaseSample &from = samples[i - 1], &to = samples[i];
    const double step = to.time - from.time;
    oscillator.ramp(from.acceleration, to.acceleration, step);
    squares = squares * std::exp(-decay * step) + step * step;
    most_squares = std::max(most_squares, squares);
    if (i + 1 < samples.size()) {
      const double bend = std::fabs(samples[i + 1].acceleration - 2 * to.acceleration + from.acceleration);
      if (bend > noisy_bend) left_open += bend * step / 12;
    }
  }
  end(oscillator, left_open + 2 * noise * std::sqrt(most_squares), quality, point);
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
  end(oscillator, error, quality, point);
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
  for (int i = 0; i < count; ++i)
    values.push_back(count == 1 ? low : low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  if (count > 1) values.back() = high;
  return values;
}

}  // namespace clatter::validation
