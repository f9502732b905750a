// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <span>

#include "validation/output/number.hpp"

namespace clatter::validation {

std::string three_digits(double value) { return significant(value, 3); }

std::string misfit_words(double misfit) { return "to " + significant(std::fmax(misfit, 1e-16), 1); }

namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

constexpr double well_explained = 3;   ///< times the least misfit, within which another hypothesis is told as well
constexpr double least_misfit = 1e-9;  ///< below it misfits do not decide between hypotheses

/// The slope of b over a through the origin, by least squares, and the largest residual.
Fitted slope_of(const std::vector<std::pair<double, double>>& points) {
  double aa = 0, ab = 0;
  for (const auto& [a, b] : points) aa += a * a, ab += a * b;
  Fitted fit{ab / aa, 0};
  for (const auto& [a, b] : points) fit.misfit = worse(fit.misfit, std::fabs(b - fit.value * a));
  return fit;
}

/// How high above the ground each impact is, and how late it is, if its point falls freely.
struct Misses {
  std::vector<double> heights, delays;

  Misses(const Reference& reference, std::span<const FoundImpact> impacts) {
    for (const FoundImpact& impact : impacts) {
      if (impact.points.empty()) continue;
      heights.push_back(reference.height(impact.before, impact.points.front()));
      const double speed = -reference.velocity(impact.before, impact.points.front()).z();
      const double square = speed * speed + 2 * reference.gravity * heights.back();  // at the ground
      delays.push_back(-2 * heights.back() / (speed + std::sqrt(std::fmax(square, 0))));
      // The point turns with the body, too: Newton's steps back along the flight.
      const analytic::space::FreeFlight flight = reference.flight(impact.before);
      for (int i = 0; i < 3 && delays.back() > 0; ++i) {
        const State then = flight.at(-delays.back());
        const int point = impact.points.front();
        delays.back() += reference.height(then, point) / reference.velocity(then, point).z();
      }
    }
  }

