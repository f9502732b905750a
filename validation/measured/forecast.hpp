// SPDX-License-Identifier: GPL-3.0-or-later
// What the discrete model says of a drop from the motion before its first impact.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "validation/measured/law_fit.hpp"

namespace clatter::validation {

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
  std::size_t face = 0;  ///< that lies down at the end
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

/// Motion after all impacts within `duration` of the first, as a sequence of impacts and flights; gravity aside, which
/// the flights on both sides have.
[[nodiscard]] analytic::space::State after_touches(const ForecastModel& model, const TrackImpact& start,
                                                   double duration);

/// Number `column` of sample `sample`: standard normal, from uniform_at().
[[nodiscard]] double normal_at(std::uint64_t seed, std::uint64_t sample, std::uint32_t column);
/// A sample of a measured state.
[[nodiscard]] analytic::space::State sample_of(const MeasuredState& state, std::uint64_t seed, std::uint64_t sample);

}  // namespace clatter::validation
