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
    return impact_sequence(drop, {.impacts = scene.request.impacts, .digits = scene.accuracy.digits});
  }
  const std::string reason = reason_against_closed_form(drop);
  if (!reason.empty()) throw BadInput("--method closed-form: does not apply: " + reason);
  return closed_form_sequence(drop, scene.request.impacts, true);
}

}  // namespace

const std::vector<std::string>& DiscreteRun::warnings() const {
  return std::visit([](const auto& s) -> const std::vector<std::string>& { return s.warnings; }, sequence);
}

DiscreteRun run_discrete(const Scene& scene, SequenceMethod method) {
  DiscreteDrop drop = discrete_drop(scene);
  if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) {
    analytic::Sequence sequence = planar_sequence(scene, *planar, method);
    return {std::move(drop), std::move(sequence)};
  }
  if (method == SequenceMethod::closed_form) throw BadInput("--method closed-form: the body moves in space");
  analytic::space::Sequence sequence = impact_sequence(
      std::get<analytic::space::Drop>(drop), {.impacts = scene.request.impacts, .digits = scene.accuracy.digits});
  return {std::move(drop), std::move(sequence)};
}

}  // namespace clatter::validation::inline plan
