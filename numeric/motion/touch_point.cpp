// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/touch_point.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {

namespace {

/// The lowest vertices, each once.
std::vector<int> touching_vertices(const Body& body, const MotionState& state) {
  // Heights over the centre of mass: over the ground those of a high flight would lose the body's size.
  MotionState level_with_centre = state;
  level_with_centre.centre.setZero();
  const double level = lowest_height(body, level_with_centre) + 1e-11 * body.radius();
  const GroundPlane plane{state.attitude.conjugate() * Vector3::UnitZ(), 0};
  const Facets& facets = body.facets();
  std::vector<int> touching;
  body.hierarchy().visit_below(plane, level, [&](int facet) {
    const Facet& which = facets.facets[static_cast<std::size_t>(facet)];
    for (int l = which.begin; l < which.end; ++l) {
      const Loop& loop = facets.loops[static_cast<std::size_t>(l)];
      for (int c = loop.begin; c < loop.end; ++c) {
        const int vertex = facets.corners[static_cast<std::size_t>(c)];
        if (plane.height(facets.vertices[static_cast<std::size_t>(vertex)]) <= level) touching.push_back(vertex);
      }
    }
  });
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

}  // namespace

Vector3 touch_point(const Body& body, const MotionState& state) {
  const std::vector<int> touching = touching_vertices(body, state);
  Vector3 sum = Vector3::Zero();
  for (const int vertex : touching) sum += body.facets().vertices[static_cast<std::size_t>(vertex)];
  return sum / static_cast<double>(touching.size());
}

FirstTouch first_touch(const Body& body, const MotionState& state) {
  FirstTouch touch{.approach_speed = -std::numeric_limits<double>::infinity()};
  bool a = false, b = false;
  for (const int vertex : touching_vertices(body, state)) {
    const Vector3& u = body.facets().vertices[static_cast<std::size_t>(vertex)];
    a = a || u.x() < -1e-9 * body.half_length();
    b = b || u.x() > 1e-9 * body.half_length();
    touch.approach_speed = std::max(touch.approach_speed, -point_velocity(state, u).z());
  }
  touch.end = a && b ? ContactEnd::both : a ? ContactEnd::a : b ? ContactEnd::b : ContactEnd::middle;
  return touch;
}

}  // namespace clatter::numeric
