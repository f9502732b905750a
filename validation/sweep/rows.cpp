// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/rows.hpp"

#include <algorithm>
#include <string_view>

#include "validation/output/number.hpp"
#include "validation/record/impact_rows.hpp"
#include "validation/record/names.hpp"
#include "validation/record/totals.hpp"

namespace clatter::validation::inline sweep {
namespace {

void append_cell(std::string& out, std::string_view text) {
  out += ',';
  out += text;
}
void append_cell(std::string& out, double number) {
  out += ',';
  append_number(out, number);
}

/// A sum over the impacts of a scene, which has a column for its error.
struct SceneNumber {
  const char *name, *unit, *meaning;
  Estimated Totals::*sum;
  bool continuous_only = false;
};
constexpr SceneNumber scene_numbers[]{
    {"total_normal_impulse", "N·s", "sum of the normal impulses", &Totals::normal_impulse},
    {"first_peak_force", "N", "peak force of the first impact", &Totals::first_peak, true},
    {"largest_peak_force", "N", "largest peak force", &Totals::largest_peak, true},
    {"energy_loss", "J", "energy lost in all impacts listed", &Totals::energy_loss},
    {"last_start", "s", "touch-down of the last impact, after that of the first", &Totals::last_start}};

/// Calls use(number) for each that the model has.
template <class Use>
void for_each_number(Model model, Use&& use) {
  for (const SceneNumber& number : scene_numbers) {
    if (model == Model::continuous || !number.continuous_only) use(number);
  }
}

Column outcome_column() {
  return {.name = "outcome", .heading = "outcome", .unit = "", .meaning = "how the scene ended"};
}

std::vector<Column> scene_columns(Model model) {
  std::vector<Column> columns{{"impacts", "impacts", "", "impacts listed"}, outcome_column()};
  for_each_number(model, [&](const SceneNumber& n) { columns.push_back({n.name, n.name, n.unit, n.meaning}); });
  columns.push_back({"predictable", "predictable", "", "whether each impact can be predicted"});
  for_each_number(model, [&](const SceneNumber& n) {
    const std::string name = std::string(n.name) + "_error";
    columns.push_back(
        {.name = name, .heading = name, .unit = n.unit, .meaning = std::string("error of ") + n.name, .shown = false});
  });
  return columns;
}

const std::vector<std::string> shown_of_impacts{
    "n", "end", "start", "contact_angle_deg", "impulse_normal", "velocity_after_z", "angular_velocity_after_y"};

/// What decides on the columns.
struct Kind {
  Model model;
  RowKind rows;
  bool in_space;
};

std::vector<Column> result_columns(const Kind& kind) {
  const auto& [model, rows, in_space] = kind;
  std::vector<Column> columns = rows == RowKind::scene       ? scene_columns(model)
                                : model == Model::continuous ? impact_columns<ContinuousRow>(shown_of_impacts)
                                : in_space                   ? impact_columns<SpaceRow>(shown_of_impacts)
                                                             : impact_columns<DiscreteRow>(shown_of_impacts);
  if (rows == RowKind::impact) columns.push_back(outcome_column());
  columns.push_back(
      word_column("reason", "reason", "why it has no numbers, or fewer impacts or digits than asked for"));
  return columns;
}

/// Ends a row of an impact.
void append_ending(const RowForm& form, const char* outcome) {
  append_cell(form.out, outcome);
  append_cell(form.out, csv_text(form.reason));
  form.out += '\n';
}

void append_empty_row(const RowForm& form, Model model, std::string_view impacts, const char* outcome) {
  const std::size_t columns = result_columns({model, form.rows, form.in_space}).size();
  form.out += form.prefix;
  if (form.rows == RowKind::impact) {
    form.out.append(columns - 2, ',');
    return append_ending(form, outcome);
  }
  append_cell(form.out, impacts);
  append_cell(form.out, outcome);
  form.out.append(columns - 3, ',');
  append_cell(form.out, csv_text(form.reason));
  form.out += '\n';
}

/// The one row of a scene with its sums.
void append_scene_row(const RowForm& form, const Totals& sums, Model model, const char* outcome) {
  form.out += form.prefix;
  append_cell(form.out, std::to_string(sums.impacts));
  append_cell(form.out, outcome);
  for_each_number(model, [&](const SceneNumber& n) { append_cell(form.out, (sums.*n.sum).value); });
  append_cell(form.out, !form.predictions ? "" : sums.predictable ? "true" : "false");
  for_each_number(model, [&](const SceneNumber& n) {
    if (form.errors) append_cell(form.out, (sums.*n.sum).error);
    else form.out += ',';
  });
  append_cell(form.out, csv_text(form.reason));
  form.out += '\n';
}

}  // namespace

std::vector<Column> sweep_columns(const SweepPlan& plan) {
  std::vector<Column> columns{{"index", "index", "", "number of the scene, from 0"}};
  for (const SweepAxis& axis : plan.points.axes()) {
    columns.push_back({axis.key, axis.key, "", "swept key; clatter keys explains it"});
  }
  const std::vector<Column> results = result_columns({plan.model, plan.rows, plan.in_space});
  columns.insert(columns.end(), results.begin(), results.end());
  return columns;
}

std::string row_prefix(long long index, const std::vector<double>& values) {
  std::string prefix = std::to_string(index);
  for (const double value : values) append_cell(prefix, value);
  return prefix;
}

void append_rows(const RowForm& form, const analytic::Sequence& sequence, double drop_deg) {
  const char* const outcome = outcome_name(sequence.outcome);
  if (form.rows == RowKind::scene) return append_scene_row(form, totals(sequence), Model::discrete, outcome);
  int n = 0;
  for (const analytic::ImpactRow& row : sequence.rows) {
    form.out += form.prefix;
    const DiscreteRow impact{row, ++n, drop_deg};
    if (form.in_space) append_impact<SpaceRow>(form.out, impact, form.errors);
    else append_impact<DiscreteRow>(form.out, impact, form.errors);
    append_ending(form, outcome);
  }
  if (!sequence.tail) return;
  form.out += form.prefix;
  if (form.in_space) append_tail<SpaceRow>(form.out, *sequence.tail, form.errors);
  else append_tail<DiscreteRow>(form.out, *sequence.tail, form.errors);
  append_ending(form, outcome);
}

void append_rows(const RowForm& form, const analytic::space::Sequence& sequence, const std::vector<SpaceRow>& rows) {
  const char* const outcome = outcome_name(sequence.outcome);
  if (form.rows == RowKind::scene) return append_scene_row(form, totals(sequence), Model::discrete, outcome);
  for (const SpaceRow& row : rows) {
    form.out += form.prefix;
    append_impact<SpaceRow>(form.out, row, form.errors);
    append_ending(form, outcome);
  }
  if (!sequence.tail) return;
  form.out += form.prefix;
  append_tail<SpaceRow>(form.out, *sequence.tail, form.errors);
  append_ending(form, outcome);
}

void append_rows(const RowForm& form, const numeric::Simulation& run) {
  const char* const outcome = outcome_name(run.outcome);
  if (run.impacts.empty()) return append_empty_row(form, Model::continuous, "0", outcome);
  if (form.rows == RowKind::scene) return append_scene_row(form, totals(run), Model::continuous, outcome);
  int n = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    form.out += form.prefix;
    append_impact<ContinuousRow>(form.out, ContinuousRow{row, ++n}, true);  // empty where none were asked for
    append_ending(form, outcome);
  }
}

