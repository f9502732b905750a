// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/contact_step.hpp"

namespace clatter::numeric {

ContactStep::ContactStep(ContactSystem& system, Stepper& stepper) : system_(system), stepper_(stepper) {
  submerged_.reserve(system.body().facets().corners.size());
}

bool ContactStep::take(const ContactInstant& from, double h, ContactInstant& to) {
  if (!stepper_.step(system_, from.state, from.rate, h, to.state, error_)) return false;
  euler_parameters(to.state).normalize();
  to.time = from.time + h;
  submerged_.clear();
  to.diagnosis = system_.diagnose(to.state, to.rate, &submerged_);
  return to.rate.allFinite();
}

}  // namespace clatter::numeric
