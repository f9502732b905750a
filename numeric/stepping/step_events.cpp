// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/step_events.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric::inline stepping {
namespace {

constexpr double resolved_part = 1e-3;  ///< of the tolerance: an event's time over the contact's

struct Depth {
  double value, rate;  ///< [m], [m/s]
};

/// Of the deepest vertex; the load looks at no facet above the ground.
Depth deepest_point(const ContactSystem& system, const ContactInstant& at) {
  const ContactLoad& load = at.diagnosis.load;
  if (load.deepest > 0) return {load.deepest, load.deepest_rate};
  const MotionState motion = system.motion(at.state);
  const Vector3 lowest = lowest_vertex(system.body(), motion);
  return {-system.height(lowest, at.state), -point_velocity(motion, lowest).z()};
}

}  // namespace

double EventLocator::fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now,
                          double h, ContactInstant& at_root) {
  const double at_start = indicator(now), at_end = indicator(at_root);
  if (!(at_start > 0 && at_end <= 0)) return h;
  double shortest = h;  // with the indicator at or below 0; at_root has its end
  const auto value = [&](double length) {
    if (length <= 0) return at_start;
    if (!step_.take(now, length, trial_)) return at_end;
    const double found = indicator(trial_);
    if (found <= 0 && length < shortest) {
      shortest = length;
      at_root = trial_;
    }
    return std::isfinite(found) ? found : at_end;
  };
  const double resolution = std::max(1e-14, resolved_part * tolerance_) * (scales_.time + now.time);
  std::uintmax_t iterations = 50;
  const double high =
      boost::math::tools::toms748_solve(
          value, 0.0, h, at_start, at_end, [&](double a, double b) { return b - a <= resolution; }, iterations)
          .second;
  assert(high > 0 && high <= h);
  if (high == shortest || !step_.take(now, high, trial_)) return shortest;
  at_root = trial_;
  return high;
}

double EventLocator::fade(double low, double high, const ContactInstant& now, double h, ContactInstant& at_end) {
  ContactInstant strong = now;
  double end = h;  // where the force is below `low`
  const double aim = std::sqrt(low * high);
  for (int i = 0; i < 100 && strong.diagnosis.load.force > high; ++i) {
    const double begin = strong.time - now.time, rate = strong.diagnosis.force_rate;
    const double newton = rate < 0 ? begin - (strong.diagnosis.load.force - aim) / rate : begin;
    const double length = newton > begin && newton < end ? newton : (begin + end) / 2;
    if (!(length > begin && length < end) || !step_.take(now, length, trial_)) break;
    if (trial_.diagnosis.load.force > low) {
      strong = trial_;
    } else {
      end = length;
    }
  }
  if (!(strong.time > now.time)) return h;
  at_end = strong;
  return strong.time - now.time;
}

double EventLocator::lift_off(const ContactInstant& now, double h, ContactInstant& at_root) {
  const double resolution = 1e-13 * scales_.depth;
  double low = 0, high = h, length = h, reached = h;
  for (int i = 0; i < 100; ++i) {
    const auto [depth, rate] = deepest_point(step_.system(), at_root);
    if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now.time)) break;
    (depth > 0 ? low : high) = length;
    const double newton = rate < 0 ? length - depth / rate : low;
    length = newton > low && newton < high ? newton : (low + high) / 2;
    if (!step_.take(now, length, trial_)) break;
    at_root = trial_;
    reached = length;
  }
  return reached;
}

void ForcePeak::note(const ContactInstant& at) {
  if (!(at.diagnosis.load.force > force_)) return;
  force_ = at.diagnosis.load.force;
  time_ = at.time;
}

const ContactInstant* ForcePeak::look(const ContactInstant& now, const ContactInstant& next) {
  note(next);
  const double h = next.time - now.time;
  const double slope = h * now.diagnosis.force_rate, end_slope = h * next.diagnosis.force_rate;
  if (!(slope >= 0) || !(end_slope <= 0) || slope == end_slope) return nullptr;
  const double rise = next.diagnosis.load.force - now.diagnosis.load.force;
  // p′(s) = slope + 2 b s + 3 a s², which falls through 0 once in (0, 1].
  const double a = slope + end_slope - 2 * rise, b = 3 * rise - 2 * slope - end_slope;
  const double root = std::sqrt(std::max(b * b - 3 * a * slope, 0.0));
  const double s = b <= 0 ? slope / (root - b) : (-b - root) / (3 * a);
  if (!(s > 0 && s < 1)) return nullptr;
  const double top = now.diagnosis.load.force + s * (slope + s * (b + s * a));
  if (!(top > 0.9 * force_) || !step_.take(now, s * h, trial_)) return nullptr;
  note(trial_);
  inside_ = trial_;
  const double at_trial = h * trial_.diagnosis.force_rate;
  const double other_s = at_trial > 0 ? 1 : 0, other = at_trial > 0 ? end_slope : slope;
  const double better = s - at_trial * (other_s - s) / (other - at_trial);
  if (better > 0 && better < 1 && step_.take(now, better * h, trial_)) note(trial_);
  if (trial_.time == time_) inside_ = trial_;
  return inside_.time == time_ ? &inside_ : nullptr;
}

}  // namespace clatter::numeric::inline stepping
