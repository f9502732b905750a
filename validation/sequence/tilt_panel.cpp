// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sequence/tilt_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "analytic/space/tilted_outcomes.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using Style = FigureCurve::Style;

constexpr std::size_t most_classes = 7;
constexpr const char* class_colours[most_classes] = {blue, red, green, pink, palette::ochre, palette::sky, "#8c564b"};
constexpr const char* grey = "#bbbbbb";
// Radii of the ring, and of the corners drawn inside it.
constexpr double inner = 0.62, corners_at = 0.42;
constexpr double aspect = 3.4;  // of a panel of three, so that a ring is round

/// Outcomes of one colour.
struct OutcomeClass {
  std::string legend, colour;
  std::vector<space::TiltSector> sectors;
  double share = 0;

  void add(const space::TiltedOutcome& outcome) {
    sectors.insert(sectors.end(), outcome.sectors.begin(), outcome.sectors.end());
    share += outcome.share;
  }
};

std::string percent(double share) { return significant(100 * share, 2) + " %"; }

/// The largest shares one by one, the others together.
std::vector<OutcomeClass> classes_by_share(const std::vector<space::TiltedOutcome>& outcomes) {
  std::vector<OutcomeClass> classes;
  OutcomeClass others{.legend = "", .colour = grey, .sectors = {}};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const space::GroupImpact& impact = outcomes[i].impact;
    if (i >= most_classes) {
      others.add(outcomes[i]);
      continue;
    }
    classes.push_back({.legend = fmt::format("{}: Vₙ {} m/s, |Ω| {} rad/s", percent(outcomes[i].share),
                                             significant(impact.velocity_after.z(), 3),
                                             significant(impact.angular_velocity_after.norm(), 3)),
                       .colour = class_colours[i],
                       .sectors = {}});
    classes.back().add(outcomes[i]);
  }
  others.legend = fmt::format("{}: {} further outcomes", percent(others.share),
                              outcomes.size() - std::min(outcomes.size(), most_classes));
  if (!others.sectors.empty()) classes.push_back(std::move(others));
  return classes;
}

/// By equal parts of the range of rebound speeds.
std::vector<OutcomeClass> classes_by_speed(const std::vector<space::TiltedOutcome>& outcomes) {
  const auto speed = [](const space::TiltedOutcome& outcome) { return outcome.impact.velocity_after.z(); };
  const auto [slow, fast] = std::ranges::minmax(outcomes, {}, speed);
  const double low = speed(slow), part = (speed(fast) - low) / most_classes;
  std::vector<OutcomeClass> classes(most_classes);
  for (const space::TiltedOutcome& outcome : outcomes) {
    const double place = part > 0 ? (speed(outcome) - low) / part : 0;
    classes[std::min(static_cast<std::size_t>(place), most_classes - 1)].add(outcome);
  }
  for (std::size_t i = 0; i < most_classes; ++i) {
    const double from = low + static_cast<double>(i) * part;
    classes[i].legend = fmt::format("{}: Vₙ {} to {} m/s", percent(classes[i].share), significant(from, 3),
                                    significant(from + part, 3));
    classes[i].colour = class_colours[i];
  }
  std::erase_if(classes, [](const OutcomeClass& one) { return one.sectors.empty(); });
  return classes;
}

/// Rows of class, x, y; a row without y ends an outline.
class RingRows {
 public:
  void add_sector(double kind, const space::TiltSector& sector) {
    const int parts = 2 + static_cast<int>(sector.width * 30);  // chords of two degrees
    for (const double radius : {1.0, inner}) {
      for (int i = 0; i <= parts; ++i) {
        const int step = radius == 1 ? i : parts - i;
        add_point(kind, radius, sector.from + sector.width * step / parts);
      }
    }
    rows.push_back({kind, 0, no_number});
  }
  void add_point(double kind, double radius, double direction) {
    rows.push_back({kind, radius * std::cos(direction), radius * std::sin(direction)});
  }

  std::vector<std::vector<double>> rows;
};

/// The corners, or the rim, as seen from above, the furthest from the centre of mass at `corners_at`.
void add_corners(const space::ImpactRow& row, double kind, RingRows& ring) {
  const space::Corner& first = row.corners.front();
  if (first.radius > 0) {
    for (int i = 0; i <= 60; ++i) ring.add_point(kind, corners_at, std::numbers::pi * i / 30);
    return;
  }
  double reach = 0;
  for (const space::Corner& corner : row.corners) {
    reach = std::fmax(reach, (row.before.attitude * corner.place).head<2>().norm());
  }
  for (const space::Corner& corner : row.corners) {
    const space::Vector3 arm = row.before.attitude * corner.place;
    ring.add_point(kind, corners_at * arm.head<2>().norm() / reach, std::atan2(arm.y(), arm.x()));
  }
}

PicturePanel ring_panel(const space::ImpactRow& row, std::size_t number, const space::OutcomeSet& set) {
  const std::vector<OutcomeClass> classes =
      set.varies ? classes_by_speed(set.outcomes) : classes_by_share(set.outcomes);
  PicturePanel panel{
      .columns = {{"class", "1", "number of the class of outcomes"},
                  {"x", "1", "along x, to the right"},
                  {"y", "1", "along y, into the page"}},
      .rows = {},
      .plot = {.title = "",
               .x_label = fmt::format("impact {}: outcome over the direction in which the tilted body lies "
                                      "higher; x to the right, y upward, from above",
                                      number),
               .y_label = "small tilts",
               .curves = {},
               .x = {-1.25 * aspect, 1.25 * aspect},
               .y = {-1.25, 1.25},
               .equal_scales = true,
               .no_axes = true,
               .ring = true}};
  RingRows ring;
  const auto add_curve = [&](const std::string& legend, Style style, const std::string& colour) {
    const auto kind = static_cast<double>(panel.plot.curves.size());
    panel.plot.curves.push_back(
        {.x = "x", .y = "y", .legend = legend, .style = style, .where = {{"class", kind}}, .colour = colour});
    return kind;
  };
  for (const OutcomeClass& one : classes) {
    const double kind = add_curve(one.legend, Style::regions, one.colour);
    for (const space::TiltSector& sector : one.sectors) ring.add_sector(kind, sector);
  }
  const bool is_rim = row.corners.front().radius > 0;
  add_corners(row, add_curve(is_rim ? "rim" : "corners", is_rim ? Style::line : Style::marks, ink), ring);
  panel.rows = std::move(ring.rows);
  return panel;
}

}  // namespace

std::optional<PicturePanel> tilt_panel(const space::Drop& drop, std::span<const space::ImpactRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].group) continue;
    const space::OutcomeSet set = tilted_outcomes(drop.body, rows[i].before, rows[i].corners, drop.law);
    if (set.outcomes.size() > 1) return ring_panel(rows[i], i + 1, set);
  }
  return std::nullopt;
}

}  // namespace clatter::validation
