// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/rod/rod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analytic/batch/rod_batch.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;

constexpr std::size_t plain_columns = 17, impacts_column = 16, deficit_column = 15;
constexpr double neighbour_shift = 0x1p-30;  // between rounding and the curvature of the results
constexpr double least_of_batch = 5;  // degrees: below, γ − θ and 2 − ΣP have digits that the batch has not

double angle_or_missing(const analytic::ContactAngle& angle) {
  return angle.next == analytic::NextImpact::other_end ? angle.angle * degrees_per_radian : NAN;
}

std::size_t column_count(const AnglesRequest& request) {
  return request.as_printed ? std::tuple_size_v<AnglesRow> : plain_columns;
}

/// θ is as given and the number of impacts is counted.
bool has_error(std::size_t column) { return column != 0 && column != impacts_column; }

std::vector<std::string> notes_of(const AnglesRequest& request) {
  std::vector<std::string> notes;
  if (request.as_printed)
    notes.emplace_back(
        "β: with the gravity term − (g/vₙ²)(…)²(θ+β)²; printed: with the paper's + (g/2vₙ²)(…)²(θ+β)²,"
        " whose sign and factor are wrong, for g of either sign.");
  else notes.emplace_back("θ, β, γ: contact angles of the first, second and third impact.");
  notes.emplace_back(
      "impacts: how many of the first three come with the ends in turn and at contact angles up to 90°. An empty cell: "
      "none comes so, because nothing strikes, the rod has turned past upright, or the same end strikes again first.");
  if (request.rod.gravity_number > 0 && request.rod.restitution > 0)
    notes.emplace_back("With gravity a later impact always comes: clatter sequence shows it.");
  if (const std::string warning = ratio_warning(request.rod); !warning.empty())
    notes.push_back("!: warning: " + warning);
  return notes;
}

/// The numbers of a row behind θ, β and γ [°], in both models' words for them.
AnglesRow row_of(double theta, double beta, double gamma, const auto& rod, const std::array<double, 2>& times,
                 const std::array<double, 2>& differences, int impacts) {
  return {theta,
          beta,
          gamma,
          rod.impulse[0],
          rod.impulse[1],
          rod.impulse[2],
          rod.velocity[0],
          rod.angular[0],
          rod.velocity[1],
          rod.angular[1],
          rod.velocity[2],
          rod.angular[2],
          times[0],
          times[1],
          differences[0],
          differences[1],
          static_cast<double>(impacts),
          NAN,
          NAN};
}

/// The row of one rod at one angle [°].
AnglesRow row_of(double theta, const analytic::RodParameters& rod, bool as_printed) {
  const analytic::Angle angle = analytic::Angle::from_degrees(theta);
  const analytic::ContactAngles a = analytic::contact_angles(angle, rod);
  const double beta = angle_or_missing(a.beta), gamma = angle_or_missing(a.gamma);
  AnglesRow row =
      row_of(theta, beta, gamma, a, {std::isnan(beta) ? NAN : a.beta.time, std::isnan(gamma) ? NAN : a.gamma.time},
             {a.gamma_minus_theta * degrees_per_radian, a.impulse_deficit}, a.impacts());
  if (!as_printed) return row;
  const double g = rod.gravity_number;
  row[plain_columns] = angle_or_missing(analytic::contact_angle_as_printed(angle, g));
  row[plain_columns + 1] = angle_or_missing(analytic::contact_angle_as_printed(angle, -g));
  return row;
}

/// The same by the batch, which is right but for the digits that γ − θ and 2 − ΣP have beyond it close to flat.
AnglesRow row_of(double theta, const analytic::RodContacts& rod) {
  const double gamma = rod.angle[1] * degrees_per_radian;
  return row_of(theta, rod.angle[0] * degrees_per_radian, gamma, rod, {rod.time[0], rod.time[1]},
                {gamma - theta, 2 - rod.impulse[0] - rod.impulse[1] - rod.impulse[2]}, rod.impacts);
}

/// Adds |Δvalue| over the relative change of one parameter, for each value; infinite where only one of the rods has it.
void add_sensitivity(const AnglesRow& row, const AnglesRow& neighbour, AnglesRow& sum) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (std::isnan(row[k])) continue;
    sum[k] += std::isnan(neighbour[k]) ? INFINITY : std::fabs(neighbour[k] - row[k]) / neighbour_shift;
  }
}

