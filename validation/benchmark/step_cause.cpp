// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <exception>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

/// A code that starts as a run does and follows the law.
class Replay {
 public:
  Replay(const Motion& motion, const Reference& reference, const DeclaredLaw& law, const Stepping& stepping)
      : motion_(motion), reference_(reference), law_(law), stepping_(stepping), state_(motion.state(0)),
        time_(motion.time(0) - motion.first_touch()) {}

  std::vector<FoundImpact> run(std::size_t most) {
    constexpr int longest = 100'000;
    const double end = motion_.time(motion_.size() - 1) - motion_.first_touch();
    for (int i = 0; i < longest && time_ <= end && impacts_.size() < most; ++i) {
      if (stepping_.step > 0) {
        strike();
        move(stepping_.step);
        continue;
      }
      State ahead = state_;
      ahead.velocity += stepping_.creep;  // the flight's places
      move(touch_time(reference_, reference_.flight(ahead)));
      if (time_ <= end) strike();
    }
    return std::move(impacts_);
  }

 private:
  void move(double time) {
    state_ = reference_.flight(state_).at(time);
    state_.position += time * stepping_.creep;
    time_ += time;
  }

  /// Strikes what is on the ground or in it and goes down, level points as one.
  void strike() {
    const Vector3 fall = stepping_.gravity_first ? stepping_.step * reference_.pull() : Vector3(0, 0, 0);
    const double close = 1e-9 * reference_.reach();
    const std::vector<Vector3> arms = reference_.arms(state_.attitude);
    const auto height = [&](int k) { return state_.position.z() + arms[static_cast<std::size_t>(k)].z(); };
    std::vector<int> low;
    for (int k = 0; k < static_cast<int>(arms.size()); ++k) {
      if (height(k) <= close) low.push_back(k);
    }
    if (!stepping_.as_listed) std::ranges::sort(low, {}, height);
    state_.velocity += fall;
    std::size_t noted = impacts_.size();
    for (std::size_t i = 0; i < low.size();) {
      std::vector<int> level;
      for (const double least = height(low[i]); i < low.size() && std::fabs(height(low[i]) - least) <= close; ++i) {
        const Vector3& arm = arms[static_cast<std::size_t>(low[i])];
        if ((state_.velocity + state_.angular_velocity.cross(arm)).z() < 0) level.push_back(low[i]);
      }
      if (!level.empty()) note(level);
    }
    state_.velocity -= fall;
    for (; noted < impacts_.size(); ++noted) {  // what its instant has is the flight's velocity
      impacts_[noted].before.velocity -= fall;
      impacts_[noted].after.velocity -= fall;
    }
  }

  void note(std::vector<int> points) {
    std::ranges::sort(points);
    const State before = state_;
    state_ = exact_map(reference_, law_, before, points);
    impacts_.push_back({.points = points,
                        .place = reference_.place_name(points),
                        .time = time_,
                        .impulse = reference_.body.mass * (state_.velocity - before.velocity),
                        .before = before,
                        .after = state_,
                        .bookings = {{before, state_}}});
  }

  const Motion& motion_;
  const Reference& reference_;
  const DeclaredLaw& law_;
  const Stepping stepping_;
  State state_;
  double time_;  ///< since the run's first touch [s]
  std::vector<FoundImpact> impacts_;
};

}  // namespace

std::vector<FoundImpact> replayed(const Motion& motion, const Reference& reference, const DeclaredLaw& law,
                                  const Stepping& stepping, std::size_t most) {
  try {
    return Replay(motion, reference, law, stepping).run(most);
  } catch (const std::exception&) {
    return {};  // the law has no answer on the way
  }
}

double replay_distance(const Reference& reference, const std::vector<FoundImpact>& replay,
                       const std::vector<FoundImpact>& impacts) {
  if (impacts.empty() || replay.size() < impacts.size()) return Score::unknown;
  double distance = 0;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const State &a = replay[i].after, &b = impacts[i].after;
    if (replay[i].place != impacts[i].place) return Score::unknown;
    const Vector3 fall = (replay[i].time - impacts[i].time) * reference.pull();  // that of b at the time of a
    distance = worse(distance, (a.velocity - b.velocity - fall).norm() / reference.speed());
    distance =
        worse(distance, reference.reach() * (a.angular_velocity - b.angular_velocity).norm() / reference.speed());
  }
  return distance;
}

}  // namespace clatter::validation
