// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/space/accumulation.hpp"
#include "analytic/space/error_growth.hpp"
#include "analytic/space/first_contact.hpp"
#include "analytic/space/impact_rows.hpp"
#include "analytic/space/level_rim.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::missing;

namespace {

Impact impact_of(const GroupImpact& group, const State& before, const Vector3& place) {
  const Vector3 arm = before.attitude * place;
  return {.impulse = group.impulse,
          .contact_before = before.velocity + before.angular_velocity.cross(arm),
          .contact_after = group.velocity_after + group.angular_velocity_after.cross(arm),
          .velocity_after = group.velocity_after,
          .angular_velocity_after = group.angular_velocity_after,
          .compression_impulse = missing,
          .slip_stop_impulse = missing,
          .least_slip = missing,
          .energy_loss = group.energy_loss,
          .path = group.path};
}

}  // namespace

namespace {

/// Without an attitude, which a ball does not need, rounding cannot move its lowest point out of the vertical.
State aligned(const Body& body, State state) {
  if (body.is_ball()) state.attitude.setIdentity();
  return state;
}

}  // namespace

/// Fills in the impact of the row's corners from the state before: one corner, or a group of corners or a level rim.
/// @throws as strike() and strike_together()
/// @param derivatives  of the impact, if asked for; NaN for a group or a level rim
void strike_row(const Body& body, const Law& law, ImpactRow& row, StrikeDerivatives* derivatives) {
  Corner corner = row.corners.front();
  if (row.corners.size() > 1 || corner.radius > 0) {
    row.group = strike_together(body, row.before, row.corners, law);
    row.impact = impact_of(*row.group, row.before, corner.place);
    row.approach_speed = row.group->approach_speed;
    if (derivatives != nullptr) derivatives->setConstant(missing);
    return;
  }
  const State before = aligned(body, row.before);
  if (body.is_ball()) corner = touching_corner(body, before.attitude, corner.index);
  ContactVelocity velocity = contact_velocity(before, corner.place);
  // Slip that is rounding would have a ball that rolls slip again.
  if (body.is_ball() && velocity.value.head<2>().norm() <= 16 * epsilon * velocity.scale) {
    velocity.value.head<2>().setZero();
  }
  // A small hop knows its normal velocity better; but an impact keeps the energy only with the velocity of its place,
  // which the attitude's rounding turns along a rim that is almost level.
  const double steep = steepness(body, before.attitude, corner.index);
  if (row.flight.time > 0 && row.flight.velocity_error < 2 * epsilon * velocity.scale / steep &&
      std::fabs(row.flight.normal_velocity) <= 1e3 * steep * velocity.scale) {
    velocity.value.z() = row.flight.normal_velocity;
  }
  row.impact = derivatives != nullptr ? strike(body, before, velocity, corner, law, *derivatives)
                                      : strike(body, before, velocity, corner.place, law);
  row.approach_speed = -velocity.value.z();
}

/// The impact of the same corners from a neighbouring state, by which the row's errors are carried on.
Impact struck_again(const Body& body, const Law& law, const ImpactRow& row, const State& before) {
  const Corner& corner = row.corners.front();
  if (row.group) return impact_of(strike_together(body, before, row.corners, law), before, corner.place);
  const State state = aligned(body, before);
  return strike(body, state, touching_place(body, state.attitude, corner.index), law);
}

/// Sets `touches` to the row's corners with their normal velocities in the state after the impact; what is rounding of
/// zero is zero.
void find_departures(const Law& law, const ImpactRow& row, const State& after, std::vector<Touch>& touches) {
  const bool plastic = law.law.restitution == 0 && law.law.law != RestitutionLaw::viscoelastic;
  touches.clear();
  for (const Corner& corner : row.corners) {
    const ContactVelocity velocity = contact_velocity(after, corner.place);
    const double turning = corner.radius * after.angular_velocity.head<2>().norm();  // of a level rim
    double normal = row.group ? velocity.value.z() - turning : row.impact.contact_after.z();
    const bool rounding = std::fabs(normal) <= 16 * epsilon * velocity.scale;
    if (rounding && (row.group || plastic)) normal = 0;
    touches.push_back({corner.index, normal});
  }
}

