// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "validation/measured/arm_angles.hpp"
#include "validation/measured/score.hpp"

namespace clatter::validation::inline measured {
namespace {

using analytic::space::State;

constexpr double sure = 0.95;  // share of the samples that agree where the start leaves no doubt

/// Forecasts beside measurements, drop by drop.
class Scorer {
 public:
  Scorer(const MeasuredFile& file, const MeasuredFit& fit, bool sequences)
      : file_(file), fit_(fit), model_(forecast_model(file, fit)), request_{.sequence = sequences} {
    if (const auto& stated = file.file.description.published) {
      published_ = FittedLaw{analytic::RestitutionLaw::newton, stated->restitution, 0, stated->friction};
    }
    for (const char* name : {"as fitted", "restitution by effective mass", "body as described"}) add_row(name);
    for (const LawFit& law : fit.laws) add_row(fitted_law_name(law.law.law));
    if (published_) add_row("published parameters");
    for (const char* name : {"flat rebound", "no change", "floor: any impulse there", "no point impact: one impact",
                             "no point impact: the sequence"})
      add_row(name);
  }

  void take(std::size_t index) {
    const MeasuredTrack& track = file_.tracks[index];
    if (track.meetings.empty()) return;
    ScoredDrop drop;
    drop.name = track.name;
    drop.measured = impact(track, 0);
    drop.predicted = forecast(model_, drop.measured, request_);
    drop.error = relative_error(model_.body, drop.measured, drop.predicted.after);
    drop.measured_impacts = static_cast<int>(track.meetings.size());
    if (track.meetings.size() > 1) drop.second = impact(track, 1);
    if (track.rest) drop.face = model_.body.down_face(model_.body.attitude(*track.rest));
    ++scores_.points.of;
    if (drop.measured.is_point) take_point(track, drop);
    else take_several(track, drop);
    take_end(drop);
    scores_.drops.push_back(std::move(drop));
  }

  Scores finish() {
    for (const ErrorRow& row : rows_) scores_.rows.push_back(row);
    return std::move(scores_);
  }

 private:
  void add_row(const std::string& name) { rows_.push_back({name, {}}); }

  [[nodiscard]] TrackImpact impact(const MeasuredTrack& track, std::size_t number) const {
    return measured_impact(track.meetings[number], model_.body, model_.ground_error,
                           file_.file.description.lever_tolerance);
  }

  void put(const std::string& name, double error) {
    for (ErrorRow& row : rows_) {
      if (row.name == name) row.errors.push_back(error);
    }
  }

  void take_point(const MeasuredTrack& track, const ScoredDrop& drop) {
    const TrackedBody& body = model_.body;
    const TrackImpact& m = drop.measured;
    const State& before = m.before.state;
    ++scores_.points.right;
    put("as fitted", drop.error);
    put("restitution by effective mass", relative_error(body, m, struck(body, before, m.corner, fit_.dependent.law)));
    for (const LawFit& law : fit_.laws)
      put(fitted_law_name(law.law.law), relative_error(body, m, struck(body, before, m.corner, law.law)));
    State flat = before;
    flat.velocity.z() *= -fit_.laws[fit_.best].law.restitution;
    put("flat rebound", relative_error(body, m, flat));
    put("no change", relative_error(body, m, before));
    put("floor: any impulse there", floor_error(body, m, fit_.laws[fit_.best].law.friction));
    take_described(track);
    ++scores_.first_corner.of;
    if (m.momentum_corner == drop.predicted.corner) ++scores_.first_corner.right;
    take_second(track, drop);
    take_intervals(drop);
  }

  /// An impact that one point does not explain: the sequence of impacts until the next frames of flight beside it.
  void take_several(const MeasuredTrack& track, const ScoredDrop& drop) {
    const State after = after_touches(model_, drop.measured, track.meetings[0].after.first() - drop.measured.time);
    put("no point impact: one impact", drop.error);
    put("no point impact: the sequence", relative_error(model_.body, drop.measured, after));
  }

  /// The same impact with the body as it is described.
  void take_described(const MeasuredTrack& track) {
    const TrackDescription& description = file_.file.description;
    const TrackedBody body(description, fit_.as_described.calibration);
    const TrackImpact m =
        measured_impact(track.meetings[0], body, fit_.as_described.ground_spread, description.lever_tolerance);
    put("body as described", relative_error(body, m, struck(body, m.before.state, m.corner, fit_.described.law)));
    if (published_)
      put("published parameters", relative_error(body, m, struck(body, m.before.state, m.corner, *published_)));
  }

