// SPDX-License-Identifier: GPL-3.0-or-later
// The benchmark's problems, with their truth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

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

/// A problem with a certified answer.
///
/// The time of a contact of finite time is that at which the flights before and after it have the same height of the
/// centre of mass, and velocity is that of the flight after it, followed back to then.
struct Problem {
  std::string id;
  int version = 1;
  std::string title, motivation, separates, acceptance;
  bool is_compliant = false;         ///< contacts take a finite time
  bool energy_alone = false;         ///< after the impacts asked for, until `until`
  bool at_rest = false;              ///< by then, with the energy of the pose of the first touch
  std::optional<double> end_energy;  ///< then, of a body that has stayed on the ground since its last bounce [J]
  /// x of the ground's right end from the centre of mass at the first touch, under the lower face of a level box [m].
  std::optional<double> ground_end;
  std::vector<double> gaps;        ///< heights of the lowest point at t = 0 to start from [m]
  std::optional<double> until;     ///< no impact more until then, since the first touch [s]
  std::vector<double> tolerances;  ///< largest error of each class, Verdict's order
  Scene scene;                     ///< run.impacts: how many are asked for
  std::string scene_text;          ///< as a scene file
};

/// All of them, by ID.
[[nodiscard]] const std::vector<Problem>& benchmark_problems();
/// @throws BadInput naming the nearest; `where` is what asks for it.
[[nodiscard]] const Problem& problem_named(const std::string& where, const std::string& id);

/// Laws that a problem has truths for: "newton routh", …, or "any" where they agree.
[[nodiscard]] std::vector<std::string> truth_laws(const Problem& problem);
/// @pre `law` is one of truth_laws()
[[nodiscard]] std::vector<TruthRow> truth_of(const Problem& problem, const std::string& law);
/// The file's digits of t, Px, Py, Pz, Vx, Vy, Vz, Wx, Wy, Wz and duration, row by row.
[[nodiscard]] std::vector<std::vector<std::string>> truth_digits(const Problem& problem, const std::string& law);
/// What gave the truth, in words.
[[nodiscard]] std::string oracle_of(const Problem& problem);

}  // namespace clatter::validation
