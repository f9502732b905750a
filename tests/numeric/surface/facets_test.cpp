// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/facets.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <set>

#include "numeric/mesh/generators.hpp"
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
  for (const Facet& facet : facets.facets) {
    for (int l = facet.begin; l < facet.end; ++l) sum.add(corners(facets, facets.loops[l]), facet.normal);
  }
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
  return planar_facets({.nodes = {{-1, -1, 0},
                                  {-1, 1, 0},
                                  {1, -1, -fall},
                                  {1, 1, -fall},
                                  {0, -1, 0},
                                  {0, 1, 0},
                                  {bend, 0, 0},
                                  {-1, -1, -1},
                                  {-1, 1, -1},
                                  {1, -1, -1},
                                  {1, 1, -1},
                                  {0, -1, -1},
                                  {0, 1, -1}},
                        .elements = {{.nodes = {0, 4, 6, -1}},
                                     {.nodes = {0, 6, 1, -1}},
                                     {.nodes = {1, 6, 5, -1}},
                                     {.nodes = {4, 2, 6, -1}},
                                     {.nodes = {6, 2, 3, -1}},
                                     {.nodes = {6, 3, 5, -1}},
                                     {.nodes = {7, 11, 4, 0}},
                                     {.nodes = {11, 9, 2, 4}},
                                     {.nodes = {12, 8, 1, 5}},
                                     {.nodes = {10, 12, 5, 3}},
                                     {.nodes = {8, 7, 0, 1}},
                                     {.nodes = {9, 10, 3, 2}},
                                     {.nodes = {7, 8, 12, 11}},
                                     {.nodes = {11, 12, 10, 9}}}});
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
  const Mesh mesh = rod_mesh({});
  for (const Mesh& turned : {mesh, moved(mesh, rotation(), Vector3(0.1, 0.2, -0.3))}) {
    const Surface surface = boundary_surface(turned);
    const Facets facets = planar_facets(surface);
    check_sound(facets);
    BOOST_TEST(facets.facets.size() == 18u);
    BOOST_TEST(facets.vertices.size() == 32u);
    BOOST_TEST(facets.corners.size() == 2u * 16 + 16 * 4);
    check_same(moments(facets), moments(surface), 1);
  }
}

BOOST_AUTO_TEST_CASE(a_hole_is_a_loop_that_runs_the_other_way) {
  const auto hole = [](const Vector3& centre) { return centre.head<2>().cwiseAbs().maxCoeff() < 0.5; };
  const Mesh plate = without(box_mesh({.size = {3, 3, 0.5}, .nx = 6, .ny = 6, .nz = 2}), hole);
  const Facets facets = facets_of(plate);
  check_sound(facets);
  BOOST_TEST(facets.facets.size() == 10u);
  BOOST_TEST(facets.vertices.size() == 16u);
  const auto top = facing(facets, Vector3::UnitZ(), 0.25);
  BOOST_REQUIRE(top.size() == 1u);
  BOOST_CHECK((loop_sizes(facets, top[0]) == std::vector{4, 4}));
  AreaMoments outer, inner;
  outer.add(corners(facets, facets.loops[top[0].begin]), top[0].normal);
  inner.add(corners(facets, facets.loops[top[0].begin + 1]), top[0].normal);
  BOOST_TEST(std::fabs(std::max(outer.area, inner.area) - 9) <= rounding * 9);
  BOOST_TEST(std::fabs(std::min(outer.area, inner.area) + 1) <= rounding);
  check_same(moments(facets), moments(boundary_surface(plate)), 3);
}

BOOST_AUTO_TEST_CASE(an_l_shape_has_eight_facets_and_keeps_its_inner_corner) {
  const auto notch = [](const Vector3& centre) { return centre.x() > 0 && centre.y() > 0; };
  const Mesh mesh = without(box_mesh({.nx = 4, .ny = 4, .nz = 3}), notch);
  const Facets facets = facets_of(mesh);
  check_sound(facets);
  BOOST_TEST(facets.facets.size() == 8u);
  BOOST_TEST(facets.vertices.size() == 12u);
  const auto top = facing(facets, Vector3::UnitZ(), 0.5);
  BOOST_REQUIRE(top.size() == 1u);
  BOOST_CHECK((loop_sizes(facets, top[0]) == std::vector{6}));
  check_same(moments(facets), moments(boundary_surface(mesh)), 1);
}

