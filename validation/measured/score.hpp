// SPDX-License-Identifier: GPL-3.0-or-later
// Fitted on one part of a file's drops, scored on the other.
#pragma once

#include <string>
#include <vector>

#include "validation/measured/forecast.hpp"

namespace clatter::validation {

/// Which drops to fit on and which to score: never the same.
struct TrackSplit {
  TrackPart fitted, scored;
};
/// At random, from a seed: drop i is fitted on if uniform_at(seed, i, 0) < share.
[[nodiscard]] TrackSplit split_by_seed(std::size_t tracks, std::uint64_t seed, double share);
/// Fitted on those of a list "1,3,10-20" of names.  @throws BadInput naming `option` for a name that is not there.
[[nodiscard]] TrackSplit split_by_list(const TrackFile& file, const std::string& option, const std::string& list);

/// Which of motion_parts() a body can have: in a plane v_x, v_z and k Ω_y.
[[nodiscard]] std::vector<int> active_parts(const TrackDescription& description);

/// Everything that a fit says.
struct MeasuredFit {
  CalibrationResult calibration;   ///< of the body
  CalibrationResult as_described;  ///< the ground alone
  std::vector<LawFit> laws;        ///< newton, poisson, stronge, with the calibrated body
  LawFit dependent;                ///< the best of them, with restitution that depends on the effective mass
  LawFit described;                ///< the best law with the body as it is described
  std::size_t best = 0;            ///< index in laws: least loss
  std::vector<PairedDifference> against_best;  ///< loss of each law less the best's
  PairedDifference dependent_gain;             ///< loss of the best pure law less that of `dependent`
  double law_scatter = 0;   ///< of the motion's parts with the best pure law, over the motion's size before
  double width_factor = 0;  ///< that makes 90 % intervals hold 90 % of the fitted part's numbers
  std::size_t impacts = 0;  ///< first impacts in the fitted part
  double contact_time = 0;  ///< share of point impacts with a frame in contact, over the rate [s]
  double contact_time_error = 0;
};

[[nodiscard]] MeasuredFit fit_measured(const MeasuredFile& file, const TrackPart& part);
/// What forecasts are made with after a fit.
[[nodiscard]] ForecastModel forecast_model(const MeasuredFile& file, const MeasuredFit& fit);

/// A drop's forecast beside its measurement.
struct ScoredDrop {
  std::string name;
  TrackImpact measured;
  Forecast predicted;
  double error = 0;                           ///< relative_error of the prediction
  std::optional<TrackImpact> second;          ///< as measured
  std::optional<std::size_t> face;            ///< that lies down at rest, as measured
  std::optional<std::size_t> published_face;  ///< as the authors' parameters have it
  int measured_impacts = 0;
};

/// Errors of one way to predict.
struct ErrorRow {
  std::string name;
  std::vector<double> errors;  ///< relative, of point impacts in the scored part
};

/// A share of drops, or nothing to count.
struct Share {
  int right = 0, of = 0;
  [[nodiscard]] double value() const;
};

/// Residuals in a range of a quantity.
struct ResidualBin {
  std::string quantity, unit;
  double low = 0, high = 0;
  int impacts = 0, points = 0;
  double error = 0;        ///< middle, of point impacts
  double lever = 0;        ///< middle lever_miss, of all
  double restitution = 0;  ///< middle, of point impacts
};

struct Scores {
  std::vector<ScoredDrop> drops;
  std::vector<ErrorRow> rows;
  Share points;                      ///< impacts that are point impacts
  Share first_corner;                ///< predicted, about which momentum is kept best
  Share second_corner;               ///< from the motion before impact 1
  Share second_corner_sure;          ///< of those, where 95 % of the start's samples agree
  Share second_corner_clear;         ///< likewise, with the law's scatter added
  Share second_corner_flown;         ///< from the motion measured after impact 1: the flight alone
  Share inside;                      ///< numbers inside their 90 % intervals
  Share face, published_face;        ///< at rest, with the fitted and the published parameters
  Share count, count_published;      ///< number of impacts met within one;
  std::vector<double> time_errors;   ///< of the second impact, over the flight's measured duration
  std::vector<double> ratio_errors;  ///< of P₂/P₁, relative
  std::vector<ResidualBin> bins;

  /// Middle error of a row by its name; NaN: there is none.
  [[nodiscard]] double middle_of(const std::string& row) const;
};
/// By angle, approach and slip; ranges without a drop are left out.
[[nodiscard]] std::vector<ResidualBin> residual_bins(const std::vector<ScoredDrop>& drops);
/// @param sequences  follow each drop to its rest
[[nodiscard]] Scores score_measured(const MeasuredFile& file, const MeasuredFit& fit, const TrackPart& part,
                                    bool sequences);

// The tracked drops that the program carries: parts of two published data sets.

/// Fitted on one half of a set's drops, drawn with seed 1, and scored on the other.
/// @param name  "square-drops" or "cube-tosses"
[[nodiscard]] Scores kept_scores(const std::string& name);

/// Every drop of a set, each predicted with what the other half fits.
struct CrossedScores {
  std::vector<ResidualBin> bins;
  double flat_rebound = 0;  ///< middle error of the flat rebound, the larger of both halves
};
[[nodiscard]] CrossedScores crossed_scores(const std::string& name);

}  // namespace clatter::validation
