// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::Vector3;

/// The numbers of a row, by the names of its columns.
class Cells {
 public:
  Cells(const NumericTable& table, std::span<double> row) : table_(table), row_(row) {}

  [[nodiscard]] bool has(const std::string& name) const { return table_.column(name).has_value(); }
  [[nodiscard]] double& operator()(const std::string& name) const { return row_[table_.column(name).value()]; }
  /// The vector of three columns.
  [[nodiscard]] Vector3 vector(const std::string& name) const {
    return {(*this)(name + "x"), (*this)(name + "y"), (*this)(name + "z")};
  }
  [[nodiscard]] space::Quaternion attitude() const {
    return {(*this)("q0"), (*this)("q1"), (*this)("q2"), (*this)("q3")};
  }

 private:
  const NumericTable& table_;
  std::span<double> row_;
};

/// A way to read rows that is not the one asked for.
struct Reading {
  const char* name;
  std::string words;
  std::function<void(const Cells&)> change;
};

std::function<void(const Cells&)> scaled(std::vector<const char*> names, double factor) {
  return [names, factor](const Cells& at) {
    for (const char* name : names) {
      if (at.has(name)) at(name) *= factor;
    }
  };
}

void from_body_frame(const Cells& at) {
  const Vector3 rate = at.attitude() * at.vector("w");
  at("wx") = rate.x(), at("wy") = rate.y(), at("wz") = rate.z();
}

void scalar_first(const Cells& at) {
  const double scalar = at("q3");
  at("q3") = at("q2"), at("q2") = at("q1"), at("q1") = at("q0"), at("q0") = scalar;
}

void exchange_axes(const Cells& at) {
  std::swap(at("x"), at("z"));
  std::swap(at("vx"), at("vz"));
}

void all_in_milliseconds(const Cells& at) {
  scaled({"t"}, 1e-3)(at);
  scaled({"vx", "vy", "vz", "omega", "wx", "wy", "wz"}, 1e3)(at);
}

space::Quaternion attitude_of(const Cells& at) {
  const double half = at.has("q0") ? 0 : at("phi") / 2;
  return at.has("q0") ? at.attitude() : space::Quaternion(std::cos(half), 0, -std::sin(half), 0);
}

/// From a point of the body, `place` in its axes, to the centre of mass.
void from_point(const Vector3& place, const Cells& at) {
  if (!at.has("q0")) {
    const double s = std::sin(at("phi")), c = std::cos(at("phi"));
    const double along = place.x() * c - place.z() * s, up = place.x() * s + place.z() * c;
    at("x") -= along, at("z") -= up;
    at("vx") += at("omega") * up, at("vz") -= at("omega") * along;
    return;
  }
  const Vector3 arm = at.attitude() * place, speed = at.vector("w").cross(arm);
  at("x") -= arm.x(), at("y") -= arm.y(), at("z") -= arm.z();
  at("vx") -= speed.x(), at("vy") -= speed.y(), at("vz") -= speed.z();
}

constexpr double radian = std::numbers::pi / 180, full_turn = 2 * std::numbers::pi;  // [rad]
constexpr double foot = 0.3048;                                                      // [m]

const std::vector<Reading> planar_readings{
    {"phi-sign", "phi and omega count the other turn as positive", scaled({"phi", "omega"}, -1)},
    {"phi-alone", "phi counts the turn as positive that omega counts as negative", scaled({"phi"}, -1)},
    {"omega-sign", "omega has not the sign of phi's rate", scaled({"omega"}, -1)},
    {"left-right", "left and right are exchanged: x, phi, vx and omega have the other sign",
     scaled({"x", "phi", "vx", "omega"}, -1)},
    {"up-down", "z points down", scaled({"z", "vz"}, -1)},
    {"y-up", "y points up, and z stands for depth", [](const Cells& at) { at("z") = at("y"), at("vz") = at("vy"); }},
    {"exchanged", "x and z are exchanged, and vx and vz", exchange_axes},
    {"exchanged", "x and z are exchanged", [](const Cells& at) { std::swap(at("x"), at("z")); }},
    {"degrees", "phi and omega are in degrees", scaled({"phi", "omega"}, radian)},
    {"degrees", "phi is in degrees", scaled({"phi"}, radian)},
    {"degrees", "omega is in degrees per second", scaled({"omega"}, radian)},
    {"turns", "omega is in turns per second", scaled({"omega"}, full_turn)},
    {"millimetres", "lengths are in millimetres", scaled({"x", "z", "vx", "vz"}, 1e-3)},
    {"centimetres", "lengths are in centimetres", scaled({"x", "z", "vx", "vz"}, 1e-2)},
    {"feet", "lengths are in feet", scaled({"x", "z", "vx", "vz"}, foot)},
    {"milliseconds", "t is in milliseconds", scaled({"t"}, 1e-3)},
    {"milliseconds", "all times are in milliseconds, those of velocities, too", all_in_milliseconds}};

