#include "numeric/touch_point.hpp"

#include <algorithm>
#include <vector>

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {

Vector3 touch_point(const Body& body, const MotionState& state) {
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
  Vector3 sum = Vector3::Zero();
  for (const int vertex : touching) sum += facets.vertices[static_cast<std::size_t>(vertex)];
  return sum / static_cast<double>(touching.size());
}

}  // namespace clatter::numeric
