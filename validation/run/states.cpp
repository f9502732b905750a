// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr double most_times = 1e6;

/// A number of a state, or one of a vector, with the error of the whole.
struct StateQuantity {
  const char *name, *heading, *unit, *meaning, *list;
  double (*value)(const MotionAt&);
  double MotionAt::*error;  ///< none: it has no error
  double StateSizes::*size;
  bool in_plane;
};

/// The errors, each of a number or of all of a vector.
struct StateError {
  const char *name, *unit;
  double MotionAt::*value;
};
constexpr StateError state_errors[] = {{"position", "m", &MotionAt::position_error},
                                       {"attitude", "rad", &MotionAt::attitude_error},
                                       {"velocity", "m/s", &MotionAt::velocity_error},
                                       {"angular_velocity", "rad/s", &MotionAt::angular_velocity_error},
                                       {"energy", "J", &MotionAt::energy_error}};

const std::vector<StateQuantity>& quantities() {
  using M = MotionAt;
  using S = StateSizes;
  static const std::vector<StateQuantity> listed{
      {"position_x", "x", "m", "x: of the centre of mass, from that of the first impact", "position",
       [](const M& s) { return s.position[0]; }, &M::position_error, &S::length, true},
      {"position_y", "y", "m", "y: likewise", "position", [](const M& s) { return s.position[1]; }, &M::position_error,
       &S::length, false},
      {"position_z", "z", "m", "z: above the ground", "position", [](const M& s) { return s.position[2]; },
       &M::position_error, &S::length, true},
      {"attitude_q0", "q0", "", "q0: body to world", "attitude", [](const M& s) { return s.attitude[0]; },
       &M::attitude_error, nullptr, false},
      {"attitude_q1", "q1", "", "q1: likewise", "attitude", [](const M& s) { return s.attitude[1]; },
       &M::attitude_error, nullptr, false},
      {"attitude_q2", "q2", "", "q2: likewise", "attitude", [](const M& s) { return s.attitude[2]; },
       &M::attitude_error, nullptr, false},
      {"attitude_q3", "q3", "", "q3: likewise", "attitude", [](const M& s) { return s.attitude[3]; },
       &M::attitude_error, nullptr, false},
      {"inclination_deg", "angle", "°", "of the body's x axis, > 0: end a lower", "",
       [](const M& s) { return s.inclination_deg; }, &M::inclination_error_deg, nullptr, true},
      {"velocity_x", "Vₜ", "m/s", "x: of the centre of mass", "velocity", [](const M& s) { return s.velocity[0]; },
       &M::velocity_error, &S::speed, true},
      {"velocity_y", "V_y", "m/s", "y: likewise", "velocity", [](const M& s) { return s.velocity[1]; },
       &M::velocity_error, &S::speed, false},
      {"velocity_z", "Vₙ", "m/s", "z: likewise", "velocity", [](const M& s) { return s.velocity[2]; },
       &M::velocity_error, &S::speed, true},
      {"angular_velocity_x", "ω_x", "rad/s", "x: world axes", "angular_velocity",
       [](const M& s) { return s.angular_velocity[0]; }, &M::angular_velocity_error, &S::rate, false},
      {"angular_velocity_y", "Ω", "rad/s", "y: likewise", "angular_velocity",
       [](const M& s) { return s.angular_velocity[1]; }, &M::angular_velocity_error, &S::rate, true},
      {"angular_velocity_z", "ω_z", "rad/s", "z: likewise", "angular_velocity",
       [](const M& s) { return s.angular_velocity[2]; }, &M::angular_velocity_error, &S::rate, false},
      {"energy", "E", "J", "translational, rotational and potential", "", [](const M& s) { return s.energy; },
       &M::energy_error, &S::energy, true}};
  return listed;
}

/// When the last of what the run tells ends [s].
double end_of(const Run& run) {
  double end = run.impacts.empty() ? 0 : run.impacts.back().value.start + run.impacts.back().value.duration;
  if (run.tail) end = std::fmax(end, run.tail->sum.value.start);
  if (!run.end_motion) return end;
  return std::fmax(end, run.end_motion->begin + (run.end_motion->ends() ? run.end_motion->duration : 0));
}

}  // namespace

