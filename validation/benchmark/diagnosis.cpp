// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "validation/output/number.hpp"

namespace clatter::validation::inline benchmark {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

constexpr double well_explained = 3;   ///< times the least misfit, within which another hypothesis is told as well
constexpr double least_misfit = 1e-9;  ///< below it misfits do not decide between hypotheses
constexpr double degrees = 180 / std::numbers::pi;

/// A number and what is left with it.
struct Fitted {
  double value = 0, misfit = Score::unknown;
};

/// The least of a function on [low, high], by a scan and golden sections.
Fitted least_of(double low, double high, const std::function<double(double)>& misfit) {
  constexpr int parts = 40, cuts = 60;
  const double part = (high - low) / parts, golden = (std::sqrt(5.0) - 1) / 2;
  Fitted best;
  for (int i = 0; i <= parts; ++i) {
    const double value = low + i * part, left = misfit(value);
    if (left < best.misfit) best = {value, left};
  }
  double a = std::max(low, best.value - part), b = std::min(high, best.value + part);
  for (int i = 0; i < cuts; ++i) {
    const double x = b - golden * (b - a), y = a + golden * (b - a);
    (misfit(x) < misfit(y) ? b : a) = misfit(x) < misfit(y) ? y : x;
  }
  const double middle = (a + b) / 2, left = misfit(middle);
  return left < best.misfit ? Fitted{middle, left} : best;
}

/// The slope of b over a through the origin, by least squares, and the largest residual.
Fitted slope_of(const std::vector<std::pair<double, double>>& points) {
  double aa = 0, ab = 0;
  for (const auto& [a, b] : points) aa += a * a, ab += a * b;
  Fitted fit{ab / aa, 0};
  for (const auto& [a, b] : points) fit.misfit = worse(fit.misfit, std::fabs(b - fit.value * a));
  return fit;
}

std::string three_digits(double value) { return significant(value, 3); }

std::string impacts_words(std::size_t count, std::size_t of, std::size_t only) {
  if (count < of) return count == 1 ? fmt::format("impact {} alone", only + 1) : fmt::format("{} impacts", count);
  return of == 1 ? "the impact" : of == 2 ? "both impacts" : fmt::format("all {} impacts", of);
}

/// Hypotheses on the law of the impacts and on the body.
class ImpactCauses {
 public:
  ImpactCauses(const Reference& reference, const DeclaredLaw& law, const std::vector<FoundImpact>& impacts)
      : reference_(reference), law_(law) {
    for (const FoundImpact& impact : impacts) {
      if (!impact.points.empty()) impacts_.push_back(impact);
    }
    for (const FoundImpact& impact : impacts_) errors_.push_back(law_error(reference_, law_, impact));
    for (const double error : errors_) worst_ = worse(worst_, error);
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
      if (!(errors_[i] <= 0.1 * worst_)) broken_.push_back(i);
    }
  }

  std::vector<Cause> of_impacts(const std::vector<FoundImpact>& impacts) {
    if (reference_.is_compliant) return {};
    add_centre_alone(impacts);
    if (!causes_.empty()) return std::move(causes_);
    if (broken_.empty() || !(worst_ > reference_.tolerances[1])) return {};
    add_threshold();
    if (!causes_.empty()) return std::move(causes_);
    add_law();
    add_restitution();
    add_friction();
    add_body();
    return std::move(causes_);
  }

 private:
  using Change = std::function<void(Reference&, DeclaredLaw&, double)>;

  /// The largest error of the impacts under another law or body.
  [[nodiscard]] double misfit(const Change& change, double value, const std::vector<std::size_t>& of) const {
    Reference reference = reference_;
    DeclaredLaw law = law_;
    change(reference, law, value);
    double error = 0;
    for (const std::size_t i : of) error = worse(error, law_error(reference, law, impacts_[i]));
    return error;
  }

  void keep(const char* name, const Fitted& fit, const std::string& words) {
    if (!(fit.misfit <= explained * worst_)) return;
    causes_.push_back({name, fit.value, fit.misfit, words + " " + misfit_words(fit.misfit)});
  }

  [[nodiscard]] std::string which() const { return impacts_words(broken_.size(), impacts_.size(), broken_.front()); }

  [[nodiscard]] std::vector<std::size_t> all() const {
    std::vector<std::size_t> each(impacts_.size());
    for (std::size_t i = 0; i < each.size(); ++i) each[i] = i;
    return each;
  }

