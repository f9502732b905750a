// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sustained_contact.hpp"

#include <gsl/gsl_odeiv2.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// Of one or two rows.
double determinant(const Small& m) { return m.rows() == 1 ? m(0, 0) : m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0); }

struct StepDeleter {
  void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
};

class ContactMotion {
 public:
  /// Attitude (w, x, y, z), ω, horizontal velocity of the first corner.
  using Motion = Eigen::Matrix<double, 9, 1>;
  ContactMotion(const Drop& drop, const State& now, const std::vector<int>& corners);
  SustainedContact follow();
  [[nodiscard]] State state() const { return state_of(motion_); }

 private:
  /// Local error of a step, relative to the sizes of attitude and velocities.
  static constexpr double step_error = 1e-14;
  /// Slip slower than this part of the body's speeds has stopped, or has not begun.
  static constexpr double no_slip = 1e-13;
  /// The same of slip that hops before the contact have left.
  static constexpr double left_slip = 1e-7;
  static constexpr double longest_step = 0.1;  ///< [rad], and of √(reach/g)
  static constexpr int most_steps = 20'000;

  struct Point {
    int index;
    Vector3 place;
    bool sticks;
  };
  /// Forces and accelerations at a moment.
  struct Forces {
    std::vector<Vector3> of_points;
    Vector3 turning, first;  ///< ω̇, and acceleration of the first corner
    bool is_unique = true;
  };
  struct Unknowns {
    Small given, rows;
    Eigen::Index count;
  };
  enum class Event { none, arrival, lifts, gives_way };

  static Vector3 horizontal(const Vector3& v) { return {v.x(), v.y(), 0}; }
  [[nodiscard]] State state_of(const Motion& y) const;
  /// @param starting  direction of slip of the one corner, in place of that of its velocity
  [[nodiscard]] Forces forces(const State& s, const Vector3* starting = nullptr) const;
  [[nodiscard]] Unknowns unknowns(const State& s, const Vector3* starting) const;
  [[nodiscard]] SmallVector solve(const State& s, const Unknowns& u, const Small& effect, const SmallVector& free,
                                  bool& is_unique) const;
  [[nodiscard]] Vector3 slip(const State& s, const Point& p) const {
    return horizontal(s.velocity + s.angular_velocity.cross(s.attitude * p.place));
  }
  [[nodiscard]] bool touches(int vertex) const {
    return std::ranges::any_of(points_, [&](const Point& p) { return p.index == vertex; });
  }
  [[nodiscard]] double energy(const State& s) const {
    const Vector3 w = s.attitude.conjugate() * s.angular_velocity;
    return drop_.body.mass * (drop_.gravity * s.position.z() + s.velocity.squaredNorm() / 2) +
           w.dot(drop_.body.inertia * w) / 2;
  }
  [[nodiscard]] double friction_left(const State& s, const Forces& f) const;
  [[nodiscard]] double room(const State& s, Event event, std::size_t number) const;
  static int derivative(double, const double y[], double rate[], void* motion);
  [[nodiscard]] Motion rate(const Motion& y) const;
  [[nodiscard]] double speed_scale() const;
  bool keep_or_begin_slip();
  [[nodiscard]] bool begin_slip();
  bool stop_slips();
  [[nodiscard]] double longest(const State& start, const Motion& rates) const;
  [[nodiscard]] bool is_clear(const State& start, const State& end, double length) const;
  void locate_first(const Motion& from);
  void step();
  [[nodiscard]] double least_between(const State& from, const State& to, double length, int vertex) const;
  bool locate(const Motion& from, double length, Event event, std::size_t number);
  void apply(Motion& y, double length, Motion& error);
  [[nodiscard]] std::vector<int> arriving() const;
  void leave(std::size_t number);
  [[nodiscard]] SustainedContact ended(ContactEnd end, const std::string& reason) const;

