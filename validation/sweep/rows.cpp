#include "validation/sweep/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

/// Appends cells, each after a comma.
class Cells {
 public:
  explicit Cells(std::string& out) : out_(out) {}

  void add(double value) {
    out_ += ',';
    append_number(out_, value);
  }
  void add(int value) { out_ += ',' + std::to_string(value); }
  void add(bool value) { add(std::string_view(value ? "true" : "false")); }
  void add(std::nullptr_t) { out_ += ','; }
  void add(const EntryVector& value) {
    for (const double part : value) add(part);
  }
  void add(std::string_view text) {
    out_ += ',';
    out_ += text;
  }
  void add(const char* text) { add(std::string_view(text)); }
  void add_empty(std::size_t count) { out_.append(count, ','); }

  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }

 private:
  std::string& out_;
};

/// Takes entries of an impact for their names.
struct ColumnNames {
  std::string& out;
  void operator()(const char* name, const EntryVector&) const {
    for (const char axis : {'x', 'y', 'z'}) out += fmt::format(",{}_{}", name, axis);
  }
  template <class Value>
  void operator()(const char* name, const Value&) const {
    out += fmt::format(",{}", name);
  }
};

std::string result_names(Model model, RowKind rows) {
  if (rows == RowKind::scene) {
    return model == Model::discrete
               ? ",impacts,outcome,total_normal_impulse,energy_loss,last_start"
               : ",impacts,outcome,total_normal_impulse,first_peak_force,largest_peak_force,energy_loss,last_start";
  }
  std::string names;
  if (model == Model::discrete) {
    for_each_entry(analytic::ImpactRow{}, 1, 0, ColumnNames{names});
    names += ",amplification";
  } else {
    for_each_entry(numeric::ImpactRecord{}, 1, ColumnNames{names});
  }
  return names + ",outcome";
}

void append_empty_row(std::string& out, const std::string& prefix, RowKind rows, const std::string& names,
                      std::string_view impacts, const char* outcome) {
  const auto columns = static_cast<std::size_t>(std::count(names.begin(), names.end(), ','));
  out += prefix;
  Cells cells(out);
  if (rows == RowKind::scene) cells.add_all(impacts, outcome);
  cells.add_empty(rows == RowKind::scene ? columns - 2 : columns - 1);
  if (rows == RowKind::impact) cells.add(outcome);
  out += '\n';
}

/// The remaining impacts, as `clatter sequence` sums them up.
void append_tail(std::string& out, const std::string& prefix, const analytic::Tail& tail, const char* outcome) {
  out += prefix;
  Cells cells(out);
  for_each_entry(analytic::ImpactRow{}, 1, 0, [&](std::string_view name, const auto& value) {
    if (name == "n")
      cells.add("tail");
    else if (name == "start")
      cells.add(tail.end_time);
    else if (name == "end")
      cells.add(analytic::PlanarBody::vertex_set_name(tail.vertices));
    else if (name == "impulse_normal")
      cells.add(tail.normal_impulse);
    else if (name == "impulse_tangential")
      cells.add(tail.tangential_impulse);
    else
      cells.add_empty(std::is_same_v<decltype(value), const EntryVector&> ? 3 : 1);
  });
  cells.add_all(nullptr, outcome);
  out += '\n';
}

void append_scene_row(std::string& out, const std::string& prefix, const analytic::Sequence& sequence) {
  double loss = 0;
  for (const analytic::ImpactRow& row : sequence.rows) loss += row.impact.energy_loss;
  out += prefix;
  Cells(out).add_all(static_cast<int>(sequence.rows.size()), outcome_name(sequence.outcome),
                     sequence.total_normal_impulse, loss, sequence.rows.back().start);
  out += '\n';
}

void append_scene_row(std::string& out, const std::string& prefix, const numeric::Simulation& run) {
  double loss = 0, peak = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    loss += row.value.energy_loss;
    peak = std::max(peak, row.value.peak_force);
  }
  out += prefix;
  Cells(out).add_all(static_cast<int>(run.impacts.size()), outcome_name(run.outcome), run.total_normal_impulse(),
                     run.impacts.front().value.peak_force, peak, loss, run.impacts.back().value.start);
  out += '\n';
}

}  // namespace

std::string column_names(const SweepPlan& plan) {
  std::string names = "index";
  for (const SweepAxis& axis : plan.points.axes()) names += "," + axis.key;
  return names + result_names(plan.model, plan.rows);
}

std::string row_prefix(long long index, const std::vector<double>& values) {
  std::string prefix = std::to_string(index);
  Cells cells(prefix);
  for (const double value : values) cells.add(value);
  return prefix;
}

void append_rows(std::string& out, const std::string& prefix, RowKind rows, const analytic::Sequence& sequence,
                 double drop_deg) {
  if (rows == RowKind::scene) return append_scene_row(out, prefix, sequence);
  const char* const outcome = outcome_name(sequence.outcome);
  int n = 0;
  for (const analytic::ImpactRow& row : sequence.rows) {
    out += prefix;
    Cells cells(out);
    for_each_entry(row, ++n, drop_deg, [&](const char*, const auto& value) { cells.add(value); });
    cells.add_all(row.amplification, outcome);
    out += '\n';
  }
  if (sequence.tail) append_tail(out, prefix, *sequence.tail, outcome);
}

void append_rows(std::string& out, const std::string& prefix, RowKind rows, const numeric::Simulation& run) {
  const char* const outcome = outcome_name(run.outcome);
  if (run.impacts.empty()) {
    return append_empty_row(out, prefix, rows, result_names(Model::continuous, rows), "0", outcome);
  }
  if (rows == RowKind::scene) return append_scene_row(out, prefix, run);
  int n = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    out += prefix;
    Cells cells(out);
    for_each_entry(row, ++n, [&](const char*, const auto& value) { cells.add(value); });
    cells.add(outcome);
    out += '\n';
  }
}

void append_failure(std::string& out, const std::string& prefix, const SweepPlan& plan, const char* outcome) {
  append_empty_row(out, prefix, plan.rows, result_names(plan.model, plan.rows), "", outcome);
}

}  // namespace clatter::validation
