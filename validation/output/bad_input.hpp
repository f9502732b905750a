// SPDX-License-Identifier: GPL-3.0-or-later
// What the user gave and cannot be used: one line, exit status 2.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace clatter::validation::inline output {

class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate nearest to `name` by edit distance.
[[nodiscard]] std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace clatter::validation::inline output
