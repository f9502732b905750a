// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/plot.hpp"
#include "validation/run/impact_rows.hpp"
#include "validation/run/run.hpp"
#include "validation/scene/names.hpp"
#include "validation/shock/damage_boundary.hpp"

namespace clatter::validation {
namespace {

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
    {"largest_indentation", "m", "greatest depth of a point of the body below the ground", &Totals::largest_depth,
     true},
    {"energy_loss", "J",
     "energy lost in all impacts; where these are infinitely many, or contacts last, what is lost to their end",
     &Totals::energy_loss},
    {"last_start", "s", "touch-down of the last impact, after that of the first", &Totals::last_start}};

/// A number of a probe, which has a column for its error.
struct ProbeNumber {
  std::string prefix;
  const char *unit, *meaning;  ///< of the point, whose name follows
  Estimated LargestShock::*value;
  int LargestShock::*impact;  ///< that has it; none: that of the number before
  bool continuous_only = false, of_part = false;
};
const std::vector<ProbeNumber>& probe_numbers() {
  const auto landing = [](std::string_view column) { return std::string(of_landing) + std::string(column); };
  static const std::vector<ProbeNumber> all{
      {std::string(peak_column), "g", "largest specific force, in units of 9.80665 m/s², of the point ",
       &LargestShock::peak_g, &LargestShock::peak_impact, true},
      {"width_", "s", "how long it stays above a tenth of that about it, of the point ", &LargestShock::width, nullptr,
       true},
      {std::string(shock_column), "m/s", "largest change of velocity over an impact of the point ",
       &LargestShock::delta_v, &LargestShock::impact},
      {landing(peak_column), "g",
       "largest specific force in the first landing, the impacts that begin while the body would go its own length at "
       "the speed of its first approach, of the point ",
       &LargestShock::landing_peak_g, &LargestShock::landing_peak_impact, true},
      {landing(shock_column), "m/s", "largest change of velocity over an impact of the first landing of the point ",
       &LargestShock::landing_delta_v, &LargestShock::landing_impact},
      {std::string(margin_column), "",
       "least margin, at most 1: it fails (of a part without a limit: 1 g over its response), over the impacts, of the "
       "part at the point ",
       &LargestShock::margin, &LargestShock::margin_impact, false, true},
      {landing(margin_column), "",
       "least margin, at most 1: it fails, over the first landing, of the part at the point ",
       &LargestShock::landing_margin, &LargestShock::landing_margin_impact, false, true}};
  return all;
}

template <class Use>
void for_each_probe_number(const RowLayout& layout, std::size_t probe, Use&& use) {
  for (const ProbeNumber& number : probe_numbers()) {
    const bool is_known = layout.model == Model::continuous || !number.continuous_only;
    if (is_known && (layout.part(probe) || !number.of_part)) use(number);
  }
}

constexpr const char* curve_column = "curve_depth";

/// Calls use(number) for each that the model has.
template <class Use>
void for_each_number(Model model, Use&& use) {
  for (const SceneNumber& number : scene_numbers) {
    if (model == Model::continuous || !number.continuous_only) use(number);
  }
}

Column outcome_column() { return word_column("outcome", "outcome", "how the scene ended"); }

/// The error of a column in a row of a scene, which in JSON, too, is a field of its own.
/// @param open  when it is empty
Column error_beside(const Column& number, const char* open = "") {
  const std::string name = number.name + "_error";
  return {.name = name,
          .heading = name,
          .unit = number.unit,
          .meaning = fmt::format("error of {}{}", number.name, open),
          .shown = false};
}

/// The model whose columns rows of impacts have.
RunModel columns_model(const RowLayout& layout) {
  if (layout.model == Model::continuous) return RunModel::continuous;
  return layout.in_space ? RunModel::space : RunModel::plane;
}

std::vector<Column> columns_of_impacts(const RowLayout& layout) {
  std::vector<Column> columns = impact_columns(columns_model(layout), shown_quantities(columns_model(layout)));
  for (const ImpactQuantity& quantity : impact_quantities()) {
    if (!std::holds_alternative<std::string>(quantity.kind())) continue;
    const auto column =
        std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == quantity.name; });
    if (column != columns.end()) column->words = true;
  }
  return columns;
}

