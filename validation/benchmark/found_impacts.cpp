// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/found_impacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "validation/benchmark/step_impulses.hpp"

namespace clatter::validation::inline benchmark {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

constexpr double on_ground = 1e-6;         ///< of the reach
constexpr std::size_t most_steps = 20000;  ///< with jumps; a body at rest has one in each

/// Impulses of neighbouring steps at the same points.
struct Contact {
  std::vector<int> points;
  Vector3 impulse = Vector3::Zero();
  double weighted_time = 0;  ///< ∫ t dP_n
  std::size_t first_row = 0, last_row = 0;
  std::size_t steps = 0;
  double separation = 0;  ///< normal velocity after the last step [m/s]

  [[nodiscard]] double time() const { return weighted_time / impulse.z(); }
};

class Search {
 public:
  Search(const Motion& motion, const Reference& reference, const ImpactSearch& search)
      : motion_(motion), reference_(reference), search_(search) {}

  std::vector<FoundImpact> run() {
    for (std::size_t row = 0; row + 1 < motion_.size(); ++row) {
      const Motion::Jump jump = motion_.jump(row);
      const double least = least_jump(motion_.time(row + 1) - motion_.time(row));
      if (!(jump.impulse.norm() > least || jump.moment.norm() > least * reference_.reach())) {
        if (contacts_.size() >= search_.most && contacts_.back().last_row + 1 < row) break;
        continue;
      }
      if (++steps_ > most_steps || contacts_.size() > search_.most + 1) break;
      for (const StepImpulse& impulse : step_impulses(motion_, reference_, row)) add(row, impulse);
    }
    return impacts();
  }

 private:
  [[nodiscard]] double least_jump(double step) const {
    // A compliant contact begins and ends with forces as small as may be.
    const double share = reference_.is_compliant ? 0 : std::fmin(1, step / search_.spread_time);
    return std::fmax(search_.least_impulse * share, search_.rounding);
  }

  void add(std::size_t row, const StepImpulse& impulse) {
    if (impulse.points.empty() && impulse.impulse.norm() <= search_.least_impulse) return;  // drift
    Contact* contact = nullptr;
    for (Contact& one : contacts_) {
      if (one.points == impulse.points && one.last_row + 1 >= row) contact = &one;
    }
    // Points that had rebounded and come down anew have another impact.
    if (contact == nullptr || (contact->separation > 0 && impulse.approach < 0)) {
      contact = &contacts_.emplace_back();
      contact->points = impulse.points;
      contact->first_row = row;
    }
    contact->impulse += impulse.impulse;
    contact->weighted_time += impulse.time * impulse.impulse.z();
    contact->last_row = row + 1;
    contact->separation = impulse.separation;
    ++contact->steps;
  }

  [[nodiscard]] bool overlap(std::size_t i) const {
    return i + 1 < contacts_.size() && contacts_[i + 1].first_row < contacts_[i].last_row;
  }

  std::vector<FoundImpact> impacts() {
    std::erase_if(contacts_, [&](const Contact& one) { return one.impulse.norm() <= search_.least_impulse; });
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const Contact& a, const Contact& b) { return a.time() < b.time(); });
    std::vector<FoundImpact> found;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const bool follows = i > 0 && overlap(i - 1);
      found.push_back(impact(i, follows ? &found.back() : nullptr));
    }
    return found;
  }

  [[nodiscard]] FoundImpact impact(std::size_t i, const FoundImpact* previous) const {
    const Contact& contact = contacts_[i];
    const State start = motion_.state(contact.first_row), end = motion_.state(contact.last_row);
    const double begin = motion_.time(contact.first_row), finish = motion_.time(contact.last_row);
    FoundImpact impact{.points = contact.points,
                       .place = reference_.place_name(contact.points),
                       .impulse = contact.impulse,
                       .before = {},
                       .after = {},
                       .bookings = {},
                       .first_row = contact.first_row,
                       .last_row = contact.last_row};
    const bool alone = previous == nullptr && !overlap(i);
    const double time = alone && contact.steps > 1
                            ? begin + meeting_time(start, end, finish - begin, reference_.gravity)
                            : contact.time();
    impact.time = time - motion_.first_touch();
    impact.before = previous != nullptr ? reference_.flight(previous->after).at(impact.time - previous->time)
                                        : reference_.flight(start).at(time - begin);
    impact.after = overlap(i) ? struck(impact) : reference_.flight(end).at(time - finish);
    impact.bookings.push_back({impact.before, impact.after});
    if (alone && !is_resolved(impact)) add_bookings(impact, start, end);
    return impact;
  }

  /// Whether the points are on the ground at the instant at which the flights meet.
  [[nodiscard]] bool is_resolved(const FoundImpact& impact) const {
    const std::vector<Vector3> arms = reference_.arms(impact.before.attitude);
    return std::all_of(impact.points.begin(), impact.points.end(), [&](int point) {
      return std::fabs(impact.before.position.z() + arms[static_cast<std::size_t>(point)].z()) <=
             on_ground * reference_.reach();
    });
  }

  void add_bookings(FoundImpact& impact, const State& start, const State& end) const {
    const double fall = reference_.gravity * (motion_.time(impact.last_row) - motion_.time(impact.first_row));
    const Vector3 down(0, 0, fall);
    for (const space::Quaternion& pose : {impact.before.attitude, start.attitude, end.attitude}) {
      const auto add = [&](const Vector3& before, const Vector3& after) {
        Booking booking{impact.before, impact.after};
        booking.before.attitude = booking.after.attitude = pose;
        booking.before.velocity = before;
        booking.after.velocity = after;
        impact.bookings.push_back(booking);
      };
      add(impact.before.velocity, impact.after.velocity);
      if (!(fall > 0)) continue;
      add(start.velocity - down, end.velocity);
      add(start.velocity, end.velocity + down);
      add(start.velocity, end.velocity);
    }
  }

  [[nodiscard]] State struck(const FoundImpact& impact) const {
    return impact.points.empty() ? impact.before
                                 : reference_.struck(impact.before, impact.points.front(), impact.impulse);
  }

  const Motion& motion_;
  const Reference& reference_;
  const ImpactSearch search_;
  std::vector<Contact> contacts_;
  std::size_t steps_ = 0;
};

}  // namespace

