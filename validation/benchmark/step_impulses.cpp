// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/step_impulses.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::validation::inline benchmark {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Residuals of the angular momentum, relative to |P| × reach.
constexpr double rounding = 1e-7;       ///< of rows with the digits of a float
constexpr double clearly_one = 5e-3;    ///< a second impulse below this share is left out
constexpr double pose_of_a_step = 0.1;  ///< of codes that strike with a pose of their own
constexpr double together = 1e-6;       ///< heights of points that come down as one, relative to the reach

class Step {
 public:
  Step(const Motion& motion, const Reference& reference, std::size_t row)
      : reference_(reference), start_time_(motion.time(row)), length_(motion.time(row + 1) - start_time_),
        before_(motion.state(row)), after_(motion.state(row + 1)), jump_(motion.jump(row)),
        flight_(reference.flight(before_)), flight_after_(reference.flight(after_)),
        middle_(meeting_time(before_, after_, length_, reference.gravity)), pose_(flight_.at(middle_)),
        scale_(std::fmax(jump_.impulse.norm() * reference.reach(), 1e-300)) {
    for (const space::State* state : {&pose_, &before_, &after_}) arms_.push_back(reference.arms(state->attitude));
    find_candidates();
  }

  [[nodiscard]] std::vector<StepImpulse> impulses() const {
    // The pressure of a compliant contact acts anywhere beside its corner.
    if (reference_.is_compliant && candidates_.size() == 1) return {whole(candidates_)};
    const One one = best_one();
    if (one.residual <= rounding) return {whole({one.point})};
    const Two two = best_two();
    const bool exact = two.is_timed && two.residual <= rounding * 1e-2;
    if (exact || (one.residual > clearly_one && two.residual < 0.3 * one.residual)) return both(two);
    if (one.residual <= pose_of_a_step) return {whole({one.point})};
    if (two.residual <= pose_of_a_step) return both(two);
    return {{.points = {}, .impulse = jump_.impulse, .time = start_time_ + middle_}};
  }

 private:
  struct One {
    int point = -1;
    double residual = std::numeric_limits<double>::infinity();
  };
  struct Two {
    int first = -1, second = -1;
    double share = 0;  ///< λ of the first
    double first_time = 0, second_time = 0;
    bool is_timed = false;  ///< the flights touch and leave the ground within the step, in this order
    double residual = std::numeric_limits<double>::infinity();
  };

