// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/sequence_loop.hpp"

#include <sstream>

namespace clatter::analytic {

std::string energy_warning(FrictionKind friction, const CreatedEnergy& created, double joules) {
  std::ostringstream text;
  text.precision(6);
  text << (friction != FrictionKind::impulse_ratio ? "the law of restitution, with friction," : "the impulse ratio")
       << " creates energy: " << joules << " J in all, from impact " << created.first << " on"
       << (friction != FrictionKind::impulse_ratio ? "; Stronge's law never does" : "");
  return text.str();
}

}  // namespace clatter::analytic
