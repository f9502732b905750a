// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/low_pass.hpp"

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr double design_of_class = 2.0775;
constexpr double memory = 8;  ///< of 1/f_d, after which the filter has forgotten all but 1e-12 of an impulse
const double cut_off_of_design = std::pow(std::numbers::sqrt2 - 1, 0.25);

}  // namespace

LowPass LowPass::of_class(double channel_class) { return {design_of_class * channel_class, channel_class}; }

LowPass LowPass::of_cut_off(double frequency) { return {.design = frequency / cut_off_of_design}; }

double LowPass::cut_off() const { return design * cut_off_of_design; }

std::string LowPass::name() const {
  return channel_class > 0 ? "CFC " + shortest(channel_class)
                           : fmt::format("a low-pass of {} Hz", significant(cut_off(), 4));
}

std::string LowPass::words() const {
  const std::string passes = "Butterworth, 2 poles forward and back, -3 dB at " + significant(cut_off(), 4) + " Hz";
  return channel_class > 0 ? fmt::format("{} of SAE J211-1, {}", name(), passes) : passes;
}

std::vector<Vector3> LowPass::filtered(const std::vector<Vector3>& values, double step) const {
  if (!(design * step < 0.5))
    throw std::domain_error(fmt::format("filter: {} samples in a second: must be more than {}",
                                        significant(1 / step, 4), significant(2 * design, 4)));
  const double w = std::tan(std::numbers::pi * design * step), all = 1 + std::numbers::sqrt2 * w + w * w;
  const double a = w * w / all, b1 = 2 * (1 - w * w) / all, b2 = (-1 + std::numbers::sqrt2 * w - w * w) / all;
  std::vector<Vector3> passed = values;
  const auto pass = [&](auto at, auto end) {
    if (at == end) return;
    Vector3 x1 = *at, x2 = x1, y1 = x1, y2 = x1;
    for (; at != end; ++at) {
      const Vector3 x = *at, y = a * (x + 2 * x1 + x2) + b1 * y1 + b2 * y2;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = *at = y;
    }
  };
  pass(passed.begin(), passed.end());
  pass(passed.rbegin(), passed.rend());
  return passed;
}

double LowPass::noise_gain(double step) const {
  const auto half = static_cast<std::size_t>(std::ceil(memory / (design * step)));
  std::vector<Vector3> impulse(2 * half + 1, Vector3::Zero());
  impulse[half].x() = 1;
  double squares = 0;
  for (const Vector3& value : filtered(impulse, step)) squares += value.x() * value.x();
  return std::sqrt(squares);
}

FilteredHistory filtered_history(std::span<const MotionPiece> motion, const Vector3& r, double mass,
                                 const LowPass& filter) {
  using Gauss = boost::math::quadrature::gauss<double, 7>;
  constexpr double steps = 200;  // of 1/f_d
  FilteredHistory history{.begin = -memory / filter.design, .step = 1 / (steps * filter.design), .values = {}};
  if (motion.empty()) return history;
  const MotionPiece& last = motion.back();
  const double end = last.begin() + last.piece.length + memory / filter.design;
  if (!(end - history.begin < 1e7 * history.step))
    throw std::domain_error(fmt::format("filter: {} Hz over {} s: takes more than 10 million steps",
                                        significant(filter.cut_off(), 4), significant(end, 4)));
  std::vector<Vector3> means(static_cast<std::size_t>((end - history.begin) / history.step) + 1, Vector3::Zero());
  for (const MotionPiece& piece : motion) {
    const VectorPolynomial felt =
        polynomial_of(piece, [&](const numeric::PieceSample& at) { return specific_force(at, r, mass); });
    const double length = piece.piece.length;
    // Value i is the mean from half a step before its time to half a step after it.
    const double from = (piece.begin() - history.begin) / history.step + 0.5, to = from + length / history.step;
    for (auto i = static_cast<std::size_t>(from); static_cast<double>(i) < to && i < means.size(); ++i) {
      const double begin = std::max(from, static_cast<double>(i)), finish = std::min(to, static_cast<double>(i) + 1);
      const auto along = [&](std::size_t axis) {
        return Gauss::integrate([&](double at) { return felt[axis].at((at - from) / (to - from)); }, begin, finish);
      };
      means[i] += Vector3(along(0), along(1), along(2));
    }
  }
  history.values = filter.filtered(means, history.step);
  return history;
}

}  // namespace clatter::validation
