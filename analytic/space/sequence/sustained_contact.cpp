// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/sustained_contact.hpp"

#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/space/sequence/slip_start.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

namespace {

// The equations of motion of a body one or two corners of which stay on the ground, solved from event to event.
//
// Steps are explicit, but for those in which slip begins: they are implicit in its direction (slip_start.hpp), until
// explicit ones are stable.

constexpr const char* slip_is_open = "how friction lets its corners slip is open";

class ContactMotion {
 public:
  ContactMotion(const Drop& drop, const State& now, const std::vector<int>& corners)
      : drop_(drop), law_(drop), reach_(drop.body.reach()), falling_(std::sqrt(reach_ / drop.gravity)),
        given_(mechanical_energy(drop, now)), corners_(corners) {
    for (const int i : corners) points_.push_back({i, place(i), false});
    hold(now);
    stick_where_slow();
    start_ = state();
    began_with_ = points_;
  }

  /// A neighbour of that motion at its beginning: the same corners stick.
  ContactMotion(const ContactMotion& base, const State& now)
      : drop_(base.drop_), law_(base.law_), reach_(base.reach_), falling_(base.falling_),
        given_(mechanical_energy(drop_, now)), corners_(base.corners_), points_(base.began_with_) {
    take(now);
    start_ = state();
  }

  ContactMotion(const ContactMotion&) = delete;
  ContactMotion& operator=(const ContactMotion&) = delete;

  /// Up to the end of the contact; once.
  /// @throws NumericalError if 5 000 steps do not end it
  SustainedContact follow() {
    for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
      if (!(height(state(), i) >= -1e-7 * reach_))
        throw NumericalError("a corner is below those that stay on the ground");
    }
    if (!(std::fabs(given_ - mechanical_energy(drop_, start_)) <=
          1e-6 * drop_.body.mass * speed_scale() * speed_scale())) {
      throw NumericalError("corners that stay on the ground are not at rest there");
    }
    length_ = 1e-3 * longest_step * falling_;
    if (!keep_or_begin_slip()) return ended(ContactEnd::open, slip_is_open);
    for (int steps = 0; steps < most_steps; ++steps) {
      if (!arriving().empty()) return ended(ContactEnd::arrival, "");
      if (lies()) return ended(ContactEnd::rest, "");
      if (auto end = pass_event()) return *end;
      if (!go_on()) return ended(ContactEnd::open, slip_is_open);
    }
    throw NumericalError("a body that stays on the ground with a corner turns on and on");
  }

  /// For this time, wherever others come down and if the ground has to pull; whether that can be computed.
  bool advance(double duration) {
    duration_ = duration;
    length_ = 1e-3 * longest_step * falling_;
    if (!keep_or_begin_slip()) return false;
    for (int steps = 0; steps < most_steps; ++steps) {
      if (duration_ - time_ <= 4 * epsilon * duration_) return true;
      if (pass_event() || !go_on()) return false;
    }
    return false;
  }

  [[nodiscard]] const Drop& drop() const { return drop_; }
  [[nodiscard]] State state() const { return state_of(motion_, points_); }
  [[nodiscard]] bool slips() const { return !std::ranges::all_of(points_, &GroundPoint::sticks); }
  /// Least speed of corners that slip with friction, infinite without [m/s].
  [[nodiscard]] double least_slip() const {
    double least = infinite;
    for (const GroundPoint& p : points_) {
      if (!p.sticks && law_.friction() > 0) least = std::fmin(least, slip_of(state(), p).norm());
    }
    return least;
  }

  /// √(g reach) + |ω| reach [m/s].
  [[nodiscard]] double speed_scale() const {
    return std::sqrt(drop_.gravity * reach_) + motion_.segment<3>(4).norm() * reach_;
  }

  /// What turns negative where the contact ends, by arrival of the vertex or lift-off.
  [[nodiscard]] double margin(ContactEnd end, int vertex) const {
    if (end == ContactEnd::arrival) return height(state(), static_cast<std::size_t>(vertex));
    return forces(motion_).of_points[0].z();
  }

  /// Rates of change, at the end, of state and margin with time.
  struct Rates {
    Vector3 acceleration, turning;  ///< V̇, ω̇
    double margin;
    double bend = 0;  ///< second derivative of a height
  };

