// SPDX-License-Identifier: GPL-3.0-or-later
// Where the ground pushes a level face that slips while it rebounds as far as pushes can make it.
//
// To turn as the rebound as a whole asks, the face needs its pushes at
//     R = R₀ + S f,   f = (F, K) = −μ (∫q d dA, ∫q x × d dA),                                         (1)
// which lies up to μh ahead of R₀, h the depth of the ground.  Where that is outside the area C the ground pushes at
//     x̂ = R₀ + λ S f,                                                                                 (2)
// λ <= 1 the largest with x̂ in C such that λ by the largest slip so far is no larger than before; the moment of the
// rest, R − x̂, tilts the body. Friction is that of the linear pressure without tension whose centre is R₀ + λ² S f, or
// the point nearest to it of C shrunk about its middle by the part η: pressure at an edge or a corner alone would have
// a friction that changes at once with slip. So friction does not lead by more than C has room for, slip whose
// direction turns again and again has no corner of its path after the first turn, and slip of rounding is forgotten. If
// R₀ is outside, λ stays 1, and no pressure is had where R is outside. A solution goes on from the last
// one. At the start, and where that one ends, it is the one that the solution without friction becomes as λ grows from
// 0: f, x̂ and λ depend on no index of a corner.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "analytic/space/flight/body.hpp"
#include "analytic/space/impulse/contact_area.hpp"

namespace clatter::analytic::space {

// The point of a convex area that is nearest to another in a given metric.

/// A convex polygon, or a unit disc about 0 for no corners, in the metric of B: q with (x − q)·B (x − q) least.
class NearestInArea {
 public:
  /// @param corners  counter-clockwise; none: the unit disc
  /// @param metric   B, symmetric positive definite
  NearestInArea(std::vector<Vector2> corners, const Matrix2& metric);

  struct Nearest {
    Vector2 point = Vector2::Zero();      ///< q
    Matrix2 slope = Matrix2::Identity();  ///< dq/dx: of the side, the corner or the arc on which q lies
    bool is_inside = true;                ///< q = x
  };
  [[nodiscard]] Nearest to(const Vector2& x) const;
  /// The same in the area shrunk by `part` about 0.
  [[nodiscard]] Nearest to(const Vector2& x, double part) const {
    Nearest nearest = to(x / part);
    nearest.point = nearest.is_inside ? x : Vector2(part * nearest.point);
    return nearest;
  }

 private:
  [[nodiscard]] bool contains(const Vector2& x) const;
  [[nodiscard]] Nearest in_polygon(const Vector2& x) const;
  [[nodiscard]] Nearest in_disc(const Vector2& x) const;

  std::vector<Vector2> corners_;
  Matrix2 metric_;
};

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
  FacePressure(const ContactArea& area, const PressedFace& face);

  struct Push {
    Vector3 friction = Vector3::Zero();  ///< f [1, m]
    Vector2 beyond = Vector2::Zero();    ///< R − x̂ [m]
  };
  void begin();
  /// Against the slip U below the centre of mass and the spin w, of any size.
  /// @param may_jump  to a solution that does not go on from the last one
  /// @return friction NaN without that leave, or without pressure
  [[nodiscard]] Push against(const Vector2& slip, double spin, bool may_jump);
  /// Later solutions go on from the last one; go_back() takes those back that came after the last keep().
  void keep();
  void go_back() {
    now_ = kept_;
    has_jumped_ = false;
  }
  /// x̂ is on the boundary of C, where λ becomes less.
  [[nodiscard]] bool is_at_side() const { return now_.place.is_at_side; }
  /// The pressure is that of a small part of C, and its friction less accurate.
  [[nodiscard]] bool is_near_side() const;
  /// One of the solutions since the last keep() does not go on from the one before it.
  [[nodiscard]] bool has_jumped() const { return has_jumped_; }
  /// λ by the largest slip so far, which does not grow.
  [[nodiscard]] double share_by_slip() const { return now_.place.share / std::fmax(largest_slip_, slip_size()); }

  /// A pressure that stays, with its centre as near to `point` as η lets it be, and its friction.
  void press_near(const Vector2& point);
  [[nodiscard]] Vector3 friction_against(const Vector2& slip, double spin) const;
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
  [[nodiscard]] Side side(const Vector2& point, std::size_t i) const;
  /// That which the point is farthest beyond.
  [[nodiscard]] std::size_t outermost(const Vector2& point) const;
  [[nodiscard]] Balance balance(const Vector2& point, double share);
  bool press_at(const Vector2& centre);
  [[nodiscard]] double slip_size() const { return std::hypot(slip_.x(), slip_.y(), spin_ * unit()); }
  /// λ of the last kept solution, times what slip has grown beyond the largest so far.
  [[nodiscard]] double most_share() const;
  bool settle(std::optional<std::size_t> on_side);
  bool settle_within();
  void grow_from_no_friction();
  [[nodiscard]] Vector3 tangent_at(const Vector3& x);
  bool follow(const Vector3& from, const Vector3& way, double step, Vector3& x);

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

}  // namespace clatter::analytic::space