  const Drop& drop_;
  double friction_, reach_;
  Matrix3 inverse_inertia_;
  std::vector<int> corners_;  ///< at the beginning
  std::vector<Point> points_;
  State start_;
  Motion motion_;
  double time_ = 0, length_ = 0;
  bool slips_ = false, sticks_ = false;
  Event event_ = Event::none;
  std::size_t number_ = 0;
  gsl_odeiv2_system system_{derivative, nullptr, 9, this};
  std::unique_ptr<gsl_odeiv2_step, StepDeleter> step_{gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 9)};
};

/// Levels the corners, and takes away their normal velocity and slip that is rounding.
ContactMotion::ContactMotion(const Drop& drop, const State& now, const std::vector<int>& corners)
    : drop_(drop), reach_(drop.body.reach()), inverse_inertia_(drop.body.inertia.inverse()) {
  const ImpactLaw& law = drop.law.law;
  friction_ = law.friction == FrictionKind::coulomb ? law.friction_value : 0;
  corners_ = corners;
  for (const int i : corners) points_.push_back({i, drop.body.vertices[static_cast<std::size_t>(i)], false});
  State s = now;
  s.attitude.normalize();
  if (points_.size() == 2) {
    const Vector3 edge = s.attitude * (points_[1].place - points_[0].place), along = horizontal(edge);
    s.attitude = (Quaternion::FromTwoVectors(edge, along) * s.attitude).normalized();
    const Vector3 across = Vector3::UnitZ().cross(along.normalized());  // a turn about it lifts one of the two
    s.angular_velocity -= s.angular_velocity.dot(across) * across;
  }
  const Vector3 u = slip(s, points_[0]);
  motion_ << s.attitude.w(), s.attitude.vec(), s.angular_velocity, u.head<2>();
  for (Point& p : points_) {
    p.sticks = friction_ > 0 && slip(state(), p).norm() <= left_slip * speed_scale();
  }
  if (points_[0].sticks) motion_.tail<2>().setZero();
  const bool hinge = std::ranges::all_of(points_, &Point::sticks) && points_.size() == 2;
  if (hinge) {
    const Vector3 edge = (s.attitude * (points_[1].place - points_[0].place)).normalized();
    motion_.segment<3>(4) = s.angular_velocity.dot(edge) * edge;
  }
}

State ContactMotion::state_of(const Motion& y) const {
  State s;
  s.attitude = Quaternion(y[0], y[1], y[2], y[3]).normalized();
  s.angular_velocity = y.segment<3>(4);
  const Vector3 arm = s.attitude * points_[0].place;
  s.velocity = Vector3(y[7], y[8], 0) - s.angular_velocity.cross(arm);
  s.position = {0, 0, -arm.z()};
  return s;
}

double ContactMotion::speed_scale() const {
  return std::sqrt(drop_.gravity * reach_) + motion_.segment<3>(4).norm() * reach_;
}

/// Those of (1): `given` makes forces of them, `rows` takes from the accelerations those that are zero.
ContactMotion::Unknowns ContactMotion::unknowns(const State& s, const Vector3* starting) const {
  Unknowns u{.given = Small::Zero(6, 6), .rows = Small::Zero(6, 6), .count = 0};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    if (points_[i].sticks) {
      u.given.block<3, 3>(at, u.count).setIdentity();
      u.rows.block<3, 3>(u.count, at).setIdentity();
      u.count += 3;
      continue;
    }
    const Vector3 v = slip(s, points_[i]);
    const Vector3 direction = starting != nullptr ? *starting : v.norm() > 0 ? Vector3(v.normalized()) : v;
    u.given.block<3, 1>(at, u.count) = Vector3::UnitZ() - friction_ * direction;
    u.rows(u.count, at + 2) = 1;
    u.count += 1;
  }
  return u;
}

