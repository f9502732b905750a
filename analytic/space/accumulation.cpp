// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/accumulation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

namespace {

/// The kinds of path that accumulation.hpp tells apart.
ImpactMode mode_of(PathKind path) {
  switch (path) {
    case PathKind::frictionless: return ImpactMode::frictionless;
    case PathKind::stick: return ImpactMode::stick;
    case PathKind::slip_stick: return ImpactMode::slip_stick;
    case PathKind::slip_reslip: return ImpactMode::reverse_slip;
    case PathKind::slip:
    case PathKind::turning_slip: break;
  }
  return ImpactMode::slip;
}

/// Tangential impulse of a body that slides with `slip` while the ground pushes with the normal impulse `normal`.
Vector2 sliding_impulse(const Drop& drop, const Vector2& slip, double normal) {
  const ImpactLaw& law = drop.law.law;
  if (law.friction == FrictionKind::none) return Vector2::Zero();
  if (law.friction == FrictionKind::impulse_ratio) return law.friction_value * normal * drop.law.ratio_direction;
  const double speed = slip.norm();
  if (!(speed > 0)) return Vector2::Zero();
  return -std::fmin(law.friction_value * normal, drop.body.mass * speed) / speed * slip;
}

/// How fast a point of the body moves after an impulse of this size at most.
double jump_of(const Body& body, double impulse) {
  const double least = static_cast<double>(PrincipalAxes(body.inertia).moments[0]), reach = body.reach();
  return impulse * (1 / body.mass + reach * reach / least);
}

}  // namespace

std::optional<Tail> bouncing_tail(const Drop& drop, const ImpactRow& last) {
  const double e = drop.law.law.restitution;
  const Impact& impact = last.impact;
  const bool is_ball = drop.body.is_ball();  // which may turn: without slip, or friction, that stays as it is
  // On sloping ground slip begins anew in each flight.
  if (drop.gravity_along != 0 && drop.law.law.friction != FrictionKind::none) return {};
  if ((impact.angular_velocity_after != Vector3::Zero() && !is_ball) || !(drop.gravity > 0) || !(e < 1)) return {};
  const Vector3 arm = is_ball ? Vector3(Vector3::Zero()) : last.before.attitude * last.corners.front().place;
  if (!last.group && (arm.head<2>() != Vector2::Zero() || impact.impulse.head<2>() != Vector2::Zero())) return {};
  if (!(impact.velocity_after.z() >= 0)) return {};
  const double w = e * last.approach_speed, mass = drop.body.mass;  // to the last digits, however small e is
  Tail tail;
  tail.end_time = last.start + 2 * w / (drop.gravity * (1 - e));
  tail.normal_impulse = mass * (1 + e) * w / (1 - e);
  const Vector2 slip = impact.velocity_after.head<2>();
  if (last.group) tail.tangential_impulse = sliding_impulse(drop, slip, tail.normal_impulse);
  for (const Corner& corner : last.corners) tail.corners.push_back(corner.index);
  tail.closed_form = true;
  tail.velocity_after.head<2>() = slip + tail.tangential_impulse / mass;
  tail.velocity_after.x() += drop.gravity_along * (tail.end_time - last.start);
  tail.angular_velocity_after = impact.angular_velocity_after;
  return tail;
}

void SpaceAccumulation::add(const ImpactRow& row, double damping_loss) {
  Event event{.corners = {},
              .mode = mode_of(row.impact.path),
              .flight_time = row.flight.time,
              .damping_loss = damping_loss,
              .impulse = row.impact.impulse,
              .moment = {}};
  for (const Corner& corner : row.corners) event.corners.push_back(corner.index);
  std::sort(event.corners.begin(), event.corners.end());
  event.moment = row.group ? row.group->moment
                           : Vector3((row.before.attitude * row.corners.front().place).cross(row.impact.impulse));
  events_.push_back(event);
}

std::size_t SpaceAccumulation::first_of_last_eight(std::vector<int>& labels) const {
  constexpr std::size_t longest = 64, most = 8;
  std::size_t first = events_.size();
  while (first > 0 && events_.size() - first < longest) {
    for (const int corner : events_[first - 1].corners) {
      if (std::find(labels.begin(), labels.end(), corner) == labels.end()) labels.push_back(corner);
    }
    if (labels.size() > most) {
      labels.resize(most);
      break;
    }
    --first;
  }
  return first;
}

