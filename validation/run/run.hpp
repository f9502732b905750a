// SPDX-License-Identifier: GPL-3.0-or-later
// One run of either model, in the plane or in space: the impacts, what follows them and how it ended.  Models' own rows
// are converted here; reports, sweeps, comparisons, JSON and Python read nothing else.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/output/estimated.hpp"

namespace clatter::validation {

/// The model of a run, which decides what is known of its impacts.
enum class RunModel { plane, space, continuous };

using EntryVector = std::array<double, 3>;      ///< x, y, z; world frame if nothing else is said
using EntryParameters = std::array<double, 4>;  ///< Euler parameters, scalar first

/// The numbers of an impact; the same struct holds their errors, not finite where not known.  What a model has not is
/// 0.
struct Numbers {
  double start = 0;              ///< touch-down, after that of impact 1; of a tail its end [s]
  double duration = 0;           ///< [s]
  double inclination_deg = 0;    ///< of the body's x axis at touch-down, > 0: end a lower [°]
  double contact_angle_deg = 0;  ///< acute angle between body and ground at touch-down [°]
  double approach_speed = 0;     ///< of the contact point, downward [m/s]
  double restitution = 0;        ///< separation over approach speed that came out
  double impulse_ratio = 0;      ///< P_x/P_z
  EntryVector impulse{};         ///< of the ground [N·s]; an error in space: each the bound on the vector's length
  double peak_force = 0;         ///< [N]
  double peak_time = 0;          ///< after touch-down [s]
  double indentation = 0;        ///< greatest depth of a point of the body below the ground [m]
  EntryVector velocity_after{};  ///< of the centre of mass [m/s]
  EntryVector angular_velocity_after{};  ///< [rad/s]
  double energy_before = 0;              ///< translational, rotational and potential [J]
  double energy_after = 0;               ///< [J]
  double energy_loss = 0;                ///< [J]
  double work_damping = 0;               ///< [J]
  double work_friction = 0;              ///< [J]
  double work_released = 0;              ///< [J]
  EntryParameters attitude{1, 0, 0, 0};  ///< at touch-down, body to world

