// SPDX-License-Identifier: GPL-3.0-or-later
// The command line, read with CLI11, which only this parser knows.
#pragma once

#include <string>
#include <vector>

#include "validation/command/command.hpp"

namespace clatter::validation {

/// What the arguments ask for: a command whose targets are set, or a text to print (help, version).
struct ParsedLine {
  const Command* command = nullptr;
  std::string text{};
  std::string note{};  ///< to be said at the end: the command was called by a name that it no longer has
};

inline constexpr const char* program_summary = "impact sequences of falling rigid bodies";
/// What --help says of the program as a whole.
inline constexpr const char* program_notes = R"(Example: clatter sequence --angle 10

clatter help COMMAND, or clatter COMMAND --help, tells more; clatter help scene explains the flags of scenes.

Exit status:
  0                    done
  1                    a check failed
  2                    bad input
  3                    a number could not be computed
  4                    outside the model's range, such as jamming
  70                   a defect of the program
  130                  interrupted

Environment:
  NO_COLOR, TERM=dumb  no colours and no progress, nor are any off a terminal)";

/// @throws BadInput with one line.
[[nodiscard]] ParsedLine parse_line(const std::vector<Command>& commands, const std::vector<std::string>& arguments);

}  // namespace clatter::validation
