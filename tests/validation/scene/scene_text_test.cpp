// SPDX-License-Identifier: GPL-3.0-or-later
// The keys that a scene has to say so that others read the same scene again.
#include "validation/scene/keys.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string_view>

namespace {

using clatter::validation::Key;
using clatter::validation::said_keys;
using clatter::validation::Scene;

bool says(const Scene& scene, std::string_view name) {
  const auto keys = said_keys(scene);
  return std::any_of(keys.begin(), keys.end(), [&](const Key* key) { return key->name == name; });
}

}  // namespace

/// Left out, each of these would be what a file's other keys make it.
BOOST_AUTO_TEST_CASE(body_gravity_and_restitution_are_said_whatever_their_values) {
  Scene scene;
  scene.world.gravity = 0;
  scene.height = 0.5;
  scene.impact.restitution = 1;
  for (const char* name : {"body.shape", "body.mass", "body.length", "world.gravity", "impact.restitution"}) {
    BOOST_TEST(says(scene, name), name);
  }
}

BOOST_AUTO_TEST_CASE(other_keys_are_said_where_flags_alone_would_not_give_their_values) {
  Scene scene;
  BOOST_TEST(!says(scene, "drop.spin"));
  scene.spin = 2;
  BOOST_TEST(says(scene, "drop.spin"));
}

/// Who opens a scene of someone else's must not write over a file for it.
BOOST_AUTO_TEST_CASE(names_of_files_are_not_said) {
  Scene scene;
  scene.history = "history.csv";
  BOOST_TEST(!says(scene, "run.history"));
}
