#include "validation/sweep/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "validation/output/impact_entries.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/output/totals.hpp"

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
  void add(const std::string& text) { add(std::string_view(text)); }
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

/// Takes the errors of an impact for their names.
struct ErrorNames {
  std::string& out;
  void operator()(const char* name, const EntryVector&) const {
    for (const char axis : {'x', 'y', 'z'}) out += fmt::format(",{}_{}_error", name, axis);
  }
  void operator()(const char* name, double) const { out += fmt::format(",{}_error", name); }
};

const char* const discrete_scene_names =
    ",impacts,outcome,total_normal_impulse,energy_loss,last_start,predictable,total_normal_impulse_error,"
    "energy_loss_error,last_start_error,reason";
const char* const continuous_scene_names =
    ",impacts,outcome,total_normal_impulse,first_peak_force,largest_peak_force,energy_loss,last_start,predictable,"
    "total_normal_impulse_error,first_peak_force_error,largest_peak_force_error,energy_loss_error,last_start_error,"
    "reason";

std::string result_names(Model model, RowKind rows) {
  if (rows == RowKind::scene) return model == Model::discrete ? discrete_scene_names : continuous_scene_names;
  std::string names;
  if (model == Model::discrete) {
    for_each_entry(analytic::ImpactRow{}, 1, 0, ColumnNames{names});
    names += ",amplification,predictable";
    for_each_error(analytic::RowErrors{}, ErrorNames{names});
  } else {
    for_each_entry(numeric::ImpactRecord{}, 1, ColumnNames{names});
    for_each_error(numeric::ImpactRecord{}, ErrorNames{names});
  }
  return names + ",outcome,reason";
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

void append_empty_row(const RowForm& form, const std::string& names, std::string_view impacts, const char* outcome) {
  const auto columns = static_cast<std::size_t>(std::count(names.begin(), names.end(), ','));
  form.out += form.prefix;
  Cells cells(form.out);
  if (form.rows == RowKind::scene) cells.add_all(impacts, outcome);
  cells.add_empty(columns - (form.rows == RowKind::scene ? 3 : 2));
  if (form.rows == RowKind::impact) cells.add(outcome);
  cells.add(quoted(form.reason));
  form.out += '\n';
}

/// The remaining impacts, as `clatter sequence` sums them up.
void append_tail(const RowForm& form, const analytic::Tail& tail, const char* outcome) {
  form.out += form.prefix;
  Cells cells(form.out);
  for_each_entry(analytic::ImpactRow{}, 1, 0, [&](std::string_view name, const auto& value) {
    if (name == "n") cells.add("tail");
    else if (name == "start") cells.add(tail.end_time);
    else if (name == "end") cells.add(analytic::PlanarBody::vertex_set_name(tail.vertices));
    else if (name == "impulse_normal") cells.add(tail.normal_impulse);
    else if (name == "impulse_tangential") cells.add(tail.tangential_impulse);
    else cells.add_empty(std::is_same_v<decltype(value), const EntryVector&> ? 3 : 1);
  });
  cells.add_empty(2);  // amplification, predictable
  for_each_error(analytic::RowErrors{}, [&](std::string_view name, const auto& value) {
    if (form.errors && name == "start") cells.add(tail.end_time_error);
    else if (form.errors && name == "impulse_normal") cells.add(tail.normal_impulse_error);
    else if (form.errors && name == "impulse_tangential") cells.add(tail.tangential_impulse_error);
    else cells.add_empty(std::is_same_v<decltype(value), const EntryVector&> ? 3 : 1);
  });
  cells.add_all(outcome, quoted(form.reason));
  form.out += '\n';
}

/// The one row of a scene with its sums.
void append_scene_row(const RowForm& form, const Totals& sums, const char* outcome, bool has_peaks) {
  const std::vector<Estimated> numbers =
      has_peaks
          ? std::vector{sums.normal_impulse, sums.first_peak, sums.largest_peak, sums.energy_loss, sums.last_start}
          : std::vector{sums.normal_impulse, sums.energy_loss, sums.last_start};
  form.out += form.prefix;
  Cells cells(form.out);
  cells.add_all(sums.impacts, outcome);
  for (const Estimated& number : numbers) cells.add(number.value);
  if (form.predictions) cells.add(sums.predictable);
  else cells.add(nullptr);
  if (form.errors)
    for (const Estimated& number : numbers) cells.add(number.error);
  else cells.add_empty(numbers.size());
  cells.add(quoted(form.reason));
  form.out += '\n';
}

void append_impact_row(const RowForm& form, const analytic::ImpactRow& row, int n, double drop_deg,
                       const char* outcome) {
  form.out += form.prefix;
  Cells cells(form.out);
  for_each_entry(row, n, drop_deg, [&](const char*, const auto& value) { cells.add(value); });
  cells.add(row.amplification);
  if (form.errors) cells.add(row.error.predictable);
  else cells.add(nullptr);
  for_each_error(row.error, [&](const char*, const auto& error) {
    if (form.errors) cells.add(error);
    else cells.add_empty(std::is_same_v<decltype(error), const EntryVector&> ? 3 : 1);
  });
  cells.add_all(outcome, quoted(form.reason));
  form.out += '\n';
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

void append_rows(const RowForm& form, const analytic::Sequence& sequence, double drop_deg) {
  const char* const outcome = outcome_name(sequence.outcome);
  if (form.rows == RowKind::scene) return append_scene_row(form, totals(sequence), outcome, false);
  int n = 0;
  for (const analytic::ImpactRow& row : sequence.rows) append_impact_row(form, row, ++n, drop_deg, outcome);
  if (sequence.tail) append_tail(form, *sequence.tail, outcome);
}

void append_rows(const RowForm& form, const numeric::Simulation& run) {
  const char* const outcome = outcome_name(run.outcome);
  if (run.impacts.empty()) return append_empty_row(form, result_names(Model::continuous, form.rows), "0", outcome);
  if (form.rows == RowKind::scene) return append_scene_row(form, totals(run), outcome, true);
  int n = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    form.out += form.prefix;
    Cells cells(form.out);
    for_each_entry(row, ++n, [&](const char*, const auto& value) { cells.add(value); });
    for_each_error(row, [&](const char*, const auto& error) { cells.add(error); });  // none where none was asked for
    cells.add_all(outcome, quoted(form.reason));
    form.out += '\n';
  }
}

void append_failure(const RowForm& form, Model model, const char* outcome) {
  append_empty_row(form, result_names(model, form.rows), "", outcome);
}

ShortfallCount::ShortfallCount(const std::string& column_names) {
  const std::size_t end = column_names.find(",outcome,");
  const auto before = column_names.begin() + static_cast<std::ptrdiff_t>(end + 1);
  outcome_ = static_cast<std::size_t>(std::count(column_names.begin(), before, ','));
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
  if (++scenes_ > 1) return;
  const bool is_quoted = row.back() == '"';
  const std::size_t begin = is_quoted ? row.find('"') : row.rfind(',');
  std::string_view reason = row.substr(begin + 1);
  if (is_quoted) reason.remove_suffix(1);
  first_ = fmt::format("{}: {}", index, reason);
}

}  // namespace clatter::validation
