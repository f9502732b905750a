// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/sequence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/sequence_loop.hpp"
#include "analytic/plane/accumulation.hpp"
#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/error_growth.hpp"
#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

using detail::infinite;
using detail::missing;

namespace {

/// In units of its own length and speed, gravity and the other speeds must still be numbers.
void require_representable(const Drop& drop, const Drop& internal) {
  const PlanarVelocity& v = internal.velocity;
  const bool keeps_gravity = std::isfinite(internal.gravity) && (internal.gravity > 0) == (drop.gravity > 0) &&
                             std::isfinite(internal.gravity_along);
  if (keeps_gravity && std::isfinite(v.tangential) && std::isfinite(v.angular)) return;
  throw NumericalError(
      "the ratio of the downward speed to gravity, tangential velocity or spin is beyond double "
      "precision");
}

/// The loop of impacts, in internal units.
class Run : public SequenceLoop<Sequence, ErrorGrowth> {
 public:
  Run(const Drop& drop, const SequenceOptions& options, bool sums_only)
      : SequenceLoop(options), law_(drop.law), gravity_(drop.gravity), gravity_along_(drop.gravity_along),
        motion_(drop.body, drop.inclination, drop.velocity, drop.gravity, drop.gravity_along) {
    result_.rows.reserve(static_cast<std::size_t>(std::min(options.impacts, 64)));
    if (options.amplification) growth_.emplace(motion_, drop, sums_only);
  }

  Sequence run() {
    const VertexSet lowest = motion_.lowest_vertices();
    require_approach(lowest);
    follow([&] { go_on(lowest); });
    result_.total_normal_impulse_error =
        (growth_ ? growth_->total_impulse() : infinite) + (result_.tail ? result_.tail->normal_impulse_error : 0);
    return std::move(result_);
  }

 private:
  void go_on(VertexSet arriving) {
    Flight flight;
    Departure departure;
    for (;;) {
      const BodyMotion::Strike strike = record(arriving, flight, departure);
      if (accumulates(strike) || is_full()) break;
      departure = motion_.departure();
      flight = fly();
      result_.root_evaluations += flight.evaluations;
      if (flight.end != FlightEnd::contact) {
        end_without_contact(flight);
        break;
      }
      if (is_over(motion_.time())) break;
      arriving = flight.arrival.vertices;
    }
  }

  Flight fly() {
    if (!growth_) return motion_.fly();
    FlownState flown{.body = motion_.turned_body(), .departure = motion_.local_departure(), .arrival = {}};
    Flight flight = motion_.fly();
    flown.arrival = flight.arrival;
    if (flight.end == FlightEnd::contact) growth_->fly(motion_, flown);
    else if (flight.end == FlightEnd::no_contact) growth_->end_without_contact(motion_, flown);
    return flight;
  }

  void require_approach(VertexSet vertices) const {
    double fastest = infinite;
    for (int i = 0; i < motion_.body().vertex_count; ++i) {
      if (!(vertices >> i & 1)) continue;
      fastest = std::fmin(fastest, normal_velocity(motion_.velocity(), motion_.contact_point(i)));
    }
    if (fastest < 0) return;
    throw std::domain_error("the first contact, end " + PlanarBody::vertex_set_name(vertices) +
                            ", does not approach the ground: speed and spin must bring it down");
  }

