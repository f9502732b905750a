#include "validation/cli/angles_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "validation/cli/options.hpp"
#include "validation/cli/rod_options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;
using analytic::NextImpact;

constexpr std::size_t plain_columns = 17, impacts_column = 16, deficit_column = 15;
constexpr double neighbour_shift = 0x1p-30;  // between rounding and the curvature of the results

/// What may be given.
struct AnglesTexts {
  SweepTexts range;
  RodTexts rod;
  std::optional<std::string> digits, as_printed;
};

using AnglesText = std::optional<std::string>& (*)(AnglesTexts&);

/// Where the text of each argument goes.
const std::map<std::string, AnglesText> members{{"from", [](AnglesTexts& texts) -> auto& {return texts.range.from;
}  // namespace
}  // namespace clatter::validation
, {"to", [](AnglesTexts& texts) -> auto& {return texts.range.to;
}
}
, {"step", [](AnglesTexts& texts) -> auto& {return texts.range.step;
}
}
, {"count", [](AnglesTexts& texts) -> auto& {return texts.range.count;
}
}
, {"gravity_number", [](AnglesTexts& texts) -> auto& {return texts.rod.gravity_number;
}
}
, {"gravity", [](AnglesTexts& texts) -> auto& {return texts.rod.gravity;
}
}
, {"length", [](AnglesTexts& texts) -> auto& {return texts.rod.length;
}
}
, {"speed", [](AnglesTexts& texts) -> auto& {return texts.rod.speed;
}
}
, {"restitution", [](AnglesTexts& texts) -> auto& {return texts.rod.restitution;
}
}
, {"impulse_ratio", [](AnglesTexts& texts) -> auto& {return texts.rod.impulse_ratio;
}
}
, {"digits", [](AnglesTexts& texts) -> auto& {return texts.digits;
}
}
, {
  "as_printed", [](AnglesTexts & texts) -> auto& { return texts.as_printed; }
}
}
;

double angle_or_missing(const analytic::ContactAngle& angle) {
  return angle.next == NextImpact::other_end ? angle.angle * degrees_per_radian : NAN;
}

std::size_t column_count(const AnglesRequest& request) {
  return request.as_printed ? std::tuple_size_v<AnglesRow> : plain_columns;
}

/// θ is as given and the number of impacts is counted.
bool has_error(std::size_t column) { return column != 0 && column != impacts_column; }

std::vector<std::string> notes_of(const AnglesRequest& request) {
  if (!request.as_printed)
    return {"An empty cell: that impact does not happen, comes with β, γ > 90°, or after another one."};
  return {
      "β: with the gravity term − (g/vₙ²)(…)²(θ+β)²; printed: with the paper's + (g/2vₙ²)(…)²(θ+β)²,"
      " whose sign and factor are wrong, for g of either sign. An empty cell: no such impact."};
}

}  // namespace

AnglesRequest angles_request(const NamedTexts& given) {
  AnglesTexts texts;
  for (const auto& [name, text] : given) named(members, name)(texts) = text;
  const Sweep sweep = read_sweep(texts.range, {0, 90, 5}, {0, 90, false, "from 0 to 90 degrees"});
  return {.theta = [sweep](long long i) { return sweep.value(i); },
          .count = sweep.count,
          .rod = read_rod(texts.rod),
          .as_printed = read_name_option("--as-printed", texts.as_printed.value_or("false"), {"false", "true"}) == 1,
          .digits = texts.digits ? read_integer_option("--digits", *texts.digits, 1, 17) : 6};
}

