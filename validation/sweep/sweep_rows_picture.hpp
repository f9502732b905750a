// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of `clatter sweep` as a picture.
#pragma once

#include <string>
#include <vector>

#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

/// What a picture of a sweep shows.
struct SweepRowsView {
  std::size_t first_swept = 1, swept = 0;  ///< columns of the keys that were swept
  bool random = false;                     ///< values without order
  std::vector<std::string> quantities;     ///< columns to draw, a panel each
};

/// Whether a column has texts, which are not drawn.
[[nodiscard]] bool holds_texts(const Grid& grid, const std::string& column);

/// One key swept: each quantity over it.  Two keys, of which one has few values: a curve for each of these.
/// Otherwise, and of random values: how many scenes have which value, in forty classes of equal width.
/// @param report of the sweep, with its rows; those without a number are left out.
[[nodiscard]] Picture sweep_rows_picture(const Report& report, const SweepRowsView& view);

}  // namespace clatter::validation
