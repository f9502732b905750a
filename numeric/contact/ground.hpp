// SPDX-License-Identifier: GPL-3.0-or-later
// The ground: a distributed viscoelastic foundation with Coulomb friction.
#pragma once

#include <vector>

namespace clatter::numeric {

/// Over which area the distributed load is integrated.
enum class AreaMeasure {
  surface,  ///< the body's own surface, the paper's reading: a steep side face counts in full
  /// Its signed vertical component, a Winkler bed of springs: F = k_G × submerged volume.  Faces that look up from
  /// below the ground are pressed downward: each column of the ground presses with the difference of what its lower and
  /// its upper face have, never less than zero, and its friction is μ times that, in every law, along the slip of the
  /// lower face.
  projected,
};

enum class FrictionLaw {
  /// Coulomb's law of a contact patch taken as flat: f_t = −μ_k f_n v/|v|, v the slip of the pressure centre plus the
  /// spin about the vertical times the distance from it; a patch that spins slips, even where its pressure centre
  /// rests.  Stick is one unknown resultant at the pressure centre and one couple about the vertical.  The discrete
  /// model's law, whose contact is a point or an evenly pressed face.  Leaves out the slip of the points from the
  /// turning
  /// about the horizontal times their depth; cannot represent areas that slip while others stick.
  coulomb,
  /// f_t = −μ_k f_n v / √(v² + v_r²) everywhere.  Represents spin; cannot represent stick: a body on a slope or under
  /// a sustained tangential load creeps, at a speed of up to about v_r.
  regularised,
  /// f_t = −μ_k f_n v/|v| with the velocity v of each point: Eq. 6 of the paper as written, where the load at each
  /// place follows from "its local indentation and relative velocity".  (Its stick, Eq. 5, is one resultant with "a
  /// presumed sticking location", as in `coulomb`.)  While the patch turns about the horizontal its points slip at
  /// different speeds, over a range of about |ω| times the depth, and at most a line of them rests: friction changes
  /// continuously from −μ_k F_n to μ_k F_n while the slip of the pressure centre crosses that range, and nothing
  /// sticks.  Where the range is below what the tolerance resolves (slip_resolution, friction_phases.cpp) the patch
  /// counts as a point, as in `coulomb`: that is the law's limit, with the resultant that keeps the point at rest, at
  /// most μ_k F_n.  The equations are stiff there, and since the slip forgets its start at the rate μ_k F_n over
  /// mass times range, the error is of second order.  A facet that lies flat slips as one while others do not: there
  /// v/√(v² + v_r²) with a v_r below the resolution stands for v/|v|.  μ_s has a place where nothing turns alone.
  local,
};

/// A depth from which on the springs have another stiffness.
struct Kink {
  double depth = 0;   ///< d [m], > 0
  double change = 0;  ///< of the stiffness, over k_G
};

/// The load of Eq. 4 of Shan et al. (2005): f_n = (k_G + c_G δ̇) δ per unit area where the surface lies δ > 0 below z =
/// 0, clamped at zero: the ground never pulls.  With `kinks` it is a pad, PadContact, whose pressure p goes along
/// straight pieces and is damped by Hunt and Crossley's factor,
///     f_n = p(δ) (1 + τ δ̇)₊,   p(δ) = k_G [δ + Σ change (δ − d)₊].                                       (1)
/// With `modulus` it is an elastic half-space, HalfSpaceContact, in place of springs, and stiffness does not count.
/// `damping` is that of springs without kinks alone.
struct Ground {
  double stiffness = 1e9;  ///< k_G [N/m³], > 0
  double damping = 0;      ///< c_G [N·s/m⁴], >= 0
  /// E* of an elastic half-space [Pa], >= 0; 0: none.  1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ of ground and body.  Its area
  /// is `projected`.
  double modulus = 0;
  double dissipation =
      0;  ///< τ of Hunt and Crossley's factor 1 + τ δ̇ on a half-space's or a pad's pressure [s/m], >= 0
  std::vector<Kink> kinks = {};  ///< of a pad, by growing depth; the stiffness between them is never negative
  double static_friction = 0;    ///< μ_s, >= sliding_friction
  double sliding_friction = 0;   ///< μ_k, >= 0
  AreaMeasure area = AreaMeasure::surface;
  FrictionLaw friction = FrictionLaw::coulomb;
  double regularisation_speed = 1e-3;  ///< v_r of the regularised law [m/s], > 0

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
  /// As hard, by a factor: k_G and c_G, or E*, are multiplied by it, and what restitution follows from stays.
  void stiffen(double factor) {
    stiffness *= factor;
    damping *= factor;
    modulus *= factor;
  }
  [[nodiscard]] bool is_half_space() const { return modulus > 0; }
  [[nodiscard]] bool is_pad() const { return !is_half_space() && !kinks.empty(); }
  /// Whether it is damped by the factor 1 + τ δ̇, and not by c_G.
  [[nodiscard]] bool has_dissipation() const { return is_half_space() || is_pad(); }
  /// c_G/k_G, or the dissipation [s/m]: what restitution at a speed follows from.
  [[nodiscard]] double damping_per_stiffness() const { return has_dissipation() ? dissipation : damping / stiffness; }
  [[nodiscard]] bool is_damped() const { return has_dissipation() ? dissipation > 0 : damping > 0; }
  /// p/k_G of (1) at a depth [m], >= 0.
  [[nodiscard]] double pressed_depth(double depth) const;
  [[nodiscard]] bool has_friction() const { return static_friction > 0 || sliding_friction > 0; }
};

}  // namespace clatter::numeric
