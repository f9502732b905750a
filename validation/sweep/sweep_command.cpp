// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <regex>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "numeric/base/linear_algebra.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/output/palette.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/processor_time.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/names.hpp"
#include "validation/sweep/column_file.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_file.hpp"
#include "validation/sweep/sweep_plan.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

/// What a picture of a sweep shows.
struct SweepRowsView {
  std::size_t first_swept = 1, swept = 0;  ///< columns of the keys that were swept
  bool random = false;                     ///< values without order
  std::vector<std::string> quantities;     ///< columns to draw, a panel each
};

constexpr std::size_t most_curves = 8;
constexpr std::size_t most_marked_scenes = 60;  // of a curve whose points are marked

/// With blanks for underlines, behind which gnuplot lowers what follows.
std::string with_blanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string named(const Column& column) {
  return with_blanks(column.name) + (column.unit.empty() ? "" : fmt::format(" [{}]", column.unit));
}

std::vector<double> numbers_of(const Grid& grid, std::size_t column) {
  std::vector<double> numbers;
  for (const Row& row : grid.rows) {
    const double* const number = column < row.size() ? row[column].value.number() : nullptr;
    numbers.push_back(number ? *number : no_number);
  }
  return numbers;
}

std::size_t place_of(const Grid& grid, const std::string& name) {
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].name == name) return i;
  }
  throw BadInput(fmt::format("--plot: the rows have no column {}", name));
}

bool are_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == std::floor(v); });
}

/// Classes of equal width, the first from `low` on.
struct Classes {
  double low = 0, width = 1;
  std::size_t count = 1;
};

/// 40, but one about each whole number where these are fewer, and a single one for a single value.
Classes classes_of(const std::vector<double>& values) {
  constexpr double most = 40;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double range = *greatest - *least;
  if (are_whole(values) && range < most) return {*least - 0.5, 1, static_cast<std::size_t>(range) + 1};
  if (range > 0) return {*least, range / most, static_cast<std::size_t>(most)};
  const double width = std::fabs(*least) / most;
  return {*least - width / 2, width, 1};
}

PicturePanel histogram(const Column& column, std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  PicturePanel panel{
      .columns = {{"value", column.unit.empty() ? "1" : column.unit, column.name},
                  {"zero", "1", "no scene"},
                  {"scenes", "1", "scenes of this value"}},
      .plot = {.x_label = named(column),
               .y_label = "scenes",
               .curves = {{.x = "value", .y = "scenes", .style = FigureCurve::Style::area, .y_low = "zero"}},
               .y = {0, no_number}}};
  if (values.empty()) return panel;
  const Classes classes = classes_of(values);
  std::vector<double> counts(classes.count, 0);
  for (const double value : values)
    ++counts[std::min(static_cast<std::size_t>((value - classes.low) / classes.width), classes.count - 1)];
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double from = classes.low + static_cast<double>(k) * classes.width;
    panel.rows.push_back({from, 0, counts[k]});
    panel.rows.push_back({from + classes.width, 0, counts[k]});
  }
  return panel;
}

/// Whole numbers that are few, from one below the least to one above the greatest, get an axis without fractions.
void count_on_y(std::vector<double> values, FigurePlot& plot) {
  constexpr double most = 12;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty() || !are_whole(values)) return;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*greatest - *least > most) return;
  plot.y = {std::min(*least, std::max(0.0, *least - 1)), *greatest + 1};
  plot.whole_y = true;
}

/// The columns of the key along x and of that whose values have a curve each.
struct SweptAxes {
  std::size_t over, of;    ///< the same: one curve
  bool are_cells = false;  ///< both have many values
};

/// Each quantity over a swept key, a curve for each value of the other.
PicturePanel curves(const Grid& grid, const SweptAxes& keys, std::size_t quantity) {
  const bool has_many = keys.over != keys.of;
  const std::vector<double> x = numbers_of(grid, keys.over), y = numbers_of(grid, quantity);
  const std::vector<double> of = has_many ? numbers_of(grid, keys.of) : std::vector<double>(x.size(), 0);
  const Column& column = grid.columns[quantity];
  PicturePanel panel{.columns = {{"x", "1", named(grid.columns[keys.over])},
                                 {"y", column.unit.empty() ? "1" : column.unit, column.name},
                                 {"of", "1", named(grid.columns[keys.of])}},
                     .plot = {.y_label = named(column)}};
  for (std::size_t i = 0; i < x.size(); ++i) panel.rows.push_back({x[i], y[i], of[i]});
  count_on_y(y, panel.plot);
  for (const double value : std::set<double>(of.begin(), of.end())) {
    panel.plot.curves.push_back(
        {.x = "x",
         .y = "y",
         .legend = has_many ? axis_words(grid.columns[keys.of].name) + " = " + shortest(value) : "",
         .style = x.size() > most_marked_scenes ? FigureCurve::Style::line : FigureCurve::Style::line_points,
         .where = {{"of", value}}});
  }
  return panel;
}

/// Mollweide's equal-area map of a unit vector: the ellipse |x| <= 2√2, |y| <= √2, +x of the body in its middle, +z at
/// its top.
std::pair<double, double> mapped(const numeric::Vector3& direction) {
  const double latitude = std::asin(std::clamp(direction.z(), -1.0, 1.0)), pi = std::numbers::pi;
  // 2θ + sin 2θ = π sin φ, by halving: θ and φ have one sign, |θ| <= π/2.
  double low = -pi / 2, high = pi / 2;
  for (int i = 0; i < 54; ++i) {
    const double theta = (low + high) / 2;
    (2 * theta + std::sin(2 * theta) < pi * std::sin(latitude) ? low : high) = theta;
  }
  const double longitude = std::atan2(direction.y(), direction.x());
  return {2 * std::numbers::sqrt2 / pi * longitude * std::cos(low), std::numbers::sqrt2 * std::sin(low)};
}

