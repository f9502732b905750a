// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/score.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Residuals of the angular momentum, relative to |P| × reach.
constexpr double rounding = 1e-7;       ///< of rows with the digits of a float
constexpr double clearly_one = 5e-3;    ///< a second impulse below this share is left out
constexpr double pose_of_a_step = 0.1;  ///< of codes that strike with a pose of their own
constexpr double together = 1e-6;       ///< heights of points that come down as one, relative to the reach

constexpr double on_ground = 1e-6;         ///< of the reach
constexpr std::size_t most_steps = 20000;  ///< with jumps; a body at rest has one in each

/// An impulse of a step at one point, or at several that came down together.
struct StepImpulse {
  std::vector<int> points;  ///< ascending; none: no point of the body explains the step
  analytic::space::Vector3 impulse = analytic::space::Vector3::Zero();  ///< [N·s]
  double time = 0;                                                      ///< [s]
  double approach = 0;    ///< normal velocity of the first of the points right before [m/s]
  double separation = 0;  ///< and right after [m/s]
};

/// The instant at which the flights before and after an impact meet, after the first row of its step and within it [s]:
///     s = (z₀ − z₁ + V₁ Δt + g Δt²/2)/(V₁ − V₀ + g Δt)                                               (1)
double meeting_time(const State& before, const State& after, double step, double gravity) {
  const double change = after.velocity.z() - before.velocity.z() + gravity * step;
  if (!(change > 0)) return step / 2;
  const double gap = before.position.z() - after.position.z() + after.velocity.z() * step + gravity * step * step / 2;
  return std::clamp(gap / change, 0.0, step);
}

/// Cuts the jump between two rows into impulses, the earlier first.
///
/// The heights alone say when its flights meet, (1).  A point r explains a jump if r × P is the change of the angular
/// momentum, at (1) or, since a code may strike with either, with the pose of the first or last row.  Two points do,
/// one after the other, if
///     r₁ × λP + r₂ × (1 − λ)P                                                                        (2)
/// is, r₁ where the flight before touches the ground, r₂ where the flight after leaves it.
/// A level edge or face explains any jump: friction all over it turns the body about the normal.
/// More than two impacts within a step cannot be told apart.
/// @pre row + 1 < motion.size()
class Step {
 public:
  Step(const Motion& motion, const Reference& reference, std::size_t row)
      : reference_(reference), start_time_(motion.time(row)), length_(motion.time(row + 1) - start_time_),
        before_(motion.state(row)), after_(motion.state(row + 1)), jump_(motion.jump(row)),
        flight_(reference.flight(before_)), flight_after_(reference.flight(after_)),
        middle_(meeting_time(before_, after_, length_, reference.gravity)), pose_(flight_.at(middle_)),
        scale_(std::fmax(jump_.impulse.norm() * reference.reach(), 1e-300)) {
    for (const space::State* state : {&pose_, &before_, &after_}) arms_.push_back(reference.arms(state->attitude));
    find_candidates();
  }

  [[nodiscard]] std::vector<StepImpulse> impulses() const {
    // The pressure of a compliant contact acts anywhere beside its corner.
    if (reference_.is_compliant && candidates_.size() == 1) return {whole(candidates_)};
    const One one = best_one();
    if (one.residual <= rounding) return {whole({one.point})};
    if (const std::vector<int> level = level_points(); !level.empty()) return {whole(level)};
    const Two two = best_two();
    const bool exact = two.is_timed && two.residual <= rounding * 1e-2;
    if (exact || (one.residual > clearly_one && two.residual < 0.3 * one.residual)) return both(two);
    if (one.residual <= pose_of_a_step) return {whole({one.point})};
    if (two.residual <= pose_of_a_step) return both(two);
    return {{.points = {}, .impulse = jump_.impulse, .time = start_time_ + middle_}};
  }

 private:
  struct One {
    int point = -1;
    double residual = std::numeric_limits<double>::infinity();
  };
  struct Two {
    int first = -1, second = -1;
    double share = 0;  ///< λ of the first
    double first_time = 0, second_time = 0;
    bool is_timed = false;  ///< the flights touch and leave the ground within the step, in this order
    double residual = std::numeric_limits<double>::infinity();
  };

