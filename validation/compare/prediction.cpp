// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "validation/output/estimated.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using analytic::Drop;
using analytic::ImpactRow;
using analytic::Sequence;
using analytic::Vertex;
using space::Vector3;

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

template <class AnyDrop>
auto run(const AnyDrop& drop, std::size_t impacts) {
  return impact_sequence(drop, {.impacts = static_cast<int>(impacts), .amplification = false});
}

bool same_contact(const ImpactRow& one, const ImpactRow& other) { return one.vertices == other.vertices; }

bool same_contact(const space::ImpactRow& one, const space::ImpactRow& other) {
  return std::ranges::equal(one.corners, other.corners, {}, &space::Corner::index, &space::Corner::index);
}

/// |difference| of each number of each row from `first` on, added to `sizes`.
template <class AnySequence>
void add_difference(const AnySequence& base, const AnySequence& other, std::size_t first,
                    std::vector<PredictedSize>& sizes, MotionNumbers PredictedSize::*effect) {
  bool same = true;
  for (std::size_t i = 0; first + i < sizes.size(); ++i) {
    same = same && i < base.rows.size() && i < other.rows.size() && same_contact(base.rows[i], other.rows[i]);
    MotionNumbers apart;
    apart.fill(unknown_error);
    if (same) {
      const MotionNumbers a = motion_numbers(impact_of(base.rows[i]).value),
                          b = motion_numbers(impact_of(other.rows[i]).value);
      for (std::size_t q = 0; q < motion_number_count; ++q) apart[q] = std::fabs(b[q] - a[q]);
    }
    for (std::size_t q = i == 0 ? 2 : 0; q < motion_number_count; ++q) {  // time and angle of a contact are before it
      (sizes[first + i].*effect)[q] += apart[q];
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

space::Drop turned(space::Drop drop, const Vector3& by) {
  if (by.norm() > 0) drop.attitude = Eigen::AngleAxisd(by.norm(), by.normalized()) * drop.attitude;
  return drop;
}

/// The body with the corner `by` further inside along one of its axes.
space::Drop shrunk(space::Drop drop, const Vector3& corner, int axis, double by) {
  const double reach = std::fabs(corner[axis]);
  const double factor = 1 - (reach > 0 ? std::min(by / reach, 0.5) : 0);
  for (Vector3& vertex : drop.body.vertices) vertex[axis] *= factor;
  return drop;
}

Drop faster(Drop drop, double by) {
  drop.velocity.normal -= by;
  return drop;
}

space::Drop faster(space::Drop drop, double by) {
  drop.velocity.z() -= by;
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

void add_effects(const space::Drop& drop, const space::ImpactRow& row, double time, std::size_t index,
                 std::vector<PredictedSize>& sizes) {
  const space::Drop here = drop_at(drop, row);
  const std::size_t impacts = sizes.size() - index;
  const space::Sequence base = run(here, impacts);
  add_difference(base, run(faster(here, drop.gravity * time), impacts), index, sizes, &PredictedSize::gravity);
  if (row.corners.size() == 1) {  // several corners stay together while they are in contact
    const Vector3 &before = row.before.angular_velocity, &after = row.impact.angular_velocity_after;
    const Vector3 turn = (before.norm() > after.norm() ? before : after) * (time / 2);
    add_difference(base, run(turned(here, turn), impacts), index, sizes, &PredictedSize::turning);
  }
  const double depth = row.approach_speed * time / (2 * std::numbers::pi);  // of the pressure centre, in the mean
  for (int axis = 0; axis < 3; ++axis) {
    const space::Drop smaller = shrunk(here, row.corners.front().place, axis, depth);
    add_difference(base, run(smaller, impacts), index, sizes, &PredictedSize::indentation);
  }
  for (std::size_t i = index + 1; i < sizes.size(); ++i) sizes[i].delay[0] += time / 2;
}

template <class AnyDrop, class AnySequence>
std::vector<PredictedSize> sizes_of(const AnyDrop& drop, const AnySequence& sequence,
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

/// The same with the centre of mass as low as the ground and no product of inertia that tilts by a couple about the
/// vertical: the face is pressed evenly.
space::Drop pressed_evenly(space::Drop drop, double depth) {
  const space::Matrix3 axes = drop.attitude.toRotationMatrix();
  for (Vector3& vertex : drop.body.vertices) vertex += axes.transpose() * Vector3(0, 0, depth);
  space::Matrix3 inverse = axes * drop.body.inertia.inverse() * axes.transpose();
  inverse.topRightCorner<2, 1>().setZero();
  inverse.bottomLeftCorner<1, 2>().setZero();
  drop.body.inertia = axes.transpose() * inverse.inverse() * axes;
  return drop;
}

}  // namespace

MotionNumbers PredictedSize::total() const {
  MotionNumbers sum{};
  for (std::size_t q = 0; q < motion_number_count; ++q) {
    sum[q] = gravity[q] + turning[q] + indentation[q] + delay[q] + tipping[q];
  }
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

FaceTipping face_tipping(const space::Drop& drop, const space::ImpactRow& row) {
  const space::Drop here = drop_at(drop, row);
  const space::Matrix3 axes = here.attitude.toRotationMatrix();
  const double depth = -(axes * row.corners.front().place).z();
  const space::Sequence even = run(pressed_evenly(here, depth), 1);
  const space::GroupImpact& group = *even.rows.at(0).group;
  const Vector3 moment = Vector3(0, 0, -depth).cross(group.impulse) + group.moment.z() * Vector3::UnitZ();
  const Vector3 turn = axes * here.body.inertia.inverse() * (axes.transpose() * moment);
  const double tipped = turn.head<2>().norm(), reach = here.body.reach();
  FaceTipping tipping{.lean = tipped * reach / row.approach_speed, .size = {}};
  const double speed = depth * tipped + tipping.lean * tipping.lean * row.approach_speed;
  const MotionNumbers by_rule = motion_numbers(impact_of(row).value),
                      evenly = motion_numbers(impact_of(even.rows[0]).value);
  MotionNumbers& size = tipping.size;
  for (std::size_t q = 2; q < motion_number_count; ++q) size[q] = std::fabs(evenly[q] - by_rule[q]);
  for (const std::size_t axis : {0, 1, 2}) {
    size[2 + axis] += here.body.mass * speed;
    size[5 + axis] += speed;
  }
  for (const std::size_t axis : {0, 1}) size[8 + axis] += tipped;
  size[10] += speed / reach;
  return tipping;
}

space::Drop drop_at(const space::Drop& drop, const space::ImpactRow& row) {
  space::Drop here = drop;
  here.attitude = row.before.attitude;
  here.velocity = row.before.velocity;
  here.angular_velocity = row.before.angular_velocity;
  return here;
}

std::vector<PredictedSize> predicted_sizes(const Drop& drop, const Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  return sizes_of(drop, sequence, contact_times);
}

std::vector<PredictedSize> predicted_sizes(const space::Drop& drop, const space::Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  return sizes_of(drop, sequence, contact_times);
}

}  // namespace clatter::validation
