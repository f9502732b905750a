// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the discrete model.  A broken contract is std::domain_error, a run that ends early is an
// outcome beside its rows (sequence.hpp); the two below are what is left.
#pragma once

#include <stdexcept>
#include <string>

namespace clatter::analytic {

/// A number could not be computed to the accuracy promised for it (exit status 3 of the program).
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The scene lies outside what the model can represent, such as jamming (exit status 4).
class OutsideModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace clatter::analytic

namespace clatter::analytic::detail {

// Refusal of arguments outside their domain.

/// @throws std::domain_error "FIELD = VALUE: must be ALLOWED".
[[noreturn]] void refuse(const std::string& field, double value, const char* allowed);

/// The same unless `holds`.
inline void require(bool holds, const char* field, double value, const char* allowed) {
  if (!holds) refuse(field, value, allowed);
}
inline void require(bool holds, const std::string& field, double value, const char* allowed) {
  if (!holds) refuse(field, value, allowed);
}

}  // namespace clatter::analytic::detail
