// SPDX-License-Identifier: GPL-3.0-or-later
// The contents of a file, and its words if it is text.
#pragma once

#include <string>
#include <string_view>

namespace clatter::numeric {

/// All of a file, without the byte order mark of a text in UTF-8.
/// @throws MeshError naming the file: it cannot be opened, is a folder or a pipe, is empty, cannot be read.
[[nodiscard]] std::string file_contents(const std::string& path);

/// Words of a text; knows the line.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The line in which the last word stands.
  [[nodiscard]] int line() const;
  /// Empty at the end of the text.
  std::string_view next();
  /// Empty at the end of the line; what follows # there is no word.
  std::string_view next_on_line();
  /// Goes on behind the end of the line.
  void skip_line();
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  /// Bytes before what follows.
  [[nodiscard]] std::size_t place() const { return at_; }

  /// @throws MeshError with the word, unless the next is a number within the range of double
  double number();
  double number_on_line();
  long long whole();

 private:
  std::string_view word();

  std::string_view text_;
  std::size_t at_ = 0, word_ = 0;  ///< places of what follows, and of the last word
};

/// Whether a word is `name`, in small letters, or that in others.
[[nodiscard]] bool is_word(std::string_view word, std::string_view name);

/// A number that a word is.  @throws MeshError
[[nodiscard]] double number_of(std::string_view word);
[[nodiscard]] long long whole_number_of(std::string_view word);
/// @throws MeshError "expected …, found …"
[[noreturn]] void refuse_word(std::string_view word, const std::string& expected);

}  // namespace clatter::numeric
