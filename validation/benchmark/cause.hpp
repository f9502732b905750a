// SPDX-License-Identifier: GPL-3.0-or-later
// What explains a foreign run that fails.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/benchmark/score.hpp"

namespace clatter::validation {

/// A hypothesis that explains a run, where the problem's own statement does not.
struct Cause {
  std::string name;             ///< "restitution", "inertia", "phi-sign", …
  std::optional<double> value;  ///< the number that explains the run, in SI units; nothing: the hypothesis has none
  double misfit = 0;            ///< the relative error that is left with it
  std::string words;            ///< one line
  bool is_more = false;         ///< holds beside the cause before it, not in place of it
  /// V, Ω and t of a code that has all but this cause, off the truth; nothing where that cannot be told.
  std::optional<double> error_without{};
  std::optional<DeclaredLaw> law{};  ///< that the impacts follow by it, if it is one of the law alone
  /// V and Ω of a code that has all causes off the run's, over the speed, told of the first; nothing where none has
  /// them.
  std::optional<double> unexplained{};
};

/// A run as its file has it.
struct Answer {
  const NumericTable& table;
  bool is_list = false;               ///< of impacts, not a motion
  bool is_counter_clockwise = false;  ///< what a list's Omega counts as positive
  Ending ending{};
};

/// The part of a run's error that a hypothesis may leave.
inline constexpr double explained = 0.05;

/// A number and what is left with it.
struct Fitted {
  double value = 0, misfit = Score::unknown;
};

/// Three significant digits.
[[nodiscard]] std::string three_digits(double value);

/// "to 2e-16": the misfit of a hypothesis, for its words.
[[nodiscard]] std::string misfit_words(double misfit);

// What explains a run that starts, or is built, in another way than the problem says.

/// Which part of the state at the start is another one: angle, spin or speed, or an angle in degrees.
/// @param left_after what flights and impacts after it leave
[[nodiscard]] std::vector<Cause> start_causes_of(const Motion& motion, const Reference& reference, double left_after);

/// Another length, thickness or radius of a planar body whose centre lies in its middle, by the height of its centre at
/// the first impact, if a step does not explain that; the moment of inertia is that of this size or the one asked for.
/// @param law_left law error of the impacts by the body asked for, which the size must explain
[[nodiscard]] std::vector<Cause> size_causes_of(const Motion& motion, const Reference& reference,
                                                const DeclaredLaw& law, const FoundImpact& first, double law_left);

// What the steps of a foreign run say of the forces that act in flight.

/// Velocities k times those with which the places change, if one k explains at least three quarters of the run's steps:
///     Δx = v Δt / k                                                                                  (1)
/// where v is the mean over the step.  Nothing for |1 − 1/k| ≤ 0.01.
[[nodiscard]] std::optional<Cause> velocity_scale_of(const Motion& motion, const Reference& reference);

/// Whether places and attitudes change as velocities and spin say, (1), and velocities by gravity, for most of the
/// steps.
[[nodiscard]] bool moves_freely(const Motion& motion, const Reference& reference);

/// Another gravity, or damping of the velocity, of the spin or of both, if one of them explains at least three quarters
/// of the run's steps.  From the step of Δt between two rows, with the means v and L of velocity and angular momentum:
///     g = −ΔV_z/Δt,     c v Δt = −(ΔV + g Δt z),     d L Δt = −ΔL                                    (2)
/// each by the median over the steps, so that those with an impact do not count.  In space also an angular velocity
/// that stays constant, as of codes without the gyroscopic term.  Where an impact lasts many rows the body lies, rocks
/// or slides on the ground, and these say nothing of flight.
[[nodiscard]] std::vector<Cause> flight_causes_of(const Motion& motion, const Reference& reference);

/// How a code of first order flies, and that as a cause.
struct FirstOrder {
  Flying flying;
  Cause cause;
};

/// A step of first order Δt, by whose velocities the places run ahead of free flight's or fall behind by
///     ±g Δt/2                                                                                        (3)
/// after each impact anew: + of the velocities at the step's end (semi-implicit Euler), − at its begin; in space it may
/// turn by Euler's method, too, or do that alone.  The cause's misfit is the flight error that is left, its value Δt.
/// @param impacts all of the motion
[[nodiscard]] std::optional<FirstOrder> first_order_step_of(const Motion& motion, const Reference& reference,
                                                            const ReferenceSequence& sequence,
                                                            const std::vector<FoundImpact>& impacts,
                                                            double flight_error);

// Rows of a foreign run that are right when read otherwise.

/// The ways to read an answer's rows by which all of it is right: other signs, axes, units and frames, and of a list
/// other ends.
[[nodiscard]] std::vector<Cause> misreadings_of(const Answer& answer, const Reference& reference, const Score& score);
/// Velocities that are those of the row before, if all is right with those of the next.
[[nodiscard]] std::vector<Cause> late_velocities_of(const Answer& answer, const Reference& reference,
                                                    const Score& score);

// What explains impacts that do not follow the law: hypotheses with one number each, fitted to all of them.

/// The work that a search may take, in exact maps of a point: where faces strike in many steps it would take minutes.
class Trials {
 public:
  /// Whether an impact may be held against a law once more.
  [[nodiscard]] bool spend(const FoundImpact& impact);
  [[nodiscard]] bool are_spent() const { return left_ < 0; }