  /// Difference of the extremes over the larger of them.
  static double spread(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return (*high - *low) / std::fmax(std::fabs(*high), std::fabs(*low));
  }
};

/// All of the motion above or below its place by one height: the rows less that height are right.
void add_margin(const Answer& answer, const Reference& reference, const Score& score,
                const std::vector<FoundImpact>& impacts, const Misses& misses, std::vector<Cause>& causes) {
  if (impacts.empty() || reference.is_compliant) return;
  // So high above the ground that no point explains the jump.
  const bool is_far = impacts.front().points.empty();
  const State& first = impacts.front().before;
  const double height = is_far ? reference.height(first, reference.lowest(first.attitude)) : misses.heights.front();
  if (!(std::fabs(height) > 1e-5 * reference.reach())) return;
  if (!is_far && !(Misses::spread(misses.heights) <= explained)) return;
  const std::size_t z = answer.table.column("z").value();
  const NumericTable lower = answer.table.changed([&](std::span<double> row) { row[z] -= height; });
  const std::string law = score.law == "any" ? "" : score.law;
  const double left = score_motion(Motion(lower, reference), reference, law, answer.ending).error();
  if (!(left <= explained * std::fmin(score.error(), 1))) return;
  causes.push_back(
      {"margin", height, left,
       fmt::format("the body strikes {} m {}: less that height all is right {}", three_digits(std::fabs(height)),
                   height > 0 ? "above the ground" : "deep in the ground", misfit_words(left))});
}

/// The same of a code of steps, by the height from which its first row would have its velocity: less that height its
/// start is right, where it was wrong, and its first impact is as near to the ground as its steps have it.
void add_height(const Answer& answer, const Motion& motion, const Reference& reference,
                const std::vector<FoundImpact>& impacts, std::vector<Cause>& causes) {
  if (impacts.empty() || !(reference.gravity > 0) || !(motion.start_error() > reference.tolerances[3])) return;
  const double speed = reference.start.velocity.z(), now = motion.state(0).velocity.z();
  const double asked = reference.start.position.z() + (speed * speed - now * now) / (2 * reference.gravity);
  const double height = motion.state(0).position.z() - asked;
  const State& first = impacts.front().before;
  const double miss = reference.height(first, reference.lowest(first.attitude)) - height;
  const std::size_t z = answer.table.column("z").value();
  const NumericTable lower = answer.table.changed([&](std::span<double> row) { row[z] -= height; });
  const double left = Motion(lower, reference).start_error();
  if (!(std::fabs(miss) <= 2 * motion.step() * reference.speed()) || !(left <= reference.tolerances[2])) return;
  causes.push_back({"margin", height, left,
                    fmt::format("all of it is {} m too {}: less that height the start is right {}",
                                three_digits(std::fabs(height)), height > 0 ? "high" : "low", misfit_words(left))});
}

/// Whether the velocities change over several steps, from the touch on, and the middle is so late; half of the time
/// that contacts take.
bool contacts_last(const Motion& motion, std::span<const FoundImpact> impacts, double delay) {
  return std::all_of(impacts.begin(), impacts.end(), [&](const FoundImpact& impact) {
    const double lasts = motion.time(impact.last_row) - motion.time(impact.first_row);
    const auto steps = static_cast<double>(impact.last_row - impact.first_row);
    return steps >= 2 && std::fabs(lasts - 2 * delay) <= 2 * lasts / steps;
  });
}

/// Whether an impact falls on a row, as one at the end of a step.
bool is_at_row(const Motion& motion, const FoundImpact& impact) {
  const double steps = (impact.time + motion.first_touch() - motion.time(impact.first_row)) / motion.step();
  return std::fabs(steps - std::round(steps)) <= 1e-3;
}

/// "0.00200 to 0.00225", or one number where both are the same.
std::string range_words(double low, double high) {
  const std::string one = three_digits(low), other = three_digits(high);
  return one == other ? one : one + " to " + other;
}

/// Impacts of a code of steps that all come early by more than a step, above the ground by one height but for a step's
/// way, or all late by one time but for a step, and that of two steps at least.
void add_offset_of_steps(const Motion& motion, std::span<const FoundImpact> impacts, const Reference& reference,
                         const Misses& misses, std::vector<Cause>& causes) {
  const double step = 1.001 * motion.step();
  const auto is_instant = [](const FoundImpact& one) {
    return !one.points.empty() && one.last_row == one.first_row + 1;
  };
  if (misses.delays.empty() || !std::ranges::all_of(impacts, is_instant)) return;
  const auto [soonest, latest] = std::ranges::minmax(misses.delays);
  const auto [lowest, highest] = std::ranges::minmax(misses.heights);
  double way = 0;
  for (const FoundImpact& one : impacts)
    way = std::fmax(way, -step * reference.velocity(one.before, one.points.front()).z());
  if (lowest > way && highest - lowest <= way) {
    causes.push_back(
        {"margin", highest, (highest - lowest) / highest,
         fmt::format("the body strikes {} m above the ground, more than a step's way", range_words(lowest, highest))});
  } else if (soonest >= 2 * step && latest - soonest <= step && impacts.size() > 1) {
    causes.push_back({"delay", soonest, (latest - soonest) / latest,
                      fmt::format("each impact comes {} s late, and a step is {} s", range_words(soonest, latest),
                                  three_digits(motion.step()))});
  }
}

/// Impacts that come late by one time.
/// @param by_steps whether the code strikes at its steps: within one, times are alike by chance
void add_delay(const Motion& motion, const Reference& reference, std::span<const FoundImpact> impacts,
               const Misses& misses, bool by_steps, std::vector<Cause>& causes) {
  const std::vector<double>& delays = misses.delays;
  if (by_steps) add_offset_of_steps(motion, impacts, reference, misses, causes);
  if (!causes.empty() || delays.size() < 2 || !(std::fabs(misses.heights.front()) > 1e-5 * reference.reach())) return;
  const double left = Misses::spread(delays);
  const bool is_within_step = by_steps && delays.front() <= 1.001 * motion.step();
  if (!(left <= (is_within_step ? 1e-3 : explained)) || !(delays.front() > 0)) return;
  if (contacts_last(motion, impacts, delays.front())) {
    causes.push_back({"contact-time", 2 * delays.front(), left,
                      fmt::format("its contacts take {} s: an impact counts in the middle, {} s after the touch, {}",
                                  three_digits(2 * delays.front()), three_digits(delays.front()), misfit_words(left))});
    return;
  }
  // A code of steps may strike at the first row after the touch, always as late by chance.
  if (is_within_step && std::ranges::all_of(impacts, [&](const auto& one) { return is_at_row(motion, one); })) return;
  causes.push_back({"delay", delays.front(), left,
                    fmt::format("each impact comes {} s late, {}", three_digits(delays.front()), misfit_words(left))});
}

/// Impacts at the touch that follow the law with the step's gravity added before them, or after.
void add_booked_gravity(const Motion& motion, const Reference& reference, double left, std::vector<Cause>& causes) {
  const double gravity = motion.step() * reference.pull().norm();
  if (!(gravity > reference.tolerances[1] * reference.speed())) return;
  causes.push_back({"time-step", motion.step(), left,
                    fmt::format("impacts follow the law {} if the step's gravity, g·step = {} m/s, is added before "
                                "or after them, in steps of {} s: the step explains the rest",
                                misfit_words(left), three_digits(gravity), three_digits(motion.step()))});
}

/// Impacts that follow the law at the run's own poses, as a step of time has them: near the touch, not at it.
/// @param flight_left the flight error, without what the step explains of it
void add_time_step(const Motion& motion, const Reference& reference, const Score& score, double flight_left,
                   const std::vector<FoundImpact>& impacts, std::vector<Cause>& causes) {
  const double left = worse(score.law_error, flight_left);
  const double most = std::fmin(explained * score.motion_error(), reference.tolerances[2]);
  if (reference.is_compliant || !(score.order_is_right || score.ends_early) || impacts.empty() || !(left <= most))
    return;
  double latest = 0, longest = 0, deepest = 0;
  for (const FoundImpact& impact : impacts) {
    const double approach = -reference.velocity(impact.before, impact.points.front()).z();
    const double step = motion.time(impact.last_row) - motion.time(impact.first_row);
    const double height = reference.height(impact.before, impact.points.front()), delay = std::fabs(height / approach);
    if (!(delay <= 2 * step)) return;
    deepest = std::fmax(deepest, -height);
    latest = std::fmax(latest, delay), longest = std::fmax(longest, step);
  }
  if (!(latest > 1e-3 * longest)) {
    add_booked_gravity(motion, reference, left, causes);
    return;
  }
  causes.push_back(
      {"time-step", latest, left,
       fmt::format("impacts follow the law {} at the steps' own poses, up to {} s from the touch{}, in steps "
                   "of {} s: the step explains the rest",
                   misfit_words(left), three_digits(latest),
                   deepest > 0 ? fmt::format(", {} m deep in the ground", three_digits(deepest)) : "",
                   three_digits(longest))});
}

/// Rows beside a motion that is right without them.
std::vector<Cause> stray_rows_of(const Answer& answer, const Motion& motion, const Reference& reference,
                                 const Score& score) {
  constexpr std::size_t few_rows = 6;
  if (!score.stray) return {};
  const Stray& stray = *score.stray;
  const std::string law = score.law == "any" ? "" : score.law;
  for (const auto& [from, to] : stray.alone) {
    const std::size_t first = motion.table_row(from), last = motion.table_row(to);
    if (motion.size() < few_rows + last - first) continue;
    const Motion rest(answer.table.without(first, last), reference);
    const double left = score_motion(rest, reference, law, answer.ending).error();
    if (!(left <= explained * std::fmin(score.error(), 1))) continue;
    const std::size_t line = answer.table.line(first), end = answer.table.line(last);
    const std::string words =
        first == last ? fmt::format("line {}: {} off the flight between its neighbours, without it", line, stray.size)
                      : fmt::format("lines {} to {}: {} off the flight between their neighbours, without them", line,
                                    end, stray.size);
    return {{"stray-rows", {}, left, fmt::format("{} all is right {}", words, misfit_words(left))}};
  }
  return {};
}

/// Impulses of a list that are those of another mass than its velocities.
void add_mass(const Reference& reference, const std::vector<FoundImpact>& impacts, std::vector<Cause>& causes) {
  std::vector<std::pair<double, double>> points;
  double error = 0, largest = 0;
  for (const FoundImpact& impact : impacts) {
    const double change = reference.body.mass * (impact.after.velocity.z() - impact.before.velocity.z());
    points.emplace_back(change, impact.impulse.z());
    error = worse(error, std::fabs(impact.impulse.z() - change));
    largest = std::fmax(largest, std::fabs(change));
  }
  if (points.empty() || !(error > reference.tolerances[1] * largest)) return;
  const Fitted fit = slope_of(points);
  if (!(fit.misfit <= explained * error)) return;
  causes.push_back({"mass", fit.value * reference.body.mass, fit.misfit / largest,
                    fmt::format("a mass of {} kg ({} kg is asked) explains the impulses beside the velocities {}",
                                three_digits(fit.value * reference.body.mass), shortest(reference.body.mass),
                                misfit_words(fit.misfit / largest))});
}

/// The best, and another that is as good.
std::vector<Cause> chosen(std::vector<Cause> causes) {
  std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
    return std::fmax(a.misfit, least_misfit) < std::fmax(b.misfit, least_misfit);
  });
  if (causes.empty()) return causes;
  const double most = well_explained * std::fmax(causes.front().misfit, least_misfit);
  std::erase_if(causes, [&](const Cause& cause) { return !(cause.misfit <= most); });
  if (causes.size() > 2 && !causes[1].is_more) causes.resize(2);
  return causes;
}

