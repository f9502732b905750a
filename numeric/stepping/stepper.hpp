// SPDX-License-Identifier: GPL-3.0-or-later
// One step of a Runge–Kutta method for Eq. 3 of Shan et al. (2005), U̇ = R(U).
#pragma once

#include <memory>

#include "numeric/contact/contact_system.hpp"
#include "numeric/stepping/method.hpp"

namespace clatter::numeric {

class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Advances `y` by `h` [s] into `next`; `rate` is the derivative at y.  `error` gets the local error estimate,
  /// or 0 for a method without one.  No allocation.
  /// @return false if the method failed (a number that is not finite).
  virtual bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h,
                    ContactState& next, ContactState& error) = 0;
  /// Order of the error estimate in h; 0: there is none, the step is fixed.
  [[nodiscard]] virtual int error_order() const = 0;
};

/// @throws std::invalid_argument for Method::automatic.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(Method method);

}  // namespace clatter::numeric
