// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/newton_euler.hpp"

#include "numeric/base/require.hpp"
#include "numeric/body/inertia.hpp"

namespace clatter::numeric {

NewtonEuler::NewtonEuler(double mass, const Matrix3& inertia) : mass_(mass), inertia_(inertia) {
  detail::require_positive("mass", mass);
  check_inertia(inertia);
  inverse_inertia_ = inverse_inertia(inertia);
}

}  // namespace clatter::numeric