/// What the columns of a run mean in place of what they should.
std::vector<Cause> readings_of(const Answer& answer, const Motion& motion, const Reference& reference,
                               const Score& score) {
  constexpr std::size_t most_rows = 100'000;
  std::vector<Cause> causes;
  const bool is_strange =
      score.start_error > 1e-2 || score.flight_error > 1e-2 || score.law_error > 2e-2 || !(score.motion_error() <= 0.5);
  if (answer.table.rows() <= most_rows) {
    if (is_strange) causes = misreadings_of(answer, reference, score);
    if (causes.empty()) causes = late_velocities_of(answer, reference, score);
  }
  constexpr double much = 2e-2;  // a reading that leaves more may be right by chance, in a run that hardly moves
  if (std::ranges::none_of(causes, [](const Cause& cause) { return cause.misfit <= much; })) {
    if (auto scale = velocity_scale_of(motion, reference)) causes.push_back(std::move(*scale));
  }
  return causes;
}

std::vector<Cause> causes_of_list(const Answer& answer, const Reference& reference, const ReferenceSequence& sequence,
                                  const Score& score, Trials& trials) {
  std::vector<Cause> causes = misreadings_of(answer, reference, score);
  if (!causes.empty()) return chosen(std::move(causes));
  const std::vector<FoundImpact> impacts = listed_impacts(answer.table, reference, answer.is_counter_clockwise);
  causes = impact_causes_of(reference, sequence.law, impacts, 0, trials);
  add_mass(reference, impacts, causes);
  return chosen(std::move(causes));
}

