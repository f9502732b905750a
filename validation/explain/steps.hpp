// SPDX-License-Identifier: GPL-3.0-or-later
// What derivations in the plane and in space share: how lines are written, the laws of an impact, its energy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "validation/explain/formula.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// A single number with its name.
[[nodiscard]] Quantity number(const Symbol& symbol, double value, const std::string& unit, double error = 0,
                              double size = 0);

/// Writes steps whose numbers are known to one relative error, unless they bring one of their own.
class StepWriter {
 public:
  /// @param relative  infinite: nothing is known
  explicit StepWriter(double relative) : relative_(relative) {}

  void open(const std::string& title, const Words& words) { steps_.push_back({title, words, {}, {}}); }
  /// More words of the step.
  void say(const Words& words);
  void law(const Expression& left, const Expression& right) { steps_.back().laws.push_back({left, right}); }
  /// A number as it stands in the scene.
  Quantity given(const Quantity& exact, const Words& words);
  /// A number of the sequence, which words tell.
  Quantity found(const Quantity& quantity, const Words& words);
  /// A number of the sequence and the formula that gives it.
  Quantity found(const Quantity& quantity, const Expression& formula, const Words& words = {});
  /// A number that the formula gives; vectors and matrices, too.
  Quantity computed(const Symbol& symbol, const std::string& unit, const Expression& formula, const Words& words = {},
                    double size = 0);

  [[nodiscard]] std::vector<Step> take() { return std::move(steps_); }

 private:
  [[nodiscard]] Quantity with_error(Quantity quantity) const;

  double relative_;
  std::vector<Step> steps_;
};

/// What the scene gives of the body, the world and the law, with a line for each.
struct Given {
  Quantity mass, gravity;
  std::optional<Quantity> restitution{};    ///< e, unless it comes from the ground
  std::optional<Quantity> damping_time{};   ///< τ = c_G/k_G, if e comes from the ground
  std::optional<Quantity> friction{};       ///< Coulomb's μ > 0
  std::optional<Quantity> moreau{};         ///< the same, judged by the slip after the impact
  std::optional<Quantity> impulse_ratio{};  ///< μ_i as given

  [[nodiscard]] bool has_friction() const { return friction || moreau || impulse_ratio; }
};
/// Opens the first step with mass and gravity, ...
[[nodiscard]] Given write_body(StepWriter& writer, double mass, double gravity);
/// ... and ends it with the law.
void write_law(StepWriter& writer, const Scene& scene, const analytic::ImpactLaw& law, Given& given);

/// e at the normal velocity u < 0 of the contact: as given, or from the ground's damping with lines that show how.
/// @param value  e as the sequence has it

Quantity write_restitution(StepWriter& writer, const Given& given, const Quantity& u, double value);

/// Speed of the fall from scene.height, downward, of a centre of mass that touches at height z.
void write_fall(StepWriter& writer, const Scene& scene, const Given& given, const Quantity& z, const Quantity& speed);

/// Energies before and after and the loss, each with its value.
struct Energies {
  Expression before, after, loss;
  Quantity before_value, after_value, loss_value;
};
void write_energy(StepWriter& writer, const Words& words, const Energies& energies);

/// The impact of a number from 1 of a sequence, and all that its steps are written from.
[[nodiscard]] std::vector<Step> impact_steps(const Scene& scene, const analytic::Drop& drop,
                                             const analytic::Sequence& sequence, int n);
[[nodiscard]] std::vector<Step> impact_steps(const Scene& scene, const analytic::space::Drop& drop,
                                             const analytic::space::Sequence& sequence, int n);

}  // namespace clatter::validation
