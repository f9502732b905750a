// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/measured_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {
namespace {

std::string mm(double metres) { return significant(1e3 * metres, 3); }

std::vector<std::string> body_head(const TrackDescription& d) {
  if (d.is_ball()) return {fmt::format("body: ball of radius {} m, {} kg", shortest(d.radius), shortest(d.mass))};
  const auto three = [](const Vector3& v, auto number) {
    return fmt::format("{} × {} × {} m", number(v.x()), number(v.y()), number(v.z()));
  };
  if (!d.mesh) return {fmt::format("body: box {}, {} kg", three(d.size, shortest), shortest(d.mass))};
  const std::size_t corners = d.mesh->body.vertices.size(), faces = d.mesh->faces.size();
  std::vector<std::string> head{fmt::format("body: {}, extents {}, {} kg; {} corners touch, {} {} to lie on",
                                            d.mesh->name, three(d.size, [](double x) { return significant(x, 4); }),
                                            shortest(d.mass), corners, faces, faces == 1 ? "face" : "faces")};
  if (!d.mesh->words.empty()) head.push_back(d.mesh->words);
  return head;
}

std::vector<std::string> tracks_head(const MeasuredRun& run) {
  const TrackDescription& d = run.file.file.description;
  std::vector<std::string> head{fmt::format("{}: {} drops, {} frames at {} Hz, motion in {}", run.file.file.path,
                                            run.file.file.tracks.size(), run.file.file.frames,
                                            d.time.empty() ? shortest(d.rate) : significant(d.rate, 6),
                                            d.is_planar() ? "a plane" : "space")};
  for (const std::string& line : body_head(d)) head.push_back(line);
  head.push_back("poses: " + d.frame_words());
  head.push_back(run.split_words);
  if (!d.source.empty()) head.push_back(fmt::format("data: {} ({})", d.source, d.licence));
  return head;
}

struct TrackCounts {
  std::size_t torn = 0, missing = 0, skipped = 0, disturbed = 0, impacts = 0, at_rest = 0, without = 0;
};

TrackCounts count_tracks(const MeasuredFile& file) {
  TrackCounts counts;
  for (const MeasuredTrack& track : file.tracks) {
    counts.torn += track.flights.torn.size();
    counts.missing += static_cast<std::size_t>(track.missing);
    counts.impacts += track.meetings.size();
    if (track.rest) ++counts.at_rest;
    if (track.meetings.empty()) ++counts.without;
    for (const Meeting& change : track.other_changes)
      ++(change.change == Change::skipped ? counts.skipped : counts.disturbed);
  }
  return counts;
}

/// Without what a body of this kind has not: a ball's axes, the rounding of corners but of a box.
Value calibration_value(const CalibrationResult& c, const TrackDescription& d) {
  Value value = Value::Fields{};
  if (!d.is_ball()) {
    const Vector3& turn = c.calibration.turn;
    value["turn"] = std::vector<double>{turn.x(), turn.y(), turn.z()};
    value["turn_error"] = rounded_up(c.turn_error);
    value["resting"] = c.resting;
  }
  value["ground"] = c.calibration.ground;
  value["ground_spread"] = c.ground_spread;
  value["inertia_factor"] = c.calibration.inertia_factor;
  value["inertia_half_width"] = c.inertia_half_width;
  if (d.is_box()) {
    value["rounding"] = c.calibration.rounding;
    value["rounding_half_width"] = c.rounding_half_width;
  }
  value["turning_unexplained_before"] = c.lever_before;
  value["turning_unexplained"] = c.lever_after;
  return value;
}

/// What the frames and flights say of themselves.
std::vector<std::string> track_notes(const MeasuredRun& run) {
  const FlightModel& model = run.file.model;
  const TrackCounts counts = count_tracks(run.file);
  return {
      fmt::format("frames: noise {} mm and {} mrad; {} torn, {} missing; {} times a flight goes on after samples that "
                  "are not counted, {} times it is disturbed away from the ground",
                  mm(model.noise.position), significant(1e3 * model.noise.rotation, 2), counts.torn, counts.missing,
                  counts.skipped, counts.disturbed),
      fmt::format("flights: {} impacts found; {} drops end at rest, {} have no impact; gravity along the fall {} ± {} "
                  "m/s² between drops",
                  counts.impacts, counts.at_rest, counts.without, significant(model.gravity.mean, 3),
                  significant(model.gravity.spread, 2))};
}

/// The calibration in words: what a body of this kind has of it.
std::string calibration_note(const MeasuredRun& run) {
  const CalibrationResult& c = run.fit.calibration;
  const TrackDescription& d = run.file.file.description;
  std::string words = "calibration on the fitted drops: ";
  if (!d.is_ball()) {
    words += fmt::format("body axes turned by ({}, {}, {}) mrad ± {} ({} resting poses); ",
                         significant(1e3 * c.calibration.turn.x(), 3), significant(1e3 * c.calibration.turn.y(), 3),
                         significant(1e3 * c.calibration.turn.z(), 3), significant(1e3 * c.turn_error, 2), c.resting);
  }
  words += fmt::format("ground at {} ± {} mm; inertia {} ± {} of the uniform body's; ", mm(c.calibration.ground),
                       mm(c.ground_spread), significant(c.calibration.inertia_factor, 3),
                       significant(c.inertia_half_width, 2));
  if (d.is_box())
    words += fmt::format("corners rounded by {} ± {} mm; ", mm(c.calibration.rounding), mm(c.rounding_half_width));
  if (d.mesh) words += "corners as the mesh has them; ";
  return words +
         fmt::format("turning unexplained {} → {}", significant(c.lever_before, 2), significant(c.lever_after, 2));
}

/// A report with what every one of a run carries: its head, the data, the split, the calibration.
Report begun(const MeasuredRun& run, const std::string& action, const std::string& what) {
  Report report = begun_report("measured " + action, what);
  report.head = tracks_head(run);
  report.fields["model"] = "measured";
  const TrackDescription& d = run.file.file.description;
  const TrackCounts counts = count_tracks(run.file);
  report.fields["data"] = Value::Fields{{"file", run.file.file.path},
                                        {"description", d.path},
                                        {"source", text_or_nothing(d.source)},
                                        {"licence", text_or_nothing(d.licence)},
                                        {"drops", run.file.file.tracks.size()},
                                        {"frames", run.file.file.frames},
                                        {"torn", counts.torn},
                                        {"missing", counts.missing},
                                        {"skipped", counts.skipped},
                                        {"disturbed", counts.disturbed},
                                        {"impacts", counts.impacts},
                                        {"noise_position", run.file.model.noise.position},
                                        {"noise_rotation", run.file.model.noise.rotation},
                                        {"gravity", run.file.model.gravity.mean},
                                        {"gravity_spread", run.file.model.gravity.spread}};
  report.fields["split"] = run.split_words;
  report.fields["fitted"] = run.split.fitted.size();
  report.fields["scored"] = run.split.scored.size();
  report.fields["calibration"] = calibration_value(run.fit.calibration, d);
  return report;
}

/// "poisson, e = 0.47, μ = 0.097".
std::string law_words(const FittedLaw& law) {
  return fmt::format("{}, e = {}, μ = {}", law_name(law.law), significant(law.restitution, 3),
                     significant(law.friction, 3));
}

/// "+-+": the signs of a corner's coordinates in the axes of a box; the number of a mesh's corner, as `sequence` has
/// it.
std::string corner_name(const MeasuredRun& run, const TrackedBody& body, int corner) {
  const TrackDescription& d = run.file.file.description;
  if (d.is_ball()) return "ball";
  if (d.mesh) return std::to_string(corner + 1);
  std::string name;
  for (const double part : body.sharp().vertices[static_cast<std::size_t>(corner)]) {
    if (part != 0) name += part > 0 ? '+' : '-';
  }
  return name;
}

/// The face's outward normal: "+x" of a box, "(0.58, -0.58, 0.58)" of a mesh.
std::string face_name(const MeasuredRun& run, const TrackedBody& body, std::size_t face) {
  const Vector3& normal = body.faces()[face];
  if (run.file.file.description.mesh) {
    const Vector3 shown = (normal.array().abs() < 0.005).select(0, normal);  // no "-0.00"
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", shown.x(), shown.y(), shown.z());
  }
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
          Cell(rounded_up(1e4 * above.error), 2),
          Cell(law.impacts)};
}

