// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <sstream>

#include "validation/cli/command.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/reports/shock_report.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/probes.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation::inline cli {
namespace {

const char* const shock_summary = "shock at points of the body";

struct ShockInput {
  SceneFlags scene;
  std::vector<std::string> probes;
  std::optional<std::string> rows, model, axis, quality, frequencies, first, severity;
  bool no_sensitivity = false;
  OutputTexts output;
  PlotTexts plot;
};

/// The continuous model where the scene has a ground and nothing else is asked.
Model model_of(const ShockInput& input) {
  if (input.model) {
    return read_name_option("--model", *input.model, {"discrete", "continuous"}) == 0 ? Model::discrete
                                                                                      : Model::continuous;
  }
  const bool has_ground =
      is_given(input.scene, "--stiffness") || scene_values(input.scene.source).has("ground.stiffness");
  return has_ground ? Model::continuous : Model::discrete;
}

Scene scene_of(const ShockInput& input) {
  SceneFlags flags = input.scene;
  flags.model = model_of(input);
  const Scene scene = flags.model == Model::discrete ? read_discrete_flags(flags).scene : read_scene_flags(flags);
  if (scene.sweep) throw BadInput(fmt::format("{}: sweep: shock takes a scene that sweeps nothing", scene.path));
  if (is_given(input.scene, "--history")) throw BadInput("--history: shock writes none; clatter simulate does");
  return scene;
}

std::vector<Probe> probes_of(const ShockInput& input) {
  const std::vector<Probe> probes =
      input.probes.empty() ? read_probes(scene_values(input.scene.source)) : read_probes("--probe", input.probes);
  if (probes.empty())
    throw BadInput("--probe: required, a point of the body as NAME:X,Y,Z in m, or [[probe]] in the scene file");
  return probes;
}

double quality_of(const std::string& text) {
  if (text == "none") return std::numeric_limits<double>::infinity();
  return read_number_option("--quality", text, {0.5, 1e9, true, "greater than 0.5 and at most 1e9, or none: undamped"});
}

/// "LOW:HIGH:COUNT"
void read_frequencies(const std::string& text, ShockRequest& request) {
  constexpr Range allowed{1e-6, 1e9, false, "from 1e-6 to 1e9 Hz"};
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  if (parts.size() != 3 || text.back() == ':')
    throw BadInput(fmt::format("--frequencies {}: must be LOW:HIGH:COUNT, as in 10:10000:61", text));
  request.low = read_number_option("--frequencies", parts[0], allowed);
  request.high = read_number_option("--frequencies", parts[1], allowed);
  request.count = read_integer_option("--frequencies", parts[2], 2, 10'000);
  if (!(request.high > request.low))
    throw BadInput(fmt::format("--frequencies {}: HIGH must be greater than LOW", text));
}

ShockRequest request_of(const ShockInput& input) {
  ShockRequest request{.continuous = model_of(input) == Model::continuous, .sensitivity = !input.no_sensitivity};
  if (input.frequencies) read_frequencies(*input.frequencies, request);
  if (input.quality) request.quality = quality_of(*input.quality);
  if (input.first) request.first = read_integer_option("--first", *input.first, 1, 1'000'000);
  if (input.axis) request.axis = static_cast<int>(read_name_option("--axis", *input.axis, {"x", "y", "z"}));
  return request;
}

/// As that of simulate, or of sequence.
int status_of(const Scene& scene, const ShockRun& run) {
  const std::string why =
      run.continuous ? shortfall(scene, run.continuous->planned) : shortfall(scene, *run.discrete_run);
  if (why.empty()) return 0;
  say(why);
  return run.continuous ? exit_status(FailureKind::not_computed) : shortfall_status(*run.discrete_run);
}

int run_shock_command(const ShockInput& input) {
  const Scene scene = scene_of(input);
  const std::vector<Probe> probes = probes_of(input);
  const ShockRequest request = request_of(input);
  const bool spectrum = read_name_option("--rows", input.rows.value_or("impact"), {"impact", "spectrum"}) == 1;
  const OutputChoice choice = read_output(input.output);
  std::optional<double> severity;
  if (input.severity) severity = read_number_option("--severity", *input.severity, positive_number);
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  const ShockRun run =
      run_shock(scene, probes, request, {.progress = [&](int, long) { return !interrupt.requested(); }});
  write_report(choice, shock_report(run, spectrum, severity));
  if (interrupt.requested()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  const Picture picture = shock_picture(run, severity);
  if (picture.panels.empty()) plot.leave_out("no impact that can be predicted");
  else if (plot.is_wanted())
    plot.write(picture,
               run_words("shock", shock_summary, scene, request.continuous ? Model::continuous : Model::discrete));
  return status_of(scene, run);
}

}  // namespace

Command shock_command() {
  auto input = std::make_shared<ShockInput>();
  Command command{.name = "shock", .help = "what the impacts do to points of the body, and response spectra"};
  add_scene_flags(command, input->scene);
  command.add({.name = "--probe",
               .target = &input->probes,
               .type = "NAME:X,Y,Z",
               .help = "a point, body frame, from the geometric centre [m]; in place of the scene's [[probe]]",
               .group = "Shock",
               .repeats = true});
  command.add_text("--model", input->model, "discrete|continuous", "(continuous if the scene has a ground)", "Shock");
  command.add_text("--rows", input->rows, "impact|spectrum", "of table and CSV: impacts, or response spectra (impact)",
                   "Shock");
  command.add_text("--axis", input->axis, "x|y|z",
                   "of the body, for spectra (that with the largest change of velocity)", "Shock");
  command.add_text("--quality", input->quality, "Q", "of the oscillators, or none: undamped (10)", "Shock");
  command.add_text("--frequencies", input->frequencies, "LOW:HIGH:COUNT", "natural, in Hz (10:10000:61)", "Shock");
  command.add_text("--first", input->first, "N", "so many impacts are the first ones (2)", "Shock");
  command.add_text("--severity", input->severity, "M/S", "a pseudo-velocity to compare with", "Shock");
  command.add_flag("--no-sensitivity", input->no_sensitivity, "leave out the four runs that it takes", "Shock");
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095\n"
      "The change of velocity is what a fragile part inside feels of a blow that is short to it; the peak depends on "
      "the floor.\n"
      "Peaks are specific forces, what an accelerometer reads, of a rigid body: parts that bend are left out.";
  command.run = [input] { return run_shock_command(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