  /// Separation over approach speed of the point that strikes, in the booking nearest to the law.
  [[nodiscard]] double restitution_of(std::size_t i) const {
    const Booking& booking = impacts_[i].bookings.front();
    const auto speed = [&](const State& state) {
      const Vector3 arm = reference_.arms(state.attitude)[static_cast<std::size_t>(impacts_[i].points.front())];
      return (state.velocity + state.angular_velocity.cross(arm)).z();
    };
    return -speed(booking.after) / speed(booking.before);
  }

  [[nodiscard]] double approach_of(std::size_t i) const {
    const State& before = impacts_[i].bookings.front().before;
    const Vector3 arm = reference_.arms(before.attitude)[static_cast<std::size_t>(impacts_[i].points.front())];
    return -(before.velocity + before.angular_velocity.cross(arm)).z();
  }

  /// Slow contacts that do not rebound, where faster ones follow the law.
  void add_threshold() {
    if (!(law_.law.law.restitution > 0.05) || broken_.size() == impacts_.size()) return;
    const Change change = [](Reference&, DeclaredLaw& law, double e) { law.law.law.restitution = e; };
    const double left = misfit(change, 0, broken_);
    double fastest = 0, slowest = Score::unknown;
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
      const bool is_broken = std::find(broken_.begin(), broken_.end(), i) != broken_.end();
      if (is_broken) fastest = std::fmax(fastest, approach_of(i));
      else slowest = std::fmin(slowest, approach_of(i));
    }
    if (!(fastest < slowest)) return;
    keep("restitution-threshold", {fastest, left},
         fmt::format("restitution is left out at {} m/s and slower, and taken at {} m/s and faster: that explains {}",
                     three_digits(fastest), three_digits(slowest), which()));
  }

  /// Another of the laws that the problem has a truth for.
  void add_law() {
    for (const ReferenceSequence& other : reference_.sequences) {
      if (other.law.name == law_.name) continue;
      const Change change = [&](Reference&, DeclaredLaw& law, double) { law = other.law; };
      const double left = misfit(change, 0, all());
      if (!(left <= explained * worst_)) continue;
      causes_.push_back({"law",
                         {},
                         left,
                         fmt::format("the law {} (judged by {}) explains {} {}", other.law.name, law_.name,
                                     impacts_words(impacts_.size(), impacts_.size(), 0), misfit_words(left))});
      return;
    }
  }

  void add_restitution() {
    const double asked = law_.law.law.restitution;
    if (law_.law.law.law == analytic::RestitutionLaw::viscoelastic) return;
    const Change change = [](Reference&, DeclaredLaw& law, double e) { law.law.law.restitution = e; };
    Fitted fit = least_of(0, 1, [&](double e) { return misfit(change, e, broken_); });
    if (const Fitted more = beyond_elastic(); more.misfit < fit.misfit) fit = more;
    keep("restitution", fit,
         fmt::format("e = {} ({} is asked) explains {}", three_digits(fit.value), shortest(asked), which()));
  }

  /// e > 1, which the law refuses: without friction the change is (1 + e)/2 times that of e = 1.
  [[nodiscard]] Fitted beyond_elastic() const {
    if (law_.law.law.friction != analytic::FrictionKind::none && law_.law.law.friction_value != 0) return {};
    double mean = 0;
    for (const std::size_t i : broken_) mean += restitution_of(i) / static_cast<double>(broken_.size());
    if (!(mean > 1)) return {};
    DeclaredLaw elastic = law_;
    elastic.law.law.restitution = 1;
    Fitted fit{mean, 0};
    for (const std::size_t i : broken_) {
      const auto& [before, after] = impacts_[i].bookings.front();
      const State once = exact_map(reference_, elastic, before, impacts_[i].points);
      const Vector3 change = (once.velocity - before.velocity) * (1 + mean) / 2;
      const Vector3 turn = (once.angular_velocity - before.angular_velocity) * (1 + mean) / 2;
      const double velocity = (before.velocity + change - after.velocity).norm() / change.norm();
      const double rate = (before.angular_velocity + turn - after.angular_velocity).norm() / turn.norm();
      fit.misfit = worse(fit.misfit, worse(velocity, turn.norm() > 0 ? rate : 0));
    }
    return fit;
  }

  void add_friction() {
    const bool has_friction = law_.law.law.friction == analytic::FrictionKind::coulomb;
    const double asked = has_friction ? law_.law.law.friction_value : 0;
    const Change coulomb = [](Reference&, DeclaredLaw& law, double value) {
      law.law.law.friction = analytic::FrictionKind::coulomb;
      law.law.law.friction_value = value;
    };
    const Fitted fit = least_of(0, 2, [&](double value) { return misfit(coulomb, value, broken_); });
    const std::string words = fit.value <= 1e-6 ? "no friction" : fmt::format("friction {}", three_digits(fit.value));
    const std::size_t before = causes_.size();
    if (broken_.size() == impacts_.size() || !(misfit(coulomb, fit.value, all()) > explained * worst_)) {
      keep("friction", fit, fmt::format("{} ({} is asked) explains {}", words, shortest(asked), which()));
    }
    if (causes_.size() > before || !reference_.is_planar) return;
    const Change ratio = [](Reference&, DeclaredLaw& law, double value) {
      law.is_moreau = false;
      law.law.law.friction = analytic::FrictionKind::impulse_ratio;
      law.law.law.friction_value = value;
    };
    const Fitted as_ratio = least_of(-2, 2, [&](double value) { return misfit(ratio, value, broken_); });
    keep("friction-ratio", as_ratio,
         fmt::format("a tangential impulse of {} times the normal one, whatever the slip (friction {} is asked), "
                     "explains {}",
                     three_digits(as_ratio.value), shortest(asked), which()));
  }

  /// Properties of the body hold at every impact.
  void add_body() {
    const Change inertia = [](Reference& reference, DeclaredLaw&, double factor) {
      reference.body.inertia *= factor;
      reference.principal = space::PrincipalAxes(reference.body.inertia);
    };
    const Change lever = [](Reference& reference, DeclaredLaw&, double factor) {
      for (Vector3& vertex : reference.body.vertices) vertex *= factor;
      for (space::Rim& rim : reference.body.rims) rim.centre *= factor, rim.radius *= factor;
      for (space::Ellipsoid& part : reference.body.ellipsoids) part.centre *= factor, part.semiaxes *= factor;
    };
    const auto each = all();
    const Fitted heavy = least_of(0.3, 3, [&](double factor) { return misfit(inertia, factor, each); });
    keep("inertia", heavy,
         fmt::format("{} times the moment of inertia explains {}", three_digits(heavy.value),
                     impacts_words(each.size(), each.size(), 0)));
    const Fitted longer = least_of(0.5, 1.5, [&](double factor) { return misfit(lever, factor, each); });
    keep("lever", longer,
         fmt::format("levers {} times as long explain {}", three_digits(longer.value),
                     impacts_words(each.size(), each.size(), 0)));
  }

  /// A velocity of the centre that is reversed without regard to the point that strikes, which no point explains.
  void add_centre_alone(const std::vector<FoundImpact>& impacts) {
    double left = 0, error = 0;
    for (const FoundImpact& impact : impacts) {
      const auto& [before, after] = impact.bookings.front();
      const double change = std::fabs(after.velocity.z() - before.velocity.z());
      const double miss = after.velocity.z() + law_.law.law.restitution * before.velocity.z();
      const double turn = (after.angular_velocity - before.angular_velocity).norm() * reference_.reach();
      left = worse(left, std::fmax(std::fabs(miss), turn) / change);
      error = worse(error, law_error(reference_, law_, impact));
    }
    if (impacts.empty() || !(left <= explained * std::fmin(error, 1)) || !(left <= reference_.tolerances[2])) return;
    causes_.push_back({"centre-alone",
                       {},
                       left,
                       fmt::format("restitution of the velocity of the centre of mass, without a lever, explains {} {}",
                                   impacts_words(impacts.size(), impacts.size(), 0), misfit_words(left))});
  }

  const Reference& reference_;
  const DeclaredLaw& law_;
  std::vector<FoundImpact> impacts_;
  std::vector<double> errors_;
  std::vector<std::size_t> broken_;  ///< impacts that do not follow the law
  double worst_ = 0;
  std::vector<Cause> causes_;
};

