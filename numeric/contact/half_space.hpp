// SPDX-License-Identifier: GPL-3.0-or-later
// The load of a ground that is an elastic half-space, with damping and friction.
#pragma once

#include <memory>

#include "numeric/contact/contact_load.hpp"
#include "numeric/contact/footprint.hpp"

namespace clatter::numeric {

/// The load of a half-space (Ground::modulus) on any surface.  Elastic pressure p = k δ + R and energy U are those of
/// the patch, Footprint; with τ = Ground::dissipation
///     f = k δ (1 + τδ̇)₊ + w R,   w = ∫δ (1 + τδ̇)₊ dA/S₁,                                             (1)
/// so that F = w ∫p dA: Hunt and Crossley's factor, 1 + τ v for a body that sinks at the speed v, and never a pull. The
/// power ∫(f − p) δ̇ dA that it dissipates is τ F_e v² there; where (1) would give power back, which is far from any
/// patch that sinks as one, a part θ of f is w_s p, w_s = (1 + τ ∫pδ̇/∫p)₊, just large enough.  Where ∫p is not
/// positive, as where a wide part begins to touch round a deep narrow one, which a single patch does not stand for,
/// nothing presses.  Friction rubs over the patch with k δ (1 + τδ̇)₊ scaled to F, about the pressure centre of f.
/// Rates: what an acceleration does through w is exact where θ = 0; all else is a central difference of the load along
/// the motion, right to some 1e-9 of the rate.
class HalfSpaceContact final : public ContactSurface {
 public:
  HalfSpaceContact(const Body& body, const Ground& ground);

  using ContactSurface::load;
  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override;
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override;
  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override;

 private:
  /// A bed of springs under the surface, whose evaluation tells the patch.
  struct Bed {
    Footprint footprint;
    std::unique_ptr<ContactSurface> surface;
  };
  struct Evaluation;
  [[nodiscard]] Evaluation evaluate(Bed& bed, const GroundView& view, LoadRates* rates, std::vector<int>* submerged);
  void add_rates(const GroundView& view, const Evaluation& here, LoadRates& rates);

  double modulus_, dissipation_;
  Ground springs_;  ///< of both beds: of stiffness 1 while the load is summed, then those that rub
  Bed bed_, beside_;
};

/// What presses on a ground: on springs, the body's surface, smooth where its shape is, else its facets; on a pad, that
/// on each of its beds; on a half-space, that over a patch of the same.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_on(const Body& body, const Ground& ground);

}  // namespace clatter::numeric
