// SPDX-License-Identifier: GPL-3.0-or-later
// Progress on stderr.
#pragma once

#include <string>

namespace clatter::validation::inline cli {

/// A line on stderr that renews itself, for runs that last; nothing where progress is not shown.
class Progress {
 public:
  void show(const std::string& text);
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

 private:
  bool shown_ = false;
};

/// "#####......... 5 of 14".
[[nodiscard]] std::string progress_bar(std::size_t done, std::size_t of);

}  // namespace clatter::validation::inline cli
