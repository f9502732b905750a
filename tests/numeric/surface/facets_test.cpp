// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/facets.hpp"

#include <set>

#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Coordinates are rounded to eps of the body's size, areas therefore to eps of its square.
constexpr double rounding = 1e-14;

/// Corners of a loop.
std::vector<Vector3> corners(const Facets& facets, const Loop& loop) {
  std::vector<Vector3> points;
  for (int i = loop.begin; i < loop.end; ++i) points.push_back(facets.vertices[facets.corners[i]]);
  return points;
}

/// Area and first moment ∫x dA, summed over planar pieces.
struct AreaMoments {
  double area = 0;
  Vector3 vector = Vector3::Zero();  ///< ∫n dA
  Vector3 first = Vector3::Zero();
  double flux = 0;  ///< ∫x·n dA, three times the enclosed volume

  void add(const std::vector<Vector3>& loop, const Vector3& normal) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Vector3 triangle = (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]) / 2;
      const Vector3 centre = (loop[0] + loop[i] + loop[i + 1]) / 3;
      area += triangle.dot(normal);
      vector += triangle;
      first += triangle.dot(normal) * centre;
      flux += triangle.dot(centre);
    }
  }
};

AreaMoments moments(const Facets& facets) {
  AreaMoments sum;
  for (const Facet& facet : facets.facets)
    for (int l = facet.begin; l < facet.end; ++l) sum.add(corners(facets, facets.loops[l]), facet.normal);
  return sum;
}

/// Moments of the surface's own elements, which must be planar.
AreaMoments moments(const Surface& surface) {
  AreaMoments sum;
  for (const SurfaceElement& element : surface.elements) {
    std::vector<Vector3> loop;
    for (const int node : element.nodes) {
      if (node >= 0) loop.push_back(surface.nodes[node]);
    }
    sum.add(loop, (loop[1] - loop[0]).cross(loop[2] - loop[0]).normalized());
  }
  return sum;
}

void check_same(const AreaMoments& a, const AreaMoments& b, double size) {
  BOOST_TEST(std::fabs(a.area - b.area) <= rounding * size * size);
  BOOST_TEST((a.first - b.first).norm() <= rounding * size * size * size);
  BOOST_TEST((a.vector - b.vector).norm() <= rounding * size * size);
  BOOST_TEST(std::fabs(a.flux - b.flux) <= rounding * size * size * size);
}

/// Corners lie in the facet's plane, indices are in range, every loop is a polygon, every vertex is
/// used, and the facets close up: each edge is run along once in each direction.
void check_sound(const Facets& facets) {
  std::multiset<std::pair<int, int>> edges;
  std::set<int> used;
  for (const Facet& facet : facets.facets) {
    BOOST_TEST(std::fabs(facet.normal.norm() - 1) <= 4 * eps);
    BOOST_TEST(facet.begin < facet.end);
    const Vector3& base = facets.vertices[facets.corners[facets.loops[facet.begin].begin]];
    for (int l = facet.begin; l < facet.end; ++l) {
      const Loop& loop = facets.loops[l];
      BOOST_TEST(loop.end - loop.begin >= 3);
      for (int i = loop.begin; i < loop.end; ++i) {
        const int from = facets.corners[i], to = facets.corners[i + 1 < loop.end ? i + 1 : loop.begin];
        BOOST_TEST(std::fabs(facet.normal.dot(facets.vertices[from] - base)) <= 1e-11);
        edges.insert({from, to});
        used.insert(from);
      }
    }
  }
  BOOST_TEST(used.size() == facets.vertices.size());
  for (const auto& [from, to] : edges) {
    BOOST_TEST(edges.count({from, to}) == 1u);
    BOOST_TEST(edges.count({to, from}) == 1u);
  }
}

/// Facets with the normal, in the given plane.
std::vector<Facet> facing(const Facets& facets, const Vector3& normal, double offset) {
  std::vector<Facet> found;
  std::copy_if(facets.facets.begin(), facets.facets.end(), std::back_inserter(found), [&](const Facet& facet) {
    const Vector3& corner = facets.vertices[facets.corners[facets.loops[facet.begin].begin]];
    return (facet.normal - normal).norm() < 1e-12 && std::fabs(corner.dot(normal) - offset) < 1e-12;
  });
  return found;
}

