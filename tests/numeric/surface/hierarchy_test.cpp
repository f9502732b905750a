// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/hierarchy.hpp"

#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

GroundPlane plane_at(const Body& body, double angle, double tilt, double depth) {
  const MotionState touch = touching_state(body, {.inclination = angle, .out_of_plane_tilt = tilt});
  return {touch.attitude.conjugate() * Vector3::UnitZ(), touch.centre.z() - depth};
}

bool reaches_below(const Body& body, int facet, const GroundPlane& plane) {
  const Facets& facets = body.facets();
  const Facet& which = facets.facets[facet];
  for (int l = which.begin; l < which.end; ++l) {
    for (int c = facets.loops[l].begin; c < facets.loops[l].end; ++c) {
      if (plane.height(facets.vertices[facets.corners[c]]) < 0) return true;
    }
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_facet_below_the_ground_is_visited_once) {
  for (const Body& body : {rod(), phone(9, 7, 5, false)}) {
    // Components of the normal of either sign.
    for (const auto& [angle, tilt] : {std::pair{0.4, 0.2}, {0.4, -0.2}, {-0.4, 0.2}, {-0.4, 2.8}}) {
      for (const double depth : {1e-6, 1e-3, 1e-2, 10.0}) {
        const GroundPlane plane = plane_at(body, angle, tilt, depth);
        std::vector<int> visited;
        body.hierarchy().visit_below(plane, 0, [&](int facet) { visited.push_back(facet); });
        std::sort(visited.begin(), visited.end());
        BOOST_TEST((std::adjacent_find(visited.begin(), visited.end()) == visited.end()));
        for (int f = 0; f < static_cast<int>(body.facets().facets.size()); ++f) {
          const bool seen = std::binary_search(visited.begin(), visited.end(), f);
          if (reaches_below(body, f, plane)) BOOST_TEST(seen);
        }
      }
    }
  }
}

/// Facets visited beyond those in contact: at most a few leaves along the patch's edge and one path to them; boxes
/// looked at, counted by the predicate of visit_if.
BOOST_AUTO_TEST_CASE(facets_visited_and_boxes_looked_at_grow_no_faster_than_log_elements_plus_elements_in_contact) {
  for (const int n : {2, 4, 8, 16}) {
    const Body body = phone(4 * n, 2 * n, n, false);
    const double elements = static_cast<double>(body.facets().facets.size());
    for (const double depth : {1e-5, 1e-4, 1e-3}) {
      const GroundPlane plane = plane_at(body, 0.2, 0.15, depth);
      int boxes = 0, in_contact = 0, visited = 0;
      body.hierarchy().visit_below(plane, 0, [&](int facet) {
        ++visited;
        in_contact += reaches_below(body, facet, plane) ? 1 : 0;
      });
      body.hierarchy().visit_if(
          [&](const Vector3& centre, const Vector3& half) {
            ++boxes;
            return plane.height(centre) - plane.normal.cwiseAbs().dot(half) < 0;
          },
          [](int) {});
      BOOST_TEST(visited <= 4 * in_contact + 8 * std::log2(elements));
      BOOST_TEST(boxes <= 8 * in_contact + 8 * std::log2(elements));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_plane_above_the_body_visits_all_and_one_far_below_none) {
  const Body body = rod();
  int visits = 0;
  const auto count = [&](int) { ++visits; };
  body.hierarchy().visit_below({Vector3::UnitZ(), 10}, 0, count);
  BOOST_TEST(visits == 0);
  body.hierarchy().visit_below({Vector3::UnitZ(), -10}, 0, count);
  BOOST_TEST(visits == static_cast<int>(body.facets().facets.size()));
}
