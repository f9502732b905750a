// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/sequence_loop.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/landing/level_rim.hpp"
#include "analytic/space/landing/striking_body.hpp"
#include "analytic/space/sequence/accumulation.hpp"
#include "analytic/space/sequence/ending.hpp"
#include "analytic/space/sequence/error_growth.hpp"
#include "analytic/space/sequence/impact_rows.hpp"
#include "analytic/space/sequence/sustained_contact.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;
using detail::missing;

namespace {

/// Sets `touches` to the row's corners with their normal velocities in the state after the impact; what is rounding of
/// zero is zero.
void find_departures(const Drop& drop, const ImpactRow& row, const State& after, std::vector<Touch>& touches) {
  const ImpactLaw& law = drop.law;
  const bool plastic = law.restitution == 0 && law.law != RestitutionLaw::viscoelastic;
  const VelocityRounding of_group(drop.body, row.before);
  touches.clear();
  for (const Corner& corner : row.corners) {
    const ContactVelocity velocity = contact_velocity(after, corner.place);
    const double turning = corner.radius * after.angular_velocity.head<2>().norm();  // of a level rim
    double normal = row.group ? velocity.value.z() - turning : row.impact.contact_after.z();
    // Several corners leave each other what is rounding of the impact.
    const double rounding =
        (row.group ? 64 : 16) * epsilon * velocity.scale + (row.group ? of_group.at(corner.place) : 0);
    if (std::fabs(normal) <= rounding && (row.group || plastic)) normal = 0;
    touches.push_back({corner.index, normal});
  }
}

/// Evaluations of the rotation in a sequence: a third of a second.
constexpr int most_evaluations = 1'000'000;
/// Contacts of corners that stay on the ground in a sequence.
constexpr std::size_t most_contacts = 10'000;
/// Angle that the body turns by during hops that are only summed up before a contact that lasts [rad].
constexpr double least_turn = 1e-8;
/// The same where corners rattle beside others that stay, whose heights are known to rounding only [rad].
constexpr double most_turn = 1e-5;

/// The loop of impacts, in internal units.
class Run : public SequenceLoop<Sequence, ErrorGrowth> {
 public:
  Run(const Drop& drop, const SequenceOptions& options, std::vector<double> times)
      : SequenceLoop(options, std::move(times)), drop_(drop), body_(drop_.body), principal_(body_.inertia),
        reach_(body_.reach()) {
    state_ = given_state(drop_);
  }

  Sequence run() {
    // An end that is asked for is where rows can no longer be predicted, whether their errors are wanted or not.
    if (options_.amplification || (options_.until_rest && !options_.until_face))
      growth_.emplace(body_, state_, drop_.gravity, drop_.gravity_along);
    FirstContact flown;
    const std::vector<int> lowest = drop_.release_height ? fall(flown) : touch_down();
    follow([&] { go_on(lowest, flown); });
    settle_after_all();
    result_.energy_at_end = energy(state_);
    bound_total();
    note_last_motion();
    note_sides();
    return std::move(result_);
  }

 private:
  /// Errors of rows, contacts and tail may be correlated: their sizes add up, and so does the rounding of each sum.
  /// What comes to rest for certain, at a time T between the last known state and Rest::latest, has taken m(g T − V_n)
  /// from the ground, V_n that of the first touch, in whatever order impacts followed.
  void bound_total() {
    const double total = result_.total_normal_impulse;
    const double rounding =
        epsilon * static_cast<double>(result_.rows.size() + 2 * result_.contacts.size() + 1) * total;
    double error = rounding;
    const auto add = [&](const std::optional<Tail>& tail) { error += tail ? tail->normal_impulse_error : 0; };
    for (const ImpactRow& row : result_.rows) error += row.error.impulse;
    for (const SustainedContact& contact : result_.contacts) error += contact.normal_impulse_error, add(contact.tail);
    add(result_.tail);
    if (result_.rest && end_is_certain_ && known_) {
      const ImpactRow& first = result_.rows.front();
      const auto until = [&](double time) { return body_.mass * (drop_.gravity * time - first.before.velocity.z()); };
      const double off = std::fmax(until(result_.rest->latest) - total, total - until(known_->time));
      error = std::fmin(error, off + rounding + first.error.impulse +
                                   body_.mass * (first.error.velocity_after + drop_.gravity * known_->error.time));
    }
    result_.total_normal_impulse_error = error;
  }

  /// Flies from the release to the first touch, from which on time counts; returns the points that touch.
  std::vector<int> fall(FirstContact& flown) {
    const FreeFlight flight(principal_, state_, drop_.gravity, drop_.gravity_along);
    flown = first_contact(body_, flight, {});
    result_.root_evaluations += flown.evaluations;
    if (flown.end != FlightEnd::contact) throw std::domain_error("the released body never reaches the ground");
    time_ = -(result_.first_flight = flown.time);
    way_error_ = epsilon * *drop_.release_height;
    while (awaits(time_)) note({}, false, {}, infinite);  // before the release
    note_flight(flight, Vector3::Zero(), 0);
    arrive(flight, flown, Vector3::Zero());  // the height of its centre of mass is given
    // Places count from where the body touches, those before that too.
    for (StateAt& before : result_.states) before.state.position.head<2>() -= state_.position.head<2>();
    state_.position.head<2>().setZero();
    time_ = 0;
    result_.first_flight_error = growth_ ? growth_->begin_time() : missing;
    first_is_open_ = !is_level(flown.together);
    return flown.together;
  }

