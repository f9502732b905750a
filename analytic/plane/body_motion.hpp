// SPDX-License-Identifier: GPL-3.0-or-later
// A planar body on its way from impact to impact.
#pragma once

#include <optional>

#include "analytic/base/angle.hpp"
#include "analytic/plane/body.hpp"
#include "analytic/plane/flight.hpp"
#include "analytic/plane/impact.hpp"

namespace clatter::analytic {

// The elastic, frictionless impacts of a uniform thin rod as reflections, free of cancellation.
//
// In the plane of X = V_n and Y = kΩ kinetic energy is a circle, and an elastic frictionless impact of
// an end is the reflection that turns the state's angle χ into 2ψ + π − χ, where tan ψ = ∓√3 cos α for
// ends b and a.  For a rod that lies flat ψ = ±π/3, so χ stays a multiple of π/3 plus a small
// deviation.  Keeping these two apart keeps the digits of whatever nearly cancels: Ω after the third
// impact, 2 − ΣP, V + Ω/6.

/// Where an end strikes: ψ = sense·(π/3 − tilt).
struct ReflectionAxis {
  int sense = 1;        ///< +1 for end a, −1 for end b (at |α| < 90°)
  double tilt = 0;      ///< δ >= 0 [rad], about (√3/4)·α²/2 for small α
  double cosine = 0.5;  ///< cos ψ
};

/// u = (1 − c)/(1 + 3c) = s²/[(1 + c)(1 + 3c)], so that tan(tilt) = √3 u.  Accuracy: 2 ulp.
[[nodiscard]] double tilt_tangent(double sine, double cosine);

/// Axis of an end at x = ±L/2 when the rod's inclination has this sine and cosine.
/// Accuracy: tilt 4 ulp, however small.
[[nodiscard]] ReflectionAxis reflection_axis(bool left_end, double sine, double cosine);

/// Velocity state (V, Ω) of a rod of length L: speed·(cos χ, sin χ) with χ = sextant·π/3 + deviation.
struct ElasticFrame {
  double speed = 0;      ///< √(V² + k²Ω²) [m/s]; 0: the frame carries nothing
  int sextant = 0;       ///< in 0..5
  double deviation = 0;  ///< [rad]

  [[nodiscard]] double normal() const;                ///< V [m/s]
  [[nodiscard]] double angular(double length) const;  ///< Ω = 2√3 speed sin χ/L [rad/s]
  /// Normal velocity of the end on the axis: V − Ω d_t.
  [[nodiscard]] double contact_velocity(const ReflectionAxis& axis) const;
  /// Elastic impact; returns the impulse per unit mass, −2 speed cos(χ − ψ) cos ψ.
  double reflect(const ReflectionAxis& axis);
};

// Small departures of the elastic rod's contact angles from the limit θ : β : γ = 2 : 1 : 2.

/// η = β − θ/2 and ε = γ − θ for e = 1, without friction and gravity.  Both are of the order θ³ and keep
/// their relative accuracy; β = θ/2 + η and γ = θ + ε are then good to an ulp for small θ.
/// With K₁ = −1/3 + k₁ and K₂ = 1/3 + k₂ (k of the order θ²) and d(x) = x − sin x the two contact
/// equations lose all terms of first order:
///     sin(θ/2 + η) − sin(θ/2) − K₁ η = (3/2) k₁ θ − d(θ) + d(θ/2),                               (1)
///     sin(θ + ε) − sin θ − K₂ ε = (3/2) k₂ θ + (1 + K₂) η + d(θ) − d(β).                          (2)
/// @param beta, gamma the roots as found by the flight, to start from.
[[nodiscard]] double first_offset(const Angle& theta, double beta);
[[nodiscard]] double second_offset(const Angle& theta, double eta, double gamma);

/// State of a body at an impact or during the flight after it, with strike() and fly() to advance it.
///
/// The velocity of a uniform thin rod is the sum of an elastic frame and a remainder, as long as the
/// remainder (gravity, restitution below 1, friction) is the smaller part; any other body has it all in
/// the remainder.
///
/// Bounces that become ever smaller keep their digits: the velocity of the vertex that arrives is carried from the one
/// that struck last wherever V_n − Ω d_t would cancel, and a body that has turned over is described by the inclination
/// of the face that is now below, which is small where that face comes to rest.
class BodyMotion {
 public:
  /// The body with the given inclination, touching the ground with its lowest vertices; a face within 8ε of level is
  /// level, but for a thin rod.
  /// @param gravity, gravity_along  as Drop's [m/s²]
  BodyMotion(const PlanarBody& body, const Angle& inclination, const PlanarVelocity& velocity, double gravity,
             double gravity_along = 0);

  /// Vertices at the height of the lowest one, to rounding of the inclination given.
  [[nodiscard]] VertexSet lowest_vertices() const;

