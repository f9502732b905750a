// SPDX-License-Identifier: GPL-3.0-or-later
// What a foreign run is judged by: the body, how it touches the ground first, the laws that a run may declare, and the
// impacts that each of them gives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/space/flight/free_flight.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// The benchmark's problems, with their truth.

/// One impact of the truth, in the world frame.
struct TruthRow {
  std::string place;    ///< "a", "b", "both", "a-top", …; in space the corner's signs, "-x+y-z"
  double time = 0;      ///< since the first touch [s]
  double duration = 0;  ///< of a contact of finite time [s]
  numeric::Vector3 impulse = numeric::Vector3::Zero();           ///< [N·s]
  numeric::Vector3 velocity = numeric::Vector3::Zero();          ///< of the centre of mass after it [m/s]
  numeric::Vector3 angular_velocity = numeric::Vector3::Zero();  ///< after it [rad/s]
  double uncertainty = 0;                                        ///< of these numbers, relative to the sequence's sizes
};

/// What is asked of a run.
struct Terms {
  bool is_compliant = false;           ///< contacts take a finite time
  bool energy_alone = false;           ///< after the impacts asked for, until `until`
  bool at_rest = false;                ///< by then, with the energy of the pose of the first touch
  std::optional<double> end_energy{};  ///< then, of a body that has stayed on the ground since its last bounce [J]
  /// x of the ground's right end from the centre of mass at the first touch, under the lower face of a level box [m].
  std::optional<double> ground_end{};
  std::vector<double> gaps{0};                             ///< heights of the lowest point at t = 0 to start from [m]
  std::optional<double> until{};                           ///< no impact more until then, since the first touch [s]
  std::vector<double> tolerances{1e-9, 1e-6, 1e-3, 1e-2};  ///< largest error of each class, Verdict's order

  /// Whether the body stays on the ground after ever smaller bounces, which are not asked for.
  [[nodiscard]] bool stays() const { return at_rest || end_energy; }
};

/// A problem with a certified answer.
///
/// The time of a contact of finite time is that at which the flights before and after it have the same height of the
/// centre of mass, and velocity is that of the flight after it, followed back to then.
struct Problem : Terms {
  std::string id;
  int version = 1;
  std::string title, motivation, separates, acceptance;
  Scene scene;             ///< run.impacts: how many are asked for
  std::string scene_text;  ///< as a scene file
};

/// All of them, by ID.
[[nodiscard]] const std::vector<Problem>& benchmark_problems();
/// @throws BadInput naming the nearest; `where` is what asks for it.
[[nodiscard]] const Problem& problem_named(const std::string& where, const std::string& id);

/// Laws that a problem has truths for: "newton routh", …, or "any" where they agree.
[[nodiscard]] std::vector<std::string> truth_laws(const Problem& problem);
/// @pre `law` is one of truth_laws()
[[nodiscard]] std::vector<TruthRow> truth_of(const Problem& problem, const std::string& law);
/// The file's digits of t, Px, Py, Pz, Vx, Vy, Vz, Wx, Wy, Wz and duration by their names, row by row.
[[nodiscard]] Value truth_digits(const Problem& problem, const std::string& law);
/// How long after the first touch a motion must go on at least to have all that is asked for, by any law: Terms::until,
/// otherwise a fifth beyond the last impact and 0.05 s [s].
[[nodiscard]] double enough_time(const Problem& problem);
/// What gave the truth, in words.
[[nodiscard]] std::string oracle_of(const Problem& problem);

/// How a code finds friction by Moreau's law: as that says, or wrongly.  Of points that strike together the impulse as
/// a whole is wrong: with the turn that it gives, reversed, or without, so that each point rebounds by the law.
enum class Solver {
  right,
  pyramid,       ///< in place of the cone, with sides along x and y
  unequal,       ///< back to the cone after steps 1/W_xx and 1/W_yy of projected Gauss-Seidel, along x and y
  reversed,      ///< the right impulse, its tangential part with the other sign
  pushing,       ///< μ times the normal impulse along the slip after the impact, and a normal impulse by that
  pushing_on,    ///< the same along the slip before it
  normal_first,  ///< the normal impulse without friction, then what stops the slip or is at the bound
  normal_first_reversed
};

/// A law of impact that a run may declare.
struct DeclaredLaw {
  std::string name;  ///< "newton routh", …; "any" where the laws agree, and of a scene, whose law is asked for
  analytic::ImpactLaw law;
  bool is_moreau = false;  ///< Newton's e and Coulomb's cone at the end of the impact, instead of along it
  Solver solver = Solver::right;
  bool aims_by_centre = false;  ///< e times the velocity of the centre of mass is what the contact gets, wrongly

  [[nodiscard]] bool is_named(const std::string& other) const { return name == other || name == "any"; }
};

