// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies in space that touch the ground with vertices, rims and round surfaces, and the state of their motion.
//
// World frame: x right, y into the page, z up, ground z = 0.  Body frame: origin at the centre of mass.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "analytic/plane/body.hpp"

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

/// An ellipsoid of the surface, its axes parallel to the body's; with equal ones a sphere.
struct Ellipsoid {
  Vector3 centre = Vector3::Zero();    ///< body frame [m]
  Vector3 semiaxes = Vector3::Ones();  ///< along x, y, z; the least above 1e-9 of the largest [m]

  [[nodiscard]] bool is_sphere() const { return semiaxes == Vector3::Constant(semiaxes.x()); }
  /// Axis of revolution, unit; a sphere has that through the origin; zero if no two axes are equal, or any will do.
  [[nodiscard]] Vector3 axis() const;
};

/// What rims and ellipsoids have in common: the points c + ρ S u, |u| = 1.  Below the vertical e, in body axes, the
/// lowest lies at
///     r = c − ρ S²e/|S e|,   h = e·c − ρ |S e|.                                                          (1)
/// S = 1 − a aᵀ of a rim with the axis a, diagonal of an ellipsoid with its semiaxes over the largest, ρ.
struct Round {
  Vector3 centre, axis, shares;  ///< c [m]; a, zero of an ellipsoid; diagonal of S + a aᵀ
  double radius;                 ///< ρ [m]

  /// S x.
  [[nodiscard]] Vector3 across(const Vector3& x) const { return x.cwiseProduct(shares) - x.dot(axis) * axis; }
  /// S²x from S x.
  [[nodiscard]] Vector3 twice(const Vector3& across) const { return across.cwiseProduct(shares); }
  /// Whether it has a point that is not lower than others: a rim, level.
  [[nodiscard]] bool is_rim() const { return axis != Vector3::Zero(); }
};

/// A rigid body: what its impacts and flights depend on.  A point of the surface that can touch is an index into
/// vertices, then rims, then ellipsoids.
struct Body {
  double mass = 1;                         ///< m [kg]
  Matrix3 inertia = Matrix3::Identity();   ///< about the centre of mass, body axes, symmetric [kg·m²]
  std::vector<Vector3> vertices;           ///< corners of the hull, body frame [m]
  std::vector<Rim> rims;                   ///< circles of the hull
  std::vector<Ellipsoid> ellipsoids = {};  ///< parts of the hull

  [[nodiscard]] int points() const { return static_cast<int>(vertices.size() + rims.size() + ellipsoids.size()); }
  /// Null unless the point is the lowest of a sphere.
  [[nodiscard]] const Ellipsoid* sphere(int point) const;
  /// The rim or ellipsoid that the point is of.  Domain: no vertex.
  [[nodiscard]] Round round(int point) const;
  /// All of it lies in the plane y = 0, as a thin rod's ends and the outline of a body that moves in that plane: two
  /// points of it on the ground are all on which it can lie.
  [[nodiscard]] bool is_flat() const;
  /// Whether it lies on the ground where so many corners of it stay there.
  [[nodiscard]] bool lies_on(std::size_t corners) const { return corners >= 3 || (corners == 2 && is_flat()); }
  /// A sphere about its centre of mass: no turn moves its lowest point.
  [[nodiscard]] bool is_centred_sphere() const;
  /// The same with equal moments of inertia: its attitude does not matter at all.
  [[nodiscard]] bool is_ball() const;

  /// Largest distance of a point of the hull from the centre of mass, of an ellipsoid off it a bound on that [m].
  [[nodiscard]] double reach() const;
  /// Moment of inertia across the axis of a body of revolution, the surface of which is rims and ellipsoids about one
  /// axis through the centre of mass that is one of the inertia, to rounding; nothing for any other body [kg·m²].
  [[nodiscard]] std::optional<double> transverse_moment() const;
  /// @throws std::domain_error naming the field, its value and what is allowed: mass > 0; inertia symmetric with
  ///         principal values > 0 that hold the triangle inequality to rounding; at least one vertex, rim or ellipsoid;
  ///         all finite.
  void validate() const;
};

/// Where the body is and how it moves.
struct State {
  Vector3 position = Vector3::Zero();            ///< of the centre of mass, world frame [m]
  Quaternion attitude = Quaternion::Identity();  ///< body to world, unit
  Vector3 velocity = Vector3::Zero();            ///< of the centre of mass, world frame [m/s]
  Vector3 angular_velocity = Vector3::Zero();    ///< world frame [rad/s]
};

/// NaN in all of it.
[[nodiscard]] inline State unknown_state() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Vector3 none = Vector3::Constant(nan);
  return {none, Quaternion(nan, nan, nan, nan), none, none};
}

/// Height of the centre of mass above the lowest point [m].
/// @throws std::domain_error unless the attitude's Euler parameters, body to world, have the length 1 to within 1e-6
[[nodiscard]] double touch_height(const Body& body, const Quaternion& attitude);

/// Velocity of the body's point at `place`, body frame from the centre of mass, in the world frame [m/s].
inline Vector3 velocity_at(const State& s, const Vector3& place) {
  return s.velocity + s.angular_velocity.cross(s.attitude * place);
}

