// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "analytic/base/angle.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

/// Sizes that errors are relative to.
struct Sizes {
  double velocity = 0, angular = 0, time = 0, energy = 0;
};

Sizes sizes_of(const Reference& reference, const ReferenceSequence& sequence) {
  Sizes sizes;
  for (const TruthRow& row : sequence.truth) {
    sizes.velocity = std::fmax(sizes.velocity, row.velocity.norm());
    sizes.angular = std::fmax(sizes.angular, row.angular_velocity.norm());
  }
  sizes.velocity = std::fmax(sizes.velocity, reference.start.velocity.norm());
  sizes.angular = std::fmax(sizes.angular, sizes.velocity / reference.reach());
  sizes.time = std::fmax(sequence.truth.back().time, reference.reach() / reference.speed());
  sizes.energy = reference.energy(reference.start);
  return sizes;
}

/// Which way friction points, where the law has it point otherwise; empty: as there.
std::string direction_words(const Vector3& slip, const Vector3& found, const Vector3& asked, bool has_sign) {
  const double cosine = found.head<2>().normalized().dot(asked.head<2>().normalized());
  constexpr double same = 1e-3, aligned = 0.98;
  const bool is_there = found.head<2>().norm() > same * found.z() && asked.head<2>().norm() > same * asked.z();
  if (!is_there || !(cosine < 1 - same)) return "";
  const bool slips = slip.head<2>().norm() > 0;
  if (slips && slip.head<2>().normalized().dot(found.head<2>().normalized()) > aligned) return ", P_t along the slip";
  if (has_sign) return "";  // P_t/P_n tells
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * analytic::degrees_per_radian;
  return fmt::format(", P_t turned by {}° from the law's", significant(angle, 3));
}

/// "P_t/P_n = 0.300 and not -0.300, P_t along the slip, e = 0.500": restitution and friction of an impact, and the
/// law's; of a jump at one point that has all of the law's how much the spin changes beside r × P.  Where no point
/// explains it, those of the lowest; of several e is that of the fastest.
std::string measured_words(const Reference& reference, const DeclaredLaw& law, const FoundImpact& impact) {
  const auto& [before, after] = impact.bookings.front();
  std::vector<int> points = impact.points;
  if (points.empty()) points = {reference.lowest(before.attitude)};
  const auto approach = [&](int one) { return -reference.velocity(before, one).z(); };
  const int point = *std::ranges::max_element(points, {}, approach);
  const auto exact = answer_of(reference, law, before, points);
  if (!exact) return "";
  const auto restitution = [&](const State& state) {
    return -reference.velocity(state, point).z() / reference.velocity(before, point).z();
  };
  bool differs = false;
  const auto words = [&](const char* name, double found, double asked) {
    constexpr double last_digits = 1e-9;
    const std::string one = significant(std::fabs(found) > last_digits ? found : 0, 3);
    const std::string other = significant(std::fabs(asked) > last_digits ? asked : 0, 3);
    differs |= one != other;
    return fmt::format("{} = {}{}", name, one, one == other ? "" : " and not " + other);
  };
  std::string all = words("e", restitution(after), restitution(*exact));
  if (law.law.has_cone()) {
    const std::string direction = direction_words(reference.velocity(before, point), after.velocity - before.velocity,
                                                  exact->velocity - before.velocity, reference.is_planar);
    differs |= !direction.empty();
    all = words("P_t/P_n", reference.impulse_ratio(before, after), reference.impulse_ratio(before, *exact)) +
          direction + ", " + all;
  }
  if (points.size() > 1) return differs ? ": " + all : "";
  const Vector3 impulse = reference.body.mass * (after.velocity - before.velocity);
  const Vector3 turn = reference.struck(before, point, impulse).angular_velocity - before.angular_velocity;
  const double along = (after.angular_velocity - before.angular_velocity).dot(turn) / turn.squaredNorm();
  if (std::fabs(along - 1) > 1e-2) all += fmt::format(", the spin changes by {} times r × P", significant(along, 3));
  else if (!differs) return "";
  return impact.points.empty() ? ": no point of the body explains its jump; of the lowest one " + all : ": " + all;
}

