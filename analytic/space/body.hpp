// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies in space that touch the ground with vertices and rims, and the state of their motion.
//
// World frame: x right, y into the page, z up, ground z = 0.  Body frame: origin at the centre of mass.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace clatter::analytic::space {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

/// A circle of the surface that can touch the ground, as the ends of a rod have it.
struct Rim {
  Vector3 centre = Vector3::Zero();  ///< body frame [m]
  Vector3 axis = Vector3::UnitX();   ///< unit normal of the circle's plane, body frame; the sign is free
  double radius = 0;                 ///< > 0 [m]
};

/// A rigid body: what its impacts and flights depend on.
struct Body {
  double mass = 1;                        ///< m [kg]
  Matrix3 inertia = Matrix3::Identity();  ///< about the centre of mass, body axes, symmetric [kg·m²]
  std::vector<Vector3> vertices;          ///< corners of the hull, body frame [m]
  std::vector<Rim> rims;                  ///< circles of the hull

  /// Largest distance of a point of the hull from the centre of mass [m].
  [[nodiscard]] double reach() const;
  /// @throws std::domain_error naming the field, its value and what is allowed: mass > 0; inertia symmetric with
  ///         principal values > 0 that hold the triangle inequality to rounding; at least one vertex or rim; all
  ///         finite.
  void validate() const;
};

/// Where the body is and how it moves.
struct State {
  Vector3 position = Vector3::Zero();            ///< of the centre of mass, world frame [m]
  Quaternion attitude = Quaternion::Identity();  ///< body to world, unit
  Vector3 velocity = Vector3::Zero();            ///< of the centre of mass, world frame [m/s]
  Vector3 angular_velocity = Vector3::Zero();    ///< world frame [rad/s]
};

/// A point of the hull, a vertex or the lowest point of a rim; or all of a rim that lies level.
struct Corner {
  int index = 0;                    ///< into Body::vertices, or vertices.size() + index into Body::rims
  Vector3 place = Vector3::Zero();  ///< body frame, from the centre of mass; the centre of a level rim [m]
  double radius = 0;                ///< of a level rim; 0: a point [m]
};

}  // namespace clatter::analytic::space
