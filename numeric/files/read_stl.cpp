// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cstdint>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
namespace {

constexpr std::size_t header_size = 84;    // 80 bytes of comment, then the number of triangles
constexpr std::size_t triangle_size = 50;  // normal, three corners, two bytes of attributes

/// Little-endian, whatever the machine.
std::uint32_t word_at(std::string_view file, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(file[offset + i]);
  return word;
}

void add(Triangles& all, const std::array<Vector3, 3>& corners) {
  const int first = static_cast<int>(all.corners.size());
  all.corners.insert(all.corners.end(), corners.begin(), corners.end());
  all.triangles.push_back({first, first + 1, first + 2});
}

Triangles binary_triangles(std::string_view file) {
  const std::size_t count = word_at(file, 80);
  Triangles all{.corners = {}, .triangles = {}, .rounding = 0x1p-24};
  all.corners.reserve(3 * count);
  all.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t offset = header_size + t * triangle_size + 12;
    std::array<Vector3, 3> corners;
    for (std::size_t i = 0; i < 9; ++i) {
      corners[i / 3][static_cast<int>(i % 3)] = std::bit_cast<float>(word_at(file, offset + 4 * i));
    }
    add(all, corners);
  }
  return all;
}

void expect(Words& words, std::string_view phrase) {
  for (Words expected(phrase);;) {
    const std::string_view wanted = expected.next();
    if (wanted.empty()) return;
    const std::string_view word = words.next();
    if (!is_word(word, wanted)) refuse_word(word, std::string(wanted));
  }
}

/// The normal in the file is often wrong or zero, or no number; the corners say where outside is.
void read_facet(Words& words, Triangles& all) {
  expect(words, "normal");
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = words.next();
    if (word.find("nan") == word.npos && word.find("inf") == word.npos && word.find("NaN") == word.npos &&
        word.find("IND") == word.npos)
      static_cast<void>(number_of(word));
  }
  expect(words, "outer loop");
  std::array<Vector3, 3> corners;
  for (Vector3& corner : corners) {
    expect(words, "vertex");
    for (double& coordinate : corner) coordinate = words.number();
    if (!corner.allFinite())
      throw MeshError("triangle " + std::to_string(all.triangles.size()) + ": a coordinate is not finite");
  }
  expect(words, "endloop endfacet");
  add(all, corners);
}

/// One "solid … endsolid" or several, the patches of one surface.
void read_text(Words& words, Triangles& all) {
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (!is_word(word, "solid")) refuse_word(word, "solid or the end of the file");
    words.skip_line();
    for (word = words.next(); !is_word(word, "endsolid"); word = words.next()) {
      if (!is_word(word, "facet")) refuse_word(word, "facet or endsolid");
      read_facet(words, all);
    }
    words.skip_line();
  }
}

/// Bytes that some programs leave behind a text.
std::string_view without_end_marks(std::string_view file) {
  while (!file.empty() && (file.back() == '\0' || file.back() == '\x1a')) file.remove_suffix(1);
  return file;
}

/// Binary files may begin with "solid" too, so their length decides.
bool is_binary(std::string_view file) {
  if (file.size() >= header_size) {
    const std::size_t whole = header_size + triangle_size * word_at(file, 80);
    if (file.size() >= whole && file.size() < whole + triangle_size) return true;
  }
  return !is_word(Words(file.substr(0, header_size)).next(), "solid") || file.find('\0') != file.npos;
}

/// How many bytes follow the last triangle; those of a whole triangle say that the count is wrong.
std::size_t trailing_bytes(std::string_view file) {
  if (file.size() < header_size) {
    throw MeshError(": truncated: neither text that begins with solid nor a whole binary header");
  }
  const std::size_t count = word_at(file, 80), expected = header_size + triangle_size * count;
  if (file.size() >= expected && file.size() < expected + triangle_size) return file.size() - expected;
  throw MeshError((file.size() < expected ? ": truncated: " : ": trailing data: ") + std::to_string(count) +
                  " triangles take " + std::to_string(expected) + " bytes, the file has " +
                  std::to_string(file.size()));
}

}  // namespace

TriangleFile parse_stl(std::string_view file) {
  if (is_binary(file) && is_binary(without_end_marks(file))) {
    const std::size_t trailing = trailing_bytes(file);
    return {.triangles = binary_triangles(file), .trailing = trailing};
  }
  TriangleFile done;
  Words words(without_end_marks(file));
  try {
    read_text(words, done.triangles);
  } catch (const MeshError& error) {
    throw MeshError(":" + std::to_string(words.line()) + ": " + error.what());
  }
  return done;
}

}  // namespace clatter::numeric
