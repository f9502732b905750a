// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/ground_forces.hpp"

#include <Eigen/LU>
#include <cmath>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::infinite;
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// A system of one or two rows.
double determinant(const Small& m) { return m.rows() == 1 ? m(0, 0) : m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0); }

/// Unknowns of (1): `given` makes forces of them, `rows` takes from the accelerations those that are zero.
struct GroundUnknowns {
  Small given = Small::Zero(6, 6), rows = Small::Zero(6, 6);
  Eigen::Index count = 0;
};

/// Unit, of a corner that slips; across its edge where the other corner sticks or begins to slip that way, too.
Vector3 slip_direction(const State& s, std::span<const GroundPoint> points, std::size_t number) {
  const GroundPoint& point = points[number];
  const Vector3 near = slip_at(point.angle);
  if (points.size() == 2 && (points[1 - number].sticks || point.across)) {
    const Vector3 across = Vector3::UnitZ().cross(edge_of(s, points)).normalized();
    return std::copysign(1, across.dot(near)) * across;
  }
  const Vector3 v = slip_of(s, point);
  return point.begins ? near : v.norm() > 0 ? Vector3(v.normalized()) : v;
}

GroundUnknowns unknowns(const State& s, std::span<const GroundPoint> points, double friction) {
  GroundUnknowns u;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].sticks) {
      u.given.block<3, 3>(at, u.count).setIdentity();
      u.rows.block<3, 3>(u.count, at).setIdentity();
      u.count += 3;
    } else {
      u.given.block<3, 1>(at, u.count) = Vector3::UnitZ() - friction * slip_direction(s, points, i);
      u.rows(u.count, at + 2) = 1;
      u.count += 1;
    }
    at += 3;
  }
  return u;
}

/// The forces of all points.
SmallVector solved(const GroundUnknowns& u, const Small& effect, const SmallVector& free, const Vector3& edge,
                   double mass, bool& is_unique) {
  const Small which = u.rows.topRows(u.count), some = u.given.leftCols(u.count);
  Small equations = which * effect * some;
  // A P-matrix: all principal minors above 0; of corners that stick W is positive definite.
  if (u.count <= 2) is_unique = equations.diagonal().minCoeff() > 0 && determinant(equations) > 0;
  if (u.count == 4) is_unique = equations.determinant() > 0;  // one corner sticks
  if (u.count == 6) {  // forces that pull the corners of an edge apart do nothing: none of those
    SmallVector apart(6);
    apart << edge, -edge;
    equations += apart * apart.transpose() / mass;
  }
  return some * equations.partialPivLu().solve(-which * free);
}

/// ω̇ of a body that turns about an edge, by its weight: from the forces it would err by their rounding over the least
/// moment of inertia, however little that has to do with the turn.
/// @param arm  of a point of the edge, `edge` its unit direction
Vector3 turning_about_edge(const Drop& drop, const Matrix3& inertia, const Vector3& arm, const Vector3& edge) {
  const double away = arm.cross(edge).squaredNorm(), mass = drop.body.mass;
  const double moment = mass * drop.gravity * arm.cross(Vector3::UnitZ()).dot(edge);
  return moment / (edge.dot(inertia * edge) + mass * away) * edge;
}

}  // namespace

Vector3 edge_of(const State& s, std::span<const GroundPoint> points) {
  return horizontal(s.attitude * (points[1].place - points[0].place));
}

Vector3 slip_of(const State& s, const GroundPoint& point) { return horizontal(velocity_at(s, point.place)); }

GroundLaw::GroundLaw(const Drop& drop)
    : drop_(drop), friction_(drop.law.most_friction()), inverse_inertia_(drop.body.inertia.inverse()) {}

struct GroundLaw::Arms {
  Matrix3 inverse;            ///< I⁻¹, world frame
  std::vector<Vector3> arms;  ///< r_i
  Small effect = Small::Zero(6, 6);
  Vector3 edge = Vector3::Zero();  ///< its direction
};

GroundLaw::Arms GroundLaw::arms(const State& s, std::span<const GroundPoint> points) const {
  const Matrix3 axes = s.attitude.toRotationMatrix();
  Arms a{.inverse = axes * inverse_inertia_ * axes.transpose(), .arms = {}};
  for (const GroundPoint& p : points) a.arms.emplace_back(axes * p.place);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      a.effect.block<3, 3>(3 * i, 3 * j) =
          Matrix3::Identity() / drop_.body.mass - cross_matrix(a.arms[i]) * a.inverse * cross_matrix(a.arms[j]);
    }
  }
  if (points.size() == 2) a.edge = (a.arms[1] - a.arms[0]).normalized();
  return a;
}

