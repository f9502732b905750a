// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "numeric/base/errors.hpp"
#include "numeric/files/import.hpp"

namespace clatter::numeric {
namespace {

constexpr std::size_t header_size = 84;    // 80 bytes of comment, then the number of triangles
constexpr std::size_t triangle_size = 50;  // normal, three corners, two bytes of attributes

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw MeshError(path + ": cannot be opened: " + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  if (text.bad() || text.tellp() <= 0) throw MeshError(path + ": is empty or cannot be read");
  return std::move(text).str();
}

/// Triangles with corners at equal coordinates made one node.
class Builder {
 public:
  explicit Builder(double unit) : unit_(unit) {}

  [[nodiscard]] int count() const { return static_cast<int>(surface_.elements.size()); }

  void add(const std::array<Vector3, 3>& corners) {
    SurfaceElement triangle{.element = count()};
    for (int i = 0; i < 3; ++i) triangle.nodes[i] = node(corners[i]);
    const auto& [a, b, c, unused] = triangle.nodes;
    if (a == b || b == c || c == a) {
      throw MeshError("triangle " + std::to_string(count()) + ": two corners are the same point");
    }
    surface_.elements.push_back(triangle);
  }

  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::uint64_t word : key) hash = (std::rotl(hash, 23) ^ word) * 0x9e3779b97f4a7c15U;
      return hash ^ hash >> 32;
    }
  };

  int node(const Vector3& corner) {
    const Vector3 at = unit_ * corner + Vector3::Zero();  // the sum makes −0 equal to 0
    if (!at.allFinite()) {
      throw MeshError("triangle " + std::to_string(count()) + ": a coordinate is not finite");
    }
    const Key key{std::bit_cast<std::uint64_t>(at.x()), std::bit_cast<std::uint64_t>(at.y()),
                  std::bit_cast<std::uint64_t>(at.z())};
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<int>(surface_.nodes.size()));
    if (is_new) surface_.nodes.push_back(at);
    return entry->second;
  }

  double unit_;
  std::unordered_map<Key, int, Hash> numbers_;
  Surface surface_;
};

/// Little-endian, whatever the machine.
std::uint32_t word_at(std::string_view file, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(file[offset + i]);
  return word;
}

void read_binary(std::string_view file, Builder& builder) {
  const std::size_t count = word_at(file, 80);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t offset = header_size + t * triangle_size + 12;
    std::array<Vector3, 3> corners;
    for (std::size_t i = 0; i < 9; ++i) {
      corners[i / 3][static_cast<int>(i % 3)] = std::bit_cast<float>(word_at(file, offset + 4 * i));
    }
    builder.add(corners);
  }
}

/// Words of a text file, in lower case; remembers the line.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  [[nodiscard]] int line() const { return line_; }

  /// Empty at the end of the file.
  std::string next() {
    while (!rest_.empty() && is_space(rest_.front())) skip();
    std::string word;
    for (; !rest_.empty() && !is_space(rest_.front()); skip()) word += lower(rest_.front());
    return word;
  }

  void skip_line() {
    while (!rest_.empty() && rest_.front() != '\n') skip();
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

  void skip() {
    line_ += rest_.front() == '\n';
    rest_.remove_prefix(1);
  }

  std::string_view rest_;
  int line_ = 1;
};

[[noreturn]] void refuse_word(const std::string& word, const std::string& expected) {
  throw MeshError("expected " + expected + ", found " + (word.empty() ? "the end of the file" : word));
}

void expect(Words& words, std::string_view phrase) {
  for (Words expected(phrase);;) {
    const std::string wanted = expected.next();
    if (wanted.empty()) return;
    const std::string word = words.next();
    if (word != wanted) refuse_word(word, wanted);
  }
}

double number(Words& words) {
  const std::string word = words.next();
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  double value = 0;
  const auto [last, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && last == end) return value;
  if (error == std::errc::result_out_of_range) refuse_word(word, "a number within the range of double");
  refuse_word(word, "a number");
}

/// The normal in the file is often wrong or zero; the corners say where outside is.
void read_facet(Words& words, Builder& builder) {
  expect(words, "normal");
  for (int i = 0; i < 3; ++i) static_cast<void>(number(words));
  expect(words, "outer loop");
  std::array<Vector3, 3> corners;
  for (Vector3& corner : corners) {
    expect(words, "vertex");
    for (double& coordinate : corner) coordinate = number(words);
  }
  expect(words, "endloop endfacet");
  builder.add(corners);
}

/// One "solid … endsolid" or several, the patches of one surface.
void read_text(Words& words, Builder& builder) {
  for (std::string word = words.next(); !word.empty(); word = words.next()) {
    if (word != "solid") refuse_word(word, "solid or the end of the file");
    words.skip_line();
    for (word = words.next(); word != "endsolid"; word = words.next()) {
      if (word != "facet") refuse_word(word, "facet or endsolid");
      read_facet(words, builder);
    }
    words.skip_line();
  }
}

/// Binary files may begin with "solid" too, so their length decides.
bool is_binary(std::string_view file) {
  if (file.size() >= header_size && file.size() == header_size + triangle_size * word_at(file, 80)) {
    return true;
  }
  return Words(file.substr(0, header_size)).next() != "solid" || file.find('\0') != file.npos;
}

void check_length(std::string_view file) {
  if (file.size() < header_size) {
    throw MeshError("truncated: neither text that begins with solid nor a whole binary header");
  }
  const std::size_t count = word_at(file, 80), expected = header_size + triangle_size * count;
  if (file.size() == expected) return;
  throw MeshError((file.size() < expected ? "truncated: " : "trailing data: ") + std::to_string(count) +
                  " triangles take " + std::to_string(expected) + " bytes, the file has " +
                  std::to_string(file.size()));
}

}  // namespace

Surface read_stl(const std::string& path, double unit) {
  detail::require_positive("unit", unit);
  const std::string file = contents(path);
  Builder builder(unit);
  if (is_binary(file)) {
    try {
      check_length(file);
      read_binary(file, builder);
    } catch (const MeshError& error) {
      throw MeshError(path + ": " + error.what());
    }
  } else {
    Words words(file);
    try {
      read_text(words, builder);
    } catch (const MeshError& error) {
      throw MeshError(path + ":" + std::to_string(words.line()) + ": " + error.what());
    }
  }
  try {
    check_closed(builder.surface());
  } catch (const MeshError& error) {
    throw MeshError(path + ": " + error.what());
  }
  return builder.surface();
}

}  // namespace clatter::numeric