/// With as many digits, three to six, as tell the two apart; whole numbers without a fraction.
std::string range_words(double low, double high) {
  if (are_whole({low, high})) return low == high ? shortest(low) : shortest(low) + " to " + shortest(high);
  int digits = 3;
  while (digits < 6 && significant(low, digits) == significant(high, digits)) ++digits;
  const std::string first = significant(low, digits), last = significant(high, digits);
  return first == last ? first : fmt::format("{} to {}", first, last);
}

/// Classes of as many values each, or one for each of few whole numbers.
struct ValueClasses {
  std::vector<double> known;  ///< all values, in order, or each of the few
  std::span<const char* const> colours;
  bool are_single = false;

  explicit ValueClasses(std::vector<double> values) : known(std::move(values)) {
    static constexpr const char* fifths[] = {"#c6dbef", "#6baed6", "#2171b5", "#fd8d3c", "#d7301f"};
    std::erase_if(known, [](double value) { return !std::isfinite(value); });
    std::sort(known.begin(), known.end());
    const std::set<double> each(known.begin(), known.end());
    colours = each.size() <= std::size(fifths) ? std::span<const char* const>(fifths) : palette::classes;
    are_single = are_whole(known) && each.size() <= colours.size();
    if (are_single) known.assign(each.begin(), each.end());
    else colours = fifths;
  }

  [[nodiscard]] std::size_t of(double value) const {
    const auto rank = static_cast<std::size_t>(std::lower_bound(known.begin(), known.end(), value) - known.begin());
    return are_single ? rank : colours.size() * rank / known.size();
  }
  [[nodiscard]] std::string words(std::size_t k) const {
    if (are_single) return shortest(known[k]);
    const auto at = [&](std::size_t part) {
      return known[std::min(part * known.size() / colours.size(), known.size() - 1)];
    };
    return range_words(at(k), at(k + 1));
  }
};

/// Points or regions for each class that has some, with the range of its values.
void add_classes(const ValueClasses& classes, FigureCurve::Style style, PicturePanel& panel) {
  for (std::size_t k = 0; k < classes.colours.size(); ++k) {
    const auto is_of_class = [&](const std::vector<double>& row) { return row[2] == static_cast<double>(k); };
    if (std::none_of(panel.rows.begin(), panel.rows.end(), is_of_class)) continue;
    panel.plot.curves.push_back({.x = "x",
                                 .y = "y",
                                 .legend = classes.words(k),
                                 .style = style,
                                 .where = {{"class", static_cast<double>(k)}},
                                 .colour = classes.colours[k]});
  }
}

/// Which direction of the body points down, coloured by a quantity in classes; the largest on top.
PicturePanel sphere(const Grid& grid, std::size_t attitude, std::size_t quantity) {
  const std::vector<double> values = numbers_of(grid, quantity);
  const ValueClasses classes(values);
  std::vector<double> q[4];
  for (std::size_t i = 0; i < 4; ++i) q[i] = numbers_of(grid, attitude + i);
  PicturePanel panel{.columns = {{"x", "1", "eastward on an equal-area map"},
                                 {"y", "1", "northward on an equal-area map"},
                                 {"class", "1", "class of its colour"}},
                     .plot = {.x_label = "direction of the body that points down: +x in the middle, +z at the top",
                              .y_label = "colour: " + named(grid.columns[quantity]),
                              .curves = {{.x = "x", .y = "y", .where = {{"class", -1}}, .colour = ink}},
                              .equal_scales = true,
                              .no_axes = true}};
  for (int i = 0; i <= 120; ++i) {
    const double turn = 2 * std::numbers::pi * i / 120;
    panel.rows.push_back({2 * std::numbers::sqrt2 * std::cos(turn), std::numbers::sqrt2 * std::sin(turn), -1});
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::Quaterniond attitude_of(q[0][i], q[1][i], q[2][i], q[3][i]);
    if (!std::isfinite(values[i]) || !std::isfinite(attitude_of.norm())) continue;
    const auto [x, y] = mapped(attitude_of.normalized().conjugate() * -numeric::Vector3::UnitZ());
    panel.rows.push_back({x, y, static_cast<double>(classes.of(values[i]))});
  }
  add_classes(classes, FigureCurve::Style::points, panel);
  return panel;
}

/// The middles between the values of a grid, and as far beyond its ends.
std::map<double, std::array<double, 2>> cell_sides(const std::vector<double>& numbers) {
  const std::set<double> each(numbers.begin(), numbers.end());
  const std::vector<double> values(each.begin(), each.end());
  std::map<double, std::array<double, 2>> sides;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double below = i > 0 ? values[i] - values[i - 1] : values[1] - values[0],
                 above = i + 1 < values.size() ? values[i + 1] - values[i] : below;
    sides[values[i]] = {values[i] - below / 2, values[i] + above / 2};
  }
  return sides;
}

/// Two keys of many values each: a cell for each scene, coloured by a quantity in classes.
PicturePanel cells(const Grid& grid, const SweptAxes& keys, std::size_t quantity) {
  const std::vector<double> x = numbers_of(grid, keys.over), y = numbers_of(grid, keys.of),
                            values = numbers_of(grid, quantity);
  const auto across = cell_sides(x), upward = cell_sides(y);
  const ValueClasses classes(values);
  PicturePanel panel{.columns = {{"x", "1", named(grid.columns[keys.over])},
                                 {"y", "1", named(grid.columns[keys.of])},
                                 {"class", "1", "class of its colour"}},
                     .plot = {.x_label = fmt::format("{}; colour: {}", axis_words(grid.columns[keys.over].name),
                                                     named(grid.columns[quantity])),
                              .y_label = axis_words(grid.columns[keys.of].name),
                              .x = {across.begin()->second[0], across.rbegin()->second[1]},
                              .y = {upward.begin()->second[0], upward.rbegin()->second[1]}}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const auto [left, right] = across.at(x[i]);
    const auto [low, high] = upward.at(y[i]);
    const double its_class = static_cast<double>(classes.of(values[i]));
    const auto add = [&](double across_it, double up) { panel.rows.push_back({across_it, up, its_class}); };
    add(left, low), add(right, low), add(right, high), add(left, high), add(left, no_number);
  }
  add_classes(classes, FigureCurve::Style::regions, panel);
  return panel;
}

