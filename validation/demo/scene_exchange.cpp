// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/scene_exchange.hpp"

#include "validation/output/bad_input.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {

void require_shown(const Scene& scene) {
  if (scene.body.shape == BodyScene::Shape::mesh)
    throw BadInput("body.shape 'mesh': must be rod or box; a page can name no file");
  if (scene.body.shape != BodyScene::Shape::rod && scene.body.shape != BodyScene::Shape::box)
    throw BadInput("body.shape: must be rod or box; the page draws no other shape");
  if (scene.sweep) throw BadInput("sweep: must be left out; the page shows one drop, and this scene sweeps a quantity");
}

Value::Fields scene_arguments(const Scene& scene) {
  require_shown(scene);
  Value::Fields arguments;
  for (const Key* key : said_keys(scene)) arguments.push_back({key->argument(), key->get(scene)});
  return arguments;
}

}  // namespace clatter::validation