 private:
  long left_ = 200'000;
};

/// Restitution, friction, another law, inertia, levers, a restitution that is left out for slow contacts or acts at the
/// centre of mass, each by the exact map at the run's own state before an impact (Score::law).
/// @param gravity_of_step g × step of a code that does not resolve the instants, otherwise 0 [m/s]: errors that it
/// makes
///        are no evidence
[[nodiscard]] std::vector<Cause> impact_causes_of(const Reference& reference, const DeclaredLaw& law,
                                                  const std::vector<FoundImpact>& impacts, double gravity_of_step,
                                                  Trials& trials);

/// An inertia or levers so far off that no point of the body explains the jumps.
/// @pre the first of the impacts has no points
[[nodiscard]] std::vector<Cause> far_body_causes_of(const Answer& answer, const Reference& reference,
                                                    const DeclaredLaw& law, const std::vector<FoundImpact>& impacts,
                                                    Trials& trials);

/// An inertia that does not turn with the body: the numbers in body axes taken for those in world axes, or those of the
/// first row kept.  It must explain each impact of one point in one step, at the run's own states; no number is free.
/// @param first  the attitude of the first row
[[nodiscard]] std::vector<Cause> unturned_inertia_of(const Reference& reference, const DeclaredLaw& law,
                                                     const std::vector<FoundImpact>& impacts,
                                                     const analytic::space::Quaternion& first);

/// What explains a run, and what that leaves open.
struct Diagnosis {
  std::vector<Cause> causes;
  std::string remark{};  ///< what the search could not tell, in words; empty: nothing
  /// Whether impacts are off the law beyond the class "good" and what a step does, and no cause explains that.
  bool law_is_unexplained = false;
};

// What may have gone wrong in a foreign run: hypotheses with one number each, fitted to the run's own impacts and
// flights, or to the rows as they were written.

/// The hypotheses that explain a run that fails; none where all leave more than a twentieth of the error.  Where
/// several are at work at once, the one comes first without which the least error would be left.
///
/// Each impact is judged by the exact map at the run's own state before it (Score::law): restitution, friction,
/// inertia, lever and a restitution that is left out for slow contacts.  The flights tell gravity and damping; the
/// first touch angle, spin and speed; the pose at impacts a margin above the ground and a delay; the rows signs, axes,
/// units and frames; lists mass, ends and the sense of Omega.
///
/// Flights and impacts have their causes independently of each other.
[[nodiscard]] Diagnosis diagnosis_of(const Answer& answer, const Reference& reference, const Score& score);

}  // namespace clatter::validation
