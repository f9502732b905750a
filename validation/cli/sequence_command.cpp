#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/sequence_report.hpp"
#include "validation/plan/closed_form.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

struct SequenceInput {
  SceneTexts scene;
  std::optional<std::string> method;
  OutputTexts output;
};

enum class SequenceMethod { automatic, closed_form, discrete };

/// By plan: the closed form costs as much as the discrete model, which goes on after the third impact, knows how errors
/// grow and takes any body; only Eq. 9 by itself is cheaper.
analytic::Sequence computed(const Scene& scene, SequenceMethod method) {
  const analytic::Drop drop = scene.drop();
  if (method != SequenceMethod::closed_form) {
    return analytic::impact_sequence(drop, {.impacts = scene.impacts, .digits = scene.digits});
  }
  const std::string reason = reason_against_closed_form(drop);
  if (!reason.empty()) throw BadInput("--method closed-form: does not apply: " + reason);
  return closed_form_sequence(drop, scene.impacts);
}

int run_sequence(const SequenceInput& input) {
  const Scene scene = read_scene(input.scene);
  const OutputChoice choice = read_output(input.output);
  const auto method = static_cast<SequenceMethod>(
      read_name_option("--method", input.method.value_or("auto"), {"auto", "closed-form", "discrete"}));
  const analytic::Sequence sequence = computed(scene, method);
  for (const std::string& warning : sequence.warnings) fmt::print(stderr, "clatter: {}\n", warning);
  write_report(choice, [&] { return sequence_json(scene, sequence); },
               [&] { return sequence_records(scene, sequence); },
               [&] { return sequence_table(scene, sequence); });
  return 0;
}

}  // namespace

Action add_sequence_command(CLI::App& app) {
  auto input = std::make_shared<SequenceInput>();
  CLI::App* command = app.add_subcommand("sequence", "impact sequence of a falling rod or box");
  add_scene_options(*command, input->scene);
  add_text(*command, "--method", input->method, "NAME", "auto, closed-form (Eqs. 9 and 12) or discrete (auto)")
      ->group("Scene");
  add_output_options(*command, input->output);
  command->footer("Example: clatter sequence --angle 10 --gravity 9.81 --restitution 0.8 --impacts 20");
  return [input] { return run_sequence(*input); };
}

}  // namespace clatter::validation