  void take_second(const MeasuredTrack& track, const ScoredDrop& drop) {
    if (!drop.second || !drop.predicted.next) return;
    const auto between = [](const Meeting& change) { return change.number == 1; };
    if (std::any_of(track.other_changes.begin(), track.other_changes.end(), between)) return;
    const NextImpact& next = *drop.predicted.next;
    const bool right = next.corner == drop.second->corner;
    const auto flown_to =
        next_contact(model_.body, drop.measured.after.state, drop.measured.corner, drop.measured.gravity);
    ++scores_.second_corner_flown.of;
    if (flown_to && flown_to->corner == drop.second->corner) ++scores_.second_corner_flown.right;
    ++scores_.second_corner.of;
    if (right) ++scores_.second_corner.right;
    if (next.certainty >= sure) {
      ++scores_.second_corner_sure.of;
      if (right) ++scores_.second_corner_sure.right;
    }
    if (next.law_certainty >= sure) {
      ++scores_.second_corner_clear.of;
      if (right) ++scores_.second_corner_clear.right;
    }
    if (!right) return;
    const double flown = drop.second->time - drop.measured.time;
    scores_.time_errors.push_back(std::fabs(next.time / flown - 1));
    const auto jump = [](const TrackImpact& i) { return i.after.state.velocity.z() - i.before.state.velocity.z(); };
    const double ratio = jump(*drop.second) / jump(drop.measured);
    scores_.ratio_errors.push_back(std::fabs(next.impulse_ratio / ratio - 1));
  }

  void take_intervals(const ScoredDrop& drop) {
    const MotionParts off =
        motion_parts(model_.body, drop.measured.after.state) - motion_parts(model_.body, drop.predicted.after);
    for (const int part : active_parts(file_.file.description)) {
      ++scores_.inside.of;
      if (std::fabs(off[part]) <= drop.predicted.half_width[part]) ++scores_.inside.right;
    }
  }

  void take_end(ScoredDrop& drop) {
    if (!request_.sequence || !drop.face || !drop.predicted.end) return;
    ++scores_.face.of;
    if (drop.predicted.end->face == *drop.face) ++scores_.face.right;
    ++scores_.count.of;
    if (std::abs(drop.predicted.end->impacts - drop.measured_impacts) <= 1) ++scores_.count.right;
    if (!published_) return;
    ForecastModel stated = model_;
    stated.law = *published_;
    const Forecast other = forecast(stated, drop.measured, {.samples = 2, .sequence = true});
    if (!other.end) return;
    drop.published_face = other.end->face;
    ++scores_.published_face.of;
    if (other.end->face == *drop.face) ++scores_.published_face.right;
    ++scores_.count_published.of;
    if (std::abs(other.end->impacts - drop.measured_impacts) <= 1) ++scores_.count_published.right;
  }

 private:
  const MeasuredFile& file_;
  const MeasuredFit& fit_;
  ForecastModel model_;
  ForecastRequest request_;
  std::optional<FittedLaw> published_;
  std::vector<ErrorRow> rows_;
  Scores scores_;
};

ResidualBin bin_of(const std::vector<ScoredDrop>& drops, const std::string& quantity, const std::string& unit,
                   double low, double high, double (*value)(const ScoredDrop&)) {
  ResidualBin bin{.quantity = quantity, .unit = unit, .low = low, .high = high};
  std::vector<double> errors, levers, restitutions;
  for (const ScoredDrop& drop : drops) {
    const double v = value(drop);
    if (!(v >= low && v < high)) continue;
    ++bin.impacts;
    levers.push_back(drop.measured.lever_miss);
    if (!drop.measured.is_point) continue;
    ++bin.points;
    errors.push_back(drop.error);
    restitutions.push_back(drop.measured.restitution);
  }
  bin.error = median(errors);
  bin.lever = median(levers);
  bin.restitution = median(restitutions);
  return bin;
}

}  // namespace

std::vector<ResidualBin> residual_bins(const std::vector<ScoredDrop>& drops) {
  std::vector<ResidualBin> bins;
  struct Axis {
    const char *name, *unit;
    std::vector<double> edges;
    double (*value)(const ScoredDrop&);
  };
  const std::vector<Axis> axes{
      {"angle",
       "°",
       {std::begin(arm_angle_edges), std::end(arm_angle_edges)},
       [](const ScoredDrop& d) { return d.measured.angle_degrees(); }},
      {"approach", "m/s", {0, 1, 1.5, 2, 2.5, 3, 4}, [](const ScoredDrop& d) { return d.measured.approach; }},
      {"slip", "m/s", {0, 0.25, 0.5, 1, 1.5, 2, 4}, [](const ScoredDrop& d) { return d.measured.slip; }}};
  for (const Axis& axis : axes) {
    for (std::size_t i = 1; i < axis.edges.size(); ++i) {
      const ResidualBin bin = bin_of(drops, axis.name, axis.unit, axis.edges[i - 1], axis.edges[i], axis.value);
      if (bin.impacts > 0) bins.push_back(bin);
    }
  }
  return bins;
}

double Share::value() const { return of == 0 ? std::nan("") : static_cast<double>(right) / of; }

double Scores::middle_of(const std::string& row) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ErrorRow& one) { return one.name == row; });
  return found == rows.end() ? std::nan("") : median(found->errors);
}

Scores score_measured(const MeasuredFile& file, const MeasuredFit& fit, const TrackPart& part, bool sequences) {
  Scorer scorer(file, fit, sequences);
  for (const std::size_t index : part) scorer.take(index);
  Scores scores = scorer.finish();
  scores.bins = residual_bins(scores.drops);
  return scores;
}

}  // namespace clatter::validation::inline measured
