// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's time integration.
#pragma once

#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// Integrates Eq. 3 of Shan et al. (2005) as they did: third-order total-variation-diminishing Runge–Kutta method of
/// Shu and Osher (1988):
///     y₁ = y + h f(y),   y₂ = ¾ y + ¼ (y₁ + h f(y₁)),   y(t+h) = ⅓ y + ⅔ (y₂ + h f(y₂)).
class TvdRk3 final : public Stepper {
 public:
  bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h, ContactState& next,
            ContactState& error) override;
  [[nodiscard]] int error_order() const override { return 0; }
};

}  // namespace clatter::numeric