/// The first of the quantities that is not the same in all rows, or else the first.
std::size_t varied_quantity(const Grid& grid, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::vector<double> values = numbers_of(grid, place_of(grid, name));
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) != values.end())
      return place_of(grid, name);
  }
  return place_of(grid, names.front());
}

/// The rows as few curves, over the last key if that leaves few, or else as cells; none: they are neither.
std::optional<SweptAxes> axes_of(const Grid& grid, const SweepRowsView& view) {
  if (view.random || view.swept == 0 || view.swept > 2) return {};
  const std::size_t first = view.first_swept, last = view.first_swept + view.swept - 1;
  std::set<double> values[2];
  for (const std::size_t key : {first, last}) {
    const std::vector<double> numbers = numbers_of(grid, key);
    if (!std::all_of(numbers.begin(), numbers.end(), [](double value) { return std::isfinite(value); })) return {};
    values[key == first ? 0 : 1].insert(numbers.begin(), numbers.end());
  }
  if (view.swept == 1 || values[0].size() <= most_curves) return SweptAxes{last, first};
  if (values[1].size() <= most_curves) return SweptAxes{first, last};
  return SweptAxes{last, first, true};
}

/// How many rows end where more impacts may follow, so that their sums are no whole sequence's; empty: none.
std::string cut_words(const Grid& grid) {
  const std::size_t outcome = place_of(grid, "outcome");
  const auto cut = std::count_if(grid.rows.begin(), grid.rows.end(), [&](const Row& row) {
    return outcome < row.size() && row[outcome].value.text() == outcome_name(analytic::Outcome::impact_limit);
  });
  return cut == 0 ? "" : fmt::format("{} of {} rows end at run.impacts, where more may follow", cut, grid.rows.size());
}

/// Whether a column has texts, which are not drawn.
bool holds_texts(const Grid& grid, const std::string& column) {
  const std::size_t place = place_of(grid, column);
  return std::any_of(grid.rows.begin(), grid.rows.end(), [&](const Row& row) {
    return place < row.size() && !row[place].value.number() && !row[place].value.text().empty();
  });
}

/// One key swept: each quantity over it.  Two keys: a curve for each value of that which has few, or a cell for each
/// scene.  Otherwise, and of random values: how many scenes have which value, in forty classes of equal width.
/// @param report of the sweep, with its rows; those without a number are left out.
Picture sweep_rows_picture(const Report& report, const SweepRowsView& view) {
  Picture picture{.what = "Many scenes", .scene = report.head};
  if (const std::string cut = cut_words(report.grid); !cut.empty()) picture.scene.push_back(cut);
  const std::optional<SweptAxes> swept = axes_of(report.grid, view);
  for (std::size_t i = 0; i < report.grid.columns.size() && !view.quantities.empty(); ++i) {
    if (report.grid.columns[i].name == "drop.attitude_q0")
      picture.panels.push_back(sphere(report.grid, i, varied_quantity(report.grid, view.quantities)));
  }
  for (const std::string& name : view.quantities) {
    const std::size_t quantity = place_of(report.grid, name);
    picture.panels.push_back(!swept ? histogram(report.grid.columns[quantity], numbers_of(report.grid, quantity))
                             : swept->are_cells ? cells(report.grid, *swept, quantity)
                                                : curves(report.grid, *swept, quantity));
  }
  if (swept && !swept->are_cells)
    picture.panels.back().plot.x_label = axis_words(report.grid.columns[swept->over].name);
  return picture;
}

struct SweepInput {
  SweepRequest request;
  std::string output;  ///< empty: stdout
  std::optional<int> threads;
  bool restart = false, check = false, dry_run = false;
  std::vector<std::string> parts;  ///< files of its --scenes that are checked together
  std::optional<Format> format;
  bool ascii = false, bare = false;
  PlotChoice plot;
};

/// What is computed, by whom, and what ends it.
struct SweepWork {
  const SweepPlan& plan;
  const SweepBody& body;
  int threads;
  const CooperativeInterrupt& interrupt;
};

bool is_hdf5(const SweepInput& input) { return input.output.ends_with(".h5") || input.output.ends_with(".hdf5"); }

/// The rows are CSV unless another form is named, a summary a table.
TextStyle style_of(const SweepInput& input) {
  const Format without = input.request.summary ? Format::table : Format::csv;
  return {.format = input.format.value_or(without), .ascii = input.ascii, .bare = input.bare};
}

/// Whether the rows go to a file that can be taken up again.
bool writes_file(const SweepInput& input) {
  return !input.output.empty() && !input.request.summary && style_of(input).format == Format::csv &&
         !destination_of({"--output", input.output}).is_stream;
}

ColumnFileHead column_head(const SweepPlan& plan, const Report& report) {
  ColumnFileHead head{
      .columns = report.grid.columns, .truths = truth_columns(plan.layout), .attributes = {{"title", report.title}}};
  for (const char* name : {"scene", "body"}) {
    const Value* const value = report.fields.find(name);
    if (value != nullptr) head.attributes.emplace_back(name, compact_json(*value));
  }
  head.attributes.emplace_back("sweep", fmt::format("{}", fmt::join(report.remarks, "\n")));
  return head;
}

