// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
namespace {

enum class Encoding { text, little_endian, big_endian };
enum class Scalar { i1, u1, i2, u2, i4, u4, f4, f8 };

struct Property {
  std::string_view name;
  Scalar type = Scalar::f4;
  bool is_list = false;
  Scalar count_type = Scalar::u1;
};

struct Part {
  std::string_view name;
  long long count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding form = Encoding::text;
  std::vector<Part> parts;
  std::size_t size = 0;  ///< bytes, the line of end_header taken
  int lines = 0;
};

Scalar scalar_named(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> names{{{"char", Scalar::i1},
                                                                       {"int8", Scalar::i1},
                                                                       {"uchar", Scalar::u1},
                                                                       {"uint8", Scalar::u1},
                                                                       {"short", Scalar::i2},
                                                                       {"int16", Scalar::i2},
                                                                       {"ushort", Scalar::u2},
                                                                       {"uint16", Scalar::u2},
                                                                       {"int", Scalar::i4},
                                                                       {"int32", Scalar::i4},
                                                                       {"uint", Scalar::u4},
                                                                       {"uint32", Scalar::u4},
                                                                       {"float", Scalar::f4},
                                                                       {"float32", Scalar::f4},
                                                                       {"double", Scalar::f8},
                                                                       {"float64", Scalar::f8}}};
  for (const auto& [name, type] : names) {
    if (name == word) return type;
  }
  refuse_word(word, "a type of numbers, such as float or uchar");
}

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

Property property(Words& words) {
  Property made;
  std::string_view type = words.next_on_line();
  made.is_list = type == "list";
  if (made.is_list) {
    made.count_type = scalar_named(words.next_on_line());
    type = words.next_on_line();
  }
  made.type = scalar_named(type);
  made.name = words.next_on_line();
  return made;
}

Header header_of(std::string_view file) {
  Header header;
  Words words(file);
  try {
    if (words.next_on_line() != "ply") throw MeshError("does not begin with ply");
    for (std::string_view word = "ply"; word != "end_header";) {
      words.skip_line();
      if (words.at_end()) throw MeshError("has no end_header");
      word = words.next_on_line();
      if (word == "format") {
        const std::string_view form = words.next_on_line();
        if (form == "ascii") header.form = Encoding::text;
        else if (form == "binary_little_endian") header.form = Encoding::little_endian;
        else if (form == "binary_big_endian") header.form = Encoding::big_endian;
        else refuse_word(form, "ascii, binary_little_endian or binary_big_endian");
      } else if (word == "element") {
        Part part;
        part.name = words.next_on_line();
        part.count = whole_number_of(words.next_on_line());
        if (part.count < 0) throw MeshError("a count below 0");
        header.parts.push_back(part);
      } else if (word == "property") {
        if (header.parts.empty()) throw MeshError("a property of no element");
        header.parts.back().properties.push_back(property(words));
      }
    }
  } catch (const MeshError& error) {
    throw MeshError(":" + std::to_string(words.line()) + ": " + error.what());
  }
  header.lines = words.line();
  Words rest = words;
  rest.skip_line();
  header.size = rest.place();
  return header;
}

/// Numbers one after another, of text or bytes.
class Numbers {
 public:
  Numbers(std::string_view rest, Encoding form) : rest_(rest), words_(rest), form_(form) {}

  double next(Scalar type) { return form_ == Encoding::text ? words_.number() : binary(type); }
  long long whole(Scalar type) {
    return form_ == Encoding::text ? words_.whole() : static_cast<long long>(binary(type));
  }
  [[nodiscard]] int line() const { return words_.line(); }

 private:
  double binary(Scalar type) {
    const std::size_t size = size_of(type);
    if (rest_.size() < size) throw MeshError("truncated: the file ends within its numbers");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = form_ == Encoding::big_endian ? i : size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(size);
    switch (type) {
      case Scalar::i1: return static_cast<std::int8_t>(bits);
      case Scalar::i2: return static_cast<std::int16_t>(bits);
      case Scalar::i4: return static_cast<std::int32_t>(bits);
      case Scalar::f4: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case Scalar::f8: return std::bit_cast<double>(bits);
      default: return static_cast<double>(bits);
    }
  }

  std::string_view rest_;
  Words words_;
  Encoding form_;
};

void skip_property(Numbers& numbers, const Property& property) {
  const long long count = property.is_list ? numbers.whole(property.count_type) : 1;
  for (long long i = 0; i < count; ++i) static_cast<void>(numbers.next(property.type));
}

void read_corner(Numbers& numbers, const Part& part, Triangles& all) {
  Vector3 corner = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Property& property : part.properties) {
    const bool is_place =
        !property.is_list && property.name.size() == 1 && property.name >= "x" && property.name <= "z";
    if (!is_place) {
      skip_property(numbers, property);
      continue;
    }
    corner[property.name[0] - 'x'] = numbers.next(property.type);
    if (property.type != Scalar::f8) all.rounding = 0x1p-24;
  }
  if (!corner.allFinite())
    throw MeshError("corner " + std::to_string(all.corners.size()) + ": a coordinate is not finite");
  all.corners.push_back(corner);
}

void read_face(Numbers& numbers, const Part& part, Triangles& all, std::vector<int>& polygon) {
  polygon.clear();
  for (const Property& property : part.properties) {
    if (!property.is_list || (property.name != "vertex_indices" && property.name != "vertex_index")) {
      skip_property(numbers, property);
      continue;
    }
    const long long size = numbers.whole(property.count_type);
    for (long long i = 0; i < size; ++i) {
      const long long corner = numbers.whole(property.type);
      if (corner < 0 || corner >= static_cast<long long>(all.corners.size()))
        throw MeshError("face " + std::to_string(all.triangles.size()) + ": corner " + std::to_string(corner) +
                        " is not one of the " + std::to_string(all.corners.size()));
      polygon.push_back(static_cast<int>(corner));
    }
  }
  add_polygon(all, polygon);
}

}  // namespace

TriangleFile parse_ply(std::string_view file) {
  const Header header = header_of(file);
  TriangleFile done;
  Numbers numbers(file.substr(header.size), header.form);
  std::vector<int> polygon;
  try {
    for (const Part& part : header.parts) {
      if (part.properties.empty()) continue;
      for (long long i = 0; i < part.count; ++i) {
        if (part.name == "vertex") {
          read_corner(numbers, part, done.triangles);
        } else if (part.name == "face") {
          read_face(numbers, part, done.triangles, polygon);
        } else {
          for (const Property& property : part.properties) skip_property(numbers, property);
        }
      }
    }
  } catch (const MeshError& error) {
    const std::string line = header.form == Encoding::text ? ":" + std::to_string(header.lines + numbers.line()) : "";
    throw MeshError(line + ": " + error.what());
  }
  if (done.triangles.triangles.empty()) throw MeshError(": has no face");
  return done;
}

}  // namespace clatter::numeric
