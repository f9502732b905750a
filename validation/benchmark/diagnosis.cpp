// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <numbers>
#include <span>

#include "validation/benchmark/flight_cause.hpp"
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

  /// Those on the body alone.
  std::vector<Cause> of_body() {
    if (!broken_.empty()) add_body();
    return std::move(causes_);
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
    // The change of e alone must be able to make the error: where the law jumps, any e beside the right one may fit.
    if (!(std::fabs(fit.value - asked) >= 0.1 * std::fmin(worst_, 1))) return;
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
    if (causes_.size() > before || add_friction_that_pushes(asked) || !reference_.is_planar) return;
    const Change ratio = [](Reference&, DeclaredLaw& law, double value) {
      law.is_moreau = false;
      law.law.law.friction = analytic::FrictionKind::impulse_ratio;
      law.law.law.friction_value = value;
    };
    const Fitted as_ratio = least_of(-2, 2, [&](double value) { return misfit(ratio, value, broken_); });
    if (pushes())
      keep("friction-direction", {std::fabs(as_ratio.value), as_ratio.misfit}, pushing_words(as_ratio.value));
    else
      keep("friction-ratio", as_ratio,
           fmt::format("a tangential impulse of {} times the normal one, whatever the slip (friction {} is asked), "
                       "explains {}",
                       three_digits(as_ratio.value), shortest(asked), which()));
  }

  /// Friction along the slip in place of against it; Moreau's cone with a negative coefficient.
  bool add_friction_that_pushes(double asked) {
    const Change along = [](Reference&, DeclaredLaw& law, double value) {
      law.is_moreau = true;
      law.law.law.friction_value = -value;
    };
    if (!(asked > 0) || !pushes()) return false;
    const std::size_t before = causes_.size();
    const Fitted fit = least_of(0, 2, [&](double value) { return misfit(along, value, broken_); });
    keep("friction-direction", fit, pushing_words(fit.value));
    return causes_.size() > before;
  }

  [[nodiscard]] std::string pushing_words(double friction) const {
    return fmt::format("friction {} that acts along the slip and not against it explains {}",
                       three_digits(std::fabs(friction)), which());
  }

  /// Whether each tangential impulse points along the slip before it.
  [[nodiscard]] bool pushes() const {
    return std::all_of(broken_.begin(), broken_.end(), [&](std::size_t i) {
      const State& before = impacts_[i].bookings.front().before;
      const Vector3 arm = reference_.arms(before.attitude)[static_cast<std::size_t>(impacts_[i].points.front())];
      const double slip = (before.velocity + before.angular_velocity.cross(arm)).x();
      return std::fabs(slip) > 1e-3 * reference_.speed() && slip * impacts_[i].impulse.x() > 0;
    });
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

  /// Normal velocity and spin of two states, as speeds at the farthest point, apart from each other.
  [[nodiscard]] double rebound_distance(const State& a, const State& b) const {
    const double turn = (a.angular_velocity - b.angular_velocity).norm() * reference_.reach();
    return std::fmax(std::fabs(a.velocity.z() - b.velocity.z()), turn);
  }

  /// A velocity of the centre that is reversed without regard to the point that strikes, where the point matters.
  void add_centre_alone(const std::vector<FoundImpact>& impacts) {
    double left = 0, lever = 0;
    for (const FoundImpact& impact : impacts) {
      const auto& [before, after] = impact.bookings.front();
      const double change = std::fabs(after.velocity.z() - before.velocity.z());
      State alone = before;
      alone.velocity.z() *= -law_.law.law.restitution;
      left = worse(left, rebound_distance(after, alone) / change);
      lever = worse(lever, impact.points.empty() ? 1 : lever_share(impact, alone));
    }
    if (impacts.empty() || !(lever > reference_.tolerances[2])) return;
    if (!(left <= explained * std::fmin(lever, 1)) || !(left <= reference_.tolerances[2])) return;
    causes_.push_back({"centre-alone",
                       {},
                       left,
                       fmt::format("restitution of the velocity of the centre of mass, without a lever, explains {} {}",
                                   impacts_words(impacts.size(), impacts.size(), 0), misfit_words(left))});
  }

  /// What the law without friction gives beside a rebound of the centre alone, over the change of normal velocity.
  [[nodiscard]] double lever_share(const FoundImpact& impact, const State& alone) const {
    const State& before = impact.bookings.front().before;
    DeclaredLaw smooth = law_;
    smooth.law.law.friction = analytic::FrictionKind::none;
    smooth.law.law.friction_value = 0;
    try {
      return rebound_distance(exact_map(reference_, smooth, before, impact.points), alone) /
             std::fabs(alone.velocity.z() - before.velocity.z());
    } catch (const std::exception&) {
      return Score::unknown;  // the law has no answer there
    }
  }

  const Reference& reference_;
  const DeclaredLaw& law_;
  std::vector<FoundImpact> impacts_;
  std::vector<double> errors_;
  std::vector<std::size_t> broken_;  ///< impacts that do not follow the law
  double worst_ = 0;
  std::vector<Cause> causes_;
};

