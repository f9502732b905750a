// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/sequence_report.hpp"

#include "validation/reports/sequence_parts.hpp"
#include "validation/reports/space_sequence_report.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation::inline reports {
namespace {

using analytic::ImpactRow;
using analytic::Sequence;

Value tail_fields(const std::optional<analytic::Tail>& some) {
  if (!some) return {};
  const analytic::Tail& tail = *some;
  return Value::Fields{{"end", analytic::PlanarBody::vertex_set_name(tail.vertices)},
                       {"end_time", tail.end_time},
                       {"end_time_error", tail.end_time_error},
                       {"impulse_normal", tail.normal_impulse},
                       {"impulse_normal_error", tail.normal_impulse_error},
                       {"impulse_tangential", tail.tangential_impulse},
                       {"impulse_tangential_error", tail.tangential_impulse_error},
                       {"closed_form", tail.closed_form},
                       {"velocity_after", std::vector<double>{tail.after.tangential, 0.0, tail.after.normal}},
                       {"angular_velocity_after", std::vector<double>{0.0, tail.after.angular, 0.0}}};
}

/// Sizes against which a number of the sequence counts as zero.
Scales scales_of(const Sequence& sequence) {
  Scales scales = begun_scales();
  for (const ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      grow(scales, Scale::speed, v.normal);
      grow(scales, Scale::speed, v.tangential);
      grow(scales, Scale::rate, v.angular);
    }
    grow(scales, Scale::time, row.start);
    grow(scales, Scale::impulse, row.impact.normal_impulse);
    grow(scales, Scale::impulse, row.impact.tangential_impulse);
    grow(scales, Scale::energy, row.energy_before);
  }
  return scales;
}

bool loses_energy(const Sequence& sequence) {
  return std::any_of(sequence.rows.begin(), sequence.rows.end(), [&](const ImpactRow& row) {
    return std::fabs(row.impact.energy_loss) > 1e-14 * sequence.rows[0].energy_before;
  });
}

std::string tail_words(const Scene& scene, const analytic::Tail& tail) {
  const Estimated end{tail.end_time, tail.end_time_error};
  return fmt::format("…: the last row sums up all further impacts; they end at {} s, {}",
                     with_error(end, {.digits = scene.accuracy.digits + 3}),
                     tail.closed_form ? "in closed form" : "by extrapolation");
}

std::string near_miss_words(const Scene& scene, const Sequence& sequence) {
  const analytic::NearMiss& miss = sequence.near_miss;
  if (sequence.outcome != analytic::Outcome::no_further_impact || !std::isfinite(miss.clearance)) return "";
  const analytic::RowErrors& last = sequence.rows.back().error;
  const Estimated clearance{miss.clearance, last.predictable ? miss.margin : last.start};
  return fmt::format("closest approach after the last impact: {} m above the ground",
                     known_text(clearance, {.digits = std::min(scene.accuracy.digits, 6)}));
}

std::vector<std::string> closing_notes(const Scene& scene, const Sequence& sequence) {
  std::vector<std::string> notes = closing_words(scene, sequence);
  if (sequence.tail) notes.insert(notes.begin(), tail_words(scene, *sequence.tail));
  const std::string miss = near_miss_words(scene, sequence);
  if (!miss.empty()) notes.push_back(miss);
  return notes;
}

}  // namespace

std::vector<Column> sequence_columns(bool friction, bool loses) {
  std::vector<std::string> shown{
      "n", "end", "start", "contact_angle_deg", "impulse_normal", "velocity_after_z", "angular_velocity_after_y"};
  if (friction) shown.insert(shown.end(), {"impulse_tangential", "mode"});
  else if (loses) shown.emplace_back("energy_loss");
  return impact_columns<DiscreteRow>(shown);
}

Report sequence_report(const Scene& scene, const analytic::Drop& drop, const Sequence& sequence) {
  Report report = begun_sequence_report(scene, drop, "impact sequence, discrete model", totals(sequence));
  report.notes = closing_notes(scene, sequence);
  report.grid.columns = sequence_columns(drop.law.friction != analytic::FrictionKind::none, loses_energy(sequence));
  const ImpactDigits digits{.digits = scene.accuracy.digits, .scales = scales_of(sequence)};
  int n = 0;
  for (const ImpactRow& row : sequence.rows) add_impact_row(report, DiscreteRow{row, ++n, scene.angle_deg}, digits);
  report.fields["impacts"] = row_objects(report.grid);
  add_results(scene, sequence, tail_fields(sequence.tail), sequence.root_evaluations, report.fields);
  if (sequence.tail) {
    report.grid.rows.push_back(tail_row(*sequence.tail, digits));
    report.grid.rows.back()[0].shown = "…";
  }
  return report;
}

Report sequence_report(const Scene& scene, const DiscreteRun& run) {
  if (const Sequence* const planar = run.planar()) {
    return sequence_report(scene, std::get<analytic::Drop>(run.drop), *planar);
  }
  return sequence_report(scene, std::get<analytic::space::Drop>(run.drop),
                         std::get<analytic::space::Sequence>(run.sequence));
}

}  // namespace clatter::validation::inline reports
