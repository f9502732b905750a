// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/drop_run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "numeric/drop/error_growth.hpp"
#include "numeric/drop/history_pieces.hpp"
#include "numeric/drop/state_notes.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

/// Turns instants of contacts and flights into history samples.
class HistoryWriter {
 public:
  /// Without an observer of the history nothing is done.
  HistoryWriter(const Body& body, const Gravity& gravity, const Observer& observer)
      : body_(body), gravity_(gravity), recorder_(observer.history) {}

  /// An instant of the contact that began at `start` [s].
  void contact(const ContactSystem& system, const ContactInstant& at, double start);
  /// Points of a slide that began at `start` and ends at rest.
  void slide(const GroundMotion& motion, double start);
  /// Points of the flight that began at `start` and lasts `duration` [s], its ends left to the contacts.
  void flight(const FreeFlight& flight, double start, double duration);

 private:
  [[nodiscard]] HistorySample sample(double time, const MotionState& state) const;

  const Body& body_;
  Gravity gravity_;
  const HistoryRecorder& recorder_;
};

HistorySample HistoryWriter::sample(double time, const MotionState& state) const {
  const Vector3& omega = state.angular_velocity;
  HistorySample sample;
  sample.time = time;
  sample.state = state;
  sample.energy_translation = 0.5 * body_.mass() * state.velocity.squaredNorm();
  sample.energy_rotation = 0.5 * omega.dot(body_.inertia() * omega);
  sample.energy_potential = gravity_.potential(body_.mass(), state.centre);
  return sample;
}

void HistoryWriter::contact(const ContactSystem& system, const ContactInstant& at, double start) {
  if (!recorder_) return;
  HistorySample row = sample(start + at.time, system.motion(at.state));
  const ContactLoad& load = at.diagnosis.load;
  row.in_contact = true;
  row.force = Vector3(at.diagnosis.friction.east, at.diagnosis.friction.north, load.force);
  row.energy_ground = load.energy;
  row.point_velocity = point_velocity(row.state, load.force > 0 ? at.diagnosis.centre : touch_point(body_, row.state));
  recorder_(row);
}

void HistoryWriter::slide(const GroundMotion& motion, double start) {
  if (!recorder_) return;
  constexpr int parts = 20;
  for (int i = 1; i <= parts; ++i) {
    const double time = motion.stops_after * i / parts;
    HistorySample row = sample(start + time, motion.at(time));
    row.in_contact = true;
    row.force = i < parts ? motion.force : motion.rest_force;
    row.energy_ground = i < parts ? motion.energy_stored : motion.rest.energy_stored;
    row.point_velocity = row.state.velocity;
    recorder_(row);
  }
}

void HistoryWriter::flight(const FreeFlight& flight, double start, double duration) {
  if (!recorder_) return;
  const double turn = flight.at(0).angular_velocity.norm() * duration;
  const int parts = static_cast<int>(std::clamp(turn * 8, 50.0, 2000.0));
  for (int i = 1; i < parts; ++i) {
    const double time = duration * i / parts;
    HistorySample row = sample(start + time, flight.at(time));
    row.point_velocity = point_velocity(row.state, touch_point(body_, row.state));
    recorder_(row);
  }
}

/// Gives the pieces of contacts and flights to an observer that takes them.
class PieceWriter {
 public:
  PieceWriter(const Body& body, bool planar, const Observer& observer)
      : body_(body), planar_(planar), recorder_(observer.pieces) {}

  [[nodiscard]] bool is_wanted() const { return recorder_ != nullptr; }
  /// An accepted step of the contact `impact`, which began at `origin` [s].
  void step(const ContactSystem& system, std::span<const ContactInstant> instants, int impact, double origin);
  /// A slide to rest at the end of the impact, which ends at `end` and began at `origin` [s].
  void slide(const GroundMotion& motion, int impact, double end, double origin);
  /// The flight after that impact, in pieces in which the body turns by half a radian, if they are not too many.
  void flight(const FreeFlight& flight, int impact, double origin, double duration);

