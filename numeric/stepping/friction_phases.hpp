// SPDX-License-Identifier: GPL-3.0-or-later
// The phases of friction along a contact: stick and slip, Eqs. 5 and 6 of Shan et al. (2005).
#pragma once

#include <vector>

#include "numeric/contact/contact_system.hpp"
#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// Notes the phases of slip and stick that mattered: slip by its work or its part of the normal impulse, stick by its
/// time.  (A sticking end slips for an instant when the force on it fades; such a phase names nothing.)
class FrictionLog {
 public:
  /// What has summed up since touch-down.
  struct Sums {
    double time = 0;     ///< [s]
    double work = 0;     ///< of friction [J]
    double impulse = 0;  ///< normal [N·s]
  };

  FrictionLog();
  void begin(const ContactScales& scales, double mass);
  void open(const Sums& sums) { start_ = sums; }
  /// Notes the phase that was opened last, if it mattered.
  void close(const FrictionPhase& phase, const Sums& sums);
  /// Name of what happened in a contact with Coulomb friction.  Slip that turns back at once is reverse_slip, whatever
  /// else there is.
  [[nodiscard]] FrictionMode mode() const;

 private:
  struct Entry {
    FrictionPhase::Kind kind;
    AlongGround direction;  ///< of slip when it began
  };

  std::vector<Entry> entries_;  ///< neighbours differ in kind or in the direction of slip
  Sums start_;                  ///< of the current phase
  double least_work_ = 0, least_impulse_ = 0, least_time_ = 0;
};

/// With Coulomb's law one of two laws holds for the resultant F_t at the pressure centre, whose slip is v:
///     stick   |F_t| <= μ_s F_n,   F_t such that v = 0                    (Eq. 5)
///     slip    F_t = −μ_k F_n d,   d the direction of v                   (Eq. 6)
/// A phase is over where its reserve falls to 0: μ_s F_n − |F_t| in stick, v·d in slip.  Stick that gives way slips
/// against the force that would have held; slip that ends sticks if Eq. 5 then holds, and else slips against that force
/// too.  Without friction, or with the regularised law, one phase lasts throughout.
///
/// A patch that spins cannot stick as a whole: with w = |ω_z| times the patch's radius (ContactDiagnosis::patch_radius)
/// above the speed w₀ up to which slip is slow (0.1 √tolerance of the contact's, a tenth of that in slip that began at
/// the touch) it slips, even where its centre rests, with the force and the couple of its points' slip.  Once v·d or w
/// has exceeded 3 w or w₀, slip is over where w <= w₀ and v·d <= 3 w; a stuck patch slips again where w exceeds 2 w₀.
/// What is neglected below is the slip of the centre that spin would cause, at most about w.
class FrictionPhases {
 public:
  struct Settings {
    double tolerance = 1e-10;     ///< of the steps
    double fixed_step = 0;        ///< their length if that is fixed, else 0 [s]
    bool point_friction = false;  ///< see World
    bool is_pressed = false;      ///< see ContactControl
  };

  explicit FrictionPhases(ContactSystem& system) : system_(system) {}

  /// The phase in which a contact begins at `now`: slip in the direction of the touching point `point` (body frame);
  /// where that has none, what the light first load would do, or the load that presses already.
  void begin(const MotionState& touch, const Vector3& point, const ContactScales& scales, const Settings& settings,
             const ContactInstant& now);

  /// Whether an event can end the phase.
  [[nodiscard]] bool can_end() const;
  /// What is left of the phase at an instant: [m/s] in slip, [N] in stick.
  [[nodiscard]] double reserve(const ContactInstant& at) const;
  [[nodiscard]] bool is_over(const ContactInstant& at) const;
  /// F_n up to which friction is not judged [N]: where the contact begins and ends, the forces that decide between slip
  /// and stick are rounding.
  [[nodiscard]] double faint_force() const;

  /// Ends the phase at `now`, by the forces at `at`, and begins the next.
  void change(const ContactInstant& at, ContactInstant& now);
  /// Lets slip's direction follow the slip, after a step accepted to `now`.
  void follow(const ContactInstant& now);
  /// FrictionLaw::local: goes over between a patch that counts as a point, which can stick, and one whose points slip
  /// each for itself.
  void choose_local_slip(ContactInstant& now);
  /// Error of the velocities after the contact where its patch spun although it counted as stuck, its couple by bound
  /// (1) of ContactSystem instead of its limit surface: estimated from the mean slip that the spin gave its points
  /// [m/s].  Runs to any tolerance near this one err alike.
  [[nodiscard]] double left_out(double duration) const;
  /// Ends the last phase and names what there was.
  [[nodiscard]] FrictionMode end(const ContactInstant& now);

 private:
  [[nodiscard]] double slip_forward(const ContactInstant& at) const;
  [[nodiscard]] double stick_reserve(const ContactInstant& at) const;
  void start(FrictionPhase::Kind kind, const AlongGround& direction, const ContactInstant& now);
  void change_kind(const FrictionPhase& from, FrictionPhase::Kind kind, const AlongGround& direction,
                   ContactInstant& now);
  [[nodiscard]] double slow_slip() const;
  [[nodiscard]] bool spin_counts() const { return !settings_.point_friction && !system_.planar(); }
  [[nodiscard]] double slow_spin() const;
  void note_variation(FrictionPhase& phase, const ContactInstant& now) const;
  [[nodiscard]] double spin_speed(const ContactDiagnosis& now) const;
  void note_held_spin(const ContactInstant& now);
  [[nodiscard]] FrictionLog::Sums sums(const ContactInstant& now) const;

  ContactSystem& system_;
  Settings settings_;
  ContactScales scales_;
  FrictionLog log_;
  bool from_rest_ = false;    ///< whether the contact began without slip and has not stuck since
  bool has_slipped_ = false;  ///< whether a slip phase with spin has come to where it can end
  double noted_time_ = 0;     ///< until which that of a stuck patch has been noted [s]
  double held_way_ = 0;       ///< of its points by its spin [m]
};

// What Coulomb's law of a patch taken as flat leaves out: the slip of its points from turning times depth.

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
