// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of simple shape.
#pragma once

#include <vector>

#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

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