namespace {

/// Of the rotation, in a sequence: a third of a second.
constexpr int most_evaluations = 1'000'000;

/// The loop of impacts, in internal units.
class Run : public SequenceLoop<Sequence, ErrorGrowth> {
 public:
  Run(const Drop& drop, const SequenceOptions& options)
      : SequenceLoop(options), drop_(drop), body_(drop_.body), principal_(body_.inertia), reach_(body_.reach()) {
    state_.attitude = drop.attitude.normalized();
    state_.velocity = drop.velocity;
    state_.angular_velocity = drop.angular_velocity;
  }

  Sequence run() {
    const std::vector<int> lowest = touch_down();
    if (options_.amplification) growth_.emplace(body_, state_, drop_.gravity);
    follow([&] { go_on(lowest); });
    return std::move(result_);
  }

 private:
  /// Puts the lowest points on the ground; returns those.
  std::vector<int> touch_down() {
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
    return lowest;
  }

  void go_on(std::vector<int> arriving) {
    FirstContact flown;
    for (;;) {
      record(arriving, flown);
      if (accumulates()) return;
      if (is_full()) return note_slow_contacts();
      const ImpactRow& last = result_.rows.back();
      const FreeFlight flight(principal_, state_, drop_.gravity);
      flown = first_contact(body_, flight, touches_);
      result_.evaluations += flown.evaluations;
      if (result_.evaluations > most_evaluations) {
        throw NumericalError("the body spins so fast that its flights take more than a million evaluations");
      }
      if (flown.end != FlightEnd::contact) return end_without_contact(flown);
      if (flown.time == 0 && last.impact.impulse.norm() == 0) return stall();
      arriving = flown.together;
      arrive(flight, flown, last.corners.front().place);
    }
  }

  /// The state before the impact: the height of the centre of mass is that of the corner that touches.
  void arrive(const FreeFlight& flight, const FirstContact& flown, const Vector3& from) {
    State now = flown.time > 0 ? flight.at(flown.time) : state_;
    const Corner corner = touching_corner(body_, now.attitude, flown.point);
    if (corner.radius > 0) now = levelled(body_, now, corner);
    const Vector3& place = corner.place;
    now.position.z() = -(now.attitude * place).z();
    if (growth_) growth_->fly(flight, flown, from, place);
    state_ = now;
    time_ += flown.time;
  }

  [[nodiscard]] double energy(const State& s) const {
    const Vector3 w = s.attitude.conjugate() * s.angular_velocity;
    return body_.mass * (drop_.gravity * s.position.z() + s.velocity.squaredNorm() / 2) + w.dot(body_.inertia * w) / 2;
  }

  void record(const std::vector<int>& arriving, const FirstContact& flown) {
    ImpactRow row;
    row.start = time_;
    row.before = state_;
    row.energy_before = energy(state_);
    row.flight = flown;
    row.amplification = missing;
    row.error = RowErrors::unknown();
    for (const int point : arriving) row.corners.push_back(touching_corner(body_, state_.attitude, point));
    StrikeDerivatives derivatives;
    const bool follows = growth_ && growth_->predictable();
    strike_row(body_, drop_.law, row, follows ? &derivatives : nullptr);
    state_.velocity = row.impact.velocity_after;
    state_.angular_velocity = row.impact.angular_velocity_after;
    row.energy_after = energy(state_);
    find_departures(drop_.law, row, state_, touches_);
    result_.total_normal_impulse += row.impact.impulse.z();
    note_energy(row.impact.energy_loss, 1e-12);
    if (growth_) {
      growth_->strike([&](const State& before) { return struck_again(body_, drop_.law, row, before); }, derivatives,
                      row);
    }
    if (!result_.rows.empty()) accumulation_.add(row, damping_loss(drop_.law.law, row.approach_speed));
    result_.rows.push_back(std::move(row));
  }

  /// Whether infinitely many impacts follow that need no more rows.
  bool accumulates() {
    const ImpactRow& last = result_.rows.back();
    if (auto tail = bouncing_tail(drop_, last)) {
      if (bounces_on(last.impact.velocity_after.z(), drop_.gravity)) return false;
      finish(std::move(*tail));
      return true;
    }
    return may_accumulate(drop_.law.law) && drop_.gravity > 0 && extrapolated_end();
  }

