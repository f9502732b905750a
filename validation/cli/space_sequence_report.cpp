#include "validation/cli/space_sequence_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/number.hpp"
#include "validation/plan/shortfall.hpp"
#include "validation/record/impact_rows.hpp"
#include "validation/record/names.hpp"
#include "validation/record/totals.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/scene_value.hpp"
#include "validation/scene/space_scene.hpp"

namespace clatter::validation {
namespace {

using analytic::space::Sequence;
using Flown = analytic::space::ImpactRow;

const char* const no_history = "the discrete model's impacts are instantaneous: no peak force or time";

/// Sizes against which a number of the sequence counts as zero.
Scales scales_of(const Sequence& sequence) {
  Scales scales{};
  const auto grow = [&](Scale scale, double number) {
    double& size = scales[static_cast<std::size_t>(scale)];
    size = std::max(size, std::fabs(number));
  };
  grow(Scale::angle, 90);
  grow(Scale::ratio, 1);
  for (const Flown& row : sequence.rows) {
    const double speed = std::max(row.before.velocity.norm(), row.impact.velocity_after.norm());
    grow(Scale::speed, speed);
    // A body that does not turn has a size of rates, too: that of its speed about the corner.
    grow(Scale::rate, speed / row.corners.front().place.norm());
    grow(Scale::rate, std::max(row.before.angular_velocity.norm(), row.impact.angular_velocity_after.norm()));
    grow(Scale::time, row.start);
    grow(Scale::impulse, row.impact.impulse.norm());
    grow(Scale::energy, row.energy_before);
  }
  return scales;
}

std::string with_error(double value, double error, int digits) {
  const std::string text = known_text({value, error}, {.digits = digits});
  return std::isfinite(error) && error > 0 ? text + " ± " + significant(error, 2) : text;
}

std::string tail_words(const Scene& scene, const analytic::space::Tail& tail) {
  return fmt::format("…: infinitely many further impacts end at {} s, {}; the sum of their normal impulses is {} N·s",
                     with_error(tail.end_time, tail.end_time_error, scene.options.digits + 3),
                     tail.closed_form ? "in closed form" : "by extrapolation",
                     with_error(tail.normal_impulse, tail.normal_impulse_error, scene.options.digits));
}

std::string trust_words(const std::vector<Flown>& rows) {
  const auto first = std::find_if(rows.begin(), rows.end(), [](const Flown& row) { return !row.error.predictable; });
  if (first == rows.end()) return "";
  const auto known = first - rows.begin();
  return known == 0 ? "?: not to be trusted: how errors grow is not known"
                    : fmt::format("?: trust ends with impact {}: after it rounding decides what happens", known);
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
    std::string words =
        fmt::format("impact {}: {} corners at once, {}", n, row.corners.size(), order_words(*row.group));
    if (set.velocity_spread > 1e-6 * speed) {
      words += fmt::format("; small tilts give {} outcomes, {} m/s and {} rad/s apart", set.outcomes.size(),
                           significant(set.velocity_spread, 3), significant(set.angular_velocity_spread, 3));
    }
    notes.push_back(words);
  }
  return notes;
}

std::vector<std::string> closing_notes(const Scene& scene, const Sequence& sequence) {
  std::vector<std::string> notes = group_notes(sequence, impact_space_drop(scene));
  const double error = largest_error(sequence);
  for (const std::string& note :
       {sequence.tail ? tail_words(scene, *sequence.tail) : std::string(), trust_words(sequence.rows),
        fmt::format("Sum of normal impulses: {} N·s",
                    known_text(totals(sequence).normal_impulse, {.digits = scene.options.digits})),
        std::isfinite(error) ? fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves",
                                           scene.options.digits, std::max(-std::log10(error), 0.0))
                             : std::string(),
        fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message)}) {
    if (!note.empty()) notes.push_back(note);
  }
  return notes;
}

Value tail_fields(const analytic::space::Tail& tail) {
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

void add_results(const Scene& scene, const Sequence& sequence, Value& fields) {
  if (sequence.tail) fields["tail"] = tail_fields(*sequence.tail);
  fields["outcome"] = outcome_name(sequence.outcome);
  fields["message"] = sequence.message + "; " + no_history;
  if (!sequence.warnings.empty()) fields["warnings"] = sequence.warnings;
  if (sequence.outcome == analytic::Outcome::no_further_impact) {
    const analytic::NearMiss& miss = sequence.near_miss;
    fields["near_miss"] =
        Value::Fields{{"clearance", miss.clearance}, {"margin", miss.margin}, {"within_margin", miss.within_margin()}};
  }
  fields["accuracy"] =
      Value::Fields{{"asked", std::pow(10.0, -scene.options.digits)}, {"achieved", largest_error(sequence)}};
  add_totals(totals(sequence), fields);
  fields["shortfall"] = text_or_nothing(shortfall(scene, sequence));
  fields["cost"] = Value::Fields{{"force_evaluations", 0}, {"root_evaluations", sequence.evaluations}};
}

}  // namespace

std::vector<SpaceRow> space_rows(const Scene& scene, const Sequence& sequence) {
  const numeric::Vector3 centre = body_properties(scene, Model::discrete).centre;
  std::vector<SpaceRow> rows;
  for (const Flown& row : sequence.rows) {
    SpaceRow named{.row = row, .n = static_cast<int>(rows.size()) + 1};
    bool left = false, right = false;
    for (const analytic::space::Corner& corner : row.corners) {
      (corner.place.x() + centre.x() < 0 ? left : right) = true;
      named.corners += (named.corners.empty() ? "" : " ") + corner_name(scene, corner);
    }
    named.end = left && right ? "both" : left ? "a" : "b";
    const numeric::Vector3 place = row.corners.front().place + centre;
    named.place = {place.x(), place.y(), place.z()};
    rows.push_back(named);
  }
  return rows;
}

Report sequence_report(const Scene& scene, const Sequence& sequence) {
  Report report = begun_report("sequence", "impact sequence, discrete model in space");
  report.head = scene_head(scene, Model::discrete);
  report.notes = closing_notes(scene, sequence);
  report.remarks = {totals_line(totals(sequence))};
  std::vector<std::string> shown{"n",
                                 "corners",
                                 "start",
                                 "impulse_normal",
                                 "velocity_after_z",
                                 "angular_velocity_after_x",
                                 "angular_velocity_after_y",
                                 "angular_velocity_after_z"};
  if (impact_law(scene).friction != analytic::FrictionKind::none) shown.emplace_back("mode");
  report.grid.columns = impact_columns<SpaceRow>(shown);
  const ImpactDigits digits{.digits = scene.options.digits, .scales = scales_of(sequence)};
  for (const SpaceRow& row : space_rows(scene, sequence)) {
    report.grid.rows.push_back(impact_row(row, digits));
    if (!row.row.error.predictable) report.grid.rows.back()[0].shown = fmt::format("{}?", row.n);
  }
  report.fields["model"] = "discrete";
  report.fields["scene"] = scene_value(scene, Model::discrete);
  report.fields["body"] = body_value(scene, Model::discrete);
  report.fields["impacts"] = row_objects(report.grid);
  add_results(scene, sequence, report.fields);
  fit_columns(report, scene.options.digits, {3, 2});
  return report;
}

}  // namespace clatter::validation
