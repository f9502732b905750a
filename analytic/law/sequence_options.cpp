// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/sequence_options.hpp"

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

void SequenceOptions::validate() const {
  detail::require(impacts >= 1, "impacts", impacts, "at least 1");
  detail::require(digits >= 1 && digits <= 15, "digits", digits, "between 1 and 15");
}

}  // namespace clatter::analytic
