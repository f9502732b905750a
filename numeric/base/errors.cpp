// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/base/errors.hpp"

#include <cmath>
#include <sstream>
#include <string>

namespace clatter::numeric::detail {

void require(bool condition, const char* field, double value, const char* allowed) {
  if (condition && std::isfinite(value)) return;
  std::ostringstream text;
  text << field << " = " << value << ": must be " << allowed;
  throw std::domain_error(text.str());
}

void require_positive(const char* field, double value) {
  require(value > 0, field, value, "finite and greater than 0");
}

void require_at_least(const char* field, int value, int least) {
  const std::string allowed = "at least " + std::to_string(least);
  require(value >= least, field, value, allowed.c_str());
}

}  // namespace clatter::numeric::detail
