// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace clatter::validation::inline compare {
namespace {

using analytic::Drop;
using analytic::ImpactRow;
using analytic::PlanarVelocity;
using analytic::Sequence;
using analytic::Vertex;

void mirror(Drop& drop, double& inclination) {
  inclination = -inclination;
  drop.velocity.tangential = -drop.velocity.tangential;
  drop.velocity.angular = -drop.velocity.angular;
  for (Vertex& vertex : drop.body.vertices) vertex.x = -vertex.x;
}

void turn_over(Drop& drop, double& inclination) {
  inclination -= std::copysign(analytic::pi, inclination);
  for (Vertex& vertex : drop.body.vertices) vertex = {-vertex.x, -vertex.z};
}

Sequence run(const Drop& drop, std::size_t impacts) {
  return impact_sequence(drop, {.impacts = static_cast<int>(impacts), .amplification = false});
}

/// |difference| of each number of each row from `first` on, added to `sizes`.
void add_difference(const Sequence& base, const Sequence& other, std::size_t first, std::vector<PredictedSize>& sizes,
                    MotionNumbers PredictedSize::*effect) {
  bool same = true;
  for (std::size_t i = 0; first + i < sizes.size(); ++i) {
    same = same && i < base.rows.size() && i < other.rows.size() && base.rows[i].vertices == other.rows[i].vertices;
    for (std::size_t q = i == 0 ? 2 : 0; q < motion_number_count; ++q) {  // time and angle of a contact are before it
      (sizes[first + i].*effect)[q] +=
          same ? std::fabs(motion_numbers(other.rows[i])[q] - motion_numbers(base.rows[i])[q])
               : std::numeric_limits<double>::infinity();
    }
  }
}

Drop turned(Drop drop, double by) {
  const double angle = drop.inclination.radians;
  const double to = angle + by <= analytic::pi / 2 ? angle + by : angle - by;
  drop.inclination = analytic::Angle::from_radians(std::clamp(to, 0.0, analytic::pi / 2));
  return drop;
}

Drop shrunk(Drop drop, double by) {
  const double factor = 1 - std::min(by / drop.body.reach(), 0.5);
  for (Vertex& vertex : drop.body.vertices) vertex = {factor * vertex.x, factor * vertex.z};
  return drop;
}

Drop faster(Drop drop, double by) {
  drop.velocity.normal -= by;
  return drop;
}

void add_effects(const Drop& drop, const ImpactRow& row, double contact_time, std::size_t index,
                 std::vector<PredictedSize>& sizes) {
  const Drop here = drop_at(drop, row);
  const std::size_t impacts = sizes.size() - index;
  const Sequence base = run(here, impacts);
  const double rate = std::max(std::fabs(row.before.angular), std::fabs(row.impact.after.angular));
  const bool flat = row.contact_angle == 0 || std::fabs(std::cos(row.contact_angle)) < 1e-15;
  add_difference(base, run(faster(here, drop.gravity * contact_time), impacts), index, sizes, &PredictedSize::gravity);
  if (!flat) {
    add_difference(base, run(turned(here, rate * contact_time / 2), impacts), index, sizes, &PredictedSize::turning);
  }
  const double depth = row.impact.approach_speed * contact_time / analytic::pi;
  add_difference(base, run(shrunk(here, depth), impacts), index, sizes, &PredictedSize::indentation);
  for (std::size_t i = index + 1; i < sizes.size(); ++i) sizes[i].delay[0] += contact_time / 2;
}

}  // namespace

MotionNumbers PredictedSize::total() const {
  MotionNumbers sum{};
  for (std::size_t q = 0; q < motion_number_count; ++q) sum[q] = gravity[q] + turning[q] + indentation[q] + delay[q];
  return sum;
}

Drop drop_at(const Drop& drop, const ImpactRow& row) {
  Drop here = drop;
  here.velocity = row.before;
  double inclination = row.inclination;
  if (std::fabs(inclination) > analytic::pi / 2) turn_over(here, inclination);
  if (inclination < 0) mirror(here, inclination);
  here.inclination = analytic::Angle::from_radians(std::min(inclination, analytic::pi / 2));
  return here;
}

std::vector<PredictedSize> predicted_sizes(const Drop& drop, const Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  std::vector<PredictedSize> sizes(std::min(sequence.rows.size(), contact_times.size()));
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    try {
      add_effects(drop, sequence.rows[i], contact_times[i], i, sizes);
    } catch (const std::domain_error&) {  // the shifted state no longer approaches the ground
      for (std::size_t later = i; later < sizes.size(); ++later) {
        sizes[later].turning.fill(std::numeric_limits<double>::infinity());
      }
    }
  }
  return sizes;
}

}  // namespace clatter::validation::inline compare
