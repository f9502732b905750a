// SPDX-License-Identifier: GPL-3.0-or-later
// What of a body lies below an elastic half-space, seen along the ground's normal, and the energy that it stores there.
#pragma once

#include <vector>

#include "numeric/contact/contact_polygon.hpp"

namespace clatter::numeric {

/// κ of a patch of aspect r, the square root of the ratio of its second moments, by q = ((r + 1/r)/2)²:
///     κ = (π/2) √r/K(1 − 1/r²) = agm(√r, 1/√r),   K(m) the complete elliptic integral,
/// the stiffness of a flat elliptic punch over that of a round one of the same area.  Even in ln r, so that it is
/// smooth in q; by the arithmetic-geometric mean, right to some eps.
struct AspectFactor {
  double value = 1;     ///< κ
  double exponent = 0;  ///< d ln κ/d ln q, from 1/16 at q = 1 to 1/4
};
[[nodiscard]] AspectFactor aspect_factor(double q);

/// The elastic pressure over a patch,
///     p = δU/δδ = k δ + R,   k = 3U/S₂,   R = U [−1/S₁ + (G/S₁)(x − c)ᵀ B (x − c)],
/// G = d ln κ/d ln q, B = 2·1/tr Σ − Σ⁻¹.  It acts across the surface: beside p along the ground's normal p ∇δ along
/// the ground, whose resultant is zero and whose couple, −½∫δ²∇R dA as a part of ∫R u, is what makes U the potential of
/// moments, too.
struct HalfSpacePressure {
  double energy = 0;                        ///< U [J]
  double stiffness = 0;                     ///< k of the part that grows with the depth [N/m³]
  double volume = 0;                        ///< S₁ [m³]
  Vector3 volume_moment = Vector3::Zero();  ///< ∫δu, body frame [m⁴]
  double rest = 0;                          ///< ∫R [N]
  Vector3 rest_moment = Vector3::Zero();    ///< ∫R u, body frame [N·m]
  double extent = 0;                        ///< √tr Σ [m]

  [[nodiscard]] double force() const { return stiffness * volume + rest; }
  [[nodiscard]] Vector3 first_moment() const { return stiffness * volume_moment + rest_moment; }
};

/// Keeps the patch of one evaluation: polygons of facets, or nodes of a rule over a smooth surface, by their places x
/// along the ground and depths δ.  Areas are vertical components, and negative where the surface looks up, so that the
/// integrals are those of the columns of the ground.  With
///     S₁ = ∫δ dA,   S₂ = ∫δ² dA,   c = ∫δx dA/S₁,   Σ = ∫δ(x − c)(x − c)ᵀ dA/S₁,   q = (tr Σ)²/(4 det Σ)
/// the energy of a half-space of modulus E* is
///     U = E*/√π · S₂^(3/2)/S₁ · κ(q),
/// exact for flat ends that are circles, and for flat ellipses; of a sphere 2 % above Hertz's, of a cone 4.5 % below
/// Sneddon's (tests/numeric/contact/half_space_test.cpp has more).  Where a wide part begins to touch round a deep
/// narrow one S₁ grows and U would fall: there, which is never of a convex body, U = 0.78 E* √(S₄/π) κ with S₄ = ∫δ⁴
/// dA, which does not, is more and counts.  One patch: of several that are far apart each is taken for softer than it
/// is.  The integrals are exact; Σ keeps its digits in patches much longer than wide, to eps times the aspect, since it
/// is formed along their axes.
class Footprint {
 public:
  /// @param up  the ground's normal, body frame
  void begin(const Vector3& up);
  /// Adds the part of a facet that lies below the ground.
  void add(const ContactPolygon& polygon);
  /// @param place  from `origin`
  /// @param area  vertical component
  void add(const Vector3& origin, const Vector3& place, double depth, double area);
  /// The pressure over what was added since begin(), which it turns to its axes: once.
  [[nodiscard]] HalfSpacePressure pressure(double modulus);

 private:
  struct Place {
    double x, y, depth;
  };
  struct Node {
    Place place;
    double area;
  };
  struct Moments;
  struct Rest;
  struct Bend {
    double xx, xy, yy;
  };
  [[nodiscard]] Place place_of(const Vector3& origin, const Vector3& place, double depth);
  void turn(double x, double y, double angle);
  template <class Triangle, class Point>
  void visit(Triangle&& triangle, Point&& point) const;
  [[nodiscard]] Moments moments() const;
  [[nodiscard]] Moments centred();
  [[nodiscard]] Rest rest_by_shape(const Bend& bend, double constant) const;
  [[nodiscard]] Rest cubes() const;

  Vector3 up_ = Vector3::UnitZ(), x_axis_ = Vector3::UnitX(), y_axis_ = Vector3::UnitY();
  Vector3 origin_ = Vector3::Zero();
  double rise_ = 0;  ///< of the origin above the ground [m]
  bool is_empty_ = true;
  std::vector<Place> corners_;
  std::vector<std::size_t> ends_;  ///< of the polygons, in corners_
  std::vector<Node> nodes_;
};

}  // namespace clatter::numeric
