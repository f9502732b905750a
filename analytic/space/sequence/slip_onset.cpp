// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/slip_onset.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

using SlipSlopes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 2>;

/// g of (1), its sign that of a turn of the slip.
SlipAngles across(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& points,
                  const SlipAngles& angles) {
  const GroundForces f = law.forces(s, directed(points, angles));
  SlipAngles g(angles.size());
  Eigen::Index k = 0;
  for (const std::size_t i : turning_points(points)) {
    g[k] = slip_at(angles[k]).cross(f.accelerations[i]).z();
    ++k;
  }
  return g;
}

SlipAngles angles_of(const std::vector<GroundPoint>& points) {
  const auto turning = turning_points(points);
  SlipAngles angles(static_cast<Eigen::Index>(turning.size()));
  for (Eigen::Index k = 0; k < angles.size(); ++k) angles[k] = points[turning[static_cast<std::size_t>(k)]].angle;
  return angles;
}

/// ∂g/∂φ.
SlipSlopes slopes(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& points,
                  const SlipAngles& angles) {
  constexpr double step = 1e-5;
  SlipSlopes all(angles.size(), angles.size());
  for (Eigen::Index k = 0; k < angles.size(); ++k) {
    const SlipAngles change = step * SlipAngles::Unit(angles.size(), k);
    all.col(k) = (across(law, s, points, angles + change) - across(law, s, points, angles - change)) / (2 * step);
  }
  return all;
}

/// Whether the solution drives slip beside it back, whatever the speeds of the corners.
bool attracts(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& points) {
  const SlipSlopes m = slopes(law, s, points, angles_of(points));
  return m.size() == 0 || (m.diagonal().maxCoeff() < 0 && (m.rows() == 1 || m.determinant() > 0));
}

void begin(GroundPoint& point, const Vector3& direction) {
  point.sticks = false;
  point.begins = true;
  point.angle = std::atan2(direction.y(), direction.x());
}

/// An edge both corners of which stuck: one gives way across the edge, or both do.
void give_way_on_edge(const GroundLaw& law, const State& s, std::vector<GroundPoint>& points, const GroundForces& f) {
  constexpr double together = 1e-6;  // of what friction can hold
  const auto loads = law.edge_loads(s, points, f);
  const auto has_no_room = [&](std::size_t i) { return loads[i].left <= together * loads[i].limit; };
  for (std::size_t i = 0; i < 2; ++i) {
    if (has_no_room(i) && !has_no_room(1 - i)) return begin(points[i], -loads[i].across);
  }
  const double along = loads[0].along.dot(f.of_points[0] + f.of_points[1]);
  const double share = along / (loads[0].room + loads[1].room);
  for (std::size_t i = 0; i < 2; ++i) {
    // Motion in the plane across the edge stays so: friction along the edge drives slip along it back.
    points[i].across = has_no_room(0) && std::fabs(along) <= together * loads[i].limit;
    begin(points[i], -loads[i].across - (points[i].across ? 0 : share * loads[i].room) * loads[i].along);
  }
}

/// The ways in which corners of an edge that stuck begin to slip across it: one, or both without a force along it.
std::vector<std::vector<GroundPoint>> ways_across(const GroundLaw& law, const State& s,
                                                  const std::vector<GroundPoint>& points) {
  const Vector3 along = edge_of(s, points).normalized();
  std::vector<std::vector<GroundPoint>> ways;
  for (const double side : {1.0, -1.0}) {
    auto some = points;
    for (GroundPoint& point : some) {
      if (point.sticks) continue;
      begin(point, side * Vector3::UnitZ().cross(along));
      point.across = turning_points(points).size() == 2;
    }
    const Vector3 acceleration = law.forces(s, some).accelerations[0];
    if (std::fabs(acceleration.dot(along)) <= 1e-6 * acceleration.norm() || !some[0].across) ways.push_back(some);
  }
  return ways;
}

/// Whether corners that stuck accelerate along the slip that they begin, and the others are held.
bool accelerates(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& stuck,
                 const std::vector<GroundPoint>& points) {
  const GroundForces f = law.forces(s, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(f.of_points[i].z() > 0)) return false;
    const bool begins = stuck[i].sticks && !points[i].sticks;
    if (begins && !(f.accelerations[i].dot(slip_at(points[i].angle)) > 0)) return false;
  }
  return f.is_unique && law.friction_left(s, points, f) >= 0;
}

