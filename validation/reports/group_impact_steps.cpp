// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of an impact of several corners at once in space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/output/number.hpp"
#include "validation/reports/space_derivation.hpp"

namespace clatter::validation::inline reports {
namespace {

namespace space = analytic::space;
using space::Vector3;

constexpr double degrees = 180 / std::numbers::pi;

std::string order_words(const ImpactInSpace& impact, const space::GroupImpact& group) {
  std::string words;
  constexpr std::size_t most = 8;
  for (std::size_t i = 0; i < std::min(group.order.size(), most); ++i) {
    words += (i > 0 ? ", then " : "") + impact.corner_names(group.order[i]);
  }
  return group.order.size() > most ? fmt::format("{}, …, {} strikes in all", words, group.order.size()) : words;
}

/// A mean height of the corners above the centre of mass, which is negative.
double depth_of(const space::ImpactRow& row) {
  double sum = 0;
  for (const space::Corner& corner : row.corners) sum -= (row.before.attitude * corner.place).z();
  return sum / static_cast<double>(row.corners.size());
}

void write_group(const ImpactInSpace& impact, StepWriter& writer) {
  const space::ImpactRow& row = impact.row();
  const space::GroupImpact& group = *row.group;
  std::vector<int> corners;
  for (const space::Corner& corner : row.corners) corners.push_back(corner.index);
  const bool is_rim = row.corners.front().radius > 0;
  const std::string who = is_rim ? "all points of the rim of " : "";
  const std::string how =
      group.is_whole ? "Pushes alone can make the body rebound as a whole, each point at e times its approach."
                     : "Pushes alone cannot make the body rebound as a whole; they strike one after the other, "
                       "the fastest first: " +
                           order_words(impact, group) + ".";
  writer.open("Corners at once", fmt::format("At once: {}{}.  {}", who, impact.corner_names(corners), how));
  for (const space::Corner& corner : row.corners) {
    const Vector3 arm = row.before.attitude * corner.place;
    writer.add({.name = "u",
                .formula = fmt::format("approach speed of {}{}", is_rim ? "the centre of the rim of " : "",
                                       impact.corner_names({corner.index})),
                .value = -(row.before.velocity + row.before.angular_velocity.cross(arm)).z(),
                .unit = "m/s",
                .size = row.approach_speed});
  }
  writer.add_vector("P", "", "impulse of all", group.impulse, "N·s");
  writer.add_vector("M", "", "moment of all about the centre of mass", group.moment, "N·m·s");
  const double depth = depth_of(row);
  const auto place = [&](const char* name, const char* formula, double value) {
    writer.add({.name = name, .formula = formula, .value = value, .unit = "m", .size = impact.drop.body.reach()});
  };
  place("d", "depth of the ground below the centre of mass", depth);
  place("x", "−(M_y + d P_x)/P_z", -(group.moment.y() + depth * group.impulse.x()) / group.impulse.z());
  place("y", "(M_x − d P_y)/P_z", (group.moment.x() - depth * group.impulse.y()) / group.impulse.z());
  writer.add_vector("V", "′", "velocity of the centre of mass after", group.velocity_after, "m/s");
  writer.add_vector("ω", "′", "angular velocity after", group.angular_velocity_after, "rad/s");
}

}  // namespace

void write_group_impact(const ImpactInSpace& impact, StepWriter& writer) {
  write_group(impact, writer);
  const space::ImpactRow& row = impact.row();
  const space::OutcomeSet set = tilted_outcomes(impact.drop.body, row.before, row.corners, impact.drop.law);
  const std::size_t count = set.outcomes.size();
  const std::string outcomes = set.varies   ? "another outcome; those of eight follow"
                               : count == 1 ? "the same outcome"
                                            : fmt::format("one of {} outcomes", count);
  writer.open("Small tilts", fmt::format("However small, a tilt makes the corners strike in some order.  Each "
                                         "direction gives {}.",
                                         outcomes));
  const double speed = std::max(row.before.velocity.norm(), row.approach_speed);
  writer.add({.name = "ΔV",
              .formula = "largest distance of two, that above included",
              .value = set.velocity_spread,
              .unit = "m/s",
              .size = speed});
  writer.add({.name = "Δω",
              .formula = "the same of angular velocities",
              .value = set.angular_velocity_spread,
              .unit = "rad/s",
              .size = speed / impact.drop.body.reach()});
  const std::size_t step = set.varies ? std::max<std::size_t>(count / 8, 1) : 1;
  for (std::size_t i = 0; i < count; i += step) {
    const space::TiltedOutcome& outcome = set.outcomes[i];
    writer.open(fmt::format("Outcome {} of {}", i + 1, count),
                fmt::format("The body is raised on the side of {}° from x: {}.",
                            significant(outcome.tilt_direction * degrees, 4), order_words(impact, outcome.impact)));
    writer.add_vector("V", "′", "velocity of the centre of mass after", outcome.impact.velocity_after, "m/s");
    writer.add_vector("ω", "′", "angular velocity after", outcome.impact.angular_velocity_after, "rad/s");
  }
}

}  // namespace clatter::validation::inline reports