std::string preference_words(const MeasuredFit& fit) {
  std::string words = fmt::format("least loss: {}", law_name(fit.laws[fit.best].law.law));
  for (std::size_t i = 0; i < fit.laws.size(); ++i) {
    if (i == fit.best) continue;
    words += fmt::format("; {} is {}", law_name(fit.laws[i].law.law),
                         fit.against_best[i].is_clear() ? "clearly worse" : "not told apart from it");
  }
  if (!fit.dependent) return words;
  return words + (fit.dependent_gain.is_clear() ? "; restitution depends on the corner's effective mass"
                                                : "; no dependence on the corner's effective mass can be told");
}

std::string contact_words(const MeasuredFit& fit) {
  return fmt::format(
      "contact lasts about {} ± {} ms, from the share of impacts that a frame was caught in: below a frame, so "
      "that k_G and c_G cannot be told apart from e",
      significant(1e3 * fit.contact_time, 2), significant(1e3 * fit.contact_time_error, 1));
}

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

constexpr int points_of_a_flight = 40;
constexpr double predicted = 1, measured = 0;

const ScoredDrop& chosen_drop(const Scores& scores, const std::string& name) {
  const auto found = std::find_if(scores.drops.begin(), scores.drops.end(), [&](const ScoredDrop& drop) {
    return name.empty() ? drop.measured.is_point : drop.name == name;
  });
  if (found != scores.drops.end()) return *found;
  throw BadInput(name.empty() ? "--plot: no point impact was scored"
                              : fmt::format("--drop {}: not among those scored", name));
}