/// The largest law error that a step does not make.
double law_left_by_step(const Reference& reference, const DeclaredLaw& law, std::span<const FoundImpact> impacts,
                        double gravity_of_step) {
  double left = 0;
  for (const FoundImpact& impact : impacts) {
    const double error = law_error(reference, law, impact);
    if (!(error <= 2 * law_error_of_speed(reference, impact, gravity_of_step))) left = worse(left, error);
  }
  return left;
}

// What the steps of a code are worth, by a code that follows the law from the run's own start.

/// How a code goes on in time.
struct Stepping {
  double step = 0;  ///< at whose ends it strikes what is in the ground; 0: it resolves the instants [s]
  Flying flying{};
  bool gravity_first = false;  ///< whether an impact has the gravity of the step that begins with it
  bool as_listed = false;      ///< whether points of one step are struck as the body lists them; else the lowest first
  bool flies_first = false;    ///< whether what touches in the first row is struck a step later
};

/// A code that starts as a run does and follows the law.
class Replay {
 public:
  Replay(const Motion& motion, const Reference& reference, const DeclaredLaw& law, const Stepping& stepping)
      : motion_(motion), reference_(reference), law_(law), stepping_(stepping), state_(motion.state(0)),
        time_(motion.time(0) - motion.first_touch()) {}

  std::vector<FoundImpact> run(std::size_t most) {
    constexpr int longest = 100'000;
    const double end = motion_.time(motion_.size() - 1) - motion_.first_touch();
    for (int i = 0; i < longest && time_ <= end && impacts_.size() < most; ++i) {
      if (stepping_.step > 0) {
        if (i > 0 || !stepping_.flies_first) strike();
        move(stepping_.step);
        continue;
      }
      State ahead = state_;
      ahead.velocity += stepping_.flying.creep;  // the flight's places
      move(touch_time(reference_, reference_.flight(ahead)));
      if (time_ <= end) strike();
    }
    return std::move(impacts_);
  }

 private:
  void move(double time) {
    state_ = flown(reference_, state_, time, stepping_.flying);
    time_ += time;
  }

  /// Strikes what is on the ground or in it and goes down, level points as one.
  void strike() {
    const Vector3 fall = stepping_.gravity_first ? stepping_.step * reference_.pull() : Vector3(0, 0, 0);
    const double close = 1e-9 * reference_.reach();
    const std::vector<Vector3> arms = reference_.arms(state_.attitude);
    const auto height = [&](int k) { return state_.position.z() + arms[static_cast<std::size_t>(k)].z(); };
    std::vector<int> low;
    for (int k = 0; k < static_cast<int>(arms.size()); ++k) {
      if (height(k) <= close) low.push_back(k);
    }
    if (!stepping_.as_listed) std::ranges::sort(low, {}, height);
    state_.velocity += fall;
    std::size_t noted = impacts_.size();
    for (std::size_t i = 0; i < low.size();) {
      std::vector<int> level;
      for (const double least = height(low[i]); i < low.size() && std::fabs(height(low[i]) - least) <= close; ++i) {
        if (reference_.velocity(state_, low[i]).z() < 0) level.push_back(low[i]);
      }
      if (!level.empty()) note(level);
    }
    state_.velocity -= fall;
    for (; noted < impacts_.size(); ++noted) {  // what its instant has is the flight's velocity
      impacts_[noted].before.velocity -= fall;
      impacts_[noted].after.velocity -= fall;
    }
  }

