// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/face_friction.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/contact_area.hpp"
#include "analytic/space/impulse/slip_motion.hpp"

namespace clatter::analytic::space {

namespace {

// Where the ground pushes a level face that slips while it rebounds as far as pushes can make it.
//
// To turn as the rebound as a whole asks, the face needs its pushes at
//     R = R₀ + S f,   f = (F, K) = −μ (∫q d dA, ∫q x × d dA),                                         (5)
// which lies up to μh ahead of R₀, h the depth of the ground.  Where that is outside the area C the ground pushes at
//     x̂ = R₀ + λ S f,                                                                                 (6)
// λ <= 1 the largest with x̂ in C such that λ by the largest slip so far is no larger than before; the moment of the
// rest, R − x̂, tilts the body. Friction is that of the linear pressure without tension whose centre is R₀ + λ² S f, or
// the point nearest to it of C shrunk about its middle by the part η: pressure at an edge or a corner alone would have
// a friction that changes at once with slip. So friction does not lead by more than C has room for, slip whose
// direction turns again and again has no corner of its path after the first turn, and slip of rounding is forgotten. If
// R₀ is outside, λ stays 1, and no pressure is had where R is outside. A solution goes on from the last
// one. At the start, and where that one ends, it is the one that the solution without friction becomes as λ grows from
// 0: f, x̂ and λ depend on no index of a corner.

// The point of a convex area that is nearest to another in a given metric.

/// A convex polygon, or a unit disc about 0 for no corners, in the metric of B: q with (x − q)·B (x − q) least.
class NearestInArea {
 public:
  /// @param corners  counter-clockwise; none: the unit disc
  /// @param metric   B, symmetric positive definite
  NearestInArea(std::vector<Vector2> corners, const Matrix2& metric) : corners_(std::move(corners)), metric_(metric) {}

  struct Nearest {
    Vector2 point = Vector2::Zero();      ///< q
    Matrix2 slope = Matrix2::Identity();  ///< dq/dx: of the side, the corner or the arc on which q lies
    bool is_inside = true;                ///< q = x
  };

  [[nodiscard]] Nearest to(const Vector2& x) const {
    if (contains(x)) return {.point = x};
    return corners_.empty() ? in_disc(x) : in_polygon(x);
  }

  /// The same in the area shrunk by `part` about 0.
  [[nodiscard]] Nearest to(const Vector2& x, double part) const {
    Nearest nearest = to(x / part);
    nearest.point = nearest.is_inside ? x : Vector2(part * nearest.point);
    return nearest;
  }

 private:
  [[nodiscard]] bool contains(const Vector2& x) const {
    if (corners_.empty()) return x.squaredNorm() <= 1;
    const Vector2* from = &corners_.back();
    for (const Vector2& to : corners_) {
      if (!(cross(to - *from, x - *from) >= 0)) return false;
      from = &to;
    }
    return true;
  }

  [[nodiscard]] Nearest in_polygon(const Vector2& x) const {
    Nearest nearest;
    nearest.is_inside = false;
    double least = std::numeric_limits<double>::infinity();
    const Vector2* from = &corners_.back();
    for (const Vector2& to : corners_) {
      const Vector2 side = to - *from, weighted = metric_ * side;
      const double along = weighted.dot(x - *from) / weighted.dot(side), part = std::clamp(along, 0.0, 1.0);
      const Vector2 point = *from + part * side;
      if (const double apart = (x - point).dot(metric_ * (x - point)); apart < least) {
        least = apart;
        nearest.point = point;
        nearest.slope.setZero();
        if (part == along) nearest.slope = side * weighted.transpose() / weighted.dot(side);
      }
      from = &to;
    }
    return nearest;
  }