  /// Points that can be on the ground within the step.
  void find_candidates() {
    const double speed =
        std::fmax(before_.velocity.norm(), after_.velocity.norm()) +
        reference_.reach() * std::fmax(before_.angular_velocity.norm(), after_.angular_velocity.norm());
    const double margin = reference_.is_compliant ? 0 : 0.02 * reference_.reach() + speed * length_;
    const double heights[]{pose_.position.z(), before_.position.z(), after_.position.z()};
    for (std::size_t k = 0; k < reference_.points.size(); ++k) {
      double lowest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i) lowest = std::fmin(lowest, heights[i] + arms_[i][k].z());
      if (lowest <= margin) candidates_.push_back(static_cast<int>(k));
    }
  }

  [[nodiscard]] One best_one() const {
    One best;
    for (const int k : candidates_) {
      for (const auto& arms : arms_) {
        const double residual = (jump_.moment - arms[static_cast<std::size_t>(k)].cross(jump_.impulse)).norm() / scale_;
        if (residual < best.residual) best = {k, residual};
      }
    }
    return best;
  }

  [[nodiscard]] double height(const space::FreeFlight& flight, int point, double time) const {
    return reference_.height(flight.at(time), point);
  }

  /// When the point is at height 0 on a flight, between two times at which it is above and below; none otherwise.
  [[nodiscard]] double crossing(const space::FreeFlight& flight, int point, double above, double below) const {
    const double slack = 1e-9 * reference_.reach();
    if (!(height(flight, point, above) > -slack && height(flight, point, below) < slack)) return none;
    for (int i = 0; i < 100; ++i) {
      const double middle = (above + below) / 2;
      (height(flight, point, middle) > 0 ? above : below) = middle;
    }
    return (above + below) / 2;
  }

  [[nodiscard]] Two pair(int first, int second) const {
    Two two{.first = first, .second = second, .first_time = middle_, .second_time = middle_};
    const auto k = static_cast<std::size_t>(first), l = static_cast<std::size_t>(second);
    const double touch = crossing(flight_, first, 0, length_);
    const double leave = crossing(flight_after_, second, 0, -length_) + length_;
    std::vector<std::pair<Vector3, Vector3>> arms;
    if (touch <= leave) {
      arms.emplace_back(reference_.arm(flight_.at(touch).attitude, first),
                        reference_.arm(flight_after_.at(leave - length_).attitude, second));
    }
    for (const auto& pose : arms_) arms.emplace_back(pose[k], pose[l]);
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const auto& [a, b] = arms[i];
      const Vector3 turn = (a - b).cross(jump_.impulse), rest = jump_.moment - b.cross(jump_.impulse);
      const double share = turn.dot(rest) / turn.squaredNorm();
      const double residual = (rest - share * turn).norm() / scale_;
      if (!(share > 0 && share < 1 && residual < two.residual)) continue;
      two.share = share;
      two.residual = residual;
      if (i > 0 || !(touch <= leave)) continue;
      two.is_timed = true;
      two.first_time = touch;
      two.second_time = leave;
      if (residual <= rounding) break;  // in the plane other poses can fit as well
    }
    return two;
  }

  [[nodiscard]] static bool is_better(const Two& two, const Two& best) {
    if (two.residual > rounding || best.residual > rounding) return two.residual < best.residual;
    if (two.is_timed != best.is_timed) return two.is_timed;
    return two.is_timed ? two.first_time < best.first_time : two.residual < best.residual;
  }

  [[nodiscard]] Two best_two() const {
    Two best;
    for (const int k : candidates_) {
      for (const int l : candidates_) {
        if (k == l) continue;
        const Two two = pair(k, l);
        if (!two.is_timed && comes_after(k, l)) continue;
        if (is_better(two, best)) best = two;
      }
    }
    return best;
  }

  /// Whether of two points without times the first comes later: the other alone approaches, or is the lower one.
  [[nodiscard]] bool comes_after(int k, int l) const {
    const bool approaches = speed_of(before_, k) < 0;
    return approaches == (speed_of(before_, l) < 0) ? reference_.height(before_, k) > reference_.height(before_, l)
                                                    : !approaches;
  }

  [[nodiscard]] double height_between(int k) const {
    return pose_.position.z() + arms_[0][static_cast<std::size_t>(k)].z();
  }

  [[nodiscard]] std::vector<int> at_level(double level) const {
    std::vector<int> group;
    for (const int k : candidates_) {
      if (std::fabs(height_between(k) - level) <= together * reference_.reach()) group.push_back(k);
    }
    return group;
  }

  /// The points of an edge or a face that come down as one in space, or a rim that lies level; none.
  [[nodiscard]] std::vector<int> level_points() const {
    if (reference_.is_planar || candidates_.empty() || !(jump_.impulse.z() > 0)) return {};
    const int lowest = *std::min_element(candidates_.begin(), candidates_.end(),
                                         [&](int k, int l) { return height_between(k) < height_between(l); });
    std::vector<int> group = at_level(height_between(lowest));
    const bool is_level = group.size() > 1 || reference_.corner(pose_.attitude, lowest).radius > 0;
    return is_level ? group : std::vector<int>{};
  }

  /// Normal velocity of a point.
  [[nodiscard]] double speed_of(const State& state, int point) const { return reference_.velocity(state, point).z(); }

  [[nodiscard]] StepImpulse whole(const std::vector<int>& points) const {
    const State after = flight_after_.at(middle_ - length_);
    return {.points = points,
            .impulse = jump_.impulse,
            .time = start_time_ + middle_,
            .approach = speed_of(pose_, points.front()),
            .separation = speed_of(after, points.front())};
  }

  [[nodiscard]] std::vector<StepImpulse> both(const Two& two) const {
    const double level = height_between(two.first);
    if (std::fabs(level - height_between(two.second)) <= together * reference_.reach()) return {whole(at_level(level))};
    const State before = flight_.at(two.first_time);
    const Vector3 first = two.share * jump_.impulse, second = jump_.impulse - first;
    const State after = reference_.struck(before, two.first, first);
    const State then = reference_.flight(after).at(two.second_time - two.first_time);
    return {{.points = {two.first},
             .impulse = first,
             .time = start_time_ + two.first_time,
             .approach = speed_of(before, two.first),
             .separation = speed_of(after, two.first)},
            {.points = {two.second},
             .impulse = second,
             .time = start_time_ + two.second_time,
             .approach = speed_of(then, two.second),
             .separation = speed_of(flight_after_.at(two.second_time - length_), two.second)}};
  }

  const Reference& reference_;
  double start_time_, length_;
  State before_, after_;
  Motion::Jump jump_;
  space::FreeFlight flight_, flight_after_;
  double middle_;
  State pose_;
  double scale_;
  std::vector<std::vector<Vector3>> arms_;  ///< at (1), in the first and in the last row
  std::vector<int> candidates_;
};

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

