// SPDX-License-Identifier: GPL-3.0-or-later
// The impacts of validation/oracles/reference/space_impacts.csv.
#pragma once

#include <Eigen/LU>
#include <string>
#include <vector>

#include "analytic/space/impulse/impulse_path.hpp"
#include "validation/oracles/reference_scene.hpp"

namespace clatter::oracle {

struct ReferenceImpact {
  std::string name, path;
  analytic::space::Body body;
  analytic::space::Vector3 place;
  analytic::space::State before;  ///< from the state after and the reference's impulse
  analytic::space::Contact contact;
  analytic::ImpactLaw law;
  double tolerance = 0;
  analytic::space::Vector3 impulse, contact_after, velocity_after, angular_velocity_after;
  double compression = 0, slip_stop = 0;
};

inline ReferenceImpact reference_impact(const ReferenceRow& row) {
  const ReferenceFields fields(row);
  ReferenceImpact r;
  r.name = fields.text("scene") + " impact " + fields.text("impact");
  r.path = fields.text("path");
  r.body = {.mass = fields.number("mass"), .inertia = fields.symmetric("I"), .vertices = {}, .rims = {}};
  r.place = fields.vector("r");
  r.law.law = law_named(fields.text("law"));
  r.law.restitution = fields.number("restitution");
  r.law.friction_value = fields.number("friction");
  r.law.friction = r.law.friction_value > 0 ? analytic::FrictionKind::coulomb : analytic::FrictionKind::none;
  r.tolerance = fields.number("tolerance");
  r.contact = {.inverse_inertia = fields.symmetric("W"),
               .velocity = fields.vector("v"),
               .velocity_scale = fields.vector("v").norm()};
  r.impulse = fields.vector("P");
  r.contact_after = fields.vector("u");
  r.velocity_after = fields.vector("V");
  r.angular_velocity_after = fields.vector("O");
  r.compression = fields.number("compression_impulse");
  r.slip_stop = fields.number("slip_stop_impulse");
  r.before.attitude =
      analytic::space::Quaternion(fields.number("q0"), fields.number("q1"), fields.number("q2"), fields.number("q3"));
  const analytic::space::Matrix3 axes = r.before.attitude.toRotationMatrix();
  const analytic::space::Vector3 moment = (axes * r.place).cross(r.impulse);
  r.before.velocity = r.velocity_after - r.impulse / r.body.mass;
  r.before.angular_velocity = r.angular_velocity_after - axes * r.body.inertia.inverse() * axes.transpose() * moment;
  return r;
}

inline std::vector<ReferenceImpact> reference_impacts(const std::string& folder) {
  std::vector<ReferenceImpact> all;
  for (const ReferenceRow& row : read_reference_table(folder + "/space_impacts.csv")) {
    all.push_back(reference_impact(row));
  }
  return all;
}

}  // namespace clatter::oracle
