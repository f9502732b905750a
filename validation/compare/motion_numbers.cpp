#include "validation/compare/motion_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::validation {
namespace {

MotionNumbers sizes_of(double time, double speed, double radius, double mass) {
  const double impulse = mass * speed, turn = speed / radius;
  return {time, 90, impulse, impulse, impulse, speed, speed, speed, turn, turn, turn};
}

}  // namespace

MotionNumbers motion_numbers(const analytic::ImpactRow& row) {
  const analytic::PlanarVelocity& after = row.impact.after;
  return {row.start,
          row.contact_angle * analytic::degrees_per_radian,
          row.impact.tangential_impulse,
          0,
          row.impact.normal_impulse,
          after.tangential,
          0,
          after.normal,
          0,
          after.angular,
          0};
}

MotionNumbers motion_numbers(const numeric::ImpactNumbers& n) {
  return {n.start,
          n.contact_angle * analytic::degrees_per_radian,
          n.impulse.x(),
          n.impulse.y(),
          n.impulse.z(),
          n.velocity_after.x(),
          n.velocity_after.y(),
          n.velocity_after.z(),
          n.angular_velocity_after.x(),
          n.angular_velocity_after.y(),
          n.angular_velocity_after.z()};
}

std::vector<MotionNumbers> motion_rows(const analytic::Sequence& sequence) {
  std::vector<MotionNumbers> rows;
  for (const analytic::ImpactRow& row : sequence.rows) rows.push_back(motion_numbers(row));
  return rows;
}

std::vector<MotionNumbers> motion_rows(const numeric::Simulation& run) {
  std::vector<MotionNumbers> rows;
  for (const numeric::ImpactRecord& record : run.impacts) rows.push_back(motion_numbers(record.value));
  return rows;
}

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

Quantities in_plane(const MotionNumbers& n) { return {n[0], n[1], n[4], n[2], n[7], n[5], n[9]}; }

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

}  // namespace clatter::validation