BOOST_AUTO_TEST_CASE(coplanar_faces_that_do_not_touch_stay_apart) {
  // A groove along x: two ridges of equal height.
  const auto groove = [](const Vector3& centre) { return std::fabs(centre.y()) < 0.2 && centre.z() > 0; };
  const Facets facets = facets_of(without(box_mesh({.nx = 2, .ny = 3, .nz = 2}), groove));
  check_sound(facets);
  BOOST_TEST(facing(facets, Vector3::UnitZ(), 0.5).size() == 2u);
  BOOST_TEST(facets.facets.size() == 10u);
  BOOST_TEST(facets.vertices.size() == 16u);
}

BOOST_AUTO_TEST_CASE(an_outline_that_touches_itself_at_a_point_is_followed_around_it) {
  // A pit and a bump of the top face meet in one corner.
  const auto removed = [](const Vector3& centre) {
    const bool middle = centre.head<2>().cwiseAbs().maxCoeff() < 1;
    const bool bump = middle && centre.x() > 0 && centre.y() > 0, pit = middle && centre.x() < 0 && centre.y() < 0;
    return (centre.z() > 0.5 && !bump) || (centre.z() > -0.5 && pit);
  };
  const Mesh mesh = without(box_mesh({.size = {4, 4, 3}, .nx = 4, .ny = 4, .nz = 3}), removed);
  const Facets facets = facets_of(mesh);
  check_sound(facets);
  const auto top = facing(facets, Vector3::UnitZ(), 0.5);
  BOOST_REQUIRE(top.size() == 1u);
  BOOST_CHECK((loop_sizes(facets, top[0]) == std::vector{4, 8}));
  check_same(moments(facets), moments(boundary_surface(mesh)), 4);
}

BOOST_AUTO_TEST_CASE(a_straight_corner_that_a_third_facet_needs_is_kept) {
  // A small block on a large one, flush with its front: its feet lie on the front's top edge.
  const auto removed = [](const Vector3& centre) {
    return centre.z() > 0 && !(std::fabs(centre.x()) < 0.5 && centre.y() < -0.5);
  };
  const Mesh mesh = without(box_mesh({.size = {3, 3, 2}, .nx = 3, .ny = 3, .nz = 2}), removed);
  const Facets facets = facets_of(mesh);
  check_sound(facets);
  BOOST_TEST(facets.vertices.size() == 16u);
  const auto front = facing(facets, -Vector3::UnitY(), 1.5);
  BOOST_REQUIRE(front.size() == 1u);
  BOOST_CHECK((loop_sizes(facets, front[0]) == std::vector{8}));
}

BOOST_AUTO_TEST_CASE(a_warped_quadrilateral_becomes_four_triangles_around_its_middle) {
  const Surface surface = boundary_surface(single(ElementShape::hexahedron, warped_cube()));
  const Facets facets = planar_facets(surface);
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
  double flux = 0;
  for (const SurfaceElement& element : surface.elements) {
    for (int i = 0; i < 4; ++i) {
      const auto node = [&](int k) { return surface.nodes[element.nodes[(i + k) % 4]]; };
      flux += node(0).dot(node(1).cross(node(2))) / 4;
    }
  }
  BOOST_TEST(std::fabs(moments(facets).flux - flux) <= 10 * rounding);
}

BOOST_AUTO_TEST_CASE(the_triangles_of_a_warped_face_do_not_depend_on_the_numbering) {
  const Surface surface = boundary_surface(single(ElementShape::hexahedron, warped_cube()));
  Surface turned = surface;
  for (SurfaceElement& element : turned.elements)
    std::rotate(element.nodes.begin(), element.nodes.begin() + 1, element.nodes.end());
  const Facets a = planar_facets(surface), b = planar_facets(turned);
  BOOST_CHECK(a.vertices == b.vertices);
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
  BOOST_TEST(straight.facets.size() == 7u);
  BOOST_TEST(bent.facets.size() == 7u);
  BOOST_TEST(straight.vertices.size() == 10u);  // eight corners and the ridge's ends
  BOOST_TEST(bent.vertices.size() == 11u);
}

BOOST_AUTO_TEST_CASE(without_merging_every_element_is_its_own_facet) {
  const Surface surface = boundary_surface(rod_mesh({}));
  const Facets facets = planar_facets(surface, false);
  check_sound(facets);
  BOOST_TEST(facets.facets.size() == surface.elements.size());
  BOOST_TEST(facets.vertices.size() == surface.nodes.size());
  check_same(moments(facets), moments(surface), 1);
}

BOOST_AUTO_TEST_CASE(nothing_has_no_facets) {
  const Facets facets = planar_facets({});
  BOOST_TEST(facets.facets.empty());
  BOOST_TEST(facets.vertices.empty());
}
