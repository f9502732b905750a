// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analytic/base/angle.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::space::Vector3;

constexpr double share_of_steps = 0.75;  ///< of the steps, that a force in flight explains
constexpr std::size_t looked_at = 2000;  ///< of a long run as many are enough
constexpr std::size_t least_count = 4;   ///< of steps
constexpr double least_size = 1e-3;      ///< of the speed: slower steps say nothing of damping

/// A rate, the share of the total effect that it leaves in the median, and how many steps it explains.
struct Rate {
  double value = 0, misfit = 0;
  std::size_t steps = 0;

  /// Whether it explains as many steps as another to the last digits, or clearly more of them about as well.
  [[nodiscard]] bool explains_all_of(const Rate& other) const {
    constexpr double last_digits = 1e-9, clearly_more = 1.05, about_as_well = 3;
    if (misfit <= last_digits) return steps >= other.steps;
    return static_cast<double>(steps) > clearly_more * static_cast<double>(other.steps) &&
           misfit <= about_as_well * other.misfit;
  }
};

/// One number of (1) or (2) from all steps: its value in each step, and what a value leaves of the step's change.
class Steps {
 public:
  [[nodiscard]] std::size_t count() const { return steps_.size(); }

  /// The step's change is −rate × weight.
  void add(const Vector3& change, const Vector3& weight) { steps_.push_back({change, weight}); }

  /// Nothing where no rate other than `asked` explains the steps.  A step is explained if it is left with a
  /// twentieth of what the difference of the rates does in it.
  [[nodiscard]] std::optional<Rate> rate(double asked) const {
    if (steps_.size() < least_count) return std::nullopt;
    std::vector<double> rates, left;
    for (const auto& [change, weight] : steps_) rates.push_back(-change.dot(weight) / weight.squaredNorm());
    const double value = upper_median(rates);
    std::size_t explained_steps = 0;
    for (const auto& [change, weight] : steps_) {
      const double share = (change + value * weight).norm() / (std::fabs(value - asked) * weight.norm());
      explained_steps += share <= explained ? 1 : 0;
      left.push_back(share);
    }
    if (!(static_cast<double>(explained_steps) >= share_of_steps * static_cast<double>(steps_.size()))) return {};
    return Rate{value, upper_median(left), explained_steps};
  }

 private:
  struct One {
    Vector3 change, weight;
  };
  std::vector<One> steps_;
};

std::string rate_words(const char* what, double rate) {
  return fmt::format("{} {} by {} per second", what, rate < 0 ? "grows" : "shrinks", significant(std::fabs(rate), 3));
}

/// Rates below which the run is not changed beyond the class "sharp".
bool matters(const std::optional<Rate>& rate, double least) { return rate && std::fabs(rate->value) > least; }

std::vector<Cause> damping_causes(const std::optional<Rate>& linear, const std::optional<Rate>& angular, bool spins,
                                  double least) {
  const bool has_linear = matters(linear, least), has_angular = matters(angular, least);
  if (!has_linear && !has_angular) return {};
  const Rate& rate = has_linear ? *linear : *angular;
  const double misfit = std::fmax(has_linear ? linear->misfit : 0, has_angular ? angular->misfit : 0);
  const bool of_all = has_linear && (has_angular || !spins);
  std::string words = has_linear ? rate_words("the velocity", linear->value) : "";
  if (has_angular) words += (words.empty() ? "" : ", ") + rate_words("the spin", angular->value);
  return {{rate.value < 0 ? "growth"
           : of_all       ? "damping"
           : has_linear   ? "linear-damping"
                          : "spin-damping",
           rate.value, misfit, fmt::format("{}: that explains the flights {}", words, misfit_words(misfit))}};
}

/// On sloping ground gravity in another direction than the asked one, `pull`.
std::optional<Cause> slope_cause(const std::vector<Vector3>& accelerations, const Vector3& pull) {
  if (pull.x() == 0 || accelerations.size() < least_count) return {};
  Vector3 found;
  for (int i = 0; i < 3; ++i) {
    std::vector<double> parts;
    for (const Vector3& one : accelerations) parts.push_back(one[i]);
    found[i] = upper_median(std::move(parts));
  }
  const double change = (found - pull).norm();
  std::vector<double> left;
  for (const Vector3& one : accelerations) left.push_back((one - found).norm() / change);
  const auto explains = [](double share) { return share <= explained; };
  const auto count = static_cast<double>(std::count_if(left.begin(), left.end(), explains));
  if (!(change > least_size * pull.norm()) || !(count >= share_of_steps * static_cast<double>(left.size()))) return {};
  const auto angle = [](const Vector3& g) { return std::atan2(g.x(), -g.z()) * analytic::degrees_per_radian; };
  const double misfit = upper_median(std::move(left));
  return Cause{"slope", angle(found), misfit,
               fmt::format("gravity {}° from the ground's normal ({}° is asked) explains the flights {}",
                           significant(angle(found), 3), significant(angle(pull), 3), misfit_words(misfit))};
}

