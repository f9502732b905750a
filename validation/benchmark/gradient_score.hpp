// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives that a foreign list of impacts gives, judged.
#pragma once

#include <string>
#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation::inline benchmark {

/// Names in a header that are columns of derivatives: "dV/dangle", "dPz/dtilt", …: of a number of the list with respect
/// to the angle, in space the tilt, the speed, restitution or friction; of turns per radian, of the speed at the first
/// touch.
[[nodiscard]] std::vector<std::string> gradient_columns_of(const std::vector<std::string>& header, bool in_space);

/// Judges the columns of derivatives of a list whose impacts are scored: a cell is a number, or "none" where there is
/// no derivative, as at a fold.  Sets Score::gradient_error, of a derivative over the largest of its column, at least
/// the size of its number; unknown for a number where there is none and the other way round.
/// @param columns  as gradient_columns_of(), read as words
/// @throws BadInput for a cell that is neither
void score_gradients(const Answer& answer, const std::vector<std::string>& columns, const Reference& reference,
                     Score& score);

}  // namespace clatter::validation::inline benchmark
