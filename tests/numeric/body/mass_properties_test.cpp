// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/body/mass_properties.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "numeric/errors.hpp"
#include "numeric/mesh/generators.hpp"
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

/// Polynomial in ξ, η, ζ: the exact integrals of the isoparametric map need nothing but this.
struct Polynomial {
  std::map<std::array<int, 3>, double> terms;

  static Polynomial constant(double c) { return {{{{0, 0, 0}, c}}}; }
  static Polynomial variable(int i) {
    std::array<int, 3> power{};
    power[i] = 1;
    return {{{power, 1.}}};
  }
  Polynomial& operator+=(const Polynomial& other) {
    for (const auto& [power, c] : other.terms) terms[power] += c;
    return *this;
  }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return a += constant(-1) * b; }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product;
    for (const auto& [p, c] : a.terms) {
      for (const auto& [q, d] : b.terms) product.terms[{p[0] + q[0], p[1] + q[1], p[2] + q[2]}] += c * d;
    }
    return product;
  }
  [[nodiscard]] Polynomial derivative(int i) const {
    Polynomial result;
    for (const auto& [power, c] : terms) {
      if (power[i] == 0) continue;
      std::array<int, 3> lowered = power;
      --lowered[i];
      result.terms[lowered] += c * power[i];
    }
    return result;
  }
};

double factorial(int n) { return std::tgamma(n + 1.); }

/// ∫ξᵃηᵇζᶜ over the unit cube, the unit triangle × [0, 1] or the unit tetrahedron.
double integral(const Polynomial& polynomial, ElementShape shape) {
  double sum = 0;
  for (const auto& [p, c] : polynomial.terms) {
    const auto [a, b, z] = p;
    if (shape == ElementShape::hexahedron) sum += c / ((a + 1) * (b + 1) * (z + 1));
    if (shape == ElementShape::prism) sum += c * factorial(a) * factorial(b) / factorial(a + b + 2) / (z + 1);
    if (shape == ElementShape::tetrahedron) {
      sum += c * factorial(a) * factorial(b) * factorial(z) / factorial(a + b + z + 3);
    }
  }
  return sum;
}

std::vector<Polynomial> nodal_basis(ElementShape shape) {
  const Polynomial one = Polynomial::constant(1), x = Polynomial::variable(0);
  const Polynomial y = Polynomial::variable(1), z = Polynomial::variable(2);
  if (shape == ElementShape::tetrahedron) return {one - x - y - z, x, y, z};
  std::vector<Polynomial> basis{one - x - y, x, y};
  if (shape == ElementShape::hexahedron) basis = {(one - x) * (one - y), x * (one - y), x * y, (one - x) * y};
  for (std::size_t i = 0, half = basis.size(); i < half; ++i) basis.push_back(basis[i] * z);
  for (std::size_t i = 0; i < basis.size() / 2; ++i) basis[i] = basis[i] * (one - z);
  return basis;
}

MassProperties exact(ElementShape shape, const std::vector<Vector3>& nodes) {
  std::array<Polynomial, 3> x;
  const std::vector<Polynomial> basis = nodal_basis(shape);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (int i = 0; i < 3; ++i) x[i] += Polynomial::constant(nodes[n][i]) * basis[n];
  }
  Polynomial det;
  for (int i = 0; i < 3; ++i) {
    const auto d = [&](int row, int variable) { return x[row].derivative(variable); };
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    det += d(0, i) * (d(1, j) * d(2, k) - d(1, k) * d(2, j));
  }
  Vector3 first;
  Matrix3 second;
  for (int i = 0; i < 3; ++i) {
    first[i] = integral(x[i] * det, shape);
    for (int j = 0; j < 3; ++j) second(i, j) = integral(x[i] * x[j] * det, shape);
  }
  return from_moments(integral(det, shape), first, second);
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

BOOST_AUTO_TEST_CASE(a_tetrahedron_has_the_second_moments_of_its_corners_and_their_sum) {
  const std::vector<Vector3> x{{0.1, 0, -0.3}, {1.5, 0.2, 0}, {0.3, 0.9, 0.2}, {-0.2, 0.4, 2}};
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  const Vector3 sum = x[0] + x[1] + x[2] + x[3];
  Matrix3 second = sum * sum.transpose();
  for (const Vector3& corner : x) second += corner * corner.transpose();
  const MassProperties expected = from_moments(volume, volume / 4 * sum, volume / 20 * second);
  BOOST_CHECK(agree(mass_properties(single(ElementShape::tetrahedron, x)), expected, rounding));
  BOOST_CHECK(agree(exact(ElementShape::tetrahedron, x), expected, rounding));
}

