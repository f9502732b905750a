// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/step_events.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

constexpr double resolved_part = 1e-3;  ///< of the tolerance: an event's time over the contact's

struct Depth {
  double value, rate;  ///< [m], [m/s]
};

/// The cubic over a step, 0 at its beginning.
struct StepCubic {
  double slope, end_slope;  ///< rates times the length of the step
  double rise;              ///< value at the end
};

/// Where in the step, from 0 to 1, the cubic has a maximum: p′(s) = slope + 2 b s + 3 a s² falls through 0 there once;
/// 0 where it has none inside.
double place_of_top(const StepCubic& p) {
  if (!(p.slope >= 0) || !(p.end_slope <= 0) || p.slope == p.end_slope) return 0;
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  const double root = std::sqrt(std::max(b * b - 3 * a * p.slope, 0.0));
  const double s = b <= 0 ? p.slope / (root - b) : (-b - root) / (3 * a);
  return s > 0 && s < 1 ? s : 0;
}

/// What the cubic rises to at the part s of the step.
double rise_to(const StepCubic& p, double s) {
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  return s * (p.slope + s * (b + s * a));
}

/// Depth of the deepest vertex; the load looks at no facet above the ground.
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
  const StepCubic cubic{h * now.diagnosis.force_rate, h * next.diagnosis.force_rate,
                        next.diagnosis.load.force - now.diagnosis.load.force};
  const double s = place_of_top(cubic);
  if (s == 0) return nullptr;
  const double top = now.diagnosis.load.force + rise_to(cubic, s);
  if (!(top > 0.9 * force_) || !step_.take(now, s * h, trial_)) return nullptr;
  note(trial_);
  inside_ = trial_;
  const double at_trial = h * trial_.diagnosis.force_rate;
  const double other_s = at_trial > 0 ? 1 : 0, other = at_trial > 0 ? cubic.end_slope : cubic.slope;
  const double better = s - at_trial * (other_s - s) / (other - at_trial);
  if (better > 0 && better < 1 && step_.take(now, better * h, trial_)) note(trial_);
  if (trial_.time == time_) inside_ = trial_;
  return inside_.time == time_ ? &inside_ : nullptr;
}

void DeepestPoint::look(const ContactInstant& now, const ContactInstant& next) {
  const ContactLoad &from = now.diagnosis.load, &to = next.diagnosis.load;
  depth_ = std::max(depth_, to.deepest);
  const double h = next.time - now.time, begin = std::max(from.deepest, 0.0);
  const StepCubic cubic{h * from.deepest_rate, h * to.deepest_rate, to.deepest - begin};
  const double s = place_of_top(cubic);
  if (s == 0 || !(begin + rise_to(cubic, s) > 0.9 * depth_) || !step_.take(now, s * h, trial_)) return;
  const double depth = trial_.diagnosis.load.deepest, slope = h * trial_.diagnosis.load.deepest_rate;
  // The rate falls along the line from here to the end of the step that lies beyond the maximum.
  const double fall = slope > 0 ? (slope - cubic.end_slope) / (1 - s) : (cubic.slope - slope) / s;
  depth_ = std::max(depth_, fall > 0 ? depth + slope * slope / (2 * fall) : depth);
}

}  // namespace clatter::numeric