  [[nodiscard]] Rates rates(ContactEnd end, int vertex) const {
    const GroundForces f = forces(motion_);
    Rates result{.acceleration = acceleration(f), .turning = f.turning, .margin = 0};
    const State s = state();
    if (end == ContactEnd::arrival) {
      result.margin = velocity_at(s, place(vertex)).z();
      result.bend = acceleration(f, s, place(vertex)).z();
      return result;
    }
    const Motion change = 1e-5 * falling_ * rate_of(motion_, points_, f);
    const auto turning = turning_points(points_);
    SlipAngles turns(turning.size());  // g stays nearly the same
    for (std::size_t k = 0; k < turning.size(); ++k) {
      turns[k] = slip_at(points_[turning[k]].angle).cross(f.accelerations[turning[k]]).z();
    }
    const auto push = [&](const Motion& y) {
      const State at = state_of(y, points_);
      if (turning.empty()) return law_.forces(at, points_).of_points[0].z();
      return law_.forces(at, directed(points_, slip_angles(law_, at, points_, turns))).of_points[0].z();
    };
    result.margin = (push(motion_ + change) - push(motion_ - change)) / (2e-5 * falling_);
    return result;
  }

 private:
  using Motion = GroundMotion;
  enum class Event { none, arrival, lifts, gives_way, digs_in };

  /// Local error of a step, relative to the sizes of attitude and velocities.
  static constexpr double step_error = 1e-14;
  /// Slip slower than this part of the body's speeds has stopped, or has not begun.
  static constexpr double no_slip = 1e-13;
  /// The same of slip that hops before the contact have left.
  static constexpr double left_slip = 1e-7;
  static constexpr double longest_step = 0.1;  ///< [rad], and of √(reach/g)
  static constexpr int most_steps = 5'000;

  /// Acceleration V̇ of the centre of mass.
  [[nodiscard]] Vector3 acceleration(const GroundForces& f) const {
    Vector3 sum(0, 0, -drop_.gravity);
    for (const Vector3& force : f.of_points) sum += force / drop_.body.mass;
    return sum;
  }
  /// Acceleration of a place, V̇ + ω̇ × r + ω × (ω × r).
  [[nodiscard]] Vector3 acceleration(const GroundForces& f, const State& s, const Vector3& place) const {
    const Vector3 arm = s.attitude * place;
    return acceleration(f) + f.turning.cross(arm) + s.angular_velocity.cross(s.angular_velocity.cross(arm));
  }

  [[nodiscard]] GroundForces forces(const Motion& y) const { return law_.forces(state_of(y, points_), points_); }

  [[nodiscard]] bool touches(int vertex) const {
    return std::ranges::any_of(points_, [&](const GroundPoint& p) { return p.index == vertex; });
  }

  [[nodiscard]] const Vector3& place(int vertex) const { return drop_.body.vertices[vertex]; }

  /// Height of a vertex above the first corner.
  [[nodiscard]] double height(const State& s, std::size_t vertex) const {
    return s.position.z() + (s.attitude * drop_.body.vertices[vertex]).z();
  }

  /// What turns negative at an event.
  [[nodiscard]] double room(const Motion& y, Event event, std::size_t number) const {
    if (event == Event::arrival) return height(state_of(y, points_), number);
    const GroundForces f = forces(y);
    return event == Event::lifts ? f.of_points[number].z() : law_.friction_left(state_of(y, points_), points_, f);
  }

  static int derivative(double, const double y[], double rate[], void* motion) {
    Eigen::Map<Motion> result(rate);
    const auto& with = *static_cast<const ContactMotion*>(motion);
    const Motion y_now = Eigen::Map<const Motion>(y);
    result = rate_of(y_now, with.points_, with.forces(y_now));
    return 0;
  }

  /// Friction no longer holds what sticks: slip begins.
  bool give_way() {
    hold(state());  // of the second corner's slip rounding is left
    auto begins = space::give_way(law_, state(), points_, no_slip * speed_scale());
    if (!begins) return false;
    points_ = std::move(*begins);
    length_ = 1e-3 * longest_step * falling_;
    return true;
  }

  /// Whether slip has turned back whose direction is kept, across an edge or where it begins: friction would drive it
  /// on.
  [[nodiscard]] bool turns_back() const {
    for (std::size_t i = 0; i < points_.size() && law_.friction() > 0; ++i) {
      const GroundPoint& p = points_[i];
      const bool is_kept = p.begins || (points_.size() == 2 && (p.across || points_[1 - i].sticks));
      if (p.sticks || !is_kept) continue;
      if (slip_of(state(), p).dot(slip_at(p.angle)) < -no_slip * speed_scale()) return true;
    }
    return false;
  }

