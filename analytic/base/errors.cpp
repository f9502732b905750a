// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/base/errors.hpp"

#include <sstream>
#include <stdexcept>

namespace clatter::analytic::detail {

void refuse(const std::string& field, double value, const char* allowed) {
  std::ostringstream text;
  text.precision(17);
  text << field << " = " << value << ": must be " << allowed;
  throw std::domain_error(text.str());
}

}  // namespace clatter::analytic::detail