 private:
  [[nodiscard]] Vector3 free_acceleration(const Vector3& omega) const;

  const Body& body_;
  bool planar_;
  const std::function<void(const HistoryPiece&)>& recorder_;
  std::vector<PieceSample> row_;
};

void PieceWriter::step(const ContactSystem& system, std::span<const ContactInstant> instants, int impact,
                       double origin) {
  row_.clear();
  for (const ContactInstant& at : instants) {
    const ContactDiagnosis& load = at.diagnosis;
    row_.push_back({system.motion(at.state), Vector3(load.friction.east, load.friction.north, load.load.force),
                    angular_velocity(at.rate)});
  }
  const double begin = instants.front().time, length = instants.back().time - begin;
  recorder_({impact, true, origin, begin, length, row_});
}

void PieceWriter::slide(const GroundMotion& motion, int impact, double end, double origin) {
  if (!recorder_) return;
  row_.clear();
  for (int j = 0; j < piece_points; ++j) {
    // The last instant is that before the body turns into its equilibrium.
    const double time = std::min(motion.stops_after * piece_point(j), std::nextafter(motion.stops_after, 0.0));
    row_.push_back({motion.at(time), motion.force, Vector3::Zero()});
  }
  const double begin = end - motion.stops_after - origin;
  recorder_({impact, true, origin, begin, motion.stops_after, row_});
}

/// I ω̇′ + ω′ × I ω′ = 0; in the plane nothing turns the axis.
Vector3 PieceWriter::free_acceleration(const Vector3& omega) const {
  if (planar_) return Vector3::Zero();
  return -(body_.inverse_inertia() * omega.cross(body_.inertia() * omega));
}

void PieceWriter::flight(const FreeFlight& flight, int impact, double origin, double duration) {
  if (!recorder_ || !(duration > 0)) return;
  constexpr double most_turn = 0.5, most_pieces = 20'000;
  const double turn = flight.at(0).angular_velocity.norm() * duration;
  const int parts = static_cast<int>(std::clamp(std::ceil(turn / most_turn), 1.0, most_pieces));
  const double length = duration / parts;
  for (int i = 0; i < parts; ++i) {
    row_.clear();
    for (int j = 0; j < piece_points; ++j) {
      const MotionState state = flight.at(length * (i + piece_point(j)));
      row_.push_back({state, Vector3::Zero(), free_acceleration(state.angular_velocity)});
    }
    recorder_({impact, false, origin, length * i, length, row_});
  }
}

/// A contact must go this much deeper than the height at its touch-down is uncertain: the springs would otherwise start
/// with more than a millionth of the energy.
constexpr double least_depth = 1e3;

Outcome outcome_of(ContactEnding ending) {
  switch (ending) {
    case ContactEnding::at_rest: return Outcome::at_rest;
    case ContactEnding::sustained_contact: return Outcome::sustained_contact;
    case ContactEnding::evaluation_limit: return Outcome::evaluation_limit;
    case ContactEnding::step_too_small: return Outcome::step_too_small;
    case ContactEnding::not_representable: return Outcome::not_representable;
    case ContactEnding::interrupted: return Outcome::interrupted;
    case ContactEnding::lift_off: break;
  }
  return Outcome::impact_limit;
}

/// Inclination of the body's x axis, which falls as the body turns clockwise, and its acute angle to the ground.
void note_angles(const MotionState& touch, ImpactNumbers& numbers) {
  const Vector3 axis = touch.attitude * Vector3::UnitX();
  const double along = std::hypot(axis.x(), axis.y());
  numbers.inclination = std::atan2(axis.z(), std::copysign(along, axis.x()));
  numbers.contact_angle = std::atan2(std::fabs(axis.z()), along);
}