/// The roots of g in directions all around: by changes of its sign for one corner, for two by Newton's method.
std::vector<std::vector<GroundPoint>> all_directions(const GroundLaw& law, const State& s,
                                                     const std::vector<GroundPoint>& points) {
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<std::vector<GroundPoint>> found;
  if (turning_points(points).size() == 1) {
    constexpr int directions = 180;
    const auto at = [&](double angle) {
      return std::signbit(across(law, s, points, SlipAngles::Constant(1, angle))[0]);
    };
    for (int i = 0; i < directions; ++i) {
      // In the middle between these limits lie the directions along x, which a motion in the plane has.
      double low = (i - 0.5) * turn / directions, high = low + turn / directions;
      const bool sign = at(low);
      if (sign == at(high)) continue;
      for (int k = 0; k < 60; ++k) (at((low + high) / 2) == sign ? low : high) = (low + high) / 2;
      found.push_back(directed(points, SlipAngles::Constant(1, low)));
    }
    return found;
  }
  constexpr int starts = 12;
  for (int i = 0; i < starts * starts; ++i) {
    SlipAngles start(2);
    start << turn / starts * (i % starts), turn / starts * (i / starts);
    const SlipAngles angles = slip_angles(law, s, directed(points, start), SlipAngles::Zero(2));
    if (!angles.allFinite()) continue;
    const auto is_same = [&](const std::vector<GroundPoint>& other) {
      return (slip_at(other[0].angle) - slip_at(angles[0])).norm() +
                 (slip_at(other[1].angle) - slip_at(angles[1])).norm() <
             1e-6;
    };
    if (std::ranges::none_of(found, is_same)) found.push_back(directed(points, angles));
  }
  return found;
}

}  // namespace

std::vector<std::size_t> turning_points(std::span<const GroundPoint> points) {
  std::vector<std::size_t> turning;
  if (std::ranges::any_of(points, &GroundPoint::sticks)) return turning;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].begins && !points[i].across) turning.push_back(i);
  }
  return turning;
}

std::vector<GroundPoint> directed(std::vector<GroundPoint> points, const SlipAngles& angles) {
  Eigen::Index k = 0;
  for (const std::size_t i : turning_points(points)) points[i].angle = angles[k++];
  return points;
}

SlipAngles slip_angles(const GroundLaw& law, const State& s, const std::vector<GroundPoint>& points,
                       const SlipAngles& target) {
  SlipAngles angles = angles_of(points);
  const SlipSlopes slope = slopes(law, s, points, angles);
  double last = detail::infinite;
  for (int i = 0; i < 20; ++i) {
    const SlipAngles change = slope.partialPivLu().solve(target - across(law, s, points, angles));
    const double size = change.cwiseAbs().maxCoeff();
    angles += change;
    if (size <= 4 * epsilon || (size <= 1e-12 && !(size < last))) return angles;
    last = size;
  }
  return SlipAngles::Constant(angles.size(), std::numeric_limits<double>::quiet_NaN());
}

std::optional<std::vector<GroundPoint>> give_way(const GroundLaw& law, const State& s, std::vector<GroundPoint> points,
                                                 double slow) {
  const GroundForces f = law.forces(s, points);
  if (points.size() == 2 && points[0].sticks && points[1].sticks) {
    give_way_on_edge(law, s, points, f);
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].sticks) begin(points[i], -f.of_points[i]);
      else if (slip_of(s, points[i]).norm() <= slow) points[i].begins = true;
    }
  }
  if (!attracts(law, s, points) || !law.forces(s, points).is_unique) return {};
  return points;
}

std::vector<std::vector<GroundPoint>> ways_to_slip(const GroundLaw& law, const State& s,
                                                   const std::vector<GroundPoint>& points) {
  std::vector<std::vector<GroundPoint>> ways;
  for (unsigned which = 1; which < 1u << points.size(); ++which) {  // bits: those that begin
    auto some = points;
    bool all_stuck = true;
    for (std::size_t i = 0; i < some.size(); ++i) {
      if ((which >> i & 1) == 0) continue;
      all_stuck = all_stuck && some[i].sticks;
      begin(some[i], Vector3::UnitX());
    }
    if (!all_stuck) continue;
    const bool hinge = points.size() == 2 && points[0].sticks && points[1].sticks;
    auto tried = hinge ? ways_across(law, s, some) : std::vector<std::vector<GroundPoint>>();
    if (tried.empty() && !turning_points(some).empty()) tried = all_directions(law, s, some);
    std::ranges::copy_if(tried, std::back_inserter(ways),
                         [&](const std::vector<GroundPoint>& way) { return accelerates(law, s, points, way); });
  }
  return ways;
}

}  // namespace clatter::analytic::space
