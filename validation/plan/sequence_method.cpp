// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/sequence_method.hpp"

#include "validation/output/bad_input.hpp"
#include "validation/plan/closed_form.hpp"

namespace clatter::validation::inline plan {

SequenceMethod read_sequence_method(const std::string& name) {
  return static_cast<SequenceMethod>(read_name_option("--method", name, {"auto", "closed-form", "discrete"}));
}

namespace {

// By plan: the closed form costs as much as the discrete model, which goes on after the third impact, knows how errors
// grow and takes any body; only Eq. 9 by itself is cheaper.
analytic::Sequence planar_sequence(const Scene& scene, const analytic::Drop& drop, SequenceMethod method) {
  if (method != SequenceMethod::closed_form) {
    return impact_sequence(
        drop, {.impacts = scene.most_impacts(), .digits = scene.accuracy.digits, .until_rest = scene.until_rest});
  }
  const std::string reason = reason_against_closed_form(drop);
  if (!reason.empty()) throw BadInput("--method closed-form: does not apply: " + reason);
  return closed_form_sequence(drop, scene.most_impacts(), true);
}

DiscreteSequence sequence_of(const PreparedScene& prepared, SequenceMethod method) {
  const Scene& scene = prepared.scene;
  if (const auto* const planar = std::get_if<analytic::Drop>(&prepared.drop)) {
    return planar_sequence(scene, *planar, method);
  }
  if (method == SequenceMethod::closed_form) throw BadInput("--method closed-form: the body moves in space");
  return impact_sequence(
      std::get<analytic::space::Drop>(prepared.drop),
      {.impacts = scene.most_impacts(), .digits = scene.accuracy.digits, .until_rest = scene.until_rest});
}

}  // namespace

DiscreteRun run_discrete(const PreparedScene& prepared, SequenceMethod method) {
  DiscreteSequence sequence = sequence_of(prepared, method);
  Run run = named_run(prepared.scene, sequence, prepared.centre);
  return {std::move(sequence), std::move(run)};
}

}  // namespace clatter::validation::inline plan