ContactMotion::Forces ContactMotion::forces(const State& s, const Vector3* starting) const {
  const Matrix3 axes = s.attitude.toRotationMatrix();
  const Matrix3 inertia = axes * drop_.body.inertia * axes.transpose();
  const Matrix3 inverse = axes * inverse_inertia_ * axes.transpose();
  const Vector3& w = s.angular_velocity;
  const Vector3 free_turning = inverse * (inertia * w).cross(w), weight(0, 0, -drop_.gravity);
  Small effect = Small::Zero(6, 6);  // W
  SmallVector free = SmallVector::Zero(6);
  std::vector<Vector3> arms;
  for (const Point& p : points_) {
    const Vector3 arm = axes * p.place;
    free.segment<3>(static_cast<Eigen::Index>(3 * arms.size())) =
        weight + free_turning.cross(arm) + w.cross(w.cross(arm));
    arms.push_back(arm);
  }
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (std::size_t j = 0; j < arms.size(); ++j) {
      effect.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) =
          Matrix3::Identity() / drop_.body.mass - cross_matrix(arms[i]) * inverse * cross_matrix(arms[j]);
    }
  }
  Forces f;
  const SmallVector all = solve(s, unknowns(s, starting), effect, free, f.is_unique);
  f.turning = free_turning;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    f.of_points.emplace_back(all.segment<3>(static_cast<Eigen::Index>(3 * i)));
    f.turning += inverse * arms[i].cross(f.of_points.back());
  }
  f.first = free.head<3>() + effect.topRows<3>() * all;
  return f;
}

/// The forces of all points.
SmallVector ContactMotion::solve(const State& s, const Unknowns& u, const Small& effect, const SmallVector& free,
                                 bool& is_unique) const {
  const Small which = u.rows.topRows(u.count), some = u.given.leftCols(u.count);
  Small equations = which * effect * some;
  // A P-matrix: all principal minors above 0; of corners that stick W is positive definite.
  if (u.count <= 2) is_unique = equations.diagonal().minCoeff() > 0 && determinant(equations) > 0;
  if (u.count == 6) {  // forces that pull the corners of an edge apart do nothing: none of those
    const Vector3 edge = (s.attitude * (points_[1].place - points_[0].place)).normalized();
    SmallVector apart(6);
    apart << edge, -edge;
    equations += apart * apart.transpose() / drop_.body.mass;
  }
  return some * equations.partialPivLu().solve(-which * free);
}

/// μN − |f_t| of a corner that sticks; of an edge both corners of which do, what friction along it has left.
double ContactMotion::friction_left(const State& s, const Forces& f) const {
  const bool hinge = points_.size() == 2 && points_[0].sticks && points_[1].sticks;
  double least = infinite, along = 0, room = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].sticks) continue;
    const double limit = friction_ * f.of_points[i].z();
    if (!hinge) {
      least = std::fmin(least, limit - f.of_points[i].head<2>().norm());
      continue;
    }
    const Vector3 edge = horizontal(s.attitude * (points_[1].place - points_[0].place)).normalized();
    const double mine = f.of_points[i].dot(edge), across = (horizontal(f.of_points[i]) - mine * edge).norm();
    along += mine;
    room += std::sqrt(std::fmax(limit * limit - across * across, 0.0));
    least = std::fmin(least, limit - across);
  }
  return hinge ? std::fmin(least, room - std::fabs(along)) : least;
}

ContactMotion::Motion ContactMotion::rate(const Motion& y) const {
  const State s = state_of(y);
  const Forces f = forces(s);
  const Quaternion turn(0, s.angular_velocity.x(), s.angular_velocity.y(), s.angular_velocity.z());
  const Quaternion change = turn * Quaternion(y[0], y[1], y[2], y[3]);
  Motion result;
  result << change.w() / 2, change.vec() / 2, f.turning, f.first.head<2>();
  if (points_[0].sticks) result.tail<2>().setZero();
  return result;
}

int ContactMotion::derivative(double, const double y[], double rate[], void* motion) {
  Eigen::Map<Motion> result(rate);
  result = static_cast<const ContactMotion*>(motion)->rate(Eigen::Map<const Motion>(y));
  return 0;
}

