// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analytic/base/angle.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::Vector3;

const std::vector<std::string> in_plane{"t", "x", "z", "phi", "vx", "vz", "omega"};
const std::vector<std::string> in_three{"t", "x", "y", "z", "q0", "q1", "q2", "q3", "vx", "vy", "vz", "wx", "wy", "wz"};

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

double touch_time(const Reference& reference, const space::FreeFlight& flight) {
  const double fastest = flight.rotation().fastest();
  const double bound = reference.gravity + 2 * reference.reach() * fastest * fastest + 1e-300;
  const double resolution = 1e-15 * reference.reach();
  double time = 0;
  for (int i = 0; i < 10000; ++i) {
    const space::State state = flight.at(time);
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& arm : reference.arms(state.attitude)) {
      const double height = state.position.z() + arm.z();
      const double speed = state.velocity.z() + state.angular_velocity.cross(arm).z();
      if (height <= resolution) {
        if (speed < 0) return time - height / speed;
        least = std::fmin(least, std::fmax(speed / bound, 1e-9));
      } else {
        const double root = std::sqrt(speed * speed + 2 * bound * height);
        // This is the one of the two forms that does not cancel.
        least = std::fmin(least, speed < 0 ? 2 * height / (root - speed) : (speed + root) / bound);
      }
    }
    if (!(least > 1e-15 * (time + reference.reach() / reference.speed()))) return time + least;
    time += least;
  }
  return time;
}

std::string place_of(const NumericTable& table, const std::string& key) {
  for (const NumericTable::Comment& one : table.comments()) {
    if (one.key == key) return fmt::format("{}:{}:1: {}", table.path(), one.line, key);
  }
  return table.path() + ": " + key;
}

std::optional<double> stated_step(const NumericTable& table) {
  const auto given = table.comment("step");
  if (!given) return std::nullopt;
  std::string text = *given;
  if (text.ends_with("s")) text = trimmed(std::string_view(text).substr(0, text.size() - 1));
  const std::size_t slash = text.find('/');
  double value = 0, divisor = 1;
  const bool is_number =
      read_number(trimmed(std::string_view(text).substr(0, slash)), value) &&
      (slash == std::string::npos || read_number(trimmed(std::string_view(text).substr(slash + 1)), divisor));
  if (!is_number || !(value / divisor > 0 && std::isfinite(value / divisor))) {
    throw BadInput(fmt::format("{} = {}: must be a number of seconds above 0, or 1/N", place_of(table, "step"),
                               shown_field(*given)));
  }
  return value / divisor;
}

bool Motion::is_in_space(const std::vector<std::string>& header, const ColumnNames& names) {
  const auto has = [&](const std::string& name) {
    return std::find(header.begin(), header.end(), name) != header.end();
  };
  return names.contains("q0") || has("q0");
}

TableRequest Motion::request(bool in_space, const ColumnNames& names) {
  std::vector<std::string> depth;  // where y is the height in a plane of x and y
  for (const std::string name : {"y", "vy"}) {
    const auto is_it = [&](const auto& given) { return given.second == name; };
    if (!in_space && std::ranges::none_of(names, is_it)) depth.push_back(name);
  }
  return {.required = in_space ? in_three : in_plane, .optional = depth, .words = {}, .names = names};
}

Motion::Motion(NumericTable table, const Reference& reference) : table_(std::move(table)), reference_(reference) {
  in_space_ = table_.column("q0").has_value();
  if (!in_space_ && !reference.is_planar)
    throw BadInput(table_.path() + ": the body moves in space; the file needs t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz");
  for (const std::string& name : in_space_ ? in_three : in_plane) column_.push_back(table_.column(name).value());
  check_rows();
  for (std::size_t row = 0; in_space_ && row < table_.rows(); ++row) momenta_.push_back(angular_momentum(row));
  find_first_touch();
  const double distance = median_step(), stated = stated_step(table_).value_or(distance);
  step_ = stated > 1.01 * distance ? distance : stated;
}

double Motion::median_step() const {
  std::vector<double> steps;
  for (std::size_t row = 0; row + 1 < table_.rows(); ++row)
    steps.push_back(table_.at(row + 1, column_[0]) - table_.at(row, column_[0]));
  return upper_median(std::move(steps));
}

void Motion::check_rows() const {
  if (table_.rows() < 2) table_.refuse(0, "t", "followed by more rows: one row is no motion");
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    if (i > 0 && !(number(i, 0) > number(i - 1, 0))) table_.refuse(i, "t", "later than in the row before");
    if (!in_space_) continue;
    double square = 0;
    for (std::size_t k = 4; k < 8; ++k) square += number(i, k) * number(i, k);
    if (!(std::fabs(square - 1) < 0.02)) table_.refuse(i, "q0", "with q1, q2 and q3 of length 1 to within 0.01");
  }
}