/// Twice the kinetic energy of a difference of velocities.
double distance(const Reference& reference, const State& a, const State& b) {
  const Vector3 turn = a.attitude.conjugate() * (a.angular_velocity - b.angular_velocity);
  return std::sqrt(reference.body.mass * (a.velocity - b.velocity).squaredNorm() +
                   turn.dot(reference.body.inertia * turn));
}

ImpactScore impact_score(const Reference& reference, const ReferenceSequence& sequence, const FoundImpact& impact,
                         std::size_t i) {
  const Sizes sizes = sizes_of(reference, sequence);
  ImpactScore score{.place = impact.place,
                    .true_place = "",
                    .first_line = impact.first_line,
                    .last_line = impact.last_line,
                    .time = impact.time,
                    .law_error = reference.is_compliant ? 0 : law_error(reference, sequence.law, impact),
                    .impulse_normal = impact.impulse.z(),
                    .impulse_tangential = impact.impulse.x(),
                    .after = impact.after};
  for (const std::vector<int>& points : impact.pair) score.pair.push_back(reference.place_name(points));
  if (score.law_error > reference.tolerances[2]) score.measured = measured_words(reference, sequence.law, impact);
  if (i >= sequence.truth.size()) return score;
  const TruthRow& truth = sequence.truth[i];
  const State& after = sequence.after[i];
  score.true_place = truth.place;
  score.time_error = impact.time - truth.time;
  score.velocity_error = (impact.after.velocity - truth.velocity).norm() / sizes.velocity;
  score.angular_error = (impact.after.angular_velocity - truth.angular_velocity).norm() / sizes.angular;
  score.energy_error = (reference.energy(impact.after) - reference.energy(after)) / sizes.energy;
  return score;
}

/// A place for readers; "?" is that of a jump that no point explains.
std::string place_words(const std::string& place) { return place == "?" ? "no point of the body" : place; }

/// "impact 2 (lines 11 to 12)"
std::string impact_words(const Score& score, std::size_t i) {
  const ImpactScore& one = score.impacts[i];
  return one.first_line == one.last_line
             ? fmt::format("impact {} (line {})", i + 1, one.first_line)
             : fmt::format("impact {} (lines {} to {})", i + 1, one.first_line, one.last_line);
}

void find_missing(Score& score, const ReferenceSequence& sequence) {
  for (std::size_t i = 0; i < sequence.truth.size(); ++i) {
    const std::string& place = sequence.truth[i].place;
    if (i >= score.impacts.size()) {
      score.findings.push_back(fmt::format("impact {} at {} is missing", i + 1, place));
    } else if (score.impacts[i].place != place) {
      score.findings.push_back(fmt::format("{} is at {}, must be at {}", impact_words(score, i),
                                           place_words(score.impacts[i].place), place));
    } else {
      continue;
    }
    return;
  }
  if (score.found > score.expected) {
    const ImpactScore& more = score.impacts.back();
    score.findings.push_back(fmt::format("an impact more at {}, {} s after the first touch: {}",
                                         place_words(more.place), significant(more.time, 4),
                                         impact_words(score, score.impacts.size() - 1)));
  }
}

/// Scores 1 to 3 and the energies after impacts.
Score score_impacts(const std::vector<FoundImpact>& impacts, const Reference& reference,
                    const ReferenceSequence& sequence) {
  Score score{.law = sequence.law.name, .expected = sequence.truth.size()};
  const Sizes sizes = sizes_of(reference, sequence);
  std::size_t kept = score.expected;
  if (impacts.size() > kept && reference.until && !reference.energy_alone && impacts[kept].time < *reference.until)
    ++kept;
  for (std::size_t i = 0; i < std::min(kept, impacts.size()); ++i) {
    score.impacts.push_back(impact_score(reference, sequence, impacts[i], i));
    const ImpactScore& one = score.impacts.back();
    if (i >= score.expected) break;
    score.law_error = worse(score.law_error, one.law_error);
    score.velocity_error = worse(score.velocity_error, one.velocity_error);
    score.angular_error = worse(score.angular_error, one.angular_error);
    score.time_error = worse(score.time_error, std::fabs(one.time_error) / sizes.time);
    score.energy_error = worse(score.energy_error, std::fabs(one.energy_error));
  }
  score.found = score.impacts.size();
  if (score.found == 0) {
    for (double* error : {&score.law_error, &score.velocity_error, &score.angular_error, &score.time_error})
      *error = Score::unknown;
  }
  find_missing(score, sequence);
  score.order_is_right = score.findings.empty();
  return score;
}