/// Adds what rows change by where θ is less by the part `shift`, of a rod with other parameters.
void add_sensitivities(const std::vector<AnglesRow>& rows, const analytic::RodParameters& rod, double shift,
                       bool as_printed, std::vector<AnglesRow>& sums) {
  std::vector<double> theta;
  for (const AnglesRow& row : rows) theta.push_back(row[0] * (1 - shift));
  std::vector<analytic::RodContacts> contacts(rows.size());
  if (!as_printed) analytic::batch_contact_angles(theta, rod, contacts);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool by_batch = !as_printed && theta[i] >= least_of_batch && !contacts[i].is_scalar;
    add_sensitivity(rows[i], by_batch ? row_of(theta[i], contacts[i]) : row_of(theta[i], rod, as_printed), sums[i]);
  }
}

/// Bounds on the errors of rows' numbers, after contact_angles(): 12 (2 + 2κ) ulp at most, κ from neighbouring rods
/// whose angle, G, e and μ_i differ; the sum of impulses cancels in the deficit unless the rod is elastic.
std::vector<AnglesRow> errors_of(const std::vector<AnglesRow>& rows, const AnglesRequest& request) {
  using Rod = analytic::RodParameters;
  std::vector<AnglesRow> sensitivities(rows.size(), AnglesRow{}), errors(rows.size(), AnglesRow{});
  add_sensitivities(rows, request.rod, neighbour_shift, request.as_printed, sensitivities);
  for (double Rod::*const parameter : {&Rod::gravity_number, &Rod::restitution, &Rod::impulse_ratio}) {
    const double neutral = parameter == &Rod::restitution ? 1 : 0;
    if (request.rod.*parameter == neutral) continue;
    Rod rod = request.rod;
    rod.*parameter *= 1 - neighbour_shift;
    add_sensitivities(rows, rod, 0, request.as_printed, sensitivities);
  }
  const bool elastic =
      request.rod.restitution == 1 && request.rod.impulse_ratio == 0 && request.rod.gravity_number == 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      const double size = k == deficit_column && !elastic ? 2 : std::fabs(rows[i][k]);
      errors[i][k] = 24 * std::numeric_limits<double>::epsilon() * (size + sensitivities[i][k]);
    }
  }
  return errors;
}

/// Calls use(row, errors) for rows `begin` … `end` − 1.
void for_known_rows(const AnglesRequest& request, long long begin, long long end, const auto& use) {
  constexpr long long part = 512;
  std::vector<AnglesRow> rows;
  for (; begin < end; begin += part) {
    rows.clear();
    for (long long i = begin; i < std::min(begin + part, end); ++i) rows.push_back(angles_row(request, i));
    const std::vector<AnglesRow> errors = errors_of(rows, request);
    for (std::size_t i = 0; i < rows.size(); ++i) use(rows[i], errors[i]);
  }
}

void add_rows(const AnglesRequest& request, long long begin, long long end, Grid& grid) {
  for_known_rows(request, begin, end, [&](const AnglesRow& row, const AnglesRow& errors) {
    Row& cells = grid.rows.emplace_back();
    for (std::size_t k = 0; k < column_count(request); ++k) {
      const bool is_exact = !has_error(k);
      cells.emplace_back(row[k], is_exact ? 17 : std::min(request.digits, known_digits(row[k], errors[k])));
      if (is_exact || std::isnan(row[k])) cells[k].shown = cells[k].value.text();
    }
    for (std::size_t k = 0; k < column_count(request); ++k) {
      if (has_error(k)) cells.emplace_back(rounded_up(errors[k]));
    }
  });
}

using Style = FigureCurve::Style;

constexpr long long most_with_points = 60;  // so few rows are marked on their curves
constexpr long long drawn_angles = 4000;    // of a curve: a branch shorter than a step between two would be missed
constexpr long long fineness = 1 << 20;     // angles between two of these: a curve ends no farther from its fold
using Existing = std::bitset<std::tuple_size_v<AnglesRow>>;

/// Which numbers a row has.
Existing existing(const AnglesRow& row) {
  Existing bits;
  for (std::size_t k = 0; k < row.size(); ++k) bits[k] = !std::isnan(row[k]);
  return bits;
}

