// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::State;
using space::Vector3;

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
  const double slope = (worse(misfit(a), misfit(b)) - best.misfit) / part;
  Fitted lower{b - golden * (b - a)}, upper{a + golden * (b - a)};
  lower.misfit = misfit(lower.value), upper.misfit = misfit(upper.value);
  // A misfit that no value between can make much smaller ends the search.
  for (int i = 0; i < cuts && !(std::fmin(lower.misfit, upper.misfit) > 4 * slope * (b - a)); ++i) {
    const bool is_lower = lower.misfit < upper.misfit;
    (is_lower ? b : a) = is_lower ? upper.value : lower.value;
    (is_lower ? upper : lower) = is_lower ? lower : upper;
    Fitted& next = is_lower ? lower : upper;
    next.value = is_lower ? b - golden * (b - a) : a + golden * (b - a);
    next.misfit = misfit(next.value);
  }
  const Fitted middle = lower.misfit < upper.misfit ? lower : upper;
  return middle.misfit < best.misfit ? middle : best;
}

std::string impacts_words(std::size_t count, std::size_t of, std::size_t only) {
  if (count < of)
    return count == 1 ? fmt::format("impact {} alone", only + 1) : fmt::format("{} of {} impacts", count, of);
  return of == 1 ? "the impact" : of == 2 ? "both impacts" : fmt::format("all {} impacts", of);
}

/// How many impacts a run has or should have, whichever are more.
std::size_t total_of(const Reference& reference, const DeclaredLaw& law, const std::vector<FoundImpact>& impacts) {
  const auto sequence = std::ranges::find(reference.sequences, law.name, [](const auto& one) { return one.law.name; });
  return std::max(impacts.size(), sequence == reference.sequences.end() ? 0 : sequence->truth.size());
}

constexpr double step_share = 2;  ///< of g × step: before an impact and, by restitution, after it

/// Impacts that begin in a row and do not follow the law, however they were booked, with the states of the rows alone:
/// with bookings to choose from two values of one number fit.
std::vector<FoundImpact> as_in_rows(const Reference& reference, const DeclaredLaw& law,
                                    std::vector<FoundImpact> impacts) {
  for (FoundImpact& impact : impacts) {
    if (!impact.begins_in_a_row) continue;
    FoundImpact plain = impact;
    plain.bookings.resize(1);
    const double booked = law_error(reference, law, impact), left = law_error(reference, law, plain);
    if (!(booked <= reference.tolerances[1]) && !(booked <= explained * left)) impact = plain;
  }
  return impacts;
}

/// Hypotheses on the law of the impacts and on the body.
class ImpactCauses {
 public:
  ImpactCauses(const Reference& reference, const DeclaredLaw& law, const std::vector<FoundImpact>& impacts,
               double gravity_of_step, Trials& trials)
      : reference_(reference), law_(law), trials_(trials), total_(total_of(reference, law, impacts)) {
    for (std::size_t i = 0; i < impacts.size(); ++i) {
      if (!impacts[i].points.empty()) impacts_.push_back(impacts[i]), places_.push_back(i);
    }
    for (const FoundImpact& impact : impacts_) errors_.push_back(law_error(reference_, law_, impact));
    for (const double error : errors_) worst_ = worse(worst_, error);
    for (std::size_t i = 0; i < impacts_.size(); ++i) {
      if (!(errors_[i] <= 0.1 * worst_)) broken_.push_back(i);
    }
    by_step_ = std::all_of(broken_.begin(), broken_.end(), [&](std::size_t i) {
      return errors_[i] <= step_share * law_error_of_speed(reference_, impacts_[i], gravity_of_step);
    });
  }

  /// Those on the body alone.
  std::vector<Cause> of_body() {
    if (!broken_.empty()) add_body();
    if (!broken_.empty() && causes_.empty()) add_together();
    return std::move(causes_);
  }