const std::vector<Reading> space_readings{
    {"conjugate", "the Euler parameters turn from the world to the body", scaled({"q1", "q2", "q3"}, -1)},
    {"body-frame", "the angular velocity is in body axes", from_body_frame},
    {"scalar-last", "the Euler parameters have their scalar last", scalar_first},
    {"omega-sign", "the angular velocity has the other sign", scaled({"wx", "wy", "wz"}, -1)},
    {"up-down", "z points down", scaled({"z", "vz"}, -1)},
    {"degrees", "the angular velocity is in degrees per second", scaled({"wx", "wy", "wz"}, radian)},
    {"turns", "the angular velocity is in turns per second", scaled({"wx", "wy", "wz"}, full_turn)},
    {"millimetres", "lengths are in millimetres", scaled({"x", "y", "z", "vx", "vy", "vz"}, 1e-3)},
    {"centimetres", "lengths are in centimetres", scaled({"x", "y", "z", "vx", "vy", "vz"}, 1e-2)},
    {"feet", "lengths are in feet", scaled({"x", "y", "z", "vx", "vy", "vz"}, foot)},
    {"milliseconds", "t is in milliseconds", scaled({"t"}, 1e-3)},
    {"milliseconds", "all times are in milliseconds, those of velocities, too", all_in_milliseconds}};

const std::vector<Reading> list_readings{
    {"omega-sign", "Omega has the other sign than its line says", scaled({"Omega"}, -1)},
    {"up-down", "V counts down as positive", scaled({"V"}, -1)},
    {"tangential-sign", "Pt counts left as positive", scaled({"Pt"}, -1)},
    {"degrees", "Omega is in degrees per second", scaled({"Omega", "Wx", "Wy", "Wz"}, radian)},
    {"milliseconds", "t is in milliseconds", scaled({"t"}, 1e-3)}};

/// Where a component of a vector stands in the rows, and with which sign.
struct From {
  int axis = 0;
  double sign = 1;
};

/// Vectors whose components are others, and what goes with that of spins and Euler parameters.
struct AxesReading {
  enum class Attitudes { as_they_are, of_the_world, of_all };
  std::array<From, 3> from{};
  double of_spin = 1;  ///< sign of the angular velocity beside the other vectors'
  Attitudes attitudes = Attitudes::as_they_are;
  double of_turn = 1;  ///< sign of the Euler parameters' vector

  [[nodiscard]] Vector3 read(const Vector3& row) const {
    return {from[0].sign * row[from[0].axis], from[1].sign * row[from[1].axis], from[2].sign * row[from[2].axis]};
  }
  [[nodiscard]] space::Matrix3 matrix() const {
    space::Matrix3 turn;
    for (int k = 0; k < 3; ++k) turn.col(k) = read(Vector3::Unit(k));
    return turn;
  }
  [[nodiscard]] bool is_exchange() const { return from[0].axis != 0 || from[1].axis != 1; }
};

