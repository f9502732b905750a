// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/no_root.hpp"

#include <cmath>

namespace clatter::analytic {

bool stays_above(const VertexHeight& height, double end, const detail::Turn& turn) {
  constexpr double longest = 3;                    // of half a turn
  constexpr double told = 1.0 / 64, above = 1e-9;  // shares of its size from which the sign of a sum is certain
  const double p = height.versine, q = height.sine, size = told * (std::fabs(p) + std::fabs(q));
  const bool turns = height.rate * (height.rate * size) > 0 && turn.angle < longest;
  if (!(turns && height.height >= 0 && height.gravity >= 0)) return false;
  const auto [last_height, last_velocity, scale] = height.at(end, turn);
  if (!(last_height > above * scale)) return false;
  const double fall = height.gravity / (height.rate * height.rate), cosine = 1 - turn.versine;
  const double first = p - fall, last = p * cosine + q * turn.sine - fall;  // h″/ω² at both ends
  if (!(std::fabs(first) > size && std::fabs(last) > size)) return false;
  // Rises to where it is concave, and from there to an end above the ground; or the other way round.
  if (first > 0) return height.velocity >= 0;
  if (last > 0) return last_velocity <= 0;
  return fall == 0 || q * (q * cosine - p * turn.sine) > 0;  // concave, with no peak of the curvature in between
}

}  // namespace clatter::analytic