double Motion::time(std::size_t row) const { return lead_ && row == 0 ? number(1, 0) : number(row, 0); }

space::State Motion::state(std::size_t row) const {
  if (lead_ && row == 0) return *lead_;
  const auto vector = [&](std::size_t k) { return Vector3(number(row, k), number(row, k + 1), number(row, k + 2)); };
  const Vector3 origin(origin_, 0, 0);
  if (in_space_) {
    return {.position = vector(1) - origin,
            .attitude = space::Quaternion(number(row, 4), number(row, 5), number(row, 6), number(row, 7)).normalized(),
            .velocity = vector(8),
            .angular_velocity = vector(11)};
  }
  const double half = number(row, 3) / 2;
  return {.position = Vector3(number(row, 1), 0, number(row, 2)) - origin,
          .attitude = space::Quaternion(std::cos(half), 0, -std::sin(half), 0),
          .velocity = {number(row, 4), 0, number(row, 5)},
          .angular_velocity = {0, -number(row, 6), 0}};
}

double Motion::energy(std::size_t row) const {
  if (lead_) return reference_.energy(state(row));
  if (in_space_) {
    const Vector3 velocity(number(row, 8), number(row, 9), number(row, 10));
    const Vector3 rate(number(row, 11), number(row, 12), number(row, 13));
    return (reference_.body.mass * velocity.squaredNorm() + rate.dot(momenta_[row])) / 2 +
           reference_.potential(number(row, 1) - origin_, number(row, 3));
  }
  const double vx = number(row, 4), vz = number(row, 5), omega = number(row, 6);
  return (reference_.body.mass * (vx * vx + vz * vz) + reference_.body.inertia(1, 1) * omega * omega) / 2 +
         reference_.potential(number(row, 1) - origin_, number(row, 2));
}

Vector3 Motion::angular_momentum(std::size_t row) const {
  const space::State now = state(row);
  return now.attitude * (reference_.body.inertia * (now.attitude.conjugate() * now.angular_velocity));
}

Motion::Jump Motion::jump(std::size_t row) const {
  const double mass = reference_.body.mass;
  const Vector3 fall = (time(row + 1) - time(row)) * reference_.pull();
  if (in_space_ || (lead_ && row == 0)) {
    const auto velocity = [&](std::size_t i) {
      return in_space_ && !lead_ ? Vector3(number(i, 8), number(i, 9), number(i, 10)) : state(i).velocity;
    };
    const Vector3 change = velocity(row + 1) - velocity(row);
    const auto momentum = [&](std::size_t i) { return in_space_ && !lead_ ? momenta_[i] : angular_momentum(i); };
    return {mass * (change - fall), momentum(row + 1) - momentum(row)};
  }
  return {{mass * (number(row + 1, 4) - number(row, 4) - fall.x()), 0,
           mass * (number(row + 1, 5) - number(row, 5) - fall.z())},
          {0, -reference_.body.inertia(1, 1) * (number(row + 1, 6) - number(row, 6)), 0}};
}

void Motion::find_first_touch() {
  const double reach = reference_.reach();
  const space::State first = state(0);
  const std::vector<Vector3> arms = reference_.arms(first.attitude);
  double height = std::numeric_limits<double>::infinity(), speed = 0;
  for (const Vector3& arm : arms) height = std::fmin(height, first.position.z() + arm.z());
  for (const Vector3& arm : arms) {  // of points that are down together one may leave while another strikes
    if (first.position.z() + arm.z() > height + 1e-6 * reach) continue;
    speed = std::fmin(speed, (first.velocity + first.angular_velocity.cross(arm)).z());
  }
  if (std::fabs(height) <= 1e-6 * reach && speed >= -1e-9 * reference_.speed()) {
    lead_ = reference_.start;
    lead_->position += first.position - Vector3(0, 0, first.position.z());
  }
  const space::FreeFlight flight = reference_.flight(state(0));
  const double delay = touch_time(reference_, flight);
  first_touch_ = time(0) + delay;
  const space::State touch = flight.at(delay);
  if (reference_.gravity_along != 0) {  // the potential counts from the place of the first touch
    origin_ = touch.position.x();
    if (lead_) lead_->position.x() = 0;
  }
  const space::State& start = reference_.start;
  start_error_ = std::max((touch.velocity - start.velocity).norm(),
                          reach * (touch.angular_velocity - start.angular_velocity).norm()) /
                 reference_.speed();
  const std::vector<Vector3> now = reference_.arms(touch.attitude), wanted = reference_.arms(start.attitude);
  for (std::size_t i = 0; i < now.size(); ++i)
    start_error_ = std::max(start_error_, (now[i] - wanted[i]).norm() / reach);
}

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
