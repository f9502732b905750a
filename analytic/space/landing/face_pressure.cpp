// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/face_pressure.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter::analytic::space {

NearestInArea::NearestInArea(std::vector<Vector2> corners, const Matrix2& metric)
    : corners_(std::move(corners)), metric_(metric) {}

bool NearestInArea::contains(const Vector2& x) const {
  if (corners_.empty()) return x.squaredNorm() <= 1;
  const Vector2* from = &corners_.back();
  for (const Vector2& to : corners_) {
    if (!(cross(to - *from, x - *from) >= 0)) return false;
    from = &to;
  }
  return true;
}

NearestInArea::Nearest NearestInArea::to(const Vector2& x) const {
  if (contains(x)) return {.point = x};
  return corners_.empty() ? in_disc(x) : in_polygon(x);
}

NearestInArea::Nearest NearestInArea::in_polygon(const Vector2& x) const {
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
NearestInArea::Nearest NearestInArea::in_disc(const Vector2& x) const {
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

namespace {

/// Changes where the error of Newton's method is its square.
constexpr double settled_change = 1e-7;
/// Points no farther beyond a side are on it.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

std::vector<Vector2> corners_in_units(const ContactArea& area, const PressedArea& pushed) {
  std::vector<Vector2> corners;
  if (area.radius > 0) return corners;
  for (const Vector2& corner : area.corners) corners.emplace_back((corner - pushed.centre()) / pushed.unit());
  return corners;
}

Vector3 with_one(const Vector2& x) { return {1, x.x(), x.y()}; }

}  // namespace

FacePressure::FacePressure(const ContactArea& area, const PressedFace& face)
    : corners_(corners_in_units(area, PressedArea(area))), pushed_(area), without_friction_(in_units(face.point)),
      is_bounded_(area.contains(face.point)), shift_(face.shift / pushed_.unit()),
      nearest_(corners_, Matrix2::Identity()), whole_moments_(pushed_.moments()), moments_(whole_moments_) {
  const Vector2& centre = pushed_.centre();
  rubbing_ << 1, 0, 0, 0, 1, 0, -centre.y(), centre.x(), pushed_.unit();
  rubbing_ *= -face.friction;
  begin();
}

void FacePressure::begin() {
  now_ = {};
  largest_slip_ = 0;
  now_.place = {.point = without_friction_, .pressure = Vector3(1 / whole_moments_(0, 0), 0, 0)};
  kept_ = now_;
}

FacePressure::Side FacePressure::side(const Vector2& point, std::size_t i) const {
  if (corners_.empty()) {
    const double away = point.norm();
    return {away - 1, away > 0 ? Vector2(point / away) : Vector2::UnitX()};
  }
  const Vector2 along = (corners_[(i + 1) % corners_.size()] - corners_[i]).normalized(), normal(along.y(), -along.x());
  return {normal.dot(point - corners_[i]), normal};
}

std::size_t FacePressure::outermost(const Vector2& point) const {
  std::size_t most = 0;
  for (std::size_t i = 1; i < corners_.size(); ++i) {
    if (side(point, i).beyond > side(point, most).beyond) most = i;
  }
  return most;
}

bool FacePressure::is_near_side() const {
  constexpr double near = 0.05;
  return side(now_.place.point, outermost(now_.place.point)).beyond > -near;
}

/// The pressure with this centre, which lies inside, by Newton's method for the bottom of a convex function.
bool FacePressure::press_at(const Vector2& centre) {
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

FacePressure::Balance FacePressure::balance(const Vector2& point, double share) {
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

/// Newton's method for x̂ with the share that it has, or for x̂ and the share with x̂ on a side.
bool FacePressure::settle(std::optional<std::size_t> on_side) {
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

double FacePressure::most_share() const {
  const double growth = largest_slip_ > 0 ? slip_size() / largest_slip_ : 1;
  return std::fmin(kept_.place.share * std::fmax(growth, 1), 1);
}

/// From a place near the solution, with the share that it had at the last kept one, or less.
bool FacePressure::settle_within() {
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
      if (beyond <= rounding) return true;
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
    if (side(now.point, outermost(now.point)).beyond <= rounding) return true;
  }
  return false;
}

/// Follows the solutions as the share of friction grows from 0, through turns back, to the share that is wanted or to a
/// side of C: the tangent of their curve is the cross product of the gradients of the excess, which does not turn
/// round.
void FacePressure::grow_from_no_friction() {
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

Vector3 FacePressure::tangent_at(const Vector3& x) {
  const Balance b = balance(x.head<2>(), x.z());
  friction_now_ = b.friction;
  const Vector3 first = b.slope.row(0), second = b.slope.row(1);
  return first.cross(second).normalized();
}

/// A solution of the plane one step ahead.
bool FacePressure::follow(const Vector3& from, const Vector3& way, double step, Vector3& x) {
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

FacePressure::Push FacePressure::against(const Vector2& slip, double spin, bool may_jump) {
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
  if (!is_bounded_ && side(now_.place.point, outermost(now_.place.point)).beyond > rounding) return none;
  return {.friction = friction_now_, .beyond = unit() * ((1 - now_.place.share) * (shift_ * friction_now_))};
}

void FacePressure::keep() {
  kept_ = now_;
  largest_slip_ = std::fmax(largest_slip_, slip_size());
  has_jumped_ = false;
}

void FacePressure::press_near(const Vector2& point) {
  now_.place.pressure << 1 / whole_moments_(0, 0), 0, 0;
  press_at(nearest_.to(in_units(point), 1 - rubbed_margin).point);
}

Vector3 FacePressure::friction_against(const Vector2& slip, double spin) const {
  const Vector2& centre = pushed_.centre();
  const Vector2 u = slip + spin * Vector2(-centre.y(), centre.x());
  return rubbing_ * (pushed_.slip_moments(u, spin * unit()) * now_.place.pressure);
}

}  // namespace clatter::analytic::space
