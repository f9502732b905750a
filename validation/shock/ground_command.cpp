// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/failure.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/ground_report.hpp"

namespace clatter::validation {
namespace {

struct GroundInput {
  SceneFlags scene;
  std::array<std::optional<double>, measure_count> measured;  ///< in the order of DropMeasure
  std::optional<double> modulus, poisson, thickness, footprint;
  std::optional<std::size_t> floor;  ///< of floors()
  OutputChoice output;
};

std::vector<MeasuredNumber> measured_of(const GroundInput& input) {
  std::vector<MeasuredNumber> measured;
  for (std::size_t i = 0; i < measure_count; ++i) {
    if (input.measured[i]) measured.push_back({static_cast<DropMeasure>(i), *input.measured[i]});
  }
  return measured;
}

/// The material that was given or named: one, or the ends of its range.
std::vector<MaterialGround> materials_of(const GroundInput& input) {
  if (input.floor) {
    if (input.modulus || input.poisson) throw BadInput("--floor: excludes --modulus and --poisson; it has its own");
    const Floor& floor = floors()[*input.floor];
    return {{floor.least_modulus, floor.least_poisson, 0}, {floor.largest_modulus, floor.largest_poisson, 0}};
  }
  if (!input.modulus) throw BadInput("--modulus: required with --poisson, --thickness and --footprint, or --floor");
  if (!input.poisson) throw BadInput("--poisson: required with --modulus");
  constexpr double of_layer = 0.4999;
  if (input.thickness && !(*input.poisson <= of_layer))
    throw BadInput(fmt::format("--poisson '{}': must be from 0 to {}", shortest(*input.poisson), of_layer));
  return {{*input.modulus, *input.poisson, 0}};
}

/// The restitution beside a material, of the scene's drop; none: none was given.
std::optional<MaterialLoss> loss_of(const GroundInput& input, const std::vector<MeasuredNumber>& measured) {
  if (measured.empty()) return {};
  if (measured.size() > 1 || measured.front().measure != DropMeasure::restitution)
    throw BadInput("--contact-time and the like: exclude a material, beside which --measured-e alone may stand");
  return MaterialLoss{measured.front().value, first_approach_speed(read_discrete_flags(input.scene).drop)};
}

Report material_report_of(const GroundInput& input, const std::optional<MaterialLoss>& loss) {
  std::vector<MaterialGround> grounds = materials_of(input);
  if (input.thickness.has_value() == input.footprint.has_value()) {
    throw BadInput(fmt::format("{}: takes --thickness H of a layer, or --footprint A on a half-space; give one of them",
                               input.floor ? "--floor" : "--modulus"));
  }
  const double size = input.thickness ? *input.thickness : *input.footprint;
  for (MaterialGround& ground : grounds) {
    ground.stiffness = input.thickness ? layer_stiffness(ground.modulus, ground.poisson, size)
                                       : half_space_stiffness(ground.modulus, ground.poisson, size);
  }
  const std::string source = input.floor ? floors()[*input.floor].source : "";
  return material_report(grounds,
                         input.thickness
                             ? "a confined layer, E (1 - ν)/((1 + ν)(1 - 2 ν) h): wide beside its thickness, bonded to "
                               "a rigid base, unable to bulge"
                             : "a half-space under a rigid flat footprint, as under a disc of its area, 2 E/((1 - ν²) "
                               "π a): the pressure of a real one is least in the middle and grows towards the rim",
                         source, loss);
}

/// The scene takes any stiffness: that is sought.
Scene scene_of(const GroundInput& input) {
  SceneFlags flags = input.scene;
  for (const char* const flag : {"--stiffness", "--damping"}) {
    if (is_given(flags, flag)) throw BadInput(fmt::format("{}: must be left out: it is what is sought", flag));
  }
  flags.texts.at("--stiffness") = "1e9";
  Scene scene = read_scene_flags(flags);
  require_level(scene, "ground");
  scene.world.ground.damping = 0;
  if (scene.sweep) throw BadInput(fmt::format("{}: sweep: ground takes a scene that sweeps nothing", scene.path));
  return scene;
}

int run_ground(const GroundInput& input) {
  const OutputChoice& choice = input.output;
  const std::vector<MeasuredNumber> measured = measured_of(input);
  if (input.modulus || input.poisson || input.floor || input.thickness || input.footprint) {
    const Report report = material_report_of(input, loss_of(input, measured));
    check_files(choice);
    write_report(choice, report);
    return 0;
  }
  if (measured.size() != 2) {
    throw BadInput(
        fmt::format("two of --measured-e, --contact-time, --peak-force and --indentation must be given, not "
                    "{}; or --modulus of a material, or --floor",
                    measured.size()));
  }
  const Scene scene = scene_of(input);
  check_files(choice);
  const numeric::Body body = scene.make_body();
  // Where the scene has no gravity the body is weighed elsewhere.
  const double gravity = scene.world.gravity > 0 ? scene.world.gravity : standard_gravity;
  const MeasuredDrop drop{&body, scene.world, scene.start(body), body.mass() * gravity};
  const GroundFit fit = fit_ground(drop, measured[0], measured[1]);
  write_report(choice, ground_report(scene, measured[0], measured[1], fit));
  if (!fit.solutions.empty()) return 0;
  say("no ground gives both numbers");
  return exit_status(FailureKind::not_computed);
}

}  // namespace

Command ground_command() {
  auto input = std::make_shared<GroundInput>();
  const char *const measured = "Measured: two of them", *const material =
                                                            "Or the material, --measured-e beside it or not";
  Command command;
  add_scene_flags(command, input->scene);
  auto& [restitution, time, force, indentation] = input->measured;
  std::vector<std::string> names;
  for (const Floor& floor : floors()) names.emplace_back(floor.name);
  command.add(
      {number_argument("--measured-e", restitution, {0, 1, true, "greater than 0 and at most 1"}, "E",
                       "restitution of the drop's first impact", measured),
       number_argument("--contact-time", time, positive_number, "S", "how long that lasts", measured),
       number_argument("--peak-force", force, positive_number, "N", "its largest normal force", measured),
       number_argument("--indentation", indentation, positive_number, "M", "of the ground under the body at rest",
                       measured),
       number_argument("--modulus", input->modulus, positive_number, "PA", "Young's modulus of the ground", material),
       number_argument("--poisson", input->poisson, {0, 0.5, false, "from 0 to 0.5"}, "NU", "its Poisson's ratio",
                       material),
       choice_argument("--floor", input->floor, names, "its material by name: published numbers, least and largest",
                       material),
       number_argument("--thickness", input->thickness, positive_number, "M", "of a layer on a rigid base", material),
       number_argument("--footprint", input->footprint, positive_number, "M2", "area on a half-space", material)});
  add_output_options(command, input->output);
  command.footer =
      "Example: clatter ground --body box --size 0.1057x0.0439x0.0191 --mass 0.088 --angle 0 --measured-e 0.5 "
      "--contact-time 5e-4\n"
      "The drop is the scene's: flat, or on one corner, with the speed that was measured.\n"
      "Exit status 3 if no ground gives both numbers.";
  command.run = [input] { return run_ground(*input); };
  return command;
}

}  // namespace clatter::validation
