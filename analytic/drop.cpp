// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "analytic/detail/require.hpp"
#include "analytic/sequence.hpp"

namespace clatter::analytic {

using detail::require;

void Drop::validate() const {
  law.validate();
  require(std::fabs(inclination.radians) <= pi, "inclination", inclination.degrees, "from -180 to 180 degrees");
  require(gravity >= 0 && std::isfinite(gravity), "gravity", gravity, "at least 0 and finite");
  require(std::isfinite(velocity.normal), "normal velocity", velocity.normal, "finite");
  require(std::isfinite(velocity.tangential), "tangential velocity", velocity.tangential, "finite");
  require(std::isfinite(velocity.angular), "spin", velocity.angular, "finite");
  require(body.vertex_count >= 1, "vertex count", body.vertex_count, "at least 1");
  // k² of lengths beyond 1e±150 m overflows or loses its digits.
  require(std::isnormal(body.gyration_square) && body.gyration_square > 0, "gyration radius squared",
          body.gyration_square, "a positive double that is not subnormal");
}

}  // namespace clatter::analytic
