// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/forecast.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "analytic/base/errors.hpp"
#include "analytic/space/first_contact.hpp"
#include "analytic/space/sequence.hpp"
#include "validation/scene/names.hpp"
#include "validation/sweep/counter_random.hpp"

namespace clatter::validation {
namespace {

using analytic::space::FirstContact;
using analytic::space::FreeFlight;
using analytic::space::PrincipalAxes;
using analytic::space::State;

constexpr double one_in_two_to_54 = 0x1p-54;  // uniform_at() may be 0
constexpr int most_impacts = 200, most_touches = 20;
constexpr double frames_of_a_flight = 3;

double point_speed(const TrackedBody& body, const State& state, int corner) {
  return (state.velocity + state.angular_velocity.cross(body.arm(state.attitude, corner))).z();
}

/// Normal impulse over the mass.
double jump(const State& before, const State& after) { return after.velocity.z() - before.velocity.z(); }

/// Samples of the start, each as a state after its first impact.
struct Samples {
  std::map<int, int> first, second, scattered;  ///< corner → how many samples
  std::vector<MotionParts> after;
  std::vector<double> times;
};

/// A motion after an impact with the law's own scatter; a planar body stays in its plane.
State scattered(const ForecastModel& model, const TrackImpact& start, State after, std::uint64_t seed,
                std::uint64_t number) {
  const double own = model.law_scatter * motion_size(model.body, start.before.state);
  const double turning = own / std::sqrt(model.body.gyration_square());
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (!model.planar || axis != 1) after.velocity[axis] += own * normal_at(seed, number, 13 + axis);
    if (!model.planar || axis == 1) after.angular_velocity[axis] += turning * normal_at(seed, number, 16 + axis);
  }
  return after;
}

Samples samples_of(const ForecastModel& model, const TrackImpact& start, const ForecastRequest& request) {
  Samples samples;
  for (int i = 0; i < request.samples; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    State state = sample_of(start.before, request.seed, number);
    const double late = start.time_error * normal_at(request.seed, number, 12);
    state.attitude = (rotation_of(late * state.angular_velocity) * state.attitude).normalized();
    const int corner = model.body.lowest(state.attitude);
    ++samples.first[corner];
    const State after = struck(model.body, state, corner, model.law);
    samples.after.push_back(motion_parts(model.body, after));
    const auto next = next_contact(model.body, after, corner, start.gravity);
    ++samples.second[next ? next->corner : -1];
    if (next) samples.times.push_back(next->time);
    const auto other =
        next_contact(model.body, scattered(model, start, after, request.seed, number), corner, start.gravity);
    ++samples.scattered[other ? other->corner : -1];
  }
  return samples;
}

double share_of(const std::map<int, int>& counts, int corner, int samples) {
  const auto found = counts.find(corner);
  return found == counts.end() || samples == 0 ? 0 : static_cast<double>(found->second) / samples;
}

MotionParts half_widths(const ForecastModel& model, const TrackImpact& start, const Samples& samples) {
  MotionParts mean = MotionParts::Zero(), square = MotionParts::Zero();
  for (const MotionParts& after : samples.after) mean += after / static_cast<double>(samples.after.size());
  for (const MotionParts& after : samples.after) {
    square += (after - mean).cwiseAbs2() / std::max(1.0, static_cast<double>(samples.after.size()) - 1);
  }
  const double own = model.law_scatter * motion_size(model.body, start.before.state);
  return model.width_factor * (square.array() + own * own).sqrt();
}

analytic::space::Sequence sequence_of(const ForecastModel& model, const TrackImpact& start) {
  analytic::space::Drop drop;
  drop.body = model.body.sharp();
  drop.attitude = start.before.state.attitude;
  drop.velocity = start.before.state.velocity;
  drop.angular_velocity = start.before.state.angular_velocity;
  drop.gravity = std::max(0.0, start.gravity);
  const double mass = model.law.slope == 0 ? 0 : effective_mass(model.body, start.before.state, start.corner);
  drop.law.law = {.restitution = model.law.restitution_at(mass),
                  .law = model.law.law,
                  .friction = analytic::FrictionKind::coulomb,
                  .friction_value = std::max(0.0, model.law.friction)};
  return analytic::space::impact_sequence(drop, {.impacts = most_impacts, .digits = 3, .amplification = false});
}

ForecastEnd sequence_end(const ForecastModel& model, const TrackImpact& start) {
  const analytic::space::Sequence sequence = sequence_of(model, start);
  ForecastEnd end{.impacts = 1, .face = 0, .outcome = outcome_name(sequence.outcome)};
  for (std::size_t i = 1; i < sequence.rows.size(); ++i) {
    if ((sequence.rows[i].start - sequence.rows[i - 1].start) * model.rate >= frames_of_a_flight) ++end.impacts;
  }
  end.face = model.body.down_face(sequence.rows.back().before.attitude);
  return end;
}

}  // namespace

