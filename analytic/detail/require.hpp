// SPDX-License-Identifier: GPL-3.0-or-later
// Refusal of arguments outside their domain.
#pragma once

#include <string>

namespace clatter::analytic::detail {

/// @throws std::domain_error "FIELD = VALUE: must be ALLOWED".
[[noreturn]] void refuse(const std::string& field, double value, const char* allowed);

/// The same unless `holds`.
inline void require(bool holds, const char* field, double value, const char* allowed) {
  if (!holds) refuse(field, value, allowed);
}
inline void require(bool holds, const std::string& field, double value, const char* allowed) {
  if (!holds) refuse(field, value, allowed);
}

}  // namespace clatter::analytic::detail
