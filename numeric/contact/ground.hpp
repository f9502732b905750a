// The ground: a distributed viscoelastic foundation with Coulomb friction.
#pragma once

namespace clatter::numeric {

/// Over which area the distributed load is integrated.
enum class AreaMeasure {
  surface,    ///< the body's own surface, the paper's reading: a steep side face counts in full
  /// Its signed vertical component, a Winkler bed of springs: F = k_G × submerged volume.  Faces that look up from
  /// below the ground are pressed downward.  Friction of the regularised law acts on them as on the others, by what
  /// presses on each; friction of the coulomb law is that of the resultant.
  projected,
};

enum class FrictionLaw {
  /// Slip per unit area against the local slip velocity; stick as one unknown resultant at the pressure centre.
  /// Cannot represent: the moment that resists spinning about the vertical while the pressure centre sticks, and
  /// areas that slip while others stick.
  coulomb,
  /// f_t = −μ_k f_n v / √(v² + v_r²) everywhere.  Represents spin; cannot represent stick: a body on a slope or under
  /// a sustained tangential load creeps, at a speed of up to about v_r.
  regularised,
};

/// f_n = (k_G + c_G δ̇) δ per unit area where the surface lies δ > 0 below z = 0, clamped at zero: the ground
/// never pulls.
struct Ground {
  double stiffness = 1e9;         ///< k_G [N/m³], > 0
  double damping = 0;             ///< c_G [N·s/m⁴], >= 0
  double static_friction = 0;     ///< μ_s, >= sliding_friction
  double sliding_friction = 0;    ///< μ_k, >= 0
  AreaMeasure area = AreaMeasure::surface;
  FrictionLaw friction = FrictionLaw::coulomb;
  double regularisation_speed = 1e-3;  ///< v_r of the regularised law [m/s], > 0

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
  [[nodiscard]] bool has_friction() const { return static_friction > 0 || sliding_friction > 0; }
};

}  // namespace clatter::numeric
