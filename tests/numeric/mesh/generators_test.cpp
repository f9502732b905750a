// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/mesh/mesh.hpp"

#include <set>

#include "numeric/body/mass_properties.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

long count(const Mesh& mesh, ElementShape shape) {
  return std::count_if(mesh.elements.begin(), mesh.elements.end(),
                       [&](const Element& element) { return element.shape == shape; });
}

/// Whether the nodes are their own mirror image in the plane where the coordinate is 0, to the bit.
bool is_symmetric(const Mesh& mesh, int coordinate) {
  std::set<std::array<double, 3>> nodes;
  for (const Vector3& node : mesh.nodes) nodes.insert({node.x(), node.y(), node.z()});
  return std::all_of(mesh.nodes.begin(), mesh.nodes.end(), [&](Vector3 node) {
    node[coordinate] = -node[coordinate];
    return nodes.contains({node.x(), node.y(), node.z()});
  });
}

bool has_node(const Mesh& mesh, const Vector3& place) {
  return std::any_of(mesh.nodes.begin(), mesh.nodes.end(), [&](const Vector3& node) { return node == place; });
}

template <typename Shape, typename Value>
void check_refused(Value Shape::*field, std::initializer_list<Value> values, const std::string& name,
                   Mesh (*make)(const Shape&)) {
  for (const Value value : values) {
    Shape shape;
    shape.*field = value;
    CHECK_REFUSED_SAYING(make(shape), std::domain_error, name + " = ");
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_rod_of_the_paper_has_its_numbers_of_elements) {
  const Mesh mesh = rod_mesh({});
  BOOST_TEST(mesh.elements.size() == 1920u);
  BOOST_TEST(count(mesh, ElementShape::prism) == 16 * 30);
  BOOST_TEST(count(mesh, ElementShape::hexahedron) == 3 * 16 * 30);
  BOOST_TEST(mesh.nodes.size() == 31u * (1 + 4 * 16));
  int ends[2] = {0, 0}, side = 0;
  const Surface surface = boundary_surface(mesh);
  for (const SurfaceElement& element : surface.elements) {
    Eigen::AlignedBox3d box;
    for (const int node : element.nodes) {
      if (node >= 0) box.extend(surface.nodes[node]);
    }
    ++(box.sizes().x() == 0 ? ends[box.min().x() > 0] : side);
  }
  BOOST_TEST((ends[0] == 64 && ends[1] == 64 && side == 480));
}

BOOST_AUTO_TEST_CASE(the_coordinates_are_symmetric_to_the_bit_and_the_rod_rests_on_a_rim_node_at_each_end) {
  for (int sectors = 3; sectors <= 40; ++sectors) {
    for (const int layers : {1, 2, 7}) {
      const Mesh rod = rod_mesh({.length = 0.7, .radius = 0.013, .sectors = sectors, .rings = 3, .layers = layers});
      BOOST_CHECK(is_symmetric(rod, 0));
      BOOST_CHECK(is_symmetric(rod, 1));
      BOOST_CHECK(is_symmetric(rod, 2) == (sectors % 2 == 0));
      for (const double x : {-0.35, 0.35}) BOOST_CHECK(has_node(rod, {x, 0, -0.013}));  // it rests on a rim node
    }
  }
  for (int i = 0; i < 3; ++i)
    BOOST_CHECK(is_symmetric(box_mesh({.size = {0.3, 0.7, 1.1}, .nx = 7, .ny = 10, .nz = 13}), i));
}

BOOST_AUTO_TEST_CASE(the_rim_nodes_lie_at_equal_angles_on_the_circle) {
  for (const int sectors : {3, 8, 16, 22, 25}) {
    const Mesh rod = rod_mesh({.radius = 1, .sectors = sectors, .rings = 1, .layers = 1});
    for (int s = 0; s < sectors; ++s) {
      const long double angle = 2 * std::acos(-1.L) * s / sectors;
      const Vector3& node = rod.nodes[1 + s];
      // Rounding of the angle and of the sine.
      BOOST_TEST(std::fabs(node.y() - static_cast<double>(std::sin(angle))) <= 4 * eps);
      BOOST_TEST(std::fabs(node.z() + static_cast<double>(std::cos(angle))) <= 4 * eps);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_corners_of_the_box_are_exactly_half_its_size) {
  const Vector3 size(0.10566, 0.04394, 0.01905);
  const Mesh box = box_mesh({.size = size, .nx = 7, .ny = 3, .nz = 5});
  BOOST_TEST((box.nodes.size() == 8u * 4 * 6 && box.elements.size() == 7u * 3 * 5));
  Eigen::AlignedBox3d bounds;
  for (const Vector3& node : box.nodes) bounds.extend(node);
  BOOST_CHECK((bounds.max() == size / 2 && bounds.min() == -size / 2));
}

BOOST_AUTO_TEST_CASE(the_density_makes_up_for_the_facets) {
  const Mesh square = rod_mesh({.length = 2, .radius = 0.5, .mass = 3, .sectors = 4});
  // Cross-section 2 r², length 2.
  for (const Element& element : square.elements) BOOST_TEST(std::fabs(element.density - 3) <= 4 * eps * 3);
  const Mesh box = box_mesh({.size = {1, 2, 4}, .mass = 2, .nx = 3});
  for (const Element& element : box.elements) BOOST_TEST(element.density == 0.25);
}

BOOST_AUTO_TEST_CASE(senseless_bodies_are_refused_by_field_and_value) {
  for (const auto& [field, name] :
       {std::pair{&RodMesh::length, "length"}, {&RodMesh::radius, "radius"}, {&RodMesh::mass, "mass"}}) {
    check_refused(field, {0., -1., not_a_number, infinite}, name, rod_mesh);
  }
  check_refused(&RodMesh::sectors, {2, 0, -5}, "sectors", rod_mesh);
  check_refused(&RodMesh::rings, {0, -1}, "rings", rod_mesh);
  check_refused(&RodMesh::layers, {0, -1}, "layers", rod_mesh);
  check_refused(&BoxMesh::mass, {0., -1., not_a_number, infinite}, "mass", box_mesh);
  for (const auto& [field, name] : {std::pair{&BoxMesh::nx, "nx"}, {&BoxMesh::ny, "ny"}, {&BoxMesh::nz, "nz"}})
    check_refused(field, {0, -1}, name, box_mesh);
  for (int i = 0; i < 3; ++i) {
    for (const double value : {0., -1., not_a_number, infinite}) {
      BoxMesh box;
      box.size[i] = value;
      CHECK_REFUSED_SAYING(box_mesh(box), std::domain_error, std::string("size.") + "xyz"[i] + " = ");
    }
  }
}

BOOST_AUTO_TEST_CASE(bodies_beyond_the_numbers_of_the_machine_are_refused) {
  constexpr int many = 2000000000;
  CHECK_REFUSED_SAYING(rod_mesh({.sectors = many, .rings = many, .layers = many}), std::domain_error,
                       "sectors, rings, layers");
  CHECK_REFUSED_SAYING(box_mesh({.nx = 2000, .ny = 2000, .nz = 2000}), std::domain_error, "nx, ny, nz");
  CHECK_REFUSED_SAYING(rod_mesh({.radius = 1e-200}), std::domain_error, "mass / volume");
  CHECK_REFUSED_SAYING(box_mesh({.size = {1e200, 1e200, 1}}), std::domain_error, "mass / volume");
}

BOOST_AUTO_TEST_CASE(round_meshes_are_closed_lie_on_their_shape_and_come_to_it_with_the_second_order) {
  // A capsule, as the ellipsoid with a straight part of the length l: V = 4/3 π a b c + π b c l.
  for (const double straight : {0.0, 0.7}) {
    double error[2];
    for (const int fine : {1, 2}) {
      const Mesh mesh = round_mesh({{0.5, 0.3, 0.2}, straight, 2, 16 * fine, 6 * fine});
      BOOST_CHECK_NO_THROW(check_closed(boundary_surface(mesh)));
      for (int i = 0; i < 3; ++i) BOOST_TEST(is_symmetric(mesh, i));
      BOOST_TEST(has_node(mesh, {-straight / 2, 0, -0.2}));
      const MassProperties properties = mass_properties(mesh);
      BOOST_TEST(std::fabs(properties.mass - 2) <= 1e-13);  // a sum over elements
      for (std::size_t i = 1; i < mesh.nodes.size(); ++i) {
        Vector3 node = mesh.nodes[i];
        node.x() -= std::copysign(std::fmin(std::fabs(node.x()), straight / 2), node.x());
        BOOST_TEST(std::fabs(node.cwiseQuotient(Vector3(0.5, 0.3, 0.2)).norm() - 1) <= 1e-15);
      }
      const double volume = 2 / mesh.elements[0].density;
      error[fine - 1] = std::numbers::pi * 0.06 * (4. / 3 * 0.5 + straight) - volume;
    }
    BOOST_TEST(error[1] > 0);
    BOOST_TEST(std::fabs(error[0] / error[1] - 4) <= 0.1);
  }
  check_refused(&RoundMesh::straight, {-1., infinite, not_a_number}, "straight", round_mesh);
  check_refused(&RoundMesh::mass, {0., infinite}, "mass", round_mesh);
  check_refused(&RoundMesh::sectors, {2, -1}, "sectors", round_mesh);
  check_refused(&RoundMesh::rings, {0}, "rings", round_mesh);
}
