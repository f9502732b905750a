// One contact from touch-down to lift-off.
#pragma once

#include <functional>
#include <vector>

#include "numeric/contact/contact_system.hpp"
#include "numeric/impact_record.hpp"
#include "numeric/stepping/contact_scales.hpp"
#include "numeric/stepping/friction_log.hpp"
#include "numeric/stepping/local_slip.hpp"
#include "numeric/stepping/stepper.hpp"
#include "numeric/stepping/touch_counter.hpp"

namespace clatter::numeric {

/// An instant of a contact.
struct ContactInstant {
  double time = 0;  ///< after touch-down [s]
  ContactState state = ContactState::Zero(), rate = ContactState::Zero();
  ContactDiagnosis diagnosis;
};

/// How a contact is stepped.
struct ContactControl {
  double tolerance = 1e-10;  ///< of an adaptive method: local error <= tolerance × scale, per step
  double step =
      0;  ///< of a fixed-step method [s], at most a quarter of scales.time; 0: scales.time / steps_per_contact
  double first_step = 0;  ///< length of the first fixed step [s], at most `step`; 0: as the others
  double steps_per_contact = 300;
  double step_cap = 1;               ///< of an adaptive method: factor of the longest step and of the first one
  long evaluation_limit = 0;         ///< of the system's count, at which the run stops
  bool estimate_local_slip = false;  ///< see ContactResult::local_slip
  bool point_friction = false;       ///< see Options
  /// Called after every accepted step, and before that with a peak of the force inside it; return false to stop.
  std::function<bool(const ContactInstant&)> observe = nullptr;
};

enum class ContactEnding {
  lift_off,
  at_rest,
  sustained_contact,  ///< steady sliding or spinning that nothing stops
  evaluation_limit,
  step_too_small,
  not_representable,
  interrupted
};

struct ContactResult {
  ContactEnding ending = ContactEnding::lift_off;
  double duration = 0;                                            ///< [s]
  MotionState after;                                              ///< at the end
  double work_damping = 0, work_released = 0, work_friction = 0;  ///< [J]
  double energy_stored = 0;                                       ///< in the ground's springs at the end [J]
  double peak_force = 0;                                          ///< largest F_n [N]
  double peak_time = 0;                                           ///< after touch-down [s]
  FrictionMode mode = FrictionMode::frictionless;
  int touches = 0;
  bool submerged = false;  ///< see ImpactRecord
  ContactEnd end = ContactEnd::middle;
  ContactScales scales;
  /// Change of the tangential impulse that FrictionLaw::local would make of a contact with FrictionLaw::coulomb,
  /// estimated (LocalSlipEstimate) if asked for [N·s].
  double local_slip = 0;
  double step = 0;  ///< fixed step used [s]; 0: adaptive
};

/// Steps a contact with touch-downs, lift-off and friction switches located as roots of the numerical solution:
/// the step before an event is repeated with the length that ends on it.
class ContactRun {
 public:
  ContactRun(ContactSystem& system, Stepper& stepper);

  /// `touch` has its lowest vertices on the ground or in it, `point` (body frame) is their mean.
  [[nodiscard]] ContactResult run(const MotionState& touch, const Vector3& point, const ContactControl& control);

 private:
  using Indicator = double (ContactRun::*)(const ContactInstant&) const;

  void begin(const MotionState& touch, const Vector3& point);
  void step_to_the_end();
  void collect();
  void choose_first_phase(const MotionState& touch, const Vector3& point);
  void weigh_errors();
  [[nodiscard]] bool try_step(const ContactInstant& from, double h, ContactInstant& to);
  [[nodiscard]] double error_of_step() const;
  bool end(ContactEnding ending);
  [[nodiscard]] bool stepped_over() const;
  [[nodiscard]] bool find_step(double& h, double& next);
  [[nodiscard]] bool advance(double& h);
  void accept(const ContactInstant& next);
  void look_for_peak(const ContactInstant& next);
  bool handle_friction_event(double h);
  void change_phase();
  [[nodiscard]] double locate(Indicator indicator, double h, ContactInstant& at_root);
  [[nodiscard]] double lift_off_time(double h, ContactInstant& at_root);
  [[nodiscard]] double slip_forward(const ContactInstant& at) const;
  [[nodiscard]] double stick_reserve(const ContactInstant& at) const;
  [[nodiscard]] double force_to_judge(const ContactInstant& at) const;
  [[nodiscard]] bool is_faint(const ContactInstant& at) const;
  [[nodiscard]] bool phase_is_over(const ContactInstant& at) const;
  void start_phase(FrictionPhase::Kind kind, const AlongGround& direction);
  void watch_local_slip();
  void change_kind(const FrictionPhase& from, FrictionPhase::Kind kind, const AlongGround& direction);
  double note_variation(FrictionPhase& phase) const;
  [[nodiscard]] FrictionLog::Sums sums() const;
  [[nodiscard]] bool is_steady(const ContactInstant& at) const;
  [[nodiscard]] bool goes_on_for_ever() const;
  bool ends_on_the_ground(const ContactInstant& at);
  [[nodiscard]] FrictionMode mode() const;

  ContactSystem& system_;
  Stepper& stepper_;
  TouchCounter touches_;
  std::vector<int> submerged_;

  const ContactControl* control_ = nullptr;
  ContactScales scales_;
  ContactState weights_, error_;
  ContactInstant now_, trial_, probe_, peak_, faint_;
  ContactResult result_;
  FrictionLog log_;
  LocalSlipEstimate local_slip_;
  double stopping_speed_ = 0;  ///< slip at which the slip phase ends [m/s]
  int switches_ = 0;           ///< of friction since the last accepted step
};

}  // namespace clatter::numeric
