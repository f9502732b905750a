// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/discrete_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/law/impact_limits.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {
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

/// A whole face strikes first and slides without a turn.
bool lands_sliding(const analytic::Sequence& sequence) {
  return !sequence.rows.empty() && is_open_face(sequence.rows[0]) && sequence.rows[0].before.angular == 0;
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
                        .follows_open = {},
                        .is_face = false,
                        .tipping = {}};
  if (is_open_face(row)) {
    impact.open = "a whole face lands turning or sliding: its rebound depends on where along it the ground presses";
  }
  return impact;
}

DiscreteSide planar_side(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence) {
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

/// Where a ground that gives way evenly presses: the centre of the area between the corners, of an edge its middle.
/// Body frame, from the centre of mass.
Vector3 middle_of(const space::ImpactRow& row, const Vector3& mean) {
  if (is_edge(row)) return mean;
  const auto foot = [&](const space::Corner& corner) {
    return space::Vector2((row.before.attitude * (corner.place - mean)).head<2>());
  };
  std::vector<space::Vector2> around;
  for (const space::Corner& corner : row.corners) around.push_back(foot(corner));
  std::ranges::sort(around, {}, [](const space::Vector2& p) { return std::atan2(p.y(), p.x()); });
  double area = 0;
  space::Vector2 moment = space::Vector2::Zero();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const space::Vector2 &from = around[i], &to = around[(i + 1) % around.size()];
    const double twice = from.x() * to.y() - from.y() * to.x();
    area += 3 * twice;
    moment += twice * (from + to);
  }
  return mean + row.before.attitude.conjugate() * Vector3(moment.x() / area, moment.y() / area, 0);
}

/// Whether the impulse acts at the middle.
bool acts_in_the_middle(const space::ImpactRow& row, const Vector3& middle) {
  const Vector3 arm = row.before.attitude * middle, &impulse = row.impact.impulse;
  return (row.group->moment - arm.cross(impulse)).norm() <= 1e-9 * arm.norm() * impulse.norm();
}

/// Whether all of a face lands and leaves without a turn about the horizontal, its middle below the centre of mass: an
/// even bed then turns it by friction alone.
bool is_even_landing(const space::ImpactRow& row, const Vector3& middle) {
  const Vector3 arm = row.before.attitude * middle;
  return arm.head<2>().norm() <= 1e-9 * row.corners.front().place.norm();
}

/// Corners that come down and leave with one speed, pressed in their middle, have one answer on any ground; where they
/// do not, the rebound depends on where between them the ground presses.
bool is_settled(const space::ImpactRow& row, const Vector3& middle, double scale) {
  const space::Impact& impact = row.impact;
  const bool as_one = moves_as_one(row, row.before.velocity, row.before.angular_velocity, scale) &&
                      moves_as_one(row, impact.velocity_after, impact.angular_velocity_after, scale);
  if (!row.group->is_whole || !as_one) return false;
  return is_edge(row) ? acts_in_the_middle(row, middle) : is_even_landing(row, middle);
}

std::string open_words(const space::Drop& drop, const space::ImpactRow& row) {
  return fmt::format("{}: the rebound depends on where between them the ground presses; {}", landing_words(row.corners),
                     tilt_words(tilted_outcomes(drop.body, row.before, row.corners, drop.law)));
}

/// Why the rule of corners that land at once is not that of an ever stiffer ground, and how far an even bed may be from
/// it where it is.
void judge_group(const space::Drop& drop, const space::ImpactRow& row, const Vector3& mean, SequenceImpact& impact) {
  constexpr double most_lean = 0.1;  // beyond it tipping has a limit of its own
  impact.is_face = row.group->is_whole && !is_edge(row) && row.held == 0;
  const double scale = row.before.velocity.norm() + row.before.angular_velocity.norm() * drop.body.reach();
  if (!is_settled(row, middle_of(row, mean), scale)) {
    impact.open = open_words(drop, row);
    return;
  }
  if (!impact.is_face) return;
  const FaceTipping tipping = face_tipping(drop, row);
  impact.tipping = tipping.size;
  if (tipping.lean <= most_lean) return;
  impact.open = fmt::format(
      "{}: friction, far below the centre of mass, tips the body on an even bed, its ends at up to {} of the approach "
      "speed, where the rule keeps it from turning",
      landing_words(row.corners), significant(tipping.lean, 2));
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
                        .follows_open = {},
                        .is_face = false,
                        .tipping = {}};
  if (row.group) judge_group(drop, row, place, impact);
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

DiscreteSide discrete_side(const Scene& scene, DiscreteBody& body) {
  const DiscreteDrop drop = body.drop(scene);
  const auto* const planar = std::get_if<analytic::Drop>(&drop);
  if (planar == nullptr) return space_side(scene, std::get<space::Drop>(drop));
  const analytic::Sequence sequence = impact_sequence(*planar, {.impacts = scene.request.impacts});
  if (!scene.world.planar && lands_sliding(sequence)) return space_side(scene, body.drop_in_space(scene));
  return planar_side(scene, *planar, sequence);
}

}  // namespace clatter::validation
