// SPDX-License-Identifier: GPL-3.0-or-later
// What Coulomb's law of a patch taken as flat leaves out: the slip of its points from turning times depth.
#pragma once

#include "numeric/contact/contact_system.hpp"

namespace clatter::numeric {

/// Carries, along a contact with FrictionLaw::coulomb, the deviation y that the slip of the pressure centre c would
/// have under FrictionLaw::local, to first order in it:
///     ẏ = R (F_local(v + y) − F_coulomb) + [I⁻¹ (C_local(v + y) − C_coulomb) × c]_t,                           (1)
/// R the response of the velocity at c to an impulse there, C friction's moment about c: places that slip forward and
/// back lie at different depths, and so turn the body even where their forces cancel.  The equation is solved
/// by Euler's implicit method over the accepted steps: (1) is stiff where the body sticks.  F_local falls with y
/// (friction opposes slip), so that each step has a solution, found component by component.  Right to a factor of about
/// 3 as long as the impulse's change is small.
/// Parts of a step in which the laws differ by less than `least` [N] count as equal; the bound, for slip v that is
/// faster than twice the range w of what turning, spin and y add to it:
///     |F_local − F_coulomb| <= 2 μ_k F_n w_across / |v|,   w_across the part of w across v                        (2)
class LocalSlipEstimate {
 public:
  void begin(double least);
  /// Over a step of length h [s] that has ended at `y` with the numbers `at`.
  void advance(ContactSystem& system, const ContactState& y, const ContactDiagnosis& at, double h);
  /// ∫(F_local − F_coulomb) dt so far, its size [N·s].
  [[nodiscard]] double impulse() const { return impulse_.norm(); }

 private:
  void part_of_step(ContactSystem& system, const ContactPatch& patch, const ContactDiagnosis& at, double h,
                    const AlongGround& ahead);
  [[nodiscard]] bool may_differ(double bound, const AlongGround& slip) const;

  double least_ = 0;   ///< difference of the laws that counts [N]
  AlongGround range_;  ///< of slip over the depth of the present patch [m/s]
  double spin_ = 0;    ///< slip of its farthest points from spin that Coulomb's law leaves out [m/s]
  AlongGround slip_, impulse_;
  AlongGround last_;  ///< slip of the pressure centre at the end of the last step
};

}  // namespace clatter::numeric
