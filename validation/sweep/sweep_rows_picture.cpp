// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_rows_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "numeric/base/linear_algebra.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

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

/// A swept key by its name, whose underlines gnuplot must not take for subscripts, with the key's unit.
std::string key_label(const std::string& name) {
  std::string label;
  for (const char c : name) label += c == '_' ? "\\_" : std::string(1, c);
  const auto& keys = all_keys();
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& one) { return one.name == name; });
  return key == keys.end() || *key->unit == '\0' ? label : fmt::format("{} [{}]", label, key->unit);
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
      .rows = {},
      .plot = {
          .title = "",
          .x_label = named(column),
          .y_label = "scenes",
          .curves = {{.x = "value", .y = "scenes", .legend = "", .style = FigureCurve::Style::area, .y_low = "zero"}},
          .y = {0, no_number}}};
  if (values.empty()) return panel;
  const Classes classes = classes_of(values);
  std::vector<double> counts(classes.count, 0);
  for (const double value : values) {
    ++counts[std::min(static_cast<std::size_t>((value - classes.low) / classes.width), classes.count - 1)];
  }
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
  std::size_t over, of;  ///< the same: one curve
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
                     .rows = {},
                     .plot = {.title = "", .x_label = "", .y_label = named(column), .curves = {}}};
  for (std::size_t i = 0; i < x.size(); ++i) panel.rows.push_back({x[i], y[i], of[i]});
  count_on_y(y, panel.plot);
  for (const double value : std::set<double>(of.begin(), of.end())) {
    panel.plot.curves.push_back(
        {.x = "x",
         .y = "y",
         .legend = has_many ? grid.columns[keys.of].name + " = " + shortest(value) : "",
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

/// A curve of points for each class that has some, with the range of its values.
/// @param known  all values, in order
void add_classes(const std::vector<double>& known, std::span<const char* const> colours, PicturePanel& panel) {
  for (std::size_t k = 0; k < colours.size(); ++k) {
    const auto at = [&](std::size_t part) {
      return known[std::min(part * known.size() / colours.size(), known.size() - 1)];
    };
    const auto is_of_class = [&](const std::vector<double>& row) { return row[2] == static_cast<double>(k); };
    if (std::none_of(panel.rows.begin(), panel.rows.end(), is_of_class)) continue;
    panel.plot.curves.push_back({.x = "x",
                                 .y = "y",
                                 .legend = range_words(at(k), at(k + 1)),
                                 .style = FigureCurve::Style::points,
                                 .where = {{"class", static_cast<double>(k)}},
                                 .colour = colours[k]});
  }
}

/// Which direction of the body points down, coloured by a quantity in classes of as many drops each; the largest on
/// top.
PicturePanel sphere(const Grid& grid, std::size_t attitude, std::size_t quantity) {
  constexpr const char* colours[] = {"#c6dbef", "#6baed6", "#2171b5", "#fd8d3c", "#d7301f"};
  constexpr std::size_t classes = std::size(colours);
  const std::vector<double> values = numbers_of(grid, quantity);
  std::vector<double> q[4], known;
  for (std::size_t i = 0; i < 4; ++i) q[i] = numbers_of(grid, attitude + i);
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double v) { return std::isfinite(v); });
  std::sort(known.begin(), known.end());
  PicturePanel panel{.columns = {{"x", "1", "eastward on an equal-area map"},
                                 {"y", "1", "northward on an equal-area map"},
                                 {"class", "1", "fifth of the drops"}},
                     .rows = {},
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
    const auto rank = std::lower_bound(known.begin(), known.end(), values[i]) - known.begin();
    const auto [x, y] = mapped(attitude_of.normalized().conjugate() * -numeric::Vector3::UnitZ());
    panel.rows.push_back({x, y,
                          std::floor(static_cast<double>(classes * static_cast<std::size_t>(rank)) /
                                     static_cast<double>(known.size()))});
  }
  add_classes(known, colours, panel);
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

/// The rows as few curves, over the last key if that leaves few; none: they are no curves.
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
  return {};
}

/// How many rows end where more impacts may follow, so that their sums are no whole sequence's; empty: none.
std::string cut_words(const Grid& grid) {
  const std::size_t outcome = place_of(grid, "outcome");
  const auto cut = std::count_if(grid.rows.begin(), grid.rows.end(), [&](const Row& row) {
    return outcome < row.size() && row[outcome].value.text() == outcome_name(analytic::Outcome::impact_limit);
  });
  return cut == 0 ? "" : fmt::format("{} of {} rows end at run.impacts, where more may follow", cut, grid.rows.size());
}

}  // namespace

bool holds_texts(const Grid& grid, const std::string& column) {
  const std::size_t place = place_of(grid, column);
  return std::any_of(grid.rows.begin(), grid.rows.end(), [&](const Row& row) {
    return place < row.size() && !row[place].value.number() && !row[place].value.text().empty();
  });
}

Picture sweep_rows_picture(const Report& report, const SweepRowsView& view) {
  Picture picture{.what = "Many scenes", .scene = report.head, .panels = {}};
  if (const std::string cut = cut_words(report.grid); !cut.empty()) picture.scene.push_back(cut);
  const std::optional<SweptAxes> swept = axes_of(report.grid, view);
  for (std::size_t i = 0; i < report.grid.columns.size() && !view.quantities.empty(); ++i) {
    if (report.grid.columns[i].name == "drop.attitude_q0")
      picture.panels.push_back(sphere(report.grid, i, varied_quantity(report.grid, view.quantities)));
  }
  for (const std::string& name : view.quantities) {
    const std::size_t quantity = place_of(report.grid, name);
    picture.panels.push_back(swept ? curves(report.grid, *swept, quantity)
                                   : histogram(report.grid.columns[quantity], numbers_of(report.grid, quantity)));
  }
  if (swept) picture.panels.back().plot.x_label = key_label(report.grid.columns[swept->over].name);
  return picture;
}

}  // namespace clatter::validation