  struct Strike {
    Impact impact;
    VertexSet vertices = 0;  ///< which took part
  };
  /// Impact of these vertices by `law`; a group that strike_flat cannot treat strikes with its fastest
  /// vertex alone.
  Strike strike(VertexSet vertices, const ImpactLaw& law);

  /// How the body leaves the ground after strike().
  [[nodiscard]] Departure departure() const;
  /// The same for turned_body(), whose inclination is that of the face below.
  [[nodiscard]] Departure local_departure() const;
  /// Flies to the next arrival, if there is one; the state is then the one before that impact.
  Flight fly();

  [[nodiscard]] PlanarVelocity velocity() const;
  [[nodiscard]] double inclination() const;
  /// In [0, π/2]; keeps its relative accuracy where a face comes to rest on the ground.
  [[nodiscard]] double contact_angle() const;
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] double centre_height() const { return centre_height_; }
  [[nodiscard]] ContactPoint contact_point(int vertex) const { return turned_.contact_point(vertex, sine_, cosine_); }
  /// Velocity of the contact point of `vertex`, from V, Ω, or from what was carried if `vertex` arrived last.
  [[nodiscard]] ContactVelocity contact_velocity(int vertex) const;
  /// Translational, rotational and potential energy.
  [[nodiscard]] double energy() const;
  [[nodiscard]] const ElasticFrame& frame() const { return frame_; }
  /// γ − θ after the second flight of an elastic, frictionless, gravity-free thin rod.
  [[nodiscard]] std::optional<double> elastic_offset() const {
    return elastic_flights_ == 2 ? std::optional(offset_) : std::nullopt;
  }
  /// Velocity beyond the frame's.
  [[nodiscard]] const PlanarVelocity& remainder() const { return remainder_; }
  [[nodiscard]] const PlanarBody& body() const { return body_; }
  /// The rounding errors of contact_velocity() since the last impact are below 4ε × these [m/s].
  [[nodiscard]] double normal_scale(int vertex) const;
  [[nodiscard]] double slip_scale(int vertex) const;
  /// Slip of the vertex that struck last, as it leaves [m/s].
  [[nodiscard]] double slip() const { return slip_; }
  /// The body turned by quarters, as local_departure() sees it.
  [[nodiscard]] const PlanarBody& turned_body() const { return turned_; }
  /// Lowest turning point that each vertex passed above the ground in the last flight; infinite clearance: none.
  [[nodiscard]] const Passes& passes() const { return passes_; }

 private:
  /// What the vertex that arrived knows of its velocity beside V_n − Ω d_t and V_t + Ω d_n.
  struct Carried {
    int vertex = -1;
    ContactVelocity velocity;
    double normal_scale = 0;  ///< its rounding error is below 4ε × this [m/s]
    double slip_scale = 0;
  };
  void turn_to_face_below();
  /// inclination() less that of turned_body(): quarters, and a whole turn where inclination() leaves one out.
  [[nodiscard]] double beyond_turned_body() const;
  /// Sets the inclination of turned_body(), `local`, which is that of the given body, `given`, less whole turns and
  /// quarters.
  void turn_to(double local, double given);
  void carry(const Departure& departure, const Arrival& arrival);
  void keep_contact_velocity(const ContactPoint& d, Impact& impact);
  [[nodiscard]] ContactVelocity absolute_scale(int vertex) const;
  [[nodiscard]] bool frame_carries(int vertex, const ContactVelocity& contact) const;
  Impact strike_point(int vertex, const ImpactLaw& law);
  void strike_framed(int vertex, Impact& impact);
  void renew_frame_velocity();
  void collapse_frame();
  void refine(Arrival& arrival);

  PlanarBody body_;
  PlanarBody turned_;  ///< body_ turned by `quarters_` times 90°
  double gravity_, gravity_along_;
  int quarters_ = 0;                    ///< in −1..2
  double inclination_, sine_, cosine_;  ///< of turned_
  double time_ = 0;
  double centre_height_ = 0;
  double way_ = 0;  ///< of the centre of mass along x since the first touch [m]
  Angle initial_;
  int elastic_flights_ = 0;  ///< flights so far on the frame alone; −1: it has been left
  double offset_ = 0;        ///< η or ε of the last of them
  ElasticFrame frame_;
  PlanarVelocity frame_velocity_;  ///< of frame_, while it carries something
  PlanarVelocity remainder_;
  VertexSet touching_ = 0;
  int reference_ = 0;
  double rebound_speed_ = 0;
  double slip_ = 0;  ///< of the reference vertex as it leaves [m/s]
  Carried carried_;
  PlanarVelocity scale_;  ///< sizes of the parts that V_n and V_t of the remainder were put together from
  Passes passes_{};
};

}  // namespace clatter::analytic