PicturePanel track_panel(const MeasuredRun& run, const ScoredDrop& drop) {
  const ForecastModel model = forecast_model(run.file, run.fit);
  PicturePanel panel{
      .columns = {{"time", "s", "since impact 1"},
                  {"height", "m", "of the centre"},
                  {"kind", "1", "0 measured, 1 predicted"}},
      .plot = {
          .x_label = "time after impact 1 [s]",
          .y_label = "height of the centre [m]",
          .curves = {
              {.x = "time",
               .y = "height",
               .legend = "drop " + drop.name + ", measured",
               .style = FigureCurve::Style::points,
               .where = {{"kind", measured}}},
              {.x = "time", .y = "height", .legend = "predicted from impact 1 on", .where = {{"kind", predicted}}}}}};
  const auto track = std::find_if(run.file.file.tracks.begin(), run.file.file.tracks.end(),
                                  [&](const Track& t) { return t.name == drop.name; });
  const double ground = run.fit.calibration.calibration.ground;
  double last = 0;
  for (const Frame& frame : track->frames) {
    last = frame.time - drop.measured.time;
    panel.rows.push_back({last, frame.position.z() - ground, measured});
  }
  for (const HeightAt& at : predicted_heights(model, drop.measured, last, points_of_a_flight))
    panel.rows.push_back({at.time, at.height, predicted});
  return panel;
}

PicturePanel residual_panel(const Scores& scores) {
  PicturePanel panel{.columns = {{"angle", "deg", "between the corner's arm and the vertical"},
                                 {"error", "%", "of the motion after impact 1"},
                                 {"point", "1", "1: a point impact"}},
                     .plot = {.x_label = "angle between the corner's arm and the vertical [°]",
                              .y_label = "error of the motion after impact 1 [%]",
                              .curves = {{.x = "angle",
                                          .y = "error",
                                          .legend = "point impacts",
                                          .style = FigureCurve::Style::points,
                                          .where = {{"point", 1.0}}},
                                         {.x = "angle",
                                          .y = "error",
                                          .legend = "others",
                                          .style = FigureCurve::Style::points,
                                          .where = {{"point", 0.0}}}}}};
  for (const ScoredDrop& drop : scores.drops)
    panel.rows.push_back({drop.measured.angle_degrees(), 100 * drop.error, drop.measured.is_point ? 1.0 : 0.0});
  return panel;
}