  /// Puts the lowest points on the ground; returns those.
  std::vector<int> touch_down() {
    while (awaits(0)) note({}, false, {}, infinite);  // before the drop is known
    const FreeFlight flight(principal_, state_, 0);
    const PointHeights heights(body_, flight);
    const FlightMoment start = heights.moment(0);
    double least = std::numeric_limits<double>::infinity(), fastest = least;
    for (int i = 0; i < heights.count(); ++i) least = std::fmin(least, heights.at(i, start).height);
    std::vector<int> lowest;
    for (int i = 0; i < heights.count(); ++i) {
      const PointHeight h = heights.at(i, start);
      if (!(h.height - least <= 32 * epsilon * reach_)) continue;
      lowest.push_back(i);
      fastest = std::fmin(fastest, h.velocity);
    }
    if (!(fastest < 0)) {
      throw std::domain_error(
          "the first contact does not approach the ground: velocity and angular velocity must bring it down");
    }
    state_.position = Vector3(0, 0, -least);
    first_is_open_ = !is_level(lowest);
    return lowest;
  }

  /// Whether these vertices are level as far as their numbers say: two of them rise by no more than 8ε of the way
  /// between, beside the rounding of their places.
  [[nodiscard]] bool is_level(const std::vector<int>& corners) const {
    const Vector3 up = state_.attitude.toRotationMatrix().row(2);
    const auto place = [&](int i) -> const Vector3& { return body_.vertices[i]; };
    const auto is_round = [&](int i) { return static_cast<std::size_t>(i) >= body_.vertices.size(); };
    if (std::ranges::any_of(corners, is_round)) return true;
    return std::ranges::all_of(corners, [&](int i) {
      const Vector3 way = place(i) - place(corners.front());
      double rounding = 8 * epsilon * way.norm();
      for (int k = 0; k < 3; ++k) rounding += way[k] == 0 ? 0 : 2 * epsilon * std::fabs(up[k] * place(i)[k]);
      return std::fabs(up.dot(way)) <= rounding;
    });
  }

  enum class Next { impact, flight, end };

  void go_on(std::vector<int> arriving, FirstContact flown) {
    for (;;) {
      record(arriving, flown);
      if (options_.until_face && is_trapped()) return settle();
      const bool stays = accumulates();
      Next next = stays ? go_on_touching(arriving) : Next::flight;
      if (next == Next::end) return;
      if (is_full()) {
        if (next == Next::flight && awaits(infinite)) take_off();
        return note_slow_contacts();
      }
      if (!stays && options_.until_rest && is_still()) return settle();
      flown = {};
      while (next == Next::flight) next = fly(arriving, flown);
      if (next == Next::end) return;
    }
  }

  struct Flown {
    FreeFlight flight;
    Vector3 from;  ///< place that left the ground last, body frame
    FirstContact to;
  };

  /// The next flight, and the states in it that are asked for.
  Flown take_off() {
    const auto lifted = std::exchange(lifted_, {});
    Flown flown{FreeFlight(principal_, state_, drop_.gravity, drop_.gravity_along),
                lifted ? body_.vertices[*lifted] : result_.rows.back().corners.front().place,
                {}};
    flown.to = first_contact(body_, flown.flight, touches_);
    result_.root_evaluations += flown.to.evaluations;
    if (flown.to.end == FlightEnd::contact || flown.to.end == FlightEnd::no_contact)
      note_flight(flown.flight, flown.from, flown.to.end == FlightEnd::contact ? time_ + flown.to.time : infinite);
    return flown;
  }

  Next fly(std::vector<int>& arriving, FirstContact& flown) {
    const ImpactRow& last = result_.rows.back();
    const Flown now = take_off();
    flown = now.to;
    if (flown.end == FlightEnd::contact && is_over(time_ + flown.time)) return Next::end;
    if (result_.root_evaluations > most_evaluations) {
      throw NumericalError("the body spins so fast that its flights take more than a million evaluations");
    }
    if (flown.end != FlightEnd::contact) {
      end_without_contact(flown);
      return go_on_touching(arriving);
    }
    if (flown.time == 0 && last.impact.impulse.norm() == 0) {
      stall();
      return go_on_touching(arriving);
    }
    arriving = flown.together;
    arrive(now.flight, flown, now.from);
    return Next::impact;
  }

  /// Where corners stay on the ground while the body turns: follows them, if that is asked for, to what comes next.
  Next go_on_touching(std::vector<int>& arriving) {
    if (!options_.until_rest || !result_.standing || !can_follow(drop_, result_.standing->corners)) return Next::end;
    if (is_still() || (options_.until_face && is_trapped())) {
      result_.message.clear();
      settle();
      return Next::end;
    }
    if (result_.contacts.size() >= most_contacts) throw NumericalError("corners stay on the ground again and again");
    if (growth_ && !growth_->predictable()) regain(*result_.standing);
    SustainedContact contact = followed(*result_.standing);
    note_contact(*result_.standing, contact);
    const bool open = contact.end == ContactEnd::open;
    if (!open) contact.tail = std::exchange(result_.tail, {});
    result_.contacts.push_back(std::move(contact));
    const SustainedContact& now = result_.contacts.back();
    result_.total_normal_impulse += now.normal_impulse;
    time_ += now.duration;
    state_ = now.after;
    if (now.end == ContactEnd::rest) return end_lying(now);
    if (growth_ && growth_->predictable()) know(state_, time_, now.error);
    if (open) return end_open(now);
    result_.standing = {};
    result_.message.clear();
    result_.end_acceleration = 0;
    accumulation_ = {};
    for (const int corner : now.corners) rattling_.touch(corner);
    for (const int corner : now.pivots) rattling_.touch(corner);
    if (now.end == ContactEnd::lift_off) return lift_off(now.pivots.front());
    if (now.end == ContactEnd::joining) {
      result_.standing = Standing{time_, state_, now.error, now.pivots};
      return go_on_touching(arriving);
    }
    arriving = now.arriving;
    held_ = now.pivots;
    return Next::impact;
  }

