// SPDX-License-Identifier: GPL-3.0-or-later
// What a blow is worth to a part of known natural frequency and fragility, and to a shock machine.
#pragma once

#include <array>
#include <optional>
#include <string>

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

/// What a part bears, in the terms that are known of it.
struct FragilePart {
  enum class Kind {
    oscillator,  ///< on an undamped mount of its natural frequency it fails at its fragility
    at_place,    ///< it fails where its place has its fragility as peak
    tested,      ///< it bore a half sine of its fragility as peak and of its duration
    unlimited    ///< an oscillator of which nobody said what it bears: its fragility is 1 g, so that margins rank it
  };
  double frequency = 0;  ///< natural [Hz], > 0; of an oscillator, with a limit or without one
  double fragility = 0;  ///< A_s [m/s²], > 0
  double duration = 0;   ///< of the tested half sine [s], > 0
  Kind kind = Kind::oscillator;
  std::string probe{};  ///< the name of the point where it is; empty: nobody said, so that any point may be its place

  [[nodiscard]] bool is_at(const std::string& place) const { return probe.empty() || probe == place; }
  [[nodiscard]] bool has_limit() const { return kind != Kind::unlimited; }
  /// What it answers with where it has this margin [m/s²].
  [[nodiscard]] double response_at(double margin) const { return fragility / margin; }
  /// The undamped oscillator that the part is, or that has the damage boundary of the half sine which it bore: by two
  /// tests V_c = A_s/ω and A_c = A_s/2 of a rectangle, so that 2AT/π and A give f = 1/(2T) and A_s = 2A.  None of a
  /// part at its place, which has its peak as response.
  [[nodiscard]] std::optional<FragilePart> oscillator() const;
};

/// The damage boundary of ASTM D3332 in the plane of a pulse's change of velocity V and its peak A: a part fails to
/// the right of V_c and above A_c.  Two tests of a shock machine give the two lines there; where one tested half sine
/// is all that is known, its own change of velocity and peak stand for them.
struct DamageBoundary {
  double critical_velocity = 0;      ///< V_c = A_s/ω, of a tested pulse 2 A T/π, below which no peak fails it [m/s]
  double critical_acceleration = 0;  ///< A_c = A_s over the largest response, below which no V fails it [m/s²]
  double corner_velocity = 0;        ///< from which A_c holds; rectangle: (π/2) V_c [m/s]
};
/// A part known by a tested pulse or at its place has one boundary for both shapes: A_c = A_s, and V_c = 0 at its
/// place.
[[nodiscard]] DamageBoundary damage_boundary(const FragilePart& part, PulseShape shape);
/// At most 1, it fails: A_s over the part's acceleration under the pulse of this change of velocity and peak; of a part
/// without a natural frequency the larger of V_c/V and A_c/A.
[[nodiscard]] double margin(const FragilePart& part, PulseShape shape, double velocity, double acceleration);

/// The least margin of a blow: under rectangle, half sine and, where it is known, its own history.
struct BlowMargin {
  enum class By { velocity, peak, history };
  double value = 0;
  By by = By::peak;  ///< what decides it

  [[nodiscard]] const char* verdict() const { return value > 1 ? "survives" : "fails"; }
};
/// @param response  largest acceleration of the part's oscillator under the blow itself [m/s²]; 0: not known
[[nodiscard]] BlowMargin blow_margin(const FragilePart& part, double velocity, double acceleration,
                                     double response = 0);
/// V_c/V, the margin whatever the peak is, which is less than any other.  Domain: no part at its place.
[[nodiscard]] double velocity_margin(const FragilePart& part, double velocity);

/// "a part of 500 Hz at crystal that bears 300 g".
[[nodiscard]] std::string words_of(const FragilePart& part);
/// What to type for it: "500:300", "crystal:1500g:2ms", "400Hz".
[[nodiscard]] std::string part_text(const FragilePart& part);

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