/// A row with whether it is one of the table.
std::vector<double> as_vector(const AnglesRow& row, bool of_table = false) {
  std::vector<double> numbers(row.begin(), row.end());
  numbers.push_back(of_table ? 1 : 0);
  return numbers;
}

/// Adds the rows on both sides of each change in what exists between row `low`, which is there already, and `high`.
void add_ends(const AnglesRequest& request, long long low, long long high, std::vector<std::vector<double>>& rows) {
  const Existing at_high = existing(angles_row(request, high));
  for (Existing at_low = existing(angles_row(request, low)); at_low != at_high;) {
    long long last = low, next = high;
    while (next - last > 1) {
      const long long middle = last + (next - last) / 2;
      (existing(angles_row(request, middle)) == at_low ? last : next) = middle;
    }
    const AnglesRow other = angles_row(request, next);
    if (last != low) rows.push_back(as_vector(angles_row(request, last)));
    if (next == high) return;
    rows.push_back(as_vector(other));
    low = next;
    at_low = existing(other);
  }
}

/// The range of the table in steps so small that the curves reach their folds.
AnglesRequest finely(const AnglesRequest& request) {
  const double first = request.theta(0), last = request.theta(request.count - 1);
  constexpr long long steps = drawn_angles * fineness;
  AnglesRequest fine = request;
  fine.count = steps + 1;
  fine.theta = [first, last](long long i) {
    return i == steps ? last : first + (last - first) * static_cast<double>(i) / static_cast<double>(steps);
  };
  return fine;
}

/// Rows from the first angle to the last, close together and with the ends of each branch.
std::vector<std::vector<double>> curve_rows(const AnglesRequest& request) {
  std::vector<std::vector<double>> rows;
  if (request.count > 1) {
    const AnglesRequest fine = finely(request);
    rows.push_back(as_vector(angles_row(fine, 0)));
    for (long long i = 0; i + 1 < fine.count; i += fineness) {
      add_ends(fine, i, i + fineness, rows);
      rows.push_back(as_vector(angles_row(fine, i + fineness)));
    }
  }
  return rows;
}

/// The curves, and the rows of the table if they are so few that each is marked.
std::vector<std::vector<double>> with_marks(const AnglesRequest& request, std::vector<std::vector<double>> rows) {
  for (long long i = 0; request.count <= most_with_points && i < request.count; ++i)
    rows.push_back(as_vector(angles_row(request, i), true));
  return rows;
}

/// "γ, P₃ also in windows narrower than the step: …° to …°", of θ with such an impact between two rows of the table;
/// empty: none, or the rows are not in order.
/// @param rows  as curve_rows()
std::string narrow_windows(const AnglesRequest& request, const std::vector<std::vector<double>>& rows, bool third) {
  for (long long i = 1; i < request.count; ++i) {
    if (request.theta(i) < request.theta(i - 1)) return "";
  }
  std::string words;
  double begin = NAN, end = NAN;
  long long next = 0;  // row of the table that is not below `begin`
  const auto close = [&] {
    if (std::isnan(begin)) return;
    while (next < request.count && request.theta(next) < begin) ++next;
    if (next == request.count || request.theta(next) > end)
      words += fmt::format("{}{:.3f}° to {:.3f}°", words.empty() ? "" : ", ", begin, end);
    begin = NAN;
  };
  for (const std::vector<double>& row : rows) {
    if (std::isnan(row[third ? 2 : 1])) {
      close();
      continue;
    }
    if (std::isnan(begin)) begin = row[0];
    end = row[0];
  }
  close();
  if (words.empty()) return "";
  return fmt::format("{} also in windows narrower than the step: {}", third ? "γ, P₃" : "β, P₂", words);
}

std::vector<FigureColumn> figure_columns(const AnglesRequest& request) {
  std::vector<FigureColumn> columns;
  for (const Column& column : angles_columns(request))
    columns.push_back({column.name, column.unit.empty() ? "1" : column.unit, column.heading});
  columns.resize(std::tuple_size_v<AnglesRow>);  // the printed forms may be left out
  columns.push_back({"of_table", "1", "1: a row of the table, 0: between them"});
  return columns;
}

Range2 range_of(const AnglesRequest& request) {
  const double first = request.theta(0), last = request.theta(request.count - 1);
  return first < last ? Range2{first, last} : Range2{first - 1, last + 1};  // a point needs room about it
}

}  // namespace