  BodyMotion::Strike record(VertexSet arriving, const Flight& flight, const Departure& departure) {
    ImpactRow row{.start = motion_.time(),
                  .inclination = motion_.inclination(),
                  .centre_height = motion_.centre_height(),
                  .before = motion_.velocity(),
                  .impact = {},
                  .energy_before = motion_.energy(),
                  .amplification = missing,
                  .flight = flight,
                  .departure = departure};
    row.contact_angle = motion_.contact_angle();
    const BodyMotion::Strike strike = motion_.strike(arriving, law_);
    row.vertices = strike.vertices;
    row.impact = strike.impact;
    row.energy_after = motion_.energy();
    result_.total_normal_impulse += row.impact.normal_impulse;
    if (may_accumulate(law_) && !result_.rows.empty()) {
      accumulation_.add({row.vertices, row.impact.mode, flight.arrival.time, row.impact.normal_impulse,
                         row.impact.tangential_impulse, damping_loss(law_, row.impact.approach_speed)});
    }
    note_energy(row.impact.energy_loss, 1e-14);
    if (law_.friction == FrictionKind::impulse_ratio && row.impact.tangential_impulse != 0) {
      const double push = std::copysign(1, row.impact.tangential_impulse);
      note_push(push * row.impact.slip_before, push * row.impact.slip_after);
    }
    if (growth_) growth_->strike(motion_, law_, row);
    result_.rows.push_back(row);
    return strike;
  }

  /// Whether infinitely many impacts follow that need no more rows.
  bool accumulates(const BodyMotion::Strike& strike) {
    if (const auto rest = resting_tail(motion_, law_, strike)) {
      const bool is_summed = options_.until_rest || is_last_row();
      if ((!is_summed || is_watched(rest->end_time)) && !vanishes(*rest)) return false;
      finish(*rest);
      return true;
    }
    auto tail = bouncing_tail(motion_, law_, strike);
    if (!tail) return extrapolated_end(strike.impact.mode);
    if (bounces_on(strike.impact.separation_speed, gravity_, tail->end_time)) return false;
    if (strike.impact.separation_speed == 0) stay(strike.vertices);
    else finish(*tail);
    return true;
  }

  bool extrapolated_end(ImpactMode mode) {
    if (!may_accumulate(law_)) return false;
    auto tail = extrapolated(accumulation_, {.time = motion_.time()});
    if (!tail || !undisturbed(*tail)) return false;
    const bool stands_for_all = keeps_its_mode(motion_, *tail, mode) && !is_watched(motion_.time() + tail->end_time);
    if (!vanishes(*tail) && !stands_for_all) return false;
    end_state(motion_, mode, *tail);
    tail->end_time += motion_.time();
    finish(*tail);
    return true;
  }

  /// Whether its impulse is rounding of the sum so far.
  [[nodiscard]] bool vanishes(const Tail& tail) const {
    constexpr double ulps = 4 * std::numeric_limits<double>::epsilon();
    return tail.normal_impulse <= ulps * result_.total_normal_impulse;
  }

  /// No other vertex reaches the ground before twice the remaining time has passed.
  [[nodiscard]] bool undisturbed(const Tail& tail) const {
    const Departure departure = motion_.local_departure();
    for (int i = 0; i < motion_.body().vertex_count; ++i) {
      if (tail.vertices >> i & 1) continue;
      const VertexHeight height = vertex_height(motion_.turned_body(), departure, i);
      if (first_root(height, 2 * tail.end_time).time) return false;
    }
    return true;
  }

  void finish(Tail tail) {
    const PlanarVelocity after{.normal = tail.velocity_after.z(),
                               .tangential = tail.velocity_after.x(),
                               .angular = tail.angular_velocity_after.y()};
    const bool slides_on = slides(after, tail.tangential_velocity_error);
    if (growth_) growth_->add_to(motion_, tail);
    const bool tips = tips_over(tail.vertices, after);
    if (slides_on && after.angular == 0 && !tips)
      note_slide(tail.end_time, std::fabs(after.tangential) > tail.tangential_velocity_error ? after.tangential : 0);
    end_in(tail, after.angular != 0 || tips, slides_on, tips ? over_the_edge : stays(tail.vertices));
  }

  /// Whether the body moves along the ground at the end, as far as an extrapolation can tell, or begins to.
  [[nodiscard]] bool slides(const PlanarVelocity& after, double error = 0) const {
    return std::fabs(after.tangential) > error || slides_down(law_, gravity_, gravity_along_);
  }

