// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/files/file_text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "numeric/base/errors.hpp"

namespace clatter::numeric {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string file_contents(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw MeshError(path + ": is a folder and cannot be read");
  // A pipe would be waited for, and what is read of it is gone.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw MeshError(path + ": is no file on a disk, but a pipe or a device");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw MeshError(path + ": cannot be opened: " + std::strerror(errno));
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size == 0) throw MeshError(path + ": is empty");
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  if (error || !file.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw MeshError(path + ": cannot be read");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.empty()) throw MeshError(path + ": is empty");
  return text;
}

int Words::line() const {
  return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(word_), '\n'));
}

std::string_view Words::word() {
  word_ = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return text_.substr(word_, at_ - word_);
}

std::string_view Words::next() {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  return word();
}

std::string_view Words::next_on_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && is_space(text_[at_])) ++at_;
  if (at_ < text_.size() && text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
  return word();
}

void Words::skip_line() {
  const std::size_t end = text_.find('\n', at_);
  at_ = end == std::string_view::npos ? text_.size() : end + 1;
}

bool is_word(std::string_view word, std::string_view name) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return word.size() == name.size() &&
         std::equal(word.begin(), word.end(), name.begin(), [&](char a, char b) { return small(a) == b; });
}

void refuse_word(std::string_view word, const std::string& expected) {
  constexpr std::size_t longest = 40;
  throw MeshError("expected " + expected + ", found " +
                  (word.empty() ? std::string("the end of the file") : std::string(word.substr(0, longest))));
}

double number_of(std::string_view word) {
  const char* const begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* const end = word.data() + word.size();
  double value = 0;
  const auto [last, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && last == end) return value;
  if (error == std::errc::result_out_of_range) refuse_word(word, "a number within the range of double");
  refuse_word(word, "a number");
}

long long whole_number_of(std::string_view word) {
  long long value = 0;
  const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && last == word.data() + word.size()) return value;
  refuse_word(word, "a whole number");
}

double Words::number() { return number_of(next()); }
double Words::number_on_line() { return number_of(next_on_line()); }
long long Words::whole() { return whole_number_of(next()); }

}  // namespace clatter::numeric
