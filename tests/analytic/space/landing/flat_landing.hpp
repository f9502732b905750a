// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that land with several corners at once, and the laws they land by.
#pragma once

#include <vector>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/impulse_path.hpp"
#include "analytic/space/landing/simultaneous.hpp"

namespace clatter::oracle {

using analytic::FrictionKind;
using analytic::ImpactLaw;
using analytic::RestitutionLaw;
using analytic::space::Body;
using analytic::space::Corner;
using analytic::space::Vector3;

inline std::vector<Corner> corners_of(const std::vector<Vector3>& places) {
  std::vector<Corner> corners;
  for (const Vector3& place : places) corners.push_back({static_cast<int>(corners.size()), place});
  return corners;
}

inline ImpactLaw frictionless(double e) {
  ImpactLaw law;
  law.restitution = e;
  return law;
}

inline ImpactLaw coulomb(double e, double friction, RestitutionLaw restitution = RestitutionLaw::newton) {
  ImpactLaw law = frictionless(e);
  law.law = restitution;
  law.friction = FrictionKind::coulomb;
  law.friction_value = friction;
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

/// What a landing lost is what its motion has less than before, `velocity` and `angular_velocity`.
void check_energy_account(const Body& body, const auto& before, const analytic::space::GroupImpact& struck) {
  const auto energy = [&](const Vector3& v, const Vector3& w) {
    return (body.mass * v.squaredNorm() + w.dot(body.inertia * w)) / 2;
  };
  const double at_first = energy(before.velocity, before.angular_velocity);
  const double at_last = energy(struck.velocity_after, struck.angular_velocity_after);
  BOOST_TEST(std::fabs(at_first - at_last - struck.energy_loss) <= 1e-13 * at_first);
}

/// `turned` is the landing of the same motion turned by `angle` about the vertical.
inline void check_turned(const analytic::space::GroupImpact& whole, const analytic::space::GroupImpact& turned,
                         double angle, double tolerance) {
  const Eigen::Quaterniond back(Eigen::AngleAxisd(-angle, Vector3::UnitZ()));
  BOOST_TEST((back * turned.velocity_after - whole.velocity_after).norm() <= tolerance);
  BOOST_TEST((back * turned.angular_velocity_after - whole.angular_velocity_after).norm() <= 20 * tolerance);
}

inline double normal_velocity(const Vector3& v, const Vector3& spin, const Vector3& arm) {
  return (v + spin.cross(arm)).z();
}

}  // namespace clatter::oracle