  /// Whether slip still begins after a step: it grows, and explicit steps of this length would not be stable.  Nothing
  /// where the step went on until slip has turned back.
  [[nodiscard]] std::optional<bool> still_begins(const State& start, double length) const {
    constexpr double stable = 3;  // for the explicit method
    const auto turning = turning_points(points_);
    if (turning.empty()) return turns_back() ? std::optional<bool>() : true;
    return stiffness_ * length > stable && std::ranges::all_of(turning, [&](std::size_t i) {
             return slip_of(motion_, points_, points_[i]).norm() > slip_of(start, points_[i]).norm();
           });
  }

  /// Directions of slip after a step from `start`.
  void note_directions(const State& start, bool begins) {
    // Across an edge slip has begun once it is more than rounding, or no longer grows, and it is kept across until (1)
    // is not stiff any more.
    constexpr double rounding = 1e-9, not_stiff = 1e-3;
    const State s = state();
    const auto turning = turning_points(points_);
    for (const std::size_t i : turning) points_[i].begins = begins;
    const bool some_turn = !turning_points(points_).empty();
    for (GroundPoint& p : points_) {
      const Vector3 v = slip_of(s, p);
      if (p.sticks || (p.begins && some_turn)) continue;
      const double begun = v.dot(slip_at(p.angle)), aside = (v - begun * slip_at(p.angle)).norm();
      const bool grows = begun > slip_of(start, p).dot(slip_at(p.angle));
      if (p.begins && (!grows || begun > rounding * speed_scale())) p.begins = false;
      const bool keeps_across = aside <= 1e-6 * begun + 1e-12 * speed_scale() && begun <= not_stiff * speed_scale();
      if (!p.begins && !keeps_across) p.across = false;
      if (!p.begins && v.norm() > 0) p.angle = std::atan2(v.y(), v.x());
    }
  }

  /// After each event: corners that stick go on sticking, or begin to slip; false where the law leaves it open.
  bool keep_or_begin_slip() {
    const State s = state();
    return std::ranges::none_of(points_, &GroundPoint::sticks) || law_.friction_left(s, points_, forces(motion_)) > 0 ||
           begin_slip();
  }

  /// Corners at rest that cannot stick begin to slip, if there is one way only.
  [[nodiscard]] bool begin_slip() {
    auto ways = ways_to_slip(law_, state(), points_);
    if (ways.size() != 1) return false;
    points_ = std::move(ways[0]);
    length_ = 1e-3 * longest_step * falling_;
    return true;
  }

