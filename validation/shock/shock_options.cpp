// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <memory>
#include <sstream>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/text_rows.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

double read_quality(const std::string& option, const std::string& text) {
  if (text == "none") return std::numeric_limits<double>::infinity();
  return read_number_option(option, text, {0.5, 1e9, true, "greater than 0.5 and at most 1e9, or none: undamped"});
}

/// "LOW:HIGH:COUNT", or one frequency.
void read_frequencies(const std::string& option, const std::string& text, ShockRequest& request) {
  constexpr Range allowed{1e-6, 1e9, false, "from 1e-6 to 1e9 Hz"};
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  if (parts.size() == 1) parts = {parts[0], parts[0], "1"};
  if (parts.size() != 3 || text.back() == ':')
    throw BadInput(fmt::format("{} {}: must be LOW:HIGH:COUNT, as in 10:10000:61, or one frequency", option, text));
  request.low = read_number_option(option, parts[0], allowed);
  request.high = read_number_option(option, parts[1], allowed);
  request.count = read_integer_option(option, parts[2], 1, 10'000);
  if (request.count == 1 ? request.high != request.low : !(request.high > request.low))
    throw BadInput(
        fmt::format("{} {}: HIGH must be {} LOW", option, text, request.count == 1 ? "equal to" : "greater than"));
}

/// A number and the unit behind it: "500", "0.5 kHz".
struct Measured {
  std::string number, unit;
};
Measured parted(std::string text) {
  std::erase(text, ' ');
  // An exponent's e stands before digits, a unit's letters before none.
  std::size_t end = text.size();
  while (end > 0 && std::isalpha(static_cast<unsigned char>(text[end - 1]))) --end;
  std::string unit = text.substr(end);
  std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return std::tolower(c); });
  return {text.substr(0, end), unit};
}

constexpr const char* part_forms =
    "must be HZ:G, natural frequency and fragility, as 500:300 or 500Hz:300g; or HZ alone, as 400Hz, which has no "
    "limit; or G alone, the peak that it bears at its place, as 300g; or a half sine that it bore, with its units, as "
    "40g:11ms; each behind the name of a probe or not, "
    "as camera:500:300";

}  // namespace

LowPass read_low_pass(const std::string& option, const std::string& text) {
  constexpr Range allowed{1e-3, 1e9, false, "a class of SAE J211-1, as CFC1000, or a cut-off from 0.001 to 1e9 Hz"};
  auto [number, unit] = parted(text);
  const bool is_class = lower(number).starts_with("cfc");
  if (is_class) number.erase(0, 3);
  if (!(unit.empty() || (!is_class && (unit == "hz" || unit == "khz"))))
    throw BadInput(fmt::format("{} '{}': must be {}", option, text, allowed.words));
  const double value = read_number_option(option, number, allowed);
  return is_class ? LowPass::of_class(value) : LowPass::of_cut_off(value * (unit == "khz" ? 1e3 : 1));
}

FragilePart read_part(const std::string& option, const std::string& text) {
  if (const std::size_t end = text.find(':'); end != std::string::npos) {
    // A frequency or a peak begins with a number, which no probe's name that is taken for one is.
    const std::string name = text.substr(0, end);
    if (double number = 0; is_probe_name(name) && !read_number(parted(name).number, number)) {
      FragilePart part = read_part(option, text.substr(end + 1));
      part.probe = name;
      return part;
    }
  }
  const auto number = [&](const Measured& given) {
    return read_number_option(option, given.number, {1e-6, 1e9, false, "from 1e-6 to 1e9"});
  };
  const auto is_one_of = [](const std::string& unit, std::initializer_list<const char*> units) {
    return std::ranges::any_of(units, [&](const char* one) { return unit == one; });
  };
  const std::size_t colon = text.find(':');
  const Measured first = parted(text.substr(0, colon)),
                 second = colon == std::string::npos ? Measured{} : parted(text.substr(colon + 1));
  if (colon == std::string::npos && is_one_of(first.unit, {"", "g"}))
    return {.fragility = number(first) * standard_gravity, .kind = FragilePart::Kind::at_place};
  if (colon == std::string::npos && is_one_of(first.unit, {"hz", "khz"}))
    return {.frequency = number(first) * (first.unit == "khz" ? 1e3 : 1),
            .fragility = standard_gravity,
            .kind = FragilePart::Kind::unlimited};
  if (colon != std::string::npos && first.unit == "g" && is_one_of(second.unit, {"ms", "s", "us"})) {
    const double unit = second.unit == "ms" ? 1e-3 : second.unit == "us" ? 1e-6 : 1;
    return {.fragility = number(first) * standard_gravity,
            .duration = number(second) * unit,
            .kind = FragilePart::Kind::tested};
  }
  if (colon != std::string::npos && is_one_of(first.unit, {"", "hz", "khz"}) && is_one_of(second.unit, {"", "g"})) {
    return {.frequency = number(first) * (first.unit == "khz" ? 1e3 : 1),
            .fragility = number(second) * standard_gravity};
  }
  throw BadInput(fmt::format("{} {}: {}", option, text, part_forms));
}

Argument part_argument(Argument::Reader read, const std::string& help, const std::string& group) {
  return {.name = "--part",
          .target = std::move(read),
          .type = "[PROBE:]HZ:G|HZ|G|G:MS",
          .help =
              "what the part at the probe (camera:500:300, one; 500:300, any) bears: natural frequency and fragility "
              "(500:300, 500Hz:300g), the first alone (400Hz: ranked by its response), its place's peak alone (300g), "
              "or a half sine that it bore (40g:11ms): " +
              help,
          .group = group};
}

