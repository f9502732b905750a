// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/striking_body.hpp"

#include <Eigen/LU>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/impulse/impulse_path.hpp"
#include "analytic/space/landing/face_friction.hpp"

namespace clatter::analytic::space {

namespace {

/// A landing that gains more of the energy than this whatever its restitution is none.
constexpr double without_gain = 1e-12;

/// Where the pushes act in the ground, if its friction has the moment of a force below the centre of mass.
Vector2 point_of_pushes(const Vector3& impulse, const Vector3& moment, const Vector3& below) {
  const Vector2 of_pushes = (moment - below.cross(impulse)).head<2>();
  return Vector2(-of_pushes.y(), of_pushes.x()) / impulse.z();
}

}  // namespace

VelocityRounding::VelocityRounding(const Body& body, const State& before)
    : speed_(before.velocity.norm()), turning_(before.angular_velocity.norm()),
      gain_(body.mass * body.inertia.inverse().cwiseAbs().rowwise().sum()) {
  const Vector3 own = before.attitude.conjugate() * before.angular_velocity;
  change_ = std::sqrt(speed_ * speed_ + own.dot(body.inertia * own) / body.mass);
}

double VelocityRounding::at(const Vector3& place) const {
  const double x = place.x(), y = place.y(), z = place.z(), distance = place.norm();
  const double turning = gain_.dot(Vector3(std::hypot(y, z), std::hypot(x, z), std::hypot(x, y)));
  return 64 * detail::epsilon * (speed_ + turning_ * distance) +
         16 * detail::epsilon * change_ * (1 + distance * turning);
}

StrikingBody::StrikingBody(const Body& body, const State& before, const ImpactLaw& law)
    : body_(body), law_(law), state_(before), before_(before), rounding_(body, before),
      axes_(before.attitude.toRotationMatrix()) {
  law.validate();
  inverse_inertia_ = axes_ * body.inertia.inverse() * axes_.transpose();
}

void StrikingBody::strike_at(const Vector3& place, const std::vector<int>& points, const ImpactLaw& law) {
  const Impact impact = space::strike(body_, state_, place, law);
  push(impact.impulse, arm(place).cross(impact.impulse), impact.path, points);
}

/// e of the law at the approach speed of the pressure point that a face which comes down has without friction.
double StrikingBody::face_restitution() const {
  const double speed = -state_.velocity.z();
  const Matrix2 inertia = inverse_inertia_.topLeftCorner<2, 2>().inverse();  // that pushes upwards have to turn
  const Vector2 turning = state_.angular_velocity.head<2>();
  return restitution_at(law_, speed + turning.dot(inertia * turning) / (body_.mass * speed));
}

FaceRebound StrikingBody::face_rebound_by(double e, double depth) const {
  const double speed = -state_.velocity.z();
  const Matrix2 inertia = inverse_inertia_.topLeftCorner<2, 2>().inverse();
  const Vector2 turn = -(1 + e) * state_.angular_velocity.head<2>();
  const Vector2 moment = inertia * turn;
  const double normal = (1 + e) * body_.mass * speed;
  const Vector3 below(0, 0, -depth);
  const Vector3 slip = velocity(below);
  const ContactImpulse whole =
      face_impulse({.mass = body_.mass,
                    .approach_speed = speed,
                    .restitution = e,
                    .slip = slip.head<2>(),
                    .drift = Vector2(-depth * turn.y(), depth * turn.x()) / normal,
                    .velocity_scale = state_.velocity.norm() + state_.angular_velocity.norm() * depth},
                   law_);
  const Vector3 of_all(moment.x(), moment.y(), 0);
  return {.impulse = whole.impulse,
          .moment = of_all,
          .pressure_point = point_of_pushes(whole.impulse, of_all, below),
          .path = whole.path};
}

std::optional<FaceRebound> StrikingBody::face_rebound(double depth) const {
  if (!(state_.velocity.z() < 0)) return {};
  return face_rebound_by(face_restitution(), depth);
}

std::optional<FaceRebound> StrikingBody::face_rebound_by(double e, double depth, const ContactArea& area) const {
  std::optional<FaceRebound> rebound = face_rebound_by(e, depth);
  if (!law_.rubs()) return area.contains(rebound->pressure_point) ? rebound : std::nullopt;
  const Vector2 turn = inverse_inertia_.topLeftCorner<2, 2>() * rebound->moment.head<2>();
  const Vector3 below(0, 0, -depth);
  const SlidingFace face{.mass = body_.mass,
                         .inverse_inertia = inverse_inertia_,
                         .depth = depth,
                         .friction = law_.friction_value,
                         .normal_impulse = rebound->impulse.z(),
                         .turn_rate = turn / rebound->impulse.z(),
                         .slip = velocity(below).head<2>(),
                         .spin = state_.angular_velocity.z(),
                         .velocity_scale = state_.velocity.norm() + state_.angular_velocity.norm() * depth};
  if (slides_straight(face, area)) return rebound;
  const FaceFriction friction = face_friction(face, area);
  rebound->tilts = friction.moment != Vector2::Zero();
  const Vector2 without_friction(-rebound->moment.y(), rebound->moment.x());
  const bool pushes_without_friction = area.contains(without_friction / rebound->impulse.z());
  if (!pushes_without_friction && (rebound->tilts || !friction.has_pressure)) return {};
  rebound->is_lost = !friction.has_pressure;
  if (rebound->is_lost) return rebound;
  rebound->path_error = friction.path_error;
  rebound->path = friction.path;
  if (friction.path == PathKind::stick && friction.couple == 0 && !rebound->tilts) return rebound;
  const Matrix2 inertia = inverse_inertia_.topLeftCorner<2, 2>().inverse();
  rebound->impulse.head<2>() = friction.impulse;
  rebound->moment.head<2>() += friction.moment - friction.couple * (inertia * inverse_inertia_.block<2, 1>(0, 2));
  rebound->moment.z() = friction.couple;
  rebound->pressure_point = point_of_pushes(rebound->impulse, rebound->moment, below);
  rebound->spin_after = friction.spin_after;
  return rebound;
}

double StrikingBody::energy() const {
  const Vector3 own = axes_.transpose() * state_.angular_velocity;
  return (body_.mass * state_.velocity.squaredNorm() + own.dot(body_.inertia * own)) / 2;
}

double StrikingBody::energy_loss(const FaceRebound& face) const {
  const Vector3 velocity = state_.velocity + face.impulse / (2 * body_.mass);
  const Vector3 turning = state_.angular_velocity + inverse_inertia_ * face.moment / 2;
  return -face.impulse.dot(velocity) - face.moment.dot(turning);
}

std::optional<FaceRebound> StrikingBody::face_rebound(double depth, const ContactArea& area) const {
  if (!(state_.velocity.z() < 0)) return {};
  const double e = face_restitution();
  auto rebound = face_rebound_by(e, depth, area);
  if (!rebound || rebound->is_lost || !law_.rubs() || may_gain_energy(law_.law)) return rebound;
  const double energy = this->energy();
  const double least = restitution_without_gain(e, energy, [&](double some) {
    const auto face = some == e ? rebound : face_rebound_by(some, depth, area);
    return face && !face->is_lost ? energy_loss(*face) : energy;
  });
  if (least < e) rebound = face_rebound_by(least, depth, area);
  if (rebound && energy_loss(*rebound) < -without_gain * energy) rebound->is_lost = true;
  return rebound;
}

EdgeContact StrikingBody::edge_contact(const Vector3& from, const Vector3& to) const {
  // In body axes, as in strike().
  const Vector3 middle = (from + to) / 2, half = (to - from) / 2, along = half.normalized();
  const Vector3 up = place(Vector3::UnitZ()), across = up.cross(along);
  Eigen::Matrix<double, 3, 5> force, moment;  // of the impulses f
  force << along, across, Vector3::Zero(), up, Vector3::Zero();
  moment << middle.cross(along), middle.cross(across), half.cross(across), middle.cross(up), half.cross(up);
  EdgeContact edge;
  edge.inverse_inertia = force.transpose() * force / body_.mass + moment.transpose() * body_.inertia.inverse() * moment;
  edge.velocity = force.transpose() * place(state_.velocity) + moment.transpose() * place(state_.angular_velocity);
  edge.velocity_scale = state_.velocity.norm() + state_.angular_velocity.norm() * (middle.norm() + half.norm());
  return edge;
}

std::optional<EdgeImpulse> StrikingBody::strike_along(const EdgeContact& edge, const Vector3& from, const Vector3& to,
                                                      const std::vector<int>& points) {
  const auto struck = edge_impulse(edge, law_);
  if (!struck) return {};
  const EdgeContact::Vector& f = struck->impulse;
  const double gain = f.dot(edge.velocity + edge.inverse_inertia * f / 2);
  if (struck->tilts && gain > without_gain * energy() && !may_gain_energy(law_.law)) return {};
  const Vector3 half = arm(to - from) / 2, along = half.normalized(), up = Vector3::UnitZ(), across = up.cross(along);
  const Vector3 impulse = f[0] * along + f[1] * across + f[3] * up;
  push(impulse, arm(from + to).cross(impulse) / 2 + half.cross(f[2] * across + f[4] * up), struck->path, points);
  impact_.tilts = impact_.tilts || struck->tilts;
  impact_.path_error = std::fmax(impact_.path_error, struck->path_error);
  return struck;
}

void StrikingBody::push(const FaceRebound& face, const std::vector<int>& points) {
  push(face.impulse, face.moment, face.path, points);
  impact_.tilts = impact_.tilts || face.tilts;
  impact_.path_error = std::fmax(impact_.path_error, face.path_error);
  if (face.spin_after) state_.angular_velocity.z() = *face.spin_after;
}

void StrikingBody::push(const Vector3& impulse, const Vector3& moment, PathKind path, const std::vector<int>& points) {
  if (impact_.order.empty()) impact_.path = path;
  add(impulse, moment);
  if (!merges_ || impact_.order.empty()) impact_.order.push_back(points);
}

void StrikingBody::add(const Vector3& impulse, const Vector3& moment) {
  impact_.impulse += impulse;
  impact_.moment += moment;
  state_.velocity += impulse / body_.mass;
  state_.angular_velocity += inverse_inertia_ * moment;
}

void StrikingBody::take(const StrikingBody& other) {
  state_ = other.state_;
  impact_ = other.impact_;
}

GroupImpact StrikingBody::result() const {
  GroupImpact result = impact_;
  result.velocity_after = state_.velocity;
  result.angular_velocity_after = state_.angular_velocity;
  result.energy_loss = -(result.impulse.dot(before_.velocity + state_.velocity) +
                         result.moment.dot(before_.angular_velocity + state_.angular_velocity)) /
                       2;
  return result;
}

/// What a sum of strikes to come may be wrong by, relative to all so far.
constexpr double series_error = 1e-9;
constexpr double part_left = 0.1;  ///< of the approach after it: what is left still approaches

bool StrikeSeries::converges(StrikingBody& struck) {
  if (struck.strikes() < next_) return false;
  next_ = struck.strikes() + block_;
  Sum& now = sums_.emplace_back();
  now << struck.impact().impulse, struck.impact().moment;
  if (sums_.size() < 4) return false;
  const std::size_t n = sums_.size();
  const Sum last = sums_[n - 1] - sums_[n - 2], before = sums_[n - 2] - sums_[n - 3];
  const Sum earliest = sums_[n - 3] - sums_[n - 4];
  const double ratio = last.norm() / before.norm();
  if (!(ratio < 1)) return false;
  // Each part may fall by a ratio of its own, and as that changes, the sum of the rounds to come is wrong.
  const double rounds = std::log(part_left) / std::log(ratio);
  Sum rest = Sum::Zero();
  double wrong = 0;
  for (Eigen::Index i = 0; i < rest.size(); ++i) {
    if (!(std::fabs(last[i]) > series_error * (1 - ratio) * now.norm())) continue;
    const double own = last[i] / before[i], change = own - before[i] / earliest[i];
    if (!(own > 0 && own < 1)) return false;
    rest[i] = last[i] * own * (1 - std::pow(own, rounds)) / (1 - own);
    wrong += std::fabs(last[i] * change) / ((1 - own) * (1 - own));
  }
  if (!(wrong <= series_error * now.norm())) return false;
  struck.add(rest.head<3>(), rest.tail<3>());
  sums_.clear();
  return true;
}

void check_number_of_strikes(std::size_t strikes) {
  if (strikes < 40000) return;
  throw NumericalError("corners that touch together strike one after the other without end");
}

}  // namespace clatter::analytic::space