/// An inertia so far off that no point of the body explains the first jump: with the one that its lowest point does
/// explain the impacts are looked for anew.
void add_far_inertia(const Answer& answer, const Reference& reference, const DeclaredLaw& law, const FoundImpact& first,
                     std::vector<Cause>& causes) {
  if (!first.points.empty() || !reference.is_planar || reference.is_compliant) return;
  const std::vector<Vector3> arms = reference.arms(first.before.attitude);
  const Vector3 arm =
      *std::min_element(arms.begin(), arms.end(), [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  const double turn = first.after.angular_velocity.y() - first.before.angular_velocity.y();
  const double factor = arm.cross(first.impulse).y() / (reference.body.inertia(1, 1) * turn);
  if (!(factor > 0.1 && factor < 10)) return;
  Reference other = reference;
  other.body.inertia *= factor;
  other.principal = space::PrincipalAxes(other.body.inertia);
  double left = 0;
  const std::vector<FoundImpact> impacts = impacts_of(Motion(answer.table, other), other);
  for (const FoundImpact& impact : impacts) left = worse(left, law_error(other, law, impact));
  if (!(left <= explained * std::fabs(factor - 1))) return;
  causes.push_back({"inertia", factor, left,
                    fmt::format("{} times the moment of inertia explains {} {}", three_digits(factor),
                                impacts_words(impacts.size(), impacts.size(), 0), misfit_words(left))});
}

/// Between two impacts, or before the first or after the last.
struct Segment {
  State from, to;
  double time = 0;
};

std::vector<Segment> segments_of(const Motion& motion, const std::vector<FoundImpact>& impacts) {
  std::vector<Segment> segments;
  std::size_t row = 0;
  for (std::size_t i = 0; i <= impacts.size(); ++i) {
    const std::size_t last = i < impacts.size() ? impacts[i].first_row : motion.size() - 1;
    if (last > row + 1)
      segments.push_back({motion.state(row), motion.state(last), motion.time(last) - motion.time(row)});
    if (i < impacts.size()) row = impacts[i].last_row;
  }
  return segments;
}

void add_gravity(const Reference& reference, const std::vector<Segment>& segments, std::vector<Cause>& causes) {
  std::vector<std::pair<double, double>> points;
  double error = 0;
  for (const Segment& one : segments) {
    const double fall = one.from.velocity.z() - one.to.velocity.z();
    points.emplace_back(one.time, fall);
    error = worse(error, std::fabs(fall - reference.gravity * one.time));
  }
  if (points.size() < 2 || !(error > reference.tolerances[1] * reference.speed())) return;
  const Fitted fit = slope_of(points);
  if (!(fit.misfit <= explained * error)) return;
  causes.push_back({"gravity", fit.value, fit.misfit / reference.speed(),
                    fmt::format("gravity {} m/s² ({} is asked) explains the flights {}", three_digits(fit.value),
                                shortest(reference.gravity), misfit_words(fit.misfit / reference.speed()))});
}

/// Velocities that shrink by exp(−c t): those of all, or the spin's alone.
void add_damping(const Reference& reference, const std::vector<Segment>& segments, std::vector<Cause>& causes) {
  if (!reference.is_planar) return;
  std::vector<std::pair<double, double>> points;
  double change = 0;
  for (const Segment& one : segments) {
    const double from = one.from.angular_velocity.y(), to = one.to.angular_velocity.y();
    if (!(std::fabs(from) * reference.reach() > 1e-3 * reference.speed()) || !(from * to > 0)) continue;
    points.emplace_back(one.time, std::log(from / to));
    change = std::fmax(change, std::fabs(points.back().second));
  }
  if (points.empty() || !(change > reference.tolerances[1])) return;
  const Fitted fit = slope_of(points);
  if (!(fit.misfit <= explained * change) || !(fit.value > 0)) return;
  double with = 0, without = 0;
  for (const Segment& one : segments) {
    const double fall = reference.gravity * one.time, from = one.from.velocity.z(), to = one.to.velocity.z();
    const double shrunk = std::exp(-fit.value * one.time);
    const double slowed = from * shrunk - reference.gravity * (1 - shrunk) / fit.value;
    with = worse(with, std::fabs(to - slowed));
    without = worse(without, std::fabs(to - from + fall));
  }
  const bool all = with < without;
  causes.push_back(
      {all ? "damping" : "spin-damping", fit.value, fit.misfit,
       fmt::format("{} that {} by {} per second in flight explain{} the flights {}", all ? "velocities" : "a spin",
                   all ? "shrink" : "shrinks", three_digits(fit.value), all ? "" : "s", misfit_words(fit.misfit))});
}

/// Which part of the state at the first touch is another one.
void add_start(const Motion& motion, const Reference& reference, std::vector<Cause>& causes) {
  if (!(motion.start_error() > reference.tolerances[1])) return;
  const State touch = reference.flight(motion.state(0)).at(motion.first_touch() - motion.time(0));
  const State& start = reference.start;
  const auto angle = [](const State& state) {
    return std::remainder(2 * std::atan2(-state.attitude.y(), state.attitude.w()), 2 * std::numbers::pi) * degrees;
  };
  const double turned = 2 * (touch.attitude.conjugate() * start.attitude).vec().norm();
  const double spin = reference.reach() * (touch.angular_velocity - start.angular_velocity).norm() / reference.speed();
  const double speed = (touch.velocity - start.velocity).norm() / reference.speed();
  const double most = std::max({turned, spin, speed});
  const auto alone = [&](double part) { return part == most && turned + spin + speed - part <= explained * part; };
  const double left = turned + spin + speed - most;
  if (alone(turned) && reference.is_planar) {
    causes.push_back({"start-angle", angle(touch), left,
                      fmt::format("the body touches at {}° and not at {}°", significant(angle(touch), 4),
                                  significant(angle(start), 4))});
  } else if (alone(spin)) {
    const double rate = (touch.angular_velocity - start.angular_velocity).norm();
    causes.push_back(
        {"start-spin", rate, left, fmt::format("the body touches with {} rad/s more or less", three_digits(rate))});
  } else if (alone(speed)) {
    const double factor = touch.velocity.norm() / start.velocity.norm();
    causes.push_back(
        {"start-speed", factor, left, fmt::format("the body touches with {} times the speed", significant(factor, 4))});
  }
}

/// Impacts above or below the ground by one height, or late by one time.
void add_margin(const Reference& reference, const std::vector<FoundImpact>& impacts, std::vector<Cause>& causes) {
  std::vector<double> heights, delays;
  for (const FoundImpact& impact : impacts) {
    if (impact.points.empty()) return;
    const Vector3 arm = reference.arms(impact.before.attitude)[static_cast<std::size_t>(impact.points.front())];
    const double height = impact.before.position.z() + arm.z();
    const double approach = -(impact.before.velocity + impact.before.angular_velocity.cross(arm)).z();
    heights.push_back(height);
    delays.push_back(-height / approach);
  }
  const auto spread = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return (*high - *low) / std::fmax(std::fabs(*high), std::fabs(*low));
  };
  if (heights.size() < 2 || !(std::fabs(heights.front()) > 1e-5 * reference.reach())) return;
  const double by_height = spread(heights), by_time = spread(delays);
  if (by_height <= explained && by_height <= by_time) {
    causes.push_back({"margin", heights.front(), by_height,
                      fmt::format("the body strikes {} m {} the ground, {}", three_digits(std::fabs(heights.front())),
                                  heights.front() > 0 ? "above" : "below", misfit_words(by_height))});
  } else if (by_time <= explained && delays.front() > 0) {
    causes.push_back(
        {"delay", delays.front(), by_time,
         fmt::format("each impact comes {} s late, {}", three_digits(delays.front()), misfit_words(by_time))});
  }
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
  if (causes.size() > 2) causes.resize(2);
  return causes;
}

}  // namespace

