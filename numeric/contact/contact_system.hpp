// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion of a body in contact with the ground: state and right side of Eq. 3 of Shan et al. (2005).
#pragma once

#include <Eigen/Core>
#include <memory>

#include "numeric/contact/contact_load.hpp"
#include "numeric/motion/equations_of_motion.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// State of a contact.  Everything is relative to the touch-down, so that depths of a billionth of the body's size
/// keep their digits.
///     r       displacement of the centre of mass, world [m]
///     β       Euler parameters of the rotation since touch-down
///     V       velocity of the centre of mass, world [m/s]
///     ω′      angular velocity, body frame [rad/s]
///     W_d, W_r, W_f   energy dissipated by dampers, released by the clamp, dissipated by friction [J]
using ContactState = Eigen::Matrix<double, 16, 1>;

auto displacement(auto& y) { return y.template head<3>(); }
auto euler_parameters(auto& y) { return y.template segment<4>(3); }
auto velocity(auto& y) { return y.template segment<3>(7); }
/// ω′.
auto angular_velocity(auto& y) { return y.template segment<3>(10); }
/// W_d, W_r, W_f.
auto works(auto& y) { return y.template tail<3>(); }
[[nodiscard]] inline double damping_work(const ContactState& y) { return works(y)[0]; }
[[nodiscard]] inline double released_work(const ContactState& y) { return works(y)[1]; }
[[nodiscard]] inline double friction_work(const ContactState& y) { return works(y)[2]; }

/// What friction does until an event changes it.
struct FrictionPhase {
  enum class Kind { none, slip, stick, regularised, local };
  Kind kind = Kind::none;
  AlongGround direction;  ///< of slip when the phase or the step began, unit
  bool varies = false;    ///< whether the direction of slip varies over the patch noticeably
  double digits = 15;     ///< that friction over such a patch needs beside the errors of steps
  double floor = 0;       ///< local law: see SlipField [m/s]
  bool turns = false;     ///< local law: the points slip differently, so that none holds by static friction
  /// Slip slower than this has no direction but that above: rounding must not choose it [m/s].
  double slow = 0;
  /// In stick a remaining slip of the pressure centre and a remaining spin fade at this rate [1/s].
  double fading = 0;
  bool point = false;  ///< the patch counts as a point, whose friction has no couple
};

/// Numbers of an instant that events and records need.
struct ContactDiagnosis {
  ContactLoad load;
  double force_rate = 0;  ///< dF_n/dt [N/s]
  AlongGround friction;   ///< [N]
  /// Force that would hold the pressure centre in stick, cut off at 2 μ_s F_n; 0 in the other phases [N].
  AlongGround hold;
  bool spins = false;                ///< whether bound (1) leaves less couple than would hold the spin in stick
  Vector3 centre = Vector3::Zero();  ///< of pressure, body frame [m]
  AlongGround slip;                  ///< velocity of the body there, along the ground [m/s]
  double spin = 0;                   ///< angular velocity about the vertical [rad/s]
  double patch_radius = 0;           ///< root mean square of the distance from the centre, weighted by depth [m]
  Vector3 couple = Vector3::Zero();  ///< moment of friction about the pressure centre, body frame [N·m]
};

/// The patch of an instant, and its pressure centre [m]; good until the next evaluation of a load.
struct ContactPatch {
  GroundView view;
  Vector3 centre;
};

/// The local law's resultant and its moment about the pressure centre.
struct LocalFriction {
  AlongGround force;                 ///< [N]
  Vector3 couple = Vector3::Zero();  ///< body frame [N·m]
};

/// U̇ = R(U), Eq. 3 of Shan et al. (2005), with their Eqs. 1 and 2 in the form of Newton and Euler (NewtonEuler):
///     ṙ = V,   β̇ = ½ β ω′,   m V̇ = F_c − m g e_z,   I ω̇′ + ω′ × I ω′ = M′,
///     F_c = ∫f_c = F_n e_z + F_t                                      (Eq. 4)
///     M′  = ∫u × f_c = ∫f_n u × n′ + (friction's)                      (Eq. 7)
/// Slip, Eq. 6: F_t = −μ_k F_n d at the pressure centre c, d the direction of the slip velocity there; if the body
/// spins about the vertical, −μ_k ∫f_n v/|v| over the patch taken as flat, with its moment about the vertical: finite
/// and continuous where the slip of c is zero.  (The slip of its points differs by the turning about the horizontal
/// times their depth too: FrictionLaw::local.)  Local slip: −μ_k ∫f_n v/|v|, v the velocity of each point, with its
/// moment.  Stick, Eq. 5, in which neither c slips nor the patch spins: F_t at c and a couple C about the vertical with
///     d/dt v_t(c) = [V̇ + ω̇ × c + ω × (ω × c) + ω × ċ]_t = 0,   d/dt ω_z = 0,   V̇_t = F_t/m + g_t,
/// ċ being the pressure centre's motion over the body, so that c stays at rest although it moves
/// (slip and spin that were left when it was caught come to rest, like exp(−fading × time)).  They are within
///     (|F_t|/μ_s F_n)² + (C/C₀)² <= 1,   C₀ = μ_s ∫f_n |u − c|, that of the patch turning about c,              (1)
/// which stands for the patch's limit surface.  A couple that asks for more gets what (1) leaves; a force F_t that by
/// itself asks for more than μ_s F_n gets the bound.  The moment M along the vertical that friction of a patch cannot
/// give lets it spin: stick is then over as soon as the spin counts (FrictionPhases).  In the plane, and of a patch
/// that counts as a point, C is 0.
class ContactSystem {
 public:
  ContactSystem(const Body& body, const Ground& ground, const Gravity& gravity, bool planar);

