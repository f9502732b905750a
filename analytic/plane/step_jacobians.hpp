// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of an impact and of a flight with respect to the state before, for error_growth.hpp.
//
// The state (t, α, u, s, Ω, ΣP) is that of a body one of whose vertices touches the ground, with
// that vertex's normal velocity u and slip s; α that of local_departure().
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "analytic/plane/flight.hpp"
#include "analytic/plane/impact.hpp"

namespace clatter::analytic {

/// Time, inclination, normal velocity and slip of the contact point, Ω, and the sum of the normal
/// impulses so far.
inline constexpr std::size_t state_size = 6;
using StateVector = std::array<double, state_size>;
/// Rows: derivatives of one number of the new state with respect to the numbers of the old one.
using StateMatrix = std::array<StateVector, state_size>;

/// J v.
[[nodiscard]] StateVector product(const StateMatrix& jacobian, const StateVector& vector);

/// Places of the numbers in a StateVector.
enum StateIndex : std::size_t { at_time, at_angle, at_normal, at_slip, at_turn, at_sum };

/// An impact for its Jacobian.
struct StruckState {
  PlanarBody body;
  ImpactLaw law;
  PlanarVelocity before;
  ContactVelocity contact;  ///< of the vertex, before
  ContactPoint place;       ///< of the vertex that struck
  ContactPoint second;      ///< of the other one of a flat landing
  bool flat = false;
};

/// Derivatives of an impact with respect to the state before it.
struct ImpactDerivatives {
  StateVector normal{}, tangential{};
  StateMatrix state{};  ///< of the state after it
};
/// From the equations of strike() and strike_flat() by forward-mode differentiation; of the branch
/// of the law that the impact has taken.  Relative accuracy: 1e-9.
[[nodiscard]] ImpactDerivatives impact_derivatives(const StruckState& struck, ImpactMode mode);

/// Derivatives of an impact with respect to one number of its law.
struct LawColumn {
  double normal = 0, tangential = 0;
  StateVector state{};  ///< of the state after it
  double part = 0;      ///< size of the parts of `normal` and `tangential`, which may cancel
  StateVector parts{};  ///< likewise of `state`
};
/// With respect to e, and to Coulomb's μ or the impulse ratio; without friction those of Coulomb's μ from above.  Of
/// the branch of the law that the impact has taken.
struct LawDerivatives {
  LawColumn restitution, friction;
};
[[nodiscard]] LawDerivatives law_derivatives(const StruckState& struck, ImpactMode mode);

/// A flight for its Jacobian.
struct FlownState {
  PlanarBody body;      ///< as turned_body() at the departure
  Departure departure;  ///< local
  Arrival arrival;
};

/// A moment of a flight.
struct Moment {
  double time;        ///< since the departure [s]
  detail::Turn turn;  ///< |Ω| × time

  Moment(const Departure& departure, double at) : time(at), turn(std::fabs(departure.angular) * at) {}
};

/// Derivatives of h of a vertex at a fixed time after the departure, with respect to the state
/// there.
[[nodiscard]] StateVector height_gradient(const FlownState& flown, int vertex, const Moment& moment);
/// Derivatives of a flight from touch to touch.
struct FlightDerivatives {
  StateMatrix state{};      ///< of the state at the arrival
  StateVector of_time{};    ///< of the state with respect to the time of arrival
  double velocity = 0;      ///< h′ of the arriving vertex [m/s]
  double acceleration = 0;  ///< h″ [m/s²]
};
/// @param touch that of the arrival
[[nodiscard]] FlightDerivatives flight_derivatives(const FlownState& flown, const Moment& touch);

/// Gradients of V_n, V_t and the energy of the body as functions of the state.
struct MotionGradients {
  StateVector normal{}, tangential{}, energy{};

  /// @param d of the vertex that touches; gravity [m/s²]
  MotionGradients(const PlanarBody& body, const ContactPoint& d, const PlanarVelocity& v, double gravity);
};

}  // namespace clatter::analytic
