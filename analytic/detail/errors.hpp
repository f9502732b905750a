// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the discrete model.  A broken contract is std::domain_error, a run that ends early is an
// outcome beside its rows (sequence.hpp); the two below are what is left.
#pragma once

#include <stdexcept>

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
