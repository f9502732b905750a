// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/space_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/compare/space_prediction.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline compare {
namespace {

namespace space = analytic::space;
using numeric::Vector3;
using space::PathKind;

/// Vertical velocities of the corners that arrived, before or after the impact.
bool moves_as_one(const space::ImpactRow& row, const Vector3& velocity, const Vector3& rate, double scale) {
  constexpr double rounding = 1e-10;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const space::Corner& corner : row.corners) {
    const double up = (velocity + rate.cross(row.before.attitude * corner.place)).z();
    least = std::min(least, up);
    most = std::max(most, up);
  }
  return most - least <= rounding * scale;
}

/// Whether the corners lie on one line.
bool is_edge(const space::ImpactRow& row) {
  const Vector3 along = row.corners[1].place - row.corners[0].place;
  return std::ranges::all_of(row.corners, [&](const space::Corner& corner) {
    return along.cross(corner.place - row.corners[0].place).norm() <= 1e-9 * along.squaredNorm();
  });
}

/// Whether the impulse acts at the middle of the corners, where a ground that gives way evenly presses.
bool acts_in_the_middle(const space::ImpactRow& row, const Vector3& middle) {
  const Vector3 arm = row.before.attitude * middle, &impulse = row.impact.impulse;
  return (row.group->moment - arm.cross(impulse)).norm() <= 1e-9 * arm.norm() * impulse.norm();
}

/// Corners that come down and leave with one speed, pressed in their middle, have one answer on any ground; where they
/// do not, or friction tips a face, the rebound depends on where between them the ground presses.
bool is_settled(const space::ImpactRow& row, const Vector3& middle, double scale) {
  const space::Impact& impact = row.impact;
  const bool as_one = moves_as_one(row, row.before.velocity, row.before.angular_velocity, scale) &&
                      moves_as_one(row, impact.velocity_after, impact.angular_velocity_after, scale);
  return row.group->is_whole && as_one && acts_in_the_middle(row, middle) &&
         (is_edge(row) || impact.impulse.head<2>().isZero(0));
}

std::string open_words(const space::Drop& drop, const space::ImpactRow& row) {
  return fmt::format("{}: the rebound depends on where between them the ground presses; {}", landing_words(row.corners),
                     tilt_words(tilted_outcomes(drop.body, row.before, row.corners, drop.law)));
}

SequenceImpact space_impact(const Scene& scene, const space::Drop& drop, const space::ImpactRow& row) {
  Vector3 place = Vector3::Zero();
  std::string names;
  for (const space::Corner& corner : row.corners) {
    place += corner.place / static_cast<double>(row.corners.size());
    names += (names.empty() ? "" : " ") + corner_name(scene, corner);
  }
  const PathKind path = row.impact.path;
  SequenceImpact impact{.numbers = motion_numbers(row),
                        .errors = motion_errors(row),
                        .end = names,
                        .place = place,
                        .amplification = row.amplification,
                        .predictable = row.error.predictable,
                        .is_group = row.group.has_value(),
                        .sticks = path == PathKind::stick || path == PathKind::slip_stick,
                        .nearly_stops = row.impact.least_slip <= 1e-3 * row.impact.contact_before.norm(),
                        .jams = false,
                        .open = {},
                        .follows_open = {}};
  const double scale = row.before.velocity.norm() + row.before.angular_velocity.norm() * drop.body.reach();
  if (row.group && !is_settled(row, place, scale)) impact.open = open_words(drop, row);
  return impact;
}

}  // namespace

DiscreteSide space_side(const Scene& scene, const space::Drop& drop) {
  const space::Sequence sequence = impact_sequence(drop, {.impacts = scene.request.impacts});
  DiscreteSide side{.in_space = true,
                    .corners = {},
                    .quantities = space_quantities,
                    .impacts = {},
                    .scales = comparison_scales(sequence, drop.body),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  for (std::size_t i = 0; i < drop.body.vertices.size(); ++i) {
    const space::Corner corner{.index = static_cast<int>(i), .place = drop.body.vertices[i]};
    side.corners.push_back({corner.place, corner_name(scene, corner)});
  }
  bool after_group = false;
  for (const space::ImpactRow& row : sequence.rows) {
    SequenceImpact& impact = side.impacts.emplace_back(space_impact(scene, drop, row));
    if (after_group) impact.follows_open = "follows corners that landed at once: rounding decides their order";
    after_group = after_group || row.group.has_value();
  }
  return side;
}

}  // namespace clatter::validation::inline compare
