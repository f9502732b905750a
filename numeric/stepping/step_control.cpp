// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/step_control.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace clatter::numeric {
namespace {

constexpr double adaptive_first_steps = 20;  ///< first step: this part of the expected contact time
constexpr double largest_part = 0.2;         ///< of that time, or of the time so far, that a step may cover
constexpr double smallest_part = 1e-13;
constexpr double fewest_steps = 4;           ///< of fixed length, in the expected contact time
constexpr double least_over_touches = 1e-9;  ///< of that time: steps this short may step over a touch

}  // namespace

void StepControl::begin(const StepSettings& settings, const ContactScales& scales, long evaluation_limit) {
  assert(scales.depth >= 0 && scales.speed >= 0 && scales.time >= 0);  // each may underflow
  settings_ = settings;
  scales_ = scales;
  evaluation_limit_ = evaluation_limit;
  weigh_errors();
  if (step_.error_order() > 0) {
    fixed_ = 0;
    next_ = settings.step_cap * scales.time / adaptive_first_steps;
  } else {
    fixed_ = settings.step > 0 ? std::min(settings.step, scales.time / fewest_steps)
                               : scales.time / settings.steps_per_contact;
    next_ = settings.first_step > 0 ? std::min(settings.first_step, fixed_) : fixed_;
  }
}

void StepControl::weigh_errors() {
  const double radius = step_.system().body().radius();
  displacement(weights_).setConstant(scales_.depth);
  euler_parameters(weights_).setConstant(scales_.depth / radius);
  velocity(weights_).setConstant(scales_.speed);
  angular_velocity(weights_).setConstant(scales_.speed / radius);
  works(weights_).setConstant(scales_.energy);
  weights_ *= settings_.tolerance;
}

double StepControl::error() const { return (step_.error().cwiseAbs().cwiseQuotient(weights_)).maxCoeff(); }

/// A contact shorter than the step, or the gap between two, must not be stepped over.
bool StepControl::stepped_over(const ContactInstant& now, const TouchCounter& touches,
                               const ContactInstant& trial) const {
  const bool shorter = now.time == 0 && !(trial.diagnosis.load.deepest > 0);
  return shorter || touches.all_new(step_.submerged());
}

std::optional<ContactEnding> StepControl::find(const ContactInstant& now, const TouchCounter& touches,
                                               ContactInstant& trial) {
  const int order = step_.error_order();
  const double horizon = std::max(scales_.time, now.time);
  double h = order > 0 ? std::min(next_, settings_.step_cap * largest_part * horizon) : next_;
  bool is_number = true;  // of the last trial
  for (;;) {
    if (step_.system().evaluations() >= evaluation_limit_) return ContactEnding::evaluation_limit;
    if (!(h > smallest_part * horizon)) {
      return is_number ? ContactEnding::step_too_small : ContactEnding::not_representable;
    }
    is_number = step_.take(now, h, trial);
    if (!is_number) {
      h /= 8;
      continue;
    }
    const double error = order > 0 ? this->error() : 0;
    const double growth = order > 0 ? 0.9 * std::pow(error, -1.0 / order) : 1;
    if (!(error <= 1)) {
      h *= std::clamp(growth, 0.1, 0.7);
    } else if (stepped_over(now, touches, trial) && h > least_over_touches * scales_.time) {
      h /= 2;
    } else {
      assert(trial.time > now.time);
      taken_ = h;
      next_ = order > 0 ? h * std::clamp(growth, 0.2, 4.0) : fixed_;
      return std::nullopt;
    }
  }
}

}  // namespace clatter::numeric