  /// The last state that can be predicted.
  struct Known {
    State state;
    StateErrors error;
    double time = 0;
    std::size_t rows = 0, contacts = 0;  ///< that come before
  };

  void know(const State& state, double time, const StateErrors& error) {
    known_ = Known{state, error, time, result_.rows.size(), result_.contacts.size()};
  }

  /// Time and impulses since the last state that can be predicted, with what is left of hops, if nothing but these
  /// corners can have reached the ground since, in whatever order they have struck.
  [[nodiscard]] std::optional<Tail> since_known(const std::vector<int>& corners, double until,
                                                const std::optional<Tail>& hops) const {
    const auto stay = [&](const std::vector<int>& some) {
      return std::ranges::all_of(some, [&](int i) { return std::ranges::count(corners, i) > 0; });
    };
    if (!known_) return {};
    Tail since{.end_time = until - known_->time, .corners = corners};
    const auto add = [&](double normal, double tangential) {
      since.normal_impulse += normal;
      since.tangential_impulse.x() += tangential;
    };
    for (std::size_t i = known_->rows; i < result_.rows.size(); ++i) {
      const ImpactRow& row = result_.rows[i];
      for (const Corner& corner : row.corners) {
        if (!stay({corner.index})) return {};
      }
      add(row.impact.impulse.z(), row.impact.impulse.head<2>().norm());
    }
    const double friction = drop_.law.most_friction();
    for (std::size_t i = known_->contacts; i < result_.contacts.size(); ++i) {
      const SustainedContact& contact = result_.contacts[i];
      if (!stay(contact.corners) || !stay(contact.pivots)) return {};
      add(contact.normal_impulse, friction * contact.normal_impulse);
      if (contact.tail) add(contact.tail->normal_impulse, contact.tail->tangential_impulse.norm());
    }
    if (hops) add(hops->normal_impulse, hops->tangential_impulse.norm());
    if (!undisturbed(drop_, known_->state, since)) return {};
    return since;
  }

  /// Where errors decide in which order corners have struck, but only those that stay, the errors are what has happened
  /// since.
  void regain(Standing& standing) {
    const auto since = since_known(standing.corners, standing.time, result_.tail);
    if (!since) return;
    standing.error = errors_since(drop_, known_->state, known_->error, *since);
    growth_->restart(standing.error);
    regained_ = true;
  }

  /// Whether a tail's corners come to rest for certain, although errors decide the order of the last impacts.
  [[nodiscard]] bool ends_for_certain(Tail& tail) const {
    const auto since = since_known(tail.corners, tail.end_time, tail);
    if (!since) {
      tail.forget();
      return false;
    }
    const StateErrors errors = errors_since(drop_, known_->state, known_->error, *since);
    tail.end_time_error = errors.time;
    tail.normal_impulse_error = tail.tangential_impulse_error = body_.mass * errors.velocity;
    tail.velocity_error = errors.velocity;
    tail.angular_velocity_error = errors.angular_velocity;
    return true;
  }

  /// The contact of these corners, its errors carried on.
  SustainedContact followed(const Standing& standing) {
    SustainedContact contact = follow_contact(drop_, standing.state, standing.corners);
    contact.rows = result_.rows.size();
    contact.begin = standing.time;
    if (!growth_ || !growth_->predictable()) return contact;
    const StateErrors& all = standing.error;
    if (contact.end == ContactEnd::rest) {
      contact.error = errors_of_rest(all, contact);
      add_impulse_error(drop_, all, contact);
      return contact;
    }
    const StateErrors exact{.time = 0, .attitude = 0, .velocity = 0, .angular_velocity = 0};
    const auto derivatives = contact_derivatives(drop_, standing.state, contact, all);
    growth_->stay(contact, derivatives, std::exchange(regained_, false) ? exact : errors_of_hops(),
                  contact_rounding(drop_, standing.state, contact));
    contact.error = growth_->bounds();
    add_impulse_error(drop_, all, contact);
    return contact;
  }

  /// Bounds on the errors in which a slide that friction brings to rest ends, twice the first order of how it slows
  /// down.
  [[nodiscard]] StateErrors errors_of_rest(const StateErrors& begin, const SustainedContact& contact) const {
    const double slowing = drop_.law.most_friction() * drop_.gravity;
    StateErrors e = begin;
    if (slowing > 0 && contact.slips) e.time += 2 * (begin.velocity + reach_ * begin.angular_velocity) / slowing;
    e.attitude += 2 * contact.duration * begin.angular_velocity + contact.duration * contact.duration * 1e-12;
    if (slowing > 0) e.velocity = e.angular_velocity = 0;
    return e;
  }