bool has_error(const ImpactQuantity& quantity, const RowLayout& layout) {
  return quantity.known_to(columns_model(layout)) == Known::with_error;
}

std::vector<Column> scene_columns(const RowLayout& layout) {
  std::vector<Column> columns{
      {"impacts", "impacts", "",
       "impacts listed; of infinitely many in a finite time those until the sum of the others "
       "is known to run.digits or lost in rounding, some 1e-9 of the first: no physical number"},
      outcome_column()},
      errors;
  const auto add = [&](const Column& number, const char* open = "") {
    columns.push_back(number);
    errors.push_back(error_beside(number, open));
  };
  for_each_number(layout.model, [&](const SceneNumber& n) {
    add({n.name, n.name, n.unit, n.meaning},
        n.sum == &Totals::first_peak ? ""
                                     : "; empty where an impact cannot be predicted and nothing bounds what follows");
  });
  columns.push_back({"predictable", "predictable", "", "whether each impact can be predicted"});
  if (layout.rests) {
    for (const Column& column : rest_columns()) {
      columns.push_back(column);
      if (!column.unit.empty()) errors.push_back(error_beside(column));
    }
  }
  if (layout.has_curve) {
    add({curve_column, curve_column, "",
         "greatest depth in the first landing over that of the last point of the pad's curve: above 1 it bottoms out"});
  }
  for (const ImpactColumn& asked : layout.asked) {
    if (has_error(*asked.quantity, layout)) add(asked.column);
    else columns.push_back(asked.column);
  }
  for (std::size_t i = 0; i < layout.probes.size(); ++i) {
    const Probe& probe = layout.probes[i];
    for_each_probe_number(layout, i, [&](const ProbeNumber& number) {
      const std::string name = number.prefix + probe.name;
      add({name, name, number.unit, number.meaning + probe.name},
          number.prefix.starts_with(of_landing)
              ? ""
              : "; empty where an impact that may be harder cannot be predicted: the first landing's is known then");
      if (number.impact) columns.push_back({name + "_impact", name + "_impact", "", "number of that impact"});
    });
  }
  columns.insert(columns.end(), errors.begin(), errors.end());
  return columns;
}

std::vector<Column> result_columns(const RowLayout& layout) {
  const bool of_impacts = layout.rows == RowKind::impact;
  std::vector<Column> columns = of_impacts ? columns_of_impacts(layout) : scene_columns(layout);
  if (of_impacts) {
    columns.push_back(outcome_column());
    columns.push_back({scene_rows_column, scene_rows_column, "",
                       "rows of the scene: one for each impact, and one for the tail of infinitely many"});
  }
  if (layout.warns) {
    columns.push_back(word_column("warning", "warning",
                                  "what the law does that no contact does: it creates energy, or an impulse ratio "
                                  "pushes along the slip"));
  }
  columns.push_back(
      word_column("reason", "reason", "why it has no numbers, or fewer impacts or digits than asked for"));
  return columns;
}

/// The names of the quantities of impacts, each with its place; made once for all names that are read.
class AskedColumns {
 public:
  AskedColumns(const RowLayout& layout, int impacts) : impacts_(impacts), columns_(columns_of_impacts(layout)) {
    std::erase_if(columns_, [](const Column& column) { return column.object == "error_estimate"; });
    names_.push_back("hardest");
    for (const Column& column : columns_) names_.push_back(column.name);
    for (const Column& column : sweep_columns(layout)) present_.push_back(column.name);
    names_.insert(names_.end(), present_.begin(), present_.end());
  }

