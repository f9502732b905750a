// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/swept_range.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline scene {

double Sweep::value(long long i) const {
  if (i == count - 1 && step == 0) return to;
  if (step > 0) return std::fmin(clean_step(from, step, i), to);
  const double part = static_cast<double>(i) / static_cast<double>(count - 1);
  if (logarithmic) return from * std::pow(to / from, part);
  return from + (to - from) * part;
}

Sweep read_sweep(const SweepTexts& texts, const SweepDefault& fallback, const Range& range) {
  Sweep sweep{.from = fallback.from, .to = fallback.to};
  if (texts.from) sweep.from = read_number_option("--from", *texts.from, range);
  if (texts.to) sweep.to = read_number_option("--to", *texts.to, range);
  if (!(sweep.from <= sweep.to)) {
    throw BadInput(
        fmt::format("--from {}: must not be greater than --to {}", shortest(sweep.from), shortest(sweep.to)));
  }
  if (texts.step && texts.count) {
    throw BadInput(fmt::format("--step {} and --count {}: give one of them, not both", *texts.step, *texts.count));
  }
  if (texts.count) {
    sweep.count = read_integer_option("--count", *texts.count, 1, 100000000);
    if (sweep.count == 1) sweep.to = sweep.from;
    return sweep;
  }
  sweep.step = texts.step ? read_number_option("--step", *texts.step, positive_number) : fallback.step;
  const double steps = (sweep.to - sweep.from) / sweep.step;
  if (!(steps < 1e8)) throw BadInput(fmt::format("--step {}: more than 100000000 values", sweep.step));
  sweep.count = count_of_steps(steps);
  return sweep;
}

}  // namespace clatter::validation::inline scene