/// The impact that counts what comes after n impacts, or before the first; nothing where there is none.
ImpactScore* counted_by(Score& score, std::size_t n) {
  if (score.impacts.empty()) return nullptr;
  return &score.impacts[std::min(std::max<std::size_t>(n, 1), score.impacts.size()) - 1];
}

void note_drift(Score& score, double error, std::size_t n) {
  if (ImpactScore* impact = counted_by(score, n)) impact->drift = worse(impact->drift, error);
  if (error <= score.energy_error) return;
  score.energy_error = worse(score.energy_error, error);
  score.drift = n;
}

/// @param time that errors of times are relative to [s]
void sum_up(Score& score, double time) {
  for (std::size_t i = 0; i < score.impacts.size(); ++i) {
    ImpactScore& one = score.impacts[i];
    one.error = i == 0 ? score.start_error : 0;
    for (const double error : {one.law_error, one.velocity_error, one.angular_error, std::fabs(one.time_error) / time,
                               std::fabs(one.energy_error), one.impulse_error, one.drift, one.flight_error}) {
      one.error = worse(one.error, error);
    }
  }
}

/// Which flight, by the impacts before it.
std::string flight_words(std::size_t n) { return n == 0 ? "before impact 1" : fmt::format("after impact {}", n); }

/// Words for each error beyond the class "sharp".
void explain(Score& score, double tolerance, double time) {
  const auto add = [&](double error, const std::string& words) {
    if (error <= tolerance) return;
    score.findings.push_back(words + (std::isfinite(error) ? ", error " + significant(rounded_up(error), 2) : ""));
  };
  add(score.start_error,
      "the run does not start as the problem says" + (score.start_words.empty() ? "" : ": " + score.start_words));
  const auto tell_law_of = [&](std::size_t i) {
    const ImpactScore& one = score.impacts[i];
    const char* otherwise =
        one.place == "?" ? ": no point of the body explains its jump" : ", which has no answer there";
    const bool is_measured = std::isfinite(one.law_error) || !one.measured.empty();
    add(one.law_error,
        fmt::format("{} does not follow the law{}", impact_words(score, i), is_measured ? one.measured : otherwise));
    return score.findings.back();
  };
  const auto tell_law = [&] {
    const std::span asked = std::span(score.impacts).first(std::min(score.impacts.size(), score.expected));
    const auto first = std::ranges::find_if(asked, [&](const auto& one) { return !(one.law_error <= tolerance); });
    if (first == asked.end()) return;
    const auto worst = std::ranges::max_element(asked, {}, &ImpactScore::law_error);
    score.law_words = tell_law_of(static_cast<std::size_t>(worst - asked.begin()));
    if (first == worst) return;
    score.findings.pop_back();
    tell_law_of(static_cast<std::size_t>(first - asked.begin()));
  };
  if (score.is_law_first()) tell_law();
  for (std::size_t i = 0; i + 1 < score.impacts.size(); ++i) {
    const ImpactScore &one = score.impacts[i], &next = score.impacts[i + 1];
    if (one.pair.empty() || one.pair != next.pair || one.first_line != next.first_line) continue;
    add(score.motion_error(), fmt::format("two ends strike between lines {} and {}, {}, then {}", one.first_line,
                                          one.last_line, one.pair.front(), one.pair.back()));
  }
  if (score.drift) add(score.energy_error, "energy drifts in flight " + flight_words(*score.drift));
  if (score.stray) add(score.flight_error, score.stray->words);
  for (std::size_t i = 0; i < std::min(score.impacts.size(), score.expected); ++i) {
    const ImpactScore& one = score.impacts[i];
    const std::string at = fmt::format(" of {} is off", impact_words(score, i));
    const std::size_t before = score.findings.size();
    add(one.velocity_error, "velocity" + at);
    add(one.angular_error, "angular velocity" + at);
    const double energy = std::fabs(one.energy_error);
    if (!(energy <= worse(one.velocity_error, one.angular_error))) add(energy, "energy after" + at.substr(3));
    add(one.impulse_error, "impulse" + at);
    constexpr double most = 1e6;  // times of the sequence: a run that never touches the ground has no time of touch
    if (!(std::fabs(one.time_error) <= most * time)) {
      score.findings.push_back(impact_words(score, i) + " comes at no time of the sequence");
    } else if (!(std::fabs(one.time_error) <= tolerance * time)) {
      score.findings.push_back(fmt::format("{} comes {} s {}", impact_words(score, i),
                                           significant(std::fabs(one.time_error), 2),
                                           one.time_error < 0 ? "early" : "late"));
    }
    if (score.findings.size() != before) break;
  }
  if (!score.is_law_first()) tell_law();
}

