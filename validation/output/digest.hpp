// SPDX-License-Identifier: GPL-3.0-or-later
// Digests that tell whether bytes are still the same.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <string>
#include <string_view>

namespace clatter::validation {

/// CRC-64/XZ: any damage within 64 bits in a row is noticed, any other but with a chance of 5e-20.  No secret, so that
/// it guards against accidents and not against intent.
class Digest {
 public:
  void add(std::string_view bytes) { crc_.process_bytes(bytes.data(), bytes.size()); }
  [[nodiscard]] std::uint64_t value() const { return crc_.checksum(); }

 private:
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693U, 0xFFFFFFFFFFFFFFFFU, 0xFFFFFFFFFFFFFFFFU, true, true> crc_;
};

/// The digest of a file's contents.  @throws BadInput naming the file if it cannot be read.
[[nodiscard]] std::uint64_t file_digest(const std::string& path);

}  // namespace clatter::validation
