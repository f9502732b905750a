// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/rod/rod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/plane/contact_angles.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::BoundaryKind;
using analytic::degrees_per_radian;
using analytic::ImpactNumber;
using analytic::RegimeBoundary;
using analytic::RodParameters;

const char* const regimes_summary = "how many impacts, and where that changes";

/// A quantity to vary.
struct VariedQuantity {
  const char* name;
  const char* heading;
  const char* words;  ///< for an axis of a picture
  double RodParameters::*member;
  std::vector<double> values;  ///< without a range given
  Range range;
};

const std::vector<VariedQuantity> all_quantities{{"gravity-number",
                                                  "G",
                                                  "gravity number G = g L/vₙ²",
                                                  &RodParameters::gravity_number,
                                                  {0, 0.001, 0.01, 0.1, 1, 10},
                                                  {0, 1e300, false, "from 0 to 1e300"}},
                                                 {"restitution",
                                                  "e",
                                                  "coefficient of restitution e",
                                                  &RodParameters::restitution,
                                                  {0.25, 0.5, 0.75, 0.9, 1},
                                                  {0, 1, false, "from 0 to 1"}},
                                                 {"impulse-ratio",
                                                  "μᵢ",
                                                  "impulse ratio μᵢ",
                                                  &RodParameters::impulse_ratio,
                                                  {-0.2, -0.1, 0, 0.1, 0.2, 0.3},
                                                  {-1e300, 1e300, false, "from -1e300 to 1e300"}}};

/// A value of the varied quantity that is given by itself is the one value asked for.
std::vector<double> values_of(const RegimesRequest& input, const VariedQuantity& quantity, const RodParameters& rod) {
  const RangeRequest& range = input.range;
  const double given = rod.*quantity.member;
  const bool is_given = given != RodParameters{}.*quantity.member;
  if (!range.from && !range.to && !range.step && !range.count)
    return is_given ? std::vector<double>{given} : quantity.values;
  if (is_given) {
    throw BadInput(fmt::format("--{} {}: is what --from and --to vary; give one of them, not both", quantity.name,
                               shortest(given)));
  }
  const bool is_point = range.from && range.to && *range.from == *range.to;
  if (!range.from || !range.to || (!range.step && !range.count && !is_point))
    throw BadInput("--from, --to and --step or --count: a range needs all three");
  Sweep sweep = sweep_of(range, {0, 0, 1}, quantity.range);
  sweep.logarithmic = input.logarithmic;
  if (input.logarithmic && (!(sweep.from > 0) || sweep.step > 0))
    throw BadInput("--log: needs --from greater than 0 and --count");
  std::vector<double> values;
  for (long long i = 0; i < sweep.count; ++i) values.push_back(sweep.value(i));
  return values;
}

const char* kind_name(BoundaryKind kind) {
  switch (kind) {
    case BoundaryKind::fold: return "fold";
    case BoundaryKind::upright: return "upright";
    case BoundaryKind::order: return "order";
    case BoundaryKind::stop: return "stop";
    case BoundaryKind::always: return "always";
    case BoundaryKind::never: return "never";
  }
  return "";
}

/// An angle that is nothing but rounding is 0.
Cell angle_cell(double radians, int digits) {
  if (std::isnan(radians)) return {};
  return std::fabs(radians) < 1e-13 ? Cell(0) : Cell(radians * degrees_per_radian, digits);
}

/// Columns of a boundary: `number` is "2" or "3", the other impact's angle there is not shown.
void add_boundary_columns(const std::string& number, const std::string& object, std::vector<Column>& columns) {
  const bool second = number == "2";
  const std::string at = "at the boundary of " + object + " impacts";
  columns.insert(
      columns.end(),
      {{"theta_" + number + "_deg", second ? "θ₂" : "θ₃", "°", "angle below which there is a " + object + " impact",
        true, false, object, "theta_deg"},
       {"kind_" + number, "kind", "", "why the " + object + " impact ends there", true, false, object, "kind"},
       {second ? "beta_deg" : "beta_3_deg", "β there", "°", "β " + at, second, false, object, "beta_deg"},
       {second ? "gamma_2_deg" : "gamma_deg", "γ there", "°", "γ " + at, !second, false, object, "gamma_deg"},
       {"theta_" + number + "_deg_error", "", "°", "error of theta_" + number + "_deg", false, false, object,
        "uncertainty_deg"}});
}

std::vector<Column> columns_of(const VariedQuantity& quantity) {
  std::vector<Column> columns{{quantity.name, quantity.heading, "", quantity.words}};
  add_boundary_columns("2", "second", columns);
  add_boundary_columns("3", "third", columns);
  return columns;
}

void add_boundary(const RegimeBoundary& b, int digits, Row& row) {
  const bool exists = b.kind != BoundaryKind::never;
  const Estimated angle = Estimated{b.theta, b.uncertainty} * degrees_per_radian;
  row.insert(row.end(),
             {exists ? known_cell(angle, {digits, 90}) : Cell(), Cell(kind_name(b.kind)), angle_cell(b.beta, digits),
              angle_cell(b.gamma, digits), Cell(exists ? error_or_nothing(angle) : Value())});
}