  void note(std::vector<int> points) {
    std::ranges::sort(points);
    const State before = state_;
    state_ = exact_map(reference_, law_, before, points);
    impacts_.push_back({.points = points,
                        .place = reference_.place_name(points),
                        .time = time_,
                        .impulse = reference_.body.mass * (state_.velocity - before.velocity),
                        .before = before,
                        .after = state_,
                        .bookings = {{before, state_}}});
  }

  const Motion& motion_;
  const Reference& reference_;
  const DeclaredLaw& law_;
  const Stepping stepping_;
  State state_;
  double time_;  ///< since the run's first touch [s]
  std::vector<FoundImpact> impacts_;
};

/// The impacts of such a code, at most so many, up to the end of the run; fewer where the law has no answer.
std::vector<FoundImpact> replayed(const Motion& motion, const Reference& reference, const DeclaredLaw& law,
                                  const Stepping& stepping, std::size_t most) {
  try {
    return Replay(motion, reference, law, stepping).run(most);
  } catch (const std::exception&) {
    return {};  // the law has no answer on the way
  }
}

/// The largest distance of velocities after impacts, over the speed; unknown where the places are others, or times by
/// more than a step.
double replay_distance(const Reference& reference, double step, const std::vector<FoundImpact>& replay,
                       std::span<const FoundImpact> impacts) {
  if (impacts.empty() || replay.size() < impacts.size()) return Score::unknown;
  double distance = 0;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const State &a = replay[i].after, &b = impacts[i].after;
    const double late = std::fabs(replay[i].time - impacts[i].time);
    if (replay[i].place != impacts[i].place || (step > 0 && !(late <= 1.001 * step))) return Score::unknown;
    const Vector3 fall = (replay[i].time - impacts[i].time) * reference.pull();  // that of b at the time of a
    distance = worse(distance, (a.velocity - b.velocity - fall).norm() / reference.speed());
    distance =
        worse(distance, reference.reach() * (a.angular_velocity - b.angular_velocity).norm() / reference.speed());
  }
  return distance;
}

/// What a motion is diagnosed by.
struct Diagnosed {
  const Answer& answer;
  const Motion& motion;
  const Reference& reference;
  const ReferenceSequence& sequence;
  const Score& score;
  std::vector<FoundImpact> impacts;         ///< of the problem
  std::optional<FirstOrder> first_order{};  ///< the step that makes the flight error
  double flight_left = 0;                   ///< flight error without that

  Diagnosed(const Answer& rows, const Motion& moved, const Reference& asked, const ReferenceSequence& by,
            const Score& scored)
      : answer(rows), motion(moved), reference(asked), sequence(by), score(scored), impacts(impacts_of(moved, asked)),
        first_order(first_order_step_of(moved, asked, by, impacts, scored.flight_error)),
        flight_left(first_order ? first_order->cause.misfit : scored.flight_error) {
    if (asked.stays()) impacts.resize(std::min(impacts.size(), by.truth.size()));  // the rest is not asked for
  }

  /// The impacts that the problem asks for.
  [[nodiscard]] std::span<const FoundImpact> asked() const {
    return std::span(impacts).first(std::min(impacts.size(), sequence.truth.size()));
  }

  /// Whether a code resolves the instants of its impacts: most of those that do not begin in a row, where nobody knows.
  /// Flights of first order come to the ground where free ones are off it by what they creep in a few steps.
  [[nodiscard]] bool resolves_instants() const {
    std::ptrdiff_t balance = 0;
    for (const FoundImpact& impact : impacts) {
      if (impact.begins_in_a_row) continue;
      bool is_resolved = impact.is_resolved;
      if (first_order && !impact.points.empty()) {
        const double time = motion.time(impact.last_row) - motion.time(impact.first_row);
        const int point = impact.points.front();
        const double fall = std::fabs(reference.velocity(impact.before, point).z()) * time;
        const double way = std::fmin(4 * first_order->flying.creep.norm() * time, 0.1 * fall);
        is_resolved |= std::fabs(reference.height(impact.before, point)) <= way;
      }
      balance += is_resolved ? 1 : -1;
    }
    return balance > 0;
  }

  /// g × step of a code that does not resolve the instants of its impacts, otherwise 0 [m/s].
  [[nodiscard]] double gravity_of_step() const {
    const bool is_exact = !first_order && resolves_instants();
    return is_exact ? 0 : motion.step() * reference.pull().norm();
  }