  /// (B + λ) q = B x with λ > 0 that makes |q| = 1, by Newton's method for 1/|q|, which is nearly straight.
  [[nodiscard]] Nearest in_disc(const Vector2& x) const {
    constexpr int most_turns = 60;
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const Eigen::SelfAdjointEigenSolver<Matrix2> axes(metric_);
    const Eigen::Array2d b = axes.eigenvalues().array(), pulled = b * (axes.eigenvectors().transpose() * x).array();
    double push = 0;
    Eigen::Array2d q = pulled / b;
    for (int i = 0; i < most_turns; ++i) {
      const double size = q.matrix().norm();
      if (std::fabs(size - 1) <= rounding) break;
      push += (size - 1) * size * size / (q.square() / (b + push)).sum();
      q = pulled / (b + push);
    }
    Nearest nearest{.point = axes.eigenvectors() * q.matrix().normalized(), .is_inside = false};
    const Vector2 along(-nearest.point.y(), nearest.point.x());
    const Vector2 weighted = metric_ * along;
    nearest.slope = along * weighted.transpose() / (weighted.dot(along) + push);
    return nearest;
  }

  std::vector<Vector2> corners_;
  Matrix2 metric_;
};

/// Changes where the error of Newton's method is its square.
constexpr double settled_change = 1e-7;
/// Points no farther beyond a side are on it.
constexpr double side_rounding = 64 * std::numeric_limits<double>::epsilon();

std::vector<Vector2> corners_in_units(const ContactArea& area, const PressedArea& pushed) {
  std::vector<Vector2> corners;
  if (area.radius > 0) return corners;
  for (const Vector2& corner : area.corners) corners.emplace_back((corner - pushed.centre()) / pushed.unit());
  return corners;
}

Vector3 with_one(const Vector2& x) { return {1, x.x(), x.y()}; }

/// η.
inline constexpr double rubbed_margin = 0.01;

/// C and what decides where it is pushed; world frame, from the centre of mass.
struct PressedFace {
  double friction = 0;                ///< μ
  Vector2 point = Vector2::Zero();    ///< R₀ [m]
  Eigen::Matrix<double, 2, 3> shift;  ///< S
};

class FacePressure {
 public:
  FacePressure(const ContactArea& area, const PressedFace& face)
      : corners_(corners_in_units(area, PressedArea(area))), pushed_(area), without_friction_(in_units(face.point)),
        is_bounded_(area.contains(face.point)), shift_(face.shift / pushed_.unit()),
        nearest_(corners_, Matrix2::Identity()), whole_moments_(pushed_.moments()), moments_(whole_moments_) {
    const Vector2& centre = pushed_.centre();
    rubbing_ << 1, 0, 0, 0, 1, 0, -centre.y(), centre.x(), pushed_.unit();
    rubbing_ *= -face.friction;
    begin();
  }

  struct Push {
    Vector3 friction = Vector3::Zero();  ///< f [1, m]
    Vector2 beyond = Vector2::Zero();    ///< R − x̂ [m]
  };

  void begin() {
    now_ = {};
    largest_slip_ = 0;
    now_.place = {.point = without_friction_, .pressure = Vector3(1 / whole_moments_(0, 0), 0, 0)};
    kept_ = now_;
  }

  /// Against the slip U below the centre of mass and the spin w, of any size.
  /// @param may_jump  to a solution that does not go on from the last one
  /// @return friction NaN without that leave, or without pressure
  [[nodiscard]] Push against(const Vector2& slip, double spin, bool may_jump) {
    const Push none{Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), Vector2::Zero()};
    const Vector2& centre = pushed_.centre();
    slip_ = slip + spin * Vector2(-centre.y(), centre.x());
    spin_ = spin;
    const Vector3 direction = Vector3(slip_.x(), slip_.y(), spin_ * unit()).normalized();
    // x̂ and the pressure change as they did between the last two directions.
    const Vector3 way = now_.direction - now_.direction_before;
    const double part = (direction - now_.direction).dot(way) / way.squaredNorm();
    const Place last = now_.place;
    if (std::fabs(part) <= 2) {
      now_.place.point += part * (last.point - now_.before.point);
      now_.place.pressure += part * (last.pressure - now_.before.pressure);
    }
    if (!settle_within()) {
      now_.place = last;
      if (!settle_within()) {
        if (!may_jump) return none;
        has_jumped_ = true;
        grow_from_no_friction();
      }
    }
    now_.before = last;
    now_.direction_before = now_.direction;
    now_.direction = direction;
    if (!is_bounded_ && side(now_.place.point, outermost(now_.place.point)).beyond > side_rounding) return none;
    return {.friction = friction_now_, .beyond = unit() * ((1 - now_.place.share) * (shift_ * friction_now_))};
  }

