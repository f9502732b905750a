// SPDX-License-Identifier: GPL-3.0-or-later
// Fitted on one part of a file's drops, scored on the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/measured/law_fit.hpp"

namespace clatter::validation {

// What the discrete model says of a drop from the motion before its first impact.

/// Velocity and k Ω after an impact, world frame: six numbers in m/s, k² = I/m.
using MotionParts = Eigen::Matrix<double, 6, 1>;
[[nodiscard]] MotionParts motion_parts(const TrackedBody& body, const analytic::space::State& state);

/// The next impact.
struct NextImpact {
  int corner = 0;
  double time = 0;             ///< after the first [s]
  double certainty = 0;        ///< share of the samples of the start that agree on the corner
  double law_certainty = 0;    ///< the same, of samples that the law's own scatter is added to
  double impulse_ratio = 0;    ///< P₂/P₁, normal
  double time_half_width = 0;  ///< of the 90 % interval [s]
};

/// The whole sequence, with the sharp body.
struct ForecastEnd {
  int impacts = 0;       ///< that flights of three frames or more follow
  std::size_t face = 0;  ///< that lies down at the end; of a ball none, 0
  std::string outcome;   ///< "at-rest", "sustained-contact", …
};

struct Forecast {
  int corner = 0;        ///< that strikes first
  double certainty = 0;  ///< share of the samples that agree on it
  analytic::space::State after;
  MotionParts half_width = MotionParts::Zero();  ///< of the 90 % intervals [m/s]
  std::optional<NextImpact> next;
  std::optional<ForecastEnd> end;
};

/// What a forecast is made with.
struct ForecastModel {
  TrackedBody body;
  FittedLaw law;
  double law_scatter = 0;       ///< of the parts of a motion after an impact, over the motion's size before; of the law
  double width_factor = 1.645;  ///< half width of a 90 % interval over the standard deviation
  double ground_error = 0;      ///< [m]
  double rate = 0;              ///< of the frames [Hz]
  bool planar = false;
};

/// Height of the centre along a predicted sequence, `per_flight` points a flight; times from the first impact.
struct HeightAt {
  double time = 0;    ///< [s]
  double height = 0;  ///< above the ground [m]
};
[[nodiscard]] std::vector<HeightAt> predicted_heights(const ForecastModel& model, const TrackImpact& start,
                                                      double until, int per_flight);

struct ForecastRequest {
  int samples = 60;       ///< of the start
  bool sequence = false;  ///< the whole sequence, too
  std::uint64_t seed = 1;
};

/// Forecast from a measured start, at the moment of the touch.  The samples are drawn from the start's covariance; the
/// intervals add the law's own scatter.
[[nodiscard]] Forecast forecast(const ForecastModel& model, const TrackImpact& start, const ForecastRequest& request);

/// The corner that reaches the ground next, and when, from the motion after an impact at `corner`; nothing if none
/// does.
[[nodiscard]] std::optional<NextImpact> next_contact(const TrackedBody& body, analytic::space::State after, int corner,
                                                     double gravity);

/// Number `column` of sample `sample`: standard normal, from uniform_at().
[[nodiscard]] double normal_at(std::uint64_t seed, std::uint64_t sample, std::uint32_t column);
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
  /// The best of them, with restitution that depends on the effective mass; none where that differs by less than a
  /// hundredth between the point impacts, as of a ball.
  std::optional<LawFit> dependent;
  LawFit described;                            ///< the best law with the body as it is described
  std::size_t best = 0;                        ///< index in laws: least loss
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
  double error = 0;                   ///< relative_error of the prediction
  std::optional<TrackImpact> second;  ///< as measured
  std::optional<std::size_t> face;    ///< that lies down at rest, as measured
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
  void take(bool is_right) { ++of, right += is_right ? 1 : 0; }
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
  Share count;                       ///< number of impacts met within one
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