/// As CSV's head has them.
std::string lines_of(const ColumnFileHead& head) {
  std::string lines;
  for (const auto& [name, text] : head.attributes) {
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part);)
      lines += name == "title" || name == "sweep" ? fmt::format("# {}\n", part) : fmt::format("# {}: {}\n", name, part);
  }
  return lines;
}

/// What FILE has of a sweep.
struct FileThere {
  FoundRows rows;
  ScenesTold told{};  ///< of its scenes
};

/// None: there is no such file, or an empty one.  @throws BadInput if it is there and not of this sweep
std::optional<FileThere> file_there(const SweepInput& input, const SweepPlan& plan) {
  const std::string path = destination_of({"--output", input.output}).path;
  std::error_code error;
  if (const auto size = std::filesystem::file_size(path, error); error || size == 0) return {};
  const Report report = plan.report();
  FileThere there;
  if (is_hdf5(input)) {
    const ColumnFileHead own = column_head(plan, report);
    const auto head = read_hdf5_head(path, own);
    std::istringstream lines(head ? lines_of(*head) : "no HDF5 of a sweep\n");
    if (!is_own_file(input.output, lines, lines_of(own))) return there;
    const auto is_there = head->rows == plan.range.last();
    there.rows = {.scenes = is_there ? plan.range.count : 0, .last = head->rows};
    if (is_there) there.rows.there = {{0, plan.range.count}};
    if (!is_there) there.rows.amiss = fmt::format("its last row is of scene {}", head->rows);
    there.told = head->told;
    return there;
  }
  if (input.bare) throw OtherFileThere(input.output, "and without comments does not say of which sweep");
  std::ifstream file(path, std::ios::binary);
  if (!is_own_file(input.output, file, csv_head(report, false))) {
    there.rows.amiss = "its head is cut";
    return there;
  }
  std::vector<double> values;
  const ExpectedRows expected{.scenes = plan.range,
                              .begins =
                                  [&](long long scene) {
                                    plan.points.at(scene, values);
                                    return row_prefix(scene, values, false);
                                  },
                              .scene_rows = plan.layout.rows == RowKind::impact
                                                ? std::optional(column_place(plan.layout, scene_rows_column))
                                                : std::nullopt};
  ShortfallCount found(plan.layout, false);
  there.rows = find_rows(file, expected, [&](std::string_view row) { found.add(row); });
  there.told = found.told(plan.range.count);
  return there;
}

/// Where the rows go: a file that can be taken up again, or stdout or a device; forms other than CSV are written when
/// all rows are there, and a summary keeps none.
class SweepOutput {
 public:
  SweepOutput(const SweepInput& input, const SweepPlan& plan)
      : plan_(plan), style_(style_of(input)), hdf5_(is_hdf5(input)), plot_(input.plot),
        random_(input.request.random.has_value()), shortfalls_(plan.layout, plan.packed) {
    report_ = plan.report();
    const std::string head = csv_head(report_, style_.bare);
    if (input.request.summary) summary_.emplace(plan.layout, plan.points);
    if (writes_file(input)) {
      file_.emplace(input.output, SweepFileForm{head, plan.range.count}, input.restart);
      file_->with_rows([this](std::string_view rows) {
        shortfalls_.add(rows);
        if (plot_.is_wanted()) collected_ += rows;
      });
    } else {
      stream_.emplace(input.output);
      if (is_csv()) stream_->write(head);
    }
  }

  [[nodiscard]] long long first() const { return file_ ? file_->scenes() : 0; }
  [[nodiscard]] long long cut() const { return shortfalls_.cut(); }
  [[nodiscard]] long long warned() const { return shortfalls_.warned(); }
  [[nodiscard]] ScenesTold told() const { return told_ ? *told_ : shortfalls_.told(plan_.range.count); }
  /// Whether the file is there already, of this very sweep and with all of its scenes, and none is being made anew.
  /// @throws BadInput if another file is there
  [[nodiscard]] bool is_done(const SweepInput& input) {
    const std::optional<FileThere> there = file_ ? file_there(input, plan_) : std::nullopt;
    if (!there || first() > 0 || plot_.is_wanted()) return false;
    if (!there->rows.is_whole()) {
      throw BadInput(
          "--output {}: is of this sweep, but not whole after scene {}; --check says what it lacks, --restart "
          "computes it anew",
          file_->path(), there->rows.last);
    }
    told_ = there->told;
    return true;
  }
  void write(const RangeRows& rows) {
    shortfalls_.add(rows.text);
    if (plot_.is_wanted() && (file_ || is_csv())) collected_ += rows.text;
    if (file_) file_->write(rows.text, rows.scenes);
    else if (summary_) summary_->add(rows.text);
    else if (is_csv()) stream_->write(rows.text);
    else collected_ += rows.text;
  }

  void commit() {
    write_rows();
    if (plot_.is_wanted()) write_picture();
  }

  /// @param words how far it came; a part says that by itself
  void leave(const std::string& words) {
    plot_.leave_out("interrupted");
    if (file_) return file_->flush();
    if (is_csv()) stream_->write(fmt::format("# {}\n", words));
    else report_.notes.push_back(words);
    write_rows();
  }

 private:
  void write_rows() {
    if (file_ && hdf5_) {
      return file_->commit([this](const std::string& path) {
        try {
          write_hdf5(path);
        } catch (const std::runtime_error& error) {  // a full disk, as of any other file
          throw BadInput("--output {}: {}", file_->path(), error.what());
        }
      });
    }
    if (file_) return file_->commit();
    if (!is_csv()) write_report();
    stream_->commit();
  }

  [[nodiscard]] bool is_csv() const { return style_.format == Format::csv && !summary_; }

  void write_report() {
    if (summary_) {
      summary_->fill(
          report_, [this](long long index, const std::string& column) { return plan_.command_of(index, column); },
          [this](long long place) { return plan_.attitude_name(place); });
    } else {
      report_.grid.rows = read_csv_rows(collected_);
    }
    report_.fields["rows"] = row_objects(report_.grid);
    stream_->write(report_text(report_, style_));
  }

