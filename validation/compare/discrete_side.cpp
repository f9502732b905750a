// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/discrete_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/law/impact_limits.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline compare {
namespace {

namespace space = analytic::space;
using analytic::ImpactMode;
using analytic::ImpactRow;
using numeric::Vector3;
using space::PathKind;

/// End of the continuous model's kind: by the side of the body that the vertices are on.
std::string end_of(const analytic::PlanarBody& body, const ImpactRow& row) {
  bool left = false, right = false;
  for (int i = 0; i < body.vertex_count; ++i) {
    if (!(row.vertices >> i & 1)) continue;
    (body.vertices[static_cast<std::size_t>(i)].x < 0 ? left : right) = true;
  }
  return left && right ? "both" : left ? "a" : "b";
}

bool jams(const analytic::Drop& drop, const ImpactRow& row) {
  if (drop.law.friction != analytic::FrictionKind::coulomb || std::popcount(row.vertices) != 1) return false;
  const analytic::ContactPoint d =
      drop.body.contact_point(std::countr_zero(row.vertices), std::sin(row.inclination), std::cos(row.inclination));
  const double limit = analytic::jamming_ratio(contact_inertia(drop.body.gyration_square, d));
  return drop.law.friction_value >= std::fabs(limit);
}

/// The body lies flat or stands upright as it lands.
bool is_face(const ImpactRow& row) {
  constexpr double square = 1e-12;  // [rad]
  return row.contact_angle < square || row.contact_angle > analytic::pi / 2 - square;
}

/// A whole face lands while it turns or slides.  Where along the face the ground then presses decides the rebound,
/// which impulses at corners do not know; only a face that lands at rest against the ground has one answer.
bool is_open_face(const ImpactRow& row) {
  return is_face(row) && (row.before.angular != 0 || row.impact.tangential_impulse != 0);
}

SequenceImpact planar_impact(const analytic::Drop& drop, const ImpactRow& row, const Impact& found) {
  const ImpactMode mode = row.impact.mode;
  SequenceImpact impact{.numbers = motion_numbers(found.value),
                        .errors = motion_numbers(found.error),
                        .end = end_of(drop.body, row),
                        .place = {},
                        .amplification = row.amplification,
                        .predictable = row.amplification * std::numeric_limits<double>::epsilon() <= 0.01,
                        .is_group = false,
                        .sticks = mode == ImpactMode::stick || mode == ImpactMode::slip_stick,
                        .nearly_stops = false,
                        .jams = jams(drop, row),
                        .open = {},
                        .follows_open = {}};
  if (is_open_face(row)) {
    impact.open = "a whole face lands turning or sliding: its rebound depends on where along it the ground presses";
  }
  return impact;
}

DiscreteSide planar_side(const Scene& scene, const analytic::Drop& drop) {
  const analytic::Sequence sequence = impact_sequence(drop, {.impacts = scene.request.impacts});
  const Run run = run_of(sequence, scene.angle_deg);
  DiscreteSide side{.in_space = false,
                    .corners = {},
                    .quantities = plane_quantities,
                    .impacts = {},
                    .scales = comparison_scales(run.impacts, {.reach = drop.body.reach(), .mass = drop.body.mass}),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  bool after_face = false;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const ImpactRow& row = sequence.rows[i];
    SequenceImpact& impact = side.impacts.emplace_back(planar_impact(drop, row, run.impacts[i]));
    if (after_face) impact.follows_open = "follows the landing of a whole face: rounding decides how it lands again";
    after_face = after_face || is_face(row);
  }
  return side;
}

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

SequenceImpact space_impact(const Scene& scene, const space::Drop& drop, const space::ImpactRow& row,
                            const Impact& found) {
  Vector3 place = Vector3::Zero();
  std::string names;
  for (const space::Corner& corner : row.corners) {
    place += corner.place / static_cast<double>(row.corners.size());
    names += (names.empty() ? "" : " ") + corner_name(scene, corner);
  }
  const PathKind path = row.impact.path;
  SequenceImpact impact{.numbers = motion_numbers(found.value),
                        .errors = motion_numbers(found.error),
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

DiscreteSide space_side(const Scene& scene, const space::Drop& drop) {
  const space::Sequence sequence = impact_sequence(drop, {.impacts = scene.request.impacts});
  const Run run = run_of(sequence);
  DiscreteSide side{.in_space = true,
                    .corners = {},
                    .quantities = space_quantities,
                    .impacts = {},
                    .scales = comparison_scales(run.impacts, {.reach = drop.body.reach(), .mass = drop.body.mass}),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  for (std::size_t i = 0; i < drop.body.vertices.size(); ++i) {
    const space::Corner corner{.index = static_cast<int>(i), .place = drop.body.vertices[i]};
    side.corners.push_back({corner.place, corner_name(scene, corner)});
  }
  bool after_group = false;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const space::ImpactRow& row = sequence.rows[i];
    SequenceImpact& impact = side.impacts.emplace_back(space_impact(scene, drop, row, run.impacts[i]));
    if (after_group) impact.follows_open = "follows corners that landed at once: rounding decides their order";
    after_group = after_group || row.group.has_value();
  }
  return side;
}

}  // namespace

DiscreteSide discrete_side(const Scene& scene, const DiscreteDrop& drop) {
  if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) return planar_side(scene, *planar);
  return space_side(scene, std::get<analytic::space::Drop>(drop));
}

}  // namespace clatter::validation::inline compare