void ContactMotion::apply(Motion& y, double length, Motion& error) {
  gsl_odeiv2_step_reset(step_.get());
  gsl_odeiv2_step_apply(step_.get(), 0, length, y.data(), error.data(), nullptr, nullptr, &system_);
  y.head<4>().normalize();
}

/// What turns negative at an event.
double ContactMotion::room(const State& s, Event event, std::size_t number) const {
  if (event == Event::arrival) return s.position.z() + (s.attitude * drop_.body.vertices[number]).z();
  const Forces f = forces(s);
  return event == Event::lifts ? f.of_points[number].z() : friction_left(s, f);
}

/// The directions in which a corner at rest that cannot stick begins to slip: its acceleration is along its slip.
bool ContactMotion::begin_slip() {
  if (points_.size() > 1) return false;
  const State s = state();
  constexpr int directions = 180;
  constexpr double step = 2 * std::numbers::pi / directions;
  const auto turned = [&](double angle) -> Vector3 { return {std::cos(angle), std::sin(angle), 0}; };
  const auto off = [&](double angle) {
    const Vector3 d = turned(angle);
    return d.cross(forces(s, &d).first).z();
  };
  points_[0].sticks = false;
  std::vector<Vector3> found;
  for (int i = 0; i < directions; ++i) {
    double low = i * step, high = low + step;
    const double at_low = off(low);
    if (std::signbit(at_low) == std::signbit(off(high))) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (std::signbit(off(middle)) == std::signbit(at_low) ? low : high) = middle;
    }
    const Vector3 d = turned(low);
    const Forces f = forces(s, &d);
    if (f.first.dot(d) > 0 && f.of_points[0].z() > 0 && f.is_unique) found.push_back(d);
  }
  if (found.size() != 1) return false;
  motion_.tail<2>() = 4 * no_slip * speed_scale() * found[0].head<2>();
  return true;
}

/// After each event: corners that stick go on sticking, or begin to slip; false where the law leaves it open.
bool ContactMotion::keep_or_begin_slip() {
  const State s = state();
  return std::ranges::none_of(points_, &Point::sticks) || friction_left(s, forces(s)) > 0 || begin_slip();
}

/// Corners whose slip has stopped stick.
bool ContactMotion::stop_slips() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& p = points_[i];
    if (p.sticks || slip(state(), p).norm() > no_slip * speed_scale()) continue;
    p.sticks = true;
    if (i == 0) motion_.tail<2>().setZero();
  }
  return keep_or_begin_slip();
}

/// Bound from below on a height between two moments.
double ContactMotion::least_between(const State& from, const State& to, double length, int vertex) const {
  const auto at = [&](const State& s) {
    const Vector3 arm = s.attitude * drop_.body.vertices[static_cast<std::size_t>(vertex)];
    return std::pair(s.position.z() + arm.z(), (s.velocity + s.angular_velocity.cross(arm)).z());
  };
  const auto [h0, v0] = at(from);
  const auto [h1, v1] = at(to);
  const double bend = 2 * std::fabs(v1 - v0) / length + 0.1 * drop_.gravity;  // of steps this short
  const double mean = (h1 - h0) / length;
  if (std::fabs(mean) >= bend * length / 2) return std::fmin(h0, h1);
  const double t = length / 2 - mean / bend;
  return h0 + mean * t - bend / 2 * t * (length - t);
}