  /// A slide with this speed, on level ground or along its slope; an impulse ratio says nothing of it.
  void note_slide(double begin, double speed) {
    if (law_.friction == FrictionKind::impulse_ratio && law_.friction_value != 0) return;
    const double rub = law_.most_friction() * gravity_;
    const double bound_for = speed != 0 ? speed : gravity_along_;
    const double acceleration = gravity_along_ - std::copysign(rub, bound_for);
    const bool stops = acceleration * speed < 0 && std::fabs(gravity_along_) <= rub;
    result_.slide = LastSlide{.begin = begin,
                              .speed = speed,
                              .duration = stops ? -speed / acceleration : infinite,
                              .distance = stops ? speed * speed / (2 * std::fabs(acceleration)) : infinite};
  }

  /// Whether a face that has come to rest on sloping ground turns over its lower edge.
  [[nodiscard]] bool tips_over(VertexSet face, const PlanarVelocity& after) const {
    if (gravity_along_ == 0 || after.angular != 0 || std::popcount(face) < 2) return false;
    const double rubs = law_.most_friction(), slope = gravity_along_ / gravity_;
    const double share = after.tangential != 0 ? -std::copysign(rubs, after.tangential)
                                               : -std::copysign(std::fmin(rubs, std::fabs(slope)), slope);
    return !stays_level(motion_, face, share);
  }

  static std::string stays(VertexSet vertices) {
    return "end " + PlanarBody::vertex_set_name(vertices) + " stays on the ground while the body still turns";
  }

  /// The last impact has left `touching` on the ground.
  void stay(VertexSet touching) {
    const PlanarVelocity after = motion_.velocity();
    const bool tips = tips_over(result_.rows.back().vertices, after);
    if (slides(after) && after.angular == 0 && !tips) note_slide(motion_.time(), after.tangential);
    rest(after.angular != 0 || tips, slides(after), law_.restitution == 0 ? "no rebound (e = 0)" : "no rebound there",
         tips ? over_the_edge : stays(touching));
  }

  void end_without_contact(const Flight& flight) {
    if (flight.end == FlightEnd::stays_touching) stay(static_cast<VertexSet>(1u << flight.arrival.vertex));
    else end_in_flight(flight.near_miss);
  }

  static constexpr const char* over_the_edge = "it tips over its lower edge";

  ImpactLaw law_;
  double gravity_, gravity_along_;
  BodyMotion motion_;
  Accumulation accumulation_;
};

/// Impulses and velocities that leave the doubles on the way back to SI units.
void require_representable(const Sequence& sequence) {
  for (const ImpactRow& row : sequence.rows) {
    const PlanarVelocity& v = row.impact.after;
    if (std::isfinite(row.start) && std::isfinite(row.impact.normal_impulse) &&
        std::isfinite(row.impact.tangential_impulse) && std::isfinite(v.normal) && std::isfinite(v.tangential) &&
        std::isfinite(v.angular)) {
      continue;
    }
    throw NumericalError("a time, impulse or velocity of the sequence is beyond the largest double");
  }
}

Sequence run_sequence(const Drop& given, const SequenceOptions& options, bool sums_only) {
  given.validate();
  options.validate();
  const Drop drop = given.release_height ? after_free_fall(given) : given;
  const Units units(drop);
  const Drop internal = units.to_internal(drop);
  require_representable(drop, internal);
  const SequenceOptions own = units.to_internal(options);
  Run run(internal, own, sums_only);
  Sequence sequence = run.run();
  units.to_si(sequence);
  if (drop.fall) sequence.first_flight = drop.fall->time, sequence.first_flight_error = drop.fall->time_error;
  require_representable(sequence);
  const Unphysical& found = run.unphysical();
  std::string warning = law_warning(drop.law.friction, found, units.energy(found.created));
  if (!warning.empty()) sequence.warnings.push_back(std::move(warning));
  return sequence;
}

}  // namespace

Sequence impact_sequence(const Drop& drop, const SequenceOptions& options) {
  return run_sequence(drop, options, false);
}

Sequence summed_sequence(const Drop& drop, const SequenceOptions& options) { return run_sequence(drop, options, true); }

}  // namespace clatter::analytic