  void add(const std::string& name) {
    const std::string_view prefix = "hardest_";
    const std::size_t cut = name.rfind('_');
    long long number = 0;
    if (name == "hardest") return add(name, find("n"), 0);
    if (name.starts_with(prefix) && has(name.substr(prefix.size())))
      return add(name, find(name.substr(prefix.size())), 0);
    if (has(name)) {
      for (int n = 1; n <= impacts_; ++n) add(fmt::format("{}_{}", name, n), find(name), n);
      return;
    }
    if (cut != std::string::npos && has(name.substr(0, cut)) && read_integer(name.substr(cut + 1), number)) {
      if (number >= 1 && number <= impacts_) {
        return add(fmt::format("{}_{}", name.substr(0, cut), number), find(name.substr(0, cut)),
                   static_cast<int>(number));
      }
      throw BadInput(fmt::format("--columns {}: the impact must be from 1 to {}, as run.impacts says", name, impacts_));
    }
    if (std::ranges::find(present_, name) != present_.end()) {
      require_new(name);
      return named_.push_back(name);
    }
    throw BadInput(
        fmt::format("--columns '{}': must be hardest, hardest_QUANTITY, QUANTITY or QUANTITY_N with N from 1 "
                    "to {}, or a column that is there anyway{}",
                    name, impacts_, near(name)));
  }

  void put_into(RowLayout& layout) && {
    layout.asked = std::move(asked_);
    layout.named = std::move(named_);
  }

 private:
  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::any_of(columns_, [&](const Column& column) { return column.name == name; });
  }
  [[nodiscard]] const Column& find(const std::string& name) const {
    return *std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.name == name; });
  }

  /// "; did you mean impulse_normal_2?": all quantities that begin with a name that there is not, else one that is
  /// near, with its impact.
  [[nodiscard]] std::string near(const std::string& name) const {
    const std::string_view prefix = "hardest_";
    const std::size_t begin = name.starts_with(prefix) ? prefix.size() : 0, cut = name.rfind('_');
    long long number = 0;
    const bool is_numbered = cut != std::string::npos && cut > begin && read_integer(name.substr(cut + 1), number);
    const std::size_t end = is_numbered ? cut : name.size();
    const std::string quantity = name.substr(begin, end - begin);
    std::vector<std::string> longer;
    for (const Column& column : columns_)
      if (column.name.starts_with(quantity + "_"))
        longer.push_back(name.substr(0, begin) + column.name + name.substr(end));
    const std::optional<std::string> other = near_name(quantity, names_);
    if (longer.empty() && other) longer.push_back(name.substr(0, begin) + *other + name.substr(end));
    return longer.empty() ? "" : fmt::format("; did you mean {}?", fmt::join(longer, ", "));
  }

  void require_new(const std::string& name) const {
    const bool is_asked = std::ranges::any_of(asked_, [&](const auto& other) { return other.column.name == name; });
    if (is_asked || std::ranges::find(named_, name) != named_.end())
      throw BadInput(fmt::format("--columns {}: asked for twice", name));
  }

  /// @param impact 0: the hardest
  void add(const std::string& name, const Column& quantity, int impact) {
    require_new(name);
    if (asked_.size() == most_columns) throw BadInput(fmt::format("--columns: more than {} columns", most_columns));
    const std::string which =
        impact == 0 ? "the impact with the largest normal impulse" : fmt::format("impact {}", impact);
    ImpactColumn asked{.column = {name, name, quantity.unit, fmt::format("of {}: {}", which, quantity.meaning)},
                       .impact = impact};
    asked.column.words = quantity.words;
    const auto quantities = impact_quantities();
    asked.quantity = &*std::find_if(quantities.begin(), quantities.end(),
                                    [&](const ImpactQuantity& one) { return one.name == quantity.json_key(); });
    while (columns_[asked.part].json_key() != quantity.json_key()) ++asked.part;
    asked.part = static_cast<std::size_t>(&quantity - columns_.data()) - asked.part;
    asked_.push_back(asked);
  }

  static constexpr std::size_t most_columns = 10'000;

  int impacts_;
  std::vector<Column> columns_;
  std::vector<std::string> names_, present_, named_;
  std::vector<ImpactColumn> asked_;
};