Arguments angles_arguments(AnglesOptions& options) {
  Arguments rows = range_arguments(options.range, "angle theta in degrees (0 to 90 by 5)");
  for (Argument& row : rod_arguments(options.rod)) rows.push_back(std::move(row));
  rows.push_back({.name = "--as-printed",
                  .target = &options.as_printed,
                  .help = "beta by the paper's printed gravity term beside the corrected one",
                  .group = "Rod"});
  rows.push_back(whole_argument("--digits", options.digits, 1, 17, "N", "significant digits in tables (6)", "Output"));
  return rows;
}

AnglesRequest angles_request(const AnglesOptions& options) {
  const Sweep sweep = sweep_of(options.range, {0, 90, 5}, {0, 90, false, "from 0 to 90 degrees"});
  return {.theta = [sweep](long long i) { return sweep.value(i); },
          .count = sweep.count,
          .rod = rod_parameters(options.rod),
          .rod_words = rod_summary(options.rod),
          .as_printed = options.as_printed,
          .digits = options.digits};
}

std::vector<Column> angles_columns(const AnglesRequest& request) {
  const bool p = request.as_printed;
  const bool returns_all = request.rod.restitution == 1 && request.rod.gravity_number == 0;  // or ΣP need not be near 2
  std::vector<Column> columns{
      {"theta_deg", "θ", "°", "contact angle of impact 1"},
      {"beta_deg", "β", "°", "contact angle of impact 2"},
      {"gamma_deg", "γ", "°", "contact angle of impact 3", !p},
      {"P1", "P₁", "m|vₙ|", "impulse 1", !p},
      {"P2", "P₂", "m|vₙ|", "impulse 2", !p},
      {"P3", "P₃", "m|vₙ|", "impulse 3", !p},
      {"V1", "V₁", "|vₙ|", "normal velocity after impact 1", false},
      {"Omega1", "Ω₁", "|vₙ|/L", "angular velocity after impact 1", false},
      {"V2", "V₂", "|vₙ|", "normal velocity after impact 2", false},
      {"Omega2", "Ω₂", "|vₙ|/L", "angular velocity after impact 2", false},
      {"V3", "V₃", "|vₙ|", "normal velocity after impact 3", false},
      {"Omega3", "Ω₃", "|vₙ|/L", "angular velocity after impact 3", false},
      {"T1", "T₁", "L/|vₙ|", "from impact 1 to 2", false},
      {"T2", "T₂", "L/|vₙ|", "from impact 2 to 3", false},
      {"gamma_minus_theta_deg", "γ − θ", "°", "γ − θ", false},
      {"impulse_deficit", "2 − ΣP", "m|vₙ|", "2 less the sum of the impulses", !p && returns_all},
      {"impacts", "impacts", "",
       "how many of the first three come with the ends in turn and at contact angles up to 90°"},
      {"beta_printed_deg", "β printed, g > 0", "°", "β by the printed gravity term", p},
      {"beta_printed_negative_g_deg", "β printed, g < 0", "°", "the same for g of the other sign", p}};
  columns.resize(column_count(request));
  return columns;
}

AnglesRow angles_row(const AnglesRequest& request, long long i) {
  return row_of(request.theta(i), request.rod, request.as_printed);
}

Report angles_frame(const AnglesRequest& request) {
  const std::string range =
      request.count == 0
          ? "no θ"
          : fmt::format("θ from {}° to {}°, {} value{}", shortest(request.theta(0)),
                        shortest(request.theta(request.count - 1)), request.count, request.count == 1 ? "" : "s");
  Report report = begun_report("angles", "contact angles of the first three impacts");
  report.head = {request.rod_words + "; " + range};
  report.notes = notes_of(request);
  report.grid.columns = angles_columns(request);
  for (std::size_t k = 0; k < column_count(request); ++k) {
    if (has_error(k)) report.grid.columns.push_back(error_column(report.grid.columns[k]));
  }
  report.fields["model"] = "discrete";
  report.fields["parameters"] = rod_fields(request.rod);
  if (const std::string warning = ratio_warning(request.rod); !warning.empty())
    report.fields["warnings"] = std::vector<std::string>{warning};
  return report;
}

