// SPDX-License-Identifier: GPL-3.0-or-later
// What the reports of a sequence in the plane and of one in space have in common.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "validation/output/estimated.hpp"
#include "validation/record/impact_rows.hpp"
#include "validation/record/names.hpp"
#include "validation/record/totals.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation::inline reports {

/// A size against which numbers count as zero is at least that of this number.
void grow(Scales& scales, Scale scale, double number);
/// Sizes before any row: 90° and ratios of 1.
[[nodiscard]] Scales begun_scales();

/// "1.25000 ± 0.00012"
[[nodiscard]] std::string with_error(const Estimated& number, const Shown& shown);
/// Until which impact rows can be trusted; empty: all can.
[[nodiscard]] std::string trust_words(std::size_t known, std::size_t all);
/// What was asked against what rounding leaves; empty where nothing is known.
[[nodiscard]] std::string accuracy_words(int digits, double error);

/// Of the report: title, head, remarks and the JSON fields before the impacts.
[[nodiscard]] Report begun_sequence_report(const Scene& scene, const DiscreteDrop& drop, const std::string& what,
                                           const Totals& sums);

/// How far the sequence can be trusted, its sum, its accuracy and why it ended.
template <class Sequence>
std::vector<std::string> closing_words(const Scene& scene, const Sequence& sequence) {
  const auto is_lost = [](const auto& row) { return !row.error.predictable; };
  const auto lost = std::find_if(sequence.rows.begin(), sequence.rows.end(), is_lost);
  const int digits = scene.accuracy.digits;
  std::vector<std::string> words{
      trust_words(static_cast<std::size_t>(lost - sequence.rows.begin()), sequence.rows.size()),
      fmt::format("Sum of normal impulses: {} N·s", known_text(totals(sequence).normal_impulse, {.digits = digits})),
      accuracy_words(digits, largest_error(sequence)),
      fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message)};
  std::erase(words, "");
  return words;
}

/// The JSON fields behind the impacts.
/// @param tail  its fields, or nothing without one
/// @param evaluations  of heights or rotations
template <class Sequence>
void add_results(const Scene& scene, const Sequence& sequence, const Value& tail, long evaluations, Value& fields) {
  if (!tail.is_nothing()) fields["tail"] = tail;
  fields["outcome"] = outcome_name(sequence.outcome);
  fields["message"] = sequence.message + "; the discrete model's impacts are instantaneous: no peak force or time";
  if (!sequence.warnings.empty()) fields["warnings"] = sequence.warnings;
  if (sequence.outcome == analytic::Outcome::no_further_impact) {
    const analytic::NearMiss& miss = sequence.near_miss;
    fields["near_miss"] =
        Value::Fields{{"clearance", miss.clearance}, {"margin", miss.margin}, {"within_margin", miss.within_margin()}};
  }
  fields["accuracy"] =
      Value::Fields{{"asked", std::pow(10.0, -scene.accuracy.digits)}, {"achieved", largest_error(sequence)}};
  add_totals(totals(sequence), fields);
  fields["shortfall"] = text_or_nothing(shortfall(scene, sequence));
  fields["cost"] = Value::Fields{{"force_evaluations", 0}, {"root_evaluations", evaluations}};
}

/// The impact's row of the table, marked where it cannot be predicted.
template <class Named>
void add_impact_row(Report& report, const Named& named, const ImpactDigits& digits) {
  report.grid.rows.push_back(impact_row(named, digits));
  if (!named.row.error.predictable) report.grid.rows.back()[0].shown = fmt::format("{}?", named.n);
}

}  // namespace clatter::validation::inline reports
