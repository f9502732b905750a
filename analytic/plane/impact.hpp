// SPDX-License-Identifier: GPL-3.0-or-later
// One impact of a planar body: impulse and momentum with a restitution law and friction.
//
// With d = (d_t, d_n) from the centre of mass to the contact point and I = m k², an impulse (P_t, P_n)
// changes the velocity of the contact point (s tangential, u normal) by
//     m Δu = A P_n − B P_t,      m Δs = C P_t − B P_n,                                          (a)
//     A = 1 + (d_t/k)²,   C = 1 + (d_n/k)²,   B = d_t d_n/k².                                   (b)
// Everything below is Eq. 8 of Shan et al. (2005) written with (a).
#pragma once

#include <optional>

#include "analytic/law/impact_law.hpp"
#include "analytic/plane/body.hpp"

namespace clatter::analytic {

/// Comes first in a struct whose members are to be given by name: {0, 0, -1} is then none.
struct ByName {
  explicit ByName() = default;
};

/// Velocity of a planar body [m/s, rad/s]; angular > 0 turns z towards x (clockwise on the page), the
/// sign of Eq. 8.
struct PlanarVelocity {
  [[no_unique_address]] ByName by_name{};
  double normal = 0;      ///< of the centre of mass, up
  double tangential = 0;  ///< of the centre of mass, to the right
  double angular = 0;     ///< Ω = ω_y
};

/// An impulse and what it did.
struct Impact {
  double normal_impulse = 0;      ///< P_n [N·s], >= 0
  double tangential_impulse = 0;  ///< P_t [N·s]
  double approach_speed = 0;      ///< −u of the contact point before [m/s]
  double separation_speed = 0;    ///< u of the contact point after [m/s]
  double slip_before = 0;         ///< s before [m/s]
  double slip_after = 0;          ///< s after [m/s]
  ImpactMode mode = ImpactMode::frictionless;
  PlanarVelocity after;     ///< of the centre of mass
  double energy_loss = 0;   ///< [J]; negative: the impulse ratio as given creates energy
  bool tilts = false;       ///< a flat landing that friction tilts: not all of it rebounds as a whole
  bool is_limited = false;  ///< a flat landing whose e is less than the law's, lest it gain energy

  /// P_t/P_n, 0 without an impulse.
  [[nodiscard]] double impulse_ratio() const;
  /// Separation over approach speed as it came out; 0 without approach.
  [[nodiscard]] double restitution() const;
};

/// A, B, C of (b).  Accuracy: 3 ulp each.
[[nodiscard]] ContactInertia contact_inertia(double gyration_square, const ContactPoint& d);

/// Velocity of the contact point: u = v_n − ω d_t, s = v_t + ω d_n.
struct ContactVelocity {
  double normal = 0;  ///< u [m/s]
  double slip = 0;    ///< s [m/s]
};
[[nodiscard]] double normal_velocity(const PlanarVelocity& v, const ContactPoint& d);
[[nodiscard]] double slip_velocity(const PlanarVelocity& v, const ContactPoint& d);

/// Eq. 8: impact at one contact point,
///     P_n = −(1+e) m u / (A − μ_i B),   P_t = μ_i P_n,                                          (1)
/// for an impulse ratio, or Routh's path in impulse space for Coulomb's law, in closed form for each
/// restitution law.  A point that does not approach (u >= 0) gets no impulse.
/// The energy loss is −(P_n (u + u′) + P_t (s + s′))/2, an identity of (a) that does not cancel.
/// Accuracy: a few ulp × condition number of (1).  Source: Eq. 8, signs as there.
/// @throws OutsideModelError if the impulse ratio given is at or beyond the jamming limit
///         (A − μ_i B <= 0); NumericalError if so close to it that the impulse overflows;
///         std::domain_error as ImpactLaw::validate().
[[nodiscard]] Impact strike(const PlanarBody& body, const PlanarVelocity& before, const ContactPoint& contact,
                            const ImpactLaw& law);

/// The same with a velocity of the contact point that is known better than v_n − ω d_t and v_t + ω d_n are: impulse and
/// separation then keep the relative accuracy of u, however small beside v_n.
[[nodiscard]] Impact strike(const PlanarBody& body, const PlanarVelocity& before, const ContactVelocity& velocity,
                            const ContactPoint& contact, const ImpactLaw& law);

/// Eq. 10 for two vertices that strike together (flat landing).  Rule: the body rebounds as a whole,
///     V_n = −e v_n,   Ω = −e ω,                                                                 (2)
/// so that every vertex of the group leaves at e times its approach speed, with the tangential impulse
/// of the friction law acting at the ground, stopped where slip stops.  For ω = 0 this is Eq. 10 as
/// printed.  The restitution laws agree here, since slip does not couple to the normal motion; the viscoelastic
/// law takes e at the approach speed of the pressure centre, −v_n − k² ω²/v_n (coulomb_path.hpp).
/// While slip, or rest, goes on, (2) asks for pushes at d_t = R₀ + μ_i d_n, R₀ = −k² ω/v_n; beyond one of the two
/// vertices they act at that vertex, and Ω changes by what they and friction make of it. Returns nothing if R₀, or d_t
/// without friction or with an impulse ratio, is not between the vertices and pushes would have to pull: then the
/// vertices strike one after the other, the faster approach first.
/// Where friction has stopped slip, the rebound that (2) prescribes can do work on the body, by pushes beside R₀. Under
/// every law but Newton's the landing then rebounds by the largest e without a gain of energy,
/// as Impact::is_limited says.
[[nodiscard]] std::optional<Impact> strike_flat(const PlanarBody& body, const PlanarVelocity& before,
                                                const ContactPoint& first, const ContactPoint& second,
                                                const ImpactLaw& law);

}  // namespace clatter::analytic