std::optional<Tail> SpaceAccumulation::extrapolate(const Accumulation::Tolerance& tolerance) const {
  std::vector<int> labels;
  Accumulation accumulation;
  for (std::size_t i = first_of_last_eight(labels); i < events_.size(); ++i) {
    const Event& event = events_[i];
    VertexSet set = 0;
    for (const int corner : event.corners) {
      const auto at = std::find(labels.begin(), labels.end(), corner) - labels.begin();
      set = static_cast<VertexSet>(set | 1u << at);
    }
    accumulation.add(
        {set, event.mode, event.flight_time, event.impulse.z(), event.impulse.head<2>().norm(), event.damping_loss});
  }
  const auto planar = accumulation.extrapolate(tolerance);
  if (!planar) return vanishing_hops(tolerance);
  Tail tail;
  tail.end_time = planar->end_time;
  tail.end_time_error = planar->end_time_error;
  tail.normal_impulse = planar->normal_impulse;
  tail.normal_impulse_error = planar->normal_impulse_error;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (planar->vertices >> k & 1) tail.corners.push_back(labels[k]);
  }
  double normal = 0;
  Vector2 tangential = Vector2::Zero();
  for (std::size_t i = last_round(tail); i < events_.size(); ++i) {
    normal += events_[i].impulse.z();
    tangential += events_[i].impulse.head<2>();
  }
  tail.tangential_impulse = tail.normal_impulse / normal * tangential;
  return tail;
}

/// The last hops of one corner are so short that what is left of them does not matter, however its slip, which is then
/// rounding, goes.
std::optional<Tail> SpaceAccumulation::vanishing_hops(const Accumulation::Tolerance& tolerance) const {
  constexpr std::size_t hops = 4;
  if (events_.size() < hops) return {};
  const auto last = std::span(events_).last(hops);
  double ratio = 0;
  for (std::size_t i = 0; i < hops; ++i) {
    if (last[i].corners.size() != 1 || last[i].corners != last[0].corners) return {};
    if (i > 0) ratio = std::fmax(ratio, last[i].flight_time / last[i - 1].flight_time);
  }
  const Event& end = last.back();
  if (!(ratio < 1)) return {};
  const double rest = ratio / (1 - ratio), time = rest * end.flight_time, impulse = rest * end.impulse.z();
  if (!(4 * time <= tolerance.time && 4 * impulse <= tolerance.impulse)) return {};
  return Tail{.end_time = time,
              .end_time_error = 4 * time,
              .normal_impulse = impulse,
              .normal_impulse_error = 4 * impulse,
              .tangential_impulse = rest * end.impulse.head<2>(),
              .corners = end.corners};
}

/// First event from the end back at which each of the tail's corners has struck.
std::size_t SpaceAccumulation::last_round(const Tail& tail) const {
  std::vector<int> unseen = tail.corners;
  std::size_t i = events_.size();
  while (i > 1 && !unseen.empty()) {
    --i;
    std::erase_if(unseen, [&](int corner) {
      const auto& struck = events_[i].corners;
      return std::find(struck.begin(), struck.end(), corner) != struck.end();
    });
  }
  return i;
}

Vector3 SpaceAccumulation::lever(const Tail& tail) const {
  double normal = 0;
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = last_round(tail); i < events_.size(); ++i) {
    normal += events_[i].impulse.z();
    moment += events_[i].moment;
  }
  return moment / normal;
}

bool undisturbed(const Drop& drop, const State& now, const Tail& tail) {
  const PrincipalAxes principal(drop.body.inertia);
  const FreeFlight flight(principal, now, drop.gravity, drop.gravity_along);
  const PointHeights heights(drop.body, flight);
  const FlightMoment moment = heights.moment(0);
  const double reach = heights.reach(), time = 2 * tail.end_time;
  const double jump = jump_of(drop.body, tail.normal_impulse + tail.tangential_impulse.norm());
  const double speed = now.angular_velocity.norm() + jump / reach;
  const double bend = drop.gravity + 2 * speed * speed * reach, rounding = 32 * detail::epsilon * reach;
  for (int i = 0; i < heights.count(); ++i) {
    if (std::find(tail.corners.begin(), tail.corners.end(), i) != tail.corners.end()) continue;
    const PointHeight h = heights.at(i, moment);
    // The rounding of a height cannot make a point that rises all the time reach the ground.
    const bool rises = h.height >= -rounding && h.velocity - jump - bend * time > 0;
    if (rises) continue;
    if (!(h.height + std::fmin(h.velocity - jump, 0.0) * time - bend / 2 * time * time > 0)) return false;
  }
  return true;
}

void end_state(const Drop& drop, const ImpactRow& last, const Vector3& lever, Tail& tail) {
  const Body& body = drop.body;
  const Impact& impact = last.impact;
  const Vector3 impulse(tail.tangential_impulse.x(), tail.tangential_impulse.y(), tail.normal_impulse);
  const Matrix3 axes = last.before.attitude.toRotationMatrix();
  const Vector3 change = axes * (body.inertia.inverse() * (axes.transpose() * (tail.normal_impulse * lever)));
  const Vector3 fall = tail.end_time * Vector3(drop.gravity_along, 0, -drop.gravity);
  // Euler's equations over the time that is left.
  const Vector3 w = axes.transpose() * impact.angular_velocity_after;
  const Vector3 drift = axes * (body.inertia.inverse() * (body.inertia * w).cross(w)) * tail.end_time;
  tail.velocity_after = impact.velocity_after + impulse / body.mass + fall;
  tail.angular_velocity_after = impact.angular_velocity_after + change + drift;
  if (body.is_centred_sphere()) tail.velocity_after.z() = 0;
  if (tail.corners.size() < 3 && !(last.corners.front().radius > 0)) return;  // neither a face nor a level rim
  tail.velocity_after.z() = 0;
  tail.angular_velocity_after.head<2>().setZero();
  const bool sticks = impact.path == PathKind::stick || impact.path == PathKind::slip_stick;
  if (sticks && tail.angular_velocity_after == Vector3::Zero()) tail.velocity_after.setZero();
}

