// SPDX-License-Identifier: GPL-3.0-or-later
// One contact from touch-down to lift-off.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

struct StepSettings {
  double tolerance = 1e-10;  ///< of an adaptive method: local error <= tolerance × scale, per step
  double step_cap = 1;       ///< of an adaptive method: factor of the longest step and of the first one
  /// Length of the steps of a fixed-step method [s], at most a quarter of scales.time; 0: scales.time /
  /// steps_per_contact.
  double step = 0;
  double first_step = 0;  ///< length of the first fixed step [s], at most `step`; 0: as the others
  double steps_per_contact = 300;
};

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
  ~ContactRun();

  /// `touch` has its lowest vertices on the ground or in it, `point` (body frame) is their mean; of a body that is
  /// pressed it is the pressure centre.
  [[nodiscard]] ContactResult run(const MotionState& touch, const Vector3& point, const ContactControl& control,
                                  const ContactObserver& observe = nullptr, const StepObserver& steps = {});

 private:
  class Contact;
  std::unique_ptr<Contact> contact_;
};

}  // namespace clatter::numeric