  /// Corners whose slip has stopped stick.
  bool stop_slips() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      GroundPoint& p = points_[i];
      if (p.sticks || p.begins || slip_of(state(), p).norm() > no_slip * speed_scale()) continue;
      p.sticks = true;
      if (i == 0) slip_in(motion_).setZero();
    }
    return keep_or_begin_slip();
  }

  /// Slip may lose nine tenths of itself in a step.
  [[nodiscard]] double longest(const State& start, const GroundForces& f) const {
    double length = std::fmin(length_, longest_step * std::fmin(falling_, 1 / start.angular_velocity.norm()));
    length = std::fmin(length, duration_ - time_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const GroundPoint& p = points_[i];
      if (p.sticks || p.begins || law_.friction() == 0) continue;
      length = std::fmin(length, 0.9 * slip_of(start, p).norm() / horizontal(f.accelerations[i]).norm());
    }
    return length;
  }

  /// Whether no other vertex that is above the ground before and after the step can have been on it meanwhile.
  [[nodiscard]] bool is_clear(const State& start, const State& end, double length) const {
    for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
      if (touches(static_cast<int>(i)) || height(end, i) <= 0) continue;
      if (height(start, i) <= 64 * epsilon * reach_) continue;
      if (!(least_between(start, end, length, static_cast<int>(i)) > 0)) return false;
    }
    return true;
  }

  void locate_first(const Motion& from) {
    for (std::size_t i = 0; i < drop_.body.vertices.size() && !is_free(); ++i) {
      if (!touches(static_cast<int>(i))) locate(from, length_, Event::arrival, i);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_free() || points_.size() > 1) locate(from, length_, Event::lifts, i);
    }
    if (std::ranges::any_of(points_, &GroundPoint::sticks)) locate(from, length_, Event::gives_way, 0);
  }

  /// Whether slip lets the ground push without bound.
  [[nodiscard]] bool digs_in() const {
    constexpr double without_bound = 1e6;  // of what weight and turning ask for
    double push = 0;
    for (const Vector3& force : forces(motion_).of_points) push = std::fmax(push, force.z());
    return push > without_bound * drop_.body.mass * speed_scale() * speed_scale() / reach_;
  }

  /// One step, or part of one up to the first event in it.
  void step() {
    const Motion from = motion_;
    const State start = state();
    const double shortest = 1e-10 * falling_;
    double length = longest(start, forces(from));
    const double order = turning_points(points_).empty() ? 8 : SlipStart::order;
    for (;;) {
      Motion error;
      motion_ = from;
      apply(motion_, length, error);
      const double share = MotionScale{reach_, speed_scale()}.largest(error) / step_error;
      const std::optional<bool> begins = share <= 1 ? still_begins(start, length) : true;
      const bool clear = begins && (length <= shortest || is_free() || is_clear(start, state(), length));
      const double better = 0.9 * std::pow(std::fmax(share, 1e-8), -1.0 / order);
      if (share <= 1 && clear) {
        length_ = length;
        locate_first(from);
        note_directions(start, *begins);
        time_ += length_;
        length_ = event_ == Event::none ? length * std::fmin(better, 4) : length;
        return;
      }
      length *= clear ? std::fmin(std::fmax(better, 0.1), 0.9) : 0.5;
      if (length > epsilon * shortest) continue;
      motion_ = from;
      if (!digs_in()) throw NumericalError("a step of a body that stays on the ground fails");
      event_ = Event::digs_in;
      return;
    }
  }

  /// Bound from below on a height between two moments.
  [[nodiscard]] double least_between(const State& from, const State& to, double length, int vertex) const {
    const auto at = [&](const State& s) {
      return std::pair(height(s, static_cast<std::size_t>(vertex)), velocity_at(s, place(vertex)).z());
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
  bool locate(const Motion& from, double length, Event event, std::size_t number) {
    double low = 0, high = length;
    double at_low = room(from, event, number), at_high = room(motion_, event, number);
    if (at_high > 0) return false;
    Motion there = motion_, error;
    for (int i = 0; i < 200 && high - low > epsilon / 4 * (time_ + high); ++i) {
      double middle =
          i % 3 == 2 || !(at_low > at_high) ? (low + high) / 2 : low + (high - low) * at_low / (at_low - at_high);
      if (!(middle > low && middle < high)) middle = (low + high) / 2;
      there = from;
      apply(there, middle, error);
      const double value = room(there, event, number);
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

  void apply(Motion& y, double length, Motion& error) {
    if (!turning_points(points_).empty()) {
      const SlipStart start = slip_start(law_, points_, y, length, {reach_, speed_scale()});
      points_ = start.points;
      stiffness_ = start.stiffness;
      error = start.error;
      y = start.end;
    } else {
      gsl_odeiv2_step_reset(step_.get());
      gsl_odeiv2_step_apply(step_.get(), 0, length, y.data(), error.data(), nullptr, nullptr, &system_);
    }
    y.head<4>().normalize();
  }

  /// The corners that come down with the one that has.
  [[nodiscard]] std::vector<int> arriving() const {
    const State s = state();
    std::vector<int> some;
    for (std::size_t i = 0; i < drop_.body.vertices.size(); ++i) {
      if (touches(static_cast<int>(i)) || height(s, i) > 64 * epsilon * reach_) continue;
      if (velocity_at(s, drop_.body.vertices[i]).z() < 0) some.push_back(static_cast<int>(i));
    }
    return some;
  }

  /// With its corners at one height.
  [[nodiscard]] State levelled(State s) const {
    s.attitude.normalize();
    if (points_.size() < 2) return s;
    const Vector3 edge = s.attitude * (points_[1].place - points_[0].place);
    s.attitude = (turn_between(edge, horizontal(edge)) * s.attitude).normalized();
    return s;
  }

  /// Takes from the state what its corners cannot do, and leaves slip and turning as they are otherwise.
  void take(State s) {
    s = levelled(s);
    if (points_.size() == 2) {
      const Vector3 edge = s.attitude * (points_[1].place - points_[0].place);
      const Vector3 across = Vector3::UnitZ().cross(edge.normalized());  // a turn about it lifts one of the two
      s.angular_velocity -= s.angular_velocity.dot(across) * across;
    }
    const Vector3 u = slip_of(s, points_[0]);
    const Vector3 on = s.position + s.attitude * points_[0].place;
    motion_ << s.attitude.w(), s.attitude.vec(), s.angular_velocity, u.head<2>(), on.head<2>();
    if (points_[0].sticks) slip_in(motion_).setZero();
    if (!is_hinge()) return;
    const Vector3 edge = (s.attitude * (points_[1].place - points_[0].place)).normalized();
    motion_.segment<3>(4) = s.angular_velocity.dot(edge) * edge;
  }

  /// What is left of the corners' normal velocity, and of the slip of those that stick, impulses of the ground stop,
  /// which cannot create energy.
  void hold(const State& s) { take(law_.stopped(levelled(s), points_)); }

  /// Whether an edge sticks, about which the body turns.
  [[nodiscard]] bool is_hinge() const {
    return points_.size() == 2 && std::ranges::all_of(points_, &GroundPoint::sticks);
  }

  /// An edge that sticks is a hinge: what the errors of steps have turned it off its axis would be slip at the next
  /// impact, which friction would rub against however little it is.
  void keep_hinge() {
    if (is_hinge()) take(state());
  }

  void stick_where_slow() {
    for (GroundPoint& p : points_) {
      const Vector3 slip = slip_of(state(), p);
      p.sticks = law_.friction() > 0 && slip.norm() <= left_slip * speed_scale();
      if (!p.sticks) p.angle = std::atan2(slip.y(), slip.x());
    }
    hold(state());
  }

  /// Where the ground would have to pull, the corner that rises once it is free while the ground pushes the other; the
  /// first if there is none.
  [[nodiscard]] std::size_t rising(const GroundForces& pulled) const {
    const State s = state();
    std::size_t first = points_.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (pulled.of_points[i].z() > 0) continue;
      first = std::min(first, i);
      std::vector<GroundPoint> others = points_;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const GroundForces f = law_.forces(s, others);
      const double rise = acceleration(f, s, points_[i].place).z();
      if (f.of_points[0].z() > 0 && rise >= 0) return i;
    }
    return first;
  }

  /// The corner leaves the ground; the velocity that is kept is that of the first.
  void leave(std::size_t number) {
    const State s = state();
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(number));
    if (points_.empty()) return;
    slip_in(motion_) = slip_of(s, points_[0]).head<2>();
    motion_.tail<2>() = (s.position + s.attitude * points_[0].place).head<2>();
  }

  /// Goes through the last event; what ends the contact there, if it does.
  [[nodiscard]] std::optional<SustainedContact> pass_event() {
    const auto open = [this](const char* why) { return ended(ContactEnd::open, why); };
    if (event_ == Event::arrival) {
      if (points_.size() > 1) return open("a face comes down without speed");
      points_.push_back({static_cast<int>(number_), drop_.body.vertices[number_], false});
      hold(state());
      return ended(ContactEnd::joining, "");
    }
    const GroundForces f = forces(motion_);
    if (!f.is_unique || event_ == Event::digs_in) return open("slip digs in (Painlevé)");
    const bool is_pulled = std::ranges::any_of(f.of_points, [](const Vector3& force) { return !(force.z() > 0); });
    if (event_ == Event::lifts || is_pulled) {
      if (points_.size() > 1) {
        leave(event_ == Event::lifts ? number_ : rising(f));
        if (!keep_or_begin_slip()) return open(slip_is_open);
      } else if (!is_free()) {
        return ended(ContactEnd::lift_off, "");
      }
    }
    if (event_ == Event::gives_way && !give_way()) return open("friction no longer holds it there");
    for (const GroundPoint& p : points_) (p.sticks ? sticks_ : slips_) = true;
    event_ = Event::none;
    return {};
  }

  /// Steps on; whether what friction does thereafter is known.
  bool go_on() {
    step();
    keep_hinge();
    return law_.friction() == 0 || event_ != Event::none || stop_slips();
  }

  /// Whether a flat body lies on both its corners: at rest, or sliding and spinning so that friction never stops it.
  [[nodiscard]] bool lies() const {
    constexpr double balanced = 1e-9;
    if (points_.size() != 2 || !drop_.body.is_flat()) return false;
    const double turning = motion_.segment<2>(4).norm(), spin = std::fabs(motion_[6]);
    if (!(turning * reach_ <= no_slip * speed_scale())) return false;
    const GroundForces f = forces(motion_);
    if (!(f.turning.norm() * reach_ <= balanced * drop_.gravity)) return false;
    if (law_.friction() == 0) return true;
    return !slips() && spin * reach_ <= no_slip * speed_scale();
  }

  [[nodiscard]] SustainedContact ended(ContactEnd end, const std::string& reason) const {
    SustainedContact result;
    result.end = end;
    result.reason = reason;
    result.duration = time_;
    result.corners = corners_;
    result.after = state();
    result.slips = slips_ && law_.friction() > 0;
    result.sticks = sticks_;
    for (const GroundPoint& p : points_) result.pivots.push_back(p.index);
    if (end == ContactEnd::arrival) result.arriving = arriving();
    for (const int i : result.arriving) {
      result.approach_speed = std::fmax(result.approach_speed, -velocity_at(result.after, place(i)).z());
    }
    const double rise = result.after.velocity.z() - start_.velocity.z();
    result.normal_impulse = drop_.body.mass * (rise + drop_.gravity * time_);
    const double energy = mechanical_energy(drop_, result.after);
    result.energy_loss = given_ - energy;
    const double size = drop_.body.mass * speed_scale() * speed_scale();
    if (!(mechanical_energy(drop_, start_) - energy >= -1e-8 * size)) {
      throw NumericalError("a body that stays on the ground gains energy");
    }
    return result;
  }

  [[nodiscard]] bool is_free() const { return duration_ < detail::infinite; }

  struct StepDeleter {
    void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
  };

  const Drop& drop_;
  GroundLaw law_;
  double reach_, falling_;    ///< reach, √(reach/g)
  double given_;              ///< energy of the state given
  std::vector<int> corners_;  ///< at the beginning
  std::vector<GroundPoint> points_, began_with_;
  State start_;
  Motion motion_;
  double time_ = 0, length_ = 0;
  double duration_ = detail::infinite;  ///< of advance()
  bool slips_ = false, sticks_ = false;
  Event event_ = Event::none;
  std::size_t number_ = 0;
  double stiffness_ = 0;  ///< rate at which the direction of slip that begins is driven back [1/s]
  gsl_odeiv2_system system_{derivative, nullptr, GroundMotion::SizeAtCompileTime, this};
  std::unique_ptr<gsl_odeiv2_step, StepDeleter> step_{
      gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, GroundMotion::SizeAtCompileTime)};
};

