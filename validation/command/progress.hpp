// SPDX-License-Identifier: GPL-3.0-or-later
// Progress on stderr.
#pragma once

#include <chrono>
#include <string>

namespace clatter::validation {

/// A line on stderr that renews itself, for runs that last; nothing where progress is not shown.
class Progress {
 public:
  void show(const std::string& text);
  /// ", 40 s left" by the pace so far; empty in the first two seconds, in which nothing is known of it.
  [[nodiscard]] std::string time_left(std::size_t done, std::size_t of) const;
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

 private:
  bool shown_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "#####......... 5 of 14".
[[nodiscard]] std::string progress_bar(std::size_t done, std::size_t of);

/// "40 s left".
[[nodiscard]] std::string time_left(double seconds);

}  // namespace clatter::validation
