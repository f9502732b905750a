#include "validation/cli/sequence_report.hpp"

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

namespace clatter::validation {
namespace {

using analytic::ImpactRow;
using analytic::Sequence;

const char* const no_history = "the discrete model's impacts are instantaneous: no peak force or time";

Value tail_fields(const analytic::Tail& tail) {
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
  Scales scales{};
  const auto grow = [&](Scale scale, double number) {
    double& size = scales[static_cast<std::size_t>(scale)];
    size = std::max(size, std::fabs(number));
  };
  grow(Scale::angle, 90);
  grow(Scale::ratio, 1);
  for (const ImpactRow& row : sequence.rows) {
    for (const analytic::PlanarVelocity& v : {row.before, row.impact.after}) {
      grow(Scale::speed, v.normal);
      grow(Scale::speed, v.tangential);
      grow(Scale::rate, v.angular);
    }
    grow(Scale::time, row.start);
    grow(Scale::impulse, row.impact.normal_impulse);
    grow(Scale::impulse, row.impact.tangential_impulse);
    grow(Scale::energy, row.energy_before);
  }
  return scales;
}

bool with_friction(const Scene& scene) { return impact_law(scene).friction != analytic::FrictionKind::none; }

bool loses_energy(const Sequence& sequence) {
  return std::any_of(sequence.rows.begin(), sequence.rows.end(), [&](const ImpactRow& row) {
    return std::fabs(row.impact.energy_loss) > 1e-14 * sequence.rows[0].energy_before;
  });
}

/// What was asked against what rounding leaves.
std::string accuracy_words(const Scene& scene, const Sequence& sequence) {
  const double error = largest_error(sequence);
  if (!std::isfinite(error)) return "";
  return fmt::format("asked {} digits, achieved {:.1f}: what rounding leaves", scene.options.digits,
                     std::max(-std::log10(error), 0.0));
}

std::string trust_words(const std::vector<ImpactRow>& rows) {
  const auto first =
      std::find_if(rows.begin(), rows.end(), [](const ImpactRow& row) { return !row.error.predictable; });
  if (first == rows.end()) return "";
  const auto known = first - rows.begin();
  return known == 0 ? "?: not to be trusted: how errors grow is not known"
                    : fmt::format("?: trust ends with impact {}: after it rounding decides what happens", known);
}

std::string with_error(const Estimated& number, const Shown& shown) {
  const std::string text = known_text(number, shown);
  return number.is_known() && number.error > 0 ? text + " ± " + significant(number.error, 2) : text;
}

std::string tail_words(const Scene& scene, const analytic::Tail& tail) {
  const Estimated end{tail.end_time, tail.end_time_error};
  return fmt::format("…: the last row sums up all further impacts; they end at {} s, {}",
                     with_error(end, {.digits = scene.options.digits + 3}),
                     tail.closed_form ? "in closed form" : "by extrapolation");
}

std::string near_miss_words(const Scene& scene, const Sequence& sequence) {
  const analytic::NearMiss& miss = sequence.near_miss;
  if (sequence.outcome != analytic::Outcome::no_further_impact || !std::isfinite(miss.clearance)) return "";
  const analytic::RowErrors& last = sequence.rows.back().error;
  const Estimated clearance{miss.clearance, last.predictable ? miss.margin : last.start};
  return fmt::format("closest approach after the last impact: {} m above the ground",
                     known_text(clearance, {.digits = std::min(scene.options.digits, 6)}));
}

std::vector<std::string> closing_notes(const Scene& scene, const Sequence& sequence) {
  std::vector<std::string> notes{
      sequence.tail ? tail_words(scene, *sequence.tail) : "",
      trust_words(sequence.rows),
      fmt::format("Sum of normal impulses: {} N·s",
                  known_text(totals(sequence).normal_impulse, {.digits = scene.options.digits})),
      accuracy_words(scene, sequence),
      fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message),
      near_miss_words(scene, sequence)};
  std::erase(notes, "");
  return notes;
}

void add_results(const Scene& scene, const Sequence& sequence, Value& fields) {
  if (sequence.tail) fields["tail"] = tail_fields(*sequence.tail);
  fields["outcome"] = outcome_name(sequence.outcome);
  fields["message"] = sequence.message + "; " + no_history;
  if (!sequence.warnings.empty()) fields["warnings"] = sequence.warnings;
  const analytic::NearMiss& miss = sequence.near_miss;
  if (sequence.outcome == analytic::Outcome::no_further_impact) {
    fields["near_miss"] =
        Value::Fields{{"clearance", miss.clearance}, {"margin", miss.margin}, {"within_margin", miss.within_margin()}};
  }
  fields["accuracy"] =
      Value::Fields{{"asked", std::pow(10.0, -scene.options.digits)}, {"achieved", largest_error(sequence)}};
  add_totals(totals(sequence), fields);
  fields["shortfall"] = text_or_nothing(shortfall(scene, sequence));
  fields["cost"] = Value::Fields{{"force_evaluations", 0}, {"root_evaluations", sequence.root_evaluations}};
}

}  // namespace

std::vector<Column> sequence_columns(bool friction, bool loses) {
  std::vector<std::string> shown{
      "n", "end", "start", "contact_angle_deg", "impulse_normal", "velocity_after_z", "angular_velocity_after_y"};
  if (friction) shown.insert(shown.end(), {"impulse_tangential", "mode"});
  else if (loses) shown.emplace_back("energy_loss");
  return impact_columns<DiscreteRow>(shown);
}

Report sequence_report(const Scene& scene, const Sequence& sequence) {
  Report report = begun_report("sequence", "impact sequence, discrete model");
  report.head = scene_head(scene, Model::discrete);
  report.notes = closing_notes(scene, sequence);
  report.remarks = {totals_line(totals(sequence))};
  report.grid.columns = sequence_columns(with_friction(scene), loses_energy(sequence));
  const ImpactDigits digits{.digits = scene.options.digits, .scales = scales_of(sequence)};
  int n = 0;
  for (const ImpactRow& row : sequence.rows) {
    report.grid.rows.push_back(impact_row(DiscreteRow{row, ++n, scene.angle_deg}, digits));
    if (!row.error.predictable) report.grid.rows.back()[0].shown = fmt::format("{}?", n);
  }
  report.fields["model"] = "discrete";
  report.fields["scene"] = scene_value(scene, Model::discrete);
  report.fields["body"] = body_value(scene, Model::discrete);
  report.fields["impacts"] = row_objects(report.grid);
  add_results(scene, sequence, report.fields);
  if (sequence.tail) {
    report.grid.rows.push_back(tail_row(*sequence.tail, digits));
    report.grid.rows.back()[0].shown = "…";
  }
  fit_columns(report, scene.options.digits, {5, 2});
  return report;
}

}  // namespace clatter::validation
