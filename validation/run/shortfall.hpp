// SPDX-License-Identifier: GPL-3.0-or-later
// Where a run falls short of what was asked of it: exit status 3.
#pragma once

#include <string>

#include "validation/run/run.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// What a run of the discrete model falls short of: in one line why there are fewer impacts than asked for, where a
/// number that could not be computed or a limit is the reason, or, with run.require_digits, that fewer digits are known
/// than asked for; empty: neither.
[[nodiscard]] std::string shortfall(const Scene& scene, const Run& run);
/// "asked 6 digits, achieved 4.2"; empty where the relative error gives the digits.
[[nodiscard]] std::string digits_shortfall(int asked, double achieved);

/// Counts what falls short among many runs, and keeps why the first of them does.
class Shortfalls {
 public:
  /// @param place  the run's value or number
  /// @param why  empty: it does not fall short
  void add(const std::string& place, const std::string& why);
  /// "2 of 9 values fall short; PLACE: WHY"; empty: none does.
  [[nodiscard]] std::string words(long long all, const char* what) const;
  /// Says so.  @returns 3, or 0 if none does
  [[nodiscard]] int status(long long all, const char* what) const;
  [[nodiscard]] long long count() const { return count_; }
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  long long count_ = 0;
  std::string first_;
};

/// Says why a run falls short, if it does.  @returns the exit status that goes with that, or 0
[[nodiscard]] int status_of(const std::string& why, int status = 3);

/// Exit status of a run of the discrete model that falls short: 4 where it leaves the model, else 3.
[[nodiscard]] int shortfall_status(const Run& run);

}  // namespace clatter::validation
