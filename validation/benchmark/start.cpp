// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "analytic/base/angle.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::space::State;
using analytic::space::Vector3;

/// What differs between two states, in words; the first is the run's, the second asked for.
class Differences {
 public:
  Differences(const Motion& motion, const Reference& reference, const State& asked)
      : motion_(motion), reference_(reference), found_(motion.state(0)), asked_(asked) {
    add("z", found_.position.z(), asked.position.z(), reference.reach(), "m");
    add_attitude();
    if (reference.is_planar) {
      add("vx", found_.velocity.x(), asked.velocity.x(), reference.speed(), "m/s");
      add("vz", found_.velocity.z(), asked.velocity.z(), reference.speed(), "m/s");
      add("omega", 0 - found_.angular_velocity.y(), 0 - asked.angular_velocity.y(),
          reference.speed() / reference.reach(), "rad/s");
      return;
    }
    add_vector("v", found_.velocity, asked.velocity, reference.speed(), "m/s");
    add_vector("w", found_.angular_velocity, asked.angular_velocity, reference.speed() / reference.reach(), "rad/s");
  }

  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }

 private:
  void add(const std::string& name, double found, double asked, double size, const char* unit) {
    if (std::fabs(found - asked) <= reference_.tolerances[1] * size) return;
    words_.push_back(fmt::format("{0} is {1:.6g} {3}, must be {2:.6g} {3}", name, found, asked, unit));
  }

  void add_vector(const std::string& name, const Vector3& found, const Vector3& asked, double size, const char* unit) {
    for (int i = 0; i < 3; ++i) add(name + "xyz"[i], found[i], asked[i], size, unit);
  }

  void add_attitude() {
    const double turned = 2 * (found_.attitude.conjugate() * asked_.attitude).vec().norm();
    if (turned <= reference_.tolerances[1]) return;
    if (reference_.is_planar && motion_.table().column("phi")) {
      const double phi = motion_.table().at(0, motion_.table().column("phi").value());  // with its whole turns
      words_.push_back(fmt::format("phi is {:.6g} rad, must be {:.6g} rad", phi, inclination_of(asked_)));
      return;
    }
    words_.push_back(
        fmt::format("the attitude is turned by {}°", significant(turned * analytic::degrees_per_radian, 3)));
  }

  const Motion& motion_;
  const Reference& reference_;
  State found_;
  const State& asked_;
  std::vector<std::string> words_;
};

}  // namespace

double inclination_of(const State& state) { return 2 * std::atan2(-state.attitude.y(), state.attitude.w()); }

State asked_at_height(const Reference& reference, double height) {
  const double above = height - reference.start.position.z(), speed = -reference.start.velocity.z();
  const double square = speed * speed - 2 * reference.gravity * above;
  return reference.flight(reference.start).at(-2 * above / (speed + std::sqrt(std::fmax(square, 0))));
}

std::string start_differences(const Motion& motion, const Reference& reference) {
  if (motion.begins_after_touch()) return "";
  std::vector<State> asked;
  for (const double gap : reference.gaps) asked.push_back(reference.release(gap).state);
  asked.push_back(asked_at_height(reference, motion.state(0).position.z()));
  std::vector<std::string> fewest = Differences(motion, reference, asked.front()).words();
  for (const State& one : asked) {
    const Differences differences(motion, reference, one);
    if (differences.words().size() < fewest.size()) fewest = differences.words();
  }
  return fmt::format("{}", fmt::join(fewest, "; "));
}

}  // namespace clatter::validation
