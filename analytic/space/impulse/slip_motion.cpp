// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/slip_motion.hpp"

#include <cmath>
#include <limits>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

namespace {

/// Forecasts of a stop as near to one another, relative to the impulse of the slip, as the error of a step differ by no
/// more than such errors; those of a slip that began at first_slip and is below `little` times that need only say that
/// it dies out.
constexpr double little = 1e6, little_agreement = 1e-6;
/// What goes along with slip that turns less than this before it stops goes straight on.
constexpr double little_turn = 1e-11;
/// A stop forecast within this part of the impulse that is left will come, whatever turn slip takes.
constexpr double sure_stop = 1e-4;
/// A step that may change no more of the slip than this is taken whatever its error: the rate has a kink there.
constexpr double shortest_step = 1e-13;
/// A step that changes no more of the slip than this may pass a jump of the rate.
constexpr double at_once = 1e-10;
/// Slip that has fallen to so many errors of a step, turning or not, has stopped: its direction is rounding;
constexpr double stopped_errors = 25;
/// so has a slip that dies out at this part of the largest.
constexpr double little_stopped_part = 1e-6;

/// Nothing goes along with slip.
bool is_alone(const SlipMotion::Values& rates) { return rates.tail(rates.size() - 3).isZero(0); }

/// Where slip will stop, by its size and growth now and as it was when it was at least twice as large.
struct StopForecast {
  double begin, size_then, agreement, stop_then = -1;
  Eigen::Vector3d direction_then = Eigen::Vector3d::Zero();

  /// Whether slip stops at `stop` and does so before the stage ends.
  /// @param direction  of slip, which must not turn; zero if it may
  bool agrees(double spent, double left, double size, double stop, const Eigen::Vector3d& direction,
              bool is_sure_early) {
    const double rounding = agreement * (stop - begin);
    const bool agree = std::fabs(stop - stop_then) <= rounding && size <= size_then / 2 &&
                       (stop - spent) * (direction - direction_then).norm() <= little_turn * (stop - begin);
    if ((agree && stop - spent < left) || stop - spent <= (is_sure_early ? sure_stop * left : rounding)) return true;
    if (!(size > size_then / 2 && stop_then >= 0)) stop_then = stop, size_then = size, direction_then = direction;
    return false;
  }
};

}  // namespace

SlipMotion::SlipMotion(Eigen::Index size)
    : y_(Values::Zero(size)), size_(static_cast<std::size_t>(size)), system_{derivative, nullptr, size_, this},
      step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size_)) {}

int SlipMotion::derivative(double impulse, const double y[], double change[], void* motion) {
  auto& with = *static_cast<SlipMotion*>(motion);
  const auto size = static_cast<Eigen::Index>(with.size_);
  Eigen::Map<Eigen::VectorXd> rates(change, size);
  rates = with.rate(Eigen::Map<const Eigen::VectorXd>(y, size));
  if (with.holds_direction_) {
    rates.head<3>().setZero();
    if (with.scales_along_) rates.tail(size - 3) *= (with.held_to_ - impulse) / (with.held_to_ - with.held_from_);
  }
  return 0;
}

double SlipMotion::error_along(const Values& next, const Values& error) {
  const Eigen::Index others = error.size() - 3;
  return error.tail(others).lpNorm<1>() / std::fmax(1, next.tail(others).lpNorm<1>());
}

void SlipMotion::go_straight_to(double stop, const Values& now) {
  constexpr double shortest = 1e-3;
  const double whole = stop - spent_;
  double length = whole;
  holds_direction_ = true;
  held_from_ = spent_;
  held_to_ = stop;
  while (!is_alone(now) && spent_ < stop) {
    const bool is_last = length >= stop - spent_;
    const double taken = is_last ? stop - spent_ : length;
    Values next = y_, error = y_;
    gsl_odeiv2_step_apply(step_.get(), spent_, taken, next.data(), error.data(), nullptr, nullptr, &system_);
    if (!(error_along(next, error) <= step_error_) && taken > shortest * whole) {
      length = taken / 2;
      continue;
    }
    y_ = next;
    spent_ = is_last ? stop : spent_ + taken;
  }
  holds_direction_ = false;
  spent_ = stop;
}

SlipMotion::End SlipMotion::slide(bool from_rest) {
  double scale = y_.head<3>().norm(), length = std::numeric_limits<double>::infinity();
  const double most_little = from_rest ? little * scale : 0;
  at_once_ = true;
  Values now = rate(y_);
  StopForecast forecast{.begin = spent_, .size_then = scale, .agreement = little_agreement};
  keep();
  for (int i = 0; i < most_steps_; ++i) {
    if (!now.allFinite()) return End::no_pressure;
    const double left = impulse_left(now);
    if (std::fabs(left) <= 4 * detail::epsilon * spent_) {
      if (end_stage()) return End::impulse_spent;
      length = std::numeric_limits<double>::infinity();
      at_once_ = true;
      now = rate(y_);
      keep();
      continue;
    }
    const double size = y_.head<3>().norm(), growth = y_.head<3>().dot(now.head<3>()) / size;
    scale = std::fmax(scale, size);
    if (scale > most_little) forecast.agreement = step_error_;
    const double stop = spent_ - size / growth;
    const bool is_rounding = size <= (scale > most_little ? stopped_errors * step_error_ : little_stopped_part) * scale;
    const bool alone = is_alone(now);
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    if (!alone) direction = y_.head<3>() / size;
    if (growth < 0 && (is_rounding || forecast.agrees(spent_, left, size, stop, direction, alone && only_friction_))) {
      go_straight_to(stop, now);
      return End::stopped;
    }
    length = std::fmin(length, size / std::fmax(-growth / 0.9, now.head<3>().norm() / 8));
    const double taken = std::fmin(length, left);
    at_once_ = taken * now.head<3>().norm() <= at_once * size;
    Values next = y_, error = y_;
    gsl_odeiv2_step_apply(step_.get(), 0, taken, next.data(), error.data(), now.data(), nullptr, &system_);
    const double wrong = (error.head<3>().norm() / scale + error_along(next, error)) / step_error_;
    const bool is_shortest = std::fabs(taken) * now.head<3>().norm() <= shortest_step * size;
    if (is_shortest && !next.allFinite()) return End::no_pressure;
    if (!(wrong <= 1 || is_shortest)) {
      go_back();
    } else if (const Values then = rate(next); is_shortest || (then.allFinite() && may_step_to(next, then, taken))) {
      y_ = next;
      spent_ += taken;
      now = then;
      keep();
    } else {
      go_back();
      length = taken / 4;
      continue;
    }
    length = std::fabs(taken) * (wrong >= 0 ? std::fmin(std::fmax(0.9 * std::pow(wrong, -0.125), 0.1), 4) : 0.1);
  }
  return End::no_pressure;
}

}  // namespace clatter::analytic::space
