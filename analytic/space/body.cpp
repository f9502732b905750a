// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/detail/require.hpp"
#include "analytic/space/principal_axes.hpp"

namespace clatter::analytic::space {

using detail::require;
namespace {

void require_finite(const Vector3& v, const std::string& field) {
  for (int i = 0; i < 3; ++i) require(std::isfinite(v[i]), field, v[i], "finite");
}

/// Rounding of the principal moments, relative to the largest.
constexpr double slack = 16 * std::numeric_limits<double>::epsilon();

void validate_inertia(const Matrix3& inertia) {
  for (int i = 0; i < 3; ++i) require_finite(inertia.col(i), "inertia");
  const double size = inertia.cwiseAbs().maxCoeff();
  const double skew = (inertia - inertia.transpose()).cwiseAbs().maxCoeff();
  require(skew <= slack * size, "inertia minus its transpose", skew, "zero: the tensor is symmetric");
  const PrincipalAxes principal(inertia);
  const auto [a, b, c] = principal.moments;
  require(a > 0, "smallest principal moment of inertia", static_cast<double>(a), "above 0");
  require(a + b >= c * (1 - slack), "sum of the two smaller principal moments of inertia less the largest",
          static_cast<double>(a + b - c), "at least 0 (triangle inequality)");
}

}  // namespace

double Body::reach() const {
  double reach = 0;
  for (const Vector3& vertex : vertices) reach = std::fmax(reach, vertex.norm());
  for (const Rim& rim : rims) {
    const double along = rim.centre.dot(rim.axis);
    const double across = (rim.centre - along * rim.axis).norm();
    reach = std::fmax(reach, std::hypot(along, across + rim.radius));
  }
  return reach;
}

void Body::validate() const {
  require(mass > 0 && std::isfinite(mass), "mass", mass, "above 0 and finite");
  validate_inertia(inertia);
  require(!vertices.empty() || !rims.empty(), "number of vertices and rims", 0, "at least 1");
  for (const Vector3& vertex : vertices) require_finite(vertex, "vertex");
  for (const Rim& rim : rims) {
    require_finite(rim.centre, "centre of a rim");
    require_finite(rim.axis, "axis of a rim");
    require(std::fabs(rim.axis.norm() - 1) <= slack, "length of a rim's axis", rim.axis.norm(), "1");
    require(rim.radius > 0 && std::isfinite(rim.radius), "radius of a rim", rim.radius, "above 0 and finite");
  }
  require(reach() > 0, "reach of the body", reach(), "above 0");
}

}  // namespace clatter::analytic::space
