// SPDX-License-Identifier: GPL-3.0-or-later
// What an exception says of a run: one classification for the command line, sweeps, the server and Python.
#pragma once

#include <new>
#include <optional>
#include <string>

namespace clatter::validation {

enum class FailureKind {
  bad_input,      ///< what was given cannot be used
  not_computed,   ///< a number could not be computed
  outside_model,  ///< the model does not hold there, as with jamming
  defect,         ///< the program broke a contract of its own
};

struct Failure {
  FailureKind kind = FailureKind::defect;
  std::string message;  ///< one line
};

/// The exit status of a run whose models disagree, whose check fails or whose requirement is not met.
inline constexpr int check_failed = 1;

/// The failure of the exception that is being handled.  A std::domain_error is a value that a library refuses, any
/// other std::logic_error a defect.  @pre called in a handler
[[nodiscard]] Failure current_failure();

/// Computes one scene among many.  @returns why it failed; nothing if it did not.
/// @throws what is not the scene's fault: a defect, or memory that is lacking, which another time may be there
[[nodiscard]] std::optional<Failure> failure_of_scene(auto&& compute) {
  try {
    compute();
    return {};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    Failure failure = current_failure();
    if (failure.kind == FailureKind::defect) throw;
    return failure;
  }
}

/// 2, 3, 4 or 70.
[[nodiscard]] int exit_status(FailureKind kind);

}  // namespace clatter::validation
