// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/body/mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "numeric/base/errors.hpp"
#include "numeric/mesh/element_geometry.hpp"

namespace clatter::numeric {
namespace {

/// Moments of one element about its own centre, axes of the mesh.
struct Moments {
  double mass = 0;
  Vector3 centre = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();  ///< ∫ρ u uᵀ dV
};

/// Sum to twice the working precision (Neumaier), so that a million elements add no error of their
/// own.
template <int rows, int columns>
class Sum {
 public:
  using Term = Eigen::Array<double, rows, columns>;

  void add(const Term& term) {
    const Term sum = sum_ + term;
    const Term of_large = sum_ - sum + term, of_small = term - sum + sum_;
    lost_ += (sum_.abs() >= term.abs()).select(of_large, of_small);
    sum_ = sum;
  }
  [[nodiscard]] Term value() const { return sum_ + lost_; }

 private:
  Term sum_ = Term::Zero(), lost_ = Term::Zero();
};

void check_density(const Mesh& mesh, int index) {
  const double density = mesh.elements[index].density;
  if (density > 0 && std::isfinite(density)) return;
  std::ostringstream text;
  text.precision(17);
  text << element_name(mesh, index) << ": density " << density << " must be greater than 0 and finite";
  throw MeshError(text.str());
}

Moments element_moments(const Mesh& mesh, int index) {
  check_density(mesh, index);
  const Element& element = mesh.elements[index];
  const ReferenceElement& reference = reference_element(element.shape);
  const ElementMap map(mesh, index);
  for (const ReferencePoint& corner : reference.corners) static_cast<void>(map.at(corner));
  Moments sum;
  for (const ReferencePoint& point : reference.quadrature) {
    const auto [position, determinant] = map.at(point);
    const double mass = element.density * point.weight * determinant;
    sum.mass += mass;
    sum.centre += mass * position;
    sum.second += mass * position * position.transpose();
  }
  const Vector3 centre = sum.centre / sum.mass;
  return {sum.mass, map.origin() + centre, sum.second - sum.mass * centre * centre.transpose()};
}

/// 1 tr P − P of the second moments, without the cancellation that would spoil the axis of a thin
/// rod.
Matrix3 inertia_of(const Matrix3& p) {
  Matrix3 inertia = Matrix3::Zero() - p;  // no negative zeros
  inertia.diagonal() << p(1, 1) + p(2, 2), p(2, 2) + p(0, 0), p(0, 0) + p(1, 1);
  return inertia;
}

/// The tetrahedra between the triangles and `apex` have together: mass, ∫ρ u dV and ∫ρ u uᵀ dV with u from the apex.
Moments moments_about(const Surface& surface, const Vector3& apex, double density) {
  Sum<1, 1> mass;
  Sum<3, 1> first;
  Sum<3, 3> second;
  for (const SurfaceElement& element : surface.elements) {
    detail::require(element.nodes[3] < 0, "corners of a surface element", 4, "3");
    const Vector3 a = surface.nodes[element.nodes[0]] - apex, b = surface.nodes[element.nodes[1]] - apex,
                  c = surface.nodes[element.nodes[2]] - apex, sum = a + b + c;
    const double part = density * a.dot(b.cross(c)) / 6;
    mass.add(Sum<1, 1>::Term(part));
    first.add(part / 4 * sum);
    second.add(part / 20 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose()));
  }
  return {mass.value()(0), first.value().matrix(), second.value().matrix()};
}

/// Not the origin, from which a body that lies far off would lose its size to rounding.
Vector3 middle(const Surface& surface) {
  Vector3 low = surface.nodes[0], high = low;
  for (const Vector3& node : surface.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  return low + (high - low) / 2;
}

void check_overflow(const MassProperties& body) {
  if (body.mass > 0 && std::isfinite(body.mass) && body.centre.allFinite() && body.inertia.allFinite()) return;
  throw NumericalError("the mass properties of the mesh overflow");
}

}  // namespace

MassProperties mass_properties(const Surface& surface, double density) {
  detail::require_positive("density", density);
  check_closed(surface);
  const Vector3 apex = middle(surface);
  const Moments rough = moments_about(surface, apex, density);
  MassProperties body{.mass = rough.mass};
  body.centre = apex + rough.centre / rough.mass;
  body.inertia = inertia_of(moments_about(surface, body.centre, density).second);
  check_overflow(body);
  return body;
}

MassProperties mass_properties(const Mesh& mesh) {
  if (mesh.elements.empty()) throw MeshError("the mesh has no element");
  std::vector<Moments> elements(mesh.elements.size());
  Sum<1, 1> mass;
  Sum<3, 1> first;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    elements[i] = element_moments(mesh, static_cast<int>(i));
    mass.add(Sum<1, 1>::Term(elements[i].mass));
    first.add(elements[i].mass * elements[i].centre);
  }
  MassProperties body{.mass = mass.value()(0)};
  body.centre = first.value().matrix() / body.mass;
  // About the centre no term of the diagonal is negative: nothing cancels.
  Sum<3, 3> second;
  for (const Moments& element : elements) {
    const Vector3 arm = element.centre - body.centre;
    second.add(element.second + element.mass * arm * arm.transpose());
  }
  body.inertia = inertia_of(second.value());
  check_overflow(body);
  return body;
}

void check_inertia(const Matrix3& inertia) {
  using detail::require;
  require(inertia.allFinite(), "inertia", inertia.sum(), "finite");
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  require(moments[0] > 0, "smallest principal moment of inertia", moments[0], "greater than 0");
  require(moments[2] <= (moments[0] + moments[1]) * (1 + 1e-9), "largest principal moment of inertia", moments[2],
          "at most the sum of the other two");
}

Matrix3 inverse_inertia(const Matrix3& inertia) {
  // By a power of two, which rounds nothing: the determinant of a large body's inertia overflows.
  const int exponent = std::ilogb(inertia.trace());
  const auto scaled = [](const Matrix3& m, int power) {
    return Matrix3(m.unaryExpr([&](double x) { return std::scalbn(x, power); }));
  };
  return scaled(scaled(inertia, -exponent).inverse(), -exponent);
}

}  // namespace clatter::numeric