/// Those with the fewest signs first.
const std::vector<AxesReading>& axes_readings() {
  static const std::vector<AxesReading> all = [] {
    using Attitudes = AxesReading::Attitudes;
    std::vector<AxesReading> readings;
    std::array<int, 3> order{0, 1, 2};
    do {
      for (int signs = 0; signs < 8; ++signs) {
        AxesReading one;
        for (std::size_t k = 0; k < 3; ++k) one.from[k] = {order[k], (signs >> k & 1) == 1 ? -1.0 : 1.0};
        for (const double of_spin : {1.0, -1.0}) {
          one.of_spin = of_spin;
          for (const Attitudes attitudes : {Attitudes::as_they_are, Attitudes::of_the_world, Attitudes::of_all}) {
            if (attitudes == Attitudes::of_the_world && one.matrix().determinant() < 0) continue;
            one.attitudes = attitudes;
            one.of_turn = 1;
            readings.push_back(one);
            if (attitudes != Attitudes::of_all) continue;
            one.of_turn = -1;
            readings.push_back(one);
          }
        }
      }
    } while (std::ranges::next_permutation(order).found);
    return readings;
  }();
  return all;
}

void read_by(const AxesReading& axes, const Cells& at) {
  for (const char* name : {"", "v", "w"}) {
    const std::string of = name;
    const Vector3 read = axes.read(at.vector(of)) * (of == "w" ? axes.of_spin : 1);
    for (int k = 0; k < 3; ++k) at(of + "xyz"[k]) = read[k];
  }
  if (axes.attitudes == AxesReading::Attitudes::as_they_are) return;
  space::Quaternion turn = at.attitude();
  if (axes.attitudes == AxesReading::Attitudes::of_the_world) turn = space::Quaternion(axes.matrix()) * turn;
  else turn.vec() = axes.of_turn * axes.read(turn.vec());
  at("q0") = turn.w(), at("q1") = turn.x(), at("q2") = turn.y(), at("q3") = turn.z();
}

/// "x, y, z stand as x, -z, y, of spins with the other sign, of the Euler parameters, too"
std::string words_of(const AxesReading& axes) {
  std::string words;
  for (const From& from : axes.from)
    words += fmt::format("{}{}{}", words.empty() ? "" : ", ", from.sign < 0 ? "-" : "", "xyz"[from.axis]);
  words = fmt::format("x, y, z stand in the columns {}", words);
  if (axes.of_spin < 0) words += ", of spins with the other sign";
  if (axes.attitudes == AxesReading::Attitudes::as_they_are) return words + ", but not in the Euler parameters";
  if (axes.attitudes == AxesReading::Attitudes::of_the_world) return words + " of a world turned so";
  return words +
         (axes.of_turn < 0 ? ", and of the Euler parameters with the other sign" : ", Euler parameters and all");
}

/// Rows that are right when read otherwise.
class ReadingCauses {
 public:
  ReadingCauses(const Answer& answer, const Reference& reference, const Score& score)
      : table_(answer.table), reference_(reference), answer_(answer), law_(score.law == "any" ? "" : score.law),
        error_(score.error()), law_error_(score.law_error) {
    if (answer.is_list || answer.table.rows() < 2) return;
    const Motion motion(answer.table, reference);
    contradicts_ = !motion.begins_after_touch() && !reference.stays() &&
                   (score.start_error > reference.tolerances[3] || !moves_freely(motion, reference));
  }

  void of_motion() {
    for (const Reading& reading : table_.column("q0") ? space_readings : planar_readings)
      add(reading, [&] { return score_as(reading); });
    if (all_right_) return;
    const Reading lowest{"lowest-point", "z is that of the lowest point, not of the centre of mass",
                         [&](const Cells& at) {
                           const space::Quaternion attitude = attitude_of(at).normalized();
                           at("z") -= reference_.arm(attitude, reference_.lowest(attitude)).z();
                         }};
    add(lowest, [&] { return score_as(lowest); });
    if (causes_.empty()) of_other_axes();
    contradicts_ = false;  // a start and flights of another point may be right by chance
    if (!all_right_) of_other_points();
  }

  /// Velocities of the row before.
  void of_late_velocities() {
    const std::size_t last = table_.rows() - 1;
    std::size_t next = 0;
    const NumericTable early = table_.changed([&](std::span<double> row) {
      next = std::min(next + 1, last);
      for (const char* name : {"vx", "vy", "vz", "omega", "wx", "wy", "wz"}) {
        if (const auto at = table_.column(name)) row[*at] = table_.at(next, *at);
      }
    });
    if (last < 2) return;
    add({"velocity-lag", "velocities are those of the row before", {}},
        [&] { return score_of(early.without(last, last)); });
  }

