// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/motion_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/base/angle.hpp"

namespace clatter::validation {
namespace {

MotionNumbers sizes_of(double time, double speed, const BodySize& body) {
  const double impulse = body.mass * speed, turn = speed / body.reach;
  return {time, 90, impulse, impulse, impulse, speed, speed, speed, turn, turn, turn};
}

/// The largest speed of the centre of mass or the tips [m/s].
double largest_speed(std::span<const Impact> impacts, double reach) {
  double speed = 0;
  for (const Impact& impact : impacts) speed = std::max({speed, impact.largest_speed, impact.largest_rate * reach});
  return speed;
}

}  // namespace

MotionNumbers motion_numbers(const Numbers& n) {
  const auto &p = n.impulse, &v = n.velocity_after, &w = n.angular_velocity_after;
  return {n.start, n.contact_angle_deg, p[0], p[1], p[2], v[0], v[1], v[2], w[0], w[1], w[2]};
}

std::vector<MotionNumbers> motion_rows(const Run& run) {
  std::vector<MotionNumbers> rows;
  for (const Impact& impact : run.impacts) rows.push_back(motion_numbers(impact.value));
  return rows;
}

MotionNumbers motion_sizes(std::span<const Impact> impacts, const BodySize& body) {
  const double speed = largest_speed(impacts, body.reach);
  return sizes_of(std::max(impacts.back().value.start, body.reach / speed), speed, body);
}

MotionNumbers motion_sizes(const numeric::Simulation& run, std::size_t count, const numeric::Body& body) {
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < count; ++i) {
    impacts.push_back(impact_of(run.impacts[i]));
    const bool slid_to_rest = impacts[i].largest_speed == 0;  // from a start on the ground
    if (slid_to_rest) impacts[i].largest_speed = std::sqrt(2 * std::fabs(impacts[i].value.energy_loss) / body.mass());
  }
  return motion_sizes(impacts, {.reach = body.radius(), .mass = body.mass()});
}

MotionNumbers comparison_scales(std::span<const Impact> impacts, const BodySize& body) {
  const double speed = largest_speed(impacts, body.reach), time = impacts.back().value.start;
  MotionNumbers sizes = sizes_of(time == 0 ? body.reach / speed : time, speed, body);
  sizes[1] = analytic::degrees_per_radian;
  return sizes;
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

}  // namespace clatter::validation
