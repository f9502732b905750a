// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "numeric/motion/free_flight.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {

std::string TimeWindow::text() const { return shortest(from) + ":" + shortest(to); }

TimeWindow read_window(const std::string& name, const std::string& text) {
  TimeWindow window;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const bool reads = colon < text.size() && read_number(text.substr(0, colon), window.from) &&
                     read_number(text.substr(colon + 1), window.to);
  if (!reads) throw BadInput("{} '{}': must be FROM:TO, two times in s", name, text);
  if (!(window.from < window.to)) throw BadInput("{} '{}': FROM must be less than TO", name, text);
  return window;
}

namespace {

/// The row at `time` on the straight line between two others.
std::vector<double> between(const std::vector<double>& before, const std::vector<double>& after, double time) {
  const double part = (time - before[0]) / (after[0] - before[0]);
  std::vector<double> row(before.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = before[i] * (1 - part) + after[i] * part;
  row[0] = time;
  return row;
}

}  // namespace

std::vector<std::vector<double>> clipped(const std::vector<std::vector<double>>& rows, const TimeWindow& window) {
  const auto is_before = [&](const std::vector<double>& row) { return row[0] < window.from; };
  const auto reaches = [&](const std::vector<double>& row) { return row[0] <= window.to; };
  const auto first = std::partition_point(rows.begin(), rows.end(), is_before);
  const auto last = std::partition_point(first, rows.end(), reaches);
  std::vector<std::vector<double>> kept;
  if (first != rows.begin() && first != rows.end()) kept.push_back(between(*(first - 1), *first, window.from));
  kept.insert(kept.end(), first, last);
  if (last != rows.end() && last != rows.begin()) kept.push_back(between(*(last - 1), *last, window.to));
  return kept;
}

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
  std::vector<double> numbers{s.time};
  const auto add = [&](const Vector3& v) { numbers.insert(numbers.end(), v.begin(), v.end()); };
  add(s.state.centre);
  numbers.push_back(beta.w());
  for (const Vector3& v : {Vector3(beta.vec()), s.state.velocity, omega, s.force, s.point_velocity}) add(v);
  numbers.insert(numbers.end(), {s.energy_translation, s.energy_rotation, s.energy_potential, s.energy_ground,
                                 s.energy_total(), s.in_contact ? 1.0 : 0.0});
  return numbers;
}

HistoryFile::HistoryFile(const std::string& path, const std::vector<std::string>& head, const TimeWindow& window)
    : sink_(path, "--history"), window_(window) {
  for (const std::string& line : head) sink_.write("# " + line + "\n");
  sink_.write(fmt::format("{}\n", fmt::join(history_names(), ",")));
}

void HistoryFile::write(const HistorySample& sample) {
  if (!window_.holds(sample.time)) return;
  std::string line;
  for (const double number : history_numbers(sample)) line += (line.empty() ? "" : ",") + shortest(number);
  sink_.write(line + "\n");
}

void record_fall(const numeric::HistoryRecorder& recorder, const numeric::Body& body, const numeric::World& world,
                 const numeric::MotionState& touch, double fall, int parts) {
  if (!(fall > 0)) return;
  const numeric::FreeFlight flight(body, touch, world.pull(), world.planar);
  for (int i = 0; i < parts; ++i) {
    HistorySample sample;
    sample.time = -fall * (1 - static_cast<double>(i) / parts);
    sample.state = flight.at(sample.time);
    const numeric::MotionState& s = sample.state;
    sample.point_velocity = numeric::point_velocity(s, numeric::touch_point(body, touch));
    sample.energy_translation = 0.5 * body.mass() * s.velocity.squaredNorm();
    sample.energy_rotation = 0.5 * s.angular_velocity.dot(body.inertia() * s.angular_velocity);
    sample.energy_potential = body.mass() * world.gravity * s.centre.z();
    recorder(sample);
  }
}

}  // namespace clatter::validation