std::vector<Cause> causes_of(const Answer& answer, const Reference& reference, const Score& score) {
  constexpr std::size_t most_rows = 100'000;
  const auto sequence = std::find_if(reference.sequences.begin(), reference.sequences.end(),
                                     [&](const ReferenceSequence& one) { return one.law.name == score.law; });
  if (sequence == reference.sequences.end()) return {};
  std::vector<Cause> causes;
  if (answer.is_list) {
    causes = misreadings_of(answer, reference, score);
    if (!causes.empty()) return chosen(std::move(causes));
    const std::vector<FoundImpact> impacts = listed_impacts(answer.table, reference, answer.is_counter_clockwise);
    causes = ImpactCauses(reference, sequence->law, impacts).of_impacts(impacts);
    add_mass(reference, impacts, causes);
    return chosen(std::move(causes));
  }
  const bool is_strange = score.start_error > 1e-2 || score.flight_error > 1e-2;
  if (is_strange && answer.table.rows() <= most_rows) {
    causes = misreadings_of(answer, reference, score);
    if (!causes.empty()) return chosen(std::move(causes));
  }
  const Motion motion(answer.table, reference);
  add_start(motion, reference, causes);
  if (!causes.empty()) return causes;
  const std::vector<FoundImpact> impacts = impacts_of(motion, reference);
  const std::vector<Segment> segments = segments_of(motion, impacts);
  add_gravity(reference, segments, causes);
  if (causes.empty()) add_damping(reference, segments, causes);
  if (!causes.empty()) return causes;
  causes = ImpactCauses(reference, sequence->law, impacts).of_impacts(impacts);
  if (causes.empty() && !impacts.empty()) add_far_inertia(answer, reference, sequence->law, impacts.front(), causes);
  if (causes.empty()) add_margin(reference, impacts, causes);
  return chosen(std::move(causes));
}

}  // namespace clatter::validation::inline benchmark