  /// Another law, or friction that is solved wrongly.  No number is free, so that this goes first: where the normal
  /// impulse is the one without friction, another restitution fits, too.
  std::vector<Cause> of_solver() {
    if (broken_.empty() || !(worst_ > reference_.tolerances[1]) || reference_.is_compliant) return {};
    add_law(explained * explained);
    if (causes_.empty()) add_centre_restitution();
    if (causes_.empty()) add_solver();
    return std::move(causes_);
  }

  std::vector<Cause> of_impacts(const std::vector<FoundImpact>& impacts) {
    if (reference_.is_compliant) return {};
    add_centre_alone(impacts);
    if (!causes_.empty()) return std::move(causes_);
    if (broken_.empty() || !(worst_ > reference_.tolerances[1])) return {};
    add_threshold();
    if (!causes_.empty()) return std::move(causes_);
    add_law(explained);
    add_restitution();
    add_friction();
    add_body();
    if (causes_.empty()) add_together();
    if (causes_.empty()) add_first_restitution();
    return std::move(causes_);
  }

 private:
  using Change = std::function<void(Reference&, DeclaredLaw&, double)>;

  static void other_restitution(Reference&, DeclaredLaw& law, double e) { law.law.restitution = e; }

  [[nodiscard]] DeclaredLaw changed(const Change& change, double value) const {
    Reference unused;
    DeclaredLaw law = law_;
    change(unused, law, value);
    return law;
  }

  /// The largest error of the impacts under another law or body.
  [[nodiscard]] double misfit(const Change& change, double value, const std::vector<std::size_t>& of) const {
    Reference reference = reference_;
    DeclaredLaw law = law_;
    change(reference, law, value);
    double error = 0;
    for (const std::size_t i : of) {
      if (!trials_.spend(impacts_[i])) return Score::unknown;
      error = worse(error, law_error(reference, law, impacts_[i]));
    }
    return error;
  }

  /// Whether the step makes errors of this size, too: one impact then proves nothing, nor do several nearly.
  [[nodiscard]] bool is_of_the_step(double misfit) const {
    return by_step_ && (broken_.size() == 1 || !(misfit <= reference_.tolerances[1]));
  }

  /// @param change by which the law becomes that of the run; none where the body does
  void keep(const char* name, const Fitted& fit, const std::string& words, const Change& change = {}) {
    // With friction one number often fits a part of an impact: it must explain all of it.
    const double most = has_friction() ? explained * explained : explained;
    if (has_friction() && takes_steps()) return;
    if (!(fit.misfit <= most * worst_) || is_of_the_step(fit.misfit)) return;
    causes_.push_back({name, fit.value, fit.misfit, words + " " + misfit_words(fit.misfit)});
    // The law of a run is known where all impacts have it.
    if (change && broken_.size() == impacts_.size()) causes_.back().law = changed(change, fit.value);
  }

  /// Whether impacts go on over several rows: with friction their whole is that of several ones, or of a contact.
  [[nodiscard]] bool takes_steps() const {
    return std::any_of(broken_.begin(), broken_.end(),
                       [&](std::size_t i) { return impacts_[i].last_row > impacts_[i].first_row + 1; });
  }

  [[nodiscard]] bool has_friction() const { return law_.law.has_cone(); }

  [[nodiscard]] std::string which() const { return impacts_words(broken_.size(), total_, places_[broken_.front()]); }

  [[nodiscard]] std::vector<std::size_t> all() const {
    std::vector<std::size_t> each(impacts_.size());
    std::iota(each.begin(), each.end(), std::size_t{0});
    return each;
  }

  /// Velocity of the point that strikes.
  [[nodiscard]] Vector3 speed_of(std::size_t i, const State& state) const {
    return reference_.velocity(state, impacts_[i].points.front());
  }

  /// Separation over approach speed of the point that strikes, in the booking nearest to the law.
  [[nodiscard]] double restitution_of(std::size_t i) const {
    const Booking& booking = impacts_[i].bookings.front();
    return -speed_of(i, booking.after).z() / speed_of(i, booking.before).z();
  }

  [[nodiscard]] double approach_of(std::size_t i) const {
    return -speed_of(i, impacts_[i].bookings.front().before).z();
  }

