// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/digest.hpp"

#include <array>
#include <fstream>
#include <vector>

#include "validation/output/bad_input.hpp"

namespace clatter::validation::inline output {
namespace {

constexpr std::size_t word_bytes = 8;
/// Of each byte, what it leaves of the remainder when 0 to 7 bytes follow.
using Tables = std::array<std::array<std::uint64_t, 256>, word_bytes>;

constexpr Tables make_tables() {
  constexpr std::uint64_t polynomial = 0xC96C5795D7870F42U;  // ECMA-182, lowest power last
  Tables tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = remainder >> 1 ^ (remainder & 1) * polynomial;
    tables[0][byte] = remainder;
  }
  for (std::size_t i = 1; i < word_bytes; ++i) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint64_t before = tables[i - 1][byte];
      tables[i][byte] = before >> 8 ^ tables[0][before & 255];
    }
  }
  return tables;
}

constexpr Tables tables = make_tables();

std::uint64_t byte_at(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

}  // namespace

/// A word at a time: eight look-ups that do not wait for each other.
void Digest::add(std::string_view bytes) {
  for (; bytes.size() >= word_bytes; bytes.remove_prefix(word_bytes)) {
    std::uint64_t word = remainder_;
    for (std::size_t i = 0; i < word_bytes; ++i) word ^= byte_at(bytes, i) << (8 * i);
    remainder_ = 0;
    for (std::size_t i = 0; i < word_bytes; ++i) remainder_ ^= tables[word_bytes - 1 - i][word >> (8 * i) & 255];
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    remainder_ = remainder_ >> 8 ^ tables[0][(remainder_ ^ byte_at(bytes, i)) & 255];
  }
}

std::uint64_t file_digest(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw BadInput(path + ": cannot be read");
  Digest digest;
  std::vector<char> block(1 << 20);
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.add({block.data(), static_cast<std::size_t>(file.gcount())});
  } while (file);
  if (file.bad()) throw BadInput(path + ": cannot be read");
  return digest.value();
}

}  // namespace clatter::validation::inline output