std::vector<FoundImpact> find_impacts(const Motion& motion, const Reference& reference, const ImpactSearch& search) {
  return Search(motion, reference, search).run();
}

TableRequest impact_list_request(bool in_space, const ColumnNames& names) {
  return {.required = in_space ? std::vector<std::string>{"t", "Px", "Py", "Pz", "Vx", "Vy", "Vz", "Wx", "Wy", "Wz"}
                               : std::vector<std::string>{"t", "Pn", "Pt", "V", "Omega"},
          .optional = {},
          .words = {"place"},
          .names = names};
}

bool is_counter_clockwise(const NumericTable& table, const Reference& reference) {
  if (!table.column("Omega")) return false;
  const std::size_t omega = table.column("Omega").value(), normal = table.column("Pn").value();
  double agreement = 0, before = reference.start.angular_velocity.y();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto points = reference.place_named(table.word(row, "place"));
    if (!points) return false;
    // End a, to the left of the centre, is turned clockwise by a push upward.
    double lever = 0;
    for (const int point : *points) lever -= reference.body.vertices[static_cast<std::size_t>(point)].x();
    agreement += (table.at(row, omega) - before) * lever * table.at(row, normal);
    before = table.at(row, omega);
  }
  return agreement < 0;
}

std::vector<FoundImpact> listed_impacts(const NumericTable& table, const Reference& reference) {
  const auto number = [&](std::size_t row, const char* name) { return table.at(row, table.column(name).value()); };
  const auto vector = [&](std::size_t row, const char* x, const char* y, const char* z) {
    return Vector3(number(row, x), number(row, y), number(row, z));
  };
  const bool in_space = table.column("Px").has_value();
  const double clockwise = is_counter_clockwise(table, reference) ? -1 : 1;
  std::vector<FoundImpact> found;
  State state = reference.start;
  double time = reference.sequences.front().truth.front().time, shift = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double given = number(row, "t");
    if (row == 0) shift = given - time;
    if (row > 0 && !(given >= number(row - 1, "t"))) table.refuse(row, "t", "no earlier than in the row before");
    const auto points = reference.place_named(table.word(row, "place"));
    if (!points) table.refuse(row, "place", fmt::format("one of {}", fmt::join(reference.points, ", ")));
    FoundImpact impact{
        .points = *points,
        .place = reference.place_name(*points),
        .time = given - shift,
        .impulse = in_space ? vector(row, "Px", "Py", "Pz") : Vector3(number(row, "Pt"), 0, number(row, "Pn")),
        .before = reference.flight(state).at(given - shift - (row == 0 ? 0 : time)),
        .after = {},
        .bookings = {}};
    time = impact.time;
    state = impact.before;
    state.velocity = in_space
                         ? vector(row, "Vx", "Vy", "Vz")
                         : Vector3(state.velocity.x() + impact.impulse.x() / reference.body.mass, 0, number(row, "V"));
    state.angular_velocity = in_space ? vector(row, "Wx", "Wy", "Wz") : Vector3(0, clockwise * number(row, "Omega"), 0);
    impact.after = state;
    impact.bookings = {{impact.before, impact.after}};
    found.push_back(impact);
  }
  return found;
}

}  // namespace clatter::validation::inline benchmark