template <class Judge>
Score best_of(const Reference& reference, const std::string& law, Judge&& judge) {
  Score best;
  bool first = true;
  for (const ReferenceSequence& sequence : reference.sequences) {
    if (!law.empty() && !sequence.law.is_named(law)) continue;
    Score score = judge(sequence);
    score.law_is_declared = !law.empty();
    if (!score.left_out.empty()) score.findings.push_back("incomplete: " + score.left_out);
    const double time = sizes_of(reference, sequence).time;
    explain(score, reference.tolerances[1], time);
    sum_up(score, time);
    if (first || score.error() < best.error() || (score.order_is_right && !best.order_is_right)) best = score;
    first = false;
  }
  return best;
}

/// Distance of a body's points by attitude alone [m]; a ball looks the same however it is turned.
double way_of_turn(const Reference& reference, const space::Quaternion& a, const space::Quaternion& b) {
  const bool is_round = reference.body.vertices.empty() && !reference.body.is_ball();
  double way = is_round ? 2 * reference.reach() * (a.conjugate() * b).vec().norm() : 0;
  for (const Vector3& vertex : reference.body.vertices) way = worse(way, (a * vertex - b * vertex).norm());
  return way;
}

/// "z is 5.1 m" or "phi is 1 rad" of what two states differ most in.
std::string difference_words(const Reference& reference, const State& a, const State& b) {
  const Vector3 way = (a.position - b.position).cwiseAbs();
  int axis = 0;
  const double largest = way.maxCoeff(&axis);
  if (!(way_of_turn(reference, a.attitude, b.attitude) > largest))
    return fmt::format("{} is {} m", "xyz"[axis], significant(largest, 2));
  const space::Quaternion turn = a.attitude.conjugate() * b.attitude;
  return fmt::format("{} is {} rad", reference.is_planar ? "phi" : "the attitude",
                     significant(2 * std::atan2(turn.vec().norm(), std::fabs(turn.w())), 2));
}

/// The largest speed at which two states move a point of the body apart, at most [m/s].
double speed_between(const Reference& reference, const State& a, const State& b) {
  return worse((a.velocity - b.velocity).norm(), reference.reach() * (a.angular_velocity - b.angular_velocity).norm());
}

/// "vz is 5.1 m/s" or "omega is 9 rad/s" of what the velocities of two states differ most in.
std::string velocity_words(const Reference& reference, const State& a, const State& b) {
  int axis = 0, turn = 0;
  const double largest = (a.velocity - b.velocity).cwiseAbs().maxCoeff(&axis);
  const double spin = (a.angular_velocity - b.angular_velocity).cwiseAbs().maxCoeff(&turn);
  if (!(reference.reach() * spin > largest)) return fmt::format("v{} is {} m/s", "xyz"[axis], significant(largest, 2));
  return fmt::format("{} is {} rad/s", reference.is_planar ? "omega" : fmt::format("w{}", "xyz"[turn]),
                     significant(spin, 2));
}

/// Energy that is gained or lost in flight, and rows that free flight does not explain, up to the last impact asked
/// for or Reference::until; of a problem of energy alone the energy at its end, too.
class Flights {
 public:
  Flights(const Motion& motion, const Reference& reference, const ReferenceSequence& sequence,
          const std::vector<FoundImpact>& impacts, bool has_ended)
      : motion_(motion), reference_(reference), sequence_(sequence), impacts_(impacts), has_ended_(has_ended) {}

  void fly_by(const Flying& flying) { flying_ = flying; }

