// The file that a sweep writes, and the part of it that an interrupted run leaves.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace clatter::validation {

/// What the file of a sweep must be.
struct SweepFileForm {
  std::string head;               ///< its first lines
  long long scenes = 0;           ///< how many it will hold
  bool one_row_per_scene = true;  ///< else a scene's last row is known by the next scene's first
};

/// FILE.part, which grows by whole scenes and takes the name FILE in commit().  Whatever ends the program leaves the
/// part, and the next object takes up after its last complete scene.  No two programs write one part.
class SweepFile {
 public:
  /// @param restart begins anew, whatever is in the part.
  /// @throws BadInput with one line if the part belongs to another sweep, is damaged or in use, or a file cannot be
  ///         written.
  SweepFile(const std::string& path, const SweepFileForm& form, bool restart);
  ~SweepFile();
  SweepFile(const SweepFile&) = delete;
  SweepFile& operator=(const SweepFile&) = delete;

  /// Scenes that the part held already: the next row is that of scene number scenes().
  [[nodiscard]] long long scenes() const { return scenes_; }
  /// Takes rows of whole scenes, or none; they are in the file after half a second or a mebibyte, or after flush().
  /// @throws BadInput if they cannot be written.
  void write(std::string_view rows);
  void flush();
  /// Ends the file and gives it its name.
  void commit();

 private:
  void open();
  void take_up(const SweepFileForm& form);
  [[noreturn]] void fail(const char* what) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::string path_, part_;
  int descriptor_ = -1;
  long long scenes_ = 0;
  std::string pending_;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace clatter::validation
