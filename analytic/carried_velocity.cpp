// SPDX-License-Identifier: GPL-3.0-or-later
// Velocity of the contact point of a BodyMotion, from V and Ω or carried along the flight,
// whichever keeps more digits.
#include <cmath>

#include "analytic/body_motion.hpp"

namespace clatter::analytic {

ContactVelocity BodyMotion::contact_velocity(int vertex) const {
  const ContactPoint d = contact_point(vertex);
  const PlanarVelocity v = velocity();
  ContactVelocity found{normal_velocity(v, d), slip_velocity(v, d)};
  if (vertex != carried_.vertex) return found;
  if (4 * carried_.normal_scale < absolute_scale(vertex).normal) found.normal = carried_.velocity.normal;
  if (4 * carried_.slip_scale < absolute_scale(vertex).slip) found.slip = carried_.velocity.slip;
  return found;
}

ContactVelocity BodyMotion::absolute_scale(int vertex) const {
  const ContactPoint d = contact_point(vertex);
  const PlanarVelocity v = velocity();
  return {.normal = std::fmax(std::fabs(v.normal), scale_.normal) + std::fabs(v.angular * d.tangential),
          .slip = std::fmax(std::fabs(v.tangential), scale_.tangential) + std::fabs(v.angular * d.normal)};
}

double BodyMotion::normal_scale(int vertex) const {
  const double absolute = absolute_scale(vertex).normal;
  return vertex == carried_.vertex && 4 * carried_.normal_scale < absolute ? carried_.normal_scale : absolute;
}

double BodyMotion::slip_scale(int vertex) const {
  const double absolute = absolute_scale(vertex).slip;
  return vertex == carried_.vertex && 4 * carried_.slip_scale < absolute ? carried_.slip_scale : absolute;
}

/// Whether frame and remainder give the normal velocity of the contact point without cancelling
/// each other.
bool BodyMotion::frame_carries(int vertex, const ContactVelocity& contact) const {
  const ReflectionAxis axis = reflection_axis(body_.vertices[vertex].x < 0, sine_, cosine_);
  const double of_frame = std::fabs(frame_.contact_velocity(axis));
  const double of_remainder = std::fabs(normal_velocity(remainder_, contact_point(vertex)));
  return of_frame + of_remainder <= 8 * std::fabs(contact.normal);
}

/// V of the centre of mass after an impact, from what loses fewer digits: V and impulse before, or
/// the contact point's velocity after it; the latter always where that was carried, so that the two
/// stay one motion.
void BodyMotion::keep_contact_velocity(const ContactPoint& d, Impact& impact) {
  const PlanarVelocity before = velocity();
  const double turn = impact.after.angular;
  scale_ = {.normal = std::fabs(before.normal) + impact.normal_impulse / body_.mass,
            .tangential = std::fabs(before.tangential) + std::fabs(impact.tangential_impulse) / body_.mass};
  const double normal_scale = impact.separation_speed + std::fabs(turn * d.tangential);
  if (-impact.approach_speed != normal_velocity(before, d) || normal_scale < scale_.normal) {
    impact.after.normal = impact.separation_speed + turn * d.tangential;
    scale_.normal = normal_scale;
  }
  const double slip_scale = std::fabs(impact.slip_after) + std::fabs(turn * d.normal);
  if (impact.slip_before != slip_velocity(before, d) || slip_scale < scale_.tangential) {
    impact.after.tangential = impact.slip_after - turn * d.normal;
    scale_.tangential = slip_scale;
  }
}

/// With h of the arriving vertex from the one that struck last: u = h′, s = s₀ + Ω (d_n − d_n0),
/// both at the touch.
void BodyMotion::carry(const Departure& departure, const Arrival& arrival) {
  const VertexHeight height = vertex_height(turned_, departure, arrival.vertex);
  const detail::Turn turn(height.rate * arrival.time);
  const double sine_part = height.sine * turn.sine;
  const double versine_part = height.versine * turn.versine;
  const auto [along, offset] = departure.offset(turned_, reference_, arrival.vertex);
  const double of_start = departure.rebound_speed + std::fabs(departure.angular * along);
  const double scale = std::fabs(offset) + std::fabs(versine_part) + std::fabs(sine_part);
  carried_ = {.vertex = arrival.vertex,
              .velocity = {height.at(arrival.time, turn).velocity,
                           slip_ + departure.angular * (offset + versine_part - sine_part)},
              .normal_scale = of_start + height.velocity_scale(arrival.time),
              .slip_scale = std::fabs(slip_) + std::fabs(departure.angular) * (scale + std::fmax(turn.angle - 1, 0))};
}

}  // namespace clatter::analytic
