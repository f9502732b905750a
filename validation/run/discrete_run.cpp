// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/discrete_run.hpp"

#include <utility>

#include "validation/output/bad_input.hpp"

namespace clatter::validation {

std::string read_sequence_method(const std::string& option, const std::string& name) {
  if (name == "closed-form")
    throw BadInput(option + " closed-form: no longer there; discrete gives the same rows, and those after the third");
  static_cast<void>(read_name_option(option, name, {"auto", "discrete"}));
  return name;
}

DiscreteRun run_discrete(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  DiscreteSequence sequence = std::visit(
      [&](const auto& drop) -> DiscreteSequence {
        return impact_sequence(
            drop, {.impacts = scene.most_impacts(), .digits = scene.accuracy.digits, .until_rest = scene.until_rest});
      },
      prepared.drop);
  Run run = named_run(scene, sequence, prepared.centre);
  return {std::move(sequence), std::move(run)};
}

}  // namespace clatter::validation
