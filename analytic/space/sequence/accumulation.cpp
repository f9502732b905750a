// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/accumulation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

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
  const ImpactLaw& law = drop.law;
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
  const double e = drop.law.restitution;
  const Impact& impact = last.impact;
  const bool is_ball = drop.body.is_ball();  // which may turn: without slip, or friction, that stays as it is
  // On sloping ground slip begins anew in each flight.
  if (drop.gravity_along != 0 && drop.law.friction != FrictionKind::none) return {};
  if ((impact.angular_velocity_after != Vector3::Zero() && !is_ball) || !(drop.gravity > 0) || !(e < 1)) return {};
  const Vector3 arm = is_ball ? Vector3(Vector3::Zero()) : last.before.attitude * last.corners.front().place;
  if (!last.group && (arm.head<2>() != Vector2::Zero() || impact.impulse.head<2>() != Vector2::Zero())) return {};
  if (!(impact.velocity_after.z() >= 0)) return {};
  const double w = e * last.impact.approach_speed, mass = drop.body.mass;  // to the last digits, however small e is
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

void Rattling::touch(int corner) {
  const auto at = std::lower_bound(touched_.begin(), touched_.end(), corner);
  if (at == touched_.end() || *at != corner) touched_.insert(at, corner);
}

void Rattling::add(const ImpactRow& row) {
  Round round{.arrived = {},
              .touched = {},
              .time = row.start,
              .approach_speed = row.impact.approach_speed,
              .after = state_after(row)};
  for (const Corner& corner : row.corners) touch(corner.index);
  for (std::size_t i = 0; i + row.held < row.corners.size(); ++i) round.arrived.push_back(row.corners[i].index);
  std::ranges::sort(round.arrived);
  round.touched = std::exchange(touched_, {});
  rounds_.push_back(std::move(round));
}

std::optional<Tail> Rattling::extrapolate(const Drop& drop, const Tolerance& tolerance) const {
  constexpr std::size_t longest = 4;
  for (std::size_t period = 1; period <= longest; ++period) {
    if (repeats(period)) return extrapolate(drop, tolerance, period);
  }
  return {};
}

/// Whether three periods are alike.
bool Rattling::repeats(std::size_t period) const {
  const std::size_t count = rounds_.size();
  if (count < 3 * period + 1) return false;
  for (std::size_t i = count - 2 * period; i < count; ++i) {
    const Round &now = rounds_[i], &before = rounds_[i - period];
    if (now.arrived != before.arrived || now.touched != before.touched) return false;
  }
  return true;
}

std::optional<Tail> Rattling::extrapolate(const Drop& drop, const Tolerance& tolerance, std::size_t period) const {
  using Change = Eigen::Matrix<double, 9, 1>;
  const auto at = [&](std::size_t periods) -> const Round& { return rounds_[rounds_.size() - 1 - periods * period]; };
  const auto duration = [&](std::size_t k) { return at(k).time - at(k + 1).time; };
  const auto change = [&](std::size_t k) {
    const State &from = at(k + 1).after, &to = at(k).after;
    const Quaternion turn = to.attitude * from.attitude.conjugate();
    Change c;
    c << std::copysign(2, turn.w()) * turn.vec(), to.velocity - from.velocity,
        to.angular_velocity - from.angular_velocity;
    return c;
  };
  const double ratio = duration(0) / duration(1), ratio_before = duration(1) / duration(2);
  if (!(ratio < 1) || !(ratio_before < 1)) return {};
  const double left = ratio / (1 - ratio), left_before = ratio_before / (1 - ratio_before);
  const double time = duration(0) * left, other = duration(1) * left_before - duration(0);
  const double off = 2 * std::fabs(time - other) + 8 * detail::epsilon * at(0).time;
  const double unknown = tolerance.resolution / (ratio * at(0).approach_speed);
  if (!(off < time) || !(off <= std::fmax(tolerance.relative * time, unknown))) return {};
  const Change rest = left * change(0);
  const Change errors = 2 * (rest - (left_before * change(1) - change(0))).cwiseAbs() + off / time * rest.cwiseAbs();
  const double mass = drop.body.mass;
  Tail tail;
  tail.end_time = time;
  tail.end_time_error = off;
  tail.velocity_after = at(0).after.velocity + rest.segment<3>(3);
  tail.velocity_error = errors.segment<3>(3).norm();
  tail.angular_velocity_after = at(0).after.angular_velocity + rest.tail<3>();
  tail.angular_velocity_error = errors.tail<3>().norm();
  tail.normal_impulse = mass * (rest[5] + drop.gravity * time);
  tail.normal_impulse_error = mass * (errors[5] + drop.gravity * off);
  tail.tangential_impulse = mass * rest.segment<2>(3);
  tail.tangential_impulse_error = mass * errors.segment<2>(3).norm();
  std::vector<int> all;
  for (std::size_t i = 0; i < period; ++i) {
    const auto& some = rounds_[rounds_.size() - 1 - i].touched;
    all.insert(all.end(), some.begin(), some.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  tail.corners = all;
  if (!drop.body.lies_on(all.size())) return tail;
  tail.velocity_after.z() = 0;  // a face rests
  tail.angular_velocity_after.head<2>().setZero();
  return tail;
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
  if (!body.lies_on(tail.corners.size()) && !(last.corners.front().radius > 0)) return;  // nor on a level rim
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
  const double share = e.approach_speed / last.impact.approach_speed +
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
