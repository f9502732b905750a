// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/surface.hpp"

#include "numeric/body/mass_properties.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double rounding = 100 * eps;

void check_refused(const Mesh& mesh, const std::string& name, const std::string& what) {
  CHECK_REFUSED_SAYING(boundary_surface(mesh), MeshError, name);
  CHECK_REFUSED_SAYING(boundary_surface(mesh), MeshError, what);
}

void check_refused(const Surface& surface, const std::string& name, const std::string& what) {
  CHECK_REFUSED_SAYING(check_closed(surface), MeshError, name);
  CHECK_REFUSED_SAYING(check_closed(surface), MeshError, what);
}

std::vector<Vector3> unit_tetrahedron() { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

/// Three blocks in a row.
Mesh row() { return box_mesh({.size = {3, 1, 1}, .nx = 3}); }

}  // namespace

BOOST_AUTO_TEST_CASE(only_outer_faces_remain_and_each_names_its_element) {
  const Surface surface = boundary_surface(row());
  BOOST_TEST(surface.elements.size() == 14u);
  BOOST_TEST(surface.nodes.size() == 16u);
  for (const auto& [element, faces] : {std::pair{0, 5}, {1, 4}, {2, 5}}) {
    BOOST_TEST(std::count_if(surface.elements.begin(), surface.elements.end(),
                             [e = element](const SurfaceElement& face) { return face.element == e; }) == faces);
  }
  for (const SurfaceElement& face : surface.elements)
    for (const int node : face.nodes) BOOST_TEST(std::fabs(surface.nodes[node].x() - (face.element - 1)) <= 0.5);
}

BOOST_AUTO_TEST_CASE(nodes_within_the_body_are_dropped) {
  const Surface surface = boundary_surface(box_mesh({.nx = 4, .ny = 3, .nz = 5}));
  BOOST_TEST(surface.nodes.size() == 5u * 4 * 6 - 3 * 2 * 4);
  BOOST_TEST(surface.elements.size() == 2u * (4 * 3 + 3 * 5 + 5 * 4));
}

