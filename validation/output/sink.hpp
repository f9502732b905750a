// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run: where output goes (stdout, a device, or a file that appears whole or not at all), where names
// lead, and that no output is an input.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clatter::validation {

/// A file that a run writes; an empty path: none.
struct RunFile {
  std::string option;  ///< that names the file, for messages
  std::string path;
};

/// Where an output goes, once symbolic links are followed.
struct Destination {
  std::string path;                 ///< a file to replace or to make; of a stream the path as given
  bool is_stream = false;           ///< device, FIFO or open file: written in place, from one end to the other
  int open_file = -1;               ///< the descriptor that -, /dev/stdout, /dev/fd/N or /proc/self/fd/N means
  std::optional<mode_t> mode = {};  ///< permissions of a file that is there
};

/// @throws BadInput naming option and path if no file of this name can be written: a folder, a name too long, a folder
/// that is not there.
[[nodiscard]] Destination destination_of(const RunFile& file);

/// Makes sure that a file can be written before a run begins, and leaves everything as it was.  @throws BadInput
void require_writable(const RunFile& file);

/// Keeps inputs from being written over, in one run of the program: each file is noted where it is opened, so that a
/// command that reads one more needs no rule of its own.  Files are compared by device and inode, those that are not
/// there yet by their folder and name, so that neither spelling nor links hide one.  Character devices hold nothing
/// that could be lost and are never refused.  Nothing is noted where no run is under way, as in a server or a library
/// whose caller may read what was written before.
class NotedFiles {
 public:
  NotedFiles();
  ~NotedFiles();
  NotedFiles(const NotedFiles&) = delete;
  NotedFiles& operator=(const NotedFiles&) = delete;
};

/// The run that is under way reads this file, or is about to.  @throws BadInput if it writes it.
void note_read(const std::string& path);
/// It writes this file, as each Sink does.  @throws BadInput if it reads the file, or writes it under another name.
void note_written(const RunFile& file);

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

  /// Both throw BadInput naming the file or stdout if it cannot be written; ReaderGone.
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

}  // namespace clatter::validation