  /// Points that can be on the ground within the step.
  void find_candidates() {
    const double speed =
        std::fmax(before_.velocity.norm(), after_.velocity.norm()) +
        reference_.reach() * std::fmax(before_.angular_velocity.norm(), after_.angular_velocity.norm());
    const double margin = reference_.is_compliant ? 0 : 0.02 * reference_.reach() + speed * length_;
    const double heights[]{pose_.position.z(), before_.position.z(), after_.position.z()};
    for (std::size_t k = 0; k < reference_.points.size(); ++k) {
      double lowest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i) lowest = std::fmin(lowest, heights[i] + arms_[i][k].z());
      if (lowest <= margin) candidates_.push_back(static_cast<int>(k));
    }
  }

  [[nodiscard]] One best_one() const {
    One best;
    for (const int k : candidates_) {
      for (const auto& arms : arms_) {
        const double residual = (jump_.moment - arms[static_cast<std::size_t>(k)].cross(jump_.impulse)).norm() / scale_;
        if (residual < best.residual) best = {k, residual};
      }
    }
    return best;
  }

  [[nodiscard]] double height(const space::FreeFlight& flight, int point, double time) const {
    const State state = flight.at(time);
    return state.position.z() + reference_.arms(state.attitude)[static_cast<std::size_t>(point)].z();
  }

  /// When the point is at height 0 on a flight, between two times at which it is above and below; none otherwise.
  [[nodiscard]] double crossing(const space::FreeFlight& flight, int point, double above, double below) const {
    const double slack = 1e-9 * reference_.reach();
    if (!(height(flight, point, above) > -slack && height(flight, point, below) < slack)) return none;
    for (int i = 0; i < 100; ++i) {
      const double middle = (above + below) / 2;
      (height(flight, point, middle) > 0 ? above : below) = middle;
    }
    return (above + below) / 2;
  }

  [[nodiscard]] Two pair(int first, int second) const {
    Two two{.first = first, .second = second, .first_time = middle_, .second_time = middle_};
    const auto k = static_cast<std::size_t>(first), l = static_cast<std::size_t>(second);
    const double touch = crossing(flight_, first, 0, length_);
    const double leave = crossing(flight_after_, second, 0, -length_) + length_;
    std::vector<std::pair<Vector3, Vector3>> arms;
    if (touch <= leave) {
      arms.emplace_back(reference_.arms(flight_.at(touch).attitude)[k],
                        reference_.arms(flight_after_.at(leave - length_).attitude)[l]);
    }
    for (const auto& pose : arms_) arms.emplace_back(pose[k], pose[l]);
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const auto& [a, b] = arms[i];
      const Vector3 turn = (a - b).cross(jump_.impulse), rest = jump_.moment - b.cross(jump_.impulse);
      const double share = turn.dot(rest) / turn.squaredNorm();
      const double residual = (rest - share * turn).norm() / scale_;
      if (!(share > 0 && share < 1 && residual < two.residual)) continue;
      two.share = share;
      two.residual = residual;
      if (i > 0 || !(touch <= leave)) continue;
      two.is_timed = true;
      two.first_time = touch;
      two.second_time = leave;
      if (residual <= rounding) break;  // in the plane other poses can fit as well
    }
    return two;
  }

  [[nodiscard]] static bool is_better(const Two& two, const Two& best) {
    if (two.residual > rounding || best.residual > rounding) return two.residual < best.residual;
    if (two.is_timed != best.is_timed) return two.is_timed;
    return two.is_timed ? two.first_time < best.first_time : two.residual < best.residual;
  }

  [[nodiscard]] Two best_two() const {
    Two best;
    for (const int k : candidates_) {
      for (const int l : candidates_) {
        if (k == l) continue;
        const Two two = pair(k, l);
        // Without times the one that is lower before the step comes first.
        if (!two.is_timed && height_before(k) > height_before(l)) continue;
        if (is_better(two, best)) best = two;
      }
    }
    return best;
  }

  [[nodiscard]] double height_before(int k) const {
    return before_.position.z() + arms_[1][static_cast<std::size_t>(k)].z();
  }
  [[nodiscard]] double height_between(int k) const {
    return pose_.position.z() + arms_[0][static_cast<std::size_t>(k)].z();
  }

  /// Normal velocity of a point.
  [[nodiscard]] double speed_of(const State& state, int point) const {
    const Vector3 arm = reference_.arms(state.attitude)[static_cast<std::size_t>(point)];
    return state.velocity.z() + state.angular_velocity.cross(arm).z();
  }

  [[nodiscard]] StepImpulse whole(const std::vector<int>& points) const {
    const State after = flight_after_.at(middle_ - length_);
    return {.points = points,
            .impulse = jump_.impulse,
            .time = start_time_ + middle_,
            .approach = speed_of(pose_, points.front()),
            .separation = speed_of(after, points.front())};
  }

  [[nodiscard]] std::vector<StepImpulse> both(const Two& two) const {
    const double level = height_between(two.first), slack = together * reference_.reach();
    if (std::fabs(level - height_between(two.second)) <= slack) {
      std::vector<int> group;
      for (const int k : candidates_) {
        if (std::fabs(height_between(k) - level) <= slack) group.push_back(k);
      }
      return {whole(group)};
    }
    const State before = flight_.at(two.first_time);
    const Vector3 first = two.share * jump_.impulse, second = jump_.impulse - first;
    const State after = reference_.struck(before, two.first, first);
    const State then = reference_.flight(after).at(two.second_time - two.first_time);
    return {{.points = {two.first},
             .impulse = first,
             .time = start_time_ + two.first_time,
             .approach = speed_of(before, two.first),
             .separation = speed_of(after, two.first)},
            {.points = {two.second},
             .impulse = second,
             .time = start_time_ + two.second_time,
             .approach = speed_of(then, two.second),
             .separation = speed_of(flight_after_.at(two.second_time - length_), two.second)}};
  }

  const Reference& reference_;
  double start_time_, length_;
  State before_, after_;
  Motion::Jump jump_;
  space::FreeFlight flight_, flight_after_;
  double middle_;
  State pose_;
  double scale_;
  std::vector<std::vector<Vector3>> arms_;  ///< at (1), in the first and in the last row
  std::vector<int> candidates_;
};

}  // namespace

double meeting_time(const space::State& before, const space::State& after, double step, double gravity) {
  const double change = after.velocity.z() - before.velocity.z() + gravity * step;
  if (!(change > 0)) return step / 2;
  const double gap = before.position.z() - after.position.z() + after.velocity.z() * step + gravity * step * step / 2;
  return std::clamp(gap / change, 0.0, step);
}

std::vector<StepImpulse> step_impulses(const Motion& motion, const Reference& reference, std::size_t row) {
  return Step(motion, reference, row).impulses();
}

}  // namespace clatter::validation::inline benchmark