using Changes = Eigen::Matrix<double, 9, 1>;  ///< of attitude, velocity, angular velocity

/// Part of a change that may be of second order.
constexpr double most_second_order = 0.02;

State shifted(const State& s, const Changes& by) {
  State other = s;
  other.attitude = turn_by(by.head<3>()) * s.attitude;
  other.velocity += by.segment<3>(3);
  other.angular_velocity += by.tail<3>();
  return other;
}

Changes change(const State& from, const State& to) {
  const Quaternion turn = to.attitude * from.attitude.conjugate();
  Changes c;
  c << std::copysign(2, turn.w()) * turn.vec(), to.velocity - from.velocity,
      to.angular_velocity - from.angular_velocity;
  return c;
}

/// The contact once more, and its neighbours.
class Neighbours {
 public:
  Neighbours(const Drop& drop, const State& now, const SustainedContact& contact)
      : drop_(drop), contact_(contact), base_(drop, now, contact.corners), start_(base_.state()),
        vertex_(contact.arriving.empty() ? 0 : contact.arriving.front()) {
    const double reach = drop.body.reach(), speed = base_.speed_scale();
    const double slip = base_.least_slip() / speed;  // its direction has to change little
    slips_ = base_.slips();
    sizes_ << Vector3::Ones(), Vector3::Constant(speed), Vector3::Constant(speed / reach);
    steps_ = std::fmin(1e-6, 1e-3 * slip) * sizes_;
    most_ = 1e-2 * std::fmin(1, slip) * sizes_;
    followed_ = base_.advance(contact.duration);
  }