constexpr double least_share = 2e-3;  ///< of the truth's smallest impulse: what counts as an impact

/// What is looked for in a motion.
struct ImpactSearch {
  double least_impulse = 0;  ///< smaller impacts are none: rounding, drift [N·s]
  double spread_time = 0;    ///< over which a code may spread an impact: shorter steps have their share of it [s]
  double rounding = 0;       ///< smaller jumps of a step are none [N·s]
  std::size_t most = 0;      ///< impacts to find
};

ImpactSearch search_for(const Reference& reference) {
  constexpr double float_rounding = 1e-6;  // of momentum, of codes with the digits of a float
  constexpr double shortest_way = 0.02;    // of the reach, within which a compliant code turns the body round
  ImpactSearch search{
      .least_impulse = std::numeric_limits<double>::infinity(),
      .spread_time = shortest_way * reference.reach() / reference.speed(),
      .rounding = (reference.is_compliant ? 1e-3 : 1.0) * float_rounding * reference.body.mass * reference.speed(),
      .most = reference.sequences.front().truth.size() + 1};
  for (const ReferenceSequence& sequence : reference.sequences) {
    for (const TruthRow& row : sequence.truth)
      search.least_impulse = std::fmin(search.least_impulse, least_share * row.impulse.norm());
  }
  return search;
}

class Search {
 public:
  Search(const Motion& motion, const Reference& reference)
      : motion_(motion), reference_(reference), search_(search_for(reference)) {}

  std::vector<FoundImpact> run() {
    for (std::size_t row = 0; row + 1 < motion_.size(); ++row) {
      const Motion::Jump jump = motion_.jump(row);
      const double least = least_jump(motion_.time(row + 1) - motion_.time(row));
      const bool jumps = jump.impulse.norm() > least || jump.moment.norm() > least * reference_.reach();
      if (!jumps && !lasts(row)) {
        if (contacts_.size() >= search_.most && contacts_.back().last_row + 1 < row) break;
        continue;
      }
      if (++steps_ > most_steps || contacts_.size() > search_.most + 1) break;
      for (const StepImpulse& impulse : Step(motion_, reference_, row).impulses()) add(row, impulse);
    }
    return impacts();
  }

 private:
  [[nodiscard]] double least_jump(double step) const {
    // A compliant contact begins and ends with forces as small as may be.
    const double share = reference_.is_compliant ? 0 : std::fmin(1, step / search_.spread_time);
    return std::fmax(search_.least_impulse * share, search_.rounding);
  }

