// SPDX-License-Identifier: GPL-3.0-or-later
// Internal units: powers of two near the size, speed and mass of a drop.
#pragma once

#include "analytic/sequence.hpp"

namespace clatter::analytic {

/// Scales a drop so that its length, speed and mass are of order 1 and its results back.  Factors are
/// powers of two, so that scaling is exact and results do not depend on the user's units.
class Units {
 public:
  explicit Units(const Drop& drop);
  [[nodiscard]] Drop to_internal(Drop drop) const;
  void to_si(Sequence& sequence) const;
  /// [J] of an energy in internal units.
  [[nodiscard]] double energy(double internal) const;

 private:
  void to_si(PlanarVelocity& v) const;
  void to_si(Impact& impact) const;
  void to_si(RowErrors& error) const;
  void to_si(NearMiss& miss) const;
  void to_si(ImpactRow& row) const;

  int length_, speed_, mass_;  ///< exponents of two
};

}  // namespace clatter::analytic
