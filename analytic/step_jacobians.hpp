// Derivatives of an impact and of a flight with respect to the state before, for error_growth.hpp.
//
// The state (t, α, u, s, Ω, ΣP) is that of a body one of whose vertices touches the ground, with
// that vertex's normal velocity u and slip s; α that of local_departure().
#pragma once

#include "analytic/error_factor.hpp"
#include "analytic/flight.hpp"
#include "analytic/impact_law.hpp"

namespace clatter::analytic {

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

/// An impulse and what it changes.
struct ImpactResponse {
  double normal = 0;      ///< P_n [N·s]
  double tangential = 0;  ///< P_t [N·s]
  double separation = 0;  ///< u after it [m/s]
  double push = 0;        ///< change of s [m/s]
  double turn = 0;        ///< change of Ω [rad/s]
};

/// Derivatives of an impact with respect to the state before it.
struct ImpactDerivatives {
  StateVector normal{}, tangential{};
  StateMatrix state{};  ///< of the state after it
};
/// By central differences of strike() and strike_flat(), which are homogeneous in the velocities;
/// relative accuracy 1e-9.
[[nodiscard]] ImpactDerivatives impact_derivatives(const StruckState& struck, const Impact& impact);

/// A flight for its Jacobian.
struct FlownState {
  PlanarBody body;      ///< as turned_body() at the departure
  Departure departure;  ///< local
  Arrival arrival;
};

/// Derivatives of h of a vertex at a fixed time after the departure, with respect to the state
/// there.
[[nodiscard]] StateVector height_gradient(const FlownState& flown, int vertex, double time);
/// Derivatives of a flight from touch to touch.
struct FlightDerivatives {
  StateMatrix state{};      ///< of the state at the arrival
  StateVector of_time{};    ///< of the state with respect to the time of arrival
  double velocity = 0;      ///< h′ of the arriving vertex [m/s]
  double acceleration = 0;  ///< h″ [m/s²]
};
[[nodiscard]] FlightDerivatives flight_derivatives(const FlownState& flown);

/// Gradients of V_n, V_t and the energy of the body as functions of the state.
struct MotionGradients {
  StateVector normal{}, tangential{}, energy{};

  /// @param d of the vertex that touches; gravity [m/s²]
  MotionGradients(const PlanarBody& body, const ContactPoint& d, const PlanarVelocity& v,
                  double gravity);
};

}  // namespace clatter::analytic