  /// Height, velocity and acceleration of a corner that lifts off are zero: the flight begins when it has risen.
  Next lift_off(int corner) {
    const FreeFlight flight(principal_, state_, drop_.gravity, drop_.gravity_along);
    const double falling = std::sqrt(reach_ / drop_.gravity);
    for (double t = 1e-4 * falling; t > 1e-7 * falling; t /= 2) {
      State s = flight.at(t);
      double least = std::numeric_limits<double>::infinity();
      for (const Vector3& vertex : body_.vertices) least = std::fmin(least, s.position.z() + (s.attitude * vertex).z());
      if (!(least > 0)) continue;
      state_ = s;
      time_ += t;
      touches_.clear();
      lifted_ = corner;
      return Next::flight;
    }
    throw NumericalError("a corner that lifts off does not rise");
  }

  // States at the times that are asked for.

  /// @param height  bound on the error of the height, which the way along the ground adds to
  /// @param is_level  whether the body lies on a face or its ends
  void note(const std::optional<State>& state, bool touches, const StateErrors& error, double height,
            bool is_level = false) {
    StateAt at;
    at.time = times_[next_time_++];
    at.rows = result_.rows.size();
    at.touches = touches;
    at.is_known = state.has_value();
    if (state) {
      at.state = *state;
      at.energy = energy(*state);
      at.error = error;
      at.tilt_error = is_level ? 8 * epsilon : error.attitude;
      at.position_error = std::hypot(way_error_ + std::fabs(at.time - time_) * error.velocity, height);
      const Vector3& w = state->angular_velocity;
      const Matrix3 axes = state->attitude.toRotationMatrix();
      const Vector3 momentum = axes * (body_.inertia * (axes.transpose() * w));
      const double along = drop_.gravity_along != 0 ? at.position_error * std::fabs(drop_.gravity_along) : 0;
      at.energy_error = body_.mass * (state->velocity.norm() * error.velocity + drop_.gravity * height + along) +
                        momentum.norm() * error.angular_velocity + w.cross(momentum).norm() * error.attitude +
                        8 * epsilon * std::fabs(at.energy);
      if (std::isnan(at.energy_error)) at.energy_error = infinite;  // of no speed, with an unknown error
    }
    result_.states.push_back(std::move(at));
  }

  /// Notes the states of the flight from time_ until `end`.
  void note_flight(const FreeFlight& flight, const Vector3& from, double end) {
    while (awaits(end)) {
      const double after = std::fmax(times_[next_time_] - time_, 0.0);
      const auto errors = growth_ ? growth_->in_flight(flight, after, from) : ErrorGrowth::InFlight{};
      note(flight.at(after), false, errors.state, errors.height);
    }
  }

  void note_contact(const Standing& standing, const SustainedContact& contact) {
    const bool is_followed = growth_ && growth_->predictable();
    while (awaits(standing.time + contact.duration)) {
      const double after = std::fmax(times_[next_time_] - standing.time, 0.0);
      const auto there =
          contact_at(drop_, standing.state, contact, after, is_followed ? standing.error : StateErrors{});
      note(there ? std::optional(there->state) : std::nullopt, true, there ? there->error : StateErrors{},
           there ? body_.reach() * there->error.attitude : infinite);
    }
  }

  /// What the way along the ground errs by after a flight or contact, in which velocities and times erred by no more
  /// than these at its ends.
  void note_way(double duration, const State& start, const StateErrors& before, const StateErrors& after) {
    way_error_ += duration * std::fmax(before.velocity, after.velocity) +
                  start.velocity.head<2>().norm() * (before.time + after.time);
  }

  /// What is done after all, and the states meanwhile.
  void note_last_motion() {
    const bool has_ended = result_.outcome == Outcome::at_rest || result_.outcome == Outcome::sustained_contact;
    const bool is_followed = result_.standing && can_follow(drop_, result_.standing->corners);
    if (!has_ended || is_followed || lying_.empty()) {
      while (awaits(infinite)) note({}, true, {}, infinite);
      return;
    }
    const GroundedMotion motion(drop_, state_, lying_);
    result_.last_motion = motion.summary();
    if (result_.last_motion) {
      result_.last_motion->begin = time_, result_.last_motion->begin_error = end_errors_.time;
      if (result_.last_motion->kind == LastMotion::Kind::rests) lies_still();
    }
    const StateErrors& error = end_errors_;
    while (awaits(infinite)) {
      // Before time_ a sum stands for hops that are rounding of the heights.
      const double after = std::fmax(times_[next_time_] - time_, 0.0);
      const auto there = motion.summary() ? motion.at(after) : std::nullopt;
      StateErrors then = error;
      const double slowing = drop_.law.most_friction() * drop_.gravity + std::fabs(drop_.gravity_along);
      then.velocity += slowing * error.time;
      then.attitude += after * error.angular_velocity + state_.angular_velocity.norm() * error.time;
      const double turning = result_.last_motion && state_.angular_velocity.norm() > 0 ? 8 : 1;
      then.velocity *= turning;
      then.angular_velocity *= turning;
      then.time = 0;
      note(there, true, then, 8 * epsilon * reach_, true);
    }
  }

