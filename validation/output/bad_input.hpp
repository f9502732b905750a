// SPDX-License-Identifier: GPL-3.0-or-later
// Words to the user, on stderr; what was given and cannot be used: one line, exit status 2.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace clatter::validation {

class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate nearest to `name` by edit distance, of those that have it as a part if there are any.
[[nodiscard]] std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

/// Writes "clatter: WORDS" as one line, foreign characters printable.  Nobody may be there to read (stderr closed, full
/// or hung up), which changes neither the run nor its status.
void say(const std::string& words);

}  // namespace clatter::validation
