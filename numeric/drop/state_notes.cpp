// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/state_notes.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::numeric {
namespace {

constexpr double decay_doubt = 0.1;

void forget(StateRecord& record) {
  record.known = false;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3 none = Vector3::Constant(nan);
  record.state = {none, Eigen::Quaterniond(nan, nan, nan, nan), none, none};
  record.force = none;
  record.energy = record.energy_stored = record.amplification = nan;
  record.error = {};
}

}  // namespace

StateNotes::StateNotes(const Body& body, const Gravity& gravity, bool planar, const std::vector<double>& times)
    : body_(body), gravity_(gravity), planar_(planar), records_(times.size()) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    records_[i].time = times[i];
    forget(records_[i]);
  }
}

StateRecord& StateNotes::note(const MotionState& state) {
  StateRecord& record = records_[next_++];
  record.known = true;
  record.state = planar_ ? in_plane(state) : state;
  record.impacts = impacts_;
  record.force.setZero();
  record.energy = mechanical_energy(body_, record.state, gravity_);
  record.energy_stored = 0;
  record.amplification = amplification_;
  return record;
}

void StateNotes::flight(const FreeFlight& flight, double origin, double duration, const ErrorGrowth* growth) {
  std::optional<ErrorGrowth> here;
  if (growth) here.emplace(*growth);
  double last = 0;
  while (!are_complete() && records_[next_].time - origin < duration) {
    const double time = std::max(records_[next_].time - origin, 0.0);
    if (here) {
      here->fly(flight.at(last), time - last);
      amplification_ = here->factor();
    }
    note(flight.at(time));
    last = time;
  }
}

void StateNotes::open_contact(double origin, const ErrorGrowth* growth, std::vector<double>& times) {
  ++impacts_;
  if (growth) amplification_ = growth->factor();
  opened_ = next_;
  times.clear();
  for (std::size_t i = next_; i < records_.size(); ++i) times.push_back(std::max(records_[i].time - origin, 0.0));
}

void StateNotes::contact(const ContactSystem& system, const ContactInstant* at) {
  if (!at) {
    records_[next_++].impacts = impacts_;
    return;
  }
  StateRecord& record = note(system.motion(at->state));
  const ContactDiagnosis& now = at->diagnosis;
  record.in_contact = true;
  record.force = {now.friction.east, now.friction.north, now.load.force};
  record.energy_stored = now.load.energy;
}

void StateNotes::close_contact(double amplification) {
  for (std::size_t i = opened_; i < next_; ++i) {
    records_[i].amplification = std::fmax(records_[i].amplification, amplification);
  }
  amplification_ = amplification;
}

void StateNotes::forget_contact() {
  for (std::size_t i = opened_; i < next_; ++i) forget(records_[i]);
}

void StateNotes::ground(const GroundMotion& motion, double origin) {
  while (!are_complete()) {
    const double time = std::max(records_[next_].time - origin, 0.0);
    const bool rests = !(time < motion.stops_after);
    StateRecord& record = note(motion.at(time));
    record.in_contact = true;
    record.force = rests ? motion.rest_force : motion.force;
    record.energy_stored = rests ? motion.rest.energy_stored : motion.energy_stored;
    // That a motion dies away in proportion to its speed is right to some per cent.
    const double slowed = decay_doubt * (motion.from.velocity.norm() * -std::expm1(-motion.decay * time));
    const double turned =
        decay_doubt * (motion.from.angular_velocity.norm() * -std::expm1(-motion.turning_decay * time));
    if (rests && motion.stops_after > 0) {
      record.error = {.position = motion.left_speed * motion.left_time,
                      .angle = 0,
                      .velocity = 0,
                      .angular_velocity = 0,
                      .energy = 0};
      continue;
    }
    record.error = {.position = motion.left_speed * motion.left_time + slowed * time,
                    .angle = motion.left_turning * motion.left_time + turned * time,
                    .velocity = motion.left_speed + slowed,
                    .angular_velocity = motion.left_turning + turned,
                    .energy = motion.force.norm() * motion.left_speed * motion.left_time +
                              body_.mass() * record.state.velocity.norm() * (motion.left_speed + slowed)};
  }
}

void StateNotes::ground_from_the_start(const GroundMotion& motion) {
  impacts_ = 0;
  ground(motion, 0);
}

}  // namespace clatter::numeric
