// SPDX-License-Identifier: GPL-3.0-or-later
// Refusal of arguments that break a contract.
#pragma once

namespace clatter::numeric::detail {

/// @throws std::domain_error "field = value: must be allowed" unless `condition` holds and `value` is finite.
void require(bool condition, const char* field, double value, const char* allowed);
void require_positive(const char* field, double value);  ///< greater than 0 and finite
void require_at_least(const char* field, int value, int least);

}  // namespace clatter::numeric::detail
