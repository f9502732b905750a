// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/energy_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/base/linear_algebra.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using numeric::Vector3;

/// How high the centre of mass is above the point, the edge or the face on which a body is at rest: these corners, from
/// the centre of mass, span it.
double height_above(const std::vector<Vector3>& corners) {
  Vector3 nearest = corners.front();
  std::vector<Vector3> along;  // directions of the span, of length 1 and at right angles
  for (const Vector3& corner : corners) {
    Vector3 edge = corner - corners.front();
    const double length = edge.norm();
    for (const Vector3& other : along) edge -= edge.dot(other) * other;
    if (along.size() == 2 || !(edge.norm() > 1e-6 * length)) continue;
    along.push_back(edge.normalized());
    nearest -= nearest.dot(along.back()) * along.back();
  }
  return nearest.norm();
}

/// @param scale  of the energies that the numbers are rounded at
double rounding(double scale) { return 16 * std::numeric_limits<double>::epsilon() * scale; }

std::optional<Estimated> lost(const analytic::Drop& drop, const analytic::Sequence& sequence) {
  if (!sequence.tail) return {};
  const analytic::ImpactRow &first = sequence.rows.front(), &last = sequence.rows.back();
  const analytic::Tail& tail = *sequence.tail;
  const double mass = drop.body.mass, weight = mass * drop.gravity, turning = tail.angular_velocity_after.y();
  std::vector<Vector3> corners;
  for (int i = 0; i < drop.body.vertex_count; ++i) {
    const analytic::Vertex& vertex = drop.body.vertices[static_cast<std::size_t>(i)];
    if ((tail.vertices >> i & 1U) != 0) corners.emplace_back(vertex.x, 0, vertex.z);
  }
  const bool is_still = turning == 0 && !corners.empty();
  const double speed = tail.velocity_after.norm(), height = is_still ? height_above(corners) : last.centre_height;
  const double left = weight * height + (mass * speed * speed + drop.body.inertia() * turning * turning) / 2;
  const double before = first.error.energy_before;
  Estimated loss{first.energy_before - left, unknown_error};
  if (drop.gravity_along != 0) {  // how far it has gone down the slope is not known
    loss.value = 0;
    for (const analytic::ImpactRow& row : sequence.rows) loss.value += row.impact.energy_loss;
  }
  const bool is_known = is_still && sequence.end_predictable && drop.gravity_along == 0;
  if (is_known && (std::isfinite(before) || !drop.fall)) {
    const double start = std::isfinite(before) ? before : 0;  // a drop without a flight begins as it is given
    const double moves = speed > 0 ? mass * speed * tail.velocity_error : 0;
    loss.error = start + moves + rounding(first.energy_before + left + weight * drop.body.reach());
  }
  return loss;
}

std::optional<Estimated> lost(const space::Drop& drop, const space::Sequence& sequence) {
  if (sequence.rows.empty() || (!sequence.tail && sequence.contacts.empty())) return {};
  const space::ImpactRow& first = sequence.rows.front();
  const double weight = drop.body.mass * drop.gravity;
  const auto is_corner = [&](int i) { return static_cast<std::size_t>(i) < drop.body.vertices.size(); };
  const bool lies = sequence.outcome == analytic::Outcome::at_rest && !sequence.moves_on && sequence.rest &&
                    drop.gravity_along == 0 && !sequence.rest->corners.empty() &&
                    std::ranges::all_of(sequence.rest->corners, is_corner);
  if (!lies) return Estimated{first.energy_before - sequence.energy_at_end, unknown_error};
  std::vector<Vector3> corners;
  for (const int corner : sequence.rest->corners)
    corners.push_back(drop.body.vertices[static_cast<std::size_t>(corner)]);
  const double left = weight * height_above(corners);
  Estimated loss{first.energy_before - left, unknown_error};
  if (sequence.end_predictable && std::isfinite(first.error.energy_before))
    loss.error = first.error.energy_before + rounding(first.energy_before + left + weight * drop.body.reach());
  return loss;
}

}  // namespace

std::optional<Estimated> energy_lost_with_tail(const DiscreteDrop& drop, const DiscreteSequence& sequence) {
  if (const auto* const planar = std::get_if<analytic::Sequence>(&sequence))
    return lost(std::get<analytic::Drop>(drop), *planar);
  return lost(std::get<space::Drop>(drop), std::get<space::Sequence>(sequence));
}

}  // namespace clatter::validation