  bool extrapolated_end() {
    const ImpactRow& last = result_.rows.back();
    // Heights that are rounding know the next arrivals no better, however long the rows go on.
    constexpr double roundings = 16;
    const double unknown = last.flight.is_hop ? 0 : roundings * last.flight.time_error;
    auto tail = extrapolated(accumulation_, {time_, unknown, unknown / last.flight.time * last.impact.impulse.z()});
    if (!tail || !undisturbed(drop_, state_, *tail)) return false;
    const bool vanishes = tail->end_time <= std::fmax(unknown, 4 * epsilon * time_);
    if (!vanishes && !keeps_slipping(body_, last, *tail)) return false;
    end_state(drop_, last, accumulation_.lever(*tail), *tail);
    tail->end_time += time_;
    finish(std::move(*tail));
    return true;
  }

  void finish(Tail tail) {
    State end = state_;
    end.velocity = tail.velocity_after;
    end.angular_velocity = tail.angular_velocity_after;
    result_.rest = settles(drop_, end, tail.end_time);
    if (!growth_) tail.forget();
    else if (growth_->predictable()) add_errors(drop_, result_.rows.back(), tail);
    else end_is_certain_ = ends_for_certain(drop_, result_.rows, tail) || rests_for_certain();
    const bool slides = tail.velocity_after.head<2>() != Vector2::Zero();
    const bool turns = !result_.rest && tail.angular_velocity_after != Vector3::Zero();
    const bool spins = tail.angular_velocity_after.z() != 0;
    const bool comes_down = result_.rest && tail.corners.size() < result_.rest->corners.size();
    const std::string stays = which_stays(tail.corners, end);
    end_in(std::move(tail), turns, slides || spins, stays, comes_down ? ", then the body settles on a face" : "");
  }

  /// Whether the body already had to come to rest on that face after the last impact that can be predicted.
  bool rests_for_certain() {
    const std::size_t known = known_rows(result_.rows);
    if (!result_.rest || known == 0) return false;
    const ImpactRow& last = result_.rows[known - 1];
    const auto then = settles(drop_, state_after(last), last.start);
    if (!then || !std::ranges::is_permutation(then->corners, result_.rest->corners)) return false;
    result_.rest->latest = std::fmax(result_.rest->latest, then->latest);
    return true;
  }

  void rest_as_it_is(const std::string& how) {
    result_.rest = settles(drop_, state_, time_);
    std::vector<int> corners;
    for (const Touch& touch : touches_) corners.push_back(touch.point);
    const bool turns = !result_.rest && state_.angular_velocity != Vector3::Zero();
    rest(turns, state_.velocity.head<2>() != Vector2::Zero(), how, which_stays(corners, state_));
  }

  void end_without_contact(const FirstContact& flown) {
    if (growth_) growth_->end_without_contact(flown);
    if (flown.end == FlightEnd::stays_touching) {
      result_.end_acceleration = flown.acceleration;
      return rest_as_it_is("no rebound");
    }
    end_in_flight(flown.near_miss);
  }

  /// Of damped ground, whose hops are no geometric series.
  void note_slow_contacts() {
    if (drop_.law.law.law != RestitutionLaw::viscoelastic) return;
    result_.message += "; on damped ground slow contacts lose next to nothing, so that hops last for ever";
  }

  /// Corners approach, but so slowly that no impulse comes of it.
  void stall() {
    if (growth_) growth_->give_up();
    rest_as_it_is("what is left of the corners' approach is rounding");
  }

  [[nodiscard]] std::string which_stays(const std::vector<int>& corners, const State& end) const {
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
  SpaceAccumulation accumulation_;
};

}  // namespace

Sequence impact_sequence(const Drop& drop, const SequenceOptions& options) {
  drop.validate();
  options.validate();
  const SequenceUnits units(drop);
  const Drop internal = units.to_internal(drop);
  try {
    internal.validate();
  } catch (const std::domain_error&) {
    throw NumericalError("the ratio of the drop's speeds, lengths or gravity is beyond double precision");
  }
  Run run(internal, options);
  Sequence sequence = run.run();
  units.to_si(sequence);
  require_representable(sequence);
  if (run.created().first > 0) {
    sequence.warnings.push_back(energy_warning(drop.law.law.friction, run.created(), units.energy(run.created().sum)));
  }
  return sequence;
}

}  // namespace clatter::analytic::space
