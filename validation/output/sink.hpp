// SPDX-License-Identifier: GPL-3.0-or-later
// Where output goes: stdout, a device, or a file that appears whole or not at all.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

#include "validation/output/run_files.hpp"

namespace clatter::validation::inline output {

/// Nobody reads any more what is written to a pipe: the end of the run, but no failure.
class ReaderGone : public std::runtime_error {
 public:
  ReaderGone() : std::runtime_error("nobody reads the output any more") {}
};

/// Stdout; or a device, FIFO or open file (-, /dev/stdout, /dev/fd/N), which is written in place; or a new file in the
/// folder of the one that it replaces in commit(), at the end of all symbolic links.  Not committed (an error or a
/// signal on the way), the new file is removed and what was there before stays.
class Sink {
 public:
  /// @param path empty: stdout.
  /// @param option that named the file, for messages.  @throws BadInput if the file cannot be created.
  explicit Sink(const std::string& path, const std::string& option = "--output");
  ~Sink();
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  /// Both throw BadInput naming the file, or std::runtime_error naming stdout, if it cannot be written; ReaderGone.
  void write(std::string_view text);
  void commit();
  /// Whether nothing can be seen of what is written before commit().
  [[nodiscard]] bool is_file() const { return !temporary_.empty(); }

 private:
  void open_stream(const Destination& destination);
  void open_temporary();
  [[noreturn]] void fail(const char* what) const;

  std::string path_, option_;
  Destination destination_;
  std::string temporary_;
  std::FILE* stream_ = nullptr;
};

}  // namespace clatter::validation::inline output
