// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/meetings.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"
#include "analytic/space/flight/first_contact.hpp"

namespace clatter::validation {
namespace {

using analytic::space::State;

constexpr std::size_t frames_before = 16, frames_after = 12;  // of a flight, next to the impact
constexpr std::size_t least_frames = 4, most_moved = 8;       // of a flight; from one flight to the next
constexpr double same_motion = 6, moved_on = 50;              // standard deviations
constexpr double slight = 0.05;                               // change of a motion over the motion
constexpr double at_the_ground = 0.2, touching = 0.03;        // height of the lowest point, over the body's size
constexpr double most_skipped = 1;                            // [s]
constexpr double skip_tolerance = 0.1, skip_turn = 0.3;       // of the way and the velocity; [rad]
constexpr int meeting_bits = 20, skip_steps = 8;

double distance_at(const FlightFit& a, const FlightFit& b, const PoseNoise& noise, double time) {
  const State before = a.state_at(time), after = b.state_at(time);
  return ((after.position - before.position) / noise.position).squaredNorm() +
         (rotation_vector(after.attitude * before.attitude.conjugate()) / noise.rotation).squaredNorm();
}

double meeting_time(const FlightFit& a, const FlightFit& b, const PoseNoise& noise) {
  return boost::math::tools::brent_find_minima([&](double t) { return distance_at(a, b, noise, t); }, a.last(),
                                               b.first(), meeting_bits)
      .first;
}

bool is_one_motion(const FlightFit& a, const FlightFit& b) {
  const double time = (a.last() + b.first()) / 2;
  const MeasuredState before = a.at(time), after = b.at(time);
  const Vector3 jump = after.state.velocity - before.state.velocity;
  const Vector3 twist = after.state.angular_velocity - before.state.angular_velocity;
  for (int axis = 0; axis < 3; ++axis) {
    const auto spread = [&](int i) { return std::sqrt(before.covariance(i, i) + after.covariance(i, i)); };
    if (std::fabs(jump[axis]) > same_motion * spread(6 + axis)) return false;
    if (std::fabs(twist[axis]) > same_motion * spread(9 + axis)) return false;
  }
  return true;
}

/// Whether the motion changes by so little that walls do it.
bool is_slight(const Meeting& meeting, double gyration) {
  const State before = meeting.before.state_at(meeting.time), after = meeting.after.state_at(meeting.time);
  const auto size = [&](const Vector3& v, const Vector3& w) { return std::hypot(v.norm(), gyration * w.norm()); };
  return size(after.velocity - before.velocity, after.angular_velocity - before.angular_velocity) <
         slight * size(before.velocity, before.angular_velocity);
}

/// Whether poses jump though the motion goes on: samples are missing.
bool has_moved_on(const FlightFit& a, const FlightFit& b, const FlightModel& model) {
  return distance_at(a, b, model.noise, (a.last() + b.first()) / 2) > moved_on * moved_on;
}

double sum_of_squares(const Track& track, const FlightFit& fit, const FlightFrames& frames, std::size_t from,
                      std::size_t to) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += fit.standard_residual(track.frames[frames[i]]).squaredNorm();
  return sum;
}

/// Moves the border between two flights to where both together leave least unexplained: after a weak impact some frames
/// still lie within the earlier flight's noise.
void settle_border(const Track& track, const FlightModel& model, FlightFrames& earlier, FlightFrames& later) {
  const std::size_t kept = std::min(earlier.size(), frames_before), next = std::min(later.size(), frames_after);
  FlightFrames all(earlier.end() - static_cast<std::ptrdiff_t>(kept), earlier.end());
  all.insert(all.end(), later.begin(), later.begin() + static_cast<std::ptrdiff_t>(next));
  std::size_t moved = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t back = 0; back <= most_moved && kept >= back + least_frames; ++back) {
    const std::size_t border = kept - back;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(border);
    const FlightFit before = fit_flight(track, {all.begin(), middle}, model, FlightSide::last, border);
    const FlightFit after = fit_flight(track, {middle, all.end()}, model, FlightSide::first, all.size());
    const double sum =
        sum_of_squares(track, before, all, 0, border) + sum_of_squares(track, after, all, border, all.size());
    if (sum < least) moved = back;
    least = std::min(least, sum);
  }
  later.insert(later.begin(), earlier.end() - static_cast<std::ptrdiff_t>(moved), earlier.end());
  earlier.resize(earlier.size() - moved);
}

