// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "validation/output/number.hpp"
#include "validation/reports/measured_notes.hpp"

namespace clatter::validation::inline reports {
namespace {

/// 95 % interval of a share (Wilson).
std::pair<double, double> share_interval(const Share& share) {
  constexpr double z = 1.96;
  const double n = share.of, p = share.value(), middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {std::fmax(middle - half, 0), std::fmin(middle + half, 1)};  // rounding must not leave what a share can be
}

Row error_row(const std::string& group, const std::string& name, const std::vector<double>& errors) {
  const auto percent = [&](double share) { return Cell(100 * quantile(errors, share), 3); };
  return {Cell(group), Cell(name), percent(0.5), percent(0.25), percent(0.75), percent(0.9), Cell(errors.size())};
}

Row share_row(const std::string& group, const std::string& name, const Share& share) {
  const auto [low, high] = share_interval(share);
  return {Cell(group),   Cell(name),    Cell(100 * share.value(), 3), Cell(100 * low, 3), Cell(100 * high, 3),
          Cell(Value()), Cell(share.of)};
}

void add_score_rows(const Scores& scores, Report& report) {
  auto& rows = report.grid.rows;
  for (const ErrorRow& row : scores.rows) rows.push_back(error_row("velocity", row.name, row.errors));
  rows.push_back(error_row("impact 2", "time", scores.time_errors));
  rows.push_back(error_row("impact 2", "P2/P1", scores.ratio_errors));
  const auto put = [&](const std::string& name, const Share& share) {
    if (share.of > 0) rows.push_back(share_row("right", name, share));
  };
  put("point impacts", scores.points);
  put("first corner", scores.first_corner);
  put("second corner", scores.second_corner);
  put("… the start leaves no doubt", scores.second_corner_sure);
  put("… nor does the law's scatter", scores.second_corner_clear);
  put("… from V and Ω as measured", scores.second_corner_flown);
  put("inside 90 % intervals", scores.inside);
  put("face at rest", scores.face);
  put("… by published parameters", scores.published_face);
  put("number of impacts within 1", scores.count);
  for (const ResidualBin& bin : scores.bins) {
    rows.push_back({Cell("by " + bin.quantity),
                    Cell(fmt::format("{} to {} {}", shortest(bin.low), shortest(bin.high), bin.unit)),
                    Cell(100 * bin.error, 3), Cell(Value()), Cell(Value()), Cell(Value()), Cell(bin.points)});
  }
}

Value bins_value(const Scores& scores) {
  Value bins = Value::List{};
  for (const ResidualBin& bin : scores.bins) {
    bins.push_back(Value::Fields{{"quantity", bin.quantity},
                                 {"unit", bin.unit},
                                 {"from", bin.low},
                                 {"to", bin.high},
                                 {"impacts", bin.impacts},
                                 {"points", bin.points},
                                 {"error", bin.error},
                                 {"lever_miss", bin.lever},
                                 {"restitution", bin.restitution}});
  }
  return bins;
}

std::string bin_words(const Scores& scores) {
  std::string words = "point impacts by angle between arm and vertical:";
  for (const ResidualBin& bin : scores.bins) {
    if (bin.quantity != "angle") continue;
    words += fmt::format(" {}–{}° {} of {}, e {};", shortest(bin.low), shortest(bin.high), bin.points, bin.impacts,
                         bin.points > 0 ? significant(bin.restitution, 2) : "–");
  }
  words.back() = '.';
  return words;
}

}  // namespace

std::vector<Column> measured_score_columns() {
  return {word_column("group", "of", "what is scored"),
          word_column("quantity", "quantity", "the model or the number"),
          {"value", "middle", "%", "median of the relative errors, or the share that is right"},
          {"low", "from", "%", "lower quartile of the errors, or lower end of the share's 95 % interval"},
          {"high", "to", "%", "upper quartile, or upper end"},
          {"ninety", "90 %", "%", "ninetieth percentile of the errors"},
          {"drops", "drops", "", "that were counted"}};
}

Report measured_score_report(const MeasuredRun& run, const Scores& scores) {
  Report report = begun(run, "score", "predictions held against drops that were not fitted to");
  report.grid.columns = measured_score_columns();
  add_score_rows(scores, report);
  report.notes = {
      "law as fitted: " + law_words(run.fit.laws[run.fit.best].law),
      "velocity: error of (V, k Ω) after impact 1 over its size before, k² = I/m of the uniform body; point "
      "impacts alone; floor: the best impulse inside the friction cone",
      bin_words(scores), calibration_note(run)};
  for (const std::string& note : track_notes(run)) report.notes.push_back(note);
  report.fields["scores"] = row_objects(report.grid);
  report.fields["residuals"] = bins_value(scores);
  report.fields["law"] = law_words(run.fit.laws[run.fit.best].law);
  return report;
}

}  // namespace clatter::validation::inline reports
