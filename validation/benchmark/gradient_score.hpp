// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives that a foreign list of impacts gives, judged.
#pragma once

#include <string>
#include <vector>

#include "validation/benchmark/cause.hpp"

namespace clatter::validation {

/// A column of derivatives of a list: of a number with respect to one of the drop, the angle, in space the
/// tilt (both per radian), the speed at the first touch, restitution or friction.
struct GradientColumn {
  std::string name;  ///< in the header: "dV/dangle", "dPz/dtilt", …
  std::string number, parameter;
  std::size_t index = 0;  ///< of the number in gradient_numbers()
};
/// The columns of a header that are such.
[[nodiscard]] std::vector<GradientColumn> gradient_columns_of(const std::vector<std::string>& header, bool in_space);

/// Judges the columns of derivatives of a list whose impacts are scored: a cell is a number, or "none" where there is
/// no derivative, as at a fold.  Sets Score::gradient_error, of a derivative over the largest of its column, at least
/// the size of its number; unknown for a number where there is none and the other way round.
/// @param columns  as gradient_columns_of(), read as words
/// @throws BadInput for a cell that is neither
void score_gradients(const Answer& answer, const std::vector<GradientColumn>& columns, const Reference& reference,
                     Score& score);

}  // namespace clatter::validation
