// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/slip_start.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

namespace {

/// P_0 … P_n.
template <std::size_t count>
std::array<double, count> legendre(double x) {
  std::array<double, count> p{1, x};
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const auto n = static_cast<double>(k);
    p[k + 1] = ((2 * n + 1) * x * p[k] - n * p[k - 1]) / (n + 1);
  }
  return p;
}

/// Collocation at Radau points: an implicit Runge–Kutta method for motions that are stiff at first.
///
/// The rates K_j at the points c_j of a step h from y give
///     Y_i = y + h Σ_j A_ij K_j,   A_ij = ∫₀^{c_i} l_j(c) dc,   c_s = 1,                                     (1)
/// l_j the polynomials of Lagrange.  The error of Y_s is of order h^(2s) where the motion is not stiff; one that is
/// driven back to where its slow solution lies is damped whatever the step (Hairer and Wanner, Radau IIA).
struct RadauRule {
  static constexpr int points = SlipStart::order;
  using Array = Eigen::Matrix<double, points, 1>;

  RadauRule() {
    constexpr auto s = static_cast<std::size_t>(points);
    Eigen::Matrix<double, points, points> values, integrals;
    for (int i = 0; i < points; ++i) {
      // The zeros of P_s − P_{s−1}, by Newton's method from those of a Chebyshev polynomial; the last is 1.
      double x = -std::cos(std::numbers::pi * (2 * i + 1) / (2 * points - 1));
      if (i == points - 1) x = 1;
      for (int k = 0; k < 50 && i < points - 1; ++k) {
        const auto p = legendre<s + 1>(x);
        const double n = points, scale = x * x - 1;
        const double slope = (n * (x * p[s] - p[s - 1]) - (n - 1) * (x * p[s - 1] - p[s - 2])) / scale;
        x -= (p[s] - p[s - 1]) / slope;
      }
      at[i] = (1 + x) / 2;
      const auto p = legendre<s + 1>(x);
      for (std::size_t k = 0; k < s; ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        values(i, column) = p[k];
        integrals(i, column) = k == 0 ? (1 + x) / 2 : (p[k + 1] - p[k - 1]) / (2 * (2 * static_cast<double>(k) + 1));
      }
    }
    const Eigen::Matrix<double, points, points> coefficients = values.inverse();
    weight = integrals * coefficients;
    highest = coefficients.row(points - 1);
  }

  Array at;                                      ///< c_j, ascending, the last is 1
  Eigen::Matrix<double, points, points> weight;  ///< A
  /// Coefficient of the highest Legendre polynomial of what has these values at the points: it falls off geometrically
  /// with the number of points, and times h bounds what the polynomial through them leaves out of Y_s.
  Array highest;
};

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
  SlipAngles angles(turning.size());
  for (Eigen::Index k = 0; k < angles.size(); ++k) angles[k] = points[turning[k]].angle;
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

namespace {

constexpr int stages = RadauRule::points;
using Stages = Eigen::Matrix<double, 11, stages>;

const RadauRule& radau_rule() {
  static const RadauRule the_rule;
  return the_rule;
}

/// What Newton's method has of a step so far.
class Collocation {
 public:
  Collocation(const GroundLaw& law, const std::vector<GroundPoint>& points, const GroundMotion& from, double length);

  /// Begins with the motion in directions in which slip would not turn, if there are such directions.
  bool begin(const std::vector<GroundPoint>& given);
  /// A step of Newton's method for the directions, in which the corners move at the stages; the rest of the state
  /// follows by iteration.  Returns the change of the state.
  double improve(const MotionScale& scale);

  [[nodiscard]] double least_speed() const { return speed_.topRows(corners()).minCoeff(); }
  [[nodiscard]] double stiffness() const;
  [[nodiscard]] GroundMotion end() const { return states_.col(stages - 1); }
  [[nodiscard]] GroundMotion error() const { return length_ * rates_ * radau_rule().highest; }
  [[nodiscard]] std::vector<GroundPoint> directed(int stage) const;

 private:
  using Equations = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2 * stages, 2 * stages>;
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * stages, 1>;

  [[nodiscard]] int corners() const { return static_cast<int>(turning_.size()); }
  [[nodiscard]] GroundPoint& point(std::vector<GroundPoint>& of, int k) const { return of[turning_[k]]; }
  [[nodiscard]] Stages reached(const Stages& rates) const {
    return from_.replicate<1, stages>() + length_ * rates * radau_rule().weight.transpose();
  }
  [[nodiscard]] GroundMotion rate(const GroundMotion& y, const std::vector<GroundPoint>& points) const {
    return rate_of(y, points, law_.forces(state_of(y, points), points));
  }
  void find_rates();
  void set_equations(const Stages& next, Equations& equations, Numbers& off);