/// Appends one cell: the part of an entry, nothing where there is none.
/// @param written  what a number becomes in the output
template <class Written>
void append_part_of(CellWriter& out, const Entry& entry, std::size_t part, Written&& written) {
  const auto append = [&](const auto& content) {
    using Content = std::decay_t<decltype(content)>;
    if constexpr (std::is_same_v<Content, EntryVector> || std::is_same_v<Content, EntryParameters>) {
      out.number(written(content[part]));
    } else if constexpr (std::is_same_v<Content, double>) out.number(written(content));
    else if constexpr (std::is_same_v<Content, bool>) out.truth(content);
    else if constexpr (std::is_same_v<Content, int>) out.whole(content);
    else if constexpr (std::is_same_v<Content, std::string>) out.word(content);
    else out.nothing();
  };
  std::visit(append, entry);
}

/// Takes the last cell and the comma before it off a row of CSV.  @returns it without its quotes
std::string_view take_last_cell(std::string_view& row) {
  const bool is_quoted = row.ends_with('"');
  std::size_t begin = is_quoted ? row.size() - 1 : row.rfind(',') + 1;
  while (is_quoted) {  // a quote within the text is doubled
    begin = row.rfind('"', begin - 1);
    if (begin == 0 || row[begin - 1] != '"') break;
    --begin;
  }
  std::string_view cell = row.substr(begin);
  row.remove_suffix(cell.size() + (begin > 0 ? 1 : 0));
  if (is_quoted) cell = cell.substr(1, cell.size() - 2);
  return cell;
}

/// Place of the impact with the largest normal impulse, the first of equal ones.
std::size_t hardest_of(const std::vector<Impact>& impacts) {
  const auto is_softer = [](const Impact& one, const Impact& other) {
    return one.value.impulse[2] < other.value.impulse[2];
  };
  return static_cast<std::size_t>(std::max_element(impacts.begin(), impacts.end(), is_softer) - impacts.begin());
}

/// Appends the cells of the columns asked for, of their values or of their errors; empty where the scene has no such
/// impact, or the impact no such quantity.
void append_asked(const RowForm& form, const Run& run, bool of_errors) {
  if (form.layout.asked.empty()) return;
  const std::size_t hardest = hardest_of(run.impacts);
  for (const ImpactColumn& asked : form.layout.asked) {
    const ImpactQuantity& quantity = *asked.quantity;
    if (of_errors && !has_error(quantity, form.layout)) continue;
    const std::size_t place = asked.impact == 0 ? hardest : static_cast<std::size_t>(asked.impact - 1);
    const Known known = quantity.known_to(run.model);
    const bool is_known = of_errors ? form.errors && known == Known::with_error
                                    : known >= Known::value_only &&
                                          (form.predictions || quantity.name != std::string_view("predictable"));
    if (place < run.impacts.size() && is_known) {
      const Impact& impact = run.impacts[place];
      if (of_errors) append_part_of(form.out, quantity.error(impact), asked.part, rounded_up);
      else append_part_of(form.out, quantity.value(impact), asked.part, [](double number) { return number; });
    } else {
      form.out.nothing();
    }
  }
}

/// Ends a row.
void append_ending(const RowForm& form) {
  if (form.layout.warns) form.out.word(form.warning);
  form.out.word(form.reason);
  form.out.end_row();
}

/// Ends a row of an impact.
void append_ending(const RowForm& form, const char* outcome, std::size_t scene_rows) {
  form.out.word(outcome);
  form.out.whole(static_cast<long long>(scene_rows));
  append_ending(form);
}

void append_empty_row(const RowForm& form, std::optional<int> impacts, const char* outcome) {
  const std::size_t columns = result_columns(form.layout).size() - (form.layout.warns ? 1 : 0);
  form.out.copy(form.prefix);
  if (form.layout.rows == RowKind::impact) {
    form.out.nothing(columns - 3);
    return append_ending(form, outcome, 1);
  }
  if (impacts) form.out.whole(*impacts);
  else form.out.nothing();
  form.out.word(outcome);
  form.out.nothing(columns - 3);
  append_ending(form);
}