  /// Whether the last contact goes on in this row: it ends with forces as small as may be, in the ground.
  [[nodiscard]] bool lasts(std::size_t row) const {
    if (!reference_.is_compliant || contacts_.empty() || contacts_.back().last_row != row) return false;
    const State state = motion_.state(row);
    return std::ranges::any_of(contacts_.back().points, [&](int k) { return reference_.height(state, k) < 0; });
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
                       .first_row = contact.first_row,
                       .last_row = contact.last_row,
                       .first_line = motion_.line(contact.first_row),
                       .last_line = motion_.line(contact.last_row)};
    const bool alone = previous == nullptr && !overlap(i);
    const double time = alone && contact.steps > 1
                            ? begin + meeting_time(start, end, finish - begin, reference_.gravity)
                            : contact.time();
    impact.time = time - motion_.first_touch();
    impact.before = previous != nullptr ? reference_.flight(previous->after).at(impact.time - previous->time)
                                        : reference_.flight(start).at(time - begin);
    impact.after = overlap(i) ? struck(impact) : reference_.flight(end).at(time - finish);
    impact.bookings.push_back({impact.before, impact.after});
    impact.begins_in_a_row = alone && !impact.points.empty() && touches(start, impact.points);
    const bool is_placed = !impact.points.empty();
    impact.is_resolved =
        touches(impact.before, is_placed ? impact.points : std::vector{reference_.lowest(impact.before.attitude)});
    if (alone && (impact.begins_in_a_row || !impact.is_resolved)) add_bookings(impact, start, end, impact.bookings);
    if (impact.begins_in_a_row) add_first_step(impact, start);
    if (is_pair(i)) add_pair(impact, i, start, end);
    else if (i > 0 && is_pair(i - 1)) add_pair(impact, i - 1, start, end);
    return impact;
  }

  /// Whether a contact and the next one are those of one step.
  [[nodiscard]] bool is_pair(std::size_t i) const {
    if (i + 1 >= contacts_.size()) return false;
    const Contact &one = contacts_[i], &next = contacts_[i + 1];
    return one.steps == 1 && next.steps == 1 && one.first_row == next.first_row && !one.points.empty() &&
           !next.points.empty();
  }

  void add_pair(FoundImpact& impact, std::size_t i, const State& start, const State& end) const {
    impact.pair = {contacts_[i].points, contacts_[i + 1].points};
    add_bookings(impact, start, end, impact.of_pair);
  }

  /// Whether the points are on the ground.
  [[nodiscard]] bool touches(const State& state, const std::vector<int>& points) const {
    return std::ranges::all_of(
        points, [&](int k) { return std::fabs(reference_.height(state, k)) <= on_ground * reference_.reach(); });
  }

  /// A code that adds its step's gravity before the impact, where a row has more than one step.
  void add_first_step(FoundImpact& impact, const State& start) const {
    const Vector3 fall = motion_.step() * reference_.pull();
    const double late = impact.time + motion_.first_touch() - motion_.time(impact.first_row);
    Booking booking{start, start};
    booking.before.velocity += fall;
    booking.after.velocity = impact.after.velocity - late * reference_.pull() + fall;
    booking.after.angular_velocity = impact.after.angular_velocity;
    impact.bookings.push_back(booking);
  }

  /// The velocities of the flights at the impact, and those of the rows with the step's flight before the impact, after
  /// it or in it; in space a step may turn by Euler's method.
  void add_bookings(const FoundImpact& impact, const State& start, const State& end,
                    std::vector<Booking>& bookings) const {
    const double time = motion_.time(impact.last_row) - motion_.time(impact.first_row);
    std::vector<Booking> own;
    if (impact.pair.empty()) own.push_back({impact.before, impact.after});
    if (reference_.gravity > 0) {
      own.push_back({reference_.flight(start).at(time), end});
      own.push_back({start, reference_.flight(end).at(-time)});
      own.push_back({start, end});
      if (!reference_.is_planar)
        own.push_back({flown(reference_, start, time, {.turning = Turning::by_new, .step = motion_.step()}), end});
    }
    for (const space::Quaternion& pose : {impact.before.attitude, start.attitude, end.attitude}) {
      for (Booking booking : own) {
        booking.before.attitude = booking.after.attitude = pose;
        bookings.push_back(booking);
      }
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

std::vector<FoundImpact> impacts_of(const Motion& motion, const Reference& reference) {
  return Search(motion, reference).run();
}

TableRequest impact_list_request(bool in_space, const ColumnNames& names) {
  return {.required = in_space ? std::vector<std::string>{"t", "Px", "Py", "Pz", "Vx", "Vy", "Vz", "Wx", "Wy", "Wz"}
                               : std::vector<std::string>{"t", "Pn", "Pt", "V", "Omega"},
          .optional = {},
          .words = {"place"},
          .names = names};
}

std::vector<FoundImpact> listed_impacts(const NumericTable& table, const Reference& reference,
                                        bool is_counter_clockwise) {
  const auto number = [&](std::size_t row, const char* name) { return table.at(row, table.column(name).value()); };
  const auto vector = [&](std::size_t row, const char* x, const char* y, const char* z) {
    return Vector3(number(row, x), number(row, y), number(row, z));
  };
  const bool in_space = table.column("Px").has_value();
  const double clockwise = is_counter_clockwise ? -1 : 1;
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
        .first_line = table.line(row),
        .last_line = table.line(row)};
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

}  // namespace clatter::validation
