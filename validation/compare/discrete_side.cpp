// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/discrete_side.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/law/impact_limits.hpp"
#include "validation/compare/space_side.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/space_scene.hpp"

namespace clatter::validation::inline compare {
namespace {

using analytic::ImpactMode;
using analytic::ImpactRow;

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

SequenceImpact planar_impact(const analytic::Drop& drop, const ImpactRow& row) {
  const ImpactMode mode = row.impact.mode;
  SequenceImpact impact{.numbers = motion_numbers(row),
                        .errors = motion_errors(row),
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

DiscreteSide planar_side(const Scene& scene, const numeric::Body& body) {
  const analytic::Drop drop = discrete_drop(scene, body);
  const analytic::Sequence sequence = impact_sequence(drop, {.impacts = scene.request.impacts});
  DiscreteSide side{.in_space = false,
                    .corners = {},
                    .quantities = plane_quantities,
                    .impacts = {},
                    .scales = comparison_scales(sequence, drop.body),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  bool after_face = false;
  for (const ImpactRow& row : sequence.rows) {
    SequenceImpact& impact = side.impacts.emplace_back(planar_impact(drop, row));
    if (after_face) impact.follows_open = "follows the landing of a whole face: rounding decides how it lands again";
    after_face = after_face || is_face(row);
  }
  return side;
}

}  // namespace

DiscreteSide discrete_side(const Scene& scene, const numeric::Body& body) {
  return is_planar(scene, body) ? planar_side(scene, body) : space_side(scene, body);
}

}  // namespace clatter::validation::inline compare
