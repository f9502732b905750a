// SPDX-License-Identifier: GPL-3.0-or-later
// The whole program as a function.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/command/command.hpp"

namespace clatter::validation {

/// Runs the program that has these commands with the arguments after its name; returns the exit status: 0 done, 1 a
/// check failed, 2 bad input, 3 a number could not be computed, 4 outside the model's range, 70 a defect of the
/// program, 130 interrupted.
[[nodiscard]] int run_program(const std::vector<Command>& commands, const std::vector<std::string>& arguments);

/// The status of `run`; an exception becomes one line on stderr and the status of its kind.
[[nodiscard]] int guarded(const std::function<int()>& run);

}  // namespace clatter::validation