  /// Next to an impact errors decide on which side of it a state is.
  void note_sides() {
    for (StateAt& at : result_.states) {
      for (std::size_t i = 0; i < result_.rows.size() && at.is_known; ++i) {
        const ImpactRow& row = result_.rows[i];
        const bool is_beside = std::fabs(at.time - row.start) <= row.error.start && std::isfinite(row.error.start);
        if (!is_beside || row.start == 0) continue;
        at.beside = i + 1;
        at.error.velocity += (row.impact.velocity_after - row.before.velocity).norm();
        at.error.angular_velocity += (row.impact.angular_velocity_after - row.before.angular_velocity).norm();
        at.energy_error += std::fabs(row.impact.energy_loss);
      }
    }
  }

  /// A flat body lies on its corners, as far as friction lets it move on.
  Next end_lying(const SustainedContact& contact) {
    lying_ = contact.pivots;
    end_errors_ = contact.error;
    state_.velocity.z() = 0;
    state_.angular_velocity.head<2>().setZero();
    if (drop_.law.rubs()) {
      state_.velocity.setZero();
      state_.angular_velocity.setZero();
    }
    result_.standing = {};
    rest(false, slides(state_) || state_.angular_velocity.z() != 0, "bouncing and rocking have ended", "");
    return Next::end;
  }

  /// The law leaves open how the contact goes on; where it comes to rest can be known yet.
  Next end_open(const SustainedContact& contact) {
    result_.message += (result_.message.empty() ? "" : "; ") + contact.reason;
    result_.rest = settles(drop_, state_, time_);
    if (result_.rest) settle();
    else result_.outcome = Outcome::not_computed;  // the end that was asked for
    return Next::end;
  }

  /// The state before the impact: the height of the centre of mass is that of the corner that touches.
  void arrive(const FreeFlight& flight, const FirstContact& flown, const Vector3& from) {
    State now = flown.time > 0 ? flight.at(flown.time) : state_;
    const Corner corner = touching_corner(body_, now.attitude, flown.point);
    if (corner.radius > 0) now = levelled(body_, now, corner);
    const Vector3& place = corner.place;
    now.position.z() = -(now.attitude * place).z();
    if (growth_) {
      const bool is_asked = awaits(infinite);
      const StateErrors before = is_asked ? growth_->bounds() : StateErrors{};
      growth_->fly(flight, flown, from, place);
      if (is_asked) note_way(flown.time, flight.start(), before, growth_->bounds());
    }
    state_ = now;
    time_ += flown.time;
  }

  [[nodiscard]] double energy(const State& s) const { return mechanical_energy(drop_, s); }

  void record(const std::vector<int>& arriving, const FirstContact& flown) {
    ImpactRow row;
    row.start = time_;
    row.before = state_;
    row.energy_before = energy(state_);
    row.flight = flown;
    row.amplification = missing;
    for (const int point : arriving) row.corners.push_back(touching_corner(body_, state_.attitude, point));
    row.held = held_.size();
    for (const int point : std::exchange(held_, {})) {
      row.corners.push_back(touching_corner(body_, state_.attitude, point));
    }
    StrikeDerivatives derivatives;
    const bool follows = growth_ && growth_->predictable();
    strike_row(body_, drop_.law, row, follows ? &derivatives : nullptr);
    if (row.group && std::exchange(first_is_open_, false)) row.group->is_open = true;
    state_.velocity = row.impact.velocity_after;
    state_.angular_velocity = row.impact.angular_velocity_after;
    row.energy_after = energy(state_);
    find_departures(drop_, row, state_, touches_);
    result_.total_normal_impulse += row.impact.impulse.z();
    note_energy(row.impact.energy_loss, 1e-12);
    if (drop_.law.friction == FrictionKind::impulse_ratio) {
      const Vector2 push = row.impact.impulse.head<2>().normalized();
      note_push(push.dot(row.impact.contact_before.head<2>()), push.dot(row.impact.contact_after.head<2>()));
    }
    if (growth_) {
      growth_->strike([&](const State& before) { return struck_again(body_, drop_.law, row, before); }, derivatives,
                      row);
    }
    if (!result_.rows.empty()) accumulation_.add(row, damping_loss(drop_.law, row.impact.approach_speed));
    if (row.held > 0) rattling_.add(row);
    else
      for (const Corner& corner : row.corners) rattling_.touch(corner.index);
    result_.rows.push_back(std::move(row));
    if (result_.rows.back().error.predictable) know(state_, time_, errors_now());
  }

  /// Whether infinitely many impacts follow that need no more rows.
  bool accumulates() {
    const ImpactRow& last = result_.rows.back();
    if (auto tail = bouncing_tail(drop_, last)) {
      if (bounces_on(last.impact.velocity_after.z(), drop_.gravity, tail->end_time)) return false;
      if (last.impact.velocity_after.z() == 0) rest_as_it_is("no rebound");
      else finish(std::move(*tail));
      return true;
    }
    return may_accumulate(drop_.law) && drop_.gravity > 0 && (rattled_end() || extrapolated_end());
  }

  /// Whether corners beside others that stay have come down often enough to tell how that ends.
  bool rattled_end() {
    const ImpactRow& last = result_.rows.back();
    if (last.held == 0) return false;
    constexpr double roundings = 16;
    const double resolution = roundings * epsilon * reach_;
    auto tail = rattling_.extrapolate(drop_, {std::pow(10.0, -options_.digits), resolution});
    if (!tail || !undisturbed(drop_, state_, *tail) || !keeps_slipping(drop_, last, *tail)) return false;
    const double turned = tail->end_time * state_.angular_velocity.norm();
    if (!body_.lies_on(tail->corners.size()) && turned > most_turn) return false;
    if (is_watched(time_ + tail->end_time) && !is_rounding(tail->end_time)) return false;
    rattling_.forget();
    tail->end_time += time_;
    finish(std::move(*tail));
    return true;
  }

