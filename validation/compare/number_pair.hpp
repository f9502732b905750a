// SPDX-License-Identifier: GPL-3.0-or-later
// One number of an impact in both models.
#pragma once

#include <cstddef>

#include "validation/compare/comparison.hpp"
#include "validation/output/estimated.hpp"

namespace clatter::validation {

/// A number of an impact in both models.  Each function needs the models, or the limit, that its words name.
struct NumberPair {
  const ComparedImpact& impact;
  std::size_t quantity;

  [[nodiscard]] double discrete() const { return (*impact.discrete)[quantity]; }
  /// The number of the discrete model with the body as given, whose corners may not be the mesh's.
  [[nodiscard]] Estimated given_number() const {
    if (!impact.as_given) return discrete_number();
    return {(*impact.as_given)[quantity], impact.as_given_error[quantity]};
  }
  [[nodiscard]] double continuous() const { return (*impact.continuous)[quantity]; }
  [[nodiscard]] double deviation() const { return continuous() - discrete(); }
  [[nodiscard]] Estimated discrete_number() const { return {discrete(), impact.discrete_error[quantity]}; }
  [[nodiscard]] Estimated continuous_number() const { return {continuous(), impact.continuous_error[quantity]}; }
  [[nodiscard]] Estimated deviation_number() const { return continuous_number() - discrete_number(); }
  /// How far the limit is off the discrete value; its own error bar stands beside it.
  [[nodiscard]] Estimated miss_number() const { return {miss(), impact.discrete_error[quantity] + bar()}; }
  [[nodiscard]] double predicted() const { return impact.predicted.total()[quantity]; }
  [[nodiscard]] double miss() const { return impact.limit->value[quantity] - discrete(); }
  [[nodiscard]] double allowance() const { return impact.allowance[quantity]; }
  [[nodiscard]] double bar() const { return impact.limit->error[quantity]; }
};

}  // namespace clatter::validation