  void write_hdf5(const std::string& path) {
    ColumnFileHead head = column_head(plan_, report_);
    head.told = told();
    std::vector<PackedCell> row(head.columns.size());
    if (plan_.layout.rows == RowKind::scene) head.rows = plan_.range.count;
    else {
      file_->with_rows([&](std::string_view rows) {
        for (PackedRows packed(rows); packed.next(row);) ++head.rows;
      });
    }
    const std::unique_ptr<ColumnFile> columns = open_hdf5(path, head);
    file_->with_rows([&](std::string_view rows) {
      for (PackedRows packed(rows); packed.next(row);) columns->add(row);
    });
    columns->close();
  }

  /// The picture shows the columns asked for, or else those that tell most of a drop.
  void write_picture() {
    Report rows = plan_.report();
    rows.grid.rows = read_csv_rows(collected_);
    SweepRowsView view{.swept = plan_.layout.swept.size(), .random = random_, .quantities = {}};
    std::vector<std::string> names;
    for (const ImpactColumn& asked : plan_.layout.asked) names.push_back(asked.column.name);
    names.insert(names.end(), plan_.layout.named.begin(), plan_.layout.named.end());
    for (std::size_t probe = 0; probe < plan_.layout.probes.size(); ++probe) {
      const std::string name = ranking_column(plan_.layout, probe);
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    for (const std::string& name : names) {
      if (!holds_texts(rows.grid, name) && view.quantities.size() < most_panels) view.quantities.push_back(name);
    }
    if (view.quantities.empty()) view.quantities = {"impacts", "total_normal_impulse", "energy_loss"};
    plot_.write(sweep_rows_picture(rows, view), {rows.title});
  }

  static constexpr std::size_t most_panels = 4;
  const SweepPlan& plan_;
  Report report_;
  TextStyle style_;
  bool hdf5_;
  PlotFile plot_;
  bool random_;
  std::string collected_;
  std::optional<Sink> stream_;
  std::optional<SweepFile> file_;
  std::optional<Summary> summary_;
  ShortfallCount shortfalls_;
  std::optional<ScenesTold> told_;  ///< of a file that is there already
};

/// An ending that promises a form which is not written would be believed.
void require_own_ending(const SweepInput& input) {
  constexpr const char* others[] = {".gz", ".xz", ".zst", ".bz2", ".zip", ".parquet", ".feather", ".xlsx", ".json"};
  const auto is_own = [&](std::string_view ending) {
    return ending == ".json" && style_of(input).format == Format::json;
  };
  for (const std::string_view ending : others) {
    if (input.output.ends_with(ending) && !is_own(ending))
      throw BadInput(fmt::format("--output {}: must not end in {}, rows are written as CSV or, to FILE.h5, HDF5",
                                 input.output, ending));
  }
}

void check_output(const SweepInput& input) {
  if (is_hdf5(input)) {
    if (input.request.summary) throw BadInput(fmt::format("--output {}: a summary has no rows for HDF5", input.output));
    if (input.format) throw BadInput(fmt::format("--format: must be left out, --output {} is HDF5", input.output));
    require_hdf5();
  }
  for (const RunFile& file : plot_files(input.plot)) note_written(file);
  if (!input.plot.path.empty() && (input.request.summary || is_hdf5(input) || input.request.rows == RowKind::impact))
    throw BadInput("--plot: draws rows of scenes, which --summary, HDF5 and --rows impact have not");
  if (writes_file(input)) {
    note_written({"--output", input.output});
    for (const RunFile& file : SweepFile::files_beside(input.output)) note_written(file);
  } else if (input.restart) {
    throw BadInput("--restart: needs a file as --output, there is nothing to go on with");
  }
}

/// Computes what the output lacks, as far as it comes.
void fill(SweepOutput& output, RangeQueue& queue, const SweepWork& what, Ranks& ranks) {
  RunProgress progress(queue.taken(), what.plan.range.count, "scenes");
  SweepHooks hooks;
  hooks.write = [&](const RangeRows& rows) { output.write(rows); };
  hooks.tick = [&] {
    output.write({});
    progress.tick(queue.taken());
  };
  hooks.stop = [&] { return what.interrupt.requested(); };
  compute_ranges(queue, what.threads, runners_of(what.plan, what.body), hooks, ranks);
}

/// The part of the process that writes.
int run_sweep(const SweepInput& input, const SweepPlan& plan, const SweepBody& body, int threads, Ranks& ranks) {
  const CooperativeInterrupt interrupt;
  SweepOutput output(input, plan);
  const long long scenes = plan.range.count;
  const bool is_done = !input.restart && output.is_done(input);
  const long long first = is_done ? scenes : output.first();
  if (is_done) say(fmt::format("{} is complete, nothing is left to do; --restart computes it anew", input.output));
  else if (first > 0 && first < scenes) say(fmt::format("goes on after {} of {} scenes", first, scenes));
  RangeQueue queue({first, scenes - first}, range_size(plan));
  fill(output, queue, {plan, body, threads, interrupt}, ranks);
  if (queue.is_complete()) {
    if (!is_done) {
      output.commit();
      for (const std::string& remark : plan.remarks(input.request.summary ? 0 : output.cut(), output.warned()))
        say(remark);
    }
    const ScenesTold told = output.told();
    told.say();
    return told.fell_short.empty() ? 0 : exit_status(FailureKind::not_computed);
  }
  const std::string words = fmt::format("interrupted after {} of {} scenes", queue.taken(), scenes);
  output.leave(words);
  if (writes_file(input)) say(words + "; the same command goes on");
  return interrupted_status;
}

/// "7, 200 to 399", of many the first.
std::string listed(const std::vector<std::string>& runs) {
  constexpr std::size_t most = 20;
  const std::size_t shown = std::min(runs.size(), most);
  return fmt::format("{}{}", fmt::join(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < runs.size() ? fmt::format(" and {} more", runs.size() - shown) : "");
}

/// "11 of 79 scenes: 30 to 39, 70; impacts of 2 scenes: 7, 9"; empty: nothing.
std::string lacking_words(const FoundRows& rows, long long count) {
  std::vector<std::string> words;
  if (!rows.missing.empty())
    words.push_back(fmt::format("{} of {} scenes: {}", count - rows.scenes, count, listed(rows.missing)));
  if (!rows.cut.empty()) words.push_back(fmt::format("impacts of {} scenes: {}", rows.cut.size(), listed(rows.cut)));
  return fmt::format("{}", fmt::join(words, "; "));
}

/// The scenes that a head says it is of, "FROM:TO:STEP"; empty: it does not say.
std::string scenes_of_head(const std::string& lines) {
  static const std::regex own("# here: scenes ([0-9]+) to ([0-9]+)( by ([0-9]+))?\n");
  std::smatch found;
  if (!std::regex_search(lines, found, own)) return "";
  return fmt::format("{}:{}:{}", found.str(1), found.str(2), found[4].matched ? found.str(4) : "1");
}

std::string comments_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string lines;
  for (std::string line; std::getline(file, line) && line.starts_with("# ");) lines += line + "\n";
  return lines;
}

/// The same for a part of a sweep.
std::string scenes_of_part(const SweepInput& part, const SweepPlan& plan) {
  if (!is_hdf5(part)) return scenes_of_head(comments_of(part.output));
  const auto head = read_hdf5_head(part.output, column_head(plan, plan.report()));
  return head ? scenes_of_head(lines_of(*head)) : "";
}

/// What an interrupted run has left of FILE: "FILE.part has 242 of 2500 scenes"; empty: nothing.
std::string begun_words(const SweepInput& input) {
  const std::string part = destination_of({"--output", input.output}).path + ".part";
  const std::optional<long long> scenes = SweepFile::begun_scenes(part);
  if (!scenes) return "";
  SweepInput begun = input;
  if (begun.request.scenes.empty()) begun.request.scenes = scenes_of_head(comments_of(part));
  return fmt::format("{}.part has {} of {} scenes", input.output, *scenes, read_sweep_plan(begun.request).range.count);
}

/// Says what FILE lacks of the sweep, and computes nothing.
int check_file(const SweepInput& input, const SweepPlan& plan) {
  if (!writes_file(input) || input.bare)
    throw BadInput("--check: needs --output with a file of CSV or HDF5, comments and all");
  if (input.restart) throw BadInput("--restart: must be left out with --check, which computes nothing");
  constexpr int failed = 1;  // a check
  if (input.request.scenes.empty() && !scenes_of_part(input, plan).empty()) {
    say(
        fmt::format("{} has the line '# here' of a part: leave it out of what is joined, and the other heads; --parts "
                    "checks parts themselves",
                    input.output));
    return failed;
  }
  const std::optional<FileThere> there = file_there(input, plan);
  if (!there) {
    const std::string begun = begun_words(input);
    say(begun.empty() ? fmt::format("{} is not there: all of {} scenes are missing", input.output, plan.range.count)
                      : fmt::format("{} is not there; {}; the same command goes on", input.output, begun));
    return failed;
  }
  const FoundRows& rows = there->rows;
  if (rows.is_whole()) {
    say(fmt::format("{} is whole, with {} scenes", input.output, rows.scenes));
    there->told.say();
    return 0;
  }
  const std::string lacks = lacking_words(rows, plan.range.count);
  if (!lacks.empty()) say(fmt::format("{} lacks {}", input.output, lacks));
  if (!rows.amiss.empty()) say(fmt::format("{} is not in order: {}", input.output, rows.amiss));
  return failed;
}

/// Places of a sweep's scenes that are marked, in words.
std::string runs_of(const std::vector<char>& marks, char mark) {
  std::vector<std::string> runs;
  for (std::size_t begin = 0; begin < marks.size();) {
    std::size_t end = begin;
    while (end < marks.size() && marks[end] == mark) ++end;
    if (end > begin) runs.push_back(scene_run(static_cast<long long>(begin), static_cast<long long>(end) - 1));
    begin = std::max(end, begin + 1);
  }
  return listed(runs);
}

/// How often the scenes of a sweep are in the files of its parts.
struct PartsFound {
  enum Mark : char { absent, once, again };
  std::vector<char> marks;
  bool is_amiss = false;  ///< a file is not a whole part of it

