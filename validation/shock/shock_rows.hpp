// SPDX-License-Identifier: GPL-3.0-or-later
// What each impact does to points of the body: its numbers, and those of the continuous model.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "validation/output/estimated.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/point_motion.hpp"

namespace clatter::validation {

/// The numbers of one impact at one point; the same struct holds their errors, not finite where not known.  The
/// discrete model has the two changes alone, the rest is 0.
struct ShockNumbers {
  Vector3 delta_v = Vector3::Zero();      ///< change of the point's velocity over the impact, world [m/s]
  double delta_v_size = 0;                ///< |ΔV| [m/s]
  Vector3 peak = Vector3::Zero();         ///< specific force when it is largest, body axes [m/s²]
  double peak_size = 0;                   ///< its size [m/s²]
  double peak_time = 0;                   ///< when, after the touch-down [s]
  double width = 0;                       ///< how long it stays above a tenth of that about it, within the contact [s]
  Vector3 delta_omega = Vector3::Zero();  ///< change of the body's angular velocity, world [rad/s]
  double delta_omega_size = 0;            ///< [rad/s]
  double peak_alpha = 0;                  ///< largest |ω̇| of the body [rad/s²]

  [[nodiscard]] static ShockNumbers unknown();
};

struct ShockRow {
  int impact = 0;  ///< from 1
  std::size_t probe = 0;
  double start = 0;     ///< of the touch-down [s]
  double duration = 0;  ///< [s]
  ShockNumbers value, error;
  Vector3 delta_v_body = Vector3::Zero();  ///< ΔV in body axes at the touch-down [m/s]
  double start_error = 0;                  ///< [s]
  bool predictable = true;
  /// The piece of the recorded motion in which the peak lies, and where in it, from 0 to 1: where the force jumps, as
  /// when friction turns, two pieces meet at one time, and the peak is that of one of them.
  std::size_t peak_piece = 0;
  double peak_place = 0;
  /// |∫a dt − ΔV| over |ΔV|, a the acceleration of the point by specific_force(): what the polynomials of the history
  /// leave open.
  double closure = 0;
  /// ∂ ln(peak)/∂ ln k_G with c_G/k_G held, which keeps the restitution.
  std::optional<Estimated> sensitivity;
  /// undamped_response() to the impact alone, by natural frequency [Hz]: of each part's oscillator.
  std::map<double, Estimated> responses{};

  /// What a part's oscillator responds with, its error not finite where it is not known; none without a history.
  [[nodiscard]] std::optional<Estimated> response_of(const FragilePart& part) const;
};

/// When the first landing ends: the time in which the body goes its own length at the speed of its first approach,
/// after the first touch [s].  Impacts that begin by then are blows of one landing; later ones follow a bounce.
/// @param approach_speed  of the first impact [m/s]
[[nodiscard]] double landing_end(const Scene& scene, double approach_speed);
/// The part's least margin under a row; without peaks, of the discrete model, that by its change of velocity.
[[nodiscard]] BlowMargin blow_margin(const ShockRow& row, const FragilePart& part, bool has_peaks);
/// The same with its error.
[[nodiscard]] Estimated margin_of(const ShockRow& row, const FragilePart& part, bool has_peaks);

/// What of a recorded drop is asked for.
struct RecordedShock {
  const std::vector<Vector3>& places;  ///< of the probes, from the centre of mass, body frame [m]
  double mass = 0;                     ///< [kg]
  double gravity = 0;                  ///< that acts in contacts [m/s²]
  std::vector<FragilePart> parts{};    ///< to whose oscillators rows have responses
};
/// The rows of a recorded drop, an impact after the other, and in each a probe after the other, without errors but
/// those of polynomials.
[[nodiscard]] std::vector<ShockRow> shock_rows(const MotionRecorder& motion, const RecordedShock& asked);

/// The continuous model's shock at the scene's probes.
struct ContinuousShock {
  PlannedRun planned;
  std::vector<ShockRow> rows;
  MotionRecorder motion;  ///< of the drop by the settings of `planned`
  MotionRecorder other;   ///< of the drop by a tenth of its tolerance (ten times it where there is none below) or step
  double error_per_distance = 0;  ///< how many times the distance of the two an error may be
  std::vector<double> trust;      ///< relative error of each impact's impulse, infinite from where the runs part
};
/// What of it is asked for beside rows.
struct ContinuousRequest {
  std::vector<FragilePart> parts{};  ///< to whose oscillators rows have responses
  bool sensitivity = false;
  bool keeps_motion = true;  ///< else of no recording more than a contact is held at a time
  numeric::Observer observer{};
};
/// Runs the scene to its digits, then again twice, recorded, where no errors are asked for once, and with the
/// sensitivity four times more at neighbouring stiffness.
/// @param places  of the probes, from the centre of mass, body frame [m]
/// @throws as run_to_digits.
[[nodiscard]] ContinuousShock continuous_shock(const Scene& scene, const numeric::Body& body,
                                               const std::vector<Vector3>& places,
                                               const ContinuousRequest& request = {});

// What each impact of the discrete model does to points of the body.

/// The changes of velocity, with errors from those of the impulse P and the attitude φ at each impact:
///     ΔV = ΔV_c + Δω × r,   |δΔV| <= |δP|/m + |r| |δΔω| + |Δω × r| |δφ|,
///     |δΔω| <= K |δP| + 2 |Δω| |δφ|,   K the largest |I⁻¹ (r_c × p)| of unit impulses p at what strikes.
/// A sequence's infinitely many impacts after its last row are left out.
/// @param places  of the probes, from the centre of mass, body frame [m]
[[nodiscard]] std::vector<ShockRow> discrete_shock(const DiscreteDrop& drop, const DiscreteSequence& sequence,
                                                   const std::vector<Vector3>& places);

}  // namespace clatter::validation
