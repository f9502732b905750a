// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the simulator.  A broken contract is std::domain_error or std::invalid_argument, a run that
// ends early is an outcome beside its rows (simulate.hpp); the two classes below are what is left.
#pragma once

#include <stdexcept>

namespace clatter::numeric {

/// A mesh or surface that cannot be the body of a simulation: inverted, degenerate, open, non-manifold,
/// unreadable.  The message names the element, face or line (exit status 2 of the program).
class MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number could not be computed (exit status 3 of the program).
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Refusal of arguments that break a contract.
namespace detail {

/// @throws std::domain_error "field = value: must be allowed" unless `condition` holds and `value` is finite.
void require(bool condition, const char* field, double value, const char* allowed);
void require_positive(const char* field, double value);  ///< greater than 0 and finite
void require_at_least(const char* field, int value, int least);

}  // namespace detail

}  // namespace clatter::numeric