class Run {
 public:
  Run(const Body& body, const World& world, const MotionState& start, const Request& request,
      const Integration& integration, const Observer& observer)
      : body_(body), world_(world), request_(request), integration_(integration), observer_(observer),
        gravity_(world.pull()), contact_gravity_(world.gravity_in_contact ? gravity_ : Gravity(0)),
        system_(body, world.ground, contact_gravity_, world.planar), stepper_(make_stepper(integration.method)),
        contact_(system_, *stepper_), rough_stepper_(make_stepper(Method::rkck)),
        rough_contact_(system_, *rough_stepper_), state_(world.planar ? in_plane(start) : start),
        growth_(body, start, gravity_, world.planar), history_(body, gravity_, observer),
        pieces_(body, world.planar, observer), notes_(body, gravity_, world.planar, request.times) {
    control_.steps = integration.steps;
    control_.evaluation_limit = integration.evaluation_limit;
    control_.estimate_local_slip =
        ((request.error_estimates && request.local_slip_with_errors) || request.local_slip) &&
        world.ground.has_friction() && world.ground.friction == FrictionLaw::coulomb;
    control_.least_local_slip = request.local_slip ? 0 : integration.least_local_slip;
    control_.point_friction = world.point_friction;
    if (observer.history || observer.pieces || observer.progress || std::isfinite(request.until)) {
      observe_ = [this](const ContactInstant& at) { return observe(at); };
    }
    steps_.at_time = [this](std::size_t, const ContactInstant* at) { notes_.contact(system_, at); };
    if (!pieces_.is_wanted()) return;
    for (int j = 0; j < piece_points; ++j) steps_.parts.push_back(piece_point(j));
    steps_.show = [this](std::span<const ContactInstant> step) {
      pieces_.step(system_, step, static_cast<int>(result_.impacts.size()) + 1, time_);
    };
  }

  DropRun run() {
    if (request_.starts_on_ground && lowest_height(body_, state_) < 0) control_.is_pressed = true;
    while ((control_.is_pressed ? begin_pressed() : fall()) && strike()) control_.is_pressed = false;
    result_.force_evaluations = system_.evaluations();
    result_.state_evaluations = system_.evaluations_aside();
    result_.final_state = state_;
    result_.end_time = time_;
    result_.states = notes_.take();
    return std::move(result_);
  }

 private:
  bool end(Outcome outcome) {
    result_.outcome = outcome;
    return false;
  }

  /// At the start the ground presses; false if a state before is asked for.
  bool begin_pressed() {
    if (notes_.begin_before(0)) return end(Outcome::interrupted);
    system_.begin(state_);
    const ContactLoad load = system_.pressed(0);
    stored_before_ = load.energy;
    pressed_point_ = load.pressure_centre();
    result_.energy_start = mechanical_energy(body_, state_, gravity_) + stored_before_;
    return true;
  }

  /// The flight to the next touch-down; false if there is none.
  bool fall() {
    const FreeFlight flight(body_, state_, gravity_, world_.planar);
    const TouchDown down = next_touch_down(body_, flight);
    result_.root_evaluations += down.evaluations;
    assert(down.time >= 0);
    const bool first = result_.impacts.empty(), touches = down.kind == TouchDown::Kind::touch;
    if (first && touches) result_.start_time = time_ = -down.time;
    if (first && notes_.begin_before(time_)) return end(Outcome::interrupted);
    const bool is_endless = down.kind == TouchDown::Kind::never;
    notes_.flight(flight, time_, is_endless ? std::numeric_limits<double>::infinity() : down.time,
                  request_.amplification && !first ? &growth_ : nullptr);
    if (is_endless) return end(Outcome::no_further_impact);
    const bool has_enough = static_cast<int>(result_.impacts.size()) >= request_.impacts;
    if (touches && has_enough && notes_.are_complete()) return end(Outcome::impact_limit);
    if (time_ + down.time > request_.until) return end(Outcome::time_limit);
    if (!touches) return end(Outcome::flight_undecided);
    if (!first) {
      history_.flight(flight, time_, down.time);
      pieces_.flight(flight, static_cast<int>(result_.impacts.size()), time_, down.time);
      if (request_.amplification) growth_.fly(state_, down.time);
    }
    time_ = first ? 0 : time_ + down.time;
    const double fallen = std::fabs(state_.velocity.z()) * down.time + gravity_.down / 2 * down.time * down.time;
    placement_ = first ? 0 : std::numeric_limits<double>::epsilon() * fallen;
    state_ = flight.at(down.time);
    if (first) result_.energy_start = mechanical_energy(body_, state_, gravity_);
    return true;
  }