  /// The state at the end, with bounds on its errors at exactly that time.
  [[nodiscard]] std::optional<StateInContact> at_end(const StateErrors& errors) const {
    if (!followed_) return {};
    StateInContact there{.state = base_.state(), .error = {}};
    if (!std::isfinite(errors.attitude + errors.velocity + errors.angular_velocity + errors.time)) return there;
    const ContactMotion::Rates rates = base_.rates(ContactEnd::arrival, vertex_);
    const Changes of_state = errors.in_each_direction().tail<9>();
    Changes all, drift;
    drift << there.state.angular_velocity, rates.acceleration, rates.turning;
    all = errors.time * drift.cwiseAbs();
    for (int k = 0; k < 9; ++k) {
      if (k == 5 || (!slips_ && k / 3 == 1)) continue;  // nothing is left of these where the corner is held
      const auto by = slope(k, of_state[k]);
      if (!by) return there;
      all += of_state[k] * by->state.cwiseAbs();
    }
    there.error = {.time = 0,
                   .attitude = all.head<3>().norm(),
                   .velocity = all.segment<3>(3).norm(),
                   .angular_velocity = all.tail<3>().norm()};
    return there;
  }

  /// Derivatives of time and state at the end by those at the beginning; nothing where errors are too large for that.
  [[nodiscard]] std::optional<ContactDerivatives> derivatives(const StateErrors& errors) const {
    const bool has_margin = contact_.end == ContactEnd::arrival || contact_.end == ContactEnd::lift_off;
    if (!followed_ || !has_margin) return {};
    const ContactMotion::Rates rates = base_.rates(contact_.end, vertex_);
    if (!(rates.margin < 0) && !lifts_at_once()) return {};
    const Changes of_state = errors.in_each_direction().tail<9>();
    const bool at_once = lifts_at_once();
    double push = 0;  // by which errors may change that of the ground
    Changes shift;    // of the end
    shift << base_.state().angular_velocity, rates.acceleration, rates.turning;
    ContactDerivatives d{.bend = std::fabs(rates.bend / rates.margin), .clearance = clearance()};
    d.of_state(0, 0) = 1;
    for (int k = 0; k < 9; ++k) {
      if (k == 5 || (!slips_ && k / 3 == 1)) continue;  // nothing is left of these where the corner is held
      const auto by = slope(k, of_state[k]);
      if (!by) return {};
      push += std::fabs(by->margin) * of_state[k];
      const double late = at_once ? 0 : -by->margin / rates.margin;
      d.of_state(0, k + 1) = late;
      d.of_state.block<9, 1>(1, k + 1) = by->state + late * shift;
    }
    if (!d.of_state.allFinite() || (at_once && !(base_.margin(contact_.end, vertex_) < -push))) return {};
    return d;
  }