std::vector<int> loop_sizes(const Facets& facets, const Facet& facet) {
  std::vector<int> sizes;
  for (int l = facet.begin; l < facet.end; ++l) sizes.push_back(facets.loops[l].end - facets.loops[l].begin);
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

Facets facets_of(const Mesh& mesh) { return planar_facets(boundary_surface(mesh)); }

/// A block whose top falls off by a billionth beyond x = 0, with a node of the ridge moved by `bend` within the top:
/// off the other half's plane by only 1e-9 × bend.
Facets facets_of_ridge(double bend) {
  const double fall = 1e-9;
  const std::vector<Vector3> nodes{{-1, -1, 0}, {-1, 1, 0},   {1, -1, -fall}, {1, 1, -fall}, {0, -1, 0},
                                   {0, 1, 0},   {bend, 0, 0}, {-1, -1, -1},   {-1, 1, -1},   {1, -1, -1},
                                   {1, 1, -1},  {0, -1, -1},  {0, 1, -1}};
  const std::vector<std::array<int, 4>> faces{
      {0, 4, 6, -1}, {0, 6, 1, -1}, {1, 6, 5, -1},  {4, 2, 6, -1}, {6, 2, 3, -1}, {6, 3, 5, -1},  {7, 11, 4, 0},
      {11, 9, 2, 4}, {12, 8, 1, 5}, {10, 12, 5, 3}, {8, 7, 0, 1},  {9, 10, 3, 2}, {7, 8, 12, 11}, {11, 12, 10, 9}};
  Surface surface{.nodes = nodes, .elements = {}};
  for (const auto& face : faces) surface.elements.push_back({.nodes = face});
  return planar_facets(surface);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_of_any_subdivision_and_attitude_has_six_facets_and_eight_vertices) {
  const Vector3 size(0.10566, 0.04394, 0.01905);
  for (const auto& [nx, ny, nz] : {std::array{1, 1, 1}, {2, 1, 3}, {7, 5, 4}, {40, 30, 20}}) {
    const Mesh mesh = box_mesh({.size = size, .nx = nx, .ny = ny, .nz = nz});
    for (const Mesh& turned : {mesh, moved(mesh, rotation(), Vector3(0.1, 0.2, -0.3)), renumbered(mesh, 5)}) {
      const Facets facets = facets_of(turned);
      check_sound(facets);
      BOOST_TEST(facets.facets.size() == 6u);
      BOOST_TEST(facets.vertices.size() == 8u);
      BOOST_TEST(facets.corners.size() == 24u);
      const AreaMoments sum = moments(facets);
      const double area = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
      BOOST_TEST(std::fabs(sum.area - area) <= rounding * area);
      BOOST_TEST(std::fabs(sum.flux - 3 * size.prod()) <= rounding * area);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_rod_of_the_paper_has_eighteen_facets) {
  for (const Mesh& mesh : {rod_mesh({}), moved(rod_mesh({}), rotation(), Vector3(0.1, 0.2, -0.3))}) {
    const Facets facets = facets_of(mesh);
    check_sound(facets);
    BOOST_TEST(facets.facets.size() == 18u);
    BOOST_TEST(facets.vertices.size() == 32u);
    BOOST_TEST(facets.corners.size() == 2u * 16 + 16 * 4);
    check_same(moments(facets), moments(boundary_surface(mesh)), 1);
  }
}

BOOST_AUTO_TEST_CASE(holes_notches_grooves_and_corners_of_other_facets_are_kept_in_the_outline_of_a_face) {
  struct Row {
    const char* name;
    Vector3 size;
    std::array<int, 3> cut;
    bool (*removed)(const Vector3& centre);
    std::size_t facets, vertices;
    Vector3 normal;                       ///< of the face looked at
    double offset;                        ///< of its plane
    std::vector<std::vector<int>> loops;  ///< sizes of the loops of each of its facets
  };
  const auto hole = [](const Vector3& c) { return c.head<2>().cwiseAbs().maxCoeff() < 0.5; };
  const auto quarter = [](const Vector3& c) { return c.x() > 0 && c.y() > 0; };
  const auto groove = [](const Vector3& c) { return std::fabs(c.y()) < 0.2 && c.z() > 0; };
  // A pit and a bump of the top face meet in one corner.
  const auto around_a_point = [](const Vector3& c) {
    const bool inner = c.head<2>().cwiseAbs().maxCoeff() < 1;
    const bool bump = inner && c.x() > 0 && c.y() > 0, pit = inner && c.x() < 0 && c.y() < 0;
    return (c.z() > 0.5 && !bump) || (c.z() > -0.5 && pit);
  };
  // A small block on a large one, flush with its front: its feet lie on the front's top edge.
  const auto all_but_a_block = [](const Vector3& c) { return c.z() > 0 && !(std::fabs(c.x()) < 0.5 && c.y() < -0.5); };
  const Vector3 up = Vector3::UnitZ(), front = -Vector3::UnitY();
  for (const Row& row : {Row{"hole", {3, 3, 0.5}, {6, 6, 2}, hole, 10, 16, up, 0.25, {{4, 4}}},
                         {"inner corner of an L", {1, 1, 1}, {4, 4, 3}, quarter, 8, 12, up, 0.5, {{6}}},
                         {"ridges apart", {1, 1, 1}, {2, 3, 2}, groove, 10, 16, up, 0.5, {{4}, {4}}},
                         {"touches itself at a point", {4, 4, 3}, {4, 4, 3}, around_a_point, 16, 23, up, 0.5, {{4, 8}}},
                         {"straight corners", {3, 3, 2}, {3, 3, 2}, all_but_a_block, 10, 16, front, 1.5, {{8}}}}) {
    BOOST_TEST_CONTEXT(row.name) {
      const auto [nx, ny, nz] = row.cut;
      const Mesh mesh = without(box_mesh({.size = row.size, .nx = nx, .ny = ny, .nz = nz}), row.removed);
      const Facets facets = facets_of(mesh);
      check_sound(facets);
      check_same(moments(facets), moments(boundary_surface(mesh)), row.size.maxCoeff());
      BOOST_TEST(facets.facets.size() == row.facets);
      BOOST_TEST(facets.vertices.size() == row.vertices);
      std::vector<std::vector<int>> loops;
      for (const Facet& facet : facing(facets, row.normal, row.offset)) loops.push_back(loop_sizes(facets, facet));
      BOOST_CHECK(loops == row.loops);
    }
  }
}

/// The outer loop of a face with a hole has its whole area, the other takes away the hole's.
BOOST_AUTO_TEST_CASE(a_hole_is_a_loop_that_runs_the_other_way) {
  const Facets facets = facets_of(
      without(box_mesh({.size = {3, 3, 0.5}, .nx = 3, .ny = 3}), [](const Vector3& c) { return c.norm() < 0.5; }));
  const Facet top = facing(facets, Vector3::UnitZ(), 0.25).at(0);
  double areas[2];
  for (int i = 0; i < 2; ++i) {
    AreaMoments loop;
    loop.add(corners(facets, facets.loops[top.begin + i]), top.normal);
    areas[i] = loop.area;
  }
  BOOST_TEST(std::fabs(std::max(areas[0], areas[1]) - 9) <= rounding * 9);
  BOOST_TEST(std::fabs(std::min(areas[0], areas[1]) + 1) <= rounding);
}

BOOST_AUTO_TEST_CASE(a_warped_quadrilateral_becomes_four_triangles_around_its_middle_however_it_is_numbered) {
  const Surface surface = boundary_surface(single(ElementShape::hexahedron, warped_cube()));
  const Facets facets = planar_facets(surface);
  Surface turned = surface;
  for (SurfaceElement& element : turned.elements)
    std::rotate(element.nodes.begin(), element.nodes.begin() + 1, element.nodes.end());
  BOOST_CHECK(planar_facets(turned).vertices == facets.vertices);
  check_sound(facets);
  BOOST_TEST(facets.facets.size() == 24u);
  BOOST_TEST(facets.vertices.size() == 14u);
  for (const SurfaceElement& element : surface.elements) {
    Vector3 middle = Vector3::Zero();
    for (const int node : element.nodes) middle += surface.nodes[node] / 4;
    BOOST_CHECK(std::any_of(facets.vertices.begin(), facets.vertices.end(),
                            [&](const Vector3& vertex) { return (vertex - middle).norm() <= 4 * eps; }));
  }
  // The flux through the four triangles is that through the bilinear face.
  BOOST_TEST(std::fabs(moments(facets).flux - 3 * enclosed(surface)) <= 10 * rounding);
}

BOOST_AUTO_TEST_CASE(a_quadrilateral_is_warped_from_a_millionth_of_a_millionth_of_its_size) {
  // With one corner off by h the corners are h/4 off their mean plane, the diagonal is √2.
  for (const auto& [lift, facets] : {std::pair{3e-12, 6u}, {8e-12, 6u + 3 * 3}}) {
    std::vector<Vector3> nodes = unit_cube();
    nodes[6] += Vector3(lift, lift, lift);
    const Surface surface = boundary_surface(single(ElementShape::hexahedron, nodes));
    BOOST_TEST(planar_facets(surface, false).facets.size() == facets);
  }
}

BOOST_AUTO_TEST_CASE(a_fine_curve_does_not_creep_into_one_facet) {
  // Neighbours differ by 0.003 rad: never within the tolerance.
  const Facets facets = facets_of(rod_mesh({.radius = 0.3, .sectors = 2000, .rings = 1, .layers = 2}));
  BOOST_TEST(facets.facets.size() == 2002u);
  // A ridge of 0.6e-12 rad from facet to facet: each agrees with its neighbour, not with the first.
  Mesh bent = box_mesh({.nx = 8});
  for (Vector3& node : bent.nodes) node.z() += 0.3e-12 * 8 * node.x() * node.x();
  BOOST_TEST(facets_of(bent).facets.size() > 6u);
}

BOOST_AUTO_TEST_CASE(a_bend_between_two_facets_is_kept_even_if_both_planes_hold_it) {
  const Facets straight = facets_of_ridge(0), bent = facets_of_ridge(1e-4);
  check_sound(bent);
  BOOST_TEST((straight.facets.size() == 7u && bent.facets.size() == 7u));
  BOOST_TEST(
      (straight.vertices.size() == 10u && bent.vertices.size() == 11u));  // eight corners, the ridge's two or three
}

BOOST_AUTO_TEST_CASE(without_merging_every_element_is_its_own_facet) {
  const Surface surface = boundary_surface(rod_mesh({}));
  const Facets facets = planar_facets(surface, false);
  check_sound(facets);
  BOOST_TEST(facets.facets.size() == surface.elements.size());
  BOOST_TEST(facets.vertices.size() == surface.nodes.size());
  check_same(moments(facets), moments(surface), 1);
}

namespace {

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
