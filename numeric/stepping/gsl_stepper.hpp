// SPDX-License-Identifier: GPL-3.0-or-later
// Embedded Runge–Kutta methods of the GNU Scientific Library.
#pragma once

#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

enum class GslMethod { rk4, rkf45, rkck, rk8pd };

[[nodiscard]] std::unique_ptr<Stepper> make_gsl_stepper(GslMethod method);

}  // namespace clatter::numeric