 private:
  struct Slope {
    Changes state;
    double margin;
  };

  /// By the k-th number of the state; nothing where a neighbour as far off as the error is no longer of first order.
  /// Nearer ones serve where those that far off slip or stick otherwise.
  [[nodiscard]] std::optional<Slope> slope(int k, double error) const {
    constexpr double nearer = 1e-2;
    const double least = std::fmax(1e-9 * sizes_[k], error);
    double length = std::fmax(steps_[k], std::fmin(error, most_[k]));
    auto found = slope(k, error, length);
    while (!found && nearer * length >= least) length *= nearer, found = slope(k, error, length);
    return found;
  }

  [[nodiscard]] std::optional<Slope> slope(int k, double error, double length) const {
    const Changes step = length * Changes::Unit(k);
    ContactMotion plus(base_, shifted(start_, step)), minus(base_, shifted(start_, -step));
    if (!plus.advance(contact_.duration) || !minus.advance(contact_.duration)) return {};
    const State end = base_.state();
    const Changes up = change(end, plus.state()), down = change(end, minus.state());
    const double straight = (up - down).cwiseQuotient(sizes_).norm(), bent = (up + down).cwiseQuotient(sizes_).norm();
    const double noise = 1e-3 * length / sizes_[k];
    if (!(error / length * bent <= most_second_order * (straight + noise))) return {};
    if (!(parted(plus) <= noise) || !(parted(minus) <= noise)) return {};
    return Slope{.state = (up - down) / (2 * length),
                 .margin = (plus.margin(contact_.end, vertex_) - minus.margin(contact_.end, vertex_)) / (2 * length)};
  }

  /// How far apart the corners that come down together are, of the reach.
  [[nodiscard]] double parted(const ContactMotion& other) const {
    double most = 0;
    for (const int i : contact_.arriving) {
      most = std::fmax(most, std::fabs(other.margin(contact_.end, i) - other.margin(contact_.end, vertex_)));
    }
    return most / drop_.body.reach();
  }

  /// Least height of vertices that come down but have not.
  [[nodiscard]] double clearance() const {
    const State end = base_.state();
    const auto is_of = [](const std::vector<int>& some, int i) { return std::ranges::count(some, i) > 0; };
    double least = detail::infinite;
    for (int i = 0; i < static_cast<int>(drop_.body.vertices.size()); ++i) {
      if (is_of(contact_.pivots, i) || is_of(contact_.arriving, i)) continue;
      const Vector3& place = drop_.body.vertices[i];
      if (!(velocity_at(end, place).z() < 0)) continue;
      least = std::fmin(least, end.position.z() + (end.attitude * place).z());
    }
    return least;
  }