  bool extrapolated_end() {
    const ImpactRow& last = result_.rows.back();
    // Heights that are rounding know the next arrivals no better, however long the rows go on.
    constexpr double roundings = 16;
    const double unknown = last.flight.is_hop ? 0 : roundings * last.flight.time_error;
    auto tail = extrapolated(accumulation_, {time_, unknown, unknown / last.flight.time * last.impact.impulse.z()});
    if (!tail || !undisturbed(drop_, state_, *tail)) return false;
    const bool vanishes = tail->end_time <= std::fmax(unknown, 4 * epsilon * time_);
    // What follows the hops begins from the attitude at their end, which is known to first order in what is left.
    const double turned = tail->end_time * state_.angular_velocity.norm();
    if (options_.until_rest && !vanishes && !body_.lies_on(tail->corners.size()) && turned > least_turn) return false;
    if (!vanishes && (!keeps_slipping(drop_, last, *tail) || is_watched(time_ + tail->end_time))) return false;
    end_state(drop_, last, accumulation_.lever(*tail), *tail);
    tail->end_time += time_;
    finish(std::move(*tail));
    return true;
  }

  /// Whether the body moves along the ground, as far as an extrapolation can tell, or begins to where that slopes.
  [[nodiscard]] bool slides(const State& end, double error = 0) const {
    return end.velocity.head<2>().norm() > error || slides_down(drop_.law, drop_.gravity, drop_.gravity_along);
  }

  /// Whether a face that settles() does not hold on sloping ground may turn over one of its edges.
  [[nodiscard]] bool tips(const std::vector<int>& face) const { return drop_.gravity_along != 0 && face.size() > 1; }

  /// Whether hops in this time rise by no more than heights are rounded.
  [[nodiscard]] bool is_rounding(double time) const { return drop_.gravity * time * time <= 64 * epsilon * reach_; }

  /// The state in which hops end.
  [[nodiscard]] State end_of(const Tail& tail) const {
    State end = state_;
    end.position.head<2>() += (tail.end_time - time_) / 2 * (state_.velocity + tail.velocity_after).head<2>();
    end.velocity = tail.velocity_after;
    end.angular_velocity = tail.angular_velocity_after;
    const Vector3 turn =
        turn_on(tail.corners, (tail.end_time - time_) / 2 * (state_.angular_velocity + end.angular_velocity));
    if (turn.norm() > 0) {
      end.attitude = (turn_by(turn) * end.attitude).normalized();
      end.position.z() = -(end.attitude * touching_place(body_, end.attitude, tail.corners.front())).z();
    }
    return end;
  }

  /// What is left of a turn whose beginning and end have all these points on the ground.
  [[nodiscard]] Vector3 turn_on(const std::vector<int>& points, Vector3 turn) const {
    const Corner first = touching_corner(body_, state_.attitude, points.front());
    if (body_.lies_on(points.size()) || first.radius > 0) {
      turn.head<2>().setZero();
    } else if (points.size() == 2) {
      const Vector3 edge = state_.attitude * (touching_place(body_, state_.attitude, points[1]) - first.place);
      const Vector3 across = Vector3::UnitZ().cross(edge).normalized();
      turn -= turn.dot(across) * across;
    }
    return turn;
  }

  void finish(Tail tail) {
    const State end = end_of(tail);
    const bool slides_on = slides(end, tail.tangential_impulse_error / body_.mass);
    tail.energy_loss = energy(state_) - energy(end);
    result_.rest = settles(drop_, end, tail.end_time);
    const bool goes_down = result_.rest && is_followed_down(tail);
    if (goes_down) {
      settling_ = std::exchange(result_.rest, {});
      end_is_certain_ = true;
    }
    if (!growth_) tail.forget();
    else if (growth_->predictable()) add_errors(drop_, result_.rows.back(), tail);
    else
      end_is_certain_ = ends_for_certain(tail) || settling_ || rests_for_certain();  // the first says what of the tail
    const bool turns =
        !result_.rest && (goes_down || tips(tail.corners) || tail.angular_velocity_after != Vector3::Zero());
    const bool spins = tail.angular_velocity_after.z() != 0;
    const bool comes_down = result_.rest && tail.corners.size() < result_.rest->corners.size();
    const std::string stays = which_stays(tail.corners, end);
    end_errors_ = errors_after(tail);
    way_error_ += (tail.end_time - time_) * (end_errors_.velocity + (end.velocity - state_.velocity).head<2>().norm());
    state_ = end;
    if (!result_.rest || body_.lies_on(tail.corners.size()))
      lying_ = result_.rest ? result_.rest->corners : tail.corners;
    if (body_.lies_on(tail.corners.size())) {
      state_.velocity.z() = 0;
      state_.angular_velocity.head<2>().setZero();
    }
    time_ = tail.end_time;
    if (turns) result_.standing = Standing{time_, state_, errors_after(tail), tail.corners};
    end_in(std::move(tail), turns, slides_on || spins, stays, comes_down ? ", then the body settles on a face" : "");
  }

