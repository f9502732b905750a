// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/ground_forces.hpp"

#include <Eigen/LU>
#include <cmath>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::infinite;
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// Of one or two rows.
double determinant(const Small& m) { return m.rows() == 1 ? m(0, 0) : m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0); }

/// Unknowns of (1): `given` makes forces of them, `rows` takes from the accelerations those that are zero.
struct GroundUnknowns {
  Small given = Small::Zero(6, 6), rows = Small::Zero(6, 6);
  Eigen::Index count = 0;
};

GroundUnknowns unknowns(const State& s, std::span<const GroundPoint> points, double friction, const Vector3* slipping) {
  GroundUnknowns u;
  Eigen::Index at = 0;
  for (const GroundPoint& point : points) {
    if (point.sticks) {
      u.given.block<3, 3>(at, u.count).setIdentity();
      u.rows.block<3, 3>(u.count, at).setIdentity();
      u.count += 3;
    } else {
      const Vector3 v = slip_of(s, point);
      const Vector3 direction = slipping != nullptr ? *slipping : v.norm() > 0 ? Vector3(v.normalized()) : v;
      u.given.block<3, 1>(at, u.count) = Vector3::UnitZ() - friction * direction;
      u.rows(u.count, at + 2) = 1;
      u.count += 1;
    }
    at += 3;
  }
  return u;
}

Vector3 edge_of(const State& s, std::span<const GroundPoint> points) {
  return s.attitude * (points[1].place - points[0].place);
}

/// The forces of all points.
SmallVector solved(const GroundUnknowns& u, const Small& effect, const SmallVector& free, const Vector3& edge,
                   double mass, bool& is_unique) {
  const Small which = u.rows.topRows(u.count), some = u.given.leftCols(u.count);
  Small equations = which * effect * some;
  // A P-matrix: all principal minors above 0; of corners that stick W is positive definite.
  if (u.count <= 2) is_unique = equations.diagonal().minCoeff() > 0 && determinant(equations) > 0;
  if (u.count == 6) {  // forces that pull the corners of an edge apart do nothing: none of those
    SmallVector apart(6);
    apart << edge, -edge;
    equations += apart * apart.transpose() / mass;
  }
  return some * equations.partialPivLu().solve(-which * free);
}

}  // namespace

Vector3 slip_of(const State& s, const GroundPoint& point) { return horizontal(velocity_at(s, point.place)); }

GroundLaw::GroundLaw(const Drop& drop)
    : drop_(drop), friction_(drop.law.law.most_friction()), inverse_inertia_(drop.body.inertia.inverse()) {}

GroundForces GroundLaw::forces(const State& s, std::span<const GroundPoint> points, const Vector3* slipping) const {
  const Matrix3 axes = s.attitude.toRotationMatrix();
  const Matrix3 inertia = axes * drop_.body.inertia * axes.transpose();
  const Matrix3 inverse = axes * inverse_inertia_ * axes.transpose();
  const Vector3& w = s.angular_velocity;
  const Vector3 free_turning = inverse * (inertia * w).cross(w), weight(0, 0, -drop_.gravity);
  Small effect = Small::Zero(6, 6);  // W
  SmallVector free = SmallVector::Zero(6);
  std::vector<Vector3> arms;
  for (const GroundPoint& p : points) {
    const Vector3 arm = axes * p.place;
    free.segment<3>(static_cast<Eigen::Index>(3 * arms.size())) =
        weight + free_turning.cross(arm) + w.cross(w.cross(arm));
    arms.push_back(arm);
  }
  for (std::size_t i = 0; i < arms.size(); ++i) {
    for (std::size_t j = 0; j < arms.size(); ++j) {
      effect.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) =
          Matrix3::Identity() / drop_.body.mass - cross_matrix(arms[i]) * inverse * cross_matrix(arms[j]);
    }
  }
  GroundForces f;
  const Vector3 edge = points.size() == 2 ? Vector3((arms[1] - arms[0]).normalized()) : Vector3(Vector3::Zero());
  const SmallVector all =
      solved(unknowns(s, points, friction_, slipping), effect, free, edge, drop_.body.mass, f.is_unique);
  f.turning = free_turning;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    f.of_points.emplace_back(all.segment<3>(static_cast<Eigen::Index>(3 * i)));
    f.turning += inverse * arms[i].cross(f.of_points.back());
  }
  f.first = free.head<3>() + effect.topRows<3>() * all;
  return f;
}

double GroundLaw::friction_left(const State& s, std::span<const GroundPoint> points, const GroundForces& f) const {
  const bool hinge = points.size() == 2 && points[0].sticks && points[1].sticks;
  double least = infinite, along = 0, room = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].sticks) continue;
    const double limit = friction_ * f.of_points[i].z();
    if (!hinge) {
      least = std::fmin(least, limit - f.of_points[i].head<2>().norm());
      continue;
    }
    const Vector3 edge = horizontal(edge_of(s, points)).normalized();
    const double mine = f.of_points[i].dot(edge), across = (horizontal(f.of_points[i]) - mine * edge).norm();
    along += mine;
    room += std::sqrt(std::fmax(limit * limit - across * across, 0.0));
    least = std::fmin(least, limit - across);
  }
  return hinge ? std::fmin(least, room - std::fabs(along)) : least;
}

}  // namespace clatter::analytic::space