PicturePanel coverage_panel(const MeasuredRun& run, const Scores& scores) {
  PicturePanel panel{
      .columns = {{"width", "1", "over that of the 90 % interval"}, {"share", "%", "of the numbers within"}},
      .plot = {.x_label = "distance over half the 90 % interval",
               .y_label = "velocities within that distance [%]",
               .curves = {{.x = "width", .y = "share", .legend = "velocities after impact 1; 90 % belong at 1"}},
               .y = {0, 100}}};
  const TrackedBody body(run.file.file.description, run.fit.calibration.calibration);
  std::vector<double> ratios;
  for (const ScoredDrop& drop : scores.drops) {
    if (!drop.measured.is_point) continue;
    const MotionParts off = motion_parts(body, drop.measured.after.state) - motion_parts(body, drop.predicted.after);
    for (const int part : active_parts(run.file.file.description))
      ratios.push_back(std::fabs(off[part]) / drop.predicted.half_width[part]);
  }
  std::sort(ratios.begin(), ratios.end());
  for (std::size_t i = 0; i < ratios.size(); ++i)
    panel.rows.push_back({ratios[i], 100 * static_cast<double>(i + 1) / static_cast<double>(ratios.size())});
  return panel;
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
    report.grid.rows.push_back(law_row(law_name(fit.laws[i].law.law), fit.laws[i], fit.against_best[i]));
  const std::string best = law_name(fit.laws[fit.best].law.law);
  if (fit.dependent) {
    report.grid.rows.push_back(
        law_row(best + ", e(ν)", *fit.dependent, {-fit.dependent_gain.mean, fit.dependent_gain.error}));
  }
  report.grid.rows.push_back(law_row(best + ", described", fit.described, {std::nan(""), std::nan("")}));
  report.notes = {preference_words(fit), calibration_note(run), contact_words(fit)};
  for (const std::string& note : track_notes(run)) report.notes.push_back(note);
  if (!std::isfinite(fit.laws[fit.best].fit.half_width(1)))
    report.notes.emplace_back(
        "μ is not settled: a larger one fits as well, as where all impacts stick before they end");
  const TrackDescription& d = run.file.file.description;
  report.notes.push_back(fmt::format("{}described: body uniform{}, its axes as tracked",
                                     fit.dependent ? "e(ν) = e + e₁ ν, ν = 1/(m W_nn); " : "",
                                     d.is_box() ? ", sharp" : ""));
  report.fields["fits"] = row_objects(report.grid);
  report.fields["best"] = best;
  report.fields["contact_time"] = fit.contact_time;
  report.fields["contact_time_error"] = rounded_up(fit.contact_time_error);
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
            Cell(corner_name(run, body, p.corner)),
            Cell(corner_name(run, body, drop.measured.momentum_corner)),
            Cell(100 * p.certainty, 3),
            Cell(drop.measured.angle_degrees(), 3)};
    const MotionParts predicted = motion_parts(body, p.after), measured = motion_parts(body, drop.measured.after.state);
    for (int part = 0; part < 6; ++part) {
      for (const double number : {predicted[part], p.half_width[part], measured[part]}) row.emplace_back(number);
    }
    const Cell nothing{Value()};
    row.emplace_back(100 * drop.error, 3);
    row.push_back(p.next ? Cell(corner_name(run, body, p.next->corner)) : nothing);
    row.push_back(drop.second ? Cell(corner_name(run, body, drop.second->corner)) : nothing);
    row.push_back(p.next ? Cell(1e3 * p.next->time, 3) : nothing);
    row.push_back(p.next ? Cell(1e3 * p.next->time_half_width, 2) : nothing);
    row.push_back(drop.second ? Cell(1e3 * (drop.second->time - drop.measured.time), 3) : nothing);
    row.push_back(p.next ? Cell(p.next->impulse_ratio) : nothing);
    row.push_back(p.end ? Cell(p.end->impacts) : nothing);
    row.emplace_back(drop.measured_impacts);
    row.push_back(p.end && !body.is_ball() ? Cell(face_name(run, body, p.end->face)) : nothing);
    row.push_back(drop.face ? Cell(face_name(run, body, *drop.face)) : nothing);
    row.push_back(p.end ? Cell(p.end->outcome) : nothing);
    report.grid.rows.push_back(std::move(row));
  }
  report.notes = {"law: " + law_words(model.law), calibration_note(run)};
  report.fields["drops"] = row_objects(report.grid);
  report.fields["law"] = law_words(model.law);
  return report;
}

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
      calibration_note(run)};
  if (!run.file.file.description.is_ball()) report.notes.insert(report.notes.end() - 1, bin_words(scores));
  for (const std::string& note : track_notes(run)) report.notes.push_back(note);
  report.fields["scores"] = row_objects(report.grid);
  report.fields["residuals"] = bins_value(scores);
  report.fields["law"] = law_words(run.fit.laws[run.fit.best].law);
  return report;
}

Picture measured_picture(const MeasuredRun& run, const Scores& scores, const std::string& drop) {
  return {.what = "Predictions held against measured drops",
          .scene = {run.file.file.description.source, run.split_words},
          .panels = {track_panel(run, chosen_drop(scores, drop)), residual_panel(scores), coverage_panel(run, scores)}};
}

std::vector<std::string> measured_words(const MeasuredRun& run) {
  return {fmt::format("clatter {}, measured: {}", version, run.file.file.path), run.split_words,
          run.file.file.description.source};
}

}  // namespace clatter::validation
