// The whole program as a function.
#pragma once

#include <string>
#include <vector>

namespace clatter::validation {

/// Runs the program with the arguments after its name; returns the exit status: 0 done, 1 a check
/// failed, 2 bad input, 3 a number could not be computed, 4 outside the model's range, 130 interrupted.
[[nodiscard]] int run_program(const std::vector<std::string>& arguments);

}  // namespace clatter::validation
