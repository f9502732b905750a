// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/space_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/base/errors.hpp"
#include "validation/output/estimated.hpp"

namespace clatter::validation::inline compare {
namespace {

using analytic::space::Drop;
using analytic::space::ImpactRow;
using analytic::space::Sequence;
using analytic::space::Vector3;

Sequence run(const Drop& drop, std::size_t impacts) {
  return impact_sequence(drop, {.impacts = static_cast<int>(impacts), .amplification = false});
}

bool same_corners(const ImpactRow& one, const ImpactRow& other) {
  return std::ranges::equal(one.corners, other.corners, {}, &analytic::space::Corner::index,
                            &analytic::space::Corner::index);
}

/// |difference| of each number of each row from `first` on, added to `sizes`.
void add_difference(const Sequence& base, const Sequence& other, std::size_t first, std::vector<PredictedSize>& sizes,
                    MotionNumbers PredictedSize::*effect) {
  bool same = true;
  for (std::size_t i = 0; first + i < sizes.size(); ++i) {
    same = same && i < base.rows.size() && i < other.rows.size() && same_corners(base.rows[i], other.rows[i]);
    MotionNumbers apart;
    apart.fill(unknown_error);
    if (same) {
      const MotionNumbers a = motion_numbers(base.rows[i]), b = motion_numbers(other.rows[i]);
      for (std::size_t q = 0; q < motion_number_count; ++q) apart[q] = std::fabs(b[q] - a[q]);
    }
    for (std::size_t q = i == 0 ? 2 : 0; q < motion_number_count; ++q) {  // time and angle of a contact are before it
      (sizes[first + i].*effect)[q] += apart[q];
    }
  }
}

Drop turned(Drop drop, const Vector3& by) {
  if (by.norm() > 0) drop.attitude = Eigen::AngleAxisd(by.norm(), by.normalized()) * drop.attitude;
  return drop;
}

/// The body with the corner `by` further inside along one of its axes.
Drop shrunk(Drop drop, const Vector3& corner, int axis, double by) {
  const double reach = std::fabs(corner[axis]);
  const double factor = 1 - (reach > 0 ? std::min(by / reach, 0.5) : 0);
  for (Vector3& vertex : drop.body.vertices) vertex[axis] *= factor;
  return drop;
}

Drop faster(Drop drop, double by) {
  drop.velocity.z() -= by;
  return drop;
}

void add_effects(const Drop& drop, const ImpactRow& row, double time, std::size_t index,
                 std::vector<PredictedSize>& sizes) {
  const Drop here = drop_at(drop, row);
  const std::size_t impacts = sizes.size() - index;
  const Sequence base = run(here, impacts);
  add_difference(base, run(faster(here, drop.gravity * time), impacts), index, sizes, &PredictedSize::gravity);
  if (row.corners.size() == 1) {  // several corners stay together while they are in contact
    const Vector3 &before = row.before.angular_velocity, &after = row.impact.angular_velocity_after;
    const Vector3 turn = (before.norm() > after.norm() ? before : after) * (time / 2);
    add_difference(base, run(turned(here, turn), impacts), index, sizes, &PredictedSize::turning);
  }
  const double depth = row.approach_speed * time / (2 * std::numbers::pi);  // of the pressure centre, in the mean
  for (int axis = 0; axis < 3; ++axis) {
    const Drop smaller = shrunk(here, row.corners.front().place, axis, depth);
    add_difference(base, run(smaller, impacts), index, sizes, &PredictedSize::indentation);
  }
  for (std::size_t i = index + 1; i < sizes.size(); ++i) sizes[i].delay[0] += time / 2;
}

}  // namespace

Drop drop_at(const Drop& drop, const ImpactRow& row) {
  Drop here = drop;
  here.attitude = row.before.attitude;
  here.velocity = row.before.velocity;
  here.angular_velocity = row.before.angular_velocity;
  return here;
}

std::vector<PredictedSize> predicted_sizes(const Drop& drop, const Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  std::vector<PredictedSize> sizes(std::min(sequence.rows.size(), contact_times.size()));
  const auto give_up_from = [&](std::size_t i) {
    for (; i < sizes.size(); ++i) sizes[i].turning.fill(unknown_error);
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    try {
      add_effects(drop, sequence.rows[i], contact_times[i], i, sizes);
    } catch (const std::domain_error&) {  // the shifted state no longer approaches the ground
      give_up_from(i);
    } catch (const analytic::NumericalError&) {
      give_up_from(i);
    } catch (const analytic::OutsideModelError&) {
      give_up_from(i);
    }
  }
  return sizes;
}

}  // namespace clatter::validation::inline compare