/// A sequence that a law gives.
struct ReferenceSequence {
  DeclaredLaw law;
  std::vector<TruthRow> truth;
  /// States right after each impact, from the truth's velocities and free flight.
  std::vector<analytic::space::State> after;
};

/// A planar body stands here with its vertices in the plane y = 0 and its moment of inertia about every axis.
struct Reference : Terms {
  std::string name{};  ///< the problem's ID, or the scene's file
  bool is_planar = true;
  DiscreteDrop drop{};  ///< as the discrete model has it
  analytic::space::Body body{};
  /// The body's principal axes.
  analytic::space::PrincipalAxes principal{analytic::space::Matrix3::Identity()};
  std::vector<std::string> points{};  ///< names of the vertices, then of the rims; "edge" where the ground ends
  analytic::space::State start{};     ///< at the first touch
  double gravity = 0;                 ///< towards the ground [m/s²]
  double gravity_along = 0;           ///< along x [m/s²]
  std::vector<ReferenceSequence> sequences{};
  std::vector<DeclaredLaw> laws{};  ///< that a run may follow, asked for or not
  std::string remark{};             ///< on the truth, for readers; empty: none

  [[nodiscard]] double reach() const { return body.reach(); }
  /// Acceleration of free fall, ground axes [m/s²].
  [[nodiscard]] analytic::space::Vector3 pull() const { return {gravity_along, 0, -gravity}; }
  /// Potential energy of the centre of mass at (x, z) [J].
  [[nodiscard]] double potential(double x, double z) const { return body.mass * (gravity * z - gravity_along * x); }
  /// Speed at the first touch, of translation and of turning [m/s].
  [[nodiscard]] double speed() const;
  /// Translational, rotational and potential energy [J].
  [[nodiscard]] double energy(const analytic::space::State& state) const;
  /// At `until` [J].  @pre energy_alone
  [[nodiscard]] double last_energy(const ReferenceSequence& sequence) const;
  [[nodiscard]] analytic::space::FreeFlight flight(const analytic::space::State& state) const;
  /// P_t/P_n of the momentum between two states, in the plane with the sign of P_t.
  [[nodiscard]] double impulse_ratio(const analytic::space::State& before, const analytic::space::State& after) const;
  /// The state with an impulse applied at a point [N·s].
  [[nodiscard]] analytic::space::State struck(const analytic::space::State& state, int point,
                                              const analytic::space::Vector3& impulse) const;
  /// Points of a group, by their indices, in words.
  [[nodiscard]] std::string place_name(const std::vector<int>& group) const;
  /// Indices of the points of a place; nothing for an unknown one.
  [[nodiscard]] std::optional<std::vector<int>> place_named(const std::string& place) const;
  /// Where a point touches: of a rim its lowest point, of one that lies level to 1e-6 rad all of it, about its centre.
  [[nodiscard]] analytic::space::Corner corner(const analytic::space::Quaternion& attitude, int point) const;
  /// Gives the body so many times its moments of inertia.
  void scale_inertia(double factor);
  /// From the centre of mass to the place of each corner(), world frame.
  [[nodiscard]] std::vector<analytic::space::Vector3> arms(const analytic::space::Quaternion& attitude) const;
  [[nodiscard]] analytic::space::Vector3 arm(const analytic::space::Quaternion& attitude, int point) const;
  /// Height of a point above the ground [m].
  [[nodiscard]] double height(const analytic::space::State& state, int point) const;
  /// Velocity of a point [m/s].
  [[nodiscard]] analytic::space::Vector3 velocity(const analytic::space::State& state, int point) const;
  /// The lowest point.  @pre there is one
  [[nodiscard]] int lowest(const analytic::space::Quaternion& attitude) const;
  /// The state from which the drop begins so that its lowest point is `gap` above the ground, and the time from there
  /// to the first touch.  @throws BadInput for a gap that the motion before the touch does not have.
  struct Release {
    analytic::space::State state;
    double time = 0;  ///< [s]
  };
  [[nodiscard]] Release release(double gap) const;
};

[[nodiscard]] Reference reference_of(const Problem& problem);
/// The discrete model's answer: with the real body and ground where the scene has one, otherwise by its impact.* keys.
/// @throws as the discrete model does; BadInput for a scene that has no impact.
[[nodiscard]] Reference reference_of(const Scene& scene);

/// The state right after the points strike by `law`: the impact laws of the discrete model in space, or Moreau's.
/// A point that does not approach gets no impulse.
/// @throws as analytic::space::strike()
[[nodiscard]] analytic::space::State exact_map(const Reference& reference, const DeclaredLaw& law,
                                               const analytic::space::State& before, const std::vector<int>& points);
/// The same; nothing where the law has no answer.
[[nodiscard]] std::optional<analytic::space::State> answer_of(const Reference& reference, const DeclaredLaw& law,
                                                              const analytic::space::State& before,
                                                              const std::vector<int>& points);

}  // namespace clatter::validation
