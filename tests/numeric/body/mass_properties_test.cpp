// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/body/mass_properties.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Sums of up to a hundred rounded products, and the roundings of the oracle.
constexpr double rounding = 100 * eps;

/// Whether two bodies agree to `tolerance` of the mass, the size and the largest moment.
bool agree(const MassProperties& a, const MassProperties& b, double tolerance, double size = 1) {
  return std::fabs(a.mass - b.mass) <= tolerance * b.mass && (a.centre - b.centre).norm() <= tolerance * size &&
         (a.inertia - b.inertia).norm() <= tolerance * b.inertia.norm();
}

MassProperties uniform_box(const Vector3& size, double mass) {
  const Vector3 square = size.cwiseProduct(size) / 12;
  const Vector3 moments(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
  return {mass, Vector3::Zero(), Matrix3((mass * moments).asDiagonal())};
}

MassProperties moved(const MassProperties& body, const Matrix3& turn, const Vector3& shift) {
  return {body.mass, turn * body.centre + shift, turn * body.inertia * turn.transpose()};
}

/// From ∫dV, ∫x dV and ∫x xᵀ dV about the origin, density 1.
MassProperties from_moments(double volume, const Vector3& first, const Matrix3& second) {
  const Vector3 centre = first / volume;
  const Matrix3 central = second - volume * centre * centre.transpose();
  return {volume, centre, central.trace() * Matrix3::Identity() - central};
}

/// The isoparametric map of a cube whose corners may coincide, as those of a prism or tetrahedron do, by Gauss's rule,
/// which is exact for its polynomials.
MassProperties exact(const std::array<Vector3, 8>& nodes) {
  using Rule = boost::math::quadrature::gauss<double, 7>;
  std::vector<std::pair<double, double>> rule{{0.5, Rule::weights()[0] / 2}};  // places from 0 to 1
  for (std::size_t i = 1; i < Rule::abscissa().size(); ++i)
    for (const double side : {-1., 1.}) rule.push_back({(1 + side * Rule::abscissa()[i]) / 2, Rule::weights()[i] / 2});
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (const auto& [x, along_x] : rule) {
    for (const auto& [y, along_y] : rule) {
      for (const auto& [z, along_z] : rule) {
        Vector3 at = Vector3::Zero();
        Matrix3 slopes = Matrix3::Zero();
        for (int n = 0; n < 8; ++n) {
          const bool i = n % 4 == 1 || n % 4 == 2, j = n % 4 >= 2, k = n >= 4;
          const Vector3 part(i ? x : 1 - x, j ? y : 1 - y, k ? z : 1 - z), slope(i ? 1 : -1, j ? 1 : -1, k ? 1 : -1);
          at += part.prod() * nodes[n];
          for (int d = 0; d < 3; ++d) slopes.col(d) += slope[d] * part[(d + 1) % 3] * part[(d + 2) % 3] * nodes[n];
        }
        const double weight = along_x * along_y * along_z * slopes.determinant();
        volume += weight;
        first += weight * at;
        second += weight * at * at.transpose();
      }
    }
  }
  return from_moments(volume, first, second);
}

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
  for (const auto& nodes : {std::array{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {1, 2, 3, -1}})
    surface.elements.push_back({.nodes = nodes});
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

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_of_any_subdivision_has_the_closed_form_in_any_position) {
  const Vector3 size(0.10566, 0.04394, 0.01905);
  const Vector3 shift(0.3, -0.2, 0.1);
  for (const auto& [nx, ny, nz] : {std::array{1, 1, 1}, {3, 2, 5}, {16, 7, 4}}) {
    const Mesh mesh = box_mesh({.size = size, .mass = 0.08814, .nx = nx, .ny = ny, .nz = nz});
    const MassProperties expected = uniform_box(size, 0.08814);
    BOOST_CHECK(agree(mass_properties(mesh), expected, rounding, size.norm()));
    BOOST_CHECK(agree(mass_properties(moved(mesh, rotation(), shift)), moved(expected, rotation(), shift), rounding,
                      size.norm()));
  }
}

BOOST_AUTO_TEST_CASE(a_rod_has_the_inertia_of_the_regular_polygonal_prism) {
  for (const int sectors : {3, 4, 5, 16, 17, 30}) {
    for (const int rings : {1, 4}) {
      const RodMesh rod{.length = 1.5, .radius = 0.01, .mass = 2, .sectors = sectors, .rings = rings, .layers = 5};
      const MassProperties body = mass_properties(rod_mesh(rod));
      // Triangle with one corner at the origin: ∫r² dA = A (a·a + a·b + b·b) / 6.
      const double k2 = rod.radius * rod.radius * (2 + std::cos(2 * std::numbers::pi / sectors)) / 6;
      const double along = rod.mass * k2, across = rod.mass * (k2 / 2 + rod.length * rod.length / 12);
      BOOST_TEST(std::fabs(body.mass - rod.mass) <= rounding * rod.mass);
      BOOST_TEST(body.centre.norm() <= rounding * rod.length);
      // The small moment about the axis to its own size, not to that of the large ones.
      BOOST_TEST(std::fabs(body.inertia(0, 0) - along) <= rounding * along);
      BOOST_TEST(std::fabs(body.inertia(1, 1) - across) <= rounding * across);
      BOOST_TEST(std::fabs(body.inertia(2, 2) - across) <= rounding * across);
      BOOST_TEST((body.inertia - Matrix3(body.inertia.diagonal().asDiagonal())).norm() <= rounding * along);
    }
  }
}

BOOST_AUTO_TEST_CASE(tetrahedra_and_warped_prisms_and_hexahedra_are_integrated_exactly) {
  const Vector3 a(0, 0, 0.1), b(1.2, 0.1, -0.2), c(-0.1, 1.1, 0), d(0.2, 0.1, 1), e(0.9, -0.1, 1.3), f(0.1, 1.4, 0.8);
  BOOST_CHECK(agree(mass_properties(single(ElementShape::tetrahedron, {a, b, c, d})), exact({a, b, c, c, d, d, d, d}),
                    rounding));
  BOOST_CHECK(agree(mass_properties(single(ElementShape::prism, {a, b, c, d, e, f})), exact({a, b, c, c, d, e, f, f}),
                    rounding));
  const std::vector<Vector3> warped = warped_cube();
  std::array<Vector3, 8> nodes;
  std::copy(warped.begin(), warped.end(), nodes.begin());
  BOOST_CHECK(agree(mass_properties(single(ElementShape::hexahedron, warped)), exact(nodes), rounding));
}

BOOST_AUTO_TEST_CASE(each_element_weighs_by_its_own_density) {
  Mesh mesh = box_mesh({.size = {2, 1, 1}, .nx = 2});
  mesh.elements[0].density = 1;
  mesh.elements[1].density = 3;
  const MassProperties body = mass_properties(mesh);
  BOOST_TEST(std::fabs(body.mass - 4) <= rounding * 4);
  BOOST_TEST((body.centre - Vector3(0.25, 0, 0)).norm() <= rounding);
  // Two cubes of m/6 each, at distances 3/4 and 1/4 from the centre.
  BOOST_TEST(std::fabs(body.inertia(0, 0) - 4. / 6) <= rounding);
  BOOST_TEST(std::fabs(body.inertia(1, 1) - (4. / 6 + 9. / 16 + 3. / 16)) <= rounding * 2);
}

BOOST_AUTO_TEST_CASE(many_elements_and_a_far_origin_cost_only_the_rounding_of_the_coordinates) {
  const Mesh mesh = box_mesh({.size = {3, 1, 1}, .nx = 20, .ny = 20, .nz = 20});
  const MassProperties expected = uniform_box({3, 1, 1}, 1);
  // The rounding of 8000 volumes averages out; 8 eps leaves none for the sum.
  BOOST_CHECK(agree(mass_properties(mesh), expected, 8 * eps));
  const Vector3 shift(1000, -2000, 500);
  BOOST_CHECK(agree(mass_properties(moved(mesh, Matrix3::Identity(), shift)),
                    moved(expected, Matrix3::Identity(), shift), 2 * eps * shift.norm()));
}

BOOST_AUTO_TEST_CASE(a_needle_of_aspect_ratio_a_million_is_sound) {
  for (const double thin : {1e-6, 1e-3, 1e6}) {
    std::vector<Vector3> nodes{{0, 0, 0}, {1, 0, 0}, {0.3, thin, 0}, {0.3, 0, thin}};
    const MassProperties body = mass_properties(moved(single(ElementShape::tetrahedron, nodes), rotation(), {0, 0, 0}));
    // Rotated coordinates are rounded to eps of the length, which is eps·1e6 of the thickness.
    BOOST_TEST(std::fabs(body.mass - thin * thin / 6) <= 10 * eps * 1e6 * body.mass);
  }
}

BOOST_AUTO_TEST_CASE(units_from_the_tiny_to_the_huge_do_not_matter) {
  for (const double size : {1e-30, 1e-9, 1e12, 1e30}) {
    const MassProperties body = mass_properties(box_mesh({.size = {size, size, 2 * size}}));
    BOOST_TEST(std::fabs(body.mass - 1) <= rounding);
    BOOST_TEST(std::fabs(body.inertia(2, 2) / (size * size) - 1. / 6) <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(what_has_no_mass_is_refused_by_name) {
  CHECK_REFUSED_SAYING(mass_properties({}), MeshError, "no element");
  for (const double density : {0., -1., not_a_number, infinite}) {
    Mesh mesh = box_mesh({.nx = 3});
    mesh.elements[2].density = density;
    CHECK_REFUSED_SAYING(mass_properties(mesh), MeshError, "element 2 (hexahedron): density");
    CHECK_REFUSED_SAYING(mass_properties(corner_tetrahedron({1, 1, 1}), density), std::domain_error, "density");
  }
  Mesh inverted = box_mesh({.nx = 3});
  std::swap(inverted.elements[1].nodes[0], inverted.elements[1].nodes[4]);
  CHECK_REFUSED_SAYING(mass_properties(inverted), MeshError, "element 1 (hexahedron): inverted");
  Mesh heavy = box_mesh({});
  heavy.elements[0].density = 1e300;
  for (Vector3& node : heavy.nodes) node *= 1e10;
  CHECK_REFUSED(mass_properties(heavy), NumericalError);
  Surface open = corner_tetrahedron({1, 1, 1}), inside_out = open;
  open.elements.pop_back();
  CHECK_REFUSED(mass_properties(open, 1), MeshError);
  for (SurfaceElement& element : inside_out.elements) std::swap(element.nodes[0], element.nodes[1]);
  CHECK_REFUSED_SAYING(mass_properties(inside_out, 1), MeshError, "inward");
  CHECK_REFUSED(mass_properties(moved(corner_tetrahedron({1, 1, 1}), 1e120 * Matrix3::Identity(), {0, 0, 0}), 1),
                NumericalError);
}

BOOST_AUTO_TEST_CASE(a_surface_around_a_tetrahedron_has_its_closed_form_mass_centre_and_inertia) {
  for (const Vector3& edges : {Vector3(1, 1, 1), Vector3(1, 2, 0.5), Vector3(0.1, 1, 0.02)})
    BOOST_CHECK(agree(mass_properties(corner_tetrahedron(edges), 7.5), exact_tetrahedron(edges, 7.5), rounding));
  // Far from the origin it loses no more than its coordinates do.
  const Vector3 edges(1, 2, 0.5), shift(1e6, -2e6, 5e5);
  BOOST_CHECK(agree(mass_properties(moved(corner_tetrahedron(edges), Matrix3::Identity(), shift), 1),
                    moved(exact_tetrahedron(edges, 1), Matrix3::Identity(), shift), 4 * eps * shift.norm()));
}

BOOST_AUTO_TEST_CASE(a_surface_has_the_mass_properties_of_the_elements_that_it_bounds) {
  const Mesh l_shape = without(box_mesh({.size = {2, 1, 2}, .mass = 4, .nx = 2, .ny = 1, .nz = 2}),
                               [](const Vector3& centre) { return centre.x() > 0 && centre.z() > 0; });
  for (const Mesh& mesh : {box_mesh({.size = {1, 0.4, 0.2}, .mass = 0.08, .nx = 3, .ny = 2}), rod_mesh({}), l_shape}) {
    for (const Matrix3& turn : {Matrix3(Matrix3::Identity()), rotation()}) {
      const Mesh turned = moved(mesh, turn, {0, 0, 0});
      const Surface surface = triangulated(boundary_surface(turned));
      BOOST_CHECK(agree(mass_properties(surface, mesh.elements[0].density), mass_properties(turned), rounding));
    }
  }
}