std::vector<Column> angles_columns(const AnglesRequest& request) {
  const bool p = request.as_printed;
  std::vector<Column> columns{{"theta_deg", "θ", "°"},
                              {"beta_deg", "β", "°"},
                              {"gamma_deg", "γ", "°", !p},
                              {"P1", "P₁", "", !p},
                              {"P2", "P₂", "", !p},
                              {"P3", "P₃", "", !p},
                              {"V1", "V₁", "", false},
                              {"Omega1", "Ω₁", "", false},
                              {"V2", "V₂", "", false},
                              {"Omega2", "Ω₂", "", false},
                              {"V3", "V₃", "", false},
                              {"Omega3", "Ω₃", "", false},
                              {"T1", "T₁", "", false},
                              {"T2", "T₂", "", false},
                              {"gamma_minus_theta_deg", "γ − θ", "°", false},
                              {"impulse_deficit", "2 − ΣP", "", !p},
                              {"impacts", "impacts", ""},
                              {"beta_printed_deg", "β printed, g > 0", "°", p},
                              {"beta_printed_negative_g_deg", "β printed, g < 0", "°", p}};
  columns.resize(column_count(request));
  return columns;
}

namespace {

/// The row of one rod at one angle [°].
AnglesRow row_of(double theta, const analytic::RodParameters& rod, bool as_printed) {
  const analytic::Angle angle = analytic::Angle::from_degrees(theta);
  const analytic::ContactAngles a = analytic::contact_angles(angle, rod);
  const double beta = angle_or_missing(a.beta);
  const double gamma = angle_or_missing(a.gamma);
  AnglesRow row{theta,
                beta,
                gamma,
                a.impulse[0],
                a.impulse[1],
                a.impulse[2],
                a.velocity[0],
                a.angular[0],
                a.velocity[1],
                a.angular[1],
                a.velocity[2],
                a.angular[2],
                std::isnan(beta) ? NAN : a.beta.time,
                std::isnan(gamma) ? NAN : a.gamma.time,
                a.gamma_minus_theta * degrees_per_radian,
                a.impulse_deficit,
                static_cast<double>(a.impacts()),
                NAN,
                NAN};
  if (!as_printed) return row;
  const double g = rod.gravity_number;
  row[plain_columns] = angle_or_missing(analytic::contact_angle_as_printed(angle, g));
  row[plain_columns + 1] = angle_or_missing(analytic::contact_angle_as_printed(angle, -g));
  return row;
}

/// Adds |Δvalue| over the relative change of one parameter, for each value; infinite where only one of the rods has it.
void add_sensitivity(const AnglesRow& row, const AnglesRow& neighbour, AnglesRow& sum) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (std::isnan(row[k])) continue;
    sum[k] += std::isnan(neighbour[k]) ? INFINITY : std::fabs(neighbour[k] - row[k]) / neighbour_shift;
  }
}

/// Bounds on the errors of a row's numbers, after contact_angles(): 12 (2 + 2κ) ulp at most, κ from neighbouring rods
/// whose angle, G, e and μ_i differ; the sum of impulses cancels in the deficit unless the rod is elastic.
AnglesRow errors_of(const AnglesRow& row, const AnglesRequest& request) {
  const double theta = row[0];
  const auto neighbour = [&](double angle, double analytic::RodParameters::*changed) {
    analytic::RodParameters rod = request.rod;
    if (changed) rod.*changed *= 1 - neighbour_shift;
    return row_of(angle, rod, request.as_printed);
  };
  using Rod = analytic::RodParameters;
  AnglesRow sensitivity{};
  if (theta > 0) add_sensitivity(row, neighbour(theta * (1 - neighbour_shift), nullptr), sensitivity);
  for (double Rod::*const parameter : {&Rod::gravity_number, &Rod::restitution, &Rod::impulse_ratio}) {
    const double neutral = parameter == &Rod::restitution ? 1 : 0;
    if (request.rod.*parameter != neutral) add_sensitivity(row, neighbour(theta, parameter), sensitivity);
  }
  const bool elastic =
      request.rod.restitution == 1 && request.rod.impulse_ratio == 0 && request.rod.gravity_number == 0;
  AnglesRow errors{};
  for (std::size_t k = 0; k < row.size(); ++k) {
    const double size = k == deficit_column && !elastic ? 2 : std::fabs(row[k]);
    errors[k] = 24 * std::numeric_limits<double>::epsilon() * (size + sensitivity[k]);
  }
  return errors;
}

}  // namespace

