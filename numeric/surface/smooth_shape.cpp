// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/smooth_shape.hpp"

#include <algorithm>

namespace clatter::numeric {

Vector3 SmoothShape::end_centre(int end) const {
  return centre + Vector3(end == 0 ? -straight / 2 : straight / 2, 0, 0);
}

Vector3 SmoothShape::lowest(int end, const Vector3& normal) const {
  const Vector3 stretched = semiaxes.cwiseProduct(normal);
  return end_centre(end) - semiaxes.cwiseProduct(stretched) / stretched.norm();
}

double SmoothShape::reach() const {
  return std::max(end_centre(0).norm(), end_centre(ends() - 1).norm()) + semiaxes.maxCoeff();
}

}  // namespace clatter::numeric