  /// How the run goes on in time, by its impacts and flights; of the orders of a step's parts the one that comes
  /// nearest to it.
  [[nodiscard]] Stepping stepping(const DeclaredLaw& law) const {
    Stepping best{.step = resolves_instants() ? 0 : motion.step()};
    if (first_order) best.flying = first_order->flying;
    if (reference.is_compliant || impacts.empty()) return best;
    best.flies_first = impacts.front().time > best.step / 2;
    double least = distance_of(best, law, impacts);
    for (Stepping other = best; const int order : {1, 2, 3}) {
      other.gravity_first = order % 2 == 1;
      other.as_listed = order > 1;
      const double distance = distance_of(other, law, impacts);
      if (distance < least) best = other, least = distance;
    }
    return best;
  }
  /// replay_distance() of some of the run's impacts from those of a code.
  [[nodiscard]] double distance_of(const Stepping& stepping, const DeclaredLaw& law,
                                   std::span<const FoundImpact> first) const {
    return replay_distance(reference, stepping.step, replayed(motion, reference, law, stepping, first.size()), first);
  }
  /// V, Ω and t of a code off the truth, as far as the run goes.
  [[nodiscard]] double error_of(const Stepping& stepping, const DeclaredLaw& law) const {
    const std::size_t count = std::min(score.found, score.expected);
    const Score of =
        score_list(replayed(motion, reference, law, stepping, count), reference, score.law == "any" ? "" : score.law);
    for (std::size_t i = 0; i < count; ++i) {
      if (of.found != count || of.impacts[i].place != sequence.truth[i].place) return Score::unknown;
    }
    return of.motion_error();
  }

  [[nodiscard]] double law_left() const {
    return law_left_by_step(reference, sequence.law, impacts, gravity_of_step());
  }
};

/// Another start, where the rest follows from it.
std::vector<Cause> causes_at_start(const Diagnosed& run) {
  if (run.impacts.empty()) return {};
  return start_causes_of(run.motion, run.reference, worse(run.flight_left, run.law_left()));
}

/// Another place, size or start of the body, or rows that end too early.
std::vector<Cause> causes_of_scene(const Diagnosed& run, const Misses& misses) {
  std::vector<Cause> causes;
  add_margin(run.answer, run.reference, run.score, run.impacts, misses, causes);
  // After one impact alone a depth in a row is that of the step; another one may be always the same.
  if (!causes.empty() && run.asked().size() == 1 && *causes.front().value < 0)
    add_time_step(run.motion, run.reference, run.score, run.flight_left, run.impacts, causes);
  if (causes.size() > 1) {
    if (is_at_row(run.motion, run.impacts.front())) return {causes.back()};
    std::swap(causes.front(), causes.back());
    return causes;
  }
  if (causes.empty() && !run.impacts.empty())
    causes = size_causes_of(run.motion, run.reference, run.sequence.law, run.impacts.front(), run.law_left());
  if (causes.empty()) add_height(run.answer, run.motion, run.reference, run.impacts, causes);
  if (!causes.empty()) return chosen(std::move(causes));
  return causes_at_start(run);
}

/// The steps of a code that follows the law and has the same impacts, however few or many.
void add_replayed(const Diagnosed& run, double distance, std::vector<Cause>& causes) {
  causes.push_back({"time-step", run.motion.step(), distance,
                    fmt::format("a code that follows the law at the ends of steps of {} s has the same impacts {}: the "
                                "step explains them",
                                three_digits(run.motion.step()), misfit_words(distance))});
}

/// Impacts that take several rows in a row, where the problem's are instants.
void add_many_rows(const Diagnosed& run, std::vector<Cause>& causes) {
  std::size_t count = 0, most = 0;
  const std::span<const FoundImpact> asked = run.asked();
  for (const FoundImpact& one : asked) {
    const std::size_t rows = one.last_row - one.first_row;
    const bool follows_law = law_error(run.reference, run.sequence.law, one) <= run.reference.tolerances[2];
    count += rows > 1 && !follows_law ? 1 : 0, most = std::max(most, rows);
  }
  if (run.reference.is_compliant || count == 0 || 2 * count < asked.size()) return;
  causes.push_back({"many-rows", static_cast<double>(most), Score::unknown,
                    fmt::format("{} of {} impacts go on from row to row, up to {} steps: a solver that asks for the "
                                "restitution anew in each iteration or step, or a soft contact",
                                count, asked.size(), most)});
}