  /// Later solutions go on from the last one; go_back() takes those back that came after the last keep().
  void keep() {
    kept_ = now_;
    largest_slip_ = std::fmax(largest_slip_, slip_size());
    has_jumped_ = false;
  }

  void go_back() {
    now_ = kept_;
    has_jumped_ = false;
  }
  /// x̂ is on the boundary of C, where λ becomes less.
  [[nodiscard]] bool is_at_side() const { return now_.place.is_at_side; }
  /// The pressure is that of a small part of C, and its friction less accurate.
  [[nodiscard]] bool is_near_side() const {
    constexpr double near = 0.05;
    return side(now_.place.point, outermost(now_.place.point)).beyond > -near;
  }

  /// One of the solutions since the last keep() does not go on from the one before it.
  [[nodiscard]] bool has_jumped() const { return has_jumped_; }
  /// λ by the largest slip so far, which does not grow.
  [[nodiscard]] double share_by_slip() const { return now_.place.share / std::fmax(largest_slip_, slip_size()); }

  /// A pressure that stays, with its centre as near to `point` as η lets it be, and its friction.
  void press_near(const Vector2& point) {
    now_.place.pressure << 1 / whole_moments_(0, 0), 0, 0;
    press_at(nearest_.to(in_units(point), 1 - rubbed_margin).point);
  }

  [[nodiscard]] Vector3 friction_against(const Vector2& slip, double spin) const {
    const Vector2& centre = pushed_.centre();
    const Vector2 u = slip + spin * Vector2(-centre.y(), centre.x());
    return rubbing_ * (pushed_.slip_moments(u, spin * unit()) * now_.place.pressure);
  }

  [[nodiscard]] const std::vector<Vector2>& corners() const { return corners_; }  ///< in units from the centre
  [[nodiscard]] double unit() const { return pushed_.unit(); }
  [[nodiscard]] Vector2 in_units(const Vector2& point) const { return (point - pushed_.centre()) / unit(); }

 private:
  /// A solution: x̂ in units, λ, and the pressure.
  struct Place {
    Vector2 point = Vector2::Zero();
    double share = 1;
    Vector3 pressure = Vector3::UnitX();
    bool is_at_side = false;
  };
  struct Known {
    Place place, before;  ///< at two directions of slip
    Vector3 direction = Vector3::Zero(), direction_before = Vector3::Zero();
  };
  /// How far a point is beyond a side, or the rim, and the derivative.
  struct Side {
    double beyond = -1;
    Vector2 normal = Vector2::Zero();
  };
  /// x̂ − R₀ − λ S f and its derivatives by x̂ and λ, and what goes into them.
  struct Balance {
    Vector2 excess;
    Eigen::Matrix<double, 2, 3> slope;
    NearestInArea::Nearest rubbed;
    Vector3 friction;
    Matrix3 rubs;
    Eigen::Matrix<double, 3, 2> pressure_slope;
    bool is_whole;
  };

  [[nodiscard]] Side side(const Vector2& point, std::size_t i) const {
    if (corners_.empty()) {
      const double away = point.norm();
      return {away - 1, away > 0 ? Vector2(point / away) : Vector2::UnitX()};
    }
    const Vector2 along = (corners_[(i + 1) % corners_.size()] - corners_[i]).normalized(),
                  normal(along.y(), -along.x());
    return {normal.dot(point - corners_[i]), normal};
  }

  /// That which the point is farthest beyond.
  [[nodiscard]] std::size_t outermost(const Vector2& point) const {
    std::size_t most = 0;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      if (side(point, i).beyond > side(point, most).beyond) most = i;
    }
    return most;
  }

  [[nodiscard]] Balance balance(const Vector2& point, double share) {
    Balance b;
    const Vector2 moved_point = point - without_friction_;
    b.rubbed = nearest_.to(without_friction_ + share * moved_point, 1 - rubbed_margin);
    if (!press_at(b.rubbed.point)) {
      now_.place.pressure << 1 / whole_moments_(0, 0), 0, 0;
      press_at(b.rubbed.point);
    }
    b.rubs = rubbing_ * pushed_.slip_moments(slip_, spin_ * unit());
    b.friction = b.rubs * now_.place.pressure;
    b.pressure_slope = moments_.inverse().rightCols<2>();
    const Vector2 moved = shift_ * b.friction;
    b.excess = point - without_friction_ - share * moved;
    const Matrix2 by_centre = share * (shift_ * (b.rubs * b.pressure_slope)) * b.rubbed.slope;
    b.slope << Matrix2::Identity() - share * by_centre, -moved - by_centre * moved_point;
    b.is_whole = is_whole_;
    return b;
  }

