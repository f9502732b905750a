// SPDX-License-Identifier: GPL-3.0-or-later
// The vector product as a matrix.
#pragma once

#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

/// V×, such that (V×) a = V × a.
inline Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

}  // namespace clatter::analytic::space
