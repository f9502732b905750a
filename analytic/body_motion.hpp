// A planar body on its way from impact to impact.
#pragma once

#include <optional>

#include "analytic/angle.hpp"
#include "analytic/elastic_frame.hpp"
#include "analytic/flight.hpp"
#include "analytic/impact_law.hpp"
#include "analytic/planar_body.hpp"

namespace clatter::analytic {

/// State of a body at an impact or during the flight after it, with strike() and fly() to advance it.
///
/// The velocity of a uniform thin rod is the sum of an elastic frame and a remainder, as long as the
/// remainder (gravity, restitution below 1, friction) is the smaller part; any other body has it all in
/// the remainder.
class BodyMotion {
 public:
  /// The body with the given inclination, touching the ground with its lowest vertices.
  BodyMotion(const PlanarBody& body, const Angle& inclination, const PlanarVelocity& velocity,
             double gravity);

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
  /// Flies to the next arrival, if there is one; the state is then the one before that impact.
  Flight fly();

  [[nodiscard]] PlanarVelocity velocity() const;
  [[nodiscard]] double inclination() const { return inclination_; }
  [[nodiscard]] double sine() const { return sine_; }
  [[nodiscard]] double cosine() const { return cosine_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] double centre_height() const { return centre_height_; }
  [[nodiscard]] ContactPoint contact_point(int vertex) const {
    return body_.contact_point(vertex, sine_, cosine_);
  }
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

 private:
  Impact strike_point(int vertex, const ImpactLaw& law);
  void strike_framed(int vertex, Impact& impact);
  void collapse_frame();
  void refine(Arrival& arrival);

  PlanarBody body_;
  double gravity_;
  double inclination_, sine_, cosine_;
  double time_ = 0;
  double centre_height_ = 0;
  Angle initial_;
  int elastic_flights_ = 0;  ///< flights so far on the frame alone; −1: it has been left
  double offset_ = 0;        ///< η or ε (elastic_offsets.hpp) of the last of them
  ElasticFrame frame_;
  PlanarVelocity remainder_;
  VertexSet touching_ = 0;
  int reference_ = 0;
  double rebound_speed_ = 0;
};

}  // namespace clatter::analytic