  /// Whether the end is asked for and can be told of a body that has to settle on a face, but has not yet.
  [[nodiscard]] bool is_followed_down(const Tail& tail) const {
    return options_.until_rest && !body_.lies_on(tail.corners.size()) && can_follow(drop_, tail.corners) && growth_ &&
           growth_->predictable();
  }

  /// A body that had to settle has done so where its last motion cannot be told.
  void settle_after_all() {
    const bool is_lost = result_.outcome == Outcome::not_computed || result_.outcome == Outcome::impact_limit ||
                         result_.outcome == Outcome::sustained_contact;
    if (!settling_ || !is_lost || result_.rows.empty()) return;
    result_.rest = settling_;
    result_.standing = {};
    lying_.clear();
    rest(false, slides(state_) || state_.angular_velocity.z() != 0, "the body settles on a face", "");
  }

  /// Error of the attitude in which bounces end, from the second order of the turn meanwhile and the error of its time.
  [[nodiscard]] double turn_error(const Tail& tail, double time_error) const {
    const double turning = tail.angular_velocity_after.norm();
    const double turned = turning * (tail.end_time - result_.rows.back().start);
    return turned * turned + turning * time_error;
  }

  /// What hops before a contact add to the errors of the last row's state.
  [[nodiscard]] StateErrors errors_of_hops() const {
    StateErrors e{.time = 0, .attitude = 0, .velocity = 0, .angular_velocity = 0};
    if (!result_.tail) return e;
    const Tail& tail = *result_.tail;
    const RowErrors& row = result_.rows.back().error;
    e.time = std::fmax(tail.end_time_error - row.start, 0.0);
    e.attitude = turn_error(tail, e.time);
    e.velocity = std::fmax(tail.velocity_error - row.velocity_after, 0.0);
    e.angular_velocity = std::fmax(tail.angular_velocity_error - row.angular_velocity_after, 0.0);
    return e;
  }

  /// Bounds on the errors of the last row's state after the impact.
  [[nodiscard]] StateErrors errors_now() const {
    if (!growth_ || !growth_->predictable()) return {};
    const RowErrors& e = result_.rows.back().error;
    return {e.start, e.attitude, e.velocity_after, e.angular_velocity_after};
  }

  /// The same at the end of bounces.
  [[nodiscard]] StateErrors errors_after(const Tail& tail) const {
    StateErrors e = errors_now();
    e.attitude += turn_error(tail, tail.end_time_error);
    e.time = tail.end_time_error;
    e.velocity = tail.velocity_error;
    e.angular_velocity = tail.angular_velocity_error;
    return e;
  }

  /// Whether what bouncing and rocking is left is rounding of the heights, on a face that the body cannot leave.
  bool is_still() {
    if (!(vertical_energy(drop_, state_) <= 64 * epsilon * body_.mass * drop_.gravity * reach_)) return false;
    if (body_.vertices.size() == 2) result_.rest = Rest{.corners = {0, 1}, .latest = time_};
    else result_.rest = settles(drop_, state_, time_);
    return result_.rest.has_value();
  }

  /// Whether the body can no longer leave the face below it.
  bool is_trapped() {
    const Vector3 turning = state_.attitude.conjugate() * state_.angular_velocity;
    const double above = state_.velocity.z() * state_.velocity.z() / 2 + drop_.gravity * state_.position.z() +
                         turning.dot(body_.inertia * turning) / (2 * body_.mass);
    if (!(above < drop_.gravity * reach_)) return false;  // else it may still turn over any of its edges
    result_.rest = settles(drop_, state_, time_);
    return result_.rest.has_value();
  }

  /// Ends on the face found.
  void settle() {
    end_is_certain_ = settling_ || (growth_ && growth_->predictable()) || rests_for_certain();
    result_.standing = {};
    lie_still();
    rest(false, slides(state_) || state_.angular_velocity.z() != 0,
         result_.message.empty() ? "bouncing and rocking have ended" : result_.message, "");
  }

  /// What is left of bouncing and rocking is rounding, and no part of the motion that follows.
  void lie_still() {
    const double energy = vertical_energy(drop_, state_);
    if (!(energy <= 64 * epsilon * body_.mass * drop_.gravity * reach_)) return;
    lying_ = result_.rest->corners;
    end_errors_ = errors_now();
    end_errors_.velocity += std::sqrt(2 * energy / body_.mass);
    end_errors_.attitude += energy / (body_.mass * drop_.gravity * reach_) * 64;
    state_.velocity.z() = 0;
    state_.angular_velocity.head<2>().setZero();
    const double rounding = 1e-12 * std::sqrt(drop_.gravity * reach_);
    if (state_.velocity.norm() <= rounding) state_.velocity.setZero();
    if (state_.angular_velocity.norm() * reach_ <= rounding) state_.angular_velocity.setZero();
    lie_level();
  }

  /// Turns the body by what its corners below still lack of lying level, and puts them on the ground.
  void lie_level() {
    const auto place = [&](std::size_t i) -> const Vector3& { return body_.vertices[lying_[i]]; };
    Vector3 from, to;  // a direction of the body as it is and as it would be
    if (lying_.size() == 2) {
      to = from = state_.attitude * (place(1) - place(0));
      to.z() = 0;
    } else {
      to = Vector3(0, 0, 1);
      from = state_.attitude * (place(1) - place(0)).cross(place(2) - place(0));
      if (from.z() < 0) from = -from;
    }
    state_.attitude = (Quaternion::FromTwoVectors(from, to) * state_.attitude).normalized();
    state_.position.z() = -(state_.attitude * place(0)).z();
  }

