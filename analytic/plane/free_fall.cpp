// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/free_fall.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "analytic/base/limits.hpp"

namespace clatter::analytic {

using detail::epsilon;
using detail::infinite;

Drop after_free_fall(const Drop& release, double height) {
  release.validate();
  const PlanarVelocity& v = release.velocity;
  const double sense = v.angular < 0 ? -1 : 1;
  std::array<VertexHeight, max_vertices> heights;
  int first = -1;
  FirstRoot touch;
  for (int i = 0; i < release.body.vertex_count; ++i) {
    const ContactPoint d = release.body.contact_point(i, release.inclination.sine, release.inclination.cosine);
    const auto k = static_cast<std::size_t>(i);
    heights[k] = {.height = height + d.normal,
                  .velocity = v.normal - v.angular * d.tangential,
                  .gravity = release.gravity,
                  .rate = std::fabs(v.angular),
                  .versine = -d.normal,
                  .sine = sense * d.tangential};
    if (!(heights[k].height > 0)) throw std::domain_error("a vertex of the released body is not above the ground");
    const FirstRoot root = first_root(heights[k], touch.time.value_or(detail::never));
    if (root.time && (!touch.time || *root.time < *touch.time)) first = i, touch = root;
  }
  if (first < 0) throw std::domain_error("the released body never reaches the ground");
  const double t = *touch.time;
  // Rounding of the numbers given counts as much as that of the height, which is below 4ε × scale.
  const auto error_of = [&](const VertexHeight::Value& at) { return 8 * epsilon * (at.scale + height); };
  const auto at = [&](int i) { return heights[static_cast<std::size_t>(i)].at(t); };
  const VertexHeight::Value arrival = at(first);
  double late = touch.within_margin ? infinite : error_of(arrival) / std::fabs(arrival.velocity);
  const double bend = std::fabs(heights[static_cast<std::size_t>(first)].acceleration(t));
  if (!(late * bend <= 0.02 * std::fabs(arrival.velocity))) late = infinite;
  for (int i = 0; i < release.body.vertex_count && v.angular != 0; ++i) {  // which of them comes first must be certain
    const VertexHeight::Value other = at(i);
    if (i != first && other.velocity < 0 && !(other.height > 2 * error_of(other))) late = infinite;
  }
  Drop drop = release;
  if (v.angular != 0)
    drop.inclination = Angle::from_radians(std::remainder(release.inclination.radians - v.angular * t, 2 * pi));
  drop.velocity.normal -= release.gravity * t;
  drop.fall = {.time = t,
               .time_error = late,
               .inclination_error = v.angular == 0 ? 0
                                                   : std::fabs(v.angular) * (late + epsilon * t) +
                                                         epsilon * std::fabs(release.inclination.radians),
               .normal_error = release.gravity * (late + epsilon * t)};
  return drop;
}

}  // namespace clatter::analytic