/// The causes of a code, but for those of its steps without which, alone or beside the others, the run comes no nearer
/// to the truth.  A wrong law stays wrong where the steps make up for it.
std::vector<Cause> helpful(const Diagnosed& run, const Stepping& stepping, const DeclaredLaw& law,
                           std::vector<Cause> causes) {
  if (causes.size() < 2) return causes;
  const auto error_without = [&](const Cause* but) {
    Stepping mended = stepping;
    DeclaredLaw by = law;
    for (const Cause& cause : causes) {
      if (&cause == but) continue;
      if (cause.name == "first-order-step") mended.flying = {};
      else if (cause.name == "time-step") mended.step = 0, mended.gravity_first = false;
      else by = run.sequence.law;
    }
    return run.error_of(mended, by);
  };
  const double all = run.score.motion_error(), without_all = error_without(nullptr);
  std::vector<Cause> kept;
  for (const Cause& cause : causes) {
    const bool is_of_steps = cause.name == "first-order-step" || cause.name == "time-step";
    const bool is_known = cause.error_without && std::isfinite(*cause.error_without) && std::isfinite(all);
    if (!is_of_steps || !is_known || *cause.error_without < all || without_all < error_without(&cause))
      kept.push_back(cause);
  }
  if (kept.empty()) return causes;
  return kept;
}

/// Causes of the impacts and the flights' step of first order, that one first without which the least would be left.
std::vector<Cause> ranked(const Diagnosed& run, std::vector<Cause> causes, bool has_first_order) {
  constexpr double as_the_run = 0.1;
  const DeclaredLaw& asked = run.sequence.law;
  const DeclaredLaw law = causes.empty() ? asked : causes.front().law.value_or(asked);  // of the run
  const bool by_step = causes.empty() || causes.front().name == "time-step";
  const Stepping stepping = run.stepping(law);
  const double all = run.score.motion_error(), distance = run.distance_of(stepping, law, run.asked());
  // What a change is worth is known where the judge's code comes to what the run does.
  const bool is_as_the_run = distance <= as_the_run * all;
  const bool is_known = is_as_the_run || (stepping.step == 0 && !by_step && !causes.front().law);
  const auto tell = [&](Cause& cause, const Stepping& without, const DeclaredLaw& by) {
    if (run.reference.is_compliant || !is_known || cause.name == "delay" || cause.name == "contact-time") return;
    cause.error_without = run.error_of(without, by);
    if (!std::isfinite(*cause.error_without) || !std::isfinite(all) || !has_first_order) return;
    const std::string left = significant(rounded_up(*cause.error_without), 2), now = significant(rounded_up(all), 2);
    cause.words += left == now
                       ? fmt::format("; mending this alone leaves V, Ω and t off by {}", now)
                       : fmt::format("; without this alone V, Ω and t would be off by {} and not {}", left, now);
  };
  Stepping resolved = stepping, second_order = stepping;
  resolved.step = 0;
  resolved.gravity_first = false;
  second_order.flying = {};
  for (Cause& cause : causes) tell(cause, by_step ? resolved : stepping, asked);
  if (has_first_order) {
    Cause first_order = run.first_order->cause;
    if (by_step || is_as_the_run) tell(first_order, second_order, law);
    const bool is_trifle =
        !by_step && run.score.is_law_first() && !(run.score.law_error <= run.reference.tolerances[2]);
    const auto is_larger = [&] {
      return first_order.error_without.value_or(all) < causes.front().error_without.value_or(0);
    };
    const bool is_first = causes.empty() || (!is_trifle && is_larger());
    causes.insert(is_first ? causes.begin() : causes.end(), first_order);
    for (std::size_t i = 1; i < causes.size(); ++i) causes[i].is_more |= is_first || i + 1 == causes.size();
  }
  if (!causes.empty() && is_as_the_run) {
    causes = helpful(run, stepping, law, std::move(causes));
    causes.front().unexplained = distance;
  }
  return causes;
}

/// Another law, body or delay of the impacts, or the steps of the code.
std::vector<Cause> causes_of_impacts(const Diagnosed& run, const Misses& misses, Trials& trials) {
  constexpr double free_flight = 1e-2;  // beyond, states before impacts are not those of the run
  constexpr double same = 1e-6, alike = 0.02;
  const auto& impacts = run.impacts;
  std::vector<Cause> causes;
  const Stepping stepping = run.stepping(run.sequence.law);
  const bool may_be_step =
      stepping.step > 0 && !run.reference.is_compliant && run.flight_left <= run.reference.tolerances[1];
  const double distance = may_be_step ? run.distance_of(stepping, run.sequence.law, impacts) : Score::unknown;
  if (run.flight_left <= free_flight && !(distance <= same))
    causes = impact_causes_of(run.reference, run.sequence.law, impacts, run.gravity_of_step(), trials);
  const bool has_places = std::ranges::none_of(impacts, [](const FoundImpact& one) { return one.points.empty(); });
  if (causes.empty() && !has_places && !(distance <= same))
    causes = far_body_causes_of(run.answer, run.reference, run.sequence.law, impacts, trials);
  if (causes.empty() && !(distance <= same) && !run.score.ends_early)
    add_delay(run.motion, run.reference, run.asked(), misses, stepping.step > 0, causes);
  if (causes.empty() && !(run.first_order && stepping.step == 0))
    add_time_step(run.motion, run.reference, run.score, run.flight_left, impacts, causes);
  causes = chosen(std::move(causes));
  if (causes.empty() && distance <= alike) add_replayed(run, distance, causes);
  if (causes.empty()) add_many_rows(run, causes);
  return ranked(run, std::move(causes), run.first_order.has_value());
}