  /// Two numbers or three at once.  A jump tells the inertia whatever the law is, r × P = k I ΔΩ, Newton's e is that of
  /// its velocities, and friction the ratio of its impulses where it slips.  How the first impact was booked is not
  /// known: each way gives other numbers, of which those of one fit all impacts.
  void add_together() {
    if (law_.law.law != analytic::RestitutionLaw::newton || impacts_.empty() || takes_steps()) return;
    if (reference_.is_planar && broken_.size() < 2) return;  // three numbers fit any three velocities
    // Alone the flights' own states fit other numbers nearly.
    if (impacts_.front().begins_in_a_row && impacts_.front().bookings.size() == 1) return;
    Together best;
    for (const Booking& booking : impacts_.front().bookings) {
      const Together found = numbers_of(booking);
      if (!(found.e >= 0 && found.e <= 1 && found.inertia > 0.1 && found.inertia < 10)) continue;
      for (Together one = found; const Solver solver : solvers()) {
        one.solver = solver;
        for (const double friction : {law_.law.friction_value, found.friction}) {
          one.friction = friction;
          one.misfit = misfit(change_of(one), 0, all());
          if (one.misfit < best.misfit) best = one;
        }
      }
    }
    const double most = has_friction() ? explained * explained : explained;
    if (!(best.misfit <= most * std::fmin(worst_, 1)) || is_of_the_step(best.misfit)) return;
    const auto tell = [&](const char* name, std::optional<double> value, const std::string& words) {
      const bool is_more = !causes_.empty();
      causes_.push_back({name, value, best.misfit,
                         is_more ? fmt::format("{} with it explains {} {}", words,
                                               impacts_words(impacts_.size(), total_, 0), misfit_words(best.misfit))
                                 : "more than one at once: " + words});
      causes_.back().is_more = is_more;
    };
    if (best.inertia != 1) tell("inertia", best.inertia, three_digits(best.inertia) + " times the moment of inertia");
    const auto asked = [](double value) { return fmt::format(" ({} is asked)", shortest(value)); };
    if (best.e != law_.law.restitution)
      tell("restitution", best.e, "e = " + three_digits(best.e) + asked(law_.law.restitution));
    if (best.friction != law_.law.friction_value)
      tell("friction", best.friction, "friction " + three_digits(best.friction) + asked(law_.law.friction_value));
    const auto [solver, solver_words] = named(best.solver);
    if (best.solver != Solver::right) tell(solver, {}, solver_words);
    if (causes_.size() < 2) causes_.clear();
  }

  struct Together {
    double inertia = 1, e = 0, friction = 0, misfit = Score::unknown;
    Solver solver = Solver::right;
  };

  [[nodiscard]] Change change_of(const Together& numbers) const {
    return [this, numbers](Reference& reference, DeclaredLaw& law, double) {
      if (numbers.inertia != 1) reference.scale_inertia(numbers.inertia);
      law.law.restitution = numbers.e;
      if (has_friction()) law.law.friction_value = numbers.friction;
      law.solver = numbers.solver;
      law.is_moreau |= numbers.solver != Solver::right;
    };
  }

  /// The numbers of the first impact so booked; those asked for where they are nearly these.
  [[nodiscard]] Together numbers_of(const Booking& booking) const {
    const auto& [before, after] = booking;
    const space::Quaternion& turn = before.attitude;
    const Vector3 change = turn.conjugate() * (after.angular_velocity - before.angular_velocity);
    const Vector3 moment = turn * (reference_.body.inertia * change);
    const Vector3 impulse = reference_.body.mass * (after.velocity - before.velocity);
    const Vector3 asked = reference_.arm(turn, impacts_.front().points.front()).cross(impulse);
    const auto near = [](double value, double wanted) {
      return std::fabs(value - wanted) <= same * wanted ? wanted : value;
    };
    return {.inertia = near(asked.dot(moment) / moment.squaredNorm(), 1),
            .e = near(-speed_of(0, after).z() / speed_of(0, before).z(), law_.law.restitution),
            .friction = has_friction() ? near(impulse.head<2>().norm() / impulse.z(), law_.law.friction_value) : 0};
  }