/// Finds the moment of the event within a step from `from`, and goes there.
bool ContactMotion::locate(const Motion& from, double length, Event event, std::size_t number) {
  double low = 0, high = length;
  double at_low = room(state_of(from), event, number), at_high = room(state(), event, number);
  if (at_high > 0) return false;
  Motion there = motion_, error;
  for (int i = 0; i < 200 && high - low > epsilon / 4 * (time_ + high); ++i) {
    double middle =
        i % 3 == 2 || !(at_low > at_high) ? (low + high) / 2 : low + (high - low) * at_low / (at_low - at_high);
    if (!(middle > low && middle < high)) middle = (low + high) / 2;
    there = from;
    apply(there, middle, error);
    const double value = room(state_of(there), event, number);
    (value > 0 ? low : high) = middle;
    (value > 0 ? at_low : at_high) = value;
    if (value == 0) break;
  }
  motion_ = from;
  apply(motion_, high, error);
  length_ = high;
  event_ = event;
  number_ = number;
  return true;
}

/// Slip may lose nine tenths of itself in a step.
double ContactMotion::longest(const State& start, const Motion& rates) const {
  const double falling = std::sqrt(reach_ / drop_.gravity);
  double length = std::fmin(length_, longest_step * std::fmin(falling, 1 / start.angular_velocity.norm()));
  const Vector3 first = start.attitude * points_[0].place, w = start.angular_velocity;
  for (const Point& p : points_) {
    if (p.sticks || friction_ == 0) continue;
    const Vector3 apart = start.attitude * p.place - first;
    const Vector3 acceleration =
        Vector3(rates[7], rates[8], 0) + horizontal(rates.segment<3>(4).cross(apart) + w.cross(w.cross(apart)));
    length = std::fmin(length, 0.9 * slip(start, p).norm() / acceleration.norm());
  }
  return length;
}

/// Whether no other vertex that is above the ground before and after the step can have been on it meanwhile.
bool ContactMotion::is_clear(const State& start, const State& end, double length) const {
  for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
    if (touches(static_cast<int>(i)) || room(end, Event::arrival, i) <= 0) continue;
    if (room(start, Event::arrival, i) <= 64 * epsilon * reach_) continue;
    if (!(least_between(start, end, length, static_cast<int>(i)) > 0)) return false;
  }
  return true;
}

void ContactMotion::locate_first(const Motion& from) {
  for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
    if (!touches(static_cast<int>(i))) locate(from, length_, Event::arrival, i);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) locate(from, length_, Event::lifts, i);
  if (std::ranges::any_of(points_, &Point::sticks)) locate(from, length_, Event::gives_way, 0);
}

/// One step, or part of one up to the first event in it.
void ContactMotion::step() {
  const Motion from = motion_;
  const State start = state();
  const double shortest = 1e-10 * std::sqrt(reach_ / drop_.gravity);
  double length = longest(start, rate(from));
  for (;;) {
    Motion error;
    motion_ = from;
    apply(motion_, length, error);
    const double turning = std::fmax(error.head<4>().norm(), error.segment<3>(4).norm() * reach_ / speed_scale());
    const double share = std::fmax(turning, error.tail<2>().norm() / speed_scale()) / step_error;
    const bool clear = length <= shortest || is_clear(start, state(), length);
    const double better = 0.9 * std::pow(std::fmax(share, 1e-8), -0.125);
    if (share <= 1 && clear) {
      length_ = length;
      locate_first(from);
      time_ += length_;
      length_ = event_ == Event::none ? length * std::fmin(better, 4) : length;
      return;
    }
    length *= clear ? std::fmin(std::fmax(better, 0.1), 0.9) : 0.5;
    if (!(length > epsilon * shortest)) throw NumericalError("a step of a body that stays on the ground fails");
  }
}

/// The corners that come down with the one that has.
std::vector<int> ContactMotion::arriving() const {
  const State s = state();
  std::vector<int> some;
  for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
    if (touches(static_cast<int>(i)) || room(s, Event::arrival, i) > 64 * epsilon * reach_) continue;
    const Vector3 arm = s.attitude * drop_.body.vertices[i];
    if ((s.velocity + s.angular_velocity.cross(arm)).z() < 0) some.push_back(static_cast<int>(i));
  }
  return some;
}