  void score(Score& score) {
    energy_ = reference_.energy(reference_.start);
    const double end = motion_.first_touch() + last_time();
    std::size_t row = 0;
    const std::size_t count = std::min(impacts_.size(), sequence_.truth.size());
    for (std::size_t i = 0; i <= count; ++i) {
      std::size_t last = i < impacts_.size() ? impacts_[i].first_row : motion_.size() - 1;
      while (i == count && last > row && motion_.time(last) > end) --last;
      if (last > row) follow(row, last, score, i);
      const std::size_t next = i < count ? impacts_[i].last_row : motion_.size() - 1;
      for (std::size_t k = std::max(row, last); k < next; ++k) leap(k, score, std::min(i + 1, count));
      row = next;
    }
    score.left_out = missing_time();
    if (reference_.energy_alone && score.left_out.empty()) long_run(score);
  }

 private:
  [[nodiscard]] double last_time() const {
    const double last = sequence_.truth.back().time;
    if (reference_.stays()) return last;  // smaller bounces follow
    return reference_.until && !reference_.energy_alone ? *reference_.until : last + 0.2 * last;
  }

  /// From one row to another without impacts in between; `n` impacts came before.
  void follow(std::size_t from, std::size_t to, Score& score, std::size_t n) const {
    const double start = motion_.energy(from);
    double drift = 0;
    for (std::size_t row = from; row <= to; ++row)
      drift = worse(drift, std::fabs(motion_.energy(row) - start) / energy_);
    note_drift(score, drift, n);
    follow_rows(from, to, score, n);
  }

  /// How far a row's place is off the flight from another row, and how far its velocity leads off it in a step.
  struct Away {
    double place = 0, by_velocity = 0;  ///< [m]
  };
  [[nodiscard]] Away away(const State& flown, std::size_t row) const {
    const State given = motion_.state(row);
    return {worse((flown.position - given.position).norm(), way_of_turn(reference_, flown.attitude, given.attitude)),
            speed_between(reference_, flown, given) * (motion_.time(row) - motion_.time(row - 1))};
  }

  void follow_rows(std::size_t from, std::size_t to, Score& score, std::size_t n) const {
    const space::FreeFlight flight = reference_.flight(motion_.state(from));
    std::vector<double> away(to - from + 1);  // of each row
    State flown = motion_.state(from);
    for (std::size_t row = from + 1; row <= to; ++row) {
      const double time = motion_.time(row) - motion_.time(from);
      if (flying_.turning == Turning::free) flown = flight.at(time), flown.position += time * flying_.creep;
      else flown = validation::flown(reference_, flown, motion_.time(row) - motion_.time(row - 1), flying_);
      const Away off = this->away(flown, row);
      away[row - from] = worse(off.place, off.by_velocity);
    }
    const auto worst = std::max_element(away.begin(), away.end());
    if (!is_worst(*worst / reference_.reach(), score, n)) return;
    constexpr double nearly_on = 0.05;  // of the worst: rows that are not meant
    std::size_t first = static_cast<std::size_t>(worst - away.begin()), last = first;
    const std::size_t at = from + first;
    while (first > 0 && away[first - 1] > nearly_on * *worst) --first;
    while (last + 1 < away.size() && away[last + 1] > nearly_on * *worst) ++last;
    flown = flight.at(motion_.time(at) - motion_.time(from));
    const State given = motion_.state(at);
    const Away off = this->away(flown, at);
    const std::string size = off.by_velocity > off.place ? velocity_words(reference_, flown, given)
                                                         : difference_words(reference_, flown, given);
    const bool has_end = last + 1 < away.size();
    score.stray = Stray{
        .alone = {},
        .size = size,
        .words = fmt::format("the flight {} is not free: {} off it in line {}", flight_words(n), size, line_of(at))};
    if (away.size() < 3) return;  // of two rows either may be wrong
    if (first == last || has_end) score.stray->alone.emplace_back(from + first, from + last);
    if (first == 1 && !has_end) score.stray->alone.emplace_back(from, from);
  }