  static constexpr double same = 1e-3;  ///< relative: numbers are those asked for

  /// Slow contacts that do not rebound, where faster ones follow the law.
  void add_threshold() {
    if (!(law_.law.restitution > 0.05) || broken_.size() == impacts_.size()) return;
    const double left = misfit(other_restitution, 0, broken_);
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

  /// The law without friction.
  [[nodiscard]] DeclaredLaw smooth() const {
    DeclaredLaw smooth = law_;
    smooth.is_moreau = false;
    smooth.law.friction = analytic::FrictionKind::none;
    smooth.law.friction_value = 0;
    return smooth;
  }

  /// The right one, and the wrong ones that differ from it.
  [[nodiscard]] std::vector<Solver> solvers() const {
    if (!has_friction() || law_.law.friction_value == 0) return {Solver::right};
    std::vector<Solver> some{Solver::right, Solver::reversed, Solver::normal_first, Solver::normal_first_reversed,
                             Solver::pushing};
    if (!reference_.is_planar) some.insert(some.end(), {Solver::pushing_on, Solver::pyramid, Solver::unequal});
    return some;
  }

  /// Name and words of a wrong one.
  static std::pair<const char*, const char*> named(Solver solver) {
    switch (solver) {
      case Solver::pyramid:
        return {"friction-pyramid",
                "friction with a bound of its own along x and along y, a pyramid in place of the cone,"};
      case Solver::unequal:
        return {"friction-weights",
                "friction that is brought back to the cone after unequal steps along x and y, not against the slip,"};
      case Solver::normal_first:
        return {"normal-first",
                "a normal impulse without friction, to which the tangential one is added, as by codes that solve one "
                "after the other,"};
      case Solver::normal_first_reversed:
        return {"friction-direction",
                "friction of the other sign, along the slip, added to the normal impulse without friction,"};
      default: return {"friction-direction", "friction of the other sign, along the slip and not against it,"};
    }
  }

  /// The wrong solver that leaves least, with the friction that is asked for or that of the first impact's impulse.
  void add_solver() {
    if (takes_steps()) return;
    double left = Score::unknown, friction = 0;
    Solver best = Solver::right;
    const Booking& first = impacts_[broken_.front()].bookings.front();
    const double asked = law_.law.friction_value,
                 ratio = std::fabs(reference_.impulse_ratio(first.before, first.after));
    for (const double value : {asked, ratio}) {
      if (value != asked && !(value > same)) break;  // no friction, of any sign
      for (const Solver solver : solvers()) {
        if (solver == Solver::right && value == asked) continue;
        const double one = misfit(solving(solver), value, all());
        if (one < left) best = solver, left = one, friction = value;
      }
      if (left <= explained * explained * worst_) break;
    }
    if (best == Solver::right) return;
    if (!(left <= explained * explained * worst_) || (by_step_ && !(left <= reference_.tolerances[1]))) return;
    const std::string which = impacts_words(impacts_.size(), total_, 0) + " " + misfit_words(left);
    const auto [name, words] = named(best);
    causes_.push_back({name, {}, left, fmt::format("{} explains {}", words, which)});
    causes_.back().law = changed(solving(best), friction);
    if (friction != asked) {
      causes_.push_back({"friction", friction, left,
                         fmt::format("friction {} ({} is asked) with it", three_digits(friction), shortest(asked))});
      causes_.back().is_more = true;
    }
    // In the plane any ratio is that of some friction along the slip after: where P_t is against the slip before,
    // either may be meant.
    if (reference_.is_planar && best != Solver::normal_first && !pushes()) add_friction_ratio(asked);
  }

  static Change solving(Solver solver) {
    return [solver](Reference&, DeclaredLaw& law, double friction) {
      law.is_moreau = true;
      law.solver = solver;
      law.law.friction_value = friction;
    };
  }

  /// e times the velocity of the centre of mass in place of the contact's.  Moreau's map takes any number for e, as a
  /// code does.
  void add_centre_restitution() {
    if (law_.law.law != analytic::RestitutionLaw::newton || takes_steps()) return;
    const Change by_centre = [](Reference&, DeclaredLaw& law, double) {
      law.is_moreau |= law.law.friction == analytic::FrictionKind::none || law.law.friction_value == 0;
      law.aims_by_centre = true;
    };
    const double left = misfit(by_centre, 0, all());
    if (!(left <= explained * explained * worst_) || (by_step_ && !(left <= reference_.tolerances[1]))) return;
    causes_.push_back({"centre-restitution",
                       {},
                       left,
                       fmt::format("the contact rebounds by e times the velocity of the centre of mass, not by its "
                                   "own: that explains {} {}",
                                   impacts_words(impacts_.size(), total_, 0), misfit_words(left))});
    causes_.back().law = changed(by_centre, 0);
  }

  /// Another of the laws that a run may follow: the one that leaves least.
  /// @param most  share of the error that it may leave
  void add_law(double most) {
    const DeclaredLaw* best = nullptr;
    double left = most * worst_;
    for (const DeclaredLaw& other : reference_.laws) {
      if (other.name == law_.name) continue;
      const double one = misfit([&](Reference&, DeclaredLaw& law, double) { law = other; }, 0, all());
      if (one <= left && !is_of_the_step(one)) best = &other, left = one;
    }
    if (best == nullptr) return;
    const std::string explains =
        fmt::format("explains {} {}", impacts_words(impacts_.size(), total_, 0), misfit_words(left));
    const std::string words = law_.name == "any"
                                  ? fmt::format("{} {}: declare it (# law: {}), and {} in the scene", best->name,
                                                explains, best->name, options_of(*best))
                                  : fmt::format("the law {} (judged by {}) {}", best->name, law_.name, explains);
    causes_.push_back({"law", {}, left, words});
    causes_.back().law = *best;
  }

  /// What makes a law the scene's.
  [[nodiscard]] std::string options_of(const DeclaredLaw& law) const {
    std::string options;
    if (law.law.law != law_.law.law)
      options = fmt::format("--restitution-law {}", law.name.substr(0, law.name.find(' ')));
    if (law.is_moreau == law_.is_moreau) return options;
    return (options.empty() ? "" : options + " ") + "--impact-friction-law " + (law.is_moreau ? "moreau" : "coulomb");
  }

  void add_restitution() {
    const double asked = law_.law.restitution;
    if (law_.law.law == analytic::RestitutionLaw::viscoelastic) return;
    Fitted fit = least_of(0, 1, [&](double e) { return misfit(other_restitution, e, broken_); });
    if (const Fitted more = beyond_elastic(); more.misfit < fit.misfit) fit = more;
    // The change of e alone must be able to make the error: where the law jumps, any e beside the right one may fit.
    if (!(std::fabs(fit.value - asked) >= 0.1 * std::fmin(worst_, 1))) return;
    keep("restitution", fit,
         fmt::format("e = {} ({} is asked){} explains {}", three_digits(fit.value), shortest(asked),
                     has_friction() && broken_.size() == 1 ? ", or another normal impulse," : "", which()),
         other_restitution);
  }

  /// By impacts before others follow in neighbouring steps, of which some are taken for one: by two of them at least.
  void add_first_restitution() {
    std::vector<std::size_t> first;
    for (const std::size_t i : broken_) {
      if (i + 1 < impacts_.size() && impacts_[i + 1].first_row <= impacts_[i].last_row) break;
      first.push_back(i);
    }
    if (first.size() < 2 || first.size() == broken_.size()) return;
    const Fitted fit = least_of(0, 1, [&](double e) { return misfit(other_restitution, e, first); });
    if (!(fit.misfit <= reference_.tolerances[1])) return;
    keep("restitution", fit,
         fmt::format("e = {} ({} is asked) explains {} impacts, before those that come in neighbouring rows,",
                     three_digits(fit.value), shortest(law_.law.restitution), first.size()));
  }

  /// e > 1, which the law refuses: without friction the change is (1 + e)/2 times that of e = 1.
  [[nodiscard]] Fitted beyond_elastic() const {
    if (law_.law.friction != analytic::FrictionKind::none && law_.law.friction_value != 0) return {};
    double mean = 0;
    for (const std::size_t i : broken_) mean += restitution_of(i) / static_cast<double>(broken_.size());
    if (!(mean > 1)) return {};
    DeclaredLaw elastic = law_;
    elastic.law.restitution = 1;
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
    const double asked = has_friction() ? law_.law.friction_value : 0;
    const Change coulomb = [](Reference&, DeclaredLaw& law, double value) {
      law.law.friction = analytic::FrictionKind::coulomb;
      law.law.friction_value = value;
    };
    const Fitted fit = least_of(0, 2, [&](double value) { return misfit(coulomb, value, broken_); });
    const bool slips = std::ranges::any_of(broken_, [&](std::size_t i) { return slips_before(i); });
    const std::string words = fit.value > 1e-6 ? fmt::format("friction {}", three_digits(fit.value))
                              : slips          ? "no friction"
                                               : "no friction, or friction by the slip before, which is none,";
    const std::size_t before = causes_.size();
    if (broken_.size() == impacts_.size() || !(misfit(coulomb, fit.value, all()) > explained * worst_))
      keep("friction", fit, fmt::format("{} ({} is asked) explains {}", words, shortest(asked), which()), coulomb);
    if (causes_.size() > before || !reference_.is_planar) return;
    // Against the slip before and along the slip after: either may be meant.
    if (!add_friction_that_pushes(asked) || !pushes()) add_friction_ratio(asked);
  }

  /// P_t = μ_i P_n, whatever the slip becomes.
  void add_friction_ratio(double asked) {
    const Change ratio = [](Reference&, DeclaredLaw& law, double value) {
      law.is_moreau = false;
      law.law.friction = analytic::FrictionKind::impulse_ratio;
      law.law.friction_value = value;
    };
    const Fitted as_ratio = least_of(-2, 2, [&](double value) { return misfit(ratio, value, broken_); });
    if (pushes())
      keep("friction-direction", {std::fabs(as_ratio.value), as_ratio.misfit}, pushing_words(as_ratio.value));
    else
      keep("friction-ratio", as_ratio,
           fmt::format("a tangential impulse of {} times the normal one, against the slip before but whatever it "
                       "becomes (friction {} is asked), explains {}",
                       three_digits(as_ratio.value), shortest(asked), which()));
  }

  /// Friction along the slip in place of against it; Moreau's cone with a negative coefficient.
  bool add_friction_that_pushes(double asked) {
    const Change along = [](Reference&, DeclaredLaw& law, double value) {
      law.is_moreau = true;
      law.law.friction_value = -value;
    };
    if (!(asked > 0)) return false;
    const std::size_t before = causes_.size();
    const Fitted fit = least_of(0, 2, [&](double value) { return misfit(along, value, broken_); });
    keep("friction-direction", fit, pushing_words(fit.value));
    return causes_.size() > before;
  }

  [[nodiscard]] std::string pushing_words(double friction) const {
    return fmt::format("friction {} that acts along the slip and not against it explains {}",
                       three_digits(std::fabs(friction)), which());
  }

  /// Whether each tangential impulse points along the slip before it or, where there is none, along the one that the
  /// normal impulse makes.
  [[nodiscard]] bool pushes() const {
    return std::ranges::all_of(broken_, [&](std::size_t i) {
      const State& before = impacts_[i].bookings.front().before;
      double slip = speed_of(i, before).x();
      if (!slips_before(i)) {
        const Vector3 normal(0, 0, impacts_[i].impulse.z());
        slip = speed_of(i, reference_.struck(before, impacts_[i].points.front(), normal)).x();
      }
      return slip * impacts_[i].impulse.x() > 0;
    });
  }

  [[nodiscard]] bool slips_before(std::size_t i) const {
    return speed_of(i, impacts_[i].bookings.front().before).head<2>().norm() > 1e-3 * reference_.speed();
  }

  /// Properties of the body hold at every impact.
  void add_body() {
    const Change inertia = [](Reference& reference, DeclaredLaw&, double factor) { reference.scale_inertia(factor); };
    const Change lever = [](Reference& reference, DeclaredLaw&, double factor) {
      for (Vector3& vertex : reference.body.vertices) vertex *= factor;
      for (space::Rim& rim : reference.body.rims) rim.centre *= factor, rim.radius *= factor;
      for (space::Ellipsoid& part : reference.body.ellipsoids) part.centre *= factor, part.semiaxes *= factor;
    };
    const auto each = all();
    const Fitted heavy = least_of(0.3, 3, [&](double factor) { return misfit(inertia, factor, each); });
    keep("inertia", heavy,
         fmt::format("{} times the moment of inertia explains {}", three_digits(heavy.value),
                     impacts_words(each.size(), total_, 0)));
    const Fitted longer = least_of(0.5, 1.5, [&](double factor) { return misfit(lever, factor, each); });
    keep("lever", longer,
         fmt::format("levers {} times as long explain {}", three_digits(longer.value),
                     impacts_words(each.size(), total_, 0)));
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
      alone.velocity.z() *= -law_.law.restitution;
      left = worse(left, rebound_distance(after, alone) / change);
      lever = worse(lever, impact.points.empty() ? 1 : lever_share(impact, alone));
    }
    if (impacts.empty() || !(lever > reference_.tolerances[2])) return;
    if (!(left <= explained * std::fmin(lever, 1)) || !(left <= reference_.tolerances[2])) return;
    causes_.push_back({"centre-alone",
                       {},
                       left,
                       fmt::format("restitution of the velocity of the centre of mass, without a lever, explains {} {}",
                                   impacts_words(impacts.size(), total_, 0), misfit_words(left))});
  }