  const GroundLaw& law_;
  GroundMotion from_;
  double length_;
  std::vector<GroundPoint> points_;   ///< every corner that slips has an angle of its own
  std::vector<std::size_t> turning_;  ///< those
  Eigen::Matrix<double, 2, stages> angles_ = Eigen::Matrix<double, 2, stages>::Zero();
  Eigen::Matrix<double, 2, stages> speed_ = angles_;  ///< along the angles
  Stages states_ = Stages::Zero(), rates_ = states_;
  std::array<Stages, 2> by_angle_{states_, states_};  ///< of the rates
};

Collocation::Collocation(const GroundLaw& law, const std::vector<GroundPoint>& points, const GroundMotion& from,
                         double length)
    : law_(law), from_(from), length_(length), points_(points) {
  for (GroundPoint& p : points_) {
    if (p.begins || p.across) continue;
    const Vector3 v = slip_of(from, points, p);
    p.angle = std::atan2(v.y(), v.x());
    p.begins = true;
  }
  turning_ = turning_points(points_);
}

std::vector<GroundPoint> Collocation::directed(int stage) const {
  auto all = points_;
  for (int k = 0; k < corners(); ++k) point(all, k).angle = angles_(k, stage);
  return all;
}

bool Collocation::begin(const std::vector<GroundPoint>& given) {
  const auto beginning = turning_points(given);
  const GroundMotion first = rate(from_, points_);
  for (int l = 0; l < stages; ++l) {
    const GroundMotion at = from_ + radau_rule().at[l] * length_ * first;
    const SlipAngles none = SlipAngles::Zero(beginning.size());
    const SlipAngles angles = slip_angles(law_, state_of(at, points_), given, none);
    if (!angles.allFinite()) return false;
    auto now = points_;
    for (std::size_t k = 0; k < beginning.size(); ++k) now[beginning[k]].angle = angles[k];
    for (int k = 0; k < corners(); ++k) angles_(k, l) = point(now, k).angle;
    rates_.col(l) = rate(at, now);
  }
  states_ = reached(rates_);
  for (int l = 0; l < stages; ++l) {  // of slip that is more than it gains in the step, the direction is its own
    for (int k = 0; k < corners(); ++k) {
      const Vector3 v = slip_of(GroundMotion(states_.col(l)), points_, point(points_, k));
      if (v.norm() > 0) angles_(k, l) = std::atan2(v.y(), v.x());
    }
  }
  return true;
}

/// At the stages, and how they change with the directions.
void Collocation::find_rates() {
  constexpr double step = 1e-5;
  for (int l = 0; l < stages; ++l) {
    const GroundMotion y = states_.col(l);
    rates_.col(l) = rate(y, directed(l));
    for (int k = 0; k < corners(); ++k) {
      auto more = directed(l), less = more;
      point(more, k).angle += step;
      point(less, k).angle -= step;
      by_angle_[k].col(l) = (rate(y, more) - rate(y, less)) / (2 * step);
    }
  }
}

/// That no corner moves across its direction, linear in changes of the directions: the state `next` has turned with the
/// rates so far.
void Collocation::set_equations(const Stages& next, Equations& equations, Numbers& off) {
  for (int l = 0; l < stages; ++l) {
    const GroundMotion y = next.col(l);
    for (int k = 0; k < corners(); ++k) {
      const GroundPoint& p = point(points_, k);
      const Vector3 along = slip_at(angles_(k, l)), aside = Vector3::UnitZ().cross(along);
      const Vector3 v = slip_of(y, points_, p);
      const Vector3 from_first = Quaternion(y[0], y[1], y[2], y[3]) * (p.place - points_[0].place);
      GroundMotion by_state = GroundMotion::Zero();  // of the slip aside
      by_state.segment<3>(4) = from_first.cross(aside);
      by_state.segment<2>(7) = aside.head<2>();
      const int row = corners() * l + k;
      for (int m = 0; m < stages; ++m) {
        for (int j = 0; j < corners(); ++j) {
          const double turned = by_state.dot(by_angle_[j].col(m));
          equations(row, corners() * m + j) = length_ * radau_rule().weight(l, m) * turned;
        }
      }
      speed_(k, l) = along.dot(v);
      equations(row, row) -= speed_(k, l);
      off[row] = aside.dot(v);
    }
  }
}

double Collocation::improve(const MotionScale& scale) {
  find_rates();
  Stages next = reached(rates_);
  Equations equations(corners() * stages, corners() * stages);
  Numbers off(corners() * stages);
  set_equations(next, equations, off);
  const Numbers turned = -equations.partialPivLu().solve(off);
  Stages turning = Stages::Zero();
  for (int l = 0; l < stages; ++l) {
    for (int k = 0; k < corners(); ++k) {
      const double angle = turned[corners() * l + k];
      angles_(k, l) += angle;
      turning.col(l) += angle * by_angle_[k].col(l);
    }
  }
  next += length_ * turning * radau_rule().weight.transpose();
  double change = 0;
  for (int l = 0; l < stages; ++l) change = std::fmax(change, scale.largest(next.col(l) - states_.col(l)));
  states_ = next;
  return next.allFinite() ? change : infinite;
}

double Collocation::stiffness() const {
  double largest = 0;
  for (int k = 0; k < corners(); ++k) {
    double turns = 0;
    for (int j = 0; j < corners(); ++j) {
      GroundMotion by = end();
      by.segment<5>(4) = by_angle_[j].col(stages - 1).segment<5>(4);
      turns += slip_of(by, points_, points_[turning_[k]]).norm();
    }
    largest = std::fmax(largest, turns / speed_(k, stages - 1));
  }
  return largest;
}

}  // namespace

SlipStart slip_start(const GroundLaw& law, const std::vector<GroundPoint>& points, const GroundMotion& from,
                     double length, const MotionScale& scale) {
  constexpr int most = 30;
  constexpr double precise = 1e-13, turned_back = 1e-13;  // of the scale
  SlipStart result{.end = from, .error = GroundMotion::Constant(infinite), .points = points};
  Collocation step(law, points, from, length);
  double change = infinite;
  const bool begins = step.begin(points);
  for (int i = 0; i < most && begins && !(change <= 4 * epsilon); ++i) {
    const double before = std::exchange(change, step.improve(scale));
    if (change <= precise && !(change < before)) break;
  }
  if (!(change <= precise) || !(step.least_speed() > -turned_back * scale.speed)) return result;
  result.end = step.end();
  result.error = step.error();
  result.stiffness = step.stiffness();
  const auto directions = step.directed(stages - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].begins) result.points[i].angle = directions[i].angle;
  }
  return result;
}

}  // namespace clatter::analytic::space
