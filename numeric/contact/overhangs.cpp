// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/overhangs.hpp"

#include <algorithm>

namespace clatter::numeric {

void Overhangs::find(std::span<const PressedFace> faces, const Vector3& up) {
  faces_ = faces;
  up_ = up;
  parts_.clear();
  corners_.clear();
  const int count = static_cast<int>(faces.size());
  for (int upper = 0; upper < count; ++upper) {
    if (!(faces[static_cast<std::size_t>(upper)].weight < -upright)) continue;
    for (int lower = 0; lower < count; ++lower) {
      const PressedFace& below = faces[static_cast<std::size_t>(lower)];
      if (!(below.weight > upright)) continue;
      for (int i = 2; i < faces[static_cast<std::size_t>(upper)].polygon.count; ++i) {
        Triangle triangle;
        const int sign = project(upper, i, lower, triangle);
        if (sign == 0) continue;
        Piece whole;
        std::copy(triangle, triangle + 3, whole.corners);
        whole.count = 3;
        for (int j = 2; j < below.polygon.count; ++j) {
          const int other = project(lower, j, lower, triangle);
          if (other == 0) continue;
          const Piece piece = cut(whole, triangle, below.polygon.normal);
          if (piece.count >= 3 && depth_below(piece, lower, lower) > 0) add(piece, lower, upper, sign * other, 0);
        }
      }
    }
  }
}

/// What of the piece has another lower face, from number `from` on, between its two is taken back.
void Overhangs::add(const Piece& piece, int lower, int upper, int sign, int from) {
  parts_.push_back({lower, upper, sign, corners_.size(), piece.count});
  corners_.insert(corners_.end(), piece.corners, piece.corners + piece.count);
  for (int face = from; face < static_cast<int>(faces_.size()); ++face) {
    const PressedFace& between = faces_[static_cast<std::size_t>(face)];
    if (face == lower || !(between.weight > upright)) continue;
    for (int i = 2; i < between.polygon.count; ++i) {
      Triangle triangle;
      const int other = project(face, i, lower, triangle);
      if (other == 0) continue;
      const Piece part = cut(piece, triangle, faces_[static_cast<std::size_t>(lower)].polygon.normal);
      if (part.count < 3) continue;
      const double under_upper = depth_below(part, face, lower), under_lower = depth_below(part, lower, lower);
      if (under_upper > 0 && under_upper < under_lower) add(part, lower, upper, -sign * other, face + 1);
    }
  }
}

int Overhangs::project(int face, int i, int lower, Triangle& out) const {
  const ContactPolygon& from = faces_[static_cast<std::size_t>(face)].polygon;
  const ContactPolygon& onto = faces_[static_cast<std::size_t>(lower)].polygon;
  const ContactCorner* corners[] = {&from.corners[0], &from.corners[i - 1], &from.corners[i]};
  const Vector3 shift = from.origin - onto.origin;
  const double slope = onto.normal.dot(up_);
  for (int j = 0; j < 3; ++j) {
    out[j] = *corners[j];
    if (face == lower) continue;
    out[j].position += shift;
    out[j].position -= (onto.normal.dot(out[j].position) / slope) * up_;
  }
  const auto area = [](const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal) {
    return normal.dot((b - a).cross(c - a));
  };
  const double own = area(corners[0]->position, corners[1]->position, corners[2]->position, from.normal);
  const double here = area(out[0].position, out[1].position, out[2].position, onto.normal);
  if (own == 0 || here == 0) return 0;
  if (here < 0) std::swap(out[1], out[2]);
  return own > 0 ? 1 : -1;
}

Overhangs::Piece Overhangs::cut(const Piece& piece, const Triangle& by, const Vector3& normal) const {
  Piece part = piece, next;
  for (int i = 0; i < 3 && part.count >= 3; ++i) {
    const Vector3& a = by[i].position;
    const Vector3 inward = normal.cross(by[(i + 1) % 3].position - a);
    if (2 * part.count > Piece::most) return {};
    next.count = clip(part.corners, part.count, next.corners,
                      [&](const ContactCorner& corner) { return inward.dot(corner.position - a); });
    std::swap(part, next);
  }
  return part;
}

/// How far, in its middle, the piece of an upper face lies above the plane of another face.  The piece is given on the
/// plane of `lower`.
double Overhangs::depth_below(const Piece& piece, int face, int lower) const {
  Vector3 middle = Vector3::Zero();
  double depth = 0;
  for (int i = 0; i < piece.count; ++i) {
    middle += piece.corners[i].position / piece.count;
    depth += piece.corners[i].depth / piece.count;
  }
  const ContactPolygon& onto = faces_[static_cast<std::size_t>(face)].polygon;
  const ContactCorner& known = onto.corners[0];
  const ContactPolygon& plane = faces_[static_cast<std::size_t>(lower)].polygon;
  // The depth of a face changes over its plane by the height along `up` alone.
  const Vector3 away = middle + (plane.origin - onto.origin) - known.position;
  const double fall = onto.normal.dot(away) / onto.normal.dot(up_);
  return known.depth - up_.dot(away - fall * up_) - depth;
}

}  // namespace clatter::numeric