/// The numbers of the probes, empty where nothing struck.
void append_shocks(const RowForm& form) {
  for (std::size_t i = 0; i < form.shocks.size(); ++i) {
    const LargestShock& shock = form.shocks[i];
    for_each_probe_number(form.layout, i, [&](const ProbeNumber& number) {
      const bool is_there = shock.impact > 0;
      form.out.number(is_there ? (shock.*number.value).value : no_number);
      if (number.impact == nullptr) return;
      if (is_there) form.out.whole(shock.*number.impact);
      else form.out.nothing();
    });
  }
}

/// Empty where the body does not come to lie, or on no face that has a name.
void append_rest(const RowForm& form) {
  if (!form.layout.rests) return;
  if (!form.rest) return form.out.nothing(3);
  form.out.word(form.rest->face);
  form.out.number(form.rest->time.value);
  if (form.errors) form.out.truth(form.rest->is_known);
  else form.out.nothing();
}

/// The one row of a scene with its sums.
void append_scene_row(const RowForm& form, const Run& run) {
  const Model model = form.layout.model;
  Totals sums = totals(run);
  if (form.energy_loss) sums.energy_loss = *form.energy_loss;
  form.out.copy(form.prefix);
  form.out.whole(sums.impacts);
  form.out.word(run.outcome);
  for_each_number(model, [&](const SceneNumber& n) { form.out.number((sums.*n.sum).value); });
  if (form.predictions) form.out.truth(sums.predictable);
  else form.out.nothing();
  append_rest(form);
  const auto append_error = [&](double error) { form.out.error(form.errors ? error : unknown_error); };
  const Estimated depth = form.curve_depth.value_or(Estimated{no_number, unknown_error});
  if (form.layout.has_curve) form.out.number(depth.value);
  append_asked(form, run, false);
  append_shocks(form);
  for_each_number(model, [&](const SceneNumber& n) { append_error((sums.*n.sum).error); });
  if (form.layout.rests) append_error(form.rest ? form.rest->time.error : unknown_error);
  if (form.layout.has_curve) append_error(depth.error);
  append_asked(form, run, true);
  for (std::size_t i = 0; i < form.shocks.size(); ++i) {
    const LargestShock& shock = form.shocks[i];
    for_each_probe_number(form.layout, i, [&](const ProbeNumber& number) {
      append_error(shock.impact > 0 ? (shock.*number.value).error : unknown_error);
    });
  }
  append_ending(form);
}

}  // namespace

bool RowLayout::has(std::string_view quantity) const {
  return rows == RowKind::impact || std::any_of(asked.begin(), asked.end(), [&](const ImpactColumn& one) {
           return one.quantity->name == quantity;
         });
}

std::vector<FragilePart> RowLayout::parts() const {
  std::vector<FragilePart> all;
  for (const auto& part : part_at) {
    const auto is_it = [&](const FragilePart& other) { return part_text(other) == part_text(*part); };
    if (part && std::ranges::none_of(all, is_it)) all.push_back(*part);
  }
  return all;
}

std::size_t RowLayout::first_ranked() const {
  const auto found = std::ranges::find_if(part_at, [](const auto& part) { return part.has_value(); });
  return found == part_at.end() ? 0 : static_cast<std::size_t>(found - part_at.begin());
}

std::optional<std::size_t> probe_of(std::string_view column, const std::vector<Probe>& probes) {
  // By all of it: one name may be the end of another.
  const auto found = std::ranges::find_if(probes, [&](const Probe& probe) {
    return std::ranges::any_of(probe_numbers(),
                               [&](const ProbeNumber& number) { return column == number.prefix + probe.name; });
  });
  if (found == probes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - probes.begin());
}

std::string ranking_column(const RowLayout& layout, std::size_t probe, bool landing_alone) {
  const std::string_view column = layout.part(probe)                  ? margin_column
                                  : layout.model == Model::continuous ? peak_column
                                                                      : shock_column;
  return std::string(landing_alone ? of_landing : "") + std::string(column) + layout.probes[probe].name;
}