std::string angles_csv_rows(const AnglesRequest& request, long long begin, long long end) {
  constexpr std::size_t bytes_per_row = 360;
  const std::size_t count = column_count(request);
  std::string out;
  out.reserve(static_cast<std::size_t>(end - begin) * bytes_per_row);
  for_known_rows(request, begin, end, [&](const AnglesRow& row, const AnglesRow& errors) {
    for (std::size_t k = 0; k < count; ++k) {
      if (k > 0) out += ',';
      append_number(out, row[k]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (!has_error(k)) continue;
      out += ',';
      append_rounded_up(out, errors[k]);
    }
    out += '\n';
  });
  return out;
}

Report angles_report(const AnglesRequest& request) {
  Report report = angles_frame(request);
  add_rows(request, 0, request.count, report.grid);
  // Without gravity a rod that has turned past upright does not come down again, which makes the windows.
  const bool may_have_windows = request.rod.gravity_number > 0;
  const std::vector<std::vector<double>> rows =
      may_have_windows ? curve_rows(request) : std::vector<std::vector<double>>{};
  for (const bool third : {false, true}) {
    const std::string windows = request.as_printed && third ? "" : narrow_windows(request, rows, third);
    if (!windows.empty()) report.notes.push_back(windows);
  }
  report.fields["rows"] = row_objects(report.grid);
  return report;
}

/// What the axis of angles goes to [°]: 90, or, where strong gravity leaves β and γ small, somewhat more than they are.
double highest_angle(const std::vector<std::vector<double>>& curves) {
  double highest = 0;
  for (const std::vector<double>& row : curves) {
    for (const std::size_t angle : {1U, 2U}) highest = std::fmax(highest, row[angle]);
  }
  return highest > 0 && highest < 45 ? 1.1 * highest : 90;
}

Picture angles_picture(const AnglesRequest& request) {
  const bool alone = request.count == 1, marked = request.count <= most_with_points;
  const Range2 range = range_of(request);
  const std::vector<std::vector<double>> curves = curve_rows(request);
  const std::string second = narrow_windows(request, curves, false),
                    third = request.as_printed ? "" : narrow_windows(request, curves, true);
  PicturePanel angles{.columns = figure_columns(request),
                      .rows = with_marks(request, curves),
                      .plot = {.y_label = "contact angle [°]", .x = range, .y = {0, highest_angle(curves)}}};
  PicturePanel impulses{.columns = angles.columns,
                        .rows = angles.rows,
                        .plot = {.x_label = "contact angle θ of the first impact [°]",
                                 .y_label = "normal impulse [m|vₙ|]",
                                 .x = range,
                                 .y = {0, no_number}}};
  // A curve, and marks of its colour at the rows of the table.
  const auto add = [&](PicturePanel& panel, const char* column, const char* legend, const char* colour) {
    FigureCurve curve{.x = "theta_deg", .y = column, .legend = legend, .where = {{"of_table", 0}}, .colour = colour};
    if (!alone) panel.plot.curves.push_back(curve);
    curve.style = alone ? Style::marks : Style::points;
    curve.where = {{"of_table", 1}};
    if (!alone) curve.legend = "";
    if (marked) panel.plot.curves.push_back(curve);
  };
  add(angles, "beta_deg", second.empty() ? "β, second impact" : "β, second impact; windows", palette::beta);
  if (request.as_printed) {
    add(angles, "beta_printed_deg", "β as printed, g > 0", palette::ochre);
    add(angles, "beta_printed_negative_g_deg", "β as printed, g < 0", palette::sky);
  } else {
    add(angles, "gamma_deg", third.empty() ? "γ, third impact" : "γ, third impact; windows", palette::gamma);
  }
  add(impulses, "P1", "P₁", palette::ink);
  add(impulses, "P2", second.empty() ? "P₂" : "P₂; windows", palette::beta);
  if (!request.as_printed) add(impulses, "P3", third.empty() ? "P₃" : "P₃; windows", palette::gamma);
  std::vector<std::string> scene{request.rod_words};
  for (const std::string& windows : {second, third}) {
    if (!windows.empty()) scene.push_back(windows);
  }
  return {
      .what = "Contact angles and impulses of the first three impacts", .scene = scene, .panels = {angles, impulses}};
}

}  // namespace clatter::validation