  /// What a row's successor lies farther from it than the speeds of both allow,
  ///     |Δx| <= (|v₀| + |v₁| + reach (|ω₀| + |ω₁|)) Δt + g Δt² + depth₀                                   (2)
  /// of a point of the body, where contacts may act in any way and take back a depth in the ground.
  void leap(std::size_t row, Score& score, std::size_t n) const {
    const State from = motion_.state(row), to = motion_.state(row + 1);
    const double step = motion_.time(row + 1) - motion_.time(row), reach = reference_.reach();
    if (!(step > 0)) return;  // a first row that the file does not have
    const double depth = std::fmax(-reference_.height(from, reference_.lowest(from.attitude)), 0);
    const double speed =
        from.velocity.norm() + to.velocity.norm() + reach * (from.angular_velocity.norm() + to.angular_velocity.norm());
    const double allowed = (speed + step * reference_.pull().norm()) * step + depth;
    const double way = worse((to.position - from.position).norm(), way_of_turn(reference_, from.attitude, to.attitude));
    if (!is_worst((way - allowed) / reach, score, n)) return;
    const std::string size = difference_words(reference_, from, to);
    score.stray = Stray{.alone = {{row + 1, row + 1}, {row, row}},
                        .size = size,
                        .words = fmt::format("no speed explains the way to line {} {}: {} off the line before",
                                             line_of(row + 1), flight_words(n), size)};
  }

  /// Notes the error of a flight, and whether it is the worst up to now; n impacts came before.
  [[nodiscard]] static bool is_worst(double error, Score& score, std::size_t n) {
    if (ImpactScore* impact = counted_by(score, n)) impact->flight_error = worse(impact->flight_error, error);
    if (error <= score.flight_error) return false;
    score.flight_error = worse(score.flight_error, error);
    return true;
  }

  [[nodiscard]] std::size_t line_of(std::size_t row) const { return motion_.table().line(motion_.table_row(row)); }

  /// That the run ends before the time until which the problem asks, unless it says that nothing approaches any more.
  [[nodiscard]] std::string missing_time() const {
    if (!reference_.until || has_ended_) return "";
    const std::size_t row = motion_.size() - 1;
    const double end = motion_.time(row) - motion_.first_touch();
    const double step = motion_.time(row) - motion_.time(row - 1);  // the last one may end beyond the time asked for
    if (!(end + step < *reference_.until)) return "";
    if (end < 0) return "the run ends before the body touches the ground";
    return fmt::format("the run ends {} s after the first touch, and {} s are asked for", significant(end, 4),
                       shortest(*reference_.until));
  }

  /// Energy at the end of a long run, whatever impacts there are.
  void long_run(Score& score) const {
    const double end = motion_.first_touch() + *reference_.until;
    std::size_t row = motion_.size() - 1;
    while (row > 0 && motion_.time(row) > end) --row;
    const double wanted = reference_.last_energy(sequence_);
    const double error = std::fabs((reference_.end_energy ? energy_at(end) : motion_.energy(row)) - wanted) / energy_;
    note_drift(score, error, sequence_.truth.size());
  }

  /// The energy of a body that slides is a parabola in time: this is the one through the last three rows about a time.
  [[nodiscard]] double energy_at(double time) const {
    std::size_t last = motion_.size() - 1;
    while (last > 2 && motion_.time(last - 1) > time) --last;
    if (last < 2) return motion_.energy(last);
    double sum = 0;
    for (std::size_t i = last - 2; i <= last; ++i) {
      double share = 1;
      for (std::size_t k = last - 2; k <= last; ++k) {
        if (k != i) share *= (time - motion_.time(k)) / (motion_.time(i) - motion_.time(k));
      }
      sum += share * motion_.energy(i);
    }
    return sum;
  }

  const Motion& motion_;
  const Reference& reference_;
  const ReferenceSequence& sequence_;
  const std::vector<FoundImpact>& impacts_;
  bool has_ended_;
  Flying flying_{};
  double energy_ = 1;
};

/// What a list says of its impulses.
void score_impulses(Score& score, const std::vector<FoundImpact>& impacts, const ReferenceSequence& sequence) {
  double largest = 0;
  for (const TruthRow& row : sequence.truth) largest = std::fmax(largest, row.impulse.norm());
  for (std::size_t i = 0; i < std::min(score.impacts.size(), sequence.truth.size()); ++i) {
    score.impacts[i].impulse_error = (impacts[i].impulse - sequence.truth[i].impulse).norm() / largest;
    score.impulse_error = worse(score.impulse_error, score.impacts[i].impulse_error);
  }
}

