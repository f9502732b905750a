// SPDX-License-Identifier: GPL-3.0-or-later
// Response spectra against closed forms of single pulses, dense sums of steps and a ramp-invariant digital filter.
#include "validation/shock/response_spectrum.hpp"

#include <boost/math/tools/minima.hpp>

#include "tests/support.hpp"

using namespace clatter::validation;

namespace {

using std::numbers::pi;
constexpr double undamped = clatter::test::infinite;
constexpr double closed_form = 1e-8;  // what is claimed of pulses; polynomials of degree 8 on 16 pieces leave 1e-13
constexpr double of_train = 1e-10;    // what is claimed of trains of steps
constexpr double rounding = 1e-13;

using Function = std::function<double(double)>;

/// A pulse of length 1 s, cut at its kinks, as pieces of the history.
std::vector<BasePiece> pieces_of(const Function& pulse, const std::vector<double>& kinks, int parts = 16) {
  std::vector<BasePiece> pieces;
  for (std::size_t k = 0; k + 1 < kinks.size(); ++k) {
    const double length = (kinks[k + 1] - kinks[k]) / parts;
    for (int i = 0; i < parts; ++i) {
      Samples samples{};
      const double begin = kinks[k] + i * length;
      for (std::size_t j = 0; j < sample_count; ++j)
        samples[j] = pulse(begin + length * clatter::numeric::piece_point(static_cast<int>(j)));
      pieces.push_back({1, true, begin, length, ChebyshevPolynomial(samples)});
    }
  }
  return pieces;
}

/// Largest size over [0, 1] of a function with no more than some tens of turns.
double largest(const Function& of) {
  constexpr int points = 20'000;
  double best = 0;
  int at = 0;
  for (int i = 0; i <= points; ++i) {
    const double found = std::fabs(of(static_cast<double>(i) / points));
    if (found > best) {
      best = found;
      at = i;
    }
  }
  const auto refined = boost::math::tools::brent_find_minima(
      [&](double t) { return -std::fabs(of(t)); }, std::max(at - 1, 0) / static_cast<double>(points),
      std::min(at + 1, points) / static_cast<double>(points), 50);
  return std::max(best, -refined.second);
}

/// A pulse of height and length 1, and ω² times the displacement of the undamped oscillator under it, from the theory
/// of vibrations.
struct Pulse {
  const char* name;
  Function acceleration;
  std::vector<double> kinks;
  std::function<double(double t, double w)> response;
};

double ramp(double t, double w) { return t <= 0 ? 0 : t - std::sin(w * t) / w; }

const std::vector<Pulse>& pulses() {
  static const std::vector<Pulse> all{
      {"half sine",
       [](double t) { return std::sin(pi * t); },
       {0, 1},
       [](double t, double w) { return (std::sin(pi * t) - pi / w * std::sin(w * t)) / (1 - pi * pi / (w * w)); }},
      {"terminal sawtooth", [](double t) { return t; }, {0, 1}, ramp},
      {"triangle",
       [](double t) { return t < 0.5 ? 2 * t : 2 - 2 * t; },
       {0, 0.5, 1},
       [](double t, double w) { return 2 * ramp(t, w) - 4 * ramp(t - 0.5, w); }},
      {"versed sine",
       [](double t) { return (1 - std::cos(2 * pi * t)) / 2; },
       {0, 1},
       [](double t, double w) {
         const double p = 2 * pi;
         return (1 - std::cos(w * t) - w * w / (w * w - p * p) * (std::cos(p * t) - std::cos(w * t))) / 2;
       }},
      {"rectangle", [](double) { return 1.0; }, {0, 1}, [](double t, double w) { return 1 - std::cos(w * t); }}};
  return all;
}

/// √(u² + (u̇/ω)²) at the end of the pulse; u̇ by a difference of the closed form, good to 1e-10.
double residual_of(const Pulse& pulse, double w) {
  const double h = 1e-3 / w;
  const auto u = [&](double t) { return pulse.response(t, w); };
  // Sixth order, one-sided: past its end the pulse's own formula goes on.
  const double rate = (147 * u(1) - 360 * u(1 - h) + 450 * u(1 - 2 * h) - 400 * u(1 - 3 * h) + 225 * u(1 - 4 * h) -
                       72 * u(1 - 5 * h) + 10 * u(1 - 6 * h)) /
                      (60 * h);
  return std::hypot(u(1), rate / w);
}

}  // namespace