void append_failure(const RowForm& form, Model model, const char* outcome) {
  append_empty_row(form, model, "", outcome);
}

ShortfallCount::ShortfallCount(const SweepPlan& plan) {
  const std::vector<Column> columns = sweep_columns(plan);
  while (columns.at(outcome_).name != "outcome") ++outcome_;
}

void ShortfallCount::add(std::string_view rows) {
  while (!rows.empty()) {
    const std::size_t end = std::min(rows.find('\n'), rows.size());
    const std::string_view row = rows.substr(0, end);
    if (!row.empty() && row.front() >= '0' && row.front() <= '9') add_row(row);
    rows.remove_prefix(std::min(end + 1, rows.size()));
  }
}

void ShortfallCount::add_row(std::string_view row) {
  if (row.back() == ',') return;  // no reason
  const std::string_view index = row.substr(0, row.find(','));
  std::string_view rest = row;
  for (std::size_t i = 0; i < outcome_; ++i) rest.remove_prefix(rest.find(',') + 1);
  const std::string_view outcome = rest.substr(0, rest.find(','));
  if (outcome == "refused" || outcome == "outside-model" || index == last_) return;
  last_ = index;
  if (found_.count() > 0) return found_.add("", "falls short");
  const bool is_quoted = row.back() == '"';
  const std::size_t begin = is_quoted ? row.find('"') : row.rfind(',');
  std::string_view reason = row.substr(begin + 1);
  if (is_quoted) reason.remove_suffix(1);
  found_.add(std::string(index), std::string(reason));
}

}  // namespace clatter::validation::inline sweep
