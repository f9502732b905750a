// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/shock_options.hpp"

#include <fmt/format.h>

#include <limits>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation {
namespace {

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

/// "HZ:G"
FragilePart part_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw BadInput(fmt::format("--part {}: must be HZ:G, natural frequency and fragility, as in 200:150", text));
  return {read_number_option("--part", text.substr(0, colon), {1e-6, 1e9, false, "from 1e-6 to 1e9 Hz"}),
          read_number_option("--part", text.substr(colon + 1), {1e-6, 1e9, false, "from 1e-6 to 1e9 g"}) *
              standard_gravity};
}

}  // namespace

Model model_of(const ShockInput& input) {
  if (input.model) {
    return read_name_option("--model", *input.model, {"discrete", "continuous"}) == 0 ? Model::discrete
                                                                                      : Model::continuous;
  }
  const bool has_ground =
      is_given(input.scene, "--stiffness") || scene_values(input.scene.source).has("ground.stiffness");
  return has_ground ? Model::continuous : Model::discrete;
}

Scene shock_scene(const ShockInput& input) {
  SceneFlags flags = input.scene;
  flags.model = model_of(input);
  const Scene scene = flags.model == Model::discrete ? read_discrete_flags(flags).scene : read_scene_flags(flags);
  if (scene.sweep)
    throw BadInput(fmt::format("{}: sweep: must be left out here, the scene sweeps nothing", scene.path));
  require_level(scene, "shock and report");
  if (is_given(input.scene, "--history")) throw BadInput("--history: none is written here; clatter simulate does");
  return scene;
}

std::vector<Probe> probes_of(const ShockInput& input) {
  return input.probes.empty() ? read_probes(scene_values(input.scene.source)) : read_probes("--probe", input.probes);
}

ShockRequest request_of(const ShockInput& input) {
  if (input.no_sensitivity && model_of(input) == Model::discrete)
    throw BadInput("--no-sensitivity: the discrete model has no peaks, whose sensitivity it leaves out");
  ShockRequest request{.continuous = model_of(input) == Model::continuous, .sensitivity = !input.no_sensitivity};
  if (input.frequencies) read_frequencies(*input.frequencies, request);
  if (input.quality) request.quality = quality_of(*input.quality);
  if (input.first) request.first = read_integer_option("--first", *input.first, 1, 1'000'000);
  if (input.axis) request.axis = static_cast<int>(read_name_option("--axis", *input.axis, {"x", "y", "z"}));
  return request;
}

ShockView view_of(const ShockInput& input) {
  ShockView view;
  view.rows = static_cast<ShockRows>(
      read_name_option("--rows", input.rows.value_or("impact"), {"impact", "spectrum", "pulse"}));
  if (input.severity) view.severity = read_number_option("--severity", *input.severity, positive_number);
  if (input.part) view.part = part_of(*input.part);
  if (input.rate) {
    if (input.rows) throw BadInput("--rate: the rows are the history's; leave out --rows");
    if (model_of(input) == Model::discrete)
      throw BadInput("--rate: needs forces, which the continuous model has: a scene with a ground");
    view.rate = read_number_option("--rate", *input.rate, {1e-3, 1e9, false, "from 0.001 to 1e9 Hz"});
  }
  if (view.rows == ShockRows::pulses && model_of(input) == Model::discrete)
    throw BadInput("--rows pulse: needs peaks, which the continuous model has: a scene with a ground");
  return view;
}

void add_shock_options(Command& command, ShockInput& input) {
  add_scene_flags(command, input.scene);
  command.add({.name = "--probe",
               .target = &input.probes,
               .type = "NAME:X,Y,Z",
               .help = "a point, body frame, from the geometric centre [m]; in place of the scene's [[probe]]",
               .group = "Shock",
               .repeats = true});
  command.add_text("--model", input.model, "discrete|continuous", "(continuous if the scene has a ground)", "Shock");
  command.add_text("--axis", input.axis, "x|y|z", "of the body, for spectra (that with the largest change of velocity)",
                   "Shock");
  command.add_text("--quality", input.quality, "Q", "of the oscillators, or none: undamped (10)", "Shock");
  command.add_text("--frequencies", input.frequencies, "LOW:HIGH:COUNT", "natural, in Hz (10:10000:61)", "Shock");
  command.add_text("--first", input.first, "N", "so many impacts are the first ones (2)", "Shock");
  command.add_text("--severity", input.severity, "M/S", "a pseudo-velocity to compare with", "Shock");
  command.add_text("--part", input.part, "HZ:G",
                   "natural frequency and fragility of a part: its damage boundary, ASTM D3332", "Shock");
  command.add_flag("--no-sensitivity", input.no_sensitivity, "leave out the four runs that it takes", "Shock");
}

int status_of(const Scene& scene, const ShockRun& run) {
  const std::string why =
      run.continuous ? shortfall(scene, run.continuous->planned) : shortfall(scene, *run.discrete_run);
  if (why.empty()) return 0;
  say(why);
  return run.continuous ? exit_status(FailureKind::not_computed) : shortfall_status(*run.discrete_run);
}

}  // namespace clatter::validation