  /// The contact; false if it did not end in a lift-off.
  bool strike() {
    const Vector3 point = control_.is_pressed ? pressed_point_ : touch_point(body_, state_);
    notes_.open_contact(time_, request_.amplification ? &growth_ : nullptr, steps_.times);
    const ContactResult contact = contact_.run(state_, point, control_, observe_, steps_);
    result_.step = contact.step;
    result_.last_touch = state_;
    result_.impact_goes_on = true;
    result_.reached = contact.after;
    result_.reached_time = time_ + contact.duration;
    if (result_.reached_time > request_.until) {
      if (contact.goes_on) notes_.ground(*contact.goes_on, time_ + contact.goes_on_from);
      return end(Outcome::time_limit);
    }
    const bool lifts = contact.ending == ContactEnding::lift_off;
    if (!lifts && contact.ending != ContactEnding::at_rest && contact.ending != ContactEnding::sustained_contact) {
      return end(outcome_of(contact.ending));
    }
    if (contact.goes_on) {
      result_.on_ground = contact.goes_on;
      result_.on_ground_from = time_ + contact.goes_on_from;
    }
    if (contact.duration == 0) {
      notes_.ground_from_the_start(*contact.goes_on);
      result_.impact_goes_on = false;
      return end(outcome_of(contact.ending));
    }
    assert(contact.duration > 0 && contact.touches >= 1);
    if (!(contact.scales.depth > least_depth * placement_)) {
      notes_.forget_contact();
      return end(Outcome::not_representable);
    }
    result_.impact_goes_on = false;
    result_.impacts.push_back(record(contact, point));
    if (request_.amplification) note_growth(contact);
    note_left_out(contact.left_out);
    notes_.close_contact(result_.impacts.back().amplification);
    if (integration_.next_tolerance) control_.steps.tolerance = integration_.next_tolerance(result_.impacts.back());
    if (observer_.impact && !observer_.impact(result_.impacts.back())) return end(Outcome::interrupted);
    state_ = world_.planar ? in_plane(contact.after) : contact.after;
    time_ += contact.duration;
    if (contact.goes_on) rest_or_glide(*contact.goes_on);
    stored_before_ = 0;
    return lifts || end(outcome_of(contact.ending));
  }

  [[nodiscard]] ImpactRecord record(const ContactResult& contact, const Vector3& point) const {
    const MotionState& after = contact.after;
    ImpactRecord row;
    ImpactNumbers& n = row.value;
    n.start = time_;
    n.duration = contact.duration;
    note_angles(state_, n);
    n.approach_speed = -point_velocity(state_, point).z();
    n.restitution = contact.touches > 1 || control_.is_pressed ? std::numeric_limits<double>::quiet_NaN()
                                                               : point_velocity(after, point).z() / n.approach_speed;
    n.impulse = body_.mass() * (after.velocity - state_.velocity - contact.duration * contact_gravity_.acceleration());
    n.peak_force = contact.peak_force;
    n.peak_time = contact.peak_time;
    n.indentation = contact.indentation;
    n.velocity_after = after.velocity;
    n.angular_velocity_after = after.attitude * after.angular_velocity;
    n.energy_before = mechanical_energy(body_, state_, gravity_);
    n.energy_after = mechanical_energy(body_, after, gravity_);
    n.energy_loss = n.energy_before - n.energy_after;
    n.work_damping = contact.work_damping;
    n.work_friction = contact.work_friction;
    n.work_released = contact.work_released;
    row.end = contact.end;
    row.attitude = state_.attitude;
    row.place = point;
    row.touches = contact.touches;
    row.mode = contact.mode;
    row.local_slip = contact.local_slip;
    row.submerged = contact.submerged;
    row.amplification = std::numeric_limits<double>::quiet_NaN();
    row.energy_stored = contact.energy_stored;
    if (contact.goes_on && contact.goes_on->kind == GroundMotionKind::rests) note_rest(*contact.goes_on, row);
    const double gap =
        n.energy_loss - n.work_damping - n.work_friction - n.work_released - (row.energy_stored - stored_before_);
    row.ledger_gap = gap / std::max(result_.energy_start, row.energy_stored);
    return row;
  }