/// The corner leaves the ground; the velocity that is kept is that of the first.
void ContactMotion::leave(std::size_t number) {
  const State s = state();
  points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(number));
  if (!points_.empty()) motion_.tail<2>() = slip(s, points_[0]).head<2>();
}

SustainedContact ContactMotion::ended(ContactEnd end, const std::string& reason) const {
  SustainedContact result;
  result.end = end;
  result.reason = reason;
  result.duration = time_;
  result.corners = corners_;
  result.after = state();
  result.slips = slips_ && friction_ > 0;
  result.sticks = sticks_;
  for (const Point& p : points_) result.pivots.push_back(p.index);
  if (end == ContactEnd::arrival) result.arriving = arriving();
  for (const int i : result.arriving) {
    const Vector3 arm = result.after.attitude * drop_.body.vertices[static_cast<std::size_t>(i)];
    const double approach = -(result.after.velocity + result.after.angular_velocity.cross(arm)).z();
    result.approach_speed = std::fmax(result.approach_speed, approach);
  }
  const double rise = result.after.velocity.z() - start_.velocity.z();
  result.normal_impulse = drop_.body.mass * (rise + drop_.gravity * time_);
  result.energy_loss = energy(start_) - energy(result.after);
  return result;
}

SustainedContact ContactMotion::follow() {
  const char* const friction = "how friction lets its corners slip is open";
  start_ = state();
  length_ = 1e-3 * longest_step * std::sqrt(reach_ / drop_.gravity);
  if (!keep_or_begin_slip()) return ended(ContactEnd::open, friction);
  for (int steps = 0; steps < most_steps; ++steps) {
    if (!arriving().empty()) return ended(ContactEnd::arrival, "");
    const Forces f = forces(state());
    if (!f.is_unique) return ended(ContactEnd::open, "slip digs in (Painlevé)");
    const auto pulled = std::ranges::find_if(f.of_points, [](const Vector3& force) { return !(force.z() > 0); });
    if (event_ == Event::lifts || pulled != f.of_points.end()) {
      if (points_.size() == 1) return ended(ContactEnd::lift_off, "");
      leave(event_ == Event::lifts ? number_ : static_cast<std::size_t>(pulled - f.of_points.begin()));
      if (!keep_or_begin_slip()) return ended(ContactEnd::open, friction);
    }
    if (event_ == Event::gives_way) return ended(ContactEnd::open, "friction no longer holds it there");
    for (const Point& p : points_) (p.sticks ? sticks_ : slips_) = true;
    event_ = Event::none;
    step();
    if (friction_ > 0 && event_ == Event::none && !stop_slips()) return ended(ContactEnd::open, friction);
  }
  throw NumericalError("a body that stays on the ground with a corner turns on and on");
}

}  // namespace

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners) {
  return ContactMotion(drop, now, corners).follow();
}