BOOST_AUTO_TEST_CASE(warped_prisms_and_hexahedra_are_integrated_exactly) {
  const std::vector<Vector3> wedge{{0, 0, 0.1},   {1.2, 0.1, -0.2}, {-0.1, 1.1, 0},
                                   {0.2, 0.1, 1}, {0.9, -0.1, 1.3}, {0.1, 1.4, 0.8}};
  BOOST_CHECK(agree(mass_properties(single(ElementShape::prism, wedge)), exact(ElementShape::prism, wedge), rounding));
  const std::vector<Vector3> brick = warped_cube();
  BOOST_CHECK(agree(mass_properties(single(ElementShape::hexahedron, brick)), exact(ElementShape::hexahedron, brick),
                    rounding));
}

BOOST_AUTO_TEST_CASE(a_frustum_has_the_moments_of_the_pyramid_less_its_tip) {
  // Square pyramid of base 2 and height 2, cut at half its height.
  std::vector<Vector3> nodes = unit_cube();
  for (Vector3& node : nodes) {
    const double scale = node.z() == 0 ? 2 : 1;
    node = {scale * (node.x() - 0.5), scale * (node.y() - 0.5), node.z()};
  }
  const MassProperties body = mass_properties(single(ElementShape::hexahedron, nodes, 3));
  // At height z the side is 2 − z: V = 7/3, ∫z = 11/12, ∫z² = 8/15, ∫x² = ∫(2 − z)⁴/12 = 31/60.
  const double volume = 7. / 3, height = 11. / 12 / volume, zz = 8. / 15 - volume * height * height;
  BOOST_TEST(std::fabs(body.mass - 3 * volume) <= rounding * body.mass);
  BOOST_TEST((body.centre - Vector3(0, 0, height)).norm() <= rounding);
  BOOST_TEST(std::fabs(body.inertia(0, 0) - 3 * (31. / 60 + zz)) <= rounding * 3);
  BOOST_TEST(std::fabs(body.inertia(2, 2) - 3 * (31. / 30)) <= rounding * 3);
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

BOOST_AUTO_TEST_CASE(renumbering_changes_nothing_and_a_mirror_image_is_mirrored) {
  Mesh mesh = box_mesh({.size = {1, 2, 3}, .nx = 3, .ny = 2, .nz = 2});
  for (Vector3& node : mesh.nodes) node += 0.1 * Vector3(node.y() * node.z(), std::sin(node.x()), node.x() * node.x());
  const MassProperties body = mass_properties(mesh);
  BOOST_CHECK(agree(mass_properties(renumbered(mesh, 1)), body, rounding));
  const Matrix3 mirror = Vector3(-1, 1, 1).asDiagonal();
  Mesh image = moved(mesh, mirror, Vector3::Zero());
  for (Element& element : image.elements) {
    std::swap(element.nodes[1], element.nodes[3]);
    std::swap(element.nodes[5], element.nodes[7]);
  }
  BOOST_CHECK(agree(mass_properties(image), moved(body, mirror, Vector3::Zero()), rounding));
}

BOOST_AUTO_TEST_CASE(many_elements_and_a_far_origin_cost_only_the_rounding_of_the_coordinates) {
  const Mesh mesh = box_mesh({.size = {3, 1, 1}, .nx = 40, .ny = 40, .nz = 40});
  const MassProperties expected = uniform_box({3, 1, 1}, 1);
  // The rounding of 64000 volumes averages out; 8 eps leaves none for the sum.
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
  BOOST_CHECK_EXCEPTION(static_cast<void>(mass_properties({})), MeshError, mentions("no element"));
  const double inf = std::numeric_limits<double>::infinity();
  for (const double density : {0., -1., std::nan(""), inf}) {
    Mesh mesh = box_mesh({.nx = 3});
    mesh.elements[2].density = density;
    BOOST_CHECK_EXCEPTION(static_cast<void>(mass_properties(mesh)), MeshError,
                          mentions("element 2 (hexahedron): density"));
  }
  Mesh inverted = box_mesh({.nx = 3});
  std::swap(inverted.elements[1].nodes[0], inverted.elements[1].nodes[4]);
  BOOST_CHECK_EXCEPTION(static_cast<void>(mass_properties(inverted)), MeshError,
                        mentions("element 1 (hexahedron): inverted"));
  Mesh heavy = box_mesh({});
  heavy.elements[0].density = 1e300;
  for (Vector3& node : heavy.nodes) node *= 1e10;
  BOOST_CHECK_THROW(static_cast<void>(mass_properties(heavy)), NumericalError);
}
