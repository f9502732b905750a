// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/record/motion_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/record/impact_quantities.hpp"

namespace clatter::validation::inline record {
namespace {

MotionNumbers sizes_of(double time, double speed, double radius, double mass) {
  const double impulse = mass * speed, turn = speed / radius;
  return {time, 90, impulse, impulse, impulse, speed, speed, speed, turn, turn, turn};
}

/// Sizes of a sequence whose last impact comes at `time`; an angle counts as a radian.
MotionNumbers scales_of(double time, double speed, double reach, double mass) {
  MotionNumbers sizes = sizes_of(time == 0 ? reach / speed : time, speed, reach, mass);
  sizes[1] = analytic::degrees_per_radian;
  return sizes;
}

/// The numbers of the list, vectors spread over three; or their errors.
template <class Impact>
MotionNumbers numbers_of(const Impact& impact, bool errors) {
  MotionNumbers numbers{};
  std::size_t place = 0;
  for (const ImpactQuantity& quantity : impact_quantities()) {
    if (!quantity.motion) continue;
    const Getter<Impact>& get = quantity.of<Impact>();
    const Entry entry = errors ? get.error(impact) : get.value(impact);
    if (const auto* vector = std::get_if<EntryVector>(&entry)) {
      for (const double part : *vector) numbers.at(place++) = part;
    } else {
      numbers.at(place++) = std::get<double>(entry);
    }
  }
  return numbers;
}

}  // namespace

MotionNumbers motion_numbers(const analytic::ImpactRow& row) { return numbers_of(DiscreteRow{row, 0}, false); }
MotionNumbers motion_numbers(const analytic::space::ImpactRow& row) { return numbers_of(SpaceRow{row}, false); }
MotionNumbers motion_numbers(const numeric::ImpactRecord& row) { return numbers_of(ContinuousRow{row}, false); }
MotionNumbers motion_errors(const analytic::ImpactRow& row) { return numbers_of(DiscreteRow{row, 0}, true); }
MotionNumbers motion_errors(const analytic::space::ImpactRow& row) { return numbers_of(SpaceRow{row}, true); }
MotionNumbers motion_errors(const numeric::ImpactRecord& row) { return numbers_of(ContinuousRow{row}, true); }

namespace {

template <class Impacts>
std::vector<MotionNumbers> rows_of(const Impacts& impacts) {
  std::vector<MotionNumbers> rows;
  for (const auto& impact : impacts) rows.push_back(motion_numbers(impact));
  return rows;
}

}  // namespace

std::vector<MotionNumbers> motion_rows(const analytic::Sequence& sequence) { return rows_of(sequence.rows); }
std::vector<MotionNumbers> motion_rows(const analytic::space::Sequence& sequence) { return rows_of(sequence.rows); }
std::vector<MotionNumbers> motion_rows(const numeric::Simulation& run) { return rows_of(run.impacts); }

MotionNumbers motion_sizes(const numeric::Simulation& run, std::size_t count, const numeric::Body& body) {
  double speed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const numeric::ImpactNumbers& n = run.impacts[i].value;
    const double tips = n.angular_velocity_after.norm() * body.radius();
    speed = std::max({speed, n.velocity_after.norm(), n.approach_speed, tips});
  }
  const double time = std::max(run.impacts[count - 1].value.start, body.radius() / speed);
  return sizes_of(time, speed, body.radius(), body.mass());
}

MotionNumbers motion_sizes(const analytic::Sequence& sequence, const analytic::PlanarBody& body) {
  double speed = 0;
  for (const analytic::ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      speed = std::max({speed, std::hypot(v.normal, v.tangential), std::fabs(v.angular) * body.reach()});
    }
  }
  const double time = std::max(sequence.rows.back().start, body.reach() / speed);
  return sizes_of(time, speed, body.reach(), body.mass);
}

MotionNumbers comparison_scales(const analytic::Sequence& sequence, const analytic::PlanarBody& body) {
  double speed = 0, time = 0;
  for (const analytic::ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      speed = std::max({speed, std::fabs(v.normal), std::fabs(v.tangential), std::fabs(v.angular) * body.reach()});
    }
    time = std::max(time, row.start);
  }
  return scales_of(time, speed, body.reach(), body.mass);
}

MotionNumbers comparison_scales(const analytic::space::Sequence& sequence, const analytic::space::Body& body) {
  double speed = 0, time = 0;
  const double reach = body.reach();
  for (const analytic::space::ImpactRow& row : sequence.rows) {
    speed = std::max({speed, row.before.velocity.norm(), row.impact.velocity_after.norm(),
                      row.before.angular_velocity.norm() * reach, row.impact.angular_velocity_after.norm() * reach});
    time = std::max(time, row.start);
  }
  return scales_of(time, speed, reach, body.mass);
}

double row_distance(const MotionNumbers& row, const MotionNumbers& other, const MotionNumbers& sizes) {
  double worst = 0;
  for (std::size_t i = 0; i < motion_number_count; ++i) {
    const double off = std::fabs(row[i] - other[i]) / sizes[i];
    if (!(off <= worst)) worst = std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
  }
  return worst;
}

double distance(const std::vector<MotionNumbers>& rows, const std::vector<MotionNumbers>& truth,
                const MotionNumbers& sizes) {
  if (rows.size() < truth.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) worst = std::max(worst, row_distance(rows[i], truth[i], sizes));
  return worst;
}

}  // namespace clatter::validation::inline record