bool is_worst_least(std::string_view column) {
  if (column.starts_with(of_landing)) column.remove_prefix(of_landing.size());
  return column.starts_with(margin_column) && !column.ends_with("_impact") && !column.ends_with("_error");
}

std::vector<LargestShock> LargestShock::of(const std::vector<ShockRow>& rows, const Terms& terms) {
  std::vector<LargestShock> largest(terms.layout.probes.size());
  // An error is the largest of what the hardest one may be; a margin is hard where it is small.
  const auto take = [](const Estimated& number, int number_of, bool is_small_hard, Estimated& so_far, int& impact) {
    const bool is_first = impact == 0;
    const bool is_harder = is_first || (is_small_hard ? number.value < so_far.value : number.value > so_far.value);
    if (is_harder) impact = number_of;
    if (is_first) so_far = number;
    else if (is_small_hard) so_far = larger(so_far * -1, number * -1) * -1;
    else so_far = larger(so_far, number);
    return is_harder;
  };
  for (const ShockRow& row : rows) {
    LargestShock& so_far = largest[row.probe];
    const FragilePart* const part = terms.layout.part(row.probe);
    const Estimated delta_v{row.value.delta_v_size, row.error.delta_v_size},
        peak_g = Estimated{row.value.peak_size, row.error.peak_size} * (1 / standard_gravity),
        margin = part ? margin_of(row, *part, terms.has_peaks) : Estimated{};
    take(delta_v, row.impact, false, so_far.delta_v, so_far.impact);
    if (take(peak_g, row.impact, false, so_far.peak_g, so_far.peak_impact))
      so_far.width = {row.value.width, row.error.width};
    take(margin, row.impact, true, so_far.margin, so_far.margin_impact);
    if (!(row.start <= terms.landing_end)) continue;
    take(delta_v, row.impact, false, so_far.landing_delta_v, so_far.landing_impact);
    take(peak_g, row.impact, false, so_far.landing_peak_g, so_far.landing_peak_impact);
    take(margin, row.impact, true, so_far.landing_margin, so_far.landing_margin_impact);
  }
  return largest;
}

void read_impact_columns(const std::string& names, int impacts, RowLayout& layout) {
  AskedColumns asked(layout, impacts);
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    asked.add(names.substr(begin, end - begin));
    begin = end + 1;
  }
  std::move(asked).put_into(layout);
}

std::vector<Column> sweep_columns(const RowLayout& layout) {
  std::vector<Column> columns{{"index", "index", "", "number of the scene, from 0"}};
  for (const std::string& key : layout.swept)
    columns.push_back({key, key, unit_of(key), "swept key; clatter help keys explains it"});
  const std::vector<Column> results = result_columns(layout);
  columns.insert(columns.end(), results.begin(), results.end());
  return columns;
}

std::vector<std::string> truth_columns(const RowLayout& layout) {
  const auto is_truth = [](const ImpactQuantity& one) { return std::holds_alternative<bool>(one.kind()); };
  std::vector<std::string> names{"rest_known"};
  for (const ImpactQuantity& quantity : impact_quantities())
    if (is_truth(quantity)) names.emplace_back(quantity.name);
  for (const ImpactColumn& asked : layout.asked)
    if (is_truth(*asked.quantity)) names.push_back(asked.column.name);
  return names;
}

std::size_t column_place(const RowLayout& layout, std::string_view column) {
  const std::vector<Column> columns = sweep_columns(layout);
  const auto found = std::ranges::find(columns, column, &Column::name);
  if (found == columns.end()) throw std::invalid_argument(std::string(column) + ": no column of these rows");
  return static_cast<std::size_t>(found - columns.begin());
}

std::string_view csv_cell(std::string_view row, std::size_t place) {
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= row.size(); ++i) {
    if (i < row.size() && row[i] == '"') is_quoted = !is_quoted;
    if (i < row.size() && (row[i] != ',' || is_quoted)) continue;
    if (place-- == 0) return row.substr(begin, i - begin);
    begin = i + 1;
  }
  return {};
}

