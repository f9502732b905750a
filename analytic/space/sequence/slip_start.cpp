// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/slip_start.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <utility>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::infinite;

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
  [[nodiscard]] GroundPoint& point(std::vector<GroundPoint>& of, int k) const {
    return of[turning_[static_cast<std::size_t>(k)]];
  }
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
    const SlipAngles none = SlipAngles::Zero(static_cast<Eigen::Index>(beginning.size()));
    const SlipAngles angles = slip_angles(law_, state_of(at, points_), given, none);
    if (!angles.allFinite()) return false;
    auto now = points_;
    for (std::size_t k = 0; k < beginning.size(); ++k) now[beginning[k]].angle = angles[static_cast<Eigen::Index>(k)];
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
      by_angle_[static_cast<std::size_t>(k)].col(l) = (rate(y, more) - rate(y, less)) / (2 * step);
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
          const double turned = by_state.dot(by_angle_[static_cast<std::size_t>(j)].col(m));
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
      turning.col(l) += angle * by_angle_[static_cast<std::size_t>(k)].col(l);
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
      by.segment<5>(4) = by_angle_[static_cast<std::size_t>(j)].col(stages - 1).segment<5>(4);
      turns += slip_of(by, points_, points_[turning_[static_cast<std::size_t>(k)]]).norm();
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
