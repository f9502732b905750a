// A drop through the continuous-contact model: impact after impact, with free flight between them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "numeric/body.hpp"
#include "numeric/contact/ground.hpp"
#include "numeric/history.hpp"
#include "numeric/motion/motion_state.hpp"

namespace clatter::numeric {

/// How contacts are integrated in time.
enum class Method {
  automatic,  ///< tvd_rk3 when a step is given, else rkck up to four digits and rk8pd beyond
  tvd_rk3,    ///< third-order TVD Runge–Kutta with a fixed step, the paper's method
  rk4,        ///< classical fourth order, adaptive by step doubling (GSL)
  rkf45,      ///< Runge–Kutta–Fehlberg 4(5), adaptive (GSL)
  rkck,       ///< Cash–Karp 4(5), adaptive (GSL)
  rk8pd,      ///< Prince–Dormand 8(9), adaptive (GSL)
};

/// What the user wants computed, and how.
struct Options {
  Method method = Method::automatic;
  double step = 0;      ///< of tvd_rk3 [s]; 0: chosen from `digits` and the estimated contact time
  int digits = 6;       ///< significant digits wanted, 2 to 12
  int impacts = 6;      ///< most impacts to report, >= 1
  bool planar = false;  ///< keep the motion in its x–z plane: no force or moment out of it acts
  double gravity = 9.81;       ///< [m/s²], >= 0
  long evaluation_limit = 3'000'000;  ///< of the contact forces, in the main run; then the run ends
  bool error_estimates = true;        ///< by a second run, at a coarser tolerance or step
  bool amplification = true;          ///< by a neighbouring run
  HistoryRecorder* history = nullptr;       ///< takes the time history, if any
  /// Called now and then with (impacts so far, contact force evaluations so far); return false to end the run.
  std::function<bool(int, long)> progress = nullptr;

  /// @throws std::domain_error naming field, value and what is allowed.
  void validate() const;
};

/// How friction acted during an impact.
enum class FrictionMode { frictionless, slip, stick, slip_stick, stick_slip, reverse_slip, regularised };

/// Which part of the body touched: by the sign of x′ of the vertices that were first to touch.
enum class ContactEnd { a, b, both, middle };

/// The numbers of an impact.  The same struct holds their error estimates.
struct ImpactNumbers {
  double start = 0;     ///< touch-down, after that of impact 1 [s]
  double duration = 0;  ///< until nothing touches any more [s]
  double inclination = 0;     ///< of the body's x axis at touch-down, > 0: end a lower [rad]
  double contact_angle = 0;   ///< acute angle between that axis and the ground [rad]
  double approach_speed = 0;  ///< of the touching point, downward [m/s]
  double restitution = 0;     ///< its speed of separation over that of approach; NaN with several touches
  Vector3 impulse = Vector3::Zero();  ///< of the contact force, world [N·s]
  double peak_force = 0;      ///< largest normal force [N]
  double peak_time = 0;       ///< when, after this touch-down [s]
  Vector3 velocity_after = Vector3::Zero();          ///< world [m/s]
  Vector3 angular_velocity_after = Vector3::Zero();  ///< world [rad/s]
  double energy_before = 0;   ///< translational + rotational + potential (m g z) [J]
  double energy_after = 0;    ///< [J]
  double energy_loss = 0;     ///< [J]
  double work_damping = 0;    ///< dissipated by the ground's dampers [J], >= 0
  double work_friction = 0;   ///< dissipated by friction [J]
  double work_released = 0;   ///< elastic energy left in the ground where the clamp let go [J], >= 0
};

struct ImpactRecord {
  ImpactNumbers value;
  ImpactNumbers error;       ///< estimates; NaN if there is none
  ContactEnd end = ContactEnd::a;
  int touches = 1;           ///< separate places that came down during this impact
  FrictionMode mode = FrictionMode::frictionless;
  /// Growth of a relative error of the start until the end of this impact; NaN if not asked for.
  double amplification = 0;
  /// Whether rounding errors, so grown, stay below one part in a hundred.
  bool predictable = true;
  double energy_stored = 0;  ///< left in the ground's springs: 0 after a lift-off, not at rest [J]
  /// energy_loss − work_damping − work_friction − work_released − energy_stored, over the energy at the start or
  /// that stored, whichever is larger: the ledger's gap.
  double ledger_gap = 0;
};

enum class Outcome {
  no_further_impact,   ///< nothing reaches the ground any more
  impact_limit,        ///< as many impacts as asked for
  at_rest,             ///< the body lies still on the ground
  evaluation_limit,    ///< contact goes on; the last row is unfinished and not listed
  step_too_small,      ///< the integrator cannot reach the tolerance; the last row is not listed
  not_representable,   ///< numbers of this scene leave the range or resolution of doubles
  flight_undecided,    ///< the next touch-down could not be decided within the work allowed
  interrupted,         ///< by `progress`
};

struct Simulation {
  std::vector<ImpactRecord> impacts;
  Outcome outcome = Outcome::no_further_impact;
  std::string message;  ///< the outcome in words, with numbers
  Method method = Method::rk8pd;  ///< that was used
  double tolerance = 0;           ///< relative, per step; 0 for a fixed step
  double step = 0;                ///< fixed step [s]; 0 for an adaptive method
  long force_evaluations = 0;     ///< of all runs, with those for error estimates and amplification
  long root_evaluations = 0;      ///< of touch-down searches
  double energy_start = 0;        ///< at the first touch-down [J]
  MotionState final_state;        ///< at the end of the last listed impact
  [[nodiscard]] double total_normal_impulse() const;  ///< [N·s]
};

/// How the body is dropped: attitude and velocity when its lowest point first touches.
struct Drop {
  double inclination = 0;  ///< of the body's x axis [rad]: rotation about −y from the mesh's own attitude
  Vector3 velocity = -Vector3::UnitZ();                ///< of the centre of mass, world [m/s]
  double spin = 0;         ///< Ω = ω_y [rad/s]
  double out_of_plane_tilt = 0;  ///< rotation about the body's x axis, before the inclination [rad]
};

/// State at the first touch: the lowest vertex on z = 0, the centre of mass above x = y = 0.
[[nodiscard]] MotionState touching_state(const Body& body, const Drop& drop);

/// Runs the drop from the state `start`, whose lowest vertex lies at or above the ground.
/// @throws std::domain_error if options or ground are not valid or the start lies below the ground.
[[nodiscard]] Simulation simulate(const Body& body, const Ground& ground, const MotionState& start,
                                  const Options& options);

}  // namespace clatter::numeric