  void of_list() {
    for (const Reading& reading : list_readings)
      add(reading, [&] { return score_list(impacts(changed(reading)), reference_, law_, answer_.ending); });
    of_velocities_before();
    if (!reference_.is_planar || reference_.points.size() != 2) return;
    add({"ends-exchanged", "the ends are exchanged", {}}, [&] {
      std::vector<FoundImpact> exchanged = impacts(table_);
      for (FoundImpact& impact : exchanged) {
        if (impact.points.size() == 1) impact.points = {1 - impact.points.front()};
        impact.place = reference_.place_name(impact.points);
      }
      return score_list(exchanged, reference_, law_, answer_.ending);
    });
  }

  [[nodiscard]] const std::vector<Cause>& causes() const { return causes_; }

 private:
  /// Axes of the world that are others or point the other way, with the Euler parameters as they are, with those of a
  /// world turned so, or with their vector exchanged alike; one of a left-handed world has one sign or the other.
  void of_other_axes() {
    if (table_.rows() < 3) return;
    if (!table_.column("q0")) {
      of_planar_axes();
      return;
    }
    const NumericTable begin = table_.without(2, table_.rows() - 1);
    for (const AxesReading& axes : axes_readings()) {
      const auto change = [&](const Cells& at) { read_by(axes, at); };
      const auto as_read = [&](const NumericTable& rows) {
        return rows.changed([&](std::span<double> row) { change({rows, row}); });
      };
      try {
        if (!(Motion(as_read(begin), reference_).start_error() <= reference_.tolerances[2])) continue;
      } catch (const std::exception&) {
        continue;
      }
      const bool is_up = axes.from[2].axis != 2, is_exchange = axes.is_exchange();
      add({is_up         ? "y-up"
           : is_exchange ? "exchanged"
                         : "mirrored",
           words_of(axes), change},
          [&] { return score_of(as_read(table_)); });
      if (!causes_.empty()) return;
    }
  }

  /// The same in the plane, with phi counted from any axis and either way.
  void of_planar_axes() {
    const NumericTable begin = table_.without(2, table_.rows() - 1);
    for (int way = 1; way < 64 && causes_.empty(); ++way) {
      const bool is_exchange = (way & 32) != 0;
      const double of_x = (way & 4) != 0 ? -1 : 1, of_z = (way & 8) != 0 ? -1 : 1, turn = (way & 16) != 0 ? -1 : 1;
      const int quarter = way & 3;
      const auto change = [&](const Cells& at) {
        if (is_exchange) exchange_axes(at);
        scaled({"x", "vx"}, of_x)(at), scaled({"z", "vz"}, of_z)(at), scaled({"phi", "omega"}, turn)(at);
        at("phi") += quarter * std::numbers::pi / 2;
      };
      const auto as_read = [&](const NumericTable& rows) {
        return rows.changed([&](std::span<double> row) { change({rows, row}); });
      };
      if (!(Motion(as_read(begin), reference_).start_error() <= reference_.tolerances[2])) continue;
      const char *x = is_exchange ? "z" : "x", *z = is_exchange ? "x" : "z";
      const char* name = is_exchange ? "exchanged" : of_z < 0 ? "up-down" : of_x < 0 ? "left-right" : "phi-sign";
      add({name,
           fmt::format("x, z, phi stand as {}{}, {}{}, {}{}phi", of_x < 0 ? "-" : "", x, of_z < 0 ? "-" : "", z,
                       quarter == 0 ? "" : fmt::format("{}° ", 90 * quarter),
                       turn < 0      ? "-"
                       : quarter > 0 ? "+"
                                     : ""),
           change},
          [&] { return score_of(as_read(table_)); });
    }
  }

  /// Place and velocity of a corner or an end, in place of the centre of mass.
  void of_other_points() {
    for (std::size_t k = 0; k < reference_.body.vertices.size() && k < reference_.points.size(); ++k) {
      const Vector3 place = reference_.body.vertices[k];
      const Reading reading{
          "other-point",
          fmt::format("place and velocity are those of {}, not of the centre of mass", reference_.points[k]),
          [&](const Cells& at) { from_point(place, at); }};
      add(reading, [&] { return score_as(reading); });
      if (all_right_) return;
    }
  }

