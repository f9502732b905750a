#include "validation/scene/number_keys.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace clatter::validation {
namespace {

using Scene = SimulationScene;

constexpr NumberKey keys[] = {
    {"drop.angle_deg", false, [](Scene& scene, double value) { scene.angle_deg = value; }},
    {"drop.tilt_deg", false, [](Scene& scene, double value) { scene.tilt_deg = value; }},
    {"drop.speed", false, [](Scene& scene, double value) { scene.speed = value; }},
    {"drop.height", false, [](Scene& scene, double value) { scene.height = value; }},
    {"drop.tangential_velocity", false, [](Scene& scene, double value) { scene.tangential_velocity = value; }},
    {"drop.spin", false, [](Scene& scene, double value) { scene.spin = value; }},
    {"world.gravity", false, [](Scene& scene, double value) { scene.options.gravity = value; }},
    {"impact.restitution", false, [](Scene& scene, double value) { scene.impact.restitution = value; }},
    {"impact.impulse_ratio", false, [](Scene& scene, double value) { scene.impact.impulse_ratio = value; }},
    {"impact.friction", false, [](Scene& scene, double value) { scene.impact.friction = value; }},
    {"body.mass", false, [](Scene& scene, double value) { scene.body.mass = value; }},
    {"body.length", false, [](Scene& scene, double value) { scene.body.length = value; }},
    {"body.radius", false, [](Scene& scene, double value) { scene.body.radius = value; }},
    {"body.size.length", false, [](Scene& scene, double value) { scene.body.size.x() = value; }},
    {"body.size.width", false, [](Scene& scene, double value) { scene.body.size.y() = value; }},
    {"body.size.thickness", false, [](Scene& scene, double value) { scene.body.size.z() = value; }},
    {"body.mesh.sectors", true, [](Scene& scene, double value) { scene.body.sectors = static_cast<int>(value); }},
    {"body.mesh.rings", true, [](Scene& scene, double value) { scene.body.rings = static_cast<int>(value); }},
    {"body.mesh.layers", true, [](Scene& scene, double value) { scene.body.layers = static_cast<int>(value); }},
    {"body.mesh.nx", true, [](Scene& scene, double value) { scene.body.nx = static_cast<int>(value); }},
    {"body.mesh.ny", true, [](Scene& scene, double value) { scene.body.ny = static_cast<int>(value); }},
    {"body.mesh.nz", true, [](Scene& scene, double value) { scene.body.nz = static_cast<int>(value); }},
    {"body.mesh.unit", false, [](Scene& scene, double value) { scene.body.unit = value; }},
    {"body.mesh.density", false, [](Scene& scene, double value) { scene.body.density = value; }},
    {"ground.stiffness", false, [](Scene& scene, double value) { scene.ground.stiffness = value; }},
    {"ground.damping", false, [](Scene& scene, double value) { scene.ground.damping = value; }},
    {"ground.static_friction", false, [](Scene& scene, double value) { scene.ground.static_friction = value; }},
    {"ground.sliding_friction", false, [](Scene& scene, double value) { scene.ground.sliding_friction = value; }},
    {"ground.regularisation_speed", false,
     [](Scene& scene, double value) { scene.ground.regularisation_speed = value; }},
    {"run.impacts", true, [](Scene& scene, double value) { scene.options.impacts = static_cast<int>(value); }},
    {"run.digits", true, [](Scene& scene, double value) { scene.options.digits = static_cast<int>(value); }},
    {"run.tolerance", false, [](Scene& scene, double value) { scene.options.tolerance = value; }},
    {"run.step", false, [](Scene& scene, double value) { scene.options.step = value; }},
    {"run.evaluation_limit", true,
     [](Scene& scene, double value) { scene.options.evaluation_limit = static_cast<long>(value); }},
};

}  // namespace

bool NumberKey::is_of_body() const { return std::string_view(name).starts_with("body."); }

const NumberKey* find_number_key(const std::string& name) {
  const auto found =
      std::find_if(std::begin(keys), std::end(keys), [&](const NumberKey& key) { return key.name == name; });
  return found == std::end(keys) ? nullptr : found;
}

}  // namespace clatter::validation