std::string row_prefix(long long index, const std::vector<double>& values, bool packed) {
  std::string prefix;
  CellWriter out(prefix, packed);
  out.whole(index);
  for (const double value : values) out.number(value);
  if (!packed) prefix.erase(0, 1);  // no comma before the first cell
  return prefix;
}

void append_rows(const RowForm& form, const Run& run) {
  if (run.impacts.empty()) return append_empty_row(form, 0, run.outcome);
  if (form.layout.rows == RowKind::scene) return append_scene_row(form, run);
  const auto append = [&](const Impact& impact) {
    form.out.copy(form.prefix);
    append_impact(form.out, impact,
                  {.model = run.model,
                   .columns = columns_model(form.layout),
                   .errors = form.errors,
                   .predictions = form.predictions});
    append_ending(form, run.outcome, run.impacts.size() + (run.tail ? 1 : 0));
  };
  for (const Impact& impact : run.impacts) append(impact);
  if (run.tail) append(run.tail->sum);
}

void append_failure(const RowForm& form, const char* outcome) { append_empty_row(form, {}, outcome); }

ShortfallCount::ShortfallCount(const RowLayout& layout, bool packed) : packed_(packed), warns_(layout.warns) {
  const std::vector<Column> columns = sweep_columns(layout);
  while (columns.at(outcome_).name != "outcome") ++outcome_;
  cells_.resize(columns.size());
}

void ShortfallCount::add(std::string_view rows) {
  for (PackedRows packed(rows); packed_ && packed.next(cells_);) {
    count(std::to_string(static_cast<long long>(cells_.front().number)),
          {.outcome = cells_[outcome_].text,
           .warning = warns_ ? cells_[cells_.size() - 2].text : std::string_view(),
           .reason = cells_.back().text});
  }
  while (!packed_ && !rows.empty()) {
    const std::size_t end = std::min(rows.find('\n'), rows.size());
    const std::string_view row = rows.substr(0, end);
    if (!row.empty() && row.front() >= '0' && row.front() <= '9') add_row(row);
    rows.remove_prefix(std::min(end + 1, rows.size()));
  }
}

void ShortfallCount::count(std::string_view index, const Words& row) {
  const auto& [outcome, warning, reason] = row;
  if (!warning.empty() && index != last_warned_) {
    last_warned_ = index;
    ++warned_;
  }
  if (outcome == outcome_name(analytic::Outcome::impact_limit) && index != last_cut_) {
    last_cut_ = index;
    ++cut_;
  }
  if (reason.empty() || index == last_) return;
  last_ = index;
  Shortfalls& kind = outcome == "refused" ? refused_ : outcome == "outside-model" ? outside_ : found_;
  kind.add(last_, std::string(kind.count() > 0 ? "as another" : reason));
}

ScenesTold ShortfallCount::told(long long all, const char* what) const {
  const auto words = [&](const Shortfalls& some, const char* are) {
    return some.count() == 0 ? "" : fmt::format("{} of {} {} are {}; {}", some.count(), all, what, are, some.first());
  };
  const std::string refused = words(refused_, "refused"), outside = words(outside_, "outside the model");
  return {.fell_short = found_.words(all, what),
          .set_aside = refused + (refused.empty() || outside.empty() ? "" : "\n") + outside};
}

void ScenesTold::say() const {
  for (const std::string& lines : {set_aside, fell_short}) {
    std::istringstream parts(lines);
    for (std::string line; std::getline(parts, line);) validation::say(line);
  }
}

void ShortfallCount::add_row(std::string_view row) {
  const std::string_view index = row.substr(0, row.find(','));
  const std::string_view outcome = csv_cell(row, outcome_);
  const std::string_view reason = take_last_cell(row), warning = warns_ ? take_last_cell(row) : std::string_view();
  count(index, {.outcome = outcome, .warning = warning, .reason = reason});
}

}  // namespace clatter::validation