/// An angular velocity that stays as it is, where Euler's equations change it.
class ConstantSpin {
 public:
  void add(const Vector3& change, const Vector3& asked) {
    if (!(asked.norm() > 0)) return;
    ++count_;
    if (change.norm() <= explained * asked.norm()) ++constant_;
    left_ += change.norm() / asked.norm();
  }

  void tell(double change, const Reference& reference, std::vector<Cause>& causes) const {
    if (count_ < least_count || !(change * reference.reach() > reference.tolerances[1] * reference.speed())) return;
    if (!(static_cast<double>(constant_) >= share_of_steps * static_cast<double>(count_))) return;
    causes.push_back({"gyroscopic-term",
                      {},
                      left_ / static_cast<double>(count_),
                      "the angular velocity stays constant in flight: the gyroscopic term is missing"});
  }

 private:
  std::size_t count_ = 0, constant_ = 0;
  double left_ = 0;
};

/// Whether the body lies, rocks or slides on the ground in a row.
bool is_on_ground(const analytic::space::State& state, const Reference& reference) {
  constexpr double on_ground = 1e-3;  // of the reach
  return std::fabs(reference.height(state, reference.lowest(state.attitude))) <= on_ground * reference.reach();
}

/// What the steps between a run's rows say of (2).
struct FlightSteps {
  Steps fall, linear, angular;
  ConstantSpin constant;
  double precession = 0;  ///< change of the angular velocity that Euler's equations ask for [rad/s]
  std::vector<Vector3> accelerations;

  FlightSteps(const Motion& motion, const Reference& reference) {
    const double until = reference.stays() ? motion.first_touch() + reference.sequences.front().truth.back().time : 0;
    for (std::size_t row = 0; row + 1 < motion.size(); row += 1 + motion.size() / looked_at) {
      if (reference.stays() && motion.time(row) > until) break;
      add(motion, reference, row);
    }
  }

 private:
  void add(const Motion& motion, const Reference& reference, std::size_t row) {
    const double time = motion.time(row + 1) - motion.time(row), slow = least_size * reference.speed();
    const auto from = motion.state(row), to = motion.state(row + 1);
    if (is_on_ground(from, reference) && is_on_ground(to, reference)) return;
    // Where no gravity is asked for, another one is still towards the ground.
    const Vector3 pull = reference.pull(), down = pull.norm() > 0 ? pull.normalized() : Vector3(0, 0, -1);
    fall.add(to.velocity - from.velocity, -time * down);
    accelerations.emplace_back((to.velocity - from.velocity) / time);
    const auto [impulse, moment] = motion.jump(row);
    const Vector3 mean = (from.velocity + to.velocity) / 2, spin = (from.angular_velocity + to.angular_velocity) / 2;
    if (mean.norm() > slow) linear.add(impulse / reference.body.mass, time * mean);
    if (!(spin.norm() * reference.reach() > slow)) return;
    const Vector3 turned = from.attitude.conjugate() * from.angular_velocity;
    const Vector3 momentum = from.attitude * (reference.body.inertia * turned) + moment / 2;
    angular.add(moment, time * momentum);
    if (reference.is_planar) return;
    const Vector3 asked = reference.flight(from).at(time).angular_velocity - from.angular_velocity;
    constant.add(to.angular_velocity - from.angular_velocity, asked);
    precession += asked.norm();
  }
};

/// Calls with what a step changes and what the mean rate by which it should asks for, in all steps that are not slow.
void each_step(const Motion& motion, const Reference& reference, auto&& change, auto&& call) {
  for (std::size_t row = 0; row + 1 < motion.size(); row += 1 + motion.size() / looked_at) {
    const std::pair<Vector3, Vector3> one = change(motion.state(row), motion.state(row + 1));
    const Vector3 asked = (motion.time(row + 1) - motion.time(row)) * one.second;
    if (one.second.norm() > least_size * reference.speed()) call(one.first, asked);
  }
}

std::pair<Vector3, Vector3> way_and_velocity(const analytic::space::State& from, const analytic::space::State& to) {
  return {to.position - from.position, (from.velocity + to.velocity) / 2};
}

/// Whether most steps change what they should, but for what coarse steps leave.
bool agrees(const Motion& motion, const Reference& reference, auto&& change) {
  constexpr double about = 0.1;
  std::size_t count = 0, right = 0;
  each_step(motion, reference, change, [&](const Vector3& way, const Vector3& asked) {
    ++count;
    right += (way - asked).norm() <= about * asked.norm() ? 1 : 0;
  });
  return count < least_count || 2 * right > count;
}

}  // namespace

