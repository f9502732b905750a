// SPDX-License-Identifier: GPL-3.0-or-later
// The load of a pad, whose pressure over depth goes along straight pieces, with damping and friction.
#pragma once

#include <memory>
#include <vector>

#include "numeric/contact/contact_load.hpp"

namespace clatter::numeric {

/// The load of a pad (Ground::kinks) on any surface: the sum of those of beds of springs that begin at the depths d of
/// the kinks,
///     f_n = Σ s (1 + τδ̇)₊ (δ − d)₊,   s = k_G of the first bed, at d = 0, and k_G change of the others, of either
///     sign.
/// A bed's load is that of the body over a ground sunk by d, with the integrals, friction and energy of springs, exact
/// as those are; all beds press where 1 + τδ̇ > 0, and their sum never pulls.  A pad of one piece has the bits of
/// springs of c_G = τ k_G.  An evaluation takes the time of as many beds as the deepest point has reached.
class PadContact final : public ContactSurface {
 public:
  PadContact(const Body& body, const Ground& ground);

  using ContactSurface::load;
  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override;
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override;
  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override;

 private:
  struct Bed {
    double depth = 0;  ///< where it begins [m]
    double sign = 1;   ///< of its springs' stiffness
    std::unique_ptr<const Ground> springs;
    std::unique_ptr<ContactSurface> surface;
  };

  std::vector<Bed> beds_;
  std::size_t reached_ = 1;  ///< beds of the last load
};

}  // namespace clatter::numeric