std::vector<Cause> found_causes(const Answer& answer, const Reference& reference, const Score& score, Trials& trials) {
  const auto sequence = std::find_if(reference.sequences.begin(), reference.sequences.end(),
                                     [&](const ReferenceSequence& one) { return one.law.name == score.law; });
  if (sequence == reference.sequences.end()) return {};
  if (answer.is_list) return causes_of_list(answer, reference, *sequence, score, trials);
  const Motion motion(answer.table, reference);
  const Cause cut_off{"cut-off", motion.time(motion.size() - 1) - motion.first_touch(), 0, score.left_out};
  if (score.ends_early && score.impacts_error() <= reference.tolerances[1]) return {cut_off};
  std::vector<Cause> causes = stray_rows_of(answer, motion, reference, score);
  if (!causes.empty()) {
    // About a single impact a row with the velocities of the one before is beside the flights, too.
    for (Cause& late : late_velocities_of(answer, reference, score)) causes.push_back(std::move(late));
    return chosen(std::move(causes));
  }
  causes = chosen(readings_of(answer, motion, reference, score));
  const auto is_mirrored = [](const Cause& one) { return one.name == "phi-sign" || one.name == "left-right"; };
  if (!causes.empty() && !std::any_of(causes.begin(), causes.end(), is_mirrored)) return causes;
  const Diagnosed run(answer, motion, reference, *sequence, score);
  if (!causes.empty()) {  // a body that starts with phi of the other sign is its own mirror image
    for (Cause& cause : causes_at_start(run)) {
      if (cause.name == "start-angle") causes.push_back(std::move(cause));
    }
    return causes;
  }
  if (score.ends_early) causes.push_back(cut_off);
  // After one impact alone a wrong start and a wrong impact look alike.
  if (motion.begins_after_touch() && sequence->truth.size() == 1) return causes;
  const Misses misses(reference, run.asked());
  std::vector<Cause> others = unturned_inertia_of(reference, sequence->law, run.impacts, motion.state(0).attitude);
  if (!others.empty()) {
    others = ranked(run, std::move(others), run.first_order.has_value());
    for (Cause& cause : flight_causes_of(motion, reference))
      others.push_back(std::move(cause)), others.back().is_more = true;
  }
  if (others.empty()) others = causes_of_scene(run, misses);
  if (others.empty()) others = chosen(flight_causes_of(motion, reference));
  if (others.empty()) others = causes_of_impacts(run, misses, trials);
  for (Cause& cause : others) {
    cause.is_more |= score.ends_early;
    causes.push_back(std::move(cause));
  }
  return causes;
}

}  // namespace

Diagnosis diagnosis_of(const Answer& answer, const Reference& reference, const Score& score) {
  Trials trials;
  Diagnosis diagnosis{found_causes(answer, reference, score, trials)};
  // A step of first order makes no law error, and a run's early end nothing at all.
  const bool is_explained = std::ranges::any_of(diagnosis.causes, [&](const Cause& cause) {
    if (cause.name == "cut-off") return score.impacts_error() <= reference.tolerances[1];
    return cause.name != "first-order-step" || score.law_error <= reference.tolerances[2];
  });
  if (is_explained) return diagnosis;
  // Beside a cause the law's numbers tell what it leaves open.
  if (trials.are_spent() || diagnosis.causes.empty())
    diagnosis.remark = trials.are_spent()
                           ? "the search for its causes ended after its last trial: shorter steps may tell"
                       : answer.is_list ? "no known single cause fits"
                                        : "no known single cause fits; shorter steps may tell";
  const auto sequence = std::ranges::find(reference.sequences, score.law, [](const auto& one) { return one.law.name; });
  if (answer.is_list || score.found == 0 || sequence == reference.sequences.end()) return diagnosis;
  const Motion motion(answer.table, reference);
  std::vector<FoundImpact> impacts = impacts_of(motion, reference);
  impacts.resize(std::min(impacts.size(), sequence->truth.size()));
  const double left = law_left_by_step(reference, sequence->law, impacts, motion.step() * reference.pull().norm());
  diagnosis.law_is_unexplained = !reference.is_compliant && !(left <= reference.tolerances[2]);
  return diagnosis;
}

}  // namespace clatter::validation