  /// Sets the pose and velocity at touch-down.
  void begin(const MotionState& touch);
  [[nodiscard]] const MotionState& touch_down() const { return touch_; }
  [[nodiscard]] ContactState initial() const;
  [[nodiscard]] MotionState motion(const ContactState& y) const;
  /// Height of the body's point u over the ground [m], with the digits of its change since touch-down.
  [[nodiscard]] double height(const Vector3& u, const ContactState& y) const { return view(y).height(u); }

  /// μ_s, or μ_k where nothing is at rest.
  [[nodiscard]] double stick_coefficient() const { return stick_coefficient(phase_); }
  /// Angular velocity about the vertical [rad/s].
  [[nodiscard]] double vertical_spin(const ContactState& y) const;

  void set_phase(const FrictionPhase& phase) { phase_ = phase; }
  [[nodiscard]] const FrictionPhase& phase() const { return phase_; }

  void derivative(const ContactState& y, ContactState& rate);
  /// The derivative with the numbers of the instant; `submerged` gets vertices below the ground if not null.
  [[nodiscard]] ContactDiagnosis diagnose(const ContactState& y, ContactState& rate,
                                          std::vector<int>* submerged = nullptr);
  /// Friction force that sticking would take, cut off at 2 μ_s F_n.
  [[nodiscard]] AlongGround sticking_force(const ContactState& y);
  /// The same per unit of normal force for a light load at the body's point u, from the touch-down pose: tells
  /// whether a contact that begins without slip sticks.
  [[nodiscard]] AlongGround sticking_ratio(const Vector3& u) const;
  /// How much faster points slip per metre of depth, by turning about the horizontal [1/s].
  [[nodiscard]] AlongGround slip_per_depth(const ContactState& y) const;
  [[nodiscard]] ContactPatch patch(const ContactState& y);
  /// Range of the slip velocities of the patch's points [m/s].
  [[nodiscard]] SlipRange slip_range(const ContactPatch& patch) const;
  /// Friction of the local law if all points slipped faster by `shift` [m/s]; in space right to some per cent.
  [[nodiscard]] LocalFriction local_friction(const ContactPatch& patch, const AlongGround& shift);
  /// Change of velocity of the pressure centre along the ground by an impulse there [m/s].
  [[nodiscard]] AlongGround response(const ContactPatch& patch, const AlongGround& impulse) const;
  /// The same by an angular impulse [N·m·s], body frame.
  [[nodiscard]] AlongGround response(const ContactPatch& patch, const Vector3& angular_impulse) const;
  /// Static energy and force at a depth below the touch-down pose, for the scales of time and depth.
  [[nodiscard]] ContactLoad pressed(double depth);

  /// Whether no point is at or above the ground.
  [[nodiscard]] bool is_submerged(const ContactState& y) const;

  [[nodiscard]] long evaluations() const { return evaluations_; }
  /// Takes the last ones out of that count: they were not for the run itself.
  void set_aside(long evaluations) {
    evaluations_ -= evaluations;
    evaluations_aside_ += evaluations;
  }
  [[nodiscard]] long evaluations_aside() const { return evaluations_aside_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const Ground& ground() const { return ground_; }
  /// Towards the ground, and along x [m/s²].
  [[nodiscard]] double gravity() const { return gravity_.down; }
  [[nodiscard]] double gravity_along() const { return gravity_.along; }
  [[nodiscard]] bool planar() const { return planar_; }

 private:
  struct Instant;
  struct Friction;
  [[nodiscard]] double stick_coefficient(const FrictionPhase& phase) const {
    return phase.turns ? ground_.sliding_friction : ground_.static_friction;
  }
  /// Where friction of the phase acts: at a patch as a whole, or at each of its points.
  [[nodiscard]] SlipField slip_field(const FrictionPhase& phase) const;
  void evaluate(const ContactState& y, const FrictionPhase& phase, ContactState& rate, ContactDiagnosis* diagnosis,
                std::vector<int>* submerged);
  [[nodiscard]] GroundView view(const ContactState& y) const;
  [[nodiscard]] Vector3 angular_acceleration(const Vector3& moment, const Vector3& omega) const;
  [[nodiscard]] Vector3 response(const Vector3& moment) const;
  [[nodiscard]] Friction friction(const Instant& at);
  [[nodiscard]] Friction at_centre(const Instant& at, const AlongGround& force) const;
  [[nodiscard]] Friction over_patch(const Instant& at, const SlipField& field);
  struct Hold;
  [[nodiscard]] Friction in_stick(const Instant& at);
  [[nodiscard]] Hold stick(const Instant& at) const;
  [[nodiscard]] double turning_couple(const Instant& at);

  const Body& body_;
  const Ground& ground_;
  Gravity gravity_;
  bool planar_;
  NewtonEuler equations_;
  std::unique_ptr<ContactSurface> loader_;
  MotionState touch_;
  GroundPlane plane_;
  Vector3 east_ = Vector3::UnitX(), north_ = Vector3::UnitY();  ///< world axes in the body frame at touch-down
  FrictionPhase phase_;
  long evaluations_ = 0, evaluations_aside_ = 0;
};

}  // namespace clatter::numeric
