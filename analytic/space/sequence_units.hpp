// SPDX-License-Identifier: GPL-3.0-or-later
// Units of a sequence in space: powers of two near the drop's own length, speed and mass.
#pragma once

#include "analytic/space/sequence.hpp"

namespace clatter::analytic::space {

/// Exact to and fro: every scale is a power of two.
class SequenceUnits {
 public:
  explicit SequenceUnits(const Drop& drop);
  [[nodiscard]] Drop to_internal(const Drop& drop) const;
  void to_si(Sequence& sequence) const;
  [[nodiscard]] double energy(double internal) const;

 private:
  void to_si(State& state) const;
  void to_si(Impact& impact) const;
  void to_si(GroupImpact& group) const;
  void to_si(FirstContact& flight) const;
  void to_si(NearMiss& miss) const;
  void to_si(ImpactRow& row) const;
  void to_si(Tail& tail) const;

  int length_ = 0, speed_ = 0, mass_ = 0;
};

/// @throws NumericalError for numbers that leave the doubles on the way back to SI units.
void require_representable(const Sequence& sequence);

}  // namespace clatter::analytic::space
