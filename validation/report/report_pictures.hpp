// SPDX-License-Identifier: GPL-3.0-or-later
// The report's own drawings, as SVG elements whose colours follow the page: the body over the floor, and what drops in
// all attitudes give.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "numeric/body/body.hpp"
#include "validation/scene/probes.hpp"

namespace clatter::validation {

/// The body as it comes to the floor, seen from a little above, with its probes; hollow is what lies inside or behind.
/// @param attitude  body to world, unit; centre of mass in the body's frame [m]
[[nodiscard]] std::string body_picture(const numeric::Body& body, const Eigen::Quaterniond& attitude,
                                       const std::vector<Probe>& probes, const numeric::Vector3& centre);

/// A drop: which way is down in the body's axes, unit, and what it is ranked by.
struct RankedDrop {
  numeric::Vector3 down;
  double value = 0;
  std::string words;  ///< shown where one points at it
};
/// Both halves of the sphere of directions, equal areas equal (Lambert's azimuthal projection), a dot for each drop.
/// @param worst  index of the one with a ring
/// @param what  the dots' numbers are, with unit
/// @param is_least_worst  dark is the least, not the largest
[[nodiscard]] std::string attitude_map(const std::vector<RankedDrop>& drops, std::size_t worst, const std::string& what,
                                       bool is_least_worst);

}  // namespace clatter::validation
