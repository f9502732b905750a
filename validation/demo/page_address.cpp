#include "validation/demo/page_address.hpp"

#include "analytic/restitution_map.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

void require_shown(bool shown, const char* key, const char* why) {
  if (!shown) throw BadInput(std::string("demo: ") + key + ": " + why);
}

void require_shown(const Scene& scene) {
  require_shown(scene.body.shape != BodyScene::Shape::mesh, "body.shape", "the page shows rods and boxes");
  require_shown(!scene.sweep, "sweep", "the page shows one drop");
  require_shown(scene.tilt_deg == 0, "drop.tilt_deg", "the page shows drops in the plane");
  require_shown(scene.tangential_velocity == 0, "drop.tangential_velocity", "the page has no control for it");
  require_shown(scene.spin == 0, "drop.spin", "the page has no control for it");
  require_shown(!scene.world.ground.has_friction() || scene.world.ground.friction == numeric::FrictionLaw::coulomb,
                "ground.friction_law", "the page has Coulomb's law alone");
}

/// Coefficient of restitution of the discrete model: by the ground's damping where there is a ground.
double restitution(const Scene& scene) {
  if (!(scene.world.ground.stiffness > 0)) return scene.impact.restitution;
  return analytic::restitution_of_damping(scene.world.ground.damping / scene.world.ground.stiffness * scene.speed);
}

}  // namespace

std::string page_query(const Scene& scene) {
  require_shown(scene);
  std::string query;
  const auto add = [&](const char* name, const std::string& value) {
    query += (query.empty() ? "?" : "&") + std::string(name) + "=" + value;
  };
  const BodyScene& body = scene.body;
  const bool rod = body.shape == BodyScene::Shape::rod;
  add("body", rod ? "own-rod" : "own-box");
  add("mass", shortest(body.mass));
  add("length", shortest(rod ? body.length : body.size.x()));
  if (rod) add("radius", shortest(body.radius));
  else add("width", shortest(body.size.y())), add("thickness", shortest(body.size.z()));
  add("angle", shortest(scene.angle_deg));
  if (scene.height) add("height", shortest(*scene.height));
  else add("speed", shortest(scene.speed));
  add("gravity", shortest(scene.world.gravity));
  add("e", shortest(restitution(scene)));
  const bool has_ground = scene.world.ground.stiffness > 0;
  add("friction", shortest(has_ground ? scene.world.ground.sliding_friction : scene.impact.friction.value_or(0)));
  if (has_ground)
    add("stiffness", shortest(scene.world.ground.stiffness)), add("damping", shortest(scene.world.ground.damping));
  add("impacts", std::to_string(scene.request.impacts));
  if (has_ground && !scene.world.planar) add("planar", "0");
  return query;
}

}  // namespace clatter::validation
