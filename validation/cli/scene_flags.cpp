#include "validation/cli/scene_flags.hpp"

#include <fmt/format.h>

#include <iterator>

#include "validation/cli/options.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

struct Flag {
  const char *name, *key, *type, *help;
};

/// Flags and the keys of the scene file that they override.
constexpr Flag flags[] = {
    {"--angle", "drop.angle_deg", "DEG", "inclination at the first impact, end a low"},
    {"--tilt", "drop.tilt_deg", "DEG", "rotation about the body's long axis before that"},
    {"--speed", "drop.speed", "M/S", "downward, of the centre of mass at first touch"},
    {"--height", "drop.height", "M", "or its height at release from rest"},
    {"--tangential-velocity", "drop.tangential_velocity", "M/S", "of the centre of mass, to the right"},
    {"--spin", "drop.spin", "RAD/S", "clockwise, as Omega in Eq. 8"},
    {"--gravity", "world.gravity", "M/S2", "gravity"},
    {"--restitution", "impact.restitution", "E", "of the discrete model (kept, not used here)"},
    {"--restitution-law", "impact.law", "NAME", "of the discrete model (kept, not used here)"},
    {"--impulse-ratio", "impact.impulse_ratio", "MU_I", "of the discrete model (kept, not used here)"},
    {"--friction", "impact.friction", "MU", "of the discrete model (kept, not used here)"},
    {"--body", "body.shape", "rod|box|mesh", "shape of the body"},
    {"--mass", "body.mass", "KG", "mass"},
    {"--length", "body.length", "M", "of the rod"},
    {"--radius", "body.radius", "M", "of the rod"},
    {"--size", "body.size", "LxWxT", "of the box in m"},
    {"--stiffness", "ground.stiffness", "N/M3", "k_G"},
    {"--damping", "ground.damping", "N.S/M4", "c_G"},
    {"--static-friction", "ground.static_friction", "MU", "of the ground"},
    {"--sliding-friction", "ground.sliding_friction", "MU", "of the ground"},
    {"--area", "ground.area", "surface|projected", "area over which the load is integrated"},
    {"--impacts", "run.impacts", "N", "most impacts to report"},
    {"--digits", "run.digits", "N", "significant digits, 2 to 12"},
    {"--method", "run.method", "NAME", "auto, tvd-rk3, rk4, rkf45, rkck or rk8pd"},
    {"--tolerance", "run.tolerance", "TOL", "local error per step of an adaptive method"},
    {"--step", "run.step", "S", "of tvd-rk3"},
    {"--history", "run.history", "FILE", "time history as CSV"},
};

}  // namespace

void add_scene_argument(Command& command, std::string& file) {
  command.add({.name = "SCENE", .target = &file, .type = "FILE", .help = "scene file (TOML)", .required = true});
}

void add_scene_flags(Command& command, SceneFlags& given) {
  const char* const group = "Scene (each overrides its key in the file)";
  add_scene_argument(command, given.file);
  given.texts.resize(std::size(flags));
  for (std::size_t i = 0; i < std::size(flags); ++i) {
    command.add_text(flags[i].name, given.texts[i], flags[i].type, flags[i].help, group);
  }
  command.add_flag("--planar", given.planar, "keep the motion in its plane", group);
  command.add_flag("--require-digits", given.require_digits, "exit status 3 if fewer digits are known", group);
  command.add_flag("--no-contact-gravity", given.no_contact_gravity, "let gravity act in flight only", group);
}

SimulationScene read_scene_flags(const SceneFlags& given) {
  std::vector<SceneOverride> overrides;
  for (std::size_t i = 0; i < given.texts.size(); ++i) {
    if (given.texts[i]) overrides.push_back({flags[i].key, flags[i].name, *given.texts[i]});
  }
  SimulationScene scene = read_simulation_scene(given.file, overrides);
  if (given.planar) scene.options.planar = true;
  if (given.require_digits) scene.require_digits = true;
  if (given.no_contact_gravity) scene.options.gravity_in_contact = false;
  return scene;
}

bool is_given(const SceneFlags& given, const std::string& name) {
  for (std::size_t i = 0; i < given.texts.size(); ++i) {
    if (name == flags[i].name) return given.texts[i].has_value();
  }
  return false;
}

std::vector<RunFile> files_of(const SimulationScene& scene) {
  return {{"the scene file", scene.path}, {"the mesh file", scene.body.file}};
}

}  // namespace clatter::validation
