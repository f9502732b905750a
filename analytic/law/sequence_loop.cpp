// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/sequence_loop.hpp"

#include <sstream>

namespace clatter::analytic {

std::string law_warning(FrictionKind friction, const Unphysical& found, double joules) {
  const bool is_ratio = friction == FrictionKind::impulse_ratio;
  if (found.first_energy == 0 && found.first_along == 0) return "";
  std::ostringstream text;
  text.precision(6);
  text << (is_ratio ? "the impulse ratio" : "the law of restitution, with friction,");
  if (found.first_energy > 0)
    text << " creates energy: " << joules << " J in all, from impact " << found.first_energy << " on";
  else text << " pushes the contact along its slip, as no friction does, from impact " << found.first_along << " on";
  text << (is_ratio ? "; Eq. 8 takes it as given, --friction MU follows the slip"
                    : "; Stronge's law (--restitution-law stronge) never does");
  return text.str();
}

}  // namespace clatter::analytic
