// SPDX-License-Identifier: GPL-3.0-or-later
// What explains a foreign run that fails.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/benchmark/score.hpp"

namespace clatter::validation {

/// A hypothesis that explains a run, where the problem's own statement does not.
struct Cause {
  std::string name;             ///< "restitution", "inertia", "phi-sign", …
  std::optional<double> value;  ///< the number that explains the run, in SI units; nothing: the hypothesis has none
  double misfit = 0;            ///< the relative error that is left with it
  std::string words;            ///< one line
  bool is_more = false;         ///< holds beside the cause before it, not in place of it
};

/// A run as its file has it.
struct Answer {
  const NumericTable& table;
  bool is_list = false;               ///< of impacts, not a motion
  bool is_counter_clockwise = false;  ///< what a list's Omega counts as positive
  Ending ending{};
};

/// The part of a run's error that a hypothesis may leave.
inline constexpr double explained = 0.05;

/// A number and what is left with it.
struct Fitted {
  double value = 0, misfit = Score::unknown;
};

/// Three significant digits.
[[nodiscard]] std::string three_digits(double value);

/// "to 2e-16": the misfit of a hypothesis, for its words.
[[nodiscard]] std::string misfit_words(double misfit);

}  // namespace clatter::validation