/// Standard deviation of Meeting::low: from the earlier flight's pose, and from the time of the meeting, which both
/// flights' poses settle by least squares.
double low_error(const Meeting& meeting, const TrackedBody& body, const PoseNoise& noise) {
  using PoseVector = Eigen::Matrix<double, 6, 1>;
  const MeasuredState before = meeting.before.at(meeting.time), after = meeting.after.at(meeting.time);
  const Vector3 arm = body.arm(before.state.attitude, body.lowest(before.state.attitude));
  PoseVector parting, weight;
  parting << after.state.velocity - before.state.velocity, after.state.angular_velocity - before.state.angular_velocity;
  weight << Vector3::Constant(1 / std::pow(noise.position, 2)), Vector3::Constant(1 / std::pow(noise.rotation, 2));
  const PoseVector weighted = weight.cwiseProduct(parting);
  const double fall = (before.state.velocity + before.state.angular_velocity.cross(arm)).z();
  const PoseVector by_time = fall / weighted.dot(parting) * weighted;
  PoseVector by_before = by_time;
  by_before.head<3>() += Vector3::UnitZ();
  by_before.tail<3>() += arm.cross(Vector3::UnitZ());  // 0 of a ball
  const double variance = by_before.dot(before.covariance.topLeftCorner<6, 6>() * by_before) +
                          by_time.dot(after.covariance.topLeftCorner<6, 6>() * by_time);
  return std::sqrt(variance);
}

/// The changes of motion in a track.  Flights between which no component of velocity or angular velocity changes by
/// more than 6 standard deviations are one; so are, away from the ground, those whose motion changes by less than a
/// twentieth: walls slow a fall and its turning.
std::vector<Meeting> find_meetings(const Track& track, const TrackFlights& flights, const FlightModel& model,
                                   const TrackedBody& body) {
  std::vector<Meeting> meetings;
  for (std::size_t i = 1; i < flights.flights.size(); ++i) {
    FlightFrames earlier = flights.flights[i - 1], later = flights.flights[i];
    settle_border(track, model, earlier, later);
    const FlightFit before = fit_flight(track, earlier, model, FlightSide::last, frames_before);
    const FlightFit after = fit_flight(track, later, model, FlightSide::first, frames_after);
    if (is_one_motion(before, after) && !has_moved_on(before, after, model)) continue;
    Meeting meeting{.before = before, .after = after};
    meeting.between = static_cast<int>(later.front() - earlier.back()) - 1;
    meeting.time = meeting_time(before, after, model.noise);
    meeting.distance = std::sqrt(distance_at(before, after, model.noise, meeting.time));
    const State met = before.state_at(meeting.time);
    meeting.low = met.position.z() + body.arm(met.attitude, body.lowest(met.attitude)).z();
    meeting.low_error = low_error(meeting, body, model.noise);
    meetings.push_back(std::move(meeting));
  }
  return meetings;
}

/// Height of the ground over that of the description: where the first two flights of each track meet, in the middle.
double first_ground(const MeasuredFile& measured) {
  std::vector<double> heights;
  for (const MeasuredTrack& track : measured.tracks) {
    if (!track.meetings.empty()) heights.push_back(track.meetings.front().low);
  }
  return heights.empty() ? measured.file.description.ground : median(heights);
}