std::vector<double> state_times(const Scene& scene, const Run& run) {
  std::vector<double> times = scene.times;
  if (scene.rate > 0) {
    const double end = std::isfinite(scene.request.until) ? scene.request.until : end_of(run);
    const double last = end * scene.rate;
    if (!(last <= most_times)) {
      throw BadInput("run.rate = {}: gives more than a million states until {} s; give a lower one, or run.until",
                     shortest(scene.rate), shortest(end));
    }
    for (double k = 0; k <= last * (1 + 1e-12); ++k) times.push_back(k / scene.rate);
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<Column> state_columns() {
  std::vector<Column> columns{
      {.name = "time", .heading = "t", .unit = "s", .meaning = "since the first impact"},
      {.name = "impacts", .heading = "n", .unit = "", .meaning = "impacts that have begun until then"},
      {.name = "touches", .heading = "", .unit = "", .meaning = "whether any of it is on the ground", .shown = false}};
  for (const StateQuantity& q : quantities()) {
    Column column{.name = q.name,
                  .heading = q.heading,
                  .unit = q.unit,
                  .meaning = q.meaning,
                  .shown = !std::string_view(q.name).starts_with("attitude")};
    if (*q.list != '\0') column.key = q.list, column.listed = true;
    columns.push_back(column);
  }
  for (const StateError& error : state_errors)
    columns.push_back(error_column({.name = error.name, .heading = "", .unit = error.unit}));
  columns.push_back({.name = "beside",
                     .heading = "",
                     .unit = "",
                     .meaning = "impact so near that errors decide whether this is before or after it; 0: none",
                     .shown = false});
  return columns;
}

Grid state_grid(const Run& run, bool in_plane, int digits, const StateSizes& sizes) {
  Grid grid{.columns = state_columns()};
  const std::vector<StateQuantity>& known = quantities();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (in_plane && !known[i].in_plane) grid.columns[3 + i].shown = false;
    if (!in_plane && std::string_view(known[i].name) == "inclination_deg") grid.columns[3 + i].shown = false;
  }
  for (const MotionAt& state : run.states) {
    Row row{state.time, state.impacts, state.touches};
    row[0].digits = 9;
    for (const StateQuantity& q : known) {
      if (!state.is_known) {
        row.emplace_back(Value(), "?");
        continue;
      }
      const double size = q.size ? sizes.*q.size : 1;
      row.push_back(known_cell({q.value(state), state.*q.error}, {.digits = digits, .size = size}));
    }
    for (const StateError& error : state_errors)
      row.emplace_back(state.is_known ? error_or_nothing({0, state.*error.value}) : Value());
    row.emplace_back(state.beside);
    grid.rows.push_back(std::move(row));
  }
  return grid;
}

std::vector<std::string> state_notes(const Run& run) {
  std::vector<std::string> notes;
  for (const MotionAt& state : run.states) {
    if (state.beside > 0) {
      notes.push_back(fmt::format("the state at {} s lies beside impact {}: its errors bear both sides",
                                  shortest(state.time), state.beside));
    }
  }
  auto known = std::ranges::find(run.states, true, &MotionAt::is_known);
  if (known == run.states.end()) known = run.states.begin();
  if (known != run.states.begin())
    notes.push_back(fmt::format("at {} s the body is not let go yet", shortest(run.states.front().time)));
  const auto lost = std::find_if(known, run.states.end(), [](const MotionAt& state) { return !state.is_known; });
  if (lost != run.states.end())
    notes.push_back(fmt::format("from {} s on the model does not say where the body is", shortest(lost->time)));
  return notes;
}

Report with_states_alone(Report report) {
  report.grid = std::move(*report.further);
  report.further.reset();
  return report;
}

void require_states(bool asked, const Scene& scene) {
  if (asked && !scene.has_times()) throw BadInput("--rows states: needs --at or --rate");
}

}  // namespace clatter::validation