GroundForces GroundLaw::forces(const State& s, std::span<const GroundPoint> points) const {
  const Matrix3 axes = s.attitude.toRotationMatrix();
  const Matrix3 inertia = axes * drop_.body.inertia * axes.transpose();
  const auto [inverse, arms, effect, edge] = this->arms(s, points);
  const Vector3& w = s.angular_velocity;
  const Vector3 free_turning = inverse * (inertia * w).cross(w), weight(0, 0, -drop_.gravity);
  SmallVector free = SmallVector::Zero(6);
  Eigen::Index at = 0;
  for (const Vector3& arm : arms) {
    free.segment<3>(at) = weight + free_turning.cross(arm) + w.cross(w.cross(arm));
    at += 3;
  }
  GroundForces f;
  const SmallVector all = solved(unknowns(s, points, friction_), effect, free, edge, drop_.body.mass, f.is_unique);
  f.turning = free_turning;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    f.of_points.emplace_back(all.segment<3>(3 * i));
    f.turning += inverse * arms[i].cross(f.of_points.back());
  }
  if (points.size() == 2 && points[0].sticks && points[1].sticks)
    f.turning = turning_about_edge(drop_, inertia, arms[0], edge);
  const SmallVector gained = free + effect * all;
  for (std::size_t i = 0; i < arms.size(); ++i) f.accelerations.emplace_back(gained.segment<3>(3 * i));
  return f;
}

State GroundLaw::stopped(State s, std::span<const GroundPoint> points) const {
  const auto [inverse, arms, effect, edge] = this->arms(s, points);
  SmallVector moving = SmallVector::Zero(6);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    moving.segment<3>(3 * i) = s.velocity + s.angular_velocity.cross(arms[i]);
  }
  bool is_unique = true;
  const SmallVector all = solved(unknowns(s, points, 0), effect, moving, edge, drop_.body.mass, is_unique);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Vector3 impulse = all.segment<3>(3 * i);
    s.velocity += impulse / drop_.body.mass;
    s.angular_velocity += inverse * arms[i].cross(impulse);
  }
  return s;
}

std::array<GroundLaw::EdgeLoad, 2> GroundLaw::edge_loads(const State& s, std::span<const GroundPoint> points,
                                                         const GroundForces& f) const {
  std::array<EdgeLoad, 2> loads;
  for (std::size_t i = 0; i < 2; ++i) {
    EdgeLoad& load = loads[i];
    load.along = edge_of(s, points).normalized();
    load.across = horizontal(f.of_points[i]) - f.of_points[i].dot(load.along) * load.along;
    load.limit = friction_ * f.of_points[i].z();
    load.left = load.limit - load.across.norm();
    load.room = std::sqrt(std::fmax(load.limit * load.limit - load.across.squaredNorm(), 0.0));
  }
  return loads;
}

double GroundLaw::friction_left(const State& s, std::span<const GroundPoint> points, const GroundForces& f) const {
  if (points.size() == 2 && points[0].sticks && points[1].sticks) {
    const auto [a, b] = edge_loads(s, points, f);
    const double along = std::fabs(a.along.dot(f.of_points[0] + f.of_points[1]));
    return std::fmin(std::fmin(a.left, b.left), a.room + b.room - along);
  }
  double least = infinite;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].sticks) continue;
    least = std::fmin(least, friction_ * f.of_points[i].z() - f.of_points[i].head<2>().norm());
  }
  return least;
}

State state_of(const GroundMotion& y, std::span<const GroundPoint> points) {
  State s;
  s.attitude = Quaternion(y[0], y[1], y[2], y[3]).normalized();
  s.angular_velocity = y.segment<3>(4);
  const Vector3 arm = s.attitude * points[0].place;
  s.velocity = slip_in(y) - s.angular_velocity.cross(arm);
  s.position = Vector3(y[9], y[10], 0) - arm;
  return s;
}

GroundMotion rate_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundForces& f) {
  const Quaternion turn(0, y[4], y[5], y[6]);
  const Quaternion change = turn * Quaternion(y[0], y[1], y[2], y[3]);
  GroundMotion result;
  result << change.w() / 2, change.vec() / 2, f.turning, f.accelerations[0].head<2>(), y[7], y[8];
  if (points[0].sticks) result.tail<4>().setZero();
  return result;
}

Vector3 slip_of(const GroundMotion& y, std::span<const GroundPoint> points, const GroundPoint& point) {
  const Vector3 from_first = Quaternion(y[0], y[1], y[2], y[3]) * (point.place - points[0].place);
  return slip_in(y) + horizontal(Vector3(y.segment<3>(4)).cross(from_first));
}

double MotionScale::largest(const GroundMotion& change) const {
  const double velocities = std::fmax(change.segment<3>(4).norm() * reach, change.segment<2>(7).norm());
  return std::fmax(change.head<4>().norm(), velocities / speed);
}

}  // namespace clatter::analytic::space