/// The time that samples left out, if the later flight is the earlier one continued after that.
std::optional<double> skipped_time(const Meeting& meeting, const FlightModel& model) {
  const State last = meeting.before.state_at(meeting.time), next = meeting.after.state_at(meeting.time);
  double late = 0;
  for (int step = 0; step < skip_steps; ++step) {  // along the way, to the place nearest to the later flight
    const State at = meeting.before.state_at(meeting.time + late);
    late += (next.position - at.position).dot(at.velocity) / at.velocity.squaredNorm();
  }
  if (!(late * meeting.before.frames() > (meeting.before.last() - meeting.before.first()) / 2 && late < most_skipped))
    return std::nullopt;
  const State go_on = meeting.before.state_at(meeting.time + late);
  const double off = (next.position - go_on.position).norm();
  const double turned_off = rotation_vector(next.attitude * go_on.attitude.conjugate()).norm();
  const double way = (go_on.position - last.position).norm();
  const bool same =
      off < skip_tolerance * way + same_motion * model.noise.position && turned_off < skip_turn &&
      (next.velocity - go_on.velocity).norm() < skip_tolerance * last.velocity.norm() + model.gravity.spread * late;
  return same ? std::optional(late) : std::nullopt;
}

/// Impacts apart from other changes, and numbered.
void sort_changes(MeasuredTrack& track, double ground, const MeasuredFile& measured) {
  const double gyration = std::sqrt(TrackedBody(measured.file.description, {}).gyration_square());
  const double near = at_the_ground * measured.file.description.size.minCoeff();
  std::vector<Meeting> impacts;
  for (Meeting& meeting : track.meetings) {
    const auto skipped = skipped_time(meeting, measured.model);
    const bool touches = std::fabs(meeting.low - ground) < near * touching / at_the_ground;
    if (!skipped && !touches && is_slight(meeting, gyration)) continue;
    if (skipped) meeting.skipped = *skipped;
    meeting.change = skipped ? Change::skipped : meeting.low - ground < near ? Change::impact : Change::disturbed;
    meeting.number = static_cast<int>(impacts.size()) + (meeting.change == Change::impact ? 1 : 0);
    (meeting.change == Change::impact ? impacts : track.other_changes).push_back(std::move(meeting));
  }
  track.meetings = std::move(impacts);
}

using analytic::space::FirstContact;
using analytic::space::FreeFlight;
using analytic::space::PrincipalAxes;

constexpr double bar = 3;  // standard deviations

Matrix3 gyration(const TrackedBody& body, const Quaternion& attitude) {
  const Matrix3 axes = attitude.toRotationMatrix();
  return axes * (body.core().inertia / body.core().mass) * axes.transpose();
}

void add_lever(const TrackedBody& body, TrackImpact& impact, double tolerance) {
  impact.lever_miss = lever(body, impact, impact.arm);
  const Vector3 jump = impact.after.state.velocity - impact.before.state.velocity;
  const StateCovariance both = impact.before.covariance + impact.after.covariance;
  Eigen::Matrix<double, 3, 12> map = Eigen::Matrix<double, 3, 12>::Zero();
  map.block<3, 3>(0, 3) = cross_matrix(jump) * cross_matrix(body.turning_part(impact.arm));
  map.block<3, 3>(0, 6) = cross_matrix(impact.arm);
  map.block<3, 3>(0, 9) = -gyration(body, impact.before.state.attitude);
  const double spread = std::sqrt((map * both * map.transpose()).trace());
  impact.lever_error = bar * spread / (jump.norm() * body.reach());
  impact.is_point = impact.lever_miss <= tolerance + impact.lever_error && impact.approach > 0;
  double least = impact.lever_miss;
  impact.momentum_corner = impact.corner;
  for (std::size_t i = 0; i < body.core().vertices.size(); ++i) {
    const Vector3 arm = body.arm(impact.before.state.attitude, static_cast<int>(i));
    if (arm.z() >= 0) continue;  // the ground cannot reach it
    const double miss = lever(body, impact, arm);
    if (miss < least) impact.momentum_corner = static_cast<int>(i);
    least = std::min(least, miss);
  }
}

MeasuredState calibrated(const TrackedBody& body, MeasuredState measured) {
  measured.state.attitude = body.attitude(measured.state.attitude);
  return measured;
}

}  // namespace

