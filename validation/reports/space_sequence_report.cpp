// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/space_sequence_report.hpp"

#include "validation/output/number.hpp"
#include "validation/reports/sequence_parts.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline reports {
namespace {

using analytic::space::Sequence;
using Flown = analytic::space::ImpactRow;

/// Sizes against which a number of the sequence counts as zero.
Scales scales_of(const Sequence& sequence) {
  Scales scales = begun_scales();
  for (const Flown& row : sequence.rows) {
    const double speed = std::max(row.before.velocity.norm(), row.impact.velocity_after.norm());
    grow(scales, Scale::speed, speed);
    // A body that does not turn has a size of rates, too: that of its speed about the corner.
    grow(scales, Scale::rate, speed / row.corners.front().place.norm());
    grow(scales, Scale::rate, std::max(row.before.angular_velocity.norm(), row.impact.angular_velocity_after.norm()));
    grow(scales, Scale::time, row.start);
    grow(scales, Scale::impulse, row.impact.impulse.norm());
    grow(scales, Scale::energy, row.energy_before);
  }
  return scales;
}

std::string tail_words(const Scene& scene, const analytic::space::Tail& tail) {
  return fmt::format("…: infinitely many further impacts end at {} s, {}; the sum of their normal impulses is {} N·s",
                     with_error({tail.end_time, tail.end_time_error}, {.digits = scene.accuracy.digits + 3}),
                     tail.closed_form ? "in closed form" : "by extrapolation",
                     with_error({tail.normal_impulse, tail.normal_impulse_error}, {.digits = scene.accuracy.digits}));
}

std::string order_words(const analytic::space::GroupImpact& group) {
  return group.is_whole ? "the body rebounds as a whole"
                        : fmt::format("they strike one after the other, {} strikes", group.order.size());
}

/// Rows in which several corners arrive together, and what a small tilt would make of them.
std::vector<std::string> group_notes(const Sequence& sequence, const analytic::space::Drop& drop) {
  std::vector<std::string> notes;
  int n = 0;
  for (const Flown& row : sequence.rows) {
    ++n;
    if (!row.group) continue;
    const analytic::space::OutcomeSet set = tilted_outcomes(drop.body, row.before, row.corners, drop.law);
    const double speed = std::max(row.before.velocity.norm(), row.approach_speed);
    std::string words = fmt::format("impact {}: {}, {}", n, landing_words(row.corners), order_words(*row.group));
    if (set.velocity_spread > 1e-6 * speed) words += "; " + tilt_words(set);
    notes.push_back(words);
  }
  return notes;
}

std::vector<std::string> closing_notes(const Scene& scene, const analytic::space::Drop& drop,
                                       const Sequence& sequence) {
  std::vector<std::string> notes = group_notes(sequence, drop);
  if (sequence.tail) notes.push_back(tail_words(scene, *sequence.tail));
  for (const std::string& words : closing_words(scene, sequence)) notes.push_back(words);
  return notes;
}

Value tail_fields(const std::optional<analytic::space::Tail>& some) {
  if (!some) return {};
  const analytic::space::Tail& tail = *some;
  const auto list = [](const analytic::space::Vector3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
  return Value::Fields{
      {"end_time", tail.end_time},
      {"end_time_error", tail.end_time_error},
      {"impulse_normal", tail.normal_impulse},
      {"impulse_normal_error", tail.normal_impulse_error},
      {"impulse", std::vector<double>{tail.tangential_impulse.x(), tail.tangential_impulse.y(), tail.normal_impulse}},
      {"closed_form", tail.closed_form},
      {"velocity_after", list(tail.velocity_after)},
      {"angular_velocity_after", list(tail.angular_velocity_after)}};
}

}  // namespace

Report sequence_report(const Scene& scene, const analytic::space::Drop& drop, const Sequence& sequence) {
  Report report = begun_sequence_report(scene, drop, "impact sequence, discrete model in space", totals(sequence));
  report.notes = closing_notes(scene, drop, sequence);
  std::vector<std::string> shown{"n",
                                 "corners",
                                 "start",
                                 "impulse_normal",
                                 "velocity_after_z",
                                 "angular_velocity_after_x",
                                 "angular_velocity_after_y",
                                 "angular_velocity_after_z"};
  if (drop.law.law.friction != analytic::FrictionKind::none) shown.emplace_back("mode");
  report.grid.columns = impact_columns<SpaceRow>(shown);
  const ImpactDigits digits{.digits = scene.accuracy.digits, .scales = scales_of(sequence)};
  const numeric::Vector3 centre = body_properties(scene, Model::discrete).centre;
  for (const SpaceRow& row : space_rows(scene, sequence, centre)) add_impact_row(report, row, digits);
  report.fields["impacts"] = row_objects(report.grid);
  add_results(scene, sequence, tail_fields(sequence.tail), sequence.evaluations, report.fields);
  return report;
}

}  // namespace clatter::validation::inline reports