  /// The ground would have to pull from the start.
  [[nodiscard]] bool lifts_at_once() const {
    return contact_.end == ContactEnd::lift_off &&
           contact_.duration <= 1e-12 * std::sqrt(drop_.body.reach() / drop_.gravity);
  }

  const Drop& drop_;
  const SustainedContact& contact_;
  ContactMotion base_;
  State start_;
  int vertex_;
  Changes sizes_, steps_, most_;  ///< of what is changed; by how much at least and at most
  bool slips_, followed_;
};

}  // namespace

std::optional<StateInContact> contact_at(const Drop& drop, const State& now, const SustainedContact& contact,
                                         double time, const StateErrors& errors) {
  SustainedContact part;
  part.duration = time;
  part.corners = contact.corners;
  part.end = ContactEnd::arrival;
  auto there = Neighbours(drop, now, part).at_end(errors);
  if (!there) return {};
  const StateErrors rounding = contact_rounding(drop, now, part);
  there->error.attitude += 2 * rounding.attitude;
  there->error.velocity += 2 * rounding.velocity;
  there->error.angular_velocity += 2 * rounding.angular_velocity;
  return there;
}

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners) {
  return ContactMotion(drop, now, corners).follow();
}

std::optional<ContactDerivatives> contact_derivatives(const Drop& drop, const State& now,
                                                      const SustainedContact& contact, const StateErrors& errors) {
  if (!std::isfinite(errors.attitude + errors.velocity + errors.angular_velocity)) return {};
  return Neighbours(drop, now, contact).derivatives(errors);
}

StateErrors contact_rounding(const Drop& drop, const State& now, const SustainedContact& contact) {
  constexpr double accuracy = 1e-12;
  const double reach = drop.body.reach(), falling = std::sqrt(reach / drop.gravity);
  const double speed = reach / falling + now.angular_velocity.norm() * reach;
  const double rounding = accuracy * std::fmin(1, contact.duration / falling) + 8 * detail::epsilon;
  // What is left of normal velocity and slip is taken away.
  const Changes held = change(now, ContactMotion(drop, now, contact.corners).state());
  return {.time = rounding * contact.duration,
          .attitude = rounding + held.head<3>().norm(),
          .velocity = rounding * speed + held.segment<3>(3).norm(),
          .angular_velocity = rounding * speed / reach + held.tail<3>().norm()};
}

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners,
                                const StateErrors& errors) {
  SustainedContact contact = follow_contact(drop, now, corners);
  const auto d = contact_derivatives(drop, now, contact, errors);
  if (!d) return contact;
  const StateErrors rounding = contact_rounding(drop, now, contact);
  const Eigen::Matrix<double, 10, 1> bounds =
      d->of_state.cwiseAbs() * (errors.in_each_direction() + rounding.in_each_direction());
  if (!d->hold(drop.body, bounds[0] - errors.time, bounds.segment<3>(1).norm())) return contact;
  contact.error = {.time = bounds[0] + rounding.time,
                   .attitude = bounds.segment<3>(1).norm() + rounding.attitude,
                   .velocity = bounds.segment<3>(4).norm() + rounding.velocity,
                   .angular_velocity = bounds.tail<3>().norm() + rounding.angular_velocity};
  add_impulse_error(drop, errors, contact);
  return contact;
}

void add_impulse_error(const Drop& drop, const StateErrors& before, SustainedContact& contact) {
  contact.normal_impulse_error =
      drop.body.mass * (before.velocity + contact.error.velocity + drop.gravity * (before.time + contact.error.time));
}

bool can_follow(const Drop& drop, const std::vector<int>& corners) {
  const ImpactLaw& law = drop.law;
  const auto is_vertex = [&](int i) { return static_cast<std::size_t>(i) < drop.body.vertices.size(); };
  const bool one_or_two = corners.size() == 1 || corners.size() == 2;
  return one_or_two && std::ranges::all_of(corners, is_vertex) && drop.gravity > 0 && drop.gravity_along == 0 &&
         law.law != RestitutionLaw::viscoelastic && law.friction != FrictionKind::impulse_ratio;
}

std::optional<SustainedContact> contact_after(const Drop& drop, const Sequence& sequence) {
  if (!sequence.standing || !can_follow(drop, sequence.standing->corners)) return {};
  const Standing& standing = *sequence.standing;
  SustainedContact contact = follow_contact(drop, standing.state, standing.corners, standing.error);
  contact.rows = sequence.rows.size();
  contact.begin = standing.time;
  return contact;
}

}  // namespace clatter::analytic::space