Report report_of(const std::vector<Regimes>& all, const VariedQuantity& quantity, const RodParameters& rod,
                 int digits) {
  Report report = begun_report("regimes", regimes_summary);
  report.grid.columns = columns_of(quantity);
  report.notes = {
      "Counted are, of the first three impacts, those with the ends in turn and β, γ ≤ 90°: three below θ₃, at least "
      "two below θ₂, from there on "
      "one.",
      "fold: the end grazes the ground; upright: it arrives at 90°; order: the end that struck last strikes again "
      "first, an impact that is not counted; stop: with e = 0 the impact before leaves the rod at rest. Past upright a "
      "later "
      "one may come, with gravity it does: clatter sequence.",
      "Above a fold or upright a window of θ may follow in which the impact comes again, as clatter angles shows; "
      "where "
      "the two join, the boundary leaps from one row to the next."};
  if (quantity.member == &RodParameters::impulse_ratio)
    report.notes.emplace_back(
        "!: warning: an impulse ratio below 0 or above 3 sin θ cos θ/(1 + 3 sin²θ) pushes the contact along its slip "
        "in "
        "impact 1, and creates energy where e = 1; Eq. 8 takes it as given, clatter sequence --friction MU follows the "
        "slip");
  else if (const std::string warning = ratio_warning(rod); !warning.empty())
    report.notes.push_back("!: warning: " + warning);
  for (const auto& [value, second, third] : all) {
    Row& row = report.grid.rows.emplace_back();
    row.emplace_back(value, 6);
    add_boundary(second, digits, row);
    add_boundary(third, digits, row);
  }
  report.fields["model"] = "discrete";
  report.fields["over"] = quantity.name;
  report.fields["parameters"] = rod_fields(rod);
  report.fields["rows"] = row_objects(report.grid);
  return report;
}

/// Two decades or more between positive values: on a linear axis most of them would lie on one another.
bool spans_decades(const std::vector<double>& values) {
  double least = INFINITY, greatest = 0;
  for (const double value : values) {
    if (value > 0) least = std::fmin(least, value);
    greatest = std::fmax(greatest, value);
  }
  return greatest >= 100 * least;
}

/// Values from the least (on a logarithmic axis the least positive one) to the greatest, evenly spaced on the axis.
std::vector<double> between(std::vector<double> values, bool logarithmic) {
  constexpr int steps = 240;
  if (logarithmic) std::erase_if(values, [](double value) { return !(value > 0); });
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::vector<double> all;
  for (int i = 0; low != high && i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    const double value = logarithmic ? *low * std::pow(*high / *low, part) : *low + (*high - *low) * part;
    all.push_back(std::fmin(value, *high));
  }
  return all;
}

/// The parameters that all rows share.
std::string rod_words(const RodParameters& rod, const VariedQuantity& quantity) {
  std::string words = "thin rod, m = L = |vₙ| = 1";
  for (const VariedQuantity& other : all_quantities) {
    if (&other != &quantity) words += fmt::format(", {} = {}", other.heading, shortest(rod.*other.member));
  }
  return words;
}

using Style = FigureCurve::Style;

constexpr std::size_t most_marked = 60;  // so few values are marked on their curves

std::vector<double> row_of(const Regimes& one, bool of_table) {
  const auto angle = [](const RegimeBoundary& b, double without) {
    return b.kind == BoundaryKind::never ? without : b.theta * degrees_per_radian;
  };
  // Without such an impact the area of fewer impacts begins at 0.
  return {one.value,
          angle(one.second, no_number),
          angle(one.third, no_number),
          0,
          angle(one.third, 0),
          angle(one.second, 0),
          90,
          of_table ? 1. : 0.};
}

/// @param colour as in figures/regimes.svg
FigureCurve area(const FoundRegimes& axis, const char* low, const char* high, const char* legend, const char* colour) {
  return {.x = axis.name,
          .y = high,
          .legend = legend,
          .style = Style::area,
          .where = {{"of_table", 0}},
          .y_low = low,
          .colour = colour};
}

Range2 range_of(const FoundRegimes& axis) {
  const std::vector<Regimes>& all = axis.all;
  const auto [low, high] = std::minmax_element(
      all.begin(), all.end(), [](const Regimes& one, const Regimes& other) { return one.value < other.value; });
  if (axis.logarithmic) return {};
  const double room = low->value == 0 ? 0.5 : std::fabs(low->value) / 2;  // about a single point
  if (low->value == high->value) return {low->value - room, high->value + room};
  return {low->value, high->value};
}