  /// Nothing is known.
  [[nodiscard]] static Numbers unknown();
};

struct Impact {
  int n = 0;              ///< from 1
  bool is_tail = false;   ///< the sum of infinitely many impacts after the last row; `start` is their end
  std::string end{};      ///< which end of the body strikes, or its vertices
  std::string corners{};  ///< which of its corners; empty: they have no names
  EntryVector place{};    ///< of the first of them, from the geometric centre (a mesh: in its file's frame) [m]
  Numbers value{}, error{};
  int touches = 1;        ///< separate places that came down
  const char* mode = "";  ///< how friction acted
  bool submerged = false;
  double local_slip = 0;     ///< [N·s]
  double energy_stored = 0;  ///< [J]
  double ledger_gap = 0;
  double amplification = 0;
  bool predictable = true;
  double largest_speed = 0;  ///< of the centre of mass, before or after; the simulator's: or of approach [m/s]
  double largest_rate = 0;   ///< before or after [rad/s]
};

/// How a body that was let go comes to the ground.
struct FirstTouch {
  Estimated time{};                ///< since the release [s]
  EntryParameters attitude{};      ///< body to world
  EntryVector velocity{};          ///< of the centre of mass [m/s]
  EntryVector angular_velocity{};  ///< [rad/s]
};

/// The sum of infinitely many impacts after the last row.
struct RunTail {
  Impact sum{};
  bool closed_form = false;  ///< else by extrapolation
};

/// The body at a time that was asked for; errors are bounds, of vectors on their length, not finite where not known.
struct MotionAt {
  double time = 0;        ///< since the first impact [s]
  int impacts = 0;        ///< that have begun until then
  bool touches = false;   ///< some of it is on the ground
  bool is_known = false;  ///< else the model does not say where it is
  int beside = 0;         ///< impact of which errors decide whether it is before or after this; 0: none
  EntryVector position{}, velocity{}, angular_velocity{};
  EntryParameters attitude{1, 0, 0, 0};
  double inclination_deg = 0, energy = 0;
  double position_error = unknown_error, attitude_error = unknown_error;  ///< [m], [rad]
  double velocity_error = unknown_error, angular_velocity_error = unknown_error, energy_error = unknown_error;
  double inclination_error_deg = unknown_error;
};

/// What the body does after its last impact, where that is known.
struct EndMotion {
  std::string kind{};                          ///< "rests", "slides", "spins", "rolls"
  double begin = 0;                            ///< since the first impact [s]
  double duration = 0;                         ///< until it rests or, if it rolls, rolls; infinite: never [s]
  double distance = 0;                         ///< along the ground meanwhile [m]
  EntryVector velocity{}, angular_velocity{};  ///< at its beginning
  EntryVector velocity_after{}, angular_velocity_after{};  ///< at its end; where it never ends as at its beginning
  [[nodiscard]] bool ends() const { return std::isfinite(duration); }
};

struct Run {
  RunModel model = RunModel::plane;
  std::vector<Impact> impacts{};
  std::optional<FirstTouch> first_touch{};  ///< of a drop with a release
  std::optional<RunTail> tail{};
  std::optional<EndMotion> end_motion{};
  std::vector<MotionAt> states{};  ///< at the times that were asked for
  const char* outcome = "";
  std::string message{};  ///< the outcome in words
  std::vector<std::string> warnings{};
  bool is_cut_short = false;  ///< a number could not be computed, or a limit on the work was reached
  bool leaves_model = false;  ///< the next impact is outside the model
  bool moves_on = false;      ///< it lies on the ground, but slides or spins there
  double relative_error = 0;  ///< largest of the discrete model's numbers; infinite: one cannot be predicted
  std::optional<analytic::NearMiss> near_miss{};  ///< of the flight after the last impact
  /// By the model itself, which knows how errors are correlated [N·s].
  std::optional<Estimated> total_normal_impulse{};
  long evaluations = 0;  ///< of the discrete model, of heights or rotations
};

/// An inclination that no drop has: the angle of the first impact is then that of its row.
inline constexpr double no_inclination = 360;

/// The impact of a row.
/// @param n  its number; 0: it has none
/// @param drop_deg  inclination of the drop as it was given, which the first impact keeps to the last digit [°]
[[nodiscard]] Impact impact_of(const analytic::ImpactRow& row, int n = 0, double drop_deg = no_inclination);
[[nodiscard]] Impact impact_of(const analytic::space::ImpactRow& row, int n = 0);
[[nodiscard]] Impact impact_of(const numeric::ImpactRecord& row, int n = 0);

/// The run of a sequence or simulation, without names of corners in space.
[[nodiscard]] Run run_of(const analytic::Sequence& sequence, double drop_deg = no_inclination);
[[nodiscard]] Run run_of(const analytic::space::Sequence& sequence);
[[nodiscard]] MotionAt motion_at(const analytic::space::StateAt& state);
[[nodiscard]] MotionAt motion_at(const numeric::StateRecord& state);
/// "friction stops its slide after 1.22324 s and 3.66972 m", "it rolls on at 0.714 m/s from 0.2 s on"; empty: it rests.
[[nodiscard]] std::string words_of(const EndMotion& motion);
[[nodiscard]] Value fields_of(const EndMotion& motion);
/// The outcome of a run whose bounces have ended in that motion, or in one that is not computed.
/// @param followed  to the rest that it comes to, if it does
/// @param stops  whether friction stops in the end whatever slides
void settle_outcome(bool followed, bool stops, Run& run);
[[nodiscard]] Run run_of(const numeric::Simulation& simulation);

// Sums over the impacts of a run, with the errors that follow from those of the impacts.

/// Sums and extremes over the impacts listed; the normal impulse with that of the discrete model's tail.  Errors of
/// impacts may be correlated, so their sizes add up.  One impact that cannot be predicted leaves all unknown but the
/// first peak, if that is another impact's.
struct Totals {
  int impacts = 0;
  bool predictable = true;   ///< each impact is
  Estimated normal_impulse;  ///< [N·s]
  Estimated energy_loss;     ///< [J]
  Estimated last_start;      ///< touch-down of the last impact, after that of the first [s]
  Estimated first_peak;      ///< peak force of the first impact [N]; the continuous model's
  Estimated largest_peak;    ///< [N]; likewise
  Estimated largest_depth;   ///< greatest indentation [m]; likewise
};

[[nodiscard]] Totals totals(const Run& run);

/// How a planar drop touches after its fall.
[[nodiscard]] FirstTouch first_touch_of(const analytic::Drop& drop);
/// How the continuous model's body touches; the error of its time is not known.
[[nodiscard]] FirstTouch first_touch_of(double time, const numeric::MotionState& state);
/// The numbers of a first touch; an error that is not known is left out.
[[nodiscard]] Value fields_of(const FirstTouch& touch);
/// "first touch 0.358364 s after the release, at (0.3, 0, -3.71555) m/s and (0, 9, 0) rad/s".
[[nodiscard]] std::string words_of(const FirstTouch& touch);

/// Adds the sum of normal impulses, its error and whether all can be predicted to the fields of a run.
void add_totals(const Totals& sums, Value& fields);
/// The sum and its error as a comment of CSV.
[[nodiscard]] std::string totals_line(const Totals& sums);

}  // namespace clatter::validation