  /// The pressure with this centre, which lies inside, by Newton's method for the bottom of a convex function.
  bool press_at(const Vector2& centre) {
    constexpr int most_turns = 100;
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    const Vector3 wanted = with_one(centre);
    Vector3& pressure = now_.place.pressure;
    Vector3 before = pressure;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_turns; ++i) {
      is_whole_ = pushed_.press(pressure);
      if (!pushed_.is_empty()) {
        moments_ = is_whole_ ? whole_moments_ : pushed_.moments();
        const Vector3 wrong = wanted - moments_ * pressure;
        const double size = wrong.norm();
        if (size <= rounding) return true;
        if (size < least) {
          least = size;
          before = pressure;
          pressure += moments_.partialPivLu().solve(wrong);
          continue;
        }
        if (least <= 64 * rounding * std::fmax(1, moments_.norm() * pressure.norm())) return true;
      }
      pressure = (before + pressure) / 2;
    }
    return false;
  }

  [[nodiscard]] double slip_size() const { return std::hypot(slip_.x(), slip_.y(), spin_ * unit()); }
  /// λ of the last kept solution, times what slip has grown beyond the largest so far.
  [[nodiscard]] double most_share() const {
    const double growth = largest_slip_ > 0 ? slip_size() / largest_slip_ : 1;
    return std::fmin(kept_.place.share * std::fmax(growth, 1), 1);
  }

  /// Newton's method for x̂ with the share that it has, or for x̂ and the share with x̂ on a side.
  bool settle(std::optional<std::size_t> on_side) {
    constexpr int most_turns = 30;
    constexpr double on_one_piece = 1e-15;
    Place& now = now_.place;
    Vector3 before(now.point.x(), now.point.y(), now.share);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_turns; ++i) {
      const Balance b = balance(now.point, now.share);
      Vector3 wrong(b.excess.x(), b.excess.y(), 0);
      Matrix3 equations = Matrix3::Identity();
      equations.topRows<2>() = b.slope;
      if (on_side) {
        const Side at = side(now.point, *on_side);
        wrong.z() = at.beyond;
        equations.row(2) << at.normal.transpose(), 0;
      }
      const double size = wrong.norm();
      if (!std::isfinite(size)) return false;
      Vector3 next = (before + Vector3(now.point.x(), now.point.y(), now.share)) / 2;
      bool is_solved = false;
      if (size < least) {
        least = size;
        const Vector3 change = -equations.partialPivLu().solve(wrong);
        const Vector2 moved =
            b.rubbed.slope * (now.share * change.head<2>() + change.z() * (now.point - without_friction_));
        const Vector3 more = b.pressure_slope * moved;
        before << now.point, now.share;
        next = before + change;
        is_solved = change.norm() <= settled_change * (1 + next.norm());
        if (!is_solved && b.is_whole && !on_side) {  // all is linear there
          const Vector2 there =
              nearest_.to(without_friction_ + next.z() * (next.head<2>() - without_friction_), 1 - rubbed_margin).point;
          is_solved = (there - b.rubbed.point - moved).norm() <= on_one_piece && pushed_.press(now.pressure + more);
        }
        if (is_solved) {
          now.pressure += more;
          friction_now_ = b.friction + b.rubs * more;
        }
      }
      if (!next.allFinite()) return false;
      now.point = next.head<2>();
      now.share = next.z();
      if (is_solved) return true;
    }
    return false;
  }

  /// From a place near the solution, with the share that it had at the last kept one, or less.
  bool settle_within() {
    Place& now = now_.place;
    const double most_share = this->most_share();
    now.is_at_side = is_bounded_ && now.is_at_side && now.share <= most_share;
    if (!now.is_at_side) {
      now.share = most_share;
      if (!settle({})) return false;
      if (!is_bounded_) return true;
    }
    for (std::size_t tried = 0; tried <= std::max<std::size_t>(corners_.size(), 2); ++tried) {
      const std::size_t most = outermost(now.point);
      const double beyond = side(now.point, most).beyond;
      if (!now.is_at_side) {
        if (beyond <= side_rounding) return true;
        const double inside = side(without_friction_, most).beyond;
        const double part = std::fmax(inside / (inside - beyond), 0);
        now.share *= part;
        now.point = without_friction_ + part * (now.point - without_friction_);
      }
      now.is_at_side = true;
      if (!settle(most)) return false;
      if (now.share > most_share) {
        now.share = most_share;
        now.is_at_side = false;
        if (!settle({})) return false;
        continue;
      }
      if (now.share < 0) now.share = 0;
      if (side(now.point, outermost(now.point)).beyond <= side_rounding) return true;
    }
    return false;
  }

  /// Follows the solutions as the share of friction grows from 0, through turns back, to the share that is wanted or to
  /// a side of C: the tangent of their curve is the cross product of the gradients of the excess, which does not turn
  /// round.
  void grow_from_no_friction() {
    constexpr int most_steps = 1000;
    constexpr double longest = 0.5, shortest = 1e-10;
    const double most_share = this->most_share();
    Place& now = now_.place;
    now = {without_friction_, 0, Vector3(1 / whole_moments_(0, 0), 0, 0)};
    Vector3 x(now.point.x(), now.point.y(), 0), way = tangent_at(x);
    double step = 0.1;
    for (int i = 0; i < most_steps && way.allFinite(); ++i) {
      const Place before = now;
      Vector3 next;
      if (!follow(x, way, step, next)) {
        now = before;
        step /= 4;
        if (step < shortest) {  // the curve has a corner here
          way = tangent_at(x + 16 * step * way);
          step = 1e2 * shortest;
        }
        continue;
      }
      const Vector2 point = next.head<2>();
      const bool leaves = side(point, outermost(point)).beyond > 0, is_beyond = is_bounded_ && leaves;
      if (is_beyond || next.z() >= most_share) {
        now.is_at_side = is_beyond;
        now.point = point;
        now.share = is_beyond ? std::fmin(next.z(), most_share) : most_share;
        if (settle_within() && (Vector3(now.point.x(), now.point.y(), now.share) - x).norm() <= 4 * step) return;
        now = before;
        step /= 4;
        if (step < shortest) return;
        continue;
      }
      x = next;
      way = tangent_at(x);
      step = std::fmin(2 * step, longest);
    }
  }

  [[nodiscard]] Vector3 tangent_at(const Vector3& x) {
    const Balance b = balance(x.head<2>(), x.z());
    friction_now_ = b.friction;
    const Vector3 first = b.slope.row(0), second = b.slope.row(1);
    return first.cross(second).normalized();
  }

  /// A solution of the plane one step ahead.
  bool follow(const Vector3& from, const Vector3& way, double step, Vector3& x) {
    constexpr int most_turns = 8;
    constexpr double exact = 1e-9;
    const Vector3 guess = from + step * way;
    x = guess;
    for (int i = 0; i < most_turns; ++i) {
      const Balance b = balance(x.head<2>(), x.z());
      Matrix3 equations;
      equations << b.slope, way.transpose();
      const Vector3 wrong(b.excess.x(), b.excess.y(), way.dot(x - guess));
      const Vector3 change = equations.partialPivLu().solve(wrong);
      x -= change;
      if (!((x - guess).norm() <= step / 2)) return false;
      if (change.norm() <= exact) return true;
    }
    return false;
  }

  std::vector<Vector2> corners_;
  PressedArea pushed_;
  Vector2 without_friction_;              ///< R₀ in units
  bool is_bounded_, has_jumped_ = false;  ///< λ may be less than 1
  Eigen::Matrix<double, 2, 3> shift_;
  NearestInArea nearest_;
  Matrix3 rubbing_, whole_moments_, moments_;
  bool is_whole_ = true;
  Vector2 slip_ = Vector2::Zero();
  double spin_ = 0, largest_slip_ = 0;
  Known now_, kept_;
  Vector3 friction_now_ = Vector3::Zero();
};

