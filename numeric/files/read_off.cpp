// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
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
