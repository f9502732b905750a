// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/files/triangle_files.hpp"

#include <algorithm>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"

namespace clatter::numeric {

namespace {

using Vector2 = Eigen::Vector2d;

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

void add_polygon(Triangles& triangles, const std::vector<int>& polygon) {
  if (polygon.size() == 3) {
    triangles.triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  if (polygon.size() < 3) return;
  constexpr std::size_t most = 20'000;  // beyond which the search for ears takes minutes
  if (polygon.size() > most) throw MeshError("a face has " + std::to_string(polygon.size()) + " corners");
  // Seen along the polygon's area it runs counter-clockwise.
  const Vector3& origin = triangles.corners[polygon[0]];
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i)
    area += (triangles.corners[polygon[i]] - origin).cross(triangles.corners[polygon[i + 1]] - origin);
  const Vector3 normal = area.norm() > 0 ? Vector3(area.stableNormalized()) : Vector3::UnitZ();
  const Vector3 across = normal.unitOrthogonal(), third = normal.cross(across);
  std::vector<Vector2> place;
  for (const int corner : polygon) {
    const Vector3 arm = triangles.corners[corner] - origin;
    place.emplace_back(arm.dot(across), arm.dot(third));
  }
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  // The most pointed ear is cut off first, so that corners on a straight edge get no flat triangles if they need not.
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t best = 0;
    double best_shape = -1;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector2 &a = place[left[(i + n - 1) % n]], &b = place[left[i]], &c = place[left[(i + 1) % n]];
      const double twice = turn(a, b, c),
                   longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
      const double shape = longest > 0 ? twice / longest : 0;
      if (!(shape > best_shape) || (twice <= 0 && best_shape >= 0)) continue;
      bool is_ear = true;
      for (std::size_t j = 0; j < n && is_ear && twice > 0; ++j) {
        const Vector2& p = place[left[j]];
        if (j == i || j == (i + 1) % n || j == (i + n - 1) % n || p == a || p == b || p == c) continue;
        is_ear = turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
      }
      if (!is_ear) continue;
      best = i;
      best_shape = shape;
      if (n > 64 && shape > 0.1) break;  // good enough where a search for the best would take n³ steps
    }
    triangles.triangles.push_back(
        {polygon[left[(best + n - 1) % n]], polygon[left[best]], polygon[left[(best + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.triangles.push_back({polygon[left[0]], polygon[left[1]], polygon[left[2]]});
}

// OBJ.

namespace {

/// The next word of a line, which goes on in the next after a backslash.
std::string_view next_word(Words& words) {
  std::string_view word = words.next_on_line();
  while (word == "\\") {
    words.skip_line();
    word = words.next_on_line();
  }
  return word;
}

/// The corner of "7", "7/1", "7/1/3", "7//3"; numbers begin with 1, those below 0 count from the last.
int corner_of(std::string_view word, std::size_t count) {
  const long long number = whole_number_of(word.substr(0, word.find('/')));
  const long long last = static_cast<long long>(count);
  const long long index = number < 0 ? last + number : number - 1;
  if (number == 0 || index < 0 || index >= last)
    throw MeshError("corner " + std::to_string(number) + " is not one of the " + std::to_string(count) + " before it");
  return static_cast<int>(index);
}

void read_line(Words& words, Triangles& all, std::vector<int>& polygon) {
  const std::string_view kind = words.next_on_line();
  if (kind == "v") {
    Vector3& corner = all.corners.emplace_back();
    for (double& coordinate : corner) coordinate = number_of(next_word(words));
    if (!corner.allFinite())
      throw MeshError("corner " + std::to_string(all.corners.size()) + ": a coordinate is not finite");
  } else if (kind == "f") {
    polygon.clear();
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words))
      polygon.push_back(corner_of(word, all.corners.size()));
    if (polygon.size() < 3) throw MeshError("a face of " + std::to_string(polygon.size()) + " corners");
    add_polygon(all, polygon);
  }
}

}  // namespace

TriangleFile parse_obj(std::string_view file) {
  TriangleFile done;
  Words words(file);
  std::vector<int> polygon;
  try {
    for (; !words.at_end(); words.skip_line()) read_line(words, done.triangles, polygon);
  } catch (const MeshError& error) {
    throw MeshError(":" + std::to_string(words.line()) + ": " + error.what());
  }
  if (done.triangles.triangles.empty()) throw MeshError(": has no face");
  return done;
}

// OFF.

namespace {

/// The first word of the next line that has one; empty at the end of the file.
std::string_view first_of_line(Words& words) {
  for (;;) {
    const std::string_view word = words.next_on_line();
    if (!word.empty() || words.at_end()) return word;
    words.skip_line();
  }
}

void read_corners(Words& words, long long count, Triangles& all) {
  for (long long i = 0; i < count; ++i) {
    Vector3 corner;
    corner.x() = number_of(first_of_line(words));
    corner.y() = words.number_on_line();
    corner.z() = words.number_on_line();
    if (!corner.allFinite()) throw MeshError("corner " + std::to_string(i) + ": a coordinate is not finite");
    all.corners.push_back(corner);
    words.skip_line();  // normals and colours
  }
}

void read_faces(Words& words, long long count, Triangles& all) {
  std::vector<int> polygon;
  for (long long i = 0; i < count; ++i) {
    const long long size = whole_number_of(first_of_line(words));
    if (size < 3) throw MeshError("face " + std::to_string(i) + ": has " + std::to_string(size) + " corners");
    polygon.clear();
    for (long long k = 0; k < size; ++k) {
      const long long corner = whole_number_of(words.next_on_line());
      if (corner < 0 || corner >= static_cast<long long>(all.corners.size()))
        throw MeshError("face " + std::to_string(i) + ": corner " + std::to_string(corner) + " is not one of the " +
                        std::to_string(all.corners.size()));
      polygon.push_back(static_cast<int>(corner));
    }
    add_polygon(all, polygon);
    words.skip_line();
  }
}

}  // namespace

TriangleFile parse_off(std::string_view file) {
  TriangleFile done;
  Words words(file);
  try {
    std::string_view word = first_of_line(words);
    const bool is_named = word.ends_with("OFF");
    if (word.starts_with("4") && is_named) throw MeshError("has corners in four dimensions");
    if (is_named) word = first_of_line(words);
    if (word == "BINARY") throw MeshError("is binary: only the text of this form can be read");
    const long long corners = whole_number_of(word), faces = whole_number_of(words.next_on_line());
    words.skip_line();
    read_corners(words, corners, done.triangles);
    read_faces(words, faces, done.triangles);
  } catch (const MeshError& error) {
    throw MeshError(":" + std::to_string(words.line()) + ": " + error.what());
  }
  return done;
}

}  // namespace clatter::numeric