  /// What the law without friction gives beside a rebound of the centre alone, over the change of normal velocity.
  [[nodiscard]] double lever_share(const FoundImpact& impact, const State& alone) const {
    const State& before = impact.bookings.front().before;
    const auto exact = answer_of(reference_, smooth(), before, impact.points);
    return exact ? rebound_distance(*exact, alone) / std::fabs(alone.velocity.z() - before.velocity.z())
                 : Score::unknown;
  }

  const Reference& reference_;
  const DeclaredLaw& law_;
  Trials& trials_;
  std::size_t total_;                  ///< impacts that the run has or should have
  std::vector<FoundImpact> impacts_;   ///< whose points are known
  std::vector<std::size_t> places_{};  ///< of each of these among all
  std::vector<double> errors_;
  std::vector<std::size_t> broken_;  ///< impacts that do not follow the law
  double worst_ = 0;
  bool by_step_ = false;  ///< g × step can make the law errors of these
  std::vector<Cause> causes_;
};

/// An inertia or levers so far off that no point of the body explains a jump: it is taken for one of the lowest point.
std::vector<Cause> far_body_causes(const Reference& reference, const DeclaredLaw& law, std::vector<FoundImpact> impacts,
                                   Trials& trials) {
  if (reference.is_compliant) return {};
  for (FoundImpact& impact : impacts) {
    if (!impact.points.empty()) continue;
    impact.points = {reference.lowest(impact.before.attitude)};
  }
  return ImpactCauses(reference, law, impacts, 0, trials).of_body();
}

