#include "validation/plan/sequence_method.hpp"

#include "validation/plan/closed_form.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation {

SequenceMethod read_sequence_method(const std::string& name) {
  return static_cast<SequenceMethod>(read_name_option("--method", name, {"auto", "closed-form", "discrete"}));
}

// By plan: the closed form costs as much as the discrete model, which goes on after the third impact, knows how errors
// grow and takes any body; only Eq. 9 by itself is cheaper.
analytic::Sequence sequence_by_method(const Scene& scene, SequenceMethod method) {
  const analytic::Drop drop = impact_drop(scene);
  if (method != SequenceMethod::closed_form) {
    return analytic::impact_sequence(drop, {.impacts = scene.options.impacts, .digits = scene.options.digits});
  }
  const std::string reason = reason_against_closed_form(drop);
  if (!reason.empty()) throw BadInput("--method closed-form: does not apply: " + reason);
  return closed_form_sequence(drop, scene.options.impacts, true);
}

}  // namespace clatter::validation
