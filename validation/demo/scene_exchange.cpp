// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/scene_exchange.hpp"

#include <fmt/format.h>

#include "validation/output/bad_input.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {

void require_shown(const Scene& scene) {
  if (scene.body.shape == BodyScene::Shape::mesh)
    throw BadInput("body.shape 'mesh': must be rod or box; a page can name no file");
  if (scene.body.shape != BodyScene::Shape::rod && scene.body.shape != BodyScene::Shape::box)
    throw BadInput("body.shape: must be rod or box; the page draws no other shape");
  if (scene.sweep) throw BadInput("sweep: must be left out; the page shows one drop, and this scene sweeps a quantity");
  const auto leave_out = [](bool is_given, const char* key, const char* reason) {
    if (is_given) throw BadInput(fmt::format("{}: must be left out; {}", key, reason));
  };
  const char* const first_touch =
      "the page begins with a fall to the first touch: give attitude, velocity and spin there";
  leave_out(scene.topple.has_value(), "drop.topple", first_touch);
  leave_out(scene.is_released(), scene.release.height ? "drop.release.height" : "drop.release.clearance", first_touch);
  leave_out(scene.request.starts_on_ground, "drop.start", "the page shows a body that falls");
  leave_out(scene.world.incline_deg != 0, "world.incline_deg", "the page draws a level ground");
}

Value::Fields scene_arguments(const Scene& scene) {
  require_shown(scene);
  Value::Fields arguments;
  for (const Key* key : said_keys(scene)) arguments.push_back({key->argument(), key->get(scene)});
  return arguments;
}

}  // namespace clatter::validation
