// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/tvd_rk3.hpp"

namespace clatter::numeric {

bool TvdRk3::step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h, ContactState& next,
                  ContactState& error) {
  ContactState slope;
  const ContactState first = y + h * rate;
  system.derivative(first, slope);
  // Increments are combined instead of states, so that the state's own rounding enters once.
  const ContactState increment = 0.25 * h * (rate + slope);
  system.derivative(y + increment, slope);
  next = y + (2.0 / 3.0) * (increment + h * slope);
  error.setZero();
  return next.allFinite();
}

}  // namespace clatter::numeric