/// What a list says of its end.
void score_ending(Score& score, const Ending& ending, const Reference& reference, const ReferenceSequence& sequence) {
  if (!reference.until) return;
  if (!reference.energy_alone) {
    if (!ending.nothing_approaches) score.left_out = "no line \"# ended: nothing approaches\"";
  } else if (!ending.energy) {
    score.left_out =
        fmt::format("no line \"# energy: J\" of the energy {} s after the first touch", shortest(*reference.until));
  } else {
    const double wanted = reference.last_energy(sequence);
    const double error = std::fabs(*ending.energy - wanted) / reference.energy(reference.start);
    score.energy_error = worse(score.energy_error, error);
    if (ImpactScore* last = counted_by(score, score.expected)) last->drift = error;
    if (error <= reference.tolerances[1]) return;
    score.findings.push_back(
        fmt::format("the energy at the end is {} J, must be {} J", shortest(*ending.energy), significant(wanted, 6)));
  }
}

/// Where impacts of a motion are missing that can still come, in its own motion or by the truth: what is left out, and
/// until when it must go on; empty: they cannot.
std::string early_end(const Motion& motion, const Reference& reference, const ReferenceSequence& sequence,
                      const Score& score, const Ending& ending) {
  if (!(score.found < score.expected) || ending.nothing_approaches) return "";
  if (!(score.start_error <= reference.tolerances.back())) return "";  // another drop has other impacts
  for (std::size_t i = 0; i < score.found; ++i) {
    if (score.impacts[i].place != sequence.truth[i].place) return "";
  }
  const std::size_t last = motion.size() - 1;
  const double end = motion.time(last) - motion.first_touch(), step = motion.time(last) - motion.time(last - 1);
  const TruthRow& next = sequence.truth[score.found];
  const space::FreeFlight flight = reference.flight(motion.state(last));
  const double wait = touch_time(reference, flight);
  const State touch = flight.at(wait);
  const int point = reference.lowest(touch.attitude);
  // A point that has come through the ground since the row before is struck in the next step.
  const bool comes = std::fabs(reference.height(touch, point)) <= 1e-2 * reference.reach() &&
                     reference.height(motion.state(last - 1), point) > 0 &&
                     reference.place_named(next.place) == std::vector{point};
  const bool is_whole = reference.until && end + step >= *reference.until;
  if (is_whole && !(comes && wait <= 0)) return "";
  if (!comes && !(end <= next.time + step)) return "";
  const double late = comes ? std::fmax(end + wait - next.time, 0) : 0;
  const double last_time = reference.until.value_or(1.1 * (sequence.truth.back().time + late) + step);
  const double enough = is_whole ? end + 2 * step : last_time;
  return fmt::format(
      "the run ends {} s after the first touch, before impact {} at {}{}: {} s are needed", significant(end, 3),
      score.found + 1, next.place,
      comes ? fmt::format(", which its own motion has at {} s", significant(std::fmax(end + wait, end), 3)) : "",
      significant(rounded_up(enough), 2));
}

}  // namespace

double law_error(const Reference& reference, const DeclaredLaw& law, const FoundImpact& impact) {
  if (impact.points.empty()) return Score::unknown;
  double least = Score::unknown;
  for (const auto& [before, after] : impact.bookings) {
    const auto exact = answer_of(reference, law, before, impact.points);
    if (!exact) continue;
    const double change = std::fmax(distance(reference, *exact, before), distance(reference, after, before));
    least = std::fmin(least, distance(reference, *exact, after) / change);
  }
  for (const auto& [before, after] : impact.of_pair) {
    const auto first = answer_of(reference, law, before, impact.pair.front());
    const auto exact = first ? answer_of(reference, law, *first, impact.pair.back()) : std::nullopt;
    if (!exact) continue;
    const double change = distance(reference, *first, before) + distance(reference, *exact, *first);
    least = std::fmin(least, distance(reference, *exact, after) / change);
  }
  return least;
}

double law_error_of_speed(const Reference& reference, const FoundImpact& impact, double speed) {
  return std::sqrt(reference.body.mass) * speed / distance(reference, impact.after, impact.before);
}

const std::vector<std::string>& verdict_names() {
  static const std::vector<std::string> names{"exact", "sharp", "good", "coarse", "incomplete", "fails"};
  return names;
}

double worse(double error, double other) {
  if (std::isnan(error) || std::isnan(other)) return Score::unknown;
  return std::max(error, other);
}

const char* verdict_name(Verdict verdict) { return verdict_names()[static_cast<std::size_t>(verdict)].c_str(); }