/// The turn about a rotation vector by its length [rad].
inline Quaternion turn_by(const Vector3& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Quaternion(Eigen::AngleAxisd(angle, rotation / angle)) : Quaternion::Identity();
}

/// The shortest turn of one direction into another, not the opposite one; lengths do not count.
/// Quaternion::FromTwoVectors knows opposite ones too, for which it takes ten seconds to compile.
inline Quaternion turn_between(const Vector3& from, const Vector3& to) {
  const Vector3 a = from.normalized(), b = to.normalized(), middle = (a + b).normalized(), axis = a.cross(middle);
  return {a.dot(middle), axis.x(), axis.y(), axis.z()};
}

/// A point of the hull, a vertex or the lowest point of a rim or ellipsoid; or all of a rim that lies level.
struct Corner {
  int index = 0;                    ///< of the point, as Body counts them
  Vector3 place = Vector3::Zero();  ///< body frame, from the centre of mass; the centre of a level rim [m]
  double radius = 0;                ///< of a level rim; 0: a point [m]
};

// Vector products.

/// The component of a × b along z.
inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }
/// a turned by a right angle to the left.
inline Vector2 quarter_turn(const Vector2& a) { return {-a.y(), a.x()}; }

/// V×, such that (V×) a = V × a.
inline Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

// Principal moments and axes of a body's inertia, with more digits than a double has.

/// Principal moments and axes of an inertia tensor.
/// Accuracy: a few ulp of long double × the largest moment; a diagonal tensor keeps its entries as they are.
struct PrincipalAxes {
  using Matrix = Eigen::Matrix<long double, 3, 3>;

  std::array<long double, 3> moments{};  ///< ascending [kg·m²]
  Matrix axes = Matrix::Identity();      ///< columns, body frame, right-handed

  explicit PrincipalAxes(const Matrix3& inertia);
};

// Bodies of simple shape.

/// A box with faces parallel to the body axes.
struct Box {
  Vector3 size = Vector3::Ones();    ///< L, W, T along x, y, z [m]
  Vector3 centre = Vector3::Zero();  ///< of mass, from the geometric centre [m]
};

/// A uniform box: I = m/12 diag(W² + T², L² + T², L² + W²), about the centre of mass also where that lies elsewhere.
/// Vertex 4i + 2j + k is the one with x > 0 for i = 1, y > 0 for j = 1, z > 0 for k = 1.
/// @throws std::domain_error for a size that is not above 0.
[[nodiscard]] Body box(double mass, const Box& shape);

/// A solid cylinder along x, the rod of the planar model with its real rim.
struct Cylinder {
  double length = 1;  ///< L [m]
  double radius = 0;  ///< r >= 0 [m]; 0: a thin rod
};

/// A uniform cylinder: I = m diag(r²/2, (3r² + L²)/12, (3r² + L²)/12), two rims, no vertices; rim 0 is at −L/2.
/// A thin rod has two vertices instead and no moment about its axis to speak of: no impulse turns it about that axis,
/// so that the third moment takes the value of the others, which makes its free rotation that of a fixed axis.
/// @throws std::domain_error for a length that is not above 0 or a radius below 0.
[[nodiscard]] Body cylinder(double mass, const Cylinder& shape);

/// The box and the rod of the planar model, by the same sizes.
[[nodiscard]] inline Body make_box(const BoxSize& size) {
  return box(size.mass, {.size = {size.length, size.width, size.thickness}});
}
[[nodiscard]] inline Body make_rod(const RodSize& size) {
  return cylinder(size.mass, {.length = size.length, .radius = size.radius});
}

/// A uniform ellipsoid: I = m/5 diag(b² + c², a² + c², a² + b²).
/// @throws std::domain_error for a semiaxis a, b, c that is not above 0, or below 1e-9 of the largest.
[[nodiscard]] Body ellipsoid(double mass, const Vector3& semiaxes);

/// A solid capsule along x, of the length L over all: a cylinder of length l = L − 2r between two half balls.
/// Uniform, with the part c = l/(l + 4r/3) of the mass in the cylinder:
///     I_x = m r² (c/2 + 2(1 − c)/5),   I_y = I_z = m [c (l²/12 + r²/4) + (1 − c)(2r²/5 + l²/4 + 3lr/8)].     (2)
/// Sphere 0 is at −l/2; for L = 2r there is one.
/// @throws std::domain_error for r not above 0 or L below 2r.
[[nodiscard]] Body capsule(double mass, const Cylinder& shape);

/// The outline of a body that moves in the plane y = 0.  Its moments of inertia are equal, so that nothing turns it out
/// of that plane.
[[nodiscard]] Body outline(const PlanarBody& body);

/// Mass, centre and inertia of a polyhedron.
struct MassProperties {
  double mass = 1;
  Vector3 centre = Vector3::Zero();       ///< of mass, in the frame of the vertices [m]
  Matrix3 inertia = Matrix3::Identity();  ///< about the centre of mass, axes of the vertices' frame [kg·m²]
};

/// A polyhedron with these hull vertices; a vertex inside the hull would do no harm but cost time.
/// @throws std::domain_error as Body::validate().
[[nodiscard]] Body polyhedron(const std::vector<Vector3>& vertices, const MassProperties& properties);

}  // namespace clatter::analytic::space
