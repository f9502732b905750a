// Where output goes: stdout, or a file that appears whole or not at all.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace clatter::validation {

/// Stdout, or a new file beside its final name that takes this name in commit().  Not committed (an
/// error or an interrupt on the way), the file is removed and what was there before stays.
class Sink {
 public:
  /// @param path empty: stdout.
  /// @param option that named the file, for messages.  @throws BadInput if the file cannot be created.
  explicit Sink(const std::string& path, const std::string& option = "--output");
  ~Sink();
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  /// @throws BadInput naming the file if it cannot be written.
  void write(std::string_view text);
  void commit();
  [[nodiscard]] bool is_file() const { return !path_.empty(); }

 private:
  [[noreturn]] void fail(const char* what) const;

  std::string path_;
  std::string option_;
  std::string temporary_;
  std::FILE* stream_;
};

}  // namespace clatter::validation
