// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, centre and inertia of what a closed surface of triangles encloses.
#include <boost/test/unit_test.hpp>
#include <limits>

#include "numeric/body/mass_properties.hpp"
#include "numeric/errors.hpp"
#include "numeric/mesh/generators.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Sums of up to a hundred rounded products of coordinates of size 1.
constexpr double rounding = 100 * eps;

/// Every quadrilateral cut along one of its diagonals: the same body where faces are flat.
Surface triangulated(const Surface& surface) {
  Surface cut{.nodes = surface.nodes, .elements = {}};
  for (const SurfaceElement& element : surface.elements) {
    const auto& [a, b, c, d] = element.nodes;
    cut.elements.push_back({.nodes = {a, b, c, -1}, .element = element.element});
    if (d >= 0) cut.elements.push_back({.nodes = {a, c, d, -1}, .element = element.element});
  }
  return cut;
}

Surface moved(Surface surface, const Matrix3& turn, const Vector3& shift) {
  for (Vector3& node : surface.nodes) node = turn * node + shift;
  return surface;
}

/// Corners at the origin and on the axes, edges along these of lengths a.
Surface corner_tetrahedron(const Vector3& a) {
  Surface surface{.nodes = {Vector3::Zero(), {a.x(), 0, 0}, {0, a.y(), 0}, {0, 0, a.z()}}, .elements = {}};
  for (const auto& nodes : {std::array{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {1, 2, 3, -1}}) {
    surface.elements.push_back({.nodes = nodes});
  }
  return surface;
}

/// m = ρ abc/6, centre (a, b, c)/4, I_xx = 3 m (b² + c²)/80, I_xy = m ab/80: central moments of a simplex.
MassProperties exact_tetrahedron(const Vector3& a, double density) {
  const double m = density * a.prod() / 6;
  Matrix3 inertia = m / 80 * a * a.transpose();
  const Vector3 s = a.cwiseProduct(a);
  inertia.diagonal() = 3 * m / 80 * Vector3(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
  return {m, a / 4, inertia};
}

bool agree(const MassProperties& a, const MassProperties& b, double tolerance) {
  return std::fabs(a.mass - b.mass) <= tolerance * b.mass && (a.centre - b.centre).norm() <= tolerance &&
         (a.inertia - b.inertia).norm() <= tolerance * b.inertia.norm();
}

/// Three unit cubes about an edge: not convex.
Mesh l_shape() {
  return without(box_mesh({.size = {2, 1, 2}, .mass = 4, .nx = 2, .ny = 1, .nz = 2}),
                 [](const Vector3& centre) { return centre.x() > 0 && centre.z() > 0; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_surface_around_a_tetrahedron_has_its_closed_form_mass_centre_and_inertia) {
  for (const Vector3& edges : {Vector3(1, 1, 1), Vector3(1, 2, 0.5), Vector3(0.1, 1, 0.02)}) {
    const MassProperties body = mass_properties(corner_tetrahedron(edges), 7.5);
    BOOST_CHECK(agree(body, exact_tetrahedron(edges, 7.5), rounding));
  }
}

BOOST_AUTO_TEST_CASE(a_surface_has_the_mass_properties_of_the_elements_that_it_bounds) {
  for (const Mesh& mesh :
       {box_mesh({.size = {1, 0.4, 0.2}, .mass = 0.08, .nx = 3, .ny = 2}), rod_mesh({}), l_shape()}) {
    const double density = mesh.elements[0].density;
    const Surface surface = triangulated(boundary_surface(mesh));
    BOOST_CHECK(agree(mass_properties(surface, density), mass_properties(mesh), rounding));
    const Mesh turned = test::moved(mesh, rotation(), {0, 0, 0});
    BOOST_CHECK(
        agree(mass_properties(::moved(surface, rotation(), {0, 0, 0}), density), mass_properties(turned), rounding));
  }
}

BOOST_AUTO_TEST_CASE(a_surface_far_from_the_origin_loses_no_more_than_its_coordinates_do) {
  const Vector3 edges(1, 2, 0.5), shift(1e6, -2e6, 5e5);
  MassProperties expected = exact_tetrahedron(edges, 1);
  expected.centre += shift;
  const MassProperties body = mass_properties(::moved(corner_tetrahedron(edges), Matrix3::Identity(), shift), 1);
  BOOST_CHECK(agree(body, expected, 4 * eps * shift.norm()));
}

BOOST_AUTO_TEST_CASE(a_surface_that_is_open_or_inside_out_has_no_mass_properties) {
  Surface open = corner_tetrahedron({1, 1, 1});
  open.elements.pop_back();
  BOOST_CHECK_THROW(static_cast<void>(mass_properties(open, 1)), MeshError);
  Surface inverted = corner_tetrahedron({1, 1, 1});
  for (SurfaceElement& element : inverted.elements) std::swap(element.nodes[0], element.nodes[1]);
  BOOST_CHECK_EXCEPTION(static_cast<void>(mass_properties(inverted, 1)), MeshError, mentions("inward"));
  const Surface sound = corner_tetrahedron({1, 1, 1});
  for (const double density : {0., -1., std::nan(""), std::numeric_limits<double>::infinity()}) {
    BOOST_CHECK_EXCEPTION(static_cast<void>(mass_properties(sound, density)), std::domain_error, mentions("density"));
  }
  BOOST_CHECK_THROW(static_cast<void>(mass_properties(::moved(sound, 1e120 * Matrix3::Identity(), {0, 0, 0}), 1)),
                    NumericalError);
}