/// θ₂ and θ₃: curves if there are any, and marks at the values of the table if these are few.
void add_boundaries(const FoundRegimes& found, bool has_curve, std::vector<FigureCurve>& curves) {
  const bool marked = found.all.size() <= most_marked;
  for (const auto& [column, legend, colour] :
       {std::tuple{"theta_2_deg", "θ₂", blue}, std::tuple{"theta_3_deg", "θ₃", pink}}) {
    const FigureCurve line{
        .x = found.name, .y = column, .legend = legend, .where = {{"of_table", 0}}, .colour = colour};
    if (has_curve) curves.push_back(line);
    if (!marked) continue;
    FigureCurve marks = line;
    marks.style = has_curve ? Style::points : Style::marks;
    marks.where = {{"of_table", 1}};
    if (has_curve) marks.legend = "";
    curves.push_back(marks);
  }
}

}  // namespace

Arguments regimes_arguments(RegimesRequest& request) {
  std::vector<std::string> names;
  for (const VariedQuantity& quantity : all_quantities) names.emplace_back(quantity.name);
  Arguments rows{choice_argument("--over", request.over, names, "what to vary (gravity-number)", "Range")};
  for (Argument& row : range_arguments(request.range, "value")) rows.push_back(std::move(row));
  rows.push_back(
      {.name = "--log", .target = &request.logarithmic, .help = "values in geometric progression", .group = "Range"});
  for (Argument& row : rod_arguments(request.rod)) rows.push_back(std::move(row));
  rows.push_back(whole_argument("--digits", request.digits, 1, 17, "N", "significant digits in tables (8)", "Output"));
  return rows;
}

FoundRegimes find_regimes(const RegimesRequest& input) {
  const VariedQuantity& quantity = all_quantities[input.over];
  const RodParameters rod = rod_parameters(input.rod);
  FoundRegimes found;
  found.name = quantity.name;
  found.words = quantity.words;
  found.values = values_of(input, quantity, rod);
  found.logarithmic =
      input.logarithmic || (quantity.member == &RodParameters::gravity_number && spans_decades(found.values));
  found.rod_words = rod_words(rod, quantity);
  found.script_head = {
      headline("regimes", regimes_summary),
      fmt::format("{}; {} from {} to {}, {} value{}", found.rod_words, quantity.heading, shortest(found.values.front()),
                  shortest(found.values.back()), found.values.size(), found.values.size() == 1 ? "" : "s")};
  const auto regimes_of = [rod, member = quantity.member](const std::vector<double>& values) {
    std::vector<Regimes> all;
    for (const double value : values) {
      RodParameters varied = rod;
      varied.*member = value;
      all.push_back({value, analytic::regime_boundary(ImpactNumber::second, varied),
                     analytic::regime_boundary(ImpactNumber::third, varied)});
    }
    return all;
  };
  found.all = regimes_of(found.values);
  found.curve = [regimes_of, values = found.values, logarithmic = found.logarithmic] {
    return regimes_of(between(values, logarithmic));
  };
  found.report = report_of(found.all, quantity, rod, input.digits);
  found.report.head = {found.rod_words};
  return found;
}

std::vector<Column> regimes_columns() {
  std::vector<Column> columns;
  for (const VariedQuantity& quantity : all_quantities) columns.push_back(columns_of(quantity).front());
  const std::vector<Column> rest = columns_of(all_quantities.front());
  columns.insert(columns.end(), rest.begin() + 1, rest.end());
  return columns;
}

Picture regimes_picture(const FoundRegimes& found) {
  const std::vector<Regimes> curve = found.curve();
  const bool leaves_out = found.logarithmic && std::any_of(found.all.begin(), found.all.end(),
                                                           [](const Regimes& one) { return !(one.value > 0); });
  PicturePanel panel{.columns = {{found.name, "1", found.words},
                                 {"theta_2_deg", "°", "largest θ with a second impact"},
                                 {"theta_3_deg", "°", "largest θ with a third impact"},
                                 {"zero", "°", "least θ"},
                                 {"below_3", "°", "three impacts below"},
                                 {"below_2", "°", "two impacts or more below"},
                                 {"upright", "°", "greatest θ"},
                                 {"of_table", "1", "1: a row of the table, 0: between them"}},
                     .plot = {.x_label = found.words + std::string(leaves_out ? " (0 lies off this axis)" : ""),
                              .y_label = "contact angle θ of the first impact [°]",
                              .x = range_of(found),
                              .y = {0, 90},
                              .logarithmic_x = found.logarithmic}};
  for (const Regimes& one : curve) panel.rows.push_back(row_of(one, false));
  for (const Regimes& one : found.all) panel.rows.push_back(row_of(one, true));
  if (!curve.empty()) {
    panel.plot.curves = {area(found, "zero", "below_3", "three impacts", "#fbd9bd"),
                         area(found, "below_3", "below_2", "at least two", "#bfdcee"),
                         area(found, "below_2", "upright", "at least one", "#eeeeee")};
  }
  add_boundaries(found, !curve.empty(), panel.plot.curves);
  return {.what = "How many impacts, and where that changes", .scene = {found.rod_words}, .panels = {panel}};
}

}  // namespace clatter::validation