/// Relative errors of the impulse of a landing whose pushes come near the boundary: where pressure always goes on from
/// what it was, and where it jumps, at a moment that is known to the square root of rounding.
constexpr double error_of_tilting = 1e-10, error_of_jump = 1e-5;
/// Local error of a step of such a landing.
constexpr double step_of_tilting = 1e-12;

/// What turns a face, of (1) to (3): E, J, α₀, R₀, S, B.
struct FaceTurning {
  Matrix2 held, metric;
  Vector2 mixed, point;
  Eigen::Matrix<double, 2, 3> shift;
  double inertia, drift;

  explicit FaceTurning(const SlidingFace& face)
      : held(face.inverse_inertia.topLeftCorner<2, 2>().inverse()), mixed(face.inverse_inertia.block<2, 1>(0, 2)) {
    const Vector2 moment = held * face.turn_rate, per_couple = held * mixed;
    inertia = 1 / (face.inverse_inertia(2, 2) - mixed.dot(per_couple));
    drift = mixed.dot(moment);
    point = quarter_turn(moment);
    shift << -face.depth, 0, per_couple.y(), 0, -face.depth, -per_couple.x();
    metric = turned(face.inverse_inertia.topLeftCorner<2, 2>());
  }
  /// A matrix of tilts, given for the axes of turns, for the slopes that they make.
  static Matrix2 turned(const Matrix2& a) { return (Matrix2() << a(1, 1), -a(0, 1), -a(1, 0), a(0, 0)).finished(); }
};