BOOST_AUTO_TEST_CASE(single_pulses_have_the_spectra_of_their_closed_forms) {
  for (const Pulse& pulse : pulses()) {
    const std::vector<BasePiece> pieces = pieces_of(pulse.acceleration, pulse.kinks);
    for (const double f : {0.03, 0.11, 0.37, 0.61, 0.809936786, 1.3, 2.71, 7.7, 23.1}) {
      BOOST_TEST_CONTEXT(pulse.name << " at f T = " << f) {
        const double w = 2 * pi * f;
        const ResponsePoint found = response(pieces, f, undamped);
        const double primary = largest([&](double t) { return pulse.response(t, w); });
        const double residual = residual_of(pulse, w);
        BOOST_TEST(std::fabs(found.primary.acceleration.maximax() - primary) < closed_form);
        BOOST_TEST(std::fabs(found.residual.acceleration.maximax() - residual) < closed_form);
        BOOST_TEST(std::fabs(w * found.whole().pseudo_velocity.maximax() - std::max(primary, residual)) < closed_form);
        BOOST_TEST(found.acceleration_error < closed_form * std::max(1.0, w));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_long_pulse_with_thousands_of_turns_keeps_the_closed_form) {
  // One piece of the whole rectangle or sawtooth: the closed solution with P, and the rest in which turns are not
  // sought.
  for (const double f : {20.0, 300.0, 5000.0}) {
    const double w = 2 * pi * f;
    const auto rectangle = response(pieces_of([](double) { return 1.0; }, {0, 1}, 1), f, undamped);
    BOOST_TEST(std::fabs(rectangle.primary.acceleration.maximax() - 2) < closed_form);
    const auto sawtooth = response(pieces_of([](double t) { return t; }, {0, 1}, 1), f, undamped);
    const double highest = 1 + 1 / w;  // no more than that: 1 − sin(w)/w at the end, or a turn before it
    BOOST_TEST(sawtooth.primary.acceleration.maximax() < highest + sawtooth.acceleration_error);
    BOOST_TEST(sawtooth.primary.acceleration.maximax() > 1 - 1 / w);
  }
}

BOOST_AUTO_TEST_CASE(a_damped_step_of_velocity_has_its_closed_form) {
  const VelocityStep steps[] = {{0, 3}};
  const double zeta = 0.05, at_the_top = std::exp(-zeta / std::sqrt(1 - zeta * zeta) * std::acos(zeta));
  for (const double f : {1.0, 1000.0}) {
    const ResponsePoint found = response(std::span<const VelocityStep>(steps), f, 10);
    BOOST_TEST(std::fabs(found.whole().pseudo_velocity.maximax() / 3 - at_the_top) < rounding);
    BOOST_TEST(std::fabs(found.whole().acceleration.maximax() / (2 * pi * f * 3) - 0.931345) < 5e-7);
  }
}

BOOST_AUTO_TEST_CASE(trains_of_steps_agree_with_a_dense_sum) {
  clatter::test::Random random(7);
  for (int trial = 0; trial < 30; ++trial) {
    const int count = 1 + trial % 5;
    const double quality = trial % 3 == 0 ? undamped : random(2, 22), zeta = 1 / (2 * quality);
    const double f = random.decades(-1, 1), w = 2 * pi * f, wd = w * std::sqrt(1 - zeta * zeta);
    std::vector<VelocityStep> steps;
    double time = 0;
    for (int i = 0; i < count; ++i, time += random(0, 1)) steps.push_back({time, random(-0.7, 1.3)});
    const auto response_at = [&](double t) {  // −ω z
      double sum = 0;
      for (const VelocityStep& step : steps) {
        const double since = t - step.time;
        if (since >= 0) sum += step.delta_v * std::exp(-zeta * w * since) * w / wd * std::sin(wd * since);
      }
      return sum;
    };
    double best = 0;
    const double end = steps.back().time + 1 / f;
    steps.push_back({end, 0});  // the last interval ends a turn after the last step
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      const double begin = steps[i].time, length = std::nextafter(steps[i + 1].time, 0) - begin;
      best = std::max(best, largest([&](double x) { return response_at(begin + x * length); }));
    }
    steps.pop_back();
    const ResponsePoint found = response(std::span<const VelocityStep>(steps), f, quality);
    BOOST_TEST(std::fabs(found.whole().pseudo_velocity.maximax() - best) < of_train);
  }
}

BOOST_AUTO_TEST_CASE(the_residual_of_an_undamped_train_is_the_size_of_its_fourier_sum) {
  const VelocityStep steps[] = {{0, 1.5}, {0.31, 2.5}, {0.77, -0.4}};
  for (const double f : {0.2, 1.7, 40.0}) {
    std::complex<double> sum = 0;
    for (const VelocityStep& step : steps) sum += step.delta_v * std::polar(1.0, 2 * pi * f * step.time);
    const ResponsePoint found = response(std::span<const VelocityStep>(steps), f, undamped);
    BOOST_TEST(std::fabs(found.residual.pseudo_velocity.maximax() - std::abs(sum)) < 1e-12);
    BOOST_TEST(found.whole().pseudo_velocity.maximax() >= std::abs(sum) - 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(the_envelope_bounds_every_gap_and_is_reached) {
  for (const double second : {2.0, -0.8}) {
    const Envelope bound = envelope(1, second, 10);
    double reached = 0;
    for (int i = 0; i <= 1000; ++i) {
      const VelocityStep steps[] = {{0, 1}, {i * 2e-3, second}};
      const auto found = response(std::span<const VelocityStep>(steps), 1, 10).whole().pseudo_velocity.maximax();
      reached = std::max(reached, found);
      BOOST_TEST(found <= bound.pseudo_velocity * (1 + 1e-9));
    }
    BOOST_TEST(reached > bound.pseudo_velocity * (1 - 1e-5));
  }
  BOOST_TEST(std::fabs(envelope(1, 2, undamped).pseudo_velocity - 3) < 1e-9);
}

namespace {

/// ISO 18431-4: the digital filter that is exact where the base's acceleration is linear between samples; absolute
/// acceleration at the samples.
std::vector<double> ramp_invariant(const std::vector<double>& s, double h, double f, double quality) {
  const double w = 2 * pi * f, zeta = 1 / (2 * quality), a = w * h * zeta, b = w * h * std::sqrt(1 - zeta * zeta);
  const double c = std::exp(-a) * std::cos(b), d = std::exp(-a) * std::sin(b) / b;
  const double b0 = 1 - d, b1 = 2 * (d - c), b2 = std::exp(-2 * a) - d, a1 = -2 * c, a2 = std::exp(-2 * a);
  std::vector<double> response;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const auto before = [&](const std::vector<double>& of, std::size_t by) { return i >= by ? of[i - by] : 0.0; };
    response.push_back(b0 * s[i] + b1 * before(s, 1) + b2 * before(s, 2) - a1 * before(response, 1) -
                       a2 * before(response, 2));
  }
  return response;
}

/// The largest size, between the samples that surround it by a parabola, which is of higher order than the filter.
double top_of(const std::vector<double>& samples) {
  std::size_t at = 1;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    if (std::fabs(samples[i]) > std::fabs(samples[at])) at = i;
  }
  const double before = samples[at - 1], middle = samples[at], after = samples[at + 1];
  const double slope = (after - before) / 2, bend = before - 2 * middle + after;
  return std::fabs(middle - slope * slope / (2 * bend));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_ramp_invariant_filter_agrees_at_second_order) {
  const std::vector<BasePiece> pieces = pieces_of(pulses()[0].acceleration, {0, 1});
  for (const double f : {0.4, 1.1, 3.3}) {
    const double exact = response(pieces, f, 10).whole().acceleration.maximax();
    double last = 0;
    for (const int n : {1000, 2000, 4000}) {  // more samples only show the rounding of 1 − d, ε/(ω h)²
      std::vector<double> samples;
      const double h = 1.0 / n;
      for (int i = 0; i <= static_cast<int>(n * (1 + 1 / f)); ++i) samples.push_back(i < n ? std::sin(pi * i * h) : 0);
      const double off = std::fabs(top_of(ramp_invariant(samples, h, f, 10)) - exact);
      // Lines miss the sine by (π h)²/8.
      BOOST_TEST(off < exact * std::pow(pi * h, 2) / 4);
      if (last > 0) BOOST_TEST(std::fabs(std::log2(last / off) - 2) < 0.05, "order " << std::log2(last / off));
      last = off;
    }
    BOOST_TEST(last < 1e-6);
  }
}
