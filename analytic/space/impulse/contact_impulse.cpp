// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/contact_impulse.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace clatter::analytic::space {

void Law::validate() const {
  law.validate();
  const double length = ratio_direction.norm();
  if (!(std::fabs(length - 1) <= 8 * std::numeric_limits<double>::epsilon())) {
    std::ostringstream text;
    text.precision(17);
    text << "length of the impulse ratio's direction = " << length << ": must be 1";
    throw std::domain_error(text.str());
  }
}

}  // namespace clatter::analytic::space