Vector2 drift_of_slip(const SlidingFace& face) { return face.depth * quarter_turn(face.turn_rate); }

/// A face that does not slip: where its pushes are asked for and act, and what friction and tilt do to it per P.
struct HeldFace {
  Vector2 point, beyond;  ///< x̂; R − x̂ of the moment about the centre of mass [m]
  Vector3 friction;       ///< (F, K)
};

/// The path of (U, w), in the metric of the kinetic energy: y = (√m U, √J w), and of ∫(R − x̂) dP in units of N ℓ.
class FacePath final : SlipMotion {
 public:
  FacePath(const SlidingFace& face, const ContactArea& area)
      : SlipMotion(5), face_(face), turning_(face), pressure_(area, {face.friction, turning_.point, turning_.shift}),
        root_(std::sqrt(face.mass), std::sqrt(face.mass), std::sqrt(turning_.inertia)),
        unit_(pressure_.unit() * face.normal_impulse) {
    load_ << root_[0] * drift_of_slip(face), root_[2] * turning_.drift;
    if (!(face.normal_impulse * load_.norm() > rounding())) load_.setZero();
    only_friction_ = load_ == Vector3::Zero();
    y_.head<3>() << root_[0] * face.slip, root_[2] * face.spin;
    of_beyond_ = root_.asDiagonal() * turning_.shift.transpose() * turning_.metric;
  }

  FaceFriction follow() {
    FaceFriction result;
    const Vector3 before = y_.head<3>();
    const bool slips = before.norm() > rounding();
    const End end = slips ? slide() : End::stopped;
    is_lost_ = end == End::no_pressure;
    if (end == End::stopped) {
      const HeldFace held = this->held();
      if (go_on_from_rest(held)) {
        result.path = slips ? PathKind::slip_reslip : PathKind::slip;
      } else {
        result.path = slips ? PathKind::slip_stick : PathKind::stick;
        y_.tail<2>() += (face_.normal_impulse - spent_) / unit_ * held.beyond;
      }
    }
    const Vector2 beyond = unit_ * y_.tail<2>();
    const Vector3 change = y_.head<3>() - before - face_.normal_impulse * load_ - of_beyond_ * beyond;
    result.impulse = root_[0] * change.head<2>();
    result.couple = root_[2] * change.z();
    result.moment = quarter_turn(beyond);
    result.has_pressure = !is_lost_;
    if (step_error_ == step_of_tilting) result.path_error = jumps_ ? error_of_jump : error_of_tilting;
    result.spin_after = y_[2] / root_[2];
    return result;
  }

 private:
  Values rate(const Values& y) override {
    const auto push = pressure_.against(y.head<2>() / root_[0], y[2] / root_[2], at_once_);
    Values change(5);
    change << load_ + Vector3(push.friction.array() / root_.array()) + of_beyond_ * push.beyond, push.beyond / unit_;
    return change;
  }

