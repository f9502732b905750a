// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/measured_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/output/number.hpp"
#include "validation/reports/measured_notes.hpp"

namespace clatter::validation::inline reports {
namespace {

/// "+-+": the signs of a corner's coordinates in the body's axes.
std::string corner_name(const TrackedBody& body, int corner) {
  std::string name;
  for (const double part : body.sharp().vertices[static_cast<std::size_t>(corner)]) {
    if (part != 0) name += part > 0 ? '+' : '-';
  }
  return name;
}

/// "+x": the face's outward normal.
std::string face_name(const TrackedBody& body, std::size_t face) {
  const Vector3& normal = body.faces()[face];
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] != 0) return std::string(normal[axis] > 0 ? "+" : "-") + "xyz"[axis];
  }
  return "";
}

Row law_row(const std::string& name, const LawFit& law, const PairedDifference& above) {
  const Cell nothing{Value()};
  return {Cell(name),
          Cell(law.law.restitution, 3),
          Cell(law.fit.half_width(0), 2),
          law.slope ? Cell(law.law.slope, 3) : nothing,
          law.slope ? Cell(law.fit.half_width(2), 2) : nothing,
          Cell(law.law.friction, 3),
          Cell(law.fit.half_width(1), 2),
          Cell(1e4 * law.fit.loss(), 4),
          Cell(1e4 * above.mean, 2),
          Cell(1e4 * above.error, 2),
          Cell(law.impacts)};
}

std::string preference_words(const MeasuredFit& fit) {
  std::string words = fmt::format("least loss: {}", fitted_law_name(fit.laws[fit.best].law.law));
  for (std::size_t i = 0; i < fit.laws.size(); ++i) {
    if (i == fit.best) continue;
    words += fmt::format("; {} is {}", fitted_law_name(fit.laws[i].law.law),
                         fit.against_best[i].is_clear() ? "clearly worse" : "not told apart from it");
  }
  return words + (fit.dependent_gain.is_clear() ? "; restitution depends on the corner's effective mass"
                                                : "; no dependence on the corner's effective mass can be told");
}

std::string contact_words(const MeasuredFit& fit) {
  return fmt::format(
      "contact lasts about {} ± {} ms, from the share of impacts that a frame was caught in: below a frame, so "
      "that k_G and c_G cannot be told apart from e",
      significant(1e3 * fit.contact_time, 2), significant(1e3 * fit.contact_time_error, 1));
}

}  // namespace

std::vector<Column> measured_fit_columns() {
  return {word_column("model", "law", "impact law, and what it is fitted with"),
          {"restitution", "e", "", "coefficient of restitution, or e0 where it depends on the effective mass"},
          {"restitution_half_width", "±", "", "half the 95 % interval of the restitution"},
          {"slope", "e₁", "", "change of e with the corner's effective mass over the mass"},
          {"slope_half_width", "±", "", "half the 95 % interval of the slope"},
          {"friction", "μ", "", "Coulomb's coefficient"},
          {"friction_half_width", "±", "", "half the 95 % interval of the friction"},
          {"loss", "loss", "1e-4", "mean pseudo-Huber loss of the relative errors"},
          {"loss_above", "above", "1e-4", "mean loss above that of the best pure law, drop by drop"},
          {"loss_above_error", "±", "1e-4", "standard error of that", false},
          {"impacts", "impacts", "", "point impacts fitted to", false}};
}

std::vector<Column> measured_predict_columns() {
  std::vector<Column> columns{
      word_column("drop", "drop", "its name in the file"),
      {"point", "point", "", "whether one impulse at the corner explains the impact"},
      word_column("corner", "corner", "predicted to strike first, signs of its body coordinates"),
      word_column("corner_measured", "seen", "about which the momentum is kept best"),
      {"certainty", "certain", "%", "share of the start's samples that agree on the corner", false},
      {"angle", "angle", "°", "between the corner's arm and the vertical"}};
  for (const char* name : {"v_x", "v_y", "v_z", "k_omega_x", "k_omega_y", "k_omega_z"}) {
    const std::string part = name;
    columns.push_back({part, part, "m/s", "after impact 1, predicted", false});
    columns.push_back({part + "_half_width", "", "m/s", "half the 90 % interval", false});
    columns.push_back({part + "_measured", "", "m/s", "after impact 1, measured", false});
  }
  const std::vector<Column> rest{
      {"error", "error", "%", "of the motion after impact 1, over the motion before"},
      word_column("next_corner", "next", "corner that strikes second, predicted"),
      word_column("next_corner_measured", "seen", "the same, measured"),
      {"next_time", "after", "ms", "time from impact 1 to impact 2, predicted"},
      {"next_time_half_width", "", "ms", "half the 90 % interval from the start's uncertainty", false},
      {"next_time_measured", "seen", "ms", "the same, measured"},
      {"impulse_ratio", "", "", "normal impulse of impact 2 over that of impact 1, predicted", false},
      {"impacts", "", "", "predicted that flights of three frames or more follow", false},
      {"impacts_measured", "", "", "impacts found", false},
      word_column("face", "face", "that lies down at rest, predicted"),
      word_column("face_measured", "seen", "the same, measured"),
      word_column("outcome", "", "of the predicted sequence")};
  columns.insert(columns.end(), rest.begin(), rest.end());
  columns.back().shown = false;
  return columns;
}

