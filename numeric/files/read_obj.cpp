// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
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

}  // namespace clatter::numeric
