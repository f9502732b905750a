// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that land with several corners at once, and the laws they land by.
#pragma once

#include <vector>

#include "analytic/space/body.hpp"
#include "analytic/space/impulse_path.hpp"

namespace clatter::oracle {

using analytic::FrictionKind;
using analytic::RestitutionLaw;
using analytic::space::Body;
using analytic::space::Corner;
using analytic::space::Law;
using analytic::space::Vector3;

inline std::vector<Corner> corners_of(const std::vector<Vector3>& places) {
  std::vector<Corner> corners;
  for (const Vector3& place : places) corners.push_back({static_cast<int>(corners.size()), place});
  return corners;
}

inline Law frictionless(double e) {
  Law law;
  law.law.restitution = e;
  return law;
}

inline Law coulomb(double e, double friction, RestitutionLaw restitution = RestitutionLaw::newton) {
  Law law = frictionless(e);
  law.law.law = restitution;
  law.law.friction = FrictionKind::coulomb;
  law.law.friction_value = friction;
  return law;
}

/// A box with its bottom face on the ground.
struct FlatBox {
  double length, width, height;
  Body body;
  std::vector<Corner> bottom;

  FlatBox(double l, double w, double h, double mass) : length(l), width(w), height(h) {
    const Vector3 inertia = mass / 12 * Vector3(w * w + h * h, h * h + l * l, l * l + w * w);
    body = {.mass = mass, .inertia = inertia.asDiagonal(), .vertices = {}, .rims = {}};
    bottom = corners_of(
        {{-l / 2, -w / 2, -h / 2}, {l / 2, -w / 2, -h / 2}, {l / 2, w / 2, -h / 2}, {-l / 2, w / 2, -h / 2}});
  }
};

inline double normal_velocity(const Vector3& v, const Vector3& spin, const Vector3& arm) {
  return (v + spin.cross(arm)).z();
}

}  // namespace clatter::oracle
