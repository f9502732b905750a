// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/extreme_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "numeric/mesh/generators.hpp"
#include "numeric/motion/free_flight.hpp"
#include "validation/evidence/oracles.hpp"
#include "validation/measured/score.hpp"

namespace clatter::validation {
namespace {

/// The drops whose arm at impact 1 is inclined from `low` on.
CellMeasure residual(const CrossedScores& scores, double low) {
  const auto bin = std::find_if(scores.bins.begin(), scores.bins.end(),
                                [&](const ResidualBin& one) { return one.quantity == "angle" && one.low == low; });
  if (bin == scores.bins.end()) throw analytic::OutsideModelError("none of the tracked drops strikes at this angle");
  if (2 * bin->points < bin->impacts)
    throw analytic::OutsideModelError("most of the tracked drops strike with more than one corner within a frame");
  return {.error = bin->error,
          .bound = scores.flat_rebound,
          .oracle = "tracked drops, each predicted with what the other half fits; the bound is a flat rebound's error",
          .outcome = fmt::format("{} of {} are point impacts", bin->points, bin->impacts)};
}

constexpr double turn = 2 * std::numbers::pi;
/// A few eps for each radian (free_rotation.hpp).
constexpr double ulps_per_radian = 8;

/// Beyond 2⁵³ turns no digit of the phase is left, and the error is bounded by the size of the numbers alone.
double bound_of(double turns) { return std::fmin(ulps_per_radian * eps * turn * (1 + turns), 2); }

/// A rod that spins so fast that it turns about `turns` times until it strikes again; the phase at that impact.
CellMeasure discrete_turns(double turns) {
  analytic::Drop drop{.body = analytic::make_rod({}),
                      .inclination = analytic::Angle::from_degrees(30),
                      .velocity = {.normal = -1, .tangential = 0, .angular = 0},
                      .gravity = 9.81,
                      .law = {}};
  // Elastic and as fast as this, the rod rises at 0.577 |Ω| L and turns 2 V |Ω|/g until it is back.
  drop.velocity.angular = -std::sqrt(turn * turns * drop.gravity / (2 * 0.577));
  CellMeasure measure{.oracle = retrace_oracle};
  const analytic::Sequence sequence =
      timed_sequence(drop, {.impacts = 2, .digits = 6, .amplification = false}, measure);
  const Retrace found = retrace(drop, sequence);
  measure.error = found.placement;
  double turned = 0;
  if (sequence.rows.size() > 1) turned = std::fabs(sequence.rows[1].flight.arrival.inclination) / turn;
  measure.bound = found.residual <= 32 * eps ? bound_of(turned) : 0;
  return measure;
}

/// A flight of the phone, turning about its middle axis (planar) or about all three.
class PhoneFlight {
 public:
  explicit PhoneFlight(bool planar)
      : body_(numeric::box_mesh({.size = {0.10566, 0.04394, 0.01905}, .mass = 0.08814})), planar_(planar) {
    start_.angular_velocity = planar ? numeric::Vector3(0, 7, 0) : numeric::Vector3(6, 0, 4);
  }

  [[nodiscard]] double time_of(double turns) const { return turns * turn / start_.angular_velocity.norm(); }
  [[nodiscard]] numeric::MotionState at(double time) const {
    return numeric::FreeFlight(body_, start_, 0, planar_).at(time);
  }
  [[nodiscard]] PeriodicSpin spin() const {
    const numeric::Vector3 moments = body_.inertia().diagonal();
    const numeric::Vector3& w = start_.angular_velocity;
    return {{moments[0], moments[1], moments[2]}, {w[0], w[1], w[2]}};
  }
  /// Distance of the attitude from a uniform turn about y.
  [[nodiscard]] double distance_from_uniform(const numeric::MotionState& end, double time) const {
    const long double phase = static_cast<long double>(time) * start_.angular_velocity.y() / 2;
    const long double half = std::remainder(phase, 2 * std::numbers::pi_v<long double>);
    const double w = static_cast<double>(std::cos(half)), y = static_cast<double>(std::sin(half));
    const double sign = w * end.attitude.w() + y * end.attitude.y() < 0 ? -1 : 1;
    return std::hypot(sign * end.attitude.w() - w, sign * end.attitude.y() - y);
  }

 private:
  numeric::Body body_;
  bool planar_;
  numeric::MotionState start_;
};

/// The worst of some moments around that number of turns: at one of them the rounding may happen to vanish.
CellMeasure continuous_turns(double turns, bool planar) {
  const PhoneFlight flight(planar);
  CellMeasure measure{.bound = bound_of(turns),
                      .oracle = planar ? "uniform turn at 64 bits" : "one period at 64 bits, repeated",
                      .outcome = "in flight"};
  const PeriodicSpin spin = PhoneFlight(false).spin();
  for (const double part : {1.0, 0.97, 0.91, 0.83, 0.71}) {
    const double time = part * flight.time_of(turns);
    numeric::MotionState end;
    measure.seconds = timed([&] { end = flight.at(time); });
    const double off =
        planar ? flight.distance_from_uniform(end, time) : spin.error({end.attitude, end.angular_velocity}, time);
    if (!(off <= measure.error)) measure.error = off;
  }
  return measure;
}

}  // namespace

std::vector<ExtremeCase> measured_cases(const MapAxis& axis) {
  const bool squares = axis.name == "squares";
  const auto scores = std::make_shared<const CrossedScores>(crossed_scores(squares ? "square-drops" : "cube-tosses"));
  std::vector<ExtremeCase> cases;
  add_cases(cases, axis, squares ? ModelLevel::discrete : ModelLevel::discrete_in_space,
            [scores](double low, const CellClock&) { return residual(*scores, low); });
  return cases;
}

std::vector<ExtremeCase> turn_cases(const MapAxis& axis) {
  std::vector<ExtremeCase> cases;
  add_cases(cases, axis, ModelLevel::discrete, [](double turns, const CellClock&) { return discrete_turns(turns); });
  add_cases(cases, axis, ModelLevel::planar,
            [](double turns, const CellClock&) { return continuous_turns(turns, true); });
  add_cases(cases, axis, ModelLevel::spatial,
            [](double turns, const CellClock&) { return continuous_turns(turns, false); });
  return cases;
}

}  // namespace clatter::validation
