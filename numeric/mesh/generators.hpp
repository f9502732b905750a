// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of the paper's bodies.
#pragma once

#include "numeric/mesh/mesh.hpp"

namespace clatter::numeric {

/// A solid cylinder along x, centred at the origin.  Its faceted mesh has less volume than the round
/// cylinder; the density is scaled so that the mass is `mass`.
struct RodMesh {
  double length = 1;     ///< [m], > 0
  double radius = 0.01;  ///< of the rim nodes [m], > 0
  double mass = 1;       ///< [kg], > 0
  int sectors = 16;      ///< around, >= 3; one node of the rim lies exactly at the bottom, (y, z) = (0, −radius)
  int rings = 4;         ///< from the axis to the rim, >= 1; the innermost are prisms, the others hexahedra
  int layers = 30;       ///< along the axis, >= 1
};

/// A box centred at the origin with its edges along x, y, z.
struct BoxMesh {
  Vector3 size{1, 1, 1};       ///< [m], each > 0
  double mass = 1;             ///< [kg], > 0
  int nx = 1, ny = 1, nz = 1;  ///< hexahedra along each edge, >= 1
};

/// An ellipsoid centred at the origin with its axes along x, y, z, or two halves of one with a straight part of the
/// same section in between: a capsule.  Tetrahedra about the middle; the nodes of the surface lie on the shape.
struct RoundMesh {
  Vector3 semiaxes{1, 1, 1};  ///< [m], each > 0
  double straight = 0;        ///< length between the two halves [m], >= 0
  double mass = 1;            ///< [kg], > 0
  int sectors = 16;           ///< around x, >= 3; as of a rod
  int rings = 4;              ///< of equal angles from each pole to the equator, >= 1
};

/// Coordinates are exactly symmetric about the planes y = 0 (both), x = 0 and z = 0 (both, for an even
/// number of sectors) to the bit.
/// @throws std::domain_error naming the field, its value and what is allowed.
[[nodiscard]] Mesh rod_mesh(const RodMesh& rod);
[[nodiscard]] Mesh box_mesh(const BoxMesh& box);
[[nodiscard]] Mesh round_mesh(const RoundMesh& shape);

}  // namespace clatter::numeric
