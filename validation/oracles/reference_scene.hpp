// SPDX-License-Identifier: GPL-3.0-or-later
// The drops of validation/oracles/reference/space_scenes.csv with the impacts of space_sequences.csv.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "analytic/space/flight/body.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "validation/oracles/reference_table.hpp"

namespace clatter::oracle {

/// Cells of a row as what they mean.
class ReferenceFields {
 public:
  explicit ReferenceFields(const ReferenceRow& row) : row_(row) {}
  [[nodiscard]] const std::string& text(const std::string& name) const { return row_.at(name); }
  [[nodiscard]] double number(const std::string& name) const {
    return row_.contains(name) ? std::stod(row_.at(name)) : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] analytic::space::Vector3 vector(const std::string& name) const {
    return {number(name + "x"), number(name + "y"), number(name + "z")};
  }
  [[nodiscard]] analytic::space::Matrix3 symmetric(const std::string& name) const {
    analytic::space::Matrix3 m;
    m << number(name + "xx"), number(name + "xy"), number(name + "xz"), number(name + "xy"), number(name + "yy"),
        number(name + "yz"), number(name + "xz"), number(name + "yz"), number(name + "zz");
    return m;
  }

 private:
  const ReferenceRow& row_;
};

inline analytic::RestitutionLaw law_named(const std::string& name) {
  using analytic::RestitutionLaw;
  return std::map<std::string, RestitutionLaw>{
      {"newton", RestitutionLaw::newton}, {"poisson", RestitutionLaw::poisson}, {"stronge", RestitutionLaw::stronge}}
      .at(name);
}

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

/// The drop of a row of space_scenes.csv.
inline analytic::space::Drop reference_drop(const ReferenceFields& f) {
  using namespace analytic;
  space::Drop drop;
  drop.body = space::box(f.number("mass"), {.size = f.vector("L"), .centre = f.vector("c")});
  drop.body.inertia = f.symmetric("I");
  drop.attitude = quaternion(f);
  drop.velocity = f.vector("V");
  drop.angular_velocity = f.vector("O");
  drop.gravity = f.number("gravity");
  drop.law.restitution = f.number("restitution");
  drop.law.law = law_named(f.text("law"));
  drop.law.friction_value = f.number("friction");
  drop.law.friction = drop.law.friction_value > 0 ? FrictionKind::coulomb : FrictionKind::none;
  return drop;
}

/// @param scenes_table rows of space_scenes.csv  @param impacts_table rows of space_sequences.csv
inline std::vector<ReferenceScene> reference_scenes(const std::vector<ReferenceRow>& scenes_table,
                                                    const std::vector<ReferenceRow>& impacts_table) {
  std::vector<ReferenceScene> scenes;
  for (const ReferenceRow& row : scenes_table) {
    const ReferenceFields f(row);
    ReferenceScene& scene = scenes.emplace_back();
    scene.name = f.text("scene");
    scene.end = f.text("end");
    scene.end_acceleration = f.number("end_acceleration");
    scene.tolerance = f.number("tolerance");
    scene.drop = reference_drop(f);
  }
  for (const ReferenceRow& row : impacts_table) {
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
