// SPDX-License-Identifier: GPL-3.0-or-later
// How the pixels of a map are computed: planar drops by the batch, all others one by one.
#pragma once

#include <string>
#include <vector>

#include "validation/sweep/map_plan.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {

/// How the rows of a map are written: as CSV, a line for each pixel; or for the picture, a line for each row.
enum class MapForm { csv, compact };

/// A pixel as it is written: a class or number, empty where there is none; with samples, how many are of the class.
struct MapPixel {
  std::string value;
  bool is_open = false;  ///< marked by a star in the compact form
};

/// The interval in which the probability lies with 95 %, from `hits` of `samples`.  Source: Wilson, J. Am. Stat. Assoc.
/// 22 (1927) 209.
struct Wilson {
  double part, low, high;

  Wilson(long long hits, long long samples);
};

/// A runner of rows of the map for each thread; a row is one "scene" of the queue.
[[nodiscard]] MakeCompute map_runners(const MapPlan& plan, const SweepBody& body, MapForm form);
/// Rows handed out at a time.
[[nodiscard]] long long map_range(const MapPlan& plan);

/// The pixels of a line of the compact form.
[[nodiscard]] std::vector<MapPixel> read_map_row(const std::string& line);

}  // namespace clatter::validation
