// SPDX-License-Identifier: GPL-3.0-or-later
// The whole program as a function: its commands, the command line, read with CLI11, which the parser alone knows, and
// what becomes of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/command/command.hpp"

namespace clatter::validation {

/// All commands, in the order of the help.
[[nodiscard]] const std::vector<Command>& all_commands();

/// Gives way to clatter-mpi where mpirun started the program (become_mpi_program()).
void hand_over(char** words);

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

/// Thrown, before anything is written, by a program that comes before the whole one and lacks what a scene needs.
struct LeftToNextProgram {};

/// Runs the program that has these commands with the arguments after its name; returns the exit status: 0 done, 1 a
/// check failed, 2 bad input, 3 a number could not be computed, 4 outside the model's range, 70 a defect of the
/// program, 75 left to the next program, which the launcher then builds, 130 interrupted.
[[nodiscard]] int run_program(const std::vector<Command>& commands, const std::vector<std::string>& arguments);

/// The status of `run`; an exception becomes one line on stderr and the status of its kind.
[[nodiscard]] int guarded(const std::function<int()>& run);

}  // namespace clatter::validation