/// Another inertia, by the lowest point's lever at the first impact: with it the impacts are looked for anew, since of
/// two within a step the share of each depends on it.
void add_far_inertia(const Answer& answer, const Reference& reference, const DeclaredLaw& law, const FoundImpact& first,
                     std::vector<Cause>& causes) {
  const space::Quaternion& turn = first.before.attitude;
  const Vector3 arm = reference.arm(turn, reference.lowest(turn));
  const Vector3 change = first.after.angular_velocity - first.before.angular_velocity;
  const Vector3 moment = turn * (reference.body.inertia * (turn.conjugate() * change));
  const double factor = arm.cross(first.impulse).dot(moment) / moment.squaredNorm();
  if (reference.is_compliant || !(factor > 0.1 && factor < 10)) return;
  Reference other = reference;
  other.scale_inertia(factor);
  double left = 0;
  const std::vector<FoundImpact> impacts = impacts_of(Motion(answer.table, other), other);
  for (const FoundImpact& impact : impacts) left = worse(left, law_error(other, law, impact));
  if (!(left <= explained * std::fabs(factor - 1))) return;
  causes.push_back(
      {"inertia", factor, left,
       fmt::format("{} times the moment of inertia explains {} {}", three_digits(factor),
                   impacts_words(impacts.size(), total_of(reference, law, impacts), 0), misfit_words(left))});
}

}  // namespace

