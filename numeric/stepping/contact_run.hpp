// SPDX-License-Identifier: GPL-3.0-or-later
// One contact from touch-down to lift-off.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/friction_phases.hpp"
#include "numeric/stepping/steady_motion.hpp"
#include "numeric/stepping/step_control.hpp"
#include "numeric/stepping/step_events.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

/// How a contact is run.
struct ContactControl {
  StepSettings steps;
  long evaluation_limit = 0;         ///< of the system's count, at which the run stops
  bool estimate_local_slip = false;  ///< see ContactResult::local_slip
  double least_local_slip = 0;       ///< part of the contact's mean force below which laws of friction count as equal
  bool point_friction = false;       ///< see World
  bool is_pressed = false;           ///< whether the body begins in the ground, and not at it
};

/// Called after every accepted step, and before that with a peak of the force inside it; returns false to stop.
using ContactObserver = std::function<bool(const ContactInstant&)>;
/// Sees instants within accepted steps, each the end of a shorter step from that step's beginning, of which the run
/// itself keeps nothing.
struct StepObserver {
  std::vector<double> parts{};  ///< of a step's length, ascending, 0 first and 1 last
  /// Called with each step: its instants at `parts`.
  std::function<void(std::span<const ContactInstant>)> show = nullptr;
  std::vector<double> times{};  ///< after touch-down, ascending, from 0 on [s]
  /// Called with each of `times` before the end of the contact, by its number: the instant, or null where a number of
  /// it is not finite.  Its evaluations are ContactSystem::evaluations_aside.
  std::function<void(std::size_t, const ContactInstant*)> at_time = nullptr;
};

/// Integrates Eq. 3 of Shan et al. (2005), U̇ = R(U), over a contact:
///
///     scales ← expected depth, speed and time of the contact                      contact_scales
///     phase  ← stick or slip                                                      FrictionPhases::begin
///     repeat
///         trial ← end of a step that is accurate and steps over no touch          StepControl::find
///         if nothing touches at trial:
///             trial ← where the deepest vertex leaves the ground                  EventLocator::lift_off
///         if the phase of friction is over at trial:
///             trial ← where the phase ends;  accept;  change the phase            EventLocator::fall, FrictionPhases
///         else accept
///     until lift-off, rest, a limit, or the observer ends it
///
///     accept: count touches;  look for a peak of F_n and of depth;  now ← trial;  slip's direction follows
class ContactRun {
 public:
  ContactRun(ContactSystem& system, Stepper& stepper);

  /// `touch` has its lowest vertices on the ground or in it, `point` (body frame) is their mean; of a body that is
  /// pressed it is the pressure centre.
  [[nodiscard]] ContactResult run(const MotionState& touch, const Vector3& point, const ContactControl& control,
                                  const ContactObserver& observe = nullptr, const StepObserver& steps = {});

 private:
  void begin(const MotionState& touch, const Vector3& point);
  [[nodiscard]] std::optional<ContactEnding> advance();
  [[nodiscard]] std::optional<ContactEnding> ending_on_the_ground();
  bool handle_friction_event(double h);
  void accept(const ContactInstant& next);
  void show_step(const ContactInstant& next);
  void show_times(const ContactInstant& next);
  [[nodiscard]] double kept_up_speed() const;
  void collect();
  void come_to_rest(const GroundMotion& motion);

  ContactSystem& system_;
  ContactStep step_;
  StepControl steps_;
  EventLocator events_;
  ForcePeak peak_;
  DeepestPoint deepest_;
  FrictionPhases friction_;
  TouchCounter touches_;
  RockingWatch rocking_;
  LocalSlipEstimate local_slip_;

  const ContactControl* control_ = nullptr;    ///< of the present run
  const ContactObserver* observer_ = nullptr;  ///< of the present run
  const StepObserver* shown_ = nullptr;        ///< of the present run
  std::vector<ContactInstant> inside_;         ///< of the step that is shown
  std::size_t next_time_ = 0;                  ///< of those that are shown
  ContactInstant now_, trial_, faint_, aside_;
  int switches_ = 0;  ///< of friction since the last step without one
  ContactResult result_;
};

}  // namespace clatter::numeric