bool keeps_slipping(const Drop& drop, const ImpactRow& last, const Tail& tail) {
  const Body& body = drop.body;
  const PathKind path = last.impact.path;
  if (path == PathKind::frictionless || path == PathKind::stick || path == PathKind::slip_stick) return true;
  const double turning = last.impact.angular_velocity_after.norm(), impulse = tail.tangential_impulse.norm();
  const double change = jump_of(body, tail.normal_impulse + impulse) +
                        (turning * turning * body.reach() + std::fabs(drop.gravity_along)) * tail.end_time;
  return 2 * change < last.impact.contact_after.head<2>().norm();
}

void add_errors(const Drop& drop, const ImpactRow& last, Tail& tail) {
  const RowErrors& e = last.error;
  const double reach = drop.body.reach(), turning = drop.body.is_ball() ? 0 : last.impact.angular_velocity_after.norm();
  const double normal = tail.normal_impulse, left = tail.end_time - last.start;
  // A hop takes 2u/|h″|.
  const double bend = 4 * reach * turning * (e.angular_velocity_after + turning * e.attitude);
  const double share = e.approach_speed / last.approach_speed +
                       (bend > 0 && !last.group ? bend / std::fabs(last.flight.acceleration) : 0);
  tail.end_time_error += e.start + share * left;
  tail.normal_impulse_error += share * normal;
  if (normal > 0) {
    tail.tangential_impulse_error +=
        tail.tangential_impulse.norm() * tail.normal_impulse_error / normal + 2 * turning * left * normal;
  }
  const double error = tail.normal_impulse_error + tail.tangential_impulse_error;
  const double turned = 2 * turning * left;  // of the corner's arm and the inertia's axes
  tail.velocity_error += e.velocity_after + error / drop.body.mass;
  tail.angular_velocity_error +=
      e.angular_velocity_after + jump_of(drop.body, error + turned * normal) / reach + turned * turning * turned;
}

std::size_t known_rows(const std::vector<ImpactRow>& rows) {
  const auto lost = std::ranges::find_if(rows, [](const ImpactRow& row) { return !row.error.predictable; });
  return static_cast<std::size_t>(lost - rows.begin());
}

bool ends_for_certain(const Drop& drop, const std::vector<ImpactRow>& rows, Tail& tail) {
  const std::size_t count = known_rows(rows);
  const auto lost = std::span(rows).subspan(count);
  const auto stays = [&](const Corner& corner) { return std::ranges::count(tail.corners, corner.index) > 0; };
  const ImpactRow* const known = count == 0 ? nullptr : &rows[count - 1];
  bool certain =
      known && std::ranges::all_of(lost, [&](const ImpactRow& row) { return std::ranges::all_of(row.corners, stays); });
  Tail since = tail;
  if (certain) {
    since.end_time -= known->start;
    for (const ImpactRow& row : lost) {
      since.normal_impulse += row.impact.impulse.z();
      since.tangential_impulse.x() += row.impact.impulse.head<2>().norm();
    }
    certain = undisturbed(drop, state_after(*known), since);
  }
  if (!certain) {
    tail.forget();
    return false;
  }
  constexpr double safety = 4;
  const double impulse = safety * (since.normal_impulse + since.tangential_impulse.norm());
  tail.end_time_error = known->error.start + safety * since.end_time;
  tail.normal_impulse_error = tail.tangential_impulse_error = impulse;
  tail.velocity_error = known->error.velocity_after + impulse / drop.body.mass;
  tail.angular_velocity_error = known->error.angular_velocity_after + jump_of(drop.body, impulse) / drop.body.reach();
  return true;
}

StateErrors errors_since(const Drop& drop, const State& known, const StateErrors& errors, const Tail& since) {
  constexpr double safety = 4;
  const double impulse = safety * (since.normal_impulse + since.tangential_impulse.norm());
  const double time = safety * since.end_time, reach = drop.body.reach();
  const double turning = known.angular_velocity.norm() + jump_of(drop.body, impulse) / reach;
  return {
      .time = errors.time + time,
      .attitude = errors.attitude + turning * time,
      .velocity = errors.velocity + impulse / drop.body.mass + (drop.gravity + std::fabs(drop.gravity_along)) * time,
      .angular_velocity = errors.angular_velocity + jump_of(drop.body, impulse) / reach + turning * turning * time};
}

}  // namespace clatter::analytic::space
