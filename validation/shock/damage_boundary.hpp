// SPDX-License-Identifier: GPL-3.0-or-later
// What a blow is worth to a part of known natural frequency and fragility, and to a shock machine.
#pragma once

#include <array>

namespace clatter::validation {

inline constexpr double standard_gravity = 9.80665;  ///< [m/s²], of "g" as a unit

/// Test pulses of shock machines, of peak A and duration T.
enum class PulseShape { rectangle, half_sine };
/// Change of velocity over A T: 1 and 2/π.
[[nodiscard]] double pulse_area(PulseShape shape);
/// Largest absolute acceleration of an undamped oscillator over A, by f T > 0: during the pulse or after it.
///     rectangle: 2 from f T = 1/2 on, 2 sin(π f T) below;  half sine: at most 1.768457654, at f T = 0.809936785
/// Accuracy: 1e-14, of the half sine 1e-9 about f T = 1/2.  Source: closed forms of the equation of motion.
[[nodiscard]] double pulse_response(PulseShape shape, double frequency_times_duration);

/// A part on an undamped mount, that fails when its acceleration reaches its fragility.
struct FragilePart {
  double frequency = 0;  ///< natural [Hz], > 0
  double fragility = 0;  ///< A_s [m/s²], > 0
};

/// The damage boundary of ASTM D3332 in the plane of a pulse's change of velocity V and its peak A: a part fails to
/// the right of V_c and above A_c.
struct DamageBoundary {
  double critical_velocity = 0;      ///< V_c = A_s/ω, below which no peak fails it [m/s]
  double critical_acceleration = 0;  ///< A_c = A_s over the largest response, below which no V fails it [m/s²]
  double corner_velocity = 0;        ///< from which A_c holds; rectangle: (π/2) V_c [m/s]
};
[[nodiscard]] DamageBoundary damage_boundary(const FragilePart& part, PulseShape shape);
/// A_s over the part's acceleration under the pulse of this change of velocity and peak: at most 1, it fails.
[[nodiscard]] double margin(const FragilePart& part, PulseShape shape, double velocity, double acceleration);

/// A half sine of a shock machine.
struct TestPulse {
  double acceleration = 0;  ///< peak [m/s²]
  double duration = 0;      ///< [s]
  /// 2 A T/π [m/s].
  [[nodiscard]] double velocity() const;
  /// From which a body falls that has this change of velocity: V²/(2 g (1 + e)²) [m].  With e = 0, as standards print
  /// it, the body does not rebound.
  [[nodiscard]] double height(double restitution) const;
};
/// That with a blow's change of velocity and peak, both > 0.
[[nodiscard]] TestPulse equivalent_pulse(double velocity, double acceleration);

/// Service conditions of JESD22-B110B (JEDEC, July 2013), table 1: half sines, by falling peak, which is by falling
/// change of velocity, too.
struct ServiceCondition {
  char name;
  TestPulse pulse;
};
[[nodiscard]] const std::array<ServiceCondition, 8>& service_conditions();
/// The mildest one whose change of velocity and peak are both at least those of a blow; none: '-'.
[[nodiscard]] char covering_condition(double velocity, double acceleration);

}  // namespace clatter::validation