bool Trials::spend(const FoundImpact& impact) {
  constexpr long of_a_face = 40;  // times what one point costs
  left_ -= static_cast<long>(impact.bookings.size() + 2 * impact.of_pair.size()) *
           (impact.points.size() > 1 ? of_a_face : 1);
  return left_ >= 0;
}

std::vector<Cause> impact_causes_of(const Reference& reference, const DeclaredLaw& law,
                                    const std::vector<FoundImpact>& impacts, double gravity_of_step, Trials& trials) {
  const std::vector<FoundImpact> plain = as_in_rows(reference, law, impacts);
  std::vector<Cause> causes = ImpactCauses(reference, law, impacts, gravity_of_step, trials).of_solver();
  if (causes.empty()) causes = ImpactCauses(reference, law, plain, gravity_of_step, trials).of_impacts(plain);
  return !causes.empty() ? causes : ImpactCauses(reference, law, impacts, gravity_of_step, trials).of_impacts(impacts);
}

std::vector<Cause> unturned_inertia_of(const Reference& reference, const DeclaredLaw& law,
                                       const std::vector<FoundImpact>& impacts, const space::Quaternion& first) {
  if (reference.is_planar || reference.is_compliant || impacts.empty()) return {};
  const auto kept_in = [&](const space::Quaternion& frame, const FoundImpact& impact) {
    double least = Score::unknown;
    for (const Booking& booking : impact.bookings) {
      Reference kept = reference;
      const space::Matrix3 turn = (booking.before.attitude.conjugate() * frame).toRotationMatrix();
      const space::Matrix3 inertia = turn * reference.body.inertia * turn.transpose();
      kept.body.inertia = (inertia + inertia.transpose()) / 2;
      kept.principal = space::PrincipalAxes(kept.body.inertia);
      FoundImpact one = impact;
      one.bookings = {booking};
      least = std::fmin(least, law_error(kept, law, one));
    }
    return least;
  };
  for (const bool is_of_world : {true, false}) {
    std::size_t count = 0, only = 0;
    double left = 0, was = 0;
    for (std::size_t i = 0; i < impacts.size(); ++i) {
      FoundImpact impact = impacts[i];
      if (impact.points.empty()) impact.points = {reference.lowest(impact.before.attitude)};
      if (impact.points.size() > 1 || !impact.pair.empty() || impact.last_row > impact.first_row + 1) continue;
      const double asked = law_error(reference, law, impact);
      const double one = kept_in(is_of_world ? space::Quaternion::Identity() : first, impact);
      if (one <= reference.tolerances[2] && asked <= reference.tolerances[2]) continue;  // as it lies, both agree
      only = i, ++count, left = worse(left, one), was = worse(was, asked);
    }
    if (count == 0 || !(left <= explained * explained * std::fmin(was, 1))) continue;
    return {{"inertia-axes",
             {},
             left,
             fmt::format("an inertia that does not turn with the body, its numbers {}, explains {} {}",
                         is_of_world ? "in body axes taken for those in world axes" : "those of the first row",
                         impacts_words(count, total_of(reference, law, impacts), only), misfit_words(left))}};
  }
  return {};
}

std::vector<Cause> far_body_causes_of(const Answer& answer, const Reference& reference, const DeclaredLaw& law,
                                      const std::vector<FoundImpact>& impacts, Trials& trials) {
  std::vector<Cause> causes;
  add_far_inertia(answer, reference, law, impacts.front(), causes);
  if (causes.empty()) causes = far_body_causes(reference, law, impacts, trials);
  return causes;
}

}  // namespace clatter::validation