  void add(const PickedScenes& scenes, const std::vector<SceneRange>& there) {
    for (const SceneRange& run : there) {
      for (long long k = run.first; k < run.first + run.count; ++k) {
        char& mark = marks[static_cast<std::size_t>(scenes.at(k))];
        mark = mark == absent ? once : again;
      }
    }
  }
};

/// What a file has of its scenes, in words; they are added to what was found.
std::string part_words(const SweepInput& input, const SweepPlan& whole, PartsFound& found) try {
  SweepInput part = input;
  const bool was_amiss = std::exchange(found.is_amiss, true);
  part.request.scenes = scenes_of_part(input, whole);
  const SweepPlan plan = read_sweep_plan(part.request);
  const std::optional<FileThere> there = file_there(part, plan);
  if (!there) {
    const std::string begun = begun_words(part);
    return begun.empty() ? "is not there, or empty" : begun + "; its command goes on";
  }
  const std::string of = fmt::format("scenes {} to {}{}", plan.range.first, plan.range.last(),
                                     plan.range.step > 1 ? fmt::format(" by {}", plan.range.step) : "");
  const FoundRows& rows = there->rows;
  found.add(plan.range, rows.there);
  if (!rows.amiss.empty()) return fmt::format("{}, not in order: {}", of, rows.amiss);
  if (!rows.is_whole()) return fmt::format("{}, lacks {}", of, lacking_words(rows, plan.range.count));
  found.is_amiss = was_amiss;
  std::string words = of + ", whole";
  for (const std::string& told : {there->told.set_aside, there->told.fell_short})
    if (!told.empty()) words += "; " + std::regex_replace(told, std::regex("\n"), "; ");
  return words;
} catch (const OtherFileThere& other) {
  return other.words;
} catch (const BadInput& error) {
  return error.what();
}

/// Says of each file of a part what it lacks, and what all of them lack together.
int check_parts(const SweepInput& input, const SweepPlan& plan) {
  if (!input.check || !input.output.empty() || !input.request.scenes.empty())
    throw BadInput("--parts: needs --check, and neither --output nor --scenes, which each file says itself");
  PartsFound found{.marks = std::vector<char>(static_cast<std::size_t>(plan.points.count()), PartsFound::absent)};
  for (const std::string& path : input.parts) {
    SweepInput part = input;
    part.output = path;
    say(fmt::format("{}: {}", path, part_words(part, plan, found)));
  }
  const auto count_of = [&](PartsFound::Mark mark) { return std::ranges::count(found.marks, mark); };
  const auto lacking = count_of(PartsFound::absent), twice = count_of(PartsFound::again);
  say(fmt::format("{} of {} scenes are there{}{}", plan.points.count() - lacking, plan.points.count(),
                  lacking == 0 ? "" : fmt::format("; missing: {}", runs_of(found.marks, PartsFound::absent)),
                  twice == 0 ? "" : fmt::format("; more than once: {}", runs_of(found.marks, PartsFound::again))));
  return lacking == 0 && twice == 0 && !found.is_amiss ? 0 : 1;
}

std::vector<Column> dry_run_columns() {
  return {{"scenes", "scenes", "", "scenes that the sweep has"},
          {"bytes", "bytes", "B", "size of the file, of HDF5 before compression"},
          {"cpu_time", "cpu time", "s", "processor time of all scenes"},
          {"cpu_time_error", "± cpu time", "s", "its standard error, by the scatter among the scenes tried"},
          {"threads", "threads", "", "threads that share it"},
          {"time", "time", "s", "processor time over threads, at least that of the dearest scene tried"},
          {"tried", "tried", "", "scenes that were computed for this"}};
}

/// Computes some scenes, spread over the sweep, and tells what all of them take; writes none.
int run_dry(const SweepInput& input, SweepPlan plan, const SweepBody& body, int threads) {
  if (input.check || input.request.summary || input.restart || !input.plot.path.empty())
    throw BadInput("--dry-run: goes with neither --check, --summary, --restart nor --plot");
  constexpr double most_seconds = 5;
  constexpr long long most_scenes_tried = 1000;
  constexpr double golden = 0.6180339887498949;  // its multiples are spread evenly, wherever they end
  plan.packed = false;
  const CooperativeInterrupt interrupt;
  SceneRunner runner(plan, body, [&] { return interrupt.requested(); });
  const auto count = static_cast<double>(plan.range.count);
  const long long most = std::min(plan.range.count, most_scenes_tried);
  double sum = 0, squares = 0, dearest = 0, bytes = 0, rows = 0;
  ShortfallCount shortfalls(plan.layout, plan.packed);
  long long tried = 0;
  for (; tried < most && sum < most_seconds && !interrupt.requested(); ++tried) {
    const double part = std::fmod((static_cast<double>(tried) + 0.5) * golden, 1);
    const long long place = most == plan.range.count ? tried : static_cast<long long>(part * count);
    const double begin = thread_seconds();
    const RangeRows there = runner({place, 1});
    const double took = thread_seconds() - begin;
    sum += took, squares += took * took;
    dearest = std::fmax(dearest, took);
    shortfalls.add(there.text);
    bytes += static_cast<double>(there.text.size());
    rows += static_cast<double>(std::ranges::count(there.text, '\n'));
  }
  if (interrupt.requested()) return interrupted_status;
  shortfalls.told(tried, "scenes tried").say();
  const auto n = static_cast<double>(tried);
  const double scatter = n > 1 ? std::sqrt(std::fmax(squares - sum * sum / n, 0) / (n - 1)) : no_number;
  Report report = plan.report();
  if (is_hdf5(input)) bytes = rows * 8 * static_cast<double>(report.grid.columns.size());
  const double head = is_hdf5(input) ? 0 : static_cast<double>(csv_head(report, input.bare).size());
  const double all = sum / n * count;
  report.grid.columns = dry_run_columns();
  constexpr int digits = 3;  // shown: others would follow the scenes tried, or the machine
  Row row{plan.range.count};
  row.emplace_back(std::round(head + bytes / n * count), digits);
  row.emplace_back(all, digits);
  row.emplace_back(Value(rounded_up(scatter / std::sqrt(n) * count)));
  row.emplace_back(threads);
  row.emplace_back(std::fmax(all / threads, dearest), digits);
  row.emplace_back(tried);
  report.grid.rows.push_back(std::move(row));
  report.fields["rows"] = row_objects(report.grid);
  fmt::print(
      "{}",
      report_text(report, {.format = input.format.value_or(Format::table), .ascii = input.ascii, .bare = input.bare}));
  return 0;
}

int run_command(const SweepInput& input, Ranks& ranks) {
  const SweepRequest& request = input.request;
  if (request.file.empty() && request.sets.empty())
    throw BadInput("SCENE, or keys by --set: required, clatter help keys has them");
  SweepPlan plan = read_sweep_plan(request);
  require_own_ending(input);
  if (!input.parts.empty()) return ranks.writes() ? check_parts(input, plan) : 0;
  plan.packed = input.request.summary || is_hdf5(input);
  const int threads = thread_count(input.threads, ranks);
  if (!input.dry_run) check_output(input);
  if (input.check && !input.dry_run) return ranks.writes() ? check_file(input, plan) : 0;
  if (ranks.writes()) say_doubts(plan.scene, plan.layout.model, plan.layout.probes);
  // A body that cannot be made is bad input, but a row's where it is swept.
  const SweepBody body = plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : SweepBody{};
  if (input.dry_run) return ranks.writes() ? run_dry(input, plan, body, threads) : 0;
  return ranks.writes() ? run_sweep(input, plan, body, threads, ranks) : serve_ranges(runners_of(plan, body), ranks);
}

constexpr const char* sweep_footer =
    "Example: clatter sweep phone-damped --set drop.angle_deg=5:85:5 "
    "--set ground.damping=0:2e7:1e6 --set run.impacts=2 --output phone.csv\n"
    "Example: clatter sweep phone-corner --set drop.attitude=uniform --random 1000 "
    "--columns hardest,hardest_corners,impulse_normal_1,impulse_normal_2\n"
    "Example: clatter sweep phone-damped --set drop.attitude=26 --random 2600 --scatter 3 --set run.impacts=2 "
    "--summary\n"
    "drop.attitude=26 has a box fall on each face, edge and corner (clatter help keys numbers them); @FILE is a CSV "
    "file\n"
    "with columns q0, q1, q2, q3. Columns asked for are quantities that rows of impacts have; the hardest impact "
    "has\n"
    "the largest normal impulse.\n"
    "An interrupted sweep goes on when the same command is given again; of a complete FILE it says so and leaves it.\n"
    "Any other FILE that is not empty is refused without --restart.\n"
    "The discrete model takes the impact.* keys.\n"
    "Continuous scenes are planned for run.digits. Each number has a column with its error, empty where that is not "
    "known.\n"
    "A scene that is refused or fails is a row with its outcome, refused, outside-model or not-computed, and "
    "reason;\na line says how many are.\n"
    "Exit status 3 if a number could not be computed, a limit left fewer impacts than asked for, or required digits\n"
    "are not known, in any scene; its row says why. run.impacts is how many are asked for: a scene that ends\n"
    "there has outcome impact-limit, and falls short with run.until_rest alone.";

/// Which scenes, and what their rows hold.
void add_request_options(Command& command, SweepRequest& request) {
  add_scene_argument(command, request.file, false);
  command.add(
      {.name = "--set",
       .target = &request.sets,
       .type = "KEY=VALUE|A,B,...|RANGE",
       .help =
           "values of a key of the scene file, RANGE as FROM:TO:STEP, FROM:TO:lin:COUNT or FROM:TO:log:COUNT; may be "
           "repeated, the last varies fastest; drop.attitude takes "
           "uniform (with --random), 26 or [Q0,Q1,Q2,Q3],[...] or @FILE",
       .repeats = true});
  command.add(sweep_arguments(request));
  command.add(
      {.name = "--scenes",
       .target = &request.scenes,
       .type = "FROM:TO[:STEP]",
       .help = "of all the scenes only these, numbered and drawn as without it; a task of an array has its own, and "
               "0:LAST:STEP is a fair sample of what all cost"});
  command.add({.name = "--probe",
               .target = &request.probes,
               .type = "NAME:X,Y,Z",
               .help =
                   "columns for the largest change of velocity of this point of the body [m], and its impact; in the "
                   "continuous model also for its peak acceleration, the width of that and its impact, for two more "
                   "runs of each scene (with --no-errors one); may be repeated (else [[probe]] in the scene file)",
               .repeats = true});
}

}  // namespace

