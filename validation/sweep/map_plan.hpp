// SPDX-License-Identifier: GPL-3.0-or-later
// A map of outcomes: which drop each of its pixels is, and what is asked of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analytic/batch/batch.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_plan.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

/// A quantity that a map may show.
struct MapQuantity {
  const char* name;
  const char* words;  ///< of the legend
  const char* unit;   ///< empty: none
  /// None: it is a class.
  double (*number)(const analytic::BatchOutcome&);

  [[nodiscard]] bool is_class() const { return !number; }
  /// Whether drops are followed until they lie still, as with run.until_rest.
  [[nodiscard]] bool tells_rest() const { return std::string_view(name) == "rest_face"; }
};
[[nodiscard]] const std::vector<MapQuantity>& map_quantities();

/// How a drop's sequence ends, as maps say it.
[[nodiscard]] const char* end_words(analytic::BatchEnd end);

/// All columns of a map's CSV that are not its keys.
[[nodiscard]] std::vector<Column> map_columns();

struct MapRequest {
  std::string file;  ///< empty: a thin rod
  std::vector<std::string> over, sets;
  std::string quantity = "impacts";  ///< with samples "NAME=CLASS"
  long long columns = 800, rows = 600;
  std::optional<int> samples;  ///< for each pixel
  std::optional<int> seed;
};

/// The options that fill it, but for values.
[[nodiscard]] Arguments map_arguments(MapRequest& request);

/// Impacts that are followed where run.impacts is not given.
inline constexpr int uncapped_impacts = 100;

struct MapPlan {
  SweepPlan sweep;  ///< whose first two axes are those of the map, the others random
  const MapQuantity* quantity = nullptr;
  std::string wanted;  ///< with samples: the class whose probability is asked for
  /// Impacts to follow for a class of counts, "3" or ">=3".  Which it is follows from one impact more, or that many,
  /// whatever run.impacts.
  std::optional<int> wanted_count;
  long long columns = 0, rows = 0;
  long long samples = 0;  ///< for each pixel; 0: the pixel's drop itself
  analytic::BatchRequest request;

  [[nodiscard]] const SweepAxis& across() const { return sweep.points.axes()[0]; }
  [[nodiscard]] const SweepAxis& upward() const { return sweep.points.axes()[1]; }
  /// Where the middle of column i (row j, from below) lies.
  [[nodiscard]] double x(long long i) const;
  [[nodiscard]] double y(long long j) const;
  [[nodiscard]] bool counts() const { return samples > 0; }
  [[nodiscard]] bool wants_at_least() const { return wanted.starts_with(">="); }
  /// The report without rows: a map is told by its head.
  [[nodiscard]] Report report() const;
};

/// @throws BadInput with one line.
[[nodiscard]] MapPlan read_map_plan(const MapRequest& request);

// How the pixels of a map are computed: planar drops by the batch, all others one by one.

/// How the rows of a map are written: as CSV, a line for each pixel; or for the picture, a line for each row.
enum class MapForm { csv, compact };

/// A pixel as it is written: a class or number, empty where there is none; with samples, how many are of the class.
struct MapPixel {
  std::string value;
  bool is_open = false;  ///< marked by a star in the compact form
};

/// A runner of rows of the map for each thread; a row is one "scene" of the queue.
[[nodiscard]] MakeCompute map_runners(const MapPlan& plan, const SweepBody& body, MapForm form);
/// Rows handed out at a time.
[[nodiscard]] long long map_range(const MapPlan& plan);

/// The pixels of a line of the compact form.
[[nodiscard]] std::vector<MapPixel> read_map_row(const std::string& line);

}  // namespace clatter::validation