Model model_of(const ShockInput& input) {
  if (input.model) return *input.model;
  return names_ground(input.scene) ? Model::continuous : Model::discrete;
}

Scene shock_scene(const ShockInput& input) {
  SceneFlags flags = input.scene;
  flags.model = model_of(input);
  const Scene scene = flags.model == Model::discrete ? read_discrete_flags(flags).scene : read_scene_flags(flags);
  if (flags.model == Model::continuous) warn_of_law(flags, scene);
  if (scene.sweep)
    throw BadInput(fmt::format("{}: sweep: must be left out here, the scene sweeps nothing", scene.path));
  require_level(scene, "shock and report");
  if (is_given(input.scene, "--history")) throw BadInput("--history: none is written here; clatter simulate does");
  return scene;
}

std::vector<Probe> probes_of(const ShockInput& input) {
  return read_probes("--probe", input.probes, read_probes(scene_values(input.scene.source)));
}

std::vector<FragilePart> parts_of(const std::vector<FragilePart>& given, const std::vector<Probe>& probes) {
  std::vector<FragilePart> parts = given;
  for (const FragilePart& part : given) {
    if (!part.probe.empty()) static_cast<void>(probe_named(probes, part.probe, "--part " + part_text(part)));
  }
  if (!parts.empty()) return parts;
  for (const Probe& probe : probes) {
    if (probe.part.empty()) continue;
    parts.push_back(read_part(probe.part_at + " =", probe.part));
    if (parts.back().probe.empty()) parts.back().probe = probe.name;
    if (!parts.back().is_at(probe.name))
      throw BadInput(
          fmt::format("{} = '{}': is at {}, not at {}", probe.part_at, probe.part, parts.back().probe, probe.name));
  }
  return parts;
}

ShockRequest request_of(const ShockInput& input) {
  if (input.no_sensitivity && model_of(input) == Model::discrete)
    throw BadInput("--no-sensitivity: the discrete model has no peaks, whose sensitivity it leaves out");
  ShockRequest request = input.request;
  request.continuous = model_of(input) == Model::continuous;
  request.sensitivity = !input.no_sensitivity && !request.filter;
  if (request.filter && !request.continuous)
    throw BadInput("--filter: needs a history, which the continuous model has: a scene with a ground");
  request.parts = parts_of(input.parts, probes_of(input));
  return request;
}

ShockView shown_of(const ShockInput& input) {
  ShockView view = input.view;
  view.rows = input.rows.value_or(view.rows);
  view.parts = parts_of(input.parts, probes_of(input));
  return view;
}

ShockView view_of(const ShockInput& input) {
  const ShockView view = shown_of(input);
  if (view.rate) {
    if (input.rows) throw BadInput("--rate: the rows are the history's; leave out --rows");
    if (model_of(input) == Model::discrete)
      throw BadInput("--rate: needs forces, which the continuous model has: a scene with a ground");
  }
  const auto is_at_place = [](const FragilePart& part) { return part.kind == FragilePart::Kind::at_place; };
  if (std::ranges::any_of(view.parts, is_at_place) && model_of(input) == Model::discrete)
    throw BadInput("--part G: needs peaks, which the continuous model has: a scene with a ground");
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
               .type = "LOW:HIGH:COUNT|HZ",
               .help = "natural, in Hz, or one (10:10000:61)",
               .group = "Shock"});
  command.add(
      whole_argument("--first", request.first, 1, 1'000'000, "N", "so many impacts are the first ones (2)", "Shock"));
  command.add(number_argument("--severity", input.view.severity, positive_number, "M/S",
                              "a pseudo-velocity to compare with", "Shock"));
  command.add(part_argument(
      [&](const std::string& option, const std::string& text) {
        const FragilePart part = read_part(option, text);
        for (const FragilePart& other : input.parts) {
          if (part_text(other) == part_text(part)) throw BadInput(fmt::format("{} {}: given twice", option, text));
        }
        input.parts.push_back(part);
      },
      "its damage boundary, ASTM D3332; again for more of them", "Shock"));
  command.arguments.back().repeats = true;
  command.add_flag("--no-sensitivity", input.no_sensitivity, "leave out the four runs that it takes", "Shock");
}

int status_of(const Scene& scene, const ShockRun& run) {
  const std::string why =
      run.continuous ? shortfall(scene, run.continuous->planned) : shortfall(scene, *run.discrete_run);
  if (why.empty()) return 0;
  say(why);
  return run.continuous ? exit_status(FailureKind::not_computed) : shortfall_status(*run.discrete_run);
}

std::function<bool(int, long)> watched(const CooperativeInterrupt& interrupt, const std::string& drop,
                                       const Scene& scene) {
  const auto impacts = static_cast<std::size_t>(scene.request.impacts);
  return [&interrupt, drop, impacts, progress = std::make_shared<Progress>()](int done, long evaluations) {
    constexpr long of_a_second = 100'000;
    if (evaluations >= of_a_second)
      progress->show(fmt::format("{}: {} force evaluations, {}", drop, evaluations,
                                 progress_bar(static_cast<std::size_t>(done), impacts)));
    return !interrupt.requested();
  };
}

}  // namespace clatter::validation