  static void note_rest(const GroundMotion& motion, ImpactRecord& row) {
    const bool slides = motion.stops_after > 0;
    if (!slides) row.carried = motion.rest_force;
    if (!motion.rocks) return;
    row.left_speed = motion.left_speed;
    row.left_turning = motion.left_turning;
    if (slides) row.left_time = motion.left_speed / motion.acceleration.norm();
  }

  void rest_or_glide(const GroundMotion& motion) {
    notes_.ground(motion, result_.on_ground_from);
    if (motion.kind != GroundMotionKind::rests || !(motion.stops_after > 0)) return;
    history_.slide(motion, result_.on_ground_from);
    pieces_.slide(motion, static_cast<int>(result_.impacts.size()), time_, result_.impacts.back().value.start);
  }

  void note_growth(const ContactResult& contact) {
    ImpactRecord& row = result_.impacts.back();
    // Beyond that no run tells one neighbour from another.
    if (is_predictable(growth_.factor())) growth_.touch({contact_, rough_contact_}, control_, state_, contact);
    row.amplification = growth_.factor();
    row.predictable = is_predictable(row.amplification);
  }

  void note_left_out(double in_contact) {
    const std::size_t count = result_.impacts.size();
    ImpactRecord& row = result_.impacts.back();
    if (count > 1) {
      const ImpactRecord& last = result_.impacts[count - 2];
      row.left_out_before = grown(last.left_out, last.amplification, row.amplification);
    }
    row.left_out = row.left_out_before + in_contact;
  }

  bool observe(const ContactInstant& at) {
    history_.contact(system_, at, time_);
    if (time_ + at.time > request_.until) return false;
    if (!observer_.progress || ++observed_ % 64 != 0) return true;
    return observer_.progress(static_cast<int>(result_.impacts.size()), system_.evaluations());
  }

  const Body& body_;
  const World& world_;
  const Request& request_;
  const Integration& integration_;
  const Observer& observer_;
  Gravity gravity_, contact_gravity_;
  ContactSystem system_;
  std::unique_ptr<Stepper> stepper_;
  ContactRun contact_;
  std::unique_ptr<Stepper> rough_stepper_;  ///< of the neighbour that tells the growth of errors
  ContactRun rough_contact_;
  ContactControl control_;
  ContactObserver observe_;
  MotionState state_;
  ErrorGrowth growth_;
  HistoryWriter history_;
  PieceWriter pieces_;
  StateNotes notes_;
  StepObserver steps_;  ///< shows the steps to pieces_, if they are wanted, and instants to notes_
  double time_ = 0;
  double placement_ = 0;      ///< rounding error of the height at the touch-down, from the flight's length [m]
  double stored_before_ = 0;  ///< in the springs at the start of a body that is pressed [J]
  Vector3 pressed_point_ = Vector3::Zero();  ///< its pressure centre, body frame [m]
  long observed_ = 0;
  DropRun result_;
};

}  // namespace

double piece_point(int j) { return (1 - std::cos(std::numbers::pi * j / (piece_points - 1))) / 2; }

DropRun run_drop(const Body& body, const World& world, const MotionState& start, const Request& request,
                 const Integration& integration, const Observer& observer) {
  return Run(body, world, start, request, integration, observer).run();
}

}  // namespace clatter::numeric