double Score::motion_error() const { return worse(velocity_error, worse(angular_error, time_error)); }

bool Score::is_law_first() const { return !(law_error <= 0.05 * motion_error()); }

double Score::error() const { return worse(impacts_error(), gradient_error); }

std::string Score::decided_by() const {
  if (!order_is_right && !ends_early) return "number or places of the impacts";
  const std::pair<const char*, double> parts[]{
      {"law", law_error},       {"V", velocity_error},    {"Ω", angular_error},
      {"t", time_error},        {"energy", energy_error}, {"impulse", impulse_error},
      {"flight", flight_error}, {"start", start_error},   {"derivatives", gradient_error}};
  return std::max_element(std::begin(parts), std::end(parts),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

double Score::impacts_error() const {
  if (!order_is_right && !ends_early) return unknown;
  return worse(worse(worse(law_error, impulse_error), motion_error()),
               worse(energy_error, worse(flight_error, start_error)));
}

Verdict verdict_of(const Score& score, const std::vector<double>& tolerances) {
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    if (!(score.error() <= tolerances[i])) continue;
    return score.left_out.empty() ? static_cast<Verdict>(i) : Verdict::incomplete;
  }
  return Verdict::fails;
}

Score score_motion(const Motion& motion, const Reference& reference, const std::string& law, const Ending& ending) {
  const std::vector<FoundImpact> impacts = impacts_of(motion, reference);
  return best_of(reference, law, [&](const ReferenceSequence& sequence) {
    Score score = score_impacts(impacts, reference, sequence);
    score.start_error = motion.start_error();
    if (!(score.start_error <= reference.tolerances[1])) score.start_words = start_differences(motion, reference);
    Flights(motion, reference, sequence, impacts, ending.nothing_approaches).score(score);
    if (const std::string words = early_end(motion, reference, sequence, score, ending); !words.empty()) {
      score.ends_early = true;
      score.left_out = words;
      score.findings.clear();  // that the impact is missing
    }
    return score;
  });
}

State flown(const Reference& reference, const State& from, double time, const Flying& by) {
  if (by.turning == Turning::free) {
    State to = reference.flight(from).at(time);
    to.position += time * by.creep;
    return to;
  }
  State to = from;
  to.position += time * (from.velocity + by.creep + time / 2 * reference.pull());
  to.velocity += time * reference.pull();
  space::Quaternion turn = from.attitude;
  Vector3 rate = from.angular_velocity;
  const space::Matrix3& inertia = reference.body.inertia;
  const Vector3 momentum = turn * (inertia * (turn.conjugate() * rate));
  const double last_digits = 1e-6 * by.step;
  for (double left = time; std::fabs(left) > last_digits;) {
    const double step = std::fabs(left - by.step) <= last_digits ? left : std::fmin(left, by.step);
    left -= step;
    const Vector3 spin = turn.conjugate() * rate;
    const Vector3 next = rate - step * (turn * (inertia.inverse() * spin.cross(inertia * spin)));
    const Vector3 half = step / 2 * (by.turning == Turning::by_new ? next : rate);
    const double size = half.norm(), along = by.is_on_sphere && size > 0 ? std::sin(size) / size : 1;
    space::Quaternion change(by.is_on_sphere ? std::cos(size) : 1, 0, 0, 0);
    change.vec() = along * half;
    turn = (change * turn).normalized();
    rate = by.turning == Turning::by_momentum ? turn * (inertia.inverse() * (turn.conjugate() * momentum)) : next;
  }
  to.attitude = turn;
  to.angular_velocity = rate;
  return to;
}

double flight_error_with(const Flying& flying, const Motion& motion, const Reference& reference,
                         const ReferenceSequence& sequence, const std::vector<FoundImpact>& impacts) {
  Score score;
  Flights flights(motion, reference, sequence, impacts, false);
  flights.fly_by(flying);
  flights.score(score);
  return score.flight_error;
}

Score score_list(const std::vector<FoundImpact>& impacts, const Reference& reference, const std::string& law,
                 const Ending& ending) {
  return best_of(reference, law, [&](const ReferenceSequence& sequence) {
    Score score = score_impacts(impacts, reference, sequence);
    score_impulses(score, impacts, sequence);
    score_ending(score, ending, reference, sequence);
    return score;
  });
}

}  // namespace clatter::validation