  double impulse_left(const Values&) override { return face_.normal_impulse - spent_; }
  bool end_stage() override { return true; }
  void keep() override {
    was_at_side_ = pressure_.is_at_side();
    if (pressure_.is_near_side()) step_error_ = step_of_tilting;
    jumps_ = jumps_ || (spent_ > 0 && pressure_.has_jumped());
    pressure_.keep();
  }
  void go_back() override { pressure_.go_back(); }

  /// The share of friction ends its fall within a millionth of slip from where it is least: the rest is of second
  /// order.
  bool may_step_to(const Values& next, const Values& then, double length) override {
    constexpr double near = 1e-6, ahead = 1e-5;
    const double size = next.head<3>().norm(), speed = then.head<3>().norm();
    if (pressure_.has_jumped()) return at_once_;
    if (!was_at_side_ || length * speed <= near * size) return true;
    if (!pressure_.is_at_side()) return false;
    const double share = pressure_.share_by_slip();
    (void)rate(next + ahead * size / speed * then);
    const bool falls = pressure_.share_by_slip() <= share;
    (void)rate(next);
    return falls;
  }

  /// Without slip tilting has the inertia of the body about the points that stay where they are, by which C is nearest.
  [[nodiscard]] HeldFace held() const {
    const Matrix2 own = face_.inverse_inertia.inverse().topLeftCorner<2, 2>();
    const Matrix2 about_ground = own + face_.mass * face_.depth * face_.depth * Matrix2::Identity();
    const Matrix2 tilting = about_ground.inverse();
    const Vector2 asked = quarter_turn(about_ground * face_.turn_rate);
    const NearestInArea nearest(pressure_.corners(), FaceTurning::turned(tilting));
    const auto pushed = nearest.to(pressure_.in_units(asked));
    const Vector2 beyond = pressure_.unit() * (pressure_.in_units(asked) - pushed.point);
    Vector2 tilt = Vector2::Zero();
    if (!pushed.is_inside) tilt = tilting * quarter_turn(beyond);
    const Vector2 turn = face_.turn_rate + tilt;
    Vector3 friction = Vector3::Zero();
    if (!only_friction_ || !pushed.is_inside) {
      friction << -face_.mass * face_.depth * quarter_turn(turn),
          -turning_.inertia * turning_.mixed.dot(turning_.held * turn);
    }
    return {asked - beyond, -quarter_turn(turning_.held * tilt), friction};
  }

  /// Whether friction can hold the face under the pressure that it then has; else where slip goes.
  bool is_held(const HeldFace& held, Vector3& direction) {
    const Vector3 load = -held.friction.array() / root_.array();
    if (load == Vector3::Zero()) return true;
    pressure_.press_near(held.point);
    SlipLetGo slip(load, [&](const Vector3& y) -> Vector3 {
      return pressure_.friction_against(y.head<2>() / root_[0], y[2] / root_[2]).array() / root_.array();
    });
    const bool is_held = slip.is_held();
    direction = slip.direction();
    return is_held;
  }

  /// Whether the face slips to the end of the impulse; otherwise it is held, by less than it would take where it seems
  /// to be let go and slip dies out.
  bool go_on_from_rest(const HeldFace& held) {
    y_.head<3>().setZero();
    Vector3 direction;
    if (is_held(held, direction)) return false;
    const Values at_rest = y_;
    const double spent = spent_;
    pressure_.begin();
    y_.head<3>() =
        first_slip * face_.normal_impulse * (held.friction.array() / root_.array()).matrix().norm() * direction;
    const End end = slide(true);
    is_lost_ = end == End::no_pressure;
    if (end == End::impulse_spent) return true;
    y_ = at_rest;
    spent_ = spent;
    return false;
  }

  /// What rounding leaves of y.
  [[nodiscard]] double rounding() const { return 16 * detail::epsilon * root_[0] * face_.velocity_scale; }

  const SlidingFace& face_;
  FaceTurning turning_;
  FacePressure pressure_;
  Vector3 root_;  ///< √m, √m, √J
  double unit_;   ///< [m·N·s]
  Vector3 load_;  ///< y′ without friction
  bool was_at_side_ = false, jumps_ = false, is_lost_ = false;
  Eigen::Matrix<double, 3, 2> of_beyond_;  ///< of y′ by R − x̂
};

}  // namespace