BOOST_AUTO_TEST_CASE(faces_point_outward_so_that_they_enclose_the_volume_of_the_mesh_however_it_is_numbered) {
  const Mesh wedge = single(ElementShape::prism, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  for (const Mesh& mesh :
       {box_mesh({.size = {1, 2, 3}, .mass = 6, .nx = 2, .ny = 3, .nz = 4}),
        rod_mesh({.length = 2, .radius = 1, .mass = 3 * std::sqrt(3.), .sectors = 6}), wedge,
        single(ElementShape::tetrahedron, unit_tetrahedron()), single(ElementShape::hexahedron, warped_cube())}) {
    const double volume = mass_properties(mesh).mass;  // density 1
    const Surface one = boundary_surface(mesh), other = boundary_surface(renumbered(mesh, 3));
    BOOST_TEST(std::fabs(enclosed(one) - volume) <= rounding * volume);
    BOOST_TEST(std::fabs(enclosed(other) - volume) <= rounding * volume);
    BOOST_TEST((one.elements.size() == other.elements.size() && one.nodes.size() == other.nodes.size()));
  }
}

BOOST_AUTO_TEST_CASE(every_boundary_of_a_mesh_passes_as_a_closed_surface) {
  check_closed(boundary_surface(rod_mesh({})));
  check_closed(boundary_surface(row()));
  const auto hole = [](const Vector3& centre) { return centre.norm() < 0.1; };
  check_closed(boundary_surface(without(box_mesh({.nx = 3, .ny = 3, .nz = 1}), hole)));
  // A hollow body has an inner surface, which faces the cavity.
  const Surface hollow = boundary_surface(without(box_mesh({.nx = 3, .ny = 3, .nz = 3}), hole));
  check_closed(hollow);
  BOOST_TEST(std::fabs(enclosed(hollow) - 26. / 27) <= rounding);
}

BOOST_AUTO_TEST_CASE(an_element_with_a_wrong_node_is_refused_by_name) {
  for (const int node : {-1, 16, 1000000}) {
    Mesh mesh = row();
    mesh.elements[2].nodes[6] = node;
    check_refused(mesh, "element 2 (hexahedron)", "is not one of the 16 nodes");
  }
  Mesh repeated = row();
  repeated.elements[1].nodes[3] = repeated.elements[1].nodes[0];
  check_refused(repeated, "element 1 (hexahedron)", "is repeated");
  for (const double value : {not_a_number, infinite}) {
    Mesh mesh = row();
    mesh.nodes[3].y() = value;
    check_refused(mesh, "element 2 (hexahedron)", "not finite");
  }
  check_refused(Mesh{}, "no element", "no element");
}

BOOST_AUTO_TEST_CASE(inverted_elements_of_every_shape_are_refused_by_name) {
  Mesh tetrahedron = single(ElementShape::tetrahedron, unit_tetrahedron());
  std::swap(tetrahedron.elements[0].nodes[0], tetrahedron.elements[0].nodes[1]);
  check_refused(tetrahedron, "element 0 (tetrahedron)", "inverted");
  Mesh rod = rod_mesh({.sectors = 5, .rings = 1, .layers = 2});
  std::swap(rod.elements[7].nodes[1], rod.elements[7].nodes[2]);
  std::swap(rod.elements[7].nodes[4], rod.elements[7].nodes[5]);
  check_refused(rod, "element 7 (prism)", "inverted");
  // One corner pushed through the opposite ones: the centre is still sound.
  std::vector<Vector3> nodes = unit_cube();
  nodes[6] = {0.3, 0.3, 0.3};
  check_refused(single(ElementShape::hexahedron, nodes), "element 0 (hexahedron)", "inverted");
}

BOOST_AUTO_TEST_CASE(degenerate_elements_are_refused_at_every_scale_and_position) {
  for (const double scale : {1e-20, 1e-3, 1., 1e20}) {
    std::vector<Vector3> flat = unit_tetrahedron();
    flat[3] = {0.3, 0.4, 0};
    check_refused(moved(single(ElementShape::tetrahedron, flat), scale * Matrix3::Identity(), {0, 0, 0}),
                  "element 0 (tetrahedron)", "degenerate");
    std::vector<Vector3> collapsed = unit_cube();
    collapsed[1] = collapsed[0];
    check_refused(moved(single(ElementShape::hexahedron, collapsed), scale * rotation(), {0, 0, 0}),
                  "element 0 (hexahedron)", "degenerate");
    std::vector<Vector3> needle = unit_tetrahedron();
    for (Vector3& node : needle) node.tail<2>() *= 1e-6;
    static_cast<void>(
        boundary_surface(moved(single(ElementShape::tetrahedron, needle), scale * rotation(), {0, 0, 0})));
  }
}

BOOST_AUTO_TEST_CASE(elements_that_overlap_are_refused_by_name) {
  Mesh doubled = row();
  doubled.elements.push_back(doubled.elements[1]);
  check_refused(doubled, "element 3 (hexahedron)", "element 1 (hexahedron)");
  // Two tetrahedra on the same side of one triangle.
  Mesh folded = single(ElementShape::tetrahedron, unit_tetrahedron());
  folded.nodes.emplace_back(0.2, 0.2, 2);
  folded.elements.push_back({ElementShape::tetrahedron, {0, 1, 2, 4, -1, -1, -1, -1}, 1});
  check_refused(folded, "element 1 (tetrahedron)", "same side");
  // With a third on the other side between them.
  folded.nodes.emplace_back(0.2, 0.2, -1);
  folded.elements.insert(folded.elements.begin() + 1, {ElementShape::tetrahedron, {0, 2, 1, 5, -1, -1, -1, -1}, 1});
  check_refused(folded, "element 2 (tetrahedron)", "shares a face with element 0 (tetrahedron) and another");
}

BOOST_AUTO_TEST_CASE(bodies_that_touch_along_an_edge_are_refused_by_name) {
  const Mesh mesh =
      without(box_mesh({.nx = 2, .ny = 2}), [](const Vector3& centre) { return centre.x() * centre.y() > 0; });
  check_refused(mesh, "element 0 (hexahedron)", "4 faces instead of 2");
}

BOOST_AUTO_TEST_CASE(an_open_or_inconsistent_surface_is_refused_by_name) {
  Surface open = boundary_surface(row());
  open.elements.pop_back();
  check_refused(open, "quadrilateral", "open");
  Surface flipped = boundary_surface(single(ElementShape::tetrahedron, unit_tetrahedron()));
  std::swap(flipped.elements[2].nodes[0], flipped.elements[2].nodes[1]);
  check_refused(flipped, "triangle 2", "same direction");
  Surface doubled = boundary_surface(row());
  doubled.elements.push_back(doubled.elements[0]);
  check_refused(doubled, "quadrilateral 0", "3 faces instead of 2");
  check_refused(Surface{}, "no element", "no element");
}

BOOST_AUTO_TEST_CASE(an_inward_surface_and_an_element_with_a_wrong_node_or_without_area_are_refused_by_name) {
  Surface inward = boundary_surface(row());
  for (SurfaceElement& face : inward.elements) std::swap(face.nodes[1], face.nodes[3]);
  check_refused(inward, "quadrilateral 0", "inward");
  const Surface sound = boundary_surface(single(ElementShape::tetrahedron, unit_tetrahedron()));
  Surface foreign = sound, repeated = sound, endless = sound, flat = sound;
  foreign.elements[1].nodes[2] = 4;
  check_refused(foreign, "triangle 1", "not one of the 4 nodes");
  repeated.elements[1].nodes[2] = repeated.elements[1].nodes[1];
  check_refused(repeated, "triangle 1", "repeated");
  endless.nodes[3].z() = not_a_number;
  check_refused(endless, "triangle", "not finite");
  flat.nodes[3] = {0.5, 0.5, 0};
  check_refused(flat, "triangle", "no area");
}
