// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/digest.hpp"

#include <fstream>
#include <vector>

#include "validation/output/bad_input.hpp"

namespace clatter::validation {

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

}  // namespace clatter::validation