AnglesRow angles_row(const AnglesRequest& request, long long i) {
  return row_of(request.theta(i), request.rod, request.as_printed);
}

namespace {

struct KnownRow {
  AnglesRow value, error;
};

KnownRow known_row(const AnglesRequest& request, long long i) {
  const AnglesRow row = angles_row(request, i);
  return {row, errors_of(row, request)};
}

}  // namespace

Table angles_frame(const AnglesRequest& request) {
  const std::string range = request.count == 0 ? "no θ"
                                               : fmt::format("θ from {}° to {}°, {} values", shortest(request.theta(0)),
                                                             shortest(request.theta(request.count - 1)), request.count);
  return {.head = {headline("angles", "contact angles of the first three impacts"),
                   rod_summary(request.rod) + "; " + range},
          .columns = angles_columns(request),
          .rows = {},
          .notes = notes_of(request)};
}

Table angles_csv_frame(const AnglesRequest& request) {
  Table frame = angles_frame(request);
  const std::vector<Column> values = frame.columns;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (has_error(k)) frame.columns.push_back({values[k].name + "_error", values[k].name + "_error", values[k].unit});
  }
  return frame;
}

Table angles_records(const AnglesRequest& request) {
  Table table = angles_csv_frame(request);
  const auto cell = [](double number) { return std::isfinite(number) ? Cell(number + 0.0, 17) : Cell(); };
  for (long long i = 0; i < request.count; ++i) {
    const auto [row, errors] = known_row(request, i);
    auto& cells = table.rows.emplace_back();
    for (std::size_t k = 0; k < column_count(request); ++k) cells.push_back(cell(row[k]));
    for (std::size_t k = 0; k < column_count(request); ++k) {
      if (has_error(k)) cells.push_back(cell(errors[k]));
    }
  }
  return table;
}

Table angles_table(const AnglesRequest& request) {
  Table table = angles_frame(request);
  for (long long i = 0; i < request.count; ++i) {
    const auto [row, errors] = known_row(request, i);
    auto& cells = table.rows.emplace_back();
    for (std::size_t k = 0; k < column_count(request); ++k) {
      const Cell known(row[k], std::min(request.digits, known_digits(row[k], errors[k])));
      cells.push_back(std::isnan(row[k]) ? Cell() : known);
    }
    cells[impacts_column] = Cell(std::to_string(static_cast<int>(row[impacts_column])));
    cells[0] = Cell(shortest(row[0]));
  }
  return table;
}

Json angles_json(const AnglesRequest& request) {
  const std::vector<Column> columns = angles_columns(request);
  Json rows = Json::array();
  for (long long i = 0; i < request.count; ++i) {
    const auto [row, errors] = known_row(request, i);
    Json item = Json::object();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      item[columns[k].name] = k == impacts_column ? Json(static_cast<int>(row[k])) : number_or_null(row[k]);
      if (has_error(k)) item["error_estimate"][columns[k].name] = number_or_null(errors[k]);
    }
    rows.push_back(item);
  }
  return {{"clatter", version}, {"model", "discrete"}, {"parameters", rod_json(request.rod)}, {"rows", rows}};
}

std::string angles_csv_rows(const AnglesRequest& request, long long begin, long long end) {
  fmt::memory_buffer out;
  const auto append = [&](double number) {
    if (std::isfinite(number)) fmt::format_to(std::back_inserter(out), "{}", number + 0.0);
  };
  for (long long i = begin; i < end; ++i) {
    const auto [row, errors] = known_row(request, i);
    for (std::size_t k = 0; k < column_count(request); ++k) {
      if (k > 0) out.push_back(',');
      append(row[k]);
    }
    for (std::size_t k = 0; k < column_count(request); ++k) {
      if (!has_error(k)) continue;
      out.push_back(',');
      append(errors[k]);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace clatter::validation
