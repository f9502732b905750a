// SPDX-License-Identifier: GPL-3.0-or-later
// A file of columns: rows of a sweep as HDF5, which h5py and pandas read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "validation/output/cells.hpp"
#include "validation/output/report.hpp"
#include "validation/sweep/scenes_told.hpp"

namespace clatter::validation {

/// What a file of columns begins with.
struct ColumnFileHead {
  std::vector<Column> columns;
  std::vector<std::string> truths{};                            ///< names of those that say true or false
  std::vector<std::pair<std::string, std::string>> attributes;  ///< of the whole file: title, scene, ...
  long long rows = 0;                                           ///< how many are to come, for the size of its chunks
  ScenesTold told{};                                            ///< of its scenes
};

/// A file that takes rows and holds columns.
class ColumnFile {
 public:
  ColumnFile() = default;
  ColumnFile(const ColumnFile&) = delete;
  ColumnFile& operator=(const ColumnFile&) = delete;
  virtual ~ColumnFile() = default;
  virtual void add(const std::vector<PackedCell>& row) = 0;
  /// Writes what is left.  @throws std::runtime_error if the file cannot be written
  virtual void close() = 0;
};

/// @throws BadInput where the program was built without HDF5
void require_hdf5();
/// Opens an HDF5 file, made anew.  The library comes from a module beside the program, so that no other run waits for
/// it.  One dataset a column, at most 65,536 rows a chunk: numbers as 64-bit floating point, NaN where there is
/// nothing; texts as numbers of the texts in the dataset words/COLUMN, truths as 8-bit integers 1 and 0, −1 where there
/// is nothing.  Each has its unit and its meaning as attributes.
/// @throws BadInput where the program was built without HDF5, std::runtime_error if the file cannot be written
[[nodiscard]] std::unique_ptr<ColumnFile> open_hdf5(const std::string& path, const ColumnFileHead& head);
/// What stands in an HDF5 file of the attributes that such a head has, what is told, and as `rows` the scene of its
/// last row; none: there is no such file.
[[nodiscard]] std::optional<ColumnFileHead> read_hdf5_head(const std::string& path, ColumnFileHead head);

}  // namespace clatter::validation
