// SPDX-License-Identifier: GPL-3.0-or-later
// The file that a sweep writes, and the part of it that an interrupted run leaves.
#pragma once

#include <boost/crc.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/output/bad_input.hpp"
#include "validation/output/sink.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {

// Digests that tell whether bytes are still the same.

/// CRC-64/XZ: any damage within 64 bits in a row is noticed, any other but with a chance of 5e-20.  No secret, so that
/// it guards against accidents and not against intent.
class Digest {
 public:
  void add(std::string_view bytes) { crc_.process_bytes(bytes.data(), bytes.size()); }
  [[nodiscard]] std::uint64_t value() const { return crc_.checksum(); }

 private:
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693U, 0xFFFFFFFFFFFFFFFFU, 0xFFFFFFFFFFFFFFFFU, true, true> crc_;
};

/// The digest of a file's contents.  @throws BadInput naming the file if it cannot be read.
[[nodiscard]] std::uint64_t file_digest(const std::string& path);

/// What the file of a sweep must be.
struct SweepFileForm {
  std::string head;      ///< its first lines
  long long scenes = 0;  ///< how many it will hold
};

/// The rows that a file of a sweep has.
struct FoundRows {
  long long scenes = 0;                ///< that have rows
  long long last = -1;                 ///< the scene of the last row before whatever is amiss; -1: none
  std::vector<std::string> missing{};  ///< scenes without rows: "7", "200 to 399"
  std::vector<std::string> cut{};      ///< scenes that have some of their rows
  std::vector<SceneRange> there{};     ///< places of those that have all, in runs
  std::string amiss{};                 ///< what else is wrong, in words; the rows from there on are not looked at

  [[nodiscard]] bool is_whole() const { return missing.empty() && cut.empty() && amiss.empty(); }
};

/// The rows that it should have.
struct ExpectedRows {
  PickedScenes scenes;
  std::function<std::string(long long scene)> begins{};  ///< what a scene's rows begin with: its number and its keys
  /// Place of the column that tells how many rows a scene has, numbered from 1 behind what they begin with, but for a
  /// last one without a number; none: it has one.
  std::optional<std::size_t> scene_rows{};
};

/// Reads rows up to the end of the file, and calls take(row) with each that is in its place.
[[nodiscard]] FoundRows find_rows(std::istream& rows, const ExpectedRows& expected,
                                  const std::function<void(std::string_view row)>& take);

/// A file that a run would overwrite is there, and is not its own.
struct OtherFileThere : BadInput {
  /// @param is  what it is, in words behind "is there already,"
  OtherFileThere(const std::string& path, const std::string& is)
      : BadInput("--output {}: is there already, {}; --restart overwrites it", path, is), words(is) {}
  std::string words;
};

/// "7" or "200 to 399".
[[nodiscard]] std::string scene_run(long long first, long long last);

/// Whether a file that is in the place of FILE, and not empty, has the whole of this head, behind which its rows are
/// read on; false: it ends within it.  Files of a scene, mesh or list that lay elsewhere count as the same.
/// @throws OtherFileThere if it is not that of this sweep or map
[[nodiscard]] bool is_own_file(const std::string& path, std::istream& there, const std::string& head);

/// FILE.part, which grows by whole scenes and takes the name FILE in commit(); FILE is where symbolic links lead.
/// Beside it FILE.part.digests has a line "bytes scenes digest" for each time that rows were written: how far the part
/// went then, and the digest of all of it and of these two numbers.  Whatever ends the program leaves both, and the
/// next object takes up after the last rows that are as their digest says; rows after them are computed anew.  No two
/// programs write one part.
class SweepFile {
 public:
  /// @param restart begins anew, whatever is in the part.
  /// @throws BadInput with one line if the part belongs to another sweep or is in use, or a file cannot be written.
  SweepFile(const std::string& path, const SweepFileForm& form, bool restart);
  ~SweepFile();
  SweepFile(const SweepFile&) = delete;
  SweepFile& operator=(const SweepFile&) = delete;

  /// The files beside FILE, for note_written.
  [[nodiscard]] static std::vector<RunFile> files_beside(const std::string& path);

  /// How many scenes a part has by its digests; none: there is no such part, or none of them.
  [[nodiscard]] static std::optional<long long> begun_scenes(const std::string& part);

  /// Scenes that the part held already: the next row is that of scene number scenes().
  [[nodiscard]] long long scenes() const { return scenes_; }
  [[nodiscard]] const std::string& path() const { return destination_.path; }
  /// Takes the rows of so many whole scenes, or none; they are in the file after half a second or a mebibyte, or after
  /// flush().  @throws BadInput if they cannot be written.
  void write(std::string_view rows, long long scenes);
  /// Calls take(rows) with all rows that are in the part.
  void with_rows(const std::function<void(std::string_view rows)>& take) const;
  void flush();
  /// Ends the file and gives it its name.
  void commit();
  /// The same for a file of another form: make(path) writes that from with_rows().
  void commit(const std::function<void(const std::string& path)>& make);
  /// Removes the part, when what its rows were for is written elsewhere.
  void discard();

 private:
  void open();
  void take_up(const SweepFileForm& form);
  /// The head of the part, which says what this one says; empty: it ends within it.
  /// @throws BadInput at another one
  [[nodiscard]] std::string own_head(const std::string& head) const;
  void keep_whole_rows(const SweepFileForm& form);
  void close_all();
  void put_in_place(const std::string& file);
  [[noreturn]] void fail(const std::string& file, const char* what) const;
  [[noreturn]] void refuse(const std::string& why) const;

  std::string path_;
  Destination destination_;
  std::string part_, digests_;
  int part_file_ = -1, digests_file_ = -1;
  bool is_own_ = false;       ///< the part was taken up, and is nothing to be kept while no scene is in it
  long long scenes_ = 0;      ///< in the part
  long long bytes_ = 0;       ///< of the part
  long long head_bytes_ = 0;  ///< of its head
  Digest digest_;             ///< of the part
  std::string pending_;
  long long pending_scenes_ = 0;
  std::chrono::steady_clock::time_point flushed_;
};

}  // namespace clatter::validation
