// The drops of tests/analytic/reference/space_scenes.csv with the impacts of space_sequences.csv.
#pragma once

#include <string>
#include <vector>

#include "analytic/space/sequence.hpp"
#include "analytic/space/shapes.hpp"
#include "tests/analytic/space/reference_impact.hpp"

namespace clatter::oracle {

struct ReferenceRowOfScene {
  double time = 0, approach = 0, energy_before = 0, energy_after = 0;
  int corner = 0;
  analytic::space::Quaternion attitude;
  analytic::space::Vector3 impulse, velocity, angular_velocity;
  std::string path;
  bool is_ambiguous = false;
};

struct ReferenceScene {
  std::string name, end;
  analytic::space::Drop drop;
  double tolerance = 0, end_acceleration = 0;
  std::vector<ReferenceRowOfScene> impacts;
};

inline analytic::space::Quaternion quaternion(const ReferenceFields& f) {
  return {f.number("q0"), f.number("q1"), f.number("q2"), f.number("q3")};
}

inline std::vector<ReferenceScene> reference_scenes(const std::string& directory) {
  using namespace analytic;
  std::vector<ReferenceScene> scenes;
  for (const ReferenceRow& row : read_reference_table(directory + "/space_scenes.csv")) {
    const ReferenceFields f(row);
    ReferenceScene& scene = scenes.emplace_back();
    scene.name = f.text("scene");
    scene.end = f.text("end");
    scene.end_acceleration = f.number("end_acceleration");
    scene.tolerance = f.number("tolerance");
    space::Drop& drop = scene.drop;
    drop.body = space::box(f.number("mass"), {.size = f.vector("L"), .centre = f.vector("c")});
    drop.body.inertia = f.symmetric("I");
    drop.attitude = quaternion(f);
    drop.velocity = f.vector("V");
    drop.angular_velocity = f.vector("O");
    drop.gravity = f.number("gravity");
    drop.law.law.restitution = f.number("restitution");
    drop.law.law.law = law_named(f.text("law"));
    drop.law.law.friction_value = f.number("friction");
    drop.law.law.friction = drop.law.law.friction_value > 0 ? FrictionKind::coulomb : FrictionKind::none;
  }
  for (const ReferenceRow& row : read_reference_table(directory + "/space_sequences.csv")) {
    const ReferenceFields f(row);
    for (ReferenceScene& scene : scenes) {
      if (scene.name != f.text("scene")) continue;
      scene.impacts.push_back({.time = f.number("time"),
                               .approach = f.number("approach"),
                               .energy_before = f.number("energy_before"),
                               .energy_after = f.number("energy_after"),
                               .corner = static_cast<int>(f.number("corner")),
                               .attitude = quaternion(f),
                               .impulse = f.vector("P"),
                               .velocity = f.vector("V"),
                               .angular_velocity = f.vector("O"),
                               .path = f.text("path"),
                               .is_ambiguous = f.text("ambiguous") == "1"});
    }
  }
  return scenes;
}

}  // namespace clatter::oracle
