// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/measured_notes.hpp"

#include <fmt/format.h>

#include "validation/output/number.hpp"

namespace clatter::validation::inline reports {
namespace {

std::string mm(double metres) { return significant(1e3 * metres, 3); }

std::vector<std::string> tracks_head(const MeasuredRun& run) {
  const TrackDescription& d = run.file.file.description;
  std::vector<std::string> head{
      fmt::format("{}: {} drops, {} frames at {} Hz, motion in {}", run.file.file.path, run.file.file.tracks.size(),
                  run.file.file.frames, shortest(d.rate), d.is_planar() ? "a plane" : "space"),
      fmt::format("body: box {} × {} × {} m, {} kg", shortest(d.size.x()), shortest(d.size.y()), shortest(d.size.z()),
                  shortest(d.mass)),
      run.split_words};
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

Value calibration_value(const CalibrationResult& c) {
  const Vector3& turn = c.calibration.turn;
  return Value::Fields{{"turn", std::vector<double>{turn.x(), turn.y(), turn.z()}},
                       {"turn_error", c.turn_error},
                       {"resting", c.resting},
                       {"ground", c.calibration.ground},
                       {"ground_spread", c.ground_spread},
                       {"inertia_factor", c.calibration.inertia_factor},
                       {"inertia_half_width", c.inertia_half_width},
                       {"rounding", c.calibration.rounding},
                       {"rounding_half_width", c.rounding_half_width},
                       {"turning_unexplained_before", c.lever_before},
                       {"turning_unexplained", c.lever_after}};
}

}  // namespace

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

std::string calibration_note(const MeasuredRun& run) {
  const CalibrationResult& c = run.fit.calibration;
  return fmt::format(
      "calibration on the fitted drops: body axes turned by ({}, {}, {}) mrad ± {} ({} resting poses); ground at {} ± "
      "{} "
      "mm; inertia {} ± {} of the uniform body's; corners rounded by {} ± {} mm; turning unexplained {} → {}",
      significant(1e3 * c.calibration.turn.x(), 3), significant(1e3 * c.calibration.turn.y(), 3),
      significant(1e3 * c.calibration.turn.z(), 3), significant(1e3 * c.turn_error, 2), c.resting,
      mm(c.calibration.ground), mm(c.ground_spread), significant(c.calibration.inertia_factor, 3),
      significant(c.inertia_half_width, 2), mm(c.calibration.rounding), mm(c.rounding_half_width),
      significant(c.lever_before, 2), significant(c.lever_after, 2));
}

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
  report.fields["calibration"] = calibration_value(run.fit.calibration);
  return report;
}

std::string law_words(const FittedLaw& law) {
  return fmt::format("{}, e = {}, μ = {}", fitted_law_name(law.law), significant(law.restitution, 3),
                     significant(law.friction, 3));
}

}  // namespace clatter::validation::inline reports
