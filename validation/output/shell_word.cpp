// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/shell_word.hpp"

#include "validation/output/report.hpp"

namespace clatter::validation::inline output {

std::string shell_word(const std::string& word) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,@%=:";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) {
    if (c == '\'') text += "'\\''";
    else text += c;
  }
  return text + "'";
}

std::string folded_command(const std::string& command, const std::string& indent, std::size_t width) {
  constexpr std::size_t mark = 2;  // a blank and a backslash
  std::string out, line, word;
  bool quoted = false;
  const auto take = [&] {
    if (!line.empty() && display_width(line) + 1 + display_width(word) + mark > width) {
      out += line + " \\\n";
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
    word.clear();
  };
  for (const char c : command) {
    if (c == '\'') quoted = !quoted;
    if (c == ' ' && !quoted) take();
    else word += c;
  }
  take();
  return out + line;
}

}  // namespace clatter::validation::inline output
