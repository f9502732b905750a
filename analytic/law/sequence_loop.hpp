// SPDX-License-Identifier: GPL-3.0-or-later
// What the runs of impact sequences share in the plane and in space: how one begins, fills and ends.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/law/impact_law.hpp"
#include "analytic/law/sequence_options.hpp"

namespace clatter::analytic {

/// When the last impact was, and what rounding leaves unknown of its flight.
struct Resolution {
  double time = 0;        ///< since the first impact [s]
  double of_flight = 0;   ///< rounding of the last flight's time [s]
  double of_impulse = 0;  ///< what the ground gives in that time [N·s]
};

/// What a law of restitution or an impulse ratio does that no contact does.
struct Unphysical {
  double created = 0;            ///< energy that impacts created [J, or in internal units]
  std::size_t first_energy = 0;  ///< number of the first impact to do so, from 1; 0: none
  std::size_t first_along = 0;   ///< the same of an impulse ratio that pushes the contact the way it slips
};

/// "the impulse ratio creates energy: ... J in all, from impact ... on", of a law of restitution with the one that
/// never does; else of a ratio that pushes along the slip; empty: neither happens.
/// @param joules  the created energy
[[nodiscard]] inline std::string law_warning(FrictionKind friction, const Unphysical& found, double joules) {
  const bool is_ratio = friction == FrictionKind::impulse_ratio;
  if (found.first_energy == 0 && found.first_along == 0) return "";
  std::ostringstream text;
  text.precision(6);
  text << (is_ratio ? "the impulse ratio" : "the law of restitution, with friction,");
  if (found.first_energy > 0)
    text << " creates energy: " << joules << " J in all, from impact " << found.first_energy << " on";
  else text << " pushes the contact along its slip, as no friction does, from impact " << found.first_along << " on";
  text << (is_ratio ? "; Eq. 8 takes it as given, --friction MU follows the slip"
                    : "; Stronge's law (--restitution-law stronge) never does");
  return text.str();
}

/// The rows, outcome and errors of one run, in internal units.  AnySequence has rows, outcome, message, tail, near_miss
/// and total_normal_impulse; AnyGrowth follows errors and says predictable().
template <class AnySequence, class AnyGrowth>
class SequenceLoop {
 public:
  [[nodiscard]] const Unphysical& unphysical() const { return unphysical_; }

 protected:
  using AnyTail = typename decltype(AnySequence::tail)::value_type;

  explicit SequenceLoop(const SequenceOptions& options, std::vector<double> times = {})
      : options_(options), times_(std::move(times)) {}

  /// Runs the impacts; what ends them early keeps the rows so far.  @throws what `go_on` throws before the first row
  void follow(auto&& go_on) {
    try {
      go_on();
    } catch (const NumericalError& error) {
      end_early(Outcome::not_computed, error);
    } catch (const OutsideModelError& error) {
      end_early(Outcome::outside_model, error);
    }
    result_.end_predictable = growth_ && (growth_->predictable() || end_is_certain_);
    if (!growth_) return;
    std::size_t known = 0;
    while (known < result_.rows.size() && result_.rows[known].error.predictable) ++known;
    if (growth_->predictable() && known == result_.rows.size()) return;
    result_.message += result_.end_predictable ? "; another sequence with the same end is possible"
                                               : "; errors have grown so far that another sequence is possible";
    if (known == result_.rows.size()) return;
    result_.message += " from impact " + std::to_string(known + 1) + " on";
    if (const auto& row = result_.rows[known]; known > 0 && is_tie(row))
      result_.message +=
          ", a tie: its corners strike at once, and no digit tells which is first; a drop of the plane, "
          "or another attitude, has none";
  }

  [[nodiscard]] bool is_last_row() const { return result_.rows.size() >= static_cast<std::size_t>(options_.impacts); }

  bool is_full() {
    if (!is_last_row()) return false;
    result_.outcome = Outcome::impact_limit;
    result_.message = "as many impacts as asked for; more may follow";
    return true;
  }

  /// Whether a state is asked for before this time that is not there yet.
  [[nodiscard]] bool awaits(double until) const { return next_time_ < times_.size() && times_[next_time_] < until; }

  /// Whether something is asked for of the time until then, so that no sum may stand for it.
  [[nodiscard]] bool is_watched(double until) const { return until > options_.until || awaits(until); }

