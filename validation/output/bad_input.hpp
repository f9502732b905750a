// SPDX-License-Identifier: GPL-3.0-or-later
// Words to the user, on stderr; what was given and cannot be used: one line, exit status 2.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace clatter::validation {

class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// Words with what was given put in.
  template <class... Given>
  requires(sizeof...(Given) > 0) explicit BadInput(fmt::format_string<Given...> words, Given&&... given)
      : std::runtime_error(fmt::format(words, std::forward<Given>(given)...)) {}
};

/// The candidate that may have been meant by `name`: the nearest by edit distance, of those that have it as a part if
/// there are any; none where that is too far.
[[nodiscard]] std::optional<std::string> near_name(const std::string& name, const std::vector<std::string>& candidates);
/// "; did you mean steel?"; where the candidates are few and none is near, these: "; there are steel, wood".
/// @param are_listed  the words before it have the candidates already, however many they are
[[nodiscard]] std::string suggestion(const std::string& name, const std::vector<std::string>& candidates,
                                     bool are_listed = false);

/// While such an object lives, what comes up in its thread is kept here in place of being written: the words of say(),
/// or the reports of write_report().  One at a time in a thread.
template <class What>
class Caught {
 public:
  Caught() { open = this; }
  ~Caught() { open = nullptr; }
  Caught(const Caught&) = delete;
  Caught& operator=(const Caught&) = delete;

  std::vector<What> all;
  static inline thread_local Caught* open = nullptr;
};

/// Writes "clatter: WORDS" as one line, foreign characters printable.  Nobody may be there to read (stderr closed, full
/// or hung up), which changes neither the run nor its status.
void say(const std::string& words);

}  // namespace clatter::validation