MeasuredFile measure_tracks(TrackFile file) {
  MeasuredFile measured{.file = std::move(file), .model = {}, .tracks = {}};
  const TrackDescription& description = measured.file.description;
  const TrackedBody body(description, {});
  measured.model = {.noise = pose_noise(measured.file),
                    .gravity = {},
                    .planar = description.is_planar(),
                    .moments = unlike_moments(body)};
  measured.model.gravity = fall_gravity(measured.file, measured.model.noise);
  std::vector<TrackFlights> flights;
  for (const Track& track : measured.file.tracks) flights.push_back(find_flights(track, measured.model));
  measured.model.noise = flight_noise(measured.file, flights, measured.model);
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const Track& track = measured.file.tracks[i];
    MeasuredTrack result{.name = track.name, .missing = track.missing};
    result.flights = std::move(flights[i]);
    result.meetings = find_meetings(track, result.flights, measured.model, body);
    if (result.flights.rests) result.rest = track.frames.back().attitude;
    measured.tracks.push_back(std::move(result));
  }
  const double ground = first_ground(measured);
  for (MeasuredTrack& track : measured.tracks) sort_changes(track, ground, measured);
  return measured;
}

double lever(const TrackedBody& body, const TrackImpact& impact, const Vector3& arm) {
  const State &before = impact.before.state, &after = impact.after.state;
  const Vector3 jump = after.velocity - before.velocity;
  const Vector3 twist = after.angular_velocity - before.angular_velocity;
  return (arm.cross(jump) - gyration(body, before.attitude) * twist).norm() / (jump.norm() * body.reach());
}

std::optional<double> contact_time(const TrackedBody& body, const FlightFit& flight, double start, double until) {
  State state = flight.state_at(start);
  state.attitude = body.attitude(state.attitude);
  state.position.z() -= body.calibration().ground + body.calibration().rounding;
  try {
    const FreeFlight free(PrincipalAxes(body.core().inertia), state, std::max(0.0, flight.gravity()));
    const double lowest = state.position.z() + body.core_arm(state.attitude, body.lowest(state.attitude)).z();
    if (!(lowest > 0)) return std::nullopt;
    const FirstContact contact = analytic::space::first_contact(body.core(), free, {});
    if (contact.end != analytic::FlightEnd::contact || !(start + contact.time <= until)) return std::nullopt;
    return start + contact.time;
  } catch (const analytic::NumericalError&) {
    return std::nullopt;
  }
}

TrackImpact measured_impact(const Meeting& meeting, const TrackedBody& body, double ground_error,
                            double lever_tolerance) {
  TrackImpact impact;
  impact.number = meeting.number;
  const FlightFit& before = meeting.before;
  const double frame = (before.last() - before.first()) / std::max(1, before.frames() - 1);
  impact.time =
      contact_time(body, before, before.last() - 2 * frame, meeting.after.first() + frame).value_or(meeting.time);
  impact.between = meeting.between;
  impact.gravity = meeting.after.gravity();
  impact.before = calibrated(body, before.at(impact.time));
  impact.after = calibrated(body, meeting.after.at(impact.time));
  const Quaternion& attitude = impact.before.state.attitude;
  impact.corner = body.lowest(attitude);
  impact.arm = body.arm(attitude, impact.corner);
  impact.angle = std::acos(std::clamp(-impact.arm.z() / impact.arm.norm(), -1.0, 1.0));
  const State met = before.state_at(meeting.time);
  const Quaternion met_attitude = body.attitude(met.attitude);
  impact.height = met.position.z() + body.arm(met_attitude, body.lowest(met_attitude)).z() - body.calibration().ground;
  const auto point_velocity = [&](const State& state) -> Vector3 {
    return state.velocity + state.angular_velocity.cross(impact.arm);
  };
  const Vector3 before_touch = point_velocity(impact.before.state), after_touch = point_velocity(impact.after.state);
  impact.approach = -before_touch.z();
  impact.slip = before_touch.head<2>().norm();
  impact.restitution = after_touch.z() / impact.approach;
  Eigen::Matrix<double, 1, 12> height = Eigen::Matrix<double, 1, 12>::Zero();  // by the state before
  height(2) = 1;
  height.segment<3>(3) = impact.arm.cross(Vector3::UnitZ()).transpose();
  const double low_error = std::sqrt((height * impact.before.covariance * height.transpose())(0));
  impact.time_error = std::hypot(ground_error, low_error) / std::max(std::fabs(impact.approach), 1e-3);
  add_lever(body, impact, lever_tolerance);
  return impact;
}

}  // namespace clatter::validation
