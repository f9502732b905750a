// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of scenes without numbers, or with fewer than asked for.
#pragma once

#include <string>

namespace clatter::validation {

/// In lines; empty: nothing.
struct ScenesTold {
  std::string fell_short{};  ///< exit status 3
  std::string set_aside{};   ///< refused, then outside the model: rows like others, which leave the status

  void say() const;
};

}  // namespace clatter::validation
