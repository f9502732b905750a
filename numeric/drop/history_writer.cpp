// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/history_writer.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/motion/touch_point.hpp"

namespace clatter::numeric {

HistorySample HistoryWriter::sample(double time, const MotionState& state) const {
  const Vector3& omega = state.angular_velocity;
  HistorySample sample;
  sample.time = time;
  sample.state = state;
  sample.energy_translation = 0.5 * body_.mass() * state.velocity.squaredNorm();
  sample.energy_rotation = 0.5 * omega.dot(body_.inertia() * omega);
  sample.energy_potential = body_.mass() * gravity_ * state.centre.z();
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
  recorder_->record(row);
}

void HistoryWriter::flight(const FreeFlight& flight, double start, double duration) {
  if (!recorder_) return;
  const double turn = flight.at(0).angular_velocity.norm() * duration;
  const int parts = static_cast<int>(std::clamp(turn * 8, 20.0, 2000.0));
  for (int i = 1; i < parts; ++i) {
    const double time = duration * i / parts;
    HistorySample row = sample(start + time, flight.at(time));
    row.point_velocity = point_velocity(row.state, touch_point(body_, row.state));
    recorder_->record(row);
  }
}

}  // namespace clatter::numeric
