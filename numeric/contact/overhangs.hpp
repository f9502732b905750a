// SPDX-License-Identifier: GPL-3.0-or-later
// What presses from above on a column of the ground, seen from the face that the column touches.
#pragma once

#include <span>
#include <vector>

#include "numeric/contact/contact_polygon.hpp"

namespace clatter::numeric {

/// Faces whose unit area has less of a vertical component than this count as upright: where they meet the lower face is
/// rounding, and what presses on them is a part of 1e-10 of that on a level face.
inline constexpr double upright = 1e-10;

/// A face below the ground and the vertical component of its unit area: positive where it looks down.
struct PressedFace {
  ContactPolygon polygon;
  double weight;
};

/// A convex part of the face `lower`, above which the face `upper` looks up with nothing of the body between.  Its
/// corners lie in the plane of `lower`, from that face's origin, and carry the depth of `upper` above them.
struct Overhang {
  int lower = 0, upper = 0;
  int sign = 1;  ///< parts of sign −1 take back what others of the same two faces have too much
  std::size_t begin = 0;
  int count = 0;
};

/// Finds which face lies below each face that looks up.  With the vertical component of the area as measure, a column
/// of the ground is pressed by the difference of what its lower and its upper face have, (k_G + c_G δ̇)(δ_lower −
/// δ_upper): δ̇ is that of both, since turning moves points above each other up and down alike.  The difference is
/// therefore never negative, and it acts where the ground touches the body, at the lower face.  Polygons that are
/// not convex count as signed sums of triangles, of which each is cut by each.  Where several faces lie below one
/// another the nearest counts, by inclusion and exclusion.
class Overhangs {
 public:
  /// @param up  the ground's normal in the body frame.
  void find(std::span<const PressedFace> faces, const Vector3& up);
  [[nodiscard]] const std::vector<Overhang>& parts() const { return parts_; }
  [[nodiscard]] const ContactCorner* corners(const Overhang& part) const { return corners_.data() + part.begin; }

 private:
  /// A convex polygon in the plane of the lower face.
  struct Piece {
    static constexpr int most = 24;
    ContactCorner corners[most];
    int count = 0;
  };
  using Triangle = ContactCorner[3];

  void add(const Piece& piece, int lower, int upper, int sign, int from);
  /// The fan triangle of `face` before corner i, on the plane of the face `lower`, counter-clockwise there; its sign
  /// in the fan, or 0 where it has no area.
  int project(int face, int i, int lower, Triangle& out) const;
  [[nodiscard]] Piece cut(const Piece& piece, const Triangle& by, const Vector3& normal) const;
  [[nodiscard]] double depth_below(const Piece& piece, int face, int lower) const;

  std::span<const PressedFace> faces_;
  Vector3 up_;
  std::vector<Overhang> parts_;
  std::vector<ContactCorner> corners_;
};

}  // namespace clatter::numeric
