// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of time integration.
#pragma once

namespace clatter::numeric {

/// How contacts are integrated in time.
enum class Method {
  automatic,  ///< tvd_rk3 when a step is given, else rkck up to four digits and rk8pd beyond
  tvd_rk3,    ///< third-order TVD Runge–Kutta with a fixed step, the paper's method
  rk4,        ///< classical fourth order, adaptive by step doubling (GSL)
  rkf45,      ///< Runge–Kutta–Fehlberg 4(5), adaptive (GSL)
  rkck,       ///< Cash–Karp 4(5), adaptive (GSL)
  rk8pd,      ///< Prince–Dormand 8(9), adaptive (GSL)
};

}  // namespace clatter::numeric
