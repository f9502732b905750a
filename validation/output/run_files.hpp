// SPDX-License-Identifier: GPL-3.0-or-later
// The files of one run: where their names lead, and that no two of them are one.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace clatter::validation::inline output {

/// A file that a run reads or writes; an empty path: none.
struct RunFile {
  std::string option;  ///< that names the file, or words for messages, such as "the scene file"
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

/// The rule that keeps a scene, its mesh and each output from being written over.  Files are compared by device and
/// inode, those that are not there yet by their folder and name, so that neither spelling nor links hide one. Character
/// devices hold nothing that could be lost and are never refused.
/// @throws BadInput if a file of `written` is one of `read`, or is written twice.
void refuse_shared_files(const std::vector<RunFile>& written, const std::vector<RunFile>& read);

}  // namespace clatter::validation::inline output