namespace {

/// How far apart the ends of two motions are: time, attitude, velocity, angular velocity; nothing if they end unlike.
std::optional<StateErrors> distance(const SustainedContact& a, const SustainedContact& b) {
  if (a.end != b.end || a.arriving != b.arriving || a.pivots != b.pivots) return {};
  return StateErrors{.time = std::fabs(a.duration - b.duration),
                     .attitude = 2 * (a.after.attitude.conjugate() * b.after.attitude).vec().norm(),
                     .velocity = (a.after.velocity - b.after.velocity).norm(),
                     .angular_velocity = (a.after.angular_velocity - b.after.angular_velocity).norm()};
}

void add(StateErrors& sum, const StateErrors& one, double times) {
  sum.time += times * one.time;
  sum.attitude += times * one.attitude;
  sum.velocity += times * one.velocity;
  sum.angular_velocity += times * one.angular_velocity;
}

}  // namespace

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners,
                                const StateErrors& errors) {
  constexpr double step = 1e-8, rounding = 1e-11, first_order = 0.02;
  SustainedContact base = follow_contact(drop, now, corners);
  if (base.end == ContactEnd::open || !std::isfinite(errors.angular_velocity)) return base;
  const State start = ContactMotion(drop, now, corners).state();
  const Vector3& place = drop.body.vertices[static_cast<std::size_t>(corners[0])];
  const double reach = drop.body.reach();
  const double speed = std::sqrt(drop.gravity * reach) + start.angular_velocity.norm() * reach;
  const Vector3 slip = start.velocity + start.angular_velocity.cross(start.attitude * place);
  StateErrors sum{.time = errors.time + rounding * base.duration,
                  .attitude = rounding,
                  .velocity = rounding * speed,
                  .angular_velocity = rounding * speed / reach};
  const double of_slip = errors.velocity + reach * errors.angular_velocity + speed * errors.attitude;
  for (int k = 0; k < 8; ++k) {
    if (k > 5 && slip.norm() == 0) continue;
    State other = start;
    const Vector3 axis = Vector3::Unit(k % 3);
    if (k < 3) other.attitude = Quaternion(Eigen::AngleAxisd(step, axis)) * start.attitude;
    else if (k < 6) other.angular_velocity += step * speed / reach * axis;
    const Vector3 slips = k < 6 ? slip : Vector3(slip + step * speed * axis);
    other.velocity = slips - other.angular_velocity.cross(other.attitude * place);
    std::optional<StateErrors> change;
    try {
      change = distance(base, follow_contact(drop, other, corners));
    } catch (const NumericalError&) {
    }
    if (!change) return base;
    add(sum, *change,
        k < 3   ? errors.attitude / step
        : k < 6 ? errors.angular_velocity * reach / (step * speed)
                : of_slip / (step * speed));
  }
  if (sum.attitude <= first_order && sum.velocity <= first_order * speed) base.error = sum;
  return base;
}

namespace {

/// The corners on the ground at the end.
std::vector<int> staying(const Sequence& sequence) {
  if (sequence.tail) return sequence.tail->corners;
  const ImpactRow& last = sequence.rows.back();
  std::vector<int> corners;
  for (const Corner& corner : last.corners) {
    const ContactVelocity v = contact_velocity(state_after(last), corner.place);
    if (std::fabs(v.value.z()) <= 64 * epsilon * v.scale) corners.push_back(corner.index);
  }
  return corners;
}

}  // namespace

std::optional<SustainedContact> contact_after(const Drop& drop, const Sequence& sequence) {
  const ImpactLaw& law = drop.law.law;
  if (sequence.outcome != Outcome::sustained_contact || law.law == RestitutionLaw::viscoelastic) return {};
  const std::vector<int> corners = staying(sequence);
  const auto is_vertex = [&](int i) { return static_cast<std::size_t>(i) < drop.body.vertices.size(); };
  const bool one_or_two = corners.size() == 1 || corners.size() == 2;
  if (!one_or_two || !std::ranges::all_of(corners, is_vertex) || law.friction == FrictionKind::impulse_ratio) return {};
  const ImpactRow& last = sequence.rows.back();
  State now = state_after(last);
  StateErrors errors{last.error.start, last.error.attitude, last.error.velocity_after,
                     last.error.angular_velocity_after};
  double begin = last.start;
  if (sequence.tail) {
    const Tail& tail = *sequence.tail;
    const double left = tail.end_time - last.start, turning = tail.angular_velocity_after.norm();
    const Vector3 turn = left / 2 * (now.angular_velocity + tail.angular_velocity_after);
    const Quaternion change(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
    now.attitude = (change * now.attitude).normalized();
    now.velocity = tail.velocity_after;
    now.angular_velocity = tail.angular_velocity_after;
    begin = tail.end_time;
    errors = {tail.end_time_error, last.error.attitude + turn.squaredNorm() + turning * tail.end_time_error,
              tail.velocity_error, tail.angular_velocity_error};
  }
  SustainedContact contact = follow_contact(drop, now, corners, errors);
  contact.begin = begin;
  return contact;
}

}  // namespace clatter::analytic::space
