// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_options.hpp"

#include <fmt/format.h>

#include <limits>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

double read_quality(const std::string& option, const std::string& text) {
  if (text == "none") return std::numeric_limits<double>::infinity();
  return read_number_option(option, text, {0.5, 1e9, true, "greater than 0.5 and at most 1e9, or none: undamped"});
}

/// "LOW:HIGH:COUNT"
void read_frequencies(const std::string& option, const std::string& text, ShockRequest& request) {
  constexpr Range allowed{1e-6, 1e9, false, "from 1e-6 to 1e9 Hz"};
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  if (parts.size() != 3 || text.back() == ':')
    throw BadInput(fmt::format("{} {}: must be LOW:HIGH:COUNT, as in 10:10000:61", option, text));
  request.low = read_number_option(option, parts[0], allowed);
  request.high = read_number_option(option, parts[1], allowed);
  request.count = read_integer_option(option, parts[2], 2, 10'000);
  if (!(request.high > request.low)) throw BadInput(fmt::format("{} {}: HIGH must be greater than LOW", option, text));
}

/// "HZ:G"
std::array<double, 2> read_part(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw BadInput(fmt::format("{} {}: must be HZ:G, natural frequency and fragility, as in 200:150", option, text));
  return {read_number_option(option, text.substr(0, colon), {1e-6, 1e9, false, "from 1e-6 to 1e9 Hz"}),
          read_number_option(option, text.substr(colon + 1), {1e-6, 1e9, false, "from 1e-6 to 1e9 g"})};
}

}  // namespace

Model model_of(const ShockInput& input) {
  if (input.model) return *input.model;
  return names_ground(input.scene) ? Model::continuous : Model::discrete;
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
  ShockRequest request = input.request;
  request.continuous = model_of(input) == Model::continuous;
  request.sensitivity = !input.no_sensitivity;
  return request;
}

ShockView shown_of(const ShockInput& input) {
  ShockView view = input.view;
  view.rows = input.rows.value_or(view.rows);
  if (input.part) view.part = FragilePart{(*input.part)[0], (*input.part)[1] * standard_gravity};
  return view;
}

ShockView view_of(const ShockInput& input) {
  const ShockView view = shown_of(input);
  if (view.rate) {
    if (input.rows) throw BadInput("--rate: the rows are the history's; leave out --rows");
    if (model_of(input) == Model::discrete)
      throw BadInput("--rate: needs forces, which the continuous model has: a scene with a ground");
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
  ShockRequest& request = input.request;
  command.add(choice_argument("--model", input.model, model_names, "(continuous if the scene has a ground)", "Shock"));
  command.add(choice_argument("--axis", request.axis, {"x", "y", "z"},
                              "of the body, for spectra (that with the largest change of velocity)", "Shock"));
  command.add(read_argument("--quality", request.quality, read_quality, "Q",
                            "of the oscillators, or none: undamped (10)", "Shock"));
  command.add({.name = "--frequencies",
               .target = [&request](const auto& name, const auto& text) { read_frequencies(name, text, request); },
               .type = "LOW:HIGH:COUNT",
               .help = "natural, in Hz (10:10000:61)",
               .group = "Shock"});
  command.add(
      whole_argument("--first", request.first, 1, 1'000'000, "N", "so many impacts are the first ones (2)", "Shock"));
  command.add(number_argument("--severity", input.view.severity, positive_number, "M/S",
                              "a pseudo-velocity to compare with", "Shock"));
  command.add(read_argument("--part", input.part, read_part, "HZ:G",
                            "natural frequency and fragility of a part: its damage boundary, ASTM D3332", "Shock"));
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
