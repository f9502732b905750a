// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/history_file.hpp"

#include <fmt/format.h>

#include "validation/output/number.hpp"

namespace clatter::validation {

using numeric::HistorySample;
using numeric::Vector3;

std::vector<Column> history_columns() {
  std::vector<Column> columns{{"t", "t", "s", "time after the first touch-down"}};
  const auto add = [&](std::initializer_list<const char*> names, const char* unit, const char* meaning) {
    for (const char* name : names) columns.push_back({name, name, unit, meaning});
  };
  add({"x", "y", "z"}, "m", "centre of mass");
  add({"beta0", "beta1", "beta2", "beta3"}, "", "Euler parameters, body to world, scalar first");
  add({"vx", "vy", "vz"}, "m/s", "velocity of the centre of mass");
  add({"wx", "wy", "wz"}, "rad/s", "angular velocity, world");
  add({"fx", "fy", "fz"}, "N", "contact force");
  add({"point_vx", "point_vy", "point_vz"}, "m/s", "velocity of the contact point");
  add({"energy_translation", "energy_rotation", "energy_potential", "energy_ground", "energy_total"}, "J", "energy");
  add({"in_contact"}, "", "1 while anything touches, else 0");
  return columns;
}

const std::vector<std::string>& history_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Column& column : history_columns()) all.push_back(column.name);
    return all;
  }();
  return names;
}

std::vector<double> history_numbers(const HistorySample& s) {
  const Eigen::Quaterniond& beta = s.state.attitude;
  const Vector3 omega = beta * s.state.angular_velocity;
  return {s.time,
          s.state.centre.x(),
          s.state.centre.y(),
          s.state.centre.z(),
          beta.w(),
          beta.x(),
          beta.y(),
          beta.z(),
          s.state.velocity.x(),
          s.state.velocity.y(),
          s.state.velocity.z(),
          omega.x(),
          omega.y(),
          omega.z(),
          s.force.x(),
          s.force.y(),
          s.force.z(),
          s.point_velocity.x(),
          s.point_velocity.y(),
          s.point_velocity.z(),
          s.energy_translation,
          s.energy_rotation,
          s.energy_potential,
          s.energy_ground,
          s.energy_total(),
          s.in_contact ? 1.0 : 0.0};
}

HistoryFile::HistoryFile(const std::string& path, const std::vector<std::string>& head, const TimeWindow& window)
    : sink_(path, "--history"), window_(window) {
  for (const std::string& line : head) sink_.write("# " + line + "\n");
  sink_.write(fmt::format("{}\n", fmt::join(history_names(), ",")));
}

void HistoryFile::record(const HistorySample& sample) {
  if (!window_.holds(sample.time)) return;
  std::string line;
  for (const double number : history_numbers(sample)) line += (line.empty() ? "" : ",") + shortest(number);
  sink_.write(line + "\n");
}

void record_fall(numeric::HistoryRecorder& recorder, const numeric::MotionState& touch, double mass, double gravity,
                 int parts) {
  const double fall = -touch.velocity.z() / gravity;
  for (int i = 0; i < parts; ++i) {
    HistorySample sample;
    sample.time = -fall * (1 - static_cast<double>(i) / parts);
    sample.state = touch;
    sample.state.centre += sample.time * touch.velocity - Vector3(0, 0, gravity / 2 * sample.time * sample.time);
    sample.state.velocity.z() -= gravity * sample.time;
    sample.point_velocity = sample.state.velocity;
    sample.energy_translation = 0.5 * mass * sample.state.velocity.squaredNorm();
    sample.energy_potential = mass * gravity * sample.state.centre.z();
    recorder.record(sample);
  }
}

}  // namespace clatter::validation