  /// Whether the body already had to come to rest on that face in the last state that can be predicted.
  bool rests_for_certain() {
    if (!result_.rest || !known_) return false;
    const auto then = settles(drop_, known_->state, known_->time);
    if (!then || !std::ranges::is_permutation(then->corners, result_.rest->corners)) return false;
    result_.rest->latest = std::fmax(result_.rest->latest, then->latest);
    return true;
  }

  void rest_as_it_is(const std::string& how) {
    result_.rest = settles(drop_, state_, time_);
    std::vector<int> corners, staying;
    for (const Touch& touch : touches_) {
      corners.push_back(touch.point);
      const ContactVelocity v = contact_velocity(state_, touching_place(body_, state_.attitude, touch.point));
      if (touch.normal_velocity == 0 || std::fabs(v.value.z()) <= 64 * epsilon * v.scale)
        staying.push_back(touch.point);
    }
    const bool turns = !result_.rest && (tips(corners) || state_.angular_velocity != Vector3::Zero());
    lying_ = result_.rest ? result_.rest->corners : staying;
    end_errors_ = errors_now();
    if (turns) result_.standing = Standing{time_, state_, errors_now(), staying};
    rest(turns, slides(state_), how, which_stays(corners, state_));
  }

  void end_without_contact(const FirstContact& flown) {
    if (growth_) growth_->end_without_contact(flown);
    if (flown.end == FlightEnd::stays_touching) {
      result_.end_acceleration = flown.acceleration;
      return rest_as_it_is("no rebound");
    }
    end_in_flight(flown.near_miss);
  }

  /// Damped ground, whose bounces are no geometric series.
  void note_slow_contacts() {
    if (drop_.law.law != RestitutionLaw::viscoelastic) return;
    result_.message += "; on damped ground slow contacts lose next to nothing, so that hops last for ever";
  }

  /// Corners approach, but so slowly that no impulse comes of it.
  void stall() {
    if (growth_) growth_->give_up();
    rest_as_it_is("what is left of the corners' approach is rounding");
  }

  [[nodiscard]] std::string which_stays(const std::vector<int>& corners, const State& end) const {
    if (tips(corners) && end.angular_velocity == Vector3::Zero()) return "whether it tips over an edge is not computed";
    const auto before = body_.vertices.size(), first = static_cast<std::size_t>(corners.front());
    if (first >= before + body_.rims.size()) {
      const ContactVelocity v = contact_velocity(end, touching_place(body_, end.attitude, corners.front()));
      return v.value.head<2>().norm() > 1e-6 * v.scale
                 ? "the body slides and turns on its round surface"
                 : "the body rolls or spins on without slip (Coulomb's law takes no energy from that)";
    }
    const char* const which = first >= before       ? "its rim rolls or slides"
                              : corners.size() == 1 ? "a corner stays"
                              : corners.size() == 2 ? "two corners stay"
                                                    : "it stays";
    return std::string("the body still turns while ") + which + " on the ground";
  }

  const Drop drop_;
  const Body& body_;
  PrincipalAxes principal_;
  double reach_;
  State state_;
  double time_ = 0;
  std::vector<Touch> touches_;
  std::vector<int> held_;  ///< corners that are on the ground at the next impact
  SpaceAccumulation accumulation_;
  Rattling rattling_;
  std::optional<Known> known_;
  double way_error_ = 0;          ///< bound on that of the place along the ground [m]
  std::optional<Rest> settling_;  ///< the face on which the body has to come to rest, once that is known
  std::vector<int> lying_;        ///< points on which the body lies in the end
  StateErrors end_errors_;        ///< of the state then
  std::optional<int> lifted_;     ///< the corner that a contact's end has left last
  bool first_is_open_ = false;    ///< heights that touch down together differ by more than the rounding of the attitude
  bool regained_ = false;         ///< errors were begun anew for the contact that follows
};

/// @throws std::domain_error naming the first time that is not finite, or earlier than the one before.
void require_ascending(const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto name = [i] { return "times[" + std::to_string(i) + "]"; };
    if (!std::isfinite(times[i])) detail::refuse(name(), times[i], "finite");
    if (i > 0 && times[i] < times[i - 1]) detail::refuse(name(), times[i], "no earlier than the time before it");
  }
}

}  // namespace

Sequence impact_sequence(const Drop& drop, const SequenceOptions& options, const std::vector<double>& times) {
  drop.validate();
  options.validate();
  require_ascending(times);
  const SequenceUnits units(drop);
  const Drop internal = units.to_internal(drop);
  try {
    internal.validate();
  } catch (const std::domain_error&) {
    throw NumericalError("the ratio of the drop's speeds, lengths or gravity is beyond double precision");
  }
  const SequenceOptions own = units.to_internal(options);
  std::vector<double> own_times;
  for (const double time : times) own_times.push_back(units.to_internal(time));
  Run run(internal, own, std::move(own_times));
  Sequence sequence = run.run();
  units.to_si(sequence);
  require_representable(sequence);
  const Unphysical& found = run.unphysical();
  std::string warning = law_warning(drop.law.friction, found, units.energy(found.created));
  if (!warning.empty()) sequence.warnings.push_back(std::move(warning));
  return sequence;
}

}  // namespace clatter::analytic::space
