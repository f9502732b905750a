// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/force_peak.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::numeric {

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

}  // namespace clatter::numeric