/// An inertia or levers so far off that no point of the body explains a jump: it is taken for one of the lowest point.
std::vector<Cause> far_body_causes(const Reference& reference, const DeclaredLaw& law,
                                   std::vector<FoundImpact> impacts) {
  if (reference.is_compliant) return {};
  for (FoundImpact& impact : impacts) {
    if (!impact.points.empty()) continue;
    const std::vector<Vector3> arms = reference.arms(impact.before.attitude);
    const auto lowest =
        std::min_element(arms.begin(), arms.end(), [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
    impact.points = {static_cast<int>(lowest - arms.begin())};
  }
  return ImpactCauses(reference, law, impacts).of_body();
}

/// Another inertia, by the lowest point's lever at the first impact: with it the impacts are looked for anew, since of
/// two within a step the share of each depends on it.
void add_far_inertia(const Answer& answer, const Reference& reference, const DeclaredLaw& law, const FoundImpact& first,
                     std::vector<Cause>& causes) {
  const std::vector<Vector3> arms = reference.arms(first.before.attitude);
  const Vector3 arm =
      *std::min_element(arms.begin(), arms.end(), [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  const space::Quaternion& turn = first.before.attitude;
  const Vector3 change = first.after.angular_velocity - first.before.angular_velocity;
  const Vector3 moment = turn * (reference.body.inertia * (turn.conjugate() * change));
  const double factor = arm.cross(first.impulse).dot(moment) / moment.squaredNorm();
  if (reference.is_compliant || !(factor > 0.1 && factor < 10)) return;
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

/// The state in which the drop that is asked for has its centre of mass at a height, on its way down to the touch.
State asked_at_height(const Reference& reference, double height) {
  const double above = height - reference.start.position.z(), speed = -reference.start.velocity.z();
  const double square = speed * speed - 2 * reference.gravity * above;
  return reference.flight(reference.start).at(-2 * above / (speed + std::sqrt(std::fmax(square, 0))));
}

/// Which part of the state at the start is another one; `left_after` is what flights and impacts after it leave.
void add_start(const Motion& motion, const Reference& reference, double left_after, std::vector<Cause>& causes) {
  if (!(motion.start_error() > reference.tolerances[1])) return;
  if (!(left_after <= explained * std::fmin(motion.start_error(), 1))) return;
  const State first = motion.state(0);
  const State start = asked_at_height(reference, first.position.z());
  const auto angle = [](const State& state) {
    return std::remainder(2 * std::atan2(-state.attitude.y(), state.attitude.w()), 2 * std::numbers::pi) * degrees;
  };
  const double turned = 2 * (first.attitude.conjugate() * start.attitude).vec().norm();
  const double spin = reference.reach() * (first.angular_velocity - start.angular_velocity).norm() / reference.speed();
  const double speed = (first.velocity - start.velocity).norm() / reference.speed();
  const double most = std::max({turned, spin, speed});
  const auto alone = [&](double part) { return part == most && turned + spin + speed - part <= explained * part; };
  const double left = turned + spin + speed - most;
  if (alone(turned)) {
    const std::string words = reference.is_planar ? fmt::format("at {}° and not at {}°", significant(angle(first), 4),
                                                                significant(angle(start), 4))
                                                  : fmt::format("turned by {}°", three_digits(turned * degrees));
    causes.push_back(
        {"start-angle", reference.is_planar ? angle(first) : turned * degrees, left, "the body starts " + words});
  } else if (alone(spin)) {
    const double rate = (first.angular_velocity - start.angular_velocity).norm();
    causes.push_back(
        {"start-spin", rate, left, fmt::format("the body starts with {} rad/s more or less", three_digits(rate))});
  } else if (alone(speed)) {
    const double factor = first.velocity.norm() / start.velocity.norm();
    causes.push_back(
        {"start-speed", factor, left, fmt::format("the body starts with {} times the speed", significant(factor, 4))});
  }
}

/// A run that is right as far as it goes, and ends before the next impact.
void add_cut_off(const Motion& motion, const ReferenceSequence& sequence, const Reference& reference,
                 const Score& score, std::vector<Cause>& causes) {
  if (!(score.found < score.expected)) return;
  for (std::size_t i = 0; i < score.found; ++i) {
    if (score.impacts[i].place != sequence.truth[i].place) return;
  }
  double left = worse(score.flight_error, score.start_error);
  if (score.found > 0) left = worse(left, worse(score.law_error, score.motion_error()));
  const std::size_t last = motion.size() - 1;
  const double end = motion.time(last) - motion.first_touch(), next = sequence.truth[score.found].time;
  if (!(left <= reference.tolerances[1]) || !(end <= next + motion.time(last) - motion.time(last - 1))) return;
  causes.push_back({"cut-off", end, left,
                    fmt::format("the run ends {} s after the first touch, before impact {} ({} s): what there is is "
                                "right {}",
                                significant(end, 3), score.found + 1, significant(next, 3), misfit_words(left))});
}

/// How high above the ground each impact is, and how late it is, if its point falls freely.
struct Misses {
  std::vector<double> heights, delays;

  Misses(const Reference& reference, std::span<const FoundImpact> impacts) {
    for (const FoundImpact& impact : impacts) {
      if (impact.points.empty()) continue;
      const Vector3 arm = reference.arms(impact.before.attitude)[static_cast<std::size_t>(impact.points.front())];
      heights.push_back(impact.before.position.z() + arm.z());
      const double speed = -(impact.before.velocity + impact.before.angular_velocity.cross(arm)).z();
      const double square = speed * speed + 2 * reference.gravity * heights.back();  // at the ground
      delays.push_back(-2 * heights.back() / (speed + std::sqrt(std::fmax(square, 0))));
    }
  }

  /// Difference of the extremes over the larger of them.
  static double spread(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return (*high - *low) / std::fmax(std::fabs(*high), std::fabs(*low));
  }
};

/// All of the motion above or below its place by one height: the rows less that height are right.
void add_margin(const Answer& answer, const Reference& reference, const Score& score, const Misses& misses,
                std::vector<Cause>& causes) {
  const std::vector<double>& heights = misses.heights;
  if (heights.empty() || reference.is_compliant || !(std::fabs(heights.front()) > 1e-5 * reference.reach())) return;
  if (!(Misses::spread(heights) <= explained)) return;
  const std::size_t z = answer.table.column("z").value();
  const NumericTable lower = answer.table.changed([&](std::span<double> row) { row[z] -= heights.front(); });
  const std::string law = score.law == "any" ? "" : score.law;
  const double left = score_motion(Motion(lower, reference), reference, law, answer.ending).error();
  if (!(left <= explained * std::fmin(score.error(), 1))) return;
  causes.push_back({"margin", heights.front(), left,
                    fmt::format("the body strikes {} m {} the ground: less that height all is right {}",
                                three_digits(std::fabs(heights.front())), heights.front() > 0 ? "above" : "below",
                                misfit_words(left))});
}

/// Impacts that come late by one time.
void add_delay(const Reference& reference, const Misses& misses, std::vector<Cause>& causes) {
  const std::vector<double>& delays = misses.delays;
  if (delays.size() < 2 || !(std::fabs(misses.heights.front()) > 1e-5 * reference.reach())) return;
  const double left = Misses::spread(delays);
  if (!(left <= explained) || !(delays.front() > 0)) return;
  causes.push_back({"delay", delays.front(), left,
                    fmt::format("each impact comes {} s late, {}", three_digits(delays.front()), misfit_words(left))});
}

/// Impacts that follow the law at the run's own poses, as a step of time has them: near the touch, not at it.
void add_time_step(const Motion& motion, const Reference& reference, const Score& score,
                   const std::vector<FoundImpact>& impacts, std::vector<Cause>& causes) {
  const double left = worse(score.law_error, score.flight_error);
  const double most = std::fmin(explained * score.motion_error(), reference.tolerances[2]);
  if (reference.is_compliant || !score.order_is_right || impacts.empty() || !(left <= most)) return;
  double latest = 0, longest = 0;
  for (const FoundImpact& impact : impacts) {
    const Vector3 arm = reference.arms(impact.before.attitude)[static_cast<std::size_t>(impact.points.front())];
    const double approach = -(impact.before.velocity + impact.before.angular_velocity.cross(arm)).z();
    const double step = motion.time(impact.last_row) - motion.time(impact.first_row);
    const double delay = std::fabs((impact.before.position.z() + arm.z()) / approach);
    if (!(delay <= 2 * step)) return;
    latest = std::fmax(latest, delay), longest = std::fmax(longest, step);
  }
  if (!(latest > 1e-3 * longest)) return;
  causes.push_back(
      {"time-step", latest, left,
       fmt::format("impacts follow the law {} at the steps' own poses, up to {} s from the touch, in steps "
                   "of {} s: the step explains the rest",
                   misfit_words(left), three_digits(latest), three_digits(longest))});
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

/// What the columns of a run mean in place of what they should.
std::vector<Cause> readings_of(const Answer& answer, const Motion& motion, const Reference& reference,
                               const Score& score) {
  constexpr std::size_t most_rows = 100'000;
  std::vector<Cause> causes;
  const bool is_strange =
      score.start_error > 1e-2 || score.flight_error > 1e-2 || score.law_error > 2e-2 || !(score.motion_error() <= 0.5);
  if (is_strange && answer.table.rows() <= most_rows) causes = misreadings_of(answer, reference, score);
  const auto is_sharp = [&](const Cause& cause) { return cause.misfit <= reference.tolerances[1]; };
  // A reading that leaves much may be right by chance, in a run that hardly moves.
  if (std::none_of(causes.begin(), causes.end(), is_sharp)) {
    if (auto scale = velocity_scale_of(motion, reference)) causes.push_back(std::move(*scale));
  }
  return causes;
}

std::vector<Cause> causes_of_list(const Answer& answer, const Reference& reference, const ReferenceSequence& sequence,
                                  const Score& score) {
  std::vector<Cause> causes = misreadings_of(answer, reference, score);
  if (!causes.empty()) return chosen(std::move(causes));
  const std::vector<FoundImpact> impacts = listed_impacts(answer.table, reference, answer.is_counter_clockwise);
  causes = ImpactCauses(reference, sequence.law, impacts).of_impacts(impacts);
  add_mass(reference, impacts, causes);
  return chosen(std::move(causes));
}

}  // namespace

std::vector<Cause> causes_of(const Answer& answer, const Reference& reference, const Score& score) {
  const auto sequence = std::find_if(reference.sequences.begin(), reference.sequences.end(),
                                     [&](const ReferenceSequence& one) { return one.law.name == score.law; });
  if (sequence == reference.sequences.end()) return {};
  if (answer.is_list) return causes_of_list(answer, reference, *sequence, score);
  const Motion motion(answer.table, reference);
  std::vector<Cause> causes = readings_of(answer, motion, reference, score);
  if (!causes.empty()) return chosen(std::move(causes));
  std::vector<FoundImpact> impacts = impacts_of(motion, reference);
  if (reference.stays()) impacts.resize(std::min(impacts.size(), sequence->truth.size()));  // the rest is not asked for
  // After one impact alone a wrong start and a wrong impact look alike.
  if (motion.begins_after_touch() && sequence->truth.size() == 1) return {};
  const Misses misses(reference, std::span(impacts).first(std::min(impacts.size(), sequence->truth.size())));
  add_margin(answer, reference, score, misses, causes);
  if (causes.empty() && !impacts.empty()) {
    double left = score.flight_error;
    for (const FoundImpact& impact : impacts) left = worse(left, law_error(reference, sequence->law, impact));
    add_start(motion, reference, left, causes);
  }
  if (causes.empty()) add_cut_off(motion, *sequence, reference, score, causes);
  if (!causes.empty()) return causes;
  causes = flight_causes_of(motion, reference);
  if (!causes.empty()) return chosen(std::move(causes));
  constexpr double free_flight = 1e-2;  // beyond, states before impacts are not those of the run
  if (score.flight_error <= free_flight) causes = ImpactCauses(reference, sequence->law, impacts).of_impacts(impacts);
  if (causes.empty() && !impacts.empty() && impacts.front().points.empty()) {
    add_far_inertia(answer, reference, sequence->law, impacts.front(), causes);
    if (causes.empty()) causes = far_body_causes(reference, sequence->law, impacts);
  }
  if (causes.empty()) add_delay(reference, misses, causes);
  if (causes.empty()) add_time_step(motion, reference, score, impacts, causes);
  return chosen(std::move(causes));
}

}  // namespace clatter::validation::inline benchmark