Report measured_fit_report(const MeasuredRun& run) {
  Report report = begun(run, "fit", "impact laws fitted to tracked drops");
  const MeasuredFit& fit = run.fit;
  report.grid.columns = measured_fit_columns();
  for (std::size_t i = 0; i < fit.laws.size(); ++i)
    report.grid.rows.push_back(law_row(fitted_law_name(fit.laws[i].law.law), fit.laws[i], fit.against_best[i]));
  const std::string best = fitted_law_name(fit.laws[fit.best].law.law);
  report.grid.rows.push_back(
      law_row(best + ", e(ν)", fit.dependent, {-fit.dependent_gain.mean, fit.dependent_gain.error}));
  report.grid.rows.push_back(law_row(best + ", described", fit.described, {std::nan(""), std::nan("")}));
  report.notes = {preference_words(fit), calibration_note(run), contact_words(fit)};
  for (const std::string& note : track_notes(run)) report.notes.push_back(note);
  report.notes.emplace_back("e(ν) = e + e₁ ν, ν = 1/(m W_nn); described: body uniform, sharp, its axes as tracked");
  report.fields["fits"] = row_objects(report.grid);
  report.fields["best"] = best;
  report.fields["contact_time"] = fit.contact_time;
  report.fields["contact_time_error"] = fit.contact_time_error;
  report.fields["message"] = preference_words(fit);
  return report;
}

Report measured_predict_report(const MeasuredRun& run, const Scores& scores) {
  Report report = begun(run, "predict", "first impacts predicted from the motion before");
  report.grid.columns = measured_predict_columns();
  const ForecastModel model = forecast_model(run.file, run.fit);
  const TrackedBody& body = model.body;
  for (const ScoredDrop& drop : scores.drops) {
    const Forecast& p = drop.predicted;
    Row row{Cell(drop.name),
            Cell(drop.measured.is_point),
            Cell(corner_name(body, p.corner)),
            Cell(corner_name(body, drop.measured.momentum_corner)),
            Cell(100 * p.certainty, 3),
            Cell(drop.measured.angle_degrees(), 3)};
    const MotionParts predicted = motion_parts(body, p.after), measured = motion_parts(body, drop.measured.after.state);
    for (int part = 0; part < 6; ++part) {
      for (const double number : {predicted[part], p.half_width[part], measured[part]}) row.emplace_back(number);
    }
    const Cell nothing{Value()};
    row.emplace_back(100 * drop.error, 3);
    row.push_back(p.next ? Cell(corner_name(body, p.next->corner)) : nothing);
    row.push_back(drop.second ? Cell(corner_name(body, drop.second->corner)) : nothing);
    row.push_back(p.next ? Cell(1e3 * p.next->time, 3) : nothing);
    row.push_back(p.next ? Cell(1e3 * p.next->time_half_width, 2) : nothing);
    row.push_back(drop.second ? Cell(1e3 * (drop.second->time - drop.measured.time), 3) : nothing);
    row.push_back(p.next ? Cell(p.next->impulse_ratio) : nothing);
    row.push_back(p.end ? Cell(p.end->impacts) : nothing);
    row.emplace_back(drop.measured_impacts);
    row.push_back(p.end ? Cell(face_name(body, p.end->face)) : nothing);
    row.push_back(drop.face ? Cell(face_name(body, *drop.face)) : nothing);
    row.push_back(p.end ? Cell(p.end->outcome) : nothing);
    report.grid.rows.push_back(std::move(row));
  }
  report.notes = {"law: " + law_words(model.law), calibration_note(run)};
  report.fields["drops"] = row_objects(report.grid);
  report.fields["law"] = law_words(model.law);
  return report;
}

}  // namespace clatter::validation::inline reports
