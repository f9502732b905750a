// SPDX-License-Identifier: GPL-3.0-or-later
// A drop through the continuous-contact model: impact after impact, with free flight between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/drop/impact_record.hpp"
#include "numeric/drop/settings.hpp"
#include "numeric/drop/state_record.hpp"
#include "numeric/motion/ground_motion.hpp"
#include "numeric/motion/motion_state.hpp"
#include "numeric/motion/start.hpp"

namespace clatter::numeric {

/// Where a body has come to rest.
struct Rest {
  double time = 0;                  ///< after the first touch-down [s]
  Vector3 place = Vector3::Zero();  ///< of the centre of mass [m]
  double distance = 0;              ///< along the ground from the last touch-down, straight [m]
  double slid = 0;                  ///< the part of it over which it slid with a constant deceleration to the end [m]
};

struct Simulation {
  std::vector<ImpactRecord> impacts;
  Outcome outcome = Outcome::no_further_impact;
  std::string message;                                ///< the outcome in words, with numbers
  std::vector<std::string> warnings;                  ///< of impacts so deep that the ground is no model of them
  Method method = Method::rk8pd;                      ///< that was used
  double tolerance = 0;                               ///< relative, per step; 0 for a fixed step
  double step = 0;                                    ///< fixed step [s]; 0 for an adaptive method
  long force_evaluations = 0;                         ///< of all runs, with those for error estimates and amplification
  long root_evaluations = 0;                          ///< of touch-down searches
  double energy_start = 0;                            ///< at the first touch-down [J]
  MotionState final_state;                            ///< at the end of the last listed impact
  std::optional<Rest> rest;                           ///< of Outcome::at_rest
  std::optional<GroundMotion> on_ground;              ///< how it goes on, of that and of Outcome::sustained_contact
  double on_ground_from = 0;                          ///< after the first touch-down [s]
  std::vector<StateRecord> states;                    ///< at Request::times
  long state_evaluations = 0;                         ///< of contact forces, for those and for pieces of history
  [[nodiscard]] double total_normal_impulse() const;  ///< [N·s]
};

/// Runs the drop from the state `start`, whose lowest vertex lies at or above the ground.
/// @throws std::domain_error if world, request or accuracy are not valid, the start lies below the ground or a time
/// before the start.
[[nodiscard]] Simulation simulate(const Body& body, const World& world, const MotionState& start,
                                  const Request& request = {}, const Accuracy& accuracy = {},
                                  const Observer& observer = {});

}  // namespace clatter::numeric
