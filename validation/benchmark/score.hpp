// SPDX-License-Identifier: GPL-3.0-or-later
// How well a foreign run answers: five scores, and a verdict.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/benchmark/motion.hpp"

namespace clatter::validation {

/// Classes of tolerance, the best first; each has its largest error in Reference::tolerances.
enum class Verdict {
  exact,
  sharp,
  good,
  coarse,
  incomplete,  ///< what there is lies in a class, and something that the problem asks for is left out
  fails
};
[[nodiscard]] const char* verdict_name(Verdict verdict);
[[nodiscard]] const std::vector<std::string>& verdict_names();

/// Errors of one impact.
struct ImpactScore {
  std::string place, true_place;
  std::size_t first_line = 0, last_line = 0;  ///< of the file, around it
  std::vector<std::string> pair{};            ///< places that one step strikes, the earlier first, this among them
  double time = 0;                            ///< since the first touch, as found [s]
  double law_error = 0;                       ///< (1)
  double time_error = 0;                      ///< [s], signed
  double velocity_error = 0;                  ///< |ΔV| over the sequence's largest |V|
  double angular_error = 0;                   ///< |ΔΩ| over the sequence's largest |Ω|, at least |V|/reach
  double energy_error = 0;                    ///< of the energy after it, relative to that of the start, signed
  double impulse_error = 0;   ///< |ΔP| over the sequence's largest |P|, of a list; of a motion P is m ΔV
  double drift = 0;           ///< of energy in flight after it, of the first impact also before it
  double flight_error = 0;    ///< of the rows there
  double error = 0;           ///< the largest of these, of the first impact also the start's
  std::string measured{};     ///< restitution and friction beside the law's, where it does not follow that
  double impulse_normal = 0;  ///< [N·s]
  double impulse_tangential = 0;
  analytic::space::State after;
};

/// Rows that lie off their flight, and how far the worst of them does.
struct Stray {
  /// Rows of the motion, first and last, that may be wrong while all others are right.
  std::vector<std::pair<std::size_t, std::size_t>> alone;
  std::string size;   ///< "z is 5.1 m", of the worst
  std::string words;  ///< a finding
};

/// The scores of one run.  Errors are relative; a score that cannot be had is infinite.
///   law       distance of the velocities after an impact from the exact map at the code's own state before it, in the
///             norm of kinetic energy, over the map's own change; the nearest of the impact's bookings
///   order     number and places of the impacts, in their order
///   motion    V, Ω and t against the truth; t over the last impact's time, at least reach/speed
///   impulse   of a list against the truth
///   energy    after the impacts against the truth, and what is gained or lost between impacts
///   flight    the farthest that a row lies off the free flight from the row after the impact before, over the reach
///             in impacts and behind what is asked for: how much farther from the row before than their speeds allow
///   start     of the state at the first touch, as Motion::start_error()
struct Score {
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  std::string law;  ///< that the run is judged by
  bool law_is_declared = false;
  std::vector<ImpactScore> impacts{};
  std::size_t found = 0, expected = 0;
  bool order_is_right = false;
  double law_error = 0, velocity_error = 0, angular_error = 0, time_error = 0, impulse_error = 0, energy_error = 0,
         flight_error = 0, start_error = 0;
  double gradient_error = 0;           ///< of derivatives that a list gives (gradient_score.hpp)
  std::optional<std::size_t> drift{};  ///< after how many impacts energy is worst
  std::optional<Stray> stray{};        ///< the flight that is worst
  std::string start_words{};           ///< what differs at the start
  std::string left_out{};              ///< what the problem asks for and the answer does not say; empty: nothing
  /// Whether the impacts that are missing can still come after the last row: errors are those of what there is.
  bool ends_early = false;
  std::vector<std::string> findings{};  ///< what is wrong, in words, the first first
  std::string law_words{};              ///< of the impact that follows the law least, as a finding; empty: all do

  /// V, Ω and t.
  [[nodiscard]] double motion_error() const;
  /// Whether the law is broken by more than a small part of that: what a step leaves of it comes last.
  [[nodiscard]] bool is_law_first() const;
  /// The largest of all but that of derivatives.
  [[nodiscard]] double impacts_error() const;
  /// The largest of all.
  [[nodiscard]] double error() const;
  /// What that is an error of, in words.
  [[nodiscard]] std::string decided_by() const;
};

/// Distance of the velocities after an impact from the law's exact map at the state before it, over the map's own
/// change; of the impact's bookings the nearest.  Unknown where no point struck or the law has no answer.
[[nodiscard]] double law_error(const Reference& reference, const DeclaredLaw& law, const FoundImpact& impact);
/// The same, of velocities that are off by a speed [m/s].
[[nodiscard]] double law_error_of_speed(const Reference& reference, const FoundImpact& impact, double speed);
/// The larger of two errors; one that is no number counts as unknown.
[[nodiscard]] double worse(double error, double other);

[[nodiscard]] Verdict verdict_of(const Score& score, const std::vector<double>& tolerances);

/// What an answer says of its end, in lines above its header.
struct Ending {
  bool nothing_approaches = false;  ///< "# ended: nothing approaches": free flight from the last row on, for ever
  std::optional<double> energy;     ///< "# energy: J", m V²/2 + ω·L/2 + m g z at its end [J]
};

/// The scores of a motion.  Without a declared law (empty) the one that fits best.
[[nodiscard]] Score score_motion(const Motion& motion, const Reference& reference, const std::string& law,
                                 const Ending& ending = {});
/// How a code turns in steps of Δt: as free bodies do, or by Euler's method.
enum class Turning {
  free,
  by_new,       ///< ω' = ω − I⁻¹(ω × Iω) Δt, and attitudes by ω'
  by_old,       ///< the same, and attitudes by ω
  by_momentum,  ///< attitudes by ω, and ω' from the angular momentum, which stays
};

/// How a code flies.
struct Flying {
  /// By which places run ahead of free flight's [m/s].
  analytic::space::Vector3 creep = analytic::space::Vector3::Zero();
  Turning turning = Turning::free;
  double step = 0;           ///< of the turning [s]
  bool is_on_sphere = true;  ///< whether Euler parameters turn by an angle, or by a way that is then made of length 1
};
[[nodiscard]] analytic::space::State flown(const Reference& reference, const analytic::space::State& from, double time,
                                           const Flying& by);
/// Score::flight_error of a motion that flies so.
/// @param impacts all of the motion
[[nodiscard]] double flight_error_with(const Flying& flying, const Motion& motion, const Reference& reference,
                                       const ReferenceSequence& sequence, const std::vector<FoundImpact>& impacts);
/// The scores of a list of impacts; no score of flight and start.  Where the problem says until when nothing more
/// strikes, the list must say that nothing does; where it asks for an energy, its own.
[[nodiscard]] Score score_list(const std::vector<FoundImpact>& impacts, const Reference& reference,
                               const std::string& law, const Ending& ending = {});

}  // namespace clatter::validation