double normal_at(std::uint64_t seed, std::uint64_t sample, std::uint32_t column) {
  return gsl_cdf_ugaussian_Pinv(std::max(one_in_two_to_54, uniform_at(seed, sample, column)));
}

State sample_of(const MeasuredState& measured, std::uint64_t seed, std::uint64_t sample) {
  const Eigen::SelfAdjointEigenSolver<StateCovariance> axes(measured.covariance);
  StateVector standard;
  for (std::uint32_t i = 0; i < 12; ++i) standard[i] = normal_at(seed, sample, i);
  const StateVector off = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseProduct(standard);
  State state = measured.state;
  state.position += off.head<3>();
  state.attitude = (rotation_of(off.segment<3>(3)) * state.attitude).normalized();
  state.velocity += off.segment<3>(6);
  state.angular_velocity += off.tail<3>();
  return state;
}

MotionParts motion_parts(const TrackedBody& body, const State& state) {
  MotionParts parts;
  parts << state.velocity, std::sqrt(body.gyration_square()) * state.angular_velocity;
  return parts;
}

std::optional<NextImpact> next_contact(const TrackedBody& body, State after, int corner, double gravity) {
  const Vector3 place = body.core().vertices[static_cast<std::size_t>(corner)];
  after.position = {0, 0, -(after.attitude * place).z()};
  try {
    const FreeFlight flight(PrincipalAxes(body.core().inertia), after, std::max(0.0, gravity));
    const double leaving = (after.velocity + after.angular_velocity.cross(after.attitude * place)).z();
    const std::vector<analytic::space::Touch> touch{{corner, leaving}};
    const FirstContact contact = analytic::space::first_contact(body.core(), flight, touch);
    if (contact.end != analytic::FlightEnd::contact) return std::nullopt;
    NextImpact next;
    next.corner = contact.point;
    next.time = contact.time;
    return next;
  } catch (const analytic::NumericalError&) {
    return std::nullopt;
  }
}

State after_touches(const ForecastModel& model, const TrackImpact& start, double duration) {
  State state = struck(model.body, start.before.state, start.corner, model.law);
  int corner = start.corner;
  double time = 0;
  for (int touch = 0; touch < most_touches; ++touch) {
    const auto next = next_contact(model.body, state, corner, start.gravity);
    if (!next || !(time + next->time < duration)) break;
    time += next->time;
    corner = next->corner;
    state.attitude = (rotation_of(next->time * state.angular_velocity) * state.attitude).normalized();
    state.velocity.z() -= start.gravity * next->time;
    state = struck(model.body, state, corner, model.law);
  }
  state.velocity.z() += start.gravity * time;
  return state;
}

std::vector<HeightAt> predicted_heights(const ForecastModel& model, const TrackImpact& start, double until,
                                        int per_flight) {
  const analytic::space::Sequence sequence = sequence_of(model, start);
  std::vector<HeightAt> heights;
  for (std::size_t i = 0; i < sequence.rows.size() && sequence.rows[i].start <= until; ++i) {
    const analytic::space::ImpactRow& row = sequence.rows[i];
    const bool is_last = i + 1 == sequence.rows.size();
    const double flown = is_last ? 0 : std::min(until, sequence.rows[i + 1].start) - row.start;
    for (int k = 0; k < per_flight; ++k) {
      const double t = flown * k / per_flight;
      heights.push_back({row.start + t, row.before.position.z() + t * (row.impact.velocity_after.z() -
                                                                       std::max(0.0, start.gravity) * t / 2)});
    }
  }
  return heights;
}

Forecast forecast(const ForecastModel& model, const TrackImpact& start, const ForecastRequest& request) {
  const TrackedBody& body = model.body;
  const State& before = start.before.state;
  Forecast result;
  result.corner = body.lowest(before.attitude);
  result.after = struck(body, before, result.corner, model.law);
  const Samples samples = samples_of(model, start, request);
  result.certainty = share_of(samples.first, result.corner, request.samples);
  result.half_width = half_widths(model, start, samples);
  if (point_speed(body, before, result.corner) >= 0) return result;
  result.next = next_contact(body, result.after, result.corner, start.gravity);
  if (result.next) {
    NextImpact& next = *result.next;
    next.law_certainty = share_of(samples.scattered, next.corner, request.samples);
    next.certainty = share_of(samples.second, next.corner, request.samples);
    next.time_half_width = (quantile(samples.times, 0.95) - quantile(samples.times, 0.05)) / 2;
    const FreeFlight flight(PrincipalAxes(body.core().inertia), result.after, std::max(0.0, start.gravity));
    const State arriving = flight.at(next.time);
    next.impulse_ratio = jump(arriving, struck(body, arriving, next.corner, model.law)) / jump(before, result.after);
  }
  if (!request.sequence) return result;
  try {
    result.end = sequence_end(model, start);
  } catch (const std::exception&) {  // no sequence can be had: the forecast has no end
    result.end.reset();
  }
  return result;
}

}  // namespace clatter::validation
