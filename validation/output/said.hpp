// SPDX-License-Identifier: GPL-3.0-or-later
// What say() says, kept for a caller that has other words for it than a line on stderr.
#pragma once

#include <string>
#include <vector>

namespace clatter::validation {

/// While it lives, say() in its thread adds here in place of a line on stderr.  One at a time in a thread.
class CaughtWords {
 public:
  CaughtWords();
  ~CaughtWords();
  CaughtWords(const CaughtWords&) = delete;
  CaughtWords& operator=(const CaughtWords&) = delete;

  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }

 private:
  friend void say(const std::string& words);
  std::vector<std::string> words_;
};

}  // namespace clatter::validation