bool slides_straight(const SlidingFace& face, const ContactArea& area) {
  constexpr double rounding = 16 * detail::epsilon;
  const FaceTurning turning(face);
  const Vector2 drift = drift_of_slip(face);
  const double radius = std::sqrt(turning.inertia / face.mass);
  const double turns = std::fabs(face.spin) + face.normal_impulse * std::fabs(turning.drift);
  if (!(turns * radius <= rounding * face.velocity_scale)) return false;
  const Vector2 line = face.slip.norm() > rounding * face.velocity_scale ? face.slip : drift;
  if (line == Vector2::Zero()) return area.contains(turning.point);
  const auto off = [&](const Vector2& v) { return std::fabs(cross(line, v)) / line.norm(); };
  const Vector2 shift = face.friction * face.depth * line.normalized();
  return face.normal_impulse * off(drift) <= rounding * face.velocity_scale &&
         off(turning.point) <= rounding * (turning.point.norm() + radius) && area.contains(turning.point + shift) &&
         area.contains(turning.point - shift);
}

FaceFriction face_friction(const SlidingFace& face, const ContactArea& area) { return FacePath(face, area).follow(); }

namespace {

/// y = (√m U, √I_zz w, ψ, x/ℓ), ℓ the way that friction alone would leave a slide as fast as this.
class FaceSlide final : SlipMotion {
 public:
  FaceSlide(const SpinningFace& face, const ContactArea& area, double impulse)
      : SlipMotion(6), face_(face), pressure_(area, {face.friction, Vector2::Zero(), shift_of(face)}),
        weight_(face.mass * face.gravity), impulse_(impulse),
        root_(std::sqrt(face.mass), std::sqrt(face.mass), std::sqrt(face.moment)) {
    y_.head<3>() << root_[0] * face.slip, root_[2] * face.spin;
    unit_ = y_.head<3>().squaredNorm() / (2 * face.friction * weight_);
    only_friction_ = scales_along_ = true;
  }

  std::optional<SlidFace> follow() {
    const End end = slide();
    if (end == End::no_pressure) return {};
    SlidFace result{.time = spent_ / weight_, .has_stopped = end == End::stopped, .turn = y_[3]};
    result.way = unit_ * y_.tail<2>();
    if (result.has_stopped) return result;
    result.slip = Eigen::Rotation2Dd(y_[3]) * Vector2(y_.head<2>() / root_[0]);
    result.spin = y_[2] / root_[2];
    return result;
  }

 private:
  static Eigen::Matrix<double, 2, 3> shift_of(const SpinningFace& face) {
    Eigen::Matrix<double, 2, 3> shift = Eigen::Matrix<double, 2, 3>::Zero();
    shift.leftCols<2>() = -face.depth * Matrix2::Identity();
    return shift;
  }

  Values rate(const Values& y) override {
    const Vector2 slip = y.head<2>() / root_[0];
    const double spin = y[2] / root_[2];
    const auto push = pressure_.against(slip, spin, at_once_);
    Values change(6);
    change.head<3>() = push.friction.array() / root_.array();
    change.head<2>() -= root_[0] * spin / weight_ * quarter_turn(slip);
    change[3] = spin / weight_;
    change.tail<2>() = Eigen::Rotation2Dd(y[3]) * slip / (weight_ * unit_);
    if (push.beyond != Vector2::Zero()) change.setConstant(detail::missing);  // it tips
    return change;
  }
  double impulse_left(const Values&) override { return impulse_ - spent_; }
  bool end_stage() override { return true; }
  void keep() override { pressure_.keep(); }
  void go_back() override { pressure_.go_back(); }

  const SpinningFace& face_;
  FacePressure pressure_;
  double weight_, impulse_, unit_ = 1;
  Vector3 root_;  ///< √m, √m, √I_zz
};

}  // namespace

std::optional<SlidFace> slide_and_spin(const SpinningFace& face, const ContactArea& area, double until) {
  if (!(until > 0)) return SlidFace{.slip = face.slip, .spin = face.spin};
  return FaceSlide(face, area, face.mass * face.gravity * until).follow();
}

}  // namespace clatter::analytic::space