std::optional<Cause> velocity_scale_of(const Motion& motion, const Reference& reference) {
  constexpr double least_lag = 1e-2;  // less is what the steps of a code may leave
  Steps lags;
  each_step(motion, reference, way_and_velocity,
            [&](const Vector3& way, const Vector3& asked) { lags.add(way - asked, asked); });
  const std::optional<Rate> lag = lags.rate(0);
  if (!matters(lag, least_lag)) return {};
  const double factor = 1 / (1 - lag->value);
  return Cause{"velocity-scale", factor, lag->misfit,
               fmt::format("velocities {} times those with which the places change explain the flights {}",
                           significant(factor, 4), misfit_words(lag->misfit))};
}

bool moves_freely(const Motion& motion, const Reference& reference) {
  const auto turned = [&](const analytic::space::State& from, const analytic::space::State& to) {
    const Vector3 half = (to.attitude * from.attitude.conjugate()).vec();
    const double sign = (to.attitude * from.attitude.conjugate()).w() < 0 ? -1 : 1;
    const Vector3 mean = (from.angular_velocity + to.angular_velocity) / 2;
    return std::pair<Vector3, Vector3>{2 * sign * reference.reach() * half, reference.reach() * mean};
  };
  const auto fallen = [&](const analytic::space::State& from, const analytic::space::State& to) {
    const bool flies = !is_on_ground(from, reference) || !is_on_ground(to, reference);
    return std::pair<Vector3, Vector3>{to.velocity - from.velocity, flies ? reference.pull() : Vector3(0, 0, 0)};
  };
  return agrees(motion, reference, way_and_velocity) && agrees(motion, reference, turned) &&
         agrees(motion, reference, fallen);
}

std::vector<Cause> flight_causes_of(const Motion& motion, const Reference& reference) {
  FlightSteps steps(motion, reference);
  const double length = motion.time(motion.size() - 1) - motion.time(0), least = reference.tolerances[1] / length;
  const Vector3 pull = reference.pull();
  const std::optional<Rate> gravity = steps.fall.rate(pull.norm());
  std::optional<Rate> linear = steps.linear.rate(0);
  // In one long flight straight down another gravity looks like velocities that grow or shrink.
  if (gravity && linear && gravity->explains_all_of(*linear)) linear.reset();
  std::vector<Cause> causes =
      damping_causes(linear, steps.angular.rate(0), steps.angular.count() >= least_count, least);
  steps.constant.tell(steps.precession, reference, causes);
  if (gravity && std::fabs(gravity->value - pull.norm()) > least * reference.speed()) {
    causes.push_back(
        {"gravity", gravity->value, gravity->misfit,
         fmt::format("gravity {} m/s² ({} is asked) explains the flights {}", significant(gravity->value, 3),
                     significant(pull.norm(), 4), misfit_words(gravity->misfit))});
  } else if (auto slope = slope_cause(steps.accelerations, pull)) {
    causes.push_back(std::move(*slope));
  }
  return causes;
}

std::optional<FirstOrder> first_order_step_of(const Motion& motion, const Reference& reference,
                                              const ReferenceSequence& sequence,
                                              const std::vector<FoundImpact>& impacts, double flight_error) {
  const double step = motion.step();
  const Vector3 creep = step / 2 * reference.pull();  // (3)
  if (!(flight_error > reference.tolerances[1])) return {};
  std::vector<Flying> ways{{.creep = creep}, {.creep = -creep}};
  if (!(creep.norm() > 0)) ways.clear();
  if (!reference.is_planar) {
    for (const double sign : {1, -1, 0}) {
      for (const Turning turning : {Turning::by_new, Turning::by_old, Turning::by_momentum}) {
        for (const bool is_on_sphere : {true, false})
          ways.push_back({.creep = sign * creep, .turning = turning, .step = step, .is_on_sphere = is_on_sphere});
      }
    }
  }
  const Flying* way = nullptr;
  double left = explained * flight_error;
  for (const Flying& one : ways) {
    constexpr double last_digits = 1e-9;  // below it a free turn comes first
    const double misfit = flight_error_with(one, motion, reference, sequence, impacts);
    if (!(misfit <= left) || (way != nullptr && left <= last_digits)) continue;
    way = &one, left = misfit;
  }
  if (way == nullptr) return {};
  std::string words;
  if (way->creep.norm() > 0) {
    const bool is_ahead = way->creep.dot(creep) > 0;
    words =
        fmt::format("places fall g·step/2 = {} m/s {} than free flight, as by {} Euler", significant(creep.norm(), 3),
                    is_ahead ? "faster" : "slower", is_ahead ? "semi-implicit" : "explicit");
  }
  if (way->turning != Turning::free)
    words += (words.empty() ? "" : ", and ") + std::string("the body turns by Euler's method");
  return FirstOrder{
      *way,
      {"first-order-step", step, left,
       fmt::format("the flights are a first-order step's: {} in steps of {} s; without that they are free {}", words,
                   significant(step, 3), misfit_words(left))}};
}

}  // namespace clatter::validation
