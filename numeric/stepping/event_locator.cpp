// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/event_locator.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>

namespace clatter::numeric {

double EventLocator::fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now,
                          double h, ContactInstant& at_root) {
  const double at_start = indicator(now), at_end = indicator(at_root);
  if (!(at_start > 0 && at_end <= 0)) return h;
  const auto value = [&](double length) {
    if (length <= 0) return at_start;
    const double found = step_.take(now, length, trial_) ? indicator(trial_) : at_end;
    return std::isfinite(found) ? found : at_end;
  };
  const double resolution = 1e-14 * (scales_.time + now.time);
  std::uintmax_t iterations = 50;
  const double high =
      boost::math::tools::toms748_solve(
          value, 0.0, h, at_start, at_end, [&](double a, double b) { return b - a <= resolution; }, iterations)
          .second;
  if (!step_.take(now, high, trial_)) return h;
  at_root = trial_;
  return high;
}

double EventLocator::lift_off(const ContactInstant& now, double h, ContactInstant& at_root) {
  const double resolution = 1e-13 * scales_.depth;
  double low = 0, high = h, length = h, reached = h;
  for (int i = 0; i < 100; ++i) {
    const double depth = at_root.diagnosis.load.deepest, rate = at_root.diagnosis.load.deepest_rate;
    if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now.time)) break;
    (depth > 0 ? low : high) = length;
    const bool seen = depth > -0.5 * step_.system().body().radius();  // facets far above the ground are not looked at
    const double newton = seen && rate < 0 ? length - depth / rate : low;
    length = newton > low && newton < high ? newton : (low + high) / 2;
    if (!step_.take(now, length, trial_)) break;
    at_root = trial_;
    reached = length;
  }
  return reached;
}

}  // namespace clatter::numeric