  /// Whether an impact comes too late to be followed.
  bool is_over(double time) {
    if (!(time > options_.until)) return false;
    result_.outcome = Outcome::time_limit;
    result_.message = "the next impact comes after the time asked for";
    return true;
  }

  /// A bouncing in closed form fills the rows asked for first, as far as its speeds and times are numbers; none where
  /// the end is asked for and no number of rows.
  /// @param end  of the bouncing
  [[nodiscard]] bool bounces_on(double separation_speed, double gravity, double end) const {
    constexpr double least = std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
    return (!options_.until_rest || is_watched(end)) && !is_last_row() && separation_speed > least &&
           separation_speed > least * gravity;
  }

  /// Notes the loss of the next row's impact where it is below zero by more than `rounding` of the energy at the start,
  /// which is of order 1 at the first impact.
  void note_energy(double loss, double rounding) {
    const double start = result_.rows.empty() ? 1 : result_.rows.front().energy_before;
    if (!(loss < -rounding * start)) return;
    unphysical_.created -= loss;
    if (unphysical_.first_energy == 0) unphysical_.first_energy = result_.rows.size() + 1;
  }

  /// Notes the next row where an impulse ratio pushes along the slip before or after its impact, as no friction does.
  /// @param before, after  tangential impulse times slip, over the size of the impulse
  void note_push(double before, double after) {
    constexpr double rounding = 1e-12;  // of the slip, beside the speed of the first impact
    if (unphysical_.first_along == 0 && std::fmax(before, after) > rounding)
      unphysical_.first_along = result_.rows.size() + 1;
  }

  inline static const std::string sliding_on = "the body slides on", lying = "the body is at rest";

  /// The contact has come to rest; has the body?
  /// @param stays  what the body does where it turns on
  void rest(bool turns, bool slides, const std::string& how, const std::string& stays) {
    result_.outcome = turns ? Outcome::sustained_contact : Outcome::at_rest;
    result_.moves_on = slides && !turns;
    result_.message = how + "; " + (turns ? stays + ", which impacts do not describe" : slides ? sliding_on : lying);
  }

  /// The motion after all that is known to be none.
  void lies_still() {
    const std::size_t at = result_.message.find(sliding_on);
    if (at != std::string::npos) result_.message.replace(at, sliding_on.size(), lying);
    result_.moves_on = false;
  }

  /// Infinitely many impacts have ended in `tail`.
  /// @param then  ", then the body ..."; empty: nothing comes before what rest() says
  void end_in(AnyTail tail, bool turns, bool slides, const std::string& stays, const std::string& then = "") {
    result_.total_normal_impulse += tail.normal_impulse;
    const char* const sum = tail.closed_form ? "geometric series" : "extrapolated";
    rest(turns, slides, std::string("infinitely many impacts end in a finite time (") + sum + ")" + then, stays);
    result_.tail = std::move(tail);
  }

  void end_in_flight(const auto& near_miss) {
    result_.outcome = Outcome::no_further_impact;
    result_.near_miss = near_miss;
    result_.message = near_miss.within_margin()
                          ? "the next impact is a graze so slight that rounding decides; taken as a miss"
                          : "nothing reaches the ground any more";
  }

  /// What an extrapolated end must be known to: the digits asked for, or 4 ulp of what came before.
  [[nodiscard]] auto extrapolated(const auto& accumulation, const Resolution& now) const {
    constexpr double ulps = 4 * std::numeric_limits<double>::epsilon();
    return accumulation.extrapolate({.relative = std::pow(10.0, -options_.digits),
                                     .time = std::fmax(ulps * now.time, now.of_flight),
                                     .impulse = std::fmax(ulps * result_.total_normal_impulse, now.of_impulse)});
  }

  const SequenceOptions& options_;
  const std::vector<double> times_;  ///< at which states are wanted
  std::optional<AnyGrowth> growth_;
  std::size_t next_time_ = 0;
  bool end_is_certain_ = false;  ///< although errors decide the order of the last impacts
  AnySequence result_;

 private:
  /// Whether several corners arrive together at the end of a flight, as in the plane the vertices of a flat body do.
  static bool is_tie(const auto& row) {
    if constexpr (requires { row.corners; }) return row.corners.size() > row.held + 1;
    return false;
  }

  /// Called while the error is handled.
  void end_early(Outcome outcome, const std::exception& error) {
    if (result_.rows.empty()) throw;
    result_.outcome = outcome;
    result_.message = error.what();
  }

  Unphysical unphysical_;
};

}  // namespace clatter::analytic