  /// Velocities of a list that its impulses change to those after each impact.
  void of_velocities_before() {
    std::vector<FoundImpact> found = impacts(table_);
    space::State state = reference_.start;
    double time = 0, off = 0;
    for (FoundImpact& impact : found) {
      if (impact.points.size() != 1) return;
      const space::State listed = impact.after;
      impact.before = reference_.flight(state).at(impact.time - time);
      off = worse(off, std::fabs(listed.velocity.z() - impact.before.velocity.z()));
      off = worse(off, reference_.reach() * (listed.angular_velocity - impact.before.angular_velocity).norm());
      impact.after = reference_.struck(impact.before, impact.points.front(), impact.impulse);
      impact.bookings = {{impact.before, impact.after}};
      state = impact.after, time = impact.time;
    }
    if (!(off <= reference_.tolerances[2] * reference_.speed())) return;
    add({"velocities-before", "velocities are those before each impact", {}},
        [&] { return score_list(found, reference_, law_, answer_.ending); });
  }

  [[nodiscard]] Score score_as(const Reading& reading) { return score_of(changed(reading)); }

  /// @throws std::domain_error if the rows do not move by their velocities
  [[nodiscard]] Score score_of(const NumericTable& table) {
    const Motion motion(table, reference_);
    shows_start_ = !motion.begins_after_touch();
    if (!moves_freely(motion, reference_)) throw std::domain_error("rows that contradict each other");
    return score_motion(motion, reference_, law_, answer_.ending);
  }

  [[nodiscard]] NumericTable changed(const Reading& reading) const {
    return table_.changed([&](std::span<double> row) { reading.change({table_, row}); });
  }

  [[nodiscard]] std::vector<FoundImpact> impacts(const NumericTable& table) const {
    return listed_impacts(table, reference_, answer_.is_counter_clockwise);
  }

  void add(const Reading& reading, auto&& judge) {
    Score score;
    try {
      score = judge();
    } catch (const std::exception&) {
      return;  // read so, the rows are no motion of the body
    }
    const double left = score.error();
    constexpr std::size_t few_rows = 6;  // may be right by chance
    const bool is_right = left <= explained * std::fmin(error_, 1);
    const double left_of_flights = worse(score.start_error, score.flight_error);
    const bool by_start =
        contradicts_ && shows_start_ && score.start_error <= reference_.tolerances[2] && left_of_flights <= explained &&
        score.law_error <= 2 * law_error_ + reference_.tolerances[2];  // else the start alone is another one
    if (!is_right && (!by_start || all_right_)) return;
    if (table_.rows() < few_rows && !(left <= reference_.tolerances[1])) return;
    if (is_right && !all_right_) causes_.clear();  // of these the start alone is right
    all_right_ |= is_right;
    causes_.push_back(
        {reading.name,
         {},
         by_start ? left_of_flights : left,
         fmt::format("{}: read so, {} right {}", reading.words, is_right ? "all is" : "the start and the flights are",
                     misfit_words(is_right ? left : left_of_flights))});
  }

  const NumericTable& table_;
  const Reference& reference_;
  const Answer& answer_;
  std::string law_;
  double error_, law_error_;
  bool contradicts_ = false;  ///< the start and the flights, as they are written
  bool shows_start_ = true;   ///< the rows as they were last read
  bool all_right_ = false;    ///< read as one of the causes has it
  std::vector<Cause> causes_;
};

}  // namespace

std::vector<Cause> misreadings_of(const Answer& answer, const Reference& reference, const Score& score) {
  ReadingCauses readings(answer, reference, score);
  if (answer.is_list) readings.of_list();
  else readings.of_motion();
  return readings.causes();
}

std::vector<Cause> late_velocities_of(const Answer& answer, const Reference& reference, const Score& score) {
  ReadingCauses readings(answer, reference, score);
  readings.of_late_velocities();
  return readings.causes();
}

}  // namespace clatter::validation
