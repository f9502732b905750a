#include "numeric/mass_properties.hpp"

#include <cmath>
#include <sstream>

#include "numeric/errors.hpp"
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

}  // namespace

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
  if (!(body.mass > 0 && body.centre.allFinite() && body.inertia.allFinite())) {
    throw NumericalError("the mass properties of the mesh overflow");
  }
  return body;
}

}  // namespace clatter::numeric