Command sweep_command() {
  return command_of<SweepInput>(
      [](const SweepInput& input) { return run_in_processes([&](Ranks& ranks) { return run_command(input, ranks); }); },
      [](Command& command, SweepInput& input) {
        SweepRequest& request = input.request;
        add_request_options(command, request);
        command.add_text(
            "--output", input.output, "FILE",
            "write there; until it is complete the rows are in FILE.part; FILE.h5 is HDF5, columns with units");
        command.add_flag(
            "--summary", request.summary,
            "no rows: counts, percentiles and extremes, in a table of what was asked for, in other forms of all, "
            "with the command that shows each extreme");
        command.add(format_argument(input.format,
                                    "form of the output (csv); others are written at the end, and not taken up again"));
        command.add_flag(
            "--check", input.check,
            "only says what FILE lacks, status 1 if anything: the rows' order, numbers and keys are looked "
            "at, not their results");
        command.add_list(
            "--parts", input.parts, "FILE",
            "with --check in place of --output: files of --scenes of this sweep; a line on each, then which "
            "scenes none or several of them have");
        command.add_flag(
            "--dry-run", input.dry_run,
            "only says how many bytes and how much time the sweep takes, by up to 1000 of its scenes or 5 s "
            "of them; --threads N for that many processes");
        command.add_flag("--ascii", input.ascii, "plain ASCII in tables");
        command.add_flag("--bare", input.bare, "CSV without comments");
        command.add_flag("--no-errors", request.no_errors,
                         "neither errors nor whether rows can be predicted; half the cost");
        command.add_flag("--require-digits", request.require_digits,
                         "a scene of which fewer digits are known falls short");
        add_plot_options(command, input.plot);
        add_process_options(command, input.restart, input.threads);
        command.footer = sweep_footer;
        command.columns = {{"sweep",
                            [] {
                              return sweep_columns({.model = Model::continuous,
                                                    .warns = true,
                                                    .probes = {{.name = "NAME"}},
                                                    .rests = true,
                                                    .part_at = {FragilePart{}},
                                                    .has_curve = true});
                            }},
                           {"sweep-summary", Summary::columns},
                           {"sweep-dry-run", dry_run_columns}};
      });
}

}  // namespace clatter::validation
