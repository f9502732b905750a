// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/contact_area.hpp"

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace clatter::analytic::space {

namespace {

/// A pole nearer than this, in units of the area, gives closed forms; its cube is what they cancel.
constexpr double near_pole = 3;
/// Beyond this, rules of six and four points do what ten and eight do nearer.
constexpr double distant_pole = 16;
/// Gauss's rule of ten points gives an arc to rounding if this many of its halves fit between its middle and the angle,
/// complex for a pole off the circle, at which a point lies on the pole.
constexpr double pieces_away = 3;
constexpr double shortest_arc = 1e-15;
/// Four points do on a side shorter than this, seen from a pole that is not near.
constexpr double short_side = 0.1;

Vector2 quarter_turn(const Vector2& a) { return {-a.y(), a.x()}; }
Vector2 on_circle(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Gauss's rule on [0, 1].
template <unsigned points>
struct UnitRule {
  std::array<double, points> nodes, weights;
  UnitRule() {
    using Gauss = boost::math::quadrature::gauss<double, points>;
    constexpr unsigned half = points / 2;
    for (unsigned i = 0; i < half; ++i) {
      nodes[half + i] = (1 + Gauss::abscissa()[i]) / 2, nodes[half - 1 - i] = (1 - Gauss::abscissa()[i]) / 2;
      weights[half + i] = weights[half - 1 - i] = Gauss::weights()[i] / 2;
    }
  }
};

template <unsigned points>
const UnitRule<points>& unit_rule() {
  static const UnitRule<points> the_rule;
  return the_rule;
}

/// Integrals about the pole, ρ from it: ∫ρ/|ρ|, ∫ρρᵀ/|ρ|, ∫ρ|ρ| over the area.
struct PoleIntegrals {
  Vector2 direction = Vector2::Zero(), weighted = Vector2::Zero();
  Matrix2 tensor = Matrix2::Zero();

  void add_side(const Vector2& from, const Vector2& to);
  void add_arc(double from, double to, const Vector2& pole);
  void add_sector(const Vector2& point, double angle, const Vector2& pole);
  bool add_disc(const Vector2& pole);
};

/// ∫ f dA over the triangle of pole and side is d/(k + 2) ∫ f ds for f homogeneous of degree k, d the pole's distance.
void PoleIntegrals::add_side(const Vector2& from, const Vector2& to) {
  const Vector2 along = (to - from).normalized(), normal = -quarter_turn(along);
  const double d = from.dot(normal), s1 = from.dot(along), s2 = to.dot(along);
  if (d == 0) return;
  const double r1 = std::hypot(d, s1), r2 = std::hypot(d, s2);
  const double log = std::asinh(s2 / std::fabs(d)) - std::asinh(s1 / std::fabs(d));  // ∫ ds/r
  const double first = r2 - r1, distance = (s2 * r2 - s1 * r1 + d * d * log) / 2;    // ∫ s ds/r, ∫ r ds
  const Matrix2 mixed = normal * along.transpose();
  direction += d / 2 * (d * log * normal + first * along);
  tensor += d / 3 *
            (d * d * log * normal * normal.transpose() + d * first * (mixed + mixed.transpose()) +
             (distance - d * d * log) * along * along.transpose());
  weighted += d / 4 * (d * distance * normal + (r2 * r2 * r2 - r1 * r1 * r1) / 3 * along);
}

void PoleIntegrals::add_arc(double from, double to, const Vector2& pole) {
  const double half = (to - from) / 2, middle = from + half;
  const double off = std::remainder(middle - std::atan2(pole.y(), pole.x()), 2 * std::numbers::pi);
  if (pieces_away * half > std::hypot(off, std::log(pole.norm())) && half > shortest_arc) {
    add_arc(from, middle, pole);
    return add_arc(middle, to, pole);
  }
  const auto& rule = unit_rule<10>();
  const Vector2 centre = on_circle(middle);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const Vector2 turn = on_circle(half * (2 * rule.nodes[i] - 1));
    add_sector(turn.x() * centre + turn.y() * quarter_turn(centre), 2 * half * rule.weights[i], pole);
  }
}

/// The triangle of pole and boundary at `point` of the unit circle.
void PoleIntegrals::add_sector(const Vector2& point, double angle, const Vector2& pole) {
  const Vector2 rho = point - pole;
  const double r = rho.norm(), area = angle * rho.dot(point);
  if (r == 0) return;
  direction += area / 2 / r * rho;
  tensor += area / 3 / r * rho * rho.transpose();
  weighted += area / 4 * r * rho;
}

/// The whole disc by the trapezoidal rule, whose error is that of the pole's distance, or of its inverse, to the power
/// of the number of points; false if those would be many.
bool PoleIntegrals::add_disc(const Vector2& pole) {
  const double count = 8 + std::ceil(37 / std::fabs(std::log(pole.norm())));
  if (!(count <= 160)) return false;
  const double step = 2 * std::numbers::pi / count;
  const Vector2 turn = on_circle(step);
  Vector2 point(1, 0);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    add_sector(point, step, pole);
    point = (turn.x() * point + turn.y() * quarter_turn(point)).eval();
  }
  return true;
}

/// ∫ (δ_x, δ_y, ξ × δ)ᵀ (1, ξ, η) dA of δ = d − u/|u| for |u| = 1 and a pole far away.
template <unsigned outward, unsigned along>
class FarIntegrals {
 public:
  FarIntegrals(const Vector2& slip, double spin) : slip_(slip), spin_(spin) {}

  void add_side(const Vector2& from, const Vector2& to) {
    if ((to - from).squaredNorm() < short_side * short_side) add_side_by<4>(from, to);
    else add_side_by<along>(from, to);
  }
  void add_arc(double from, double to) {
    const auto& rule = unit_rule<along>();
    for (unsigned i = 0; i < along; ++i) {
      add(on_circle(from + rule.nodes[i] * (to - from)), rule.weights[i] * (to - from));
    }
  }
  Matrix3 sum = Matrix3::Zero();

 private:
  template <unsigned points>
  void add_side_by(const Vector2& from, const Vector2& to) {
    const auto& rule = unit_rule<points>();
    for (unsigned i = 0; i < points; ++i) {
      add(from + rule.nodes[i] * (to - from), rule.weights[i] * cross(from, to));
    }
  }
  /// The sector from the centre to a boundary point, `area` = ξ × dξ there.
  void add(const Vector2& point, double area) {
    using Nodes = Eigen::Array<double, outward, 1>;
    const auto& rule = unit_rule<outward>();
    const Eigen::Map<const Nodes> t(rule.nodes.data()), weights(rule.weights.data());
    const Vector2 turn = spin_ * quarter_turn(point);
    const Nodes excess = t * (2 * slip_.dot(turn) + t * turn.squaredNorm());  // |s|² − 1
    const Nodes speed = (1 + excess).sqrt(), weight = weights * t * area / speed;
    const Nodes back = excess / (1 + speed), first = weight * t, second = first * t;
    const auto row = [&](const Nodes& factor) {  // ∫ of δ = t turn − back u with this factor
      return Vector2((factor * t).sum() * turn - (factor * back).sum() * slip_);
    };
    const Vector2 once = row(weight), twice = row(first), thrice = row(second);
    sum.col(0) += Vector3(once.x(), once.y(), cross(point, twice));
    sum.col(1) += point.x() * Vector3(twice.x(), twice.y(), cross(point, thrice));
    sum.col(2) += point.y() * Vector3(twice.x(), twice.y(), cross(point, thrice));
  }

  Vector2 slip_;
  double spin_;
};

}  // namespace

bool ContactArea::contains(const Vector2& point) const {
  if (radius > 0) return (point - corners.front()).norm() <= radius;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2& from = corners[i];
    if (!(cross(corners[(i + 1) % corners.size()] - from, point - from) >= 0)) return false;
  }
  return corners.size() > 2;
}

PressedArea::PressedArea(const ContactArea& area) : centre_(Vector2::Zero()), unit_(area.radius) {
  for (const Vector2& corner : area.corners) centre_ += corner / static_cast<double>(area.corners.size());
  if (!(area.radius > 0)) {
    for (const Vector2& corner : area.corners) unit_ = std::fmax(unit_, (corner - centre_).norm());
    for (const Vector2& corner : area.corners) corners_.emplace_back((corner - centre_) / unit_);
  }
  press(Vector3::UnitX());
}

bool PressedArea::press(const Vector3& pressure) {
  sides_.clear();
  arcs_.clear();
  if (corners_.empty()) {
    press_disc(pressure);
    return sides_.empty() && !arcs_.empty();
  }
  const auto at = [&](const Vector2& x) { return pressure[0] + pressure.tail<2>().dot(x); };
  bool whole = true;
  Vector2 leaves = Vector2::Zero(), returns = Vector2::Zero();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector2 &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
    const double first = at(from), last = at(to);
    if (first > 0 && last > 0) {
      sides_.push_back({from, to});
      continue;
    }
    whole = false;
    if (!(first > 0) && !(last > 0)) continue;
    const Vector2 cut = from + first / (first - last) * (to - from);
    if (first > 0) sides_.push_back({from, cut}), leaves = cut;
    else sides_.push_back({cut, to}), returns = cut;
  }
  if (!whole && !sides_.empty() && leaves != returns) sides_.push_back({leaves, returns});
  return whole;
}

void PressedArea::press_disc(const Vector3& pressure) {
  const double slope = pressure.tail<2>().norm();
  if (pressure[0] >= slope) return add_arcs(0, 2 * std::numbers::pi);
  if (!(pressure[0] > -slope)) return;
  const double middle = std::atan2(pressure[2], pressure[1]), half = std::acos(-pressure[0] / slope);
  add_arcs(middle - half, middle + half);
  sides_.push_back({on_circle(middle + half), on_circle(middle - half)});
}

void PressedArea::add_arcs(double from, double to) {
  const int count = static_cast<int>(std::ceil((to - from) / (std::numbers::pi / 4) - 1e-9));
  for (int i = 0; i < count; ++i)
    arcs_.push_back({from + (to - from) * i / count, from + (to - from) * (i + 1) / count});
}

Matrix3 PressedArea::moments() const {
  Matrix3 m = Matrix3::Zero();
  const auto add = [&](double area, const Vector2& first, const Matrix2& second) {
    m(0, 0) += area;
    m.block<2, 1>(1, 0) += first;
    m.bottomRightCorner<2, 2>() += second;
  };
  for (const auto& [a, b] : sides_) {
    const Vector2 sum = a + b;
    const double twice = cross(a, b);
    add(twice / 2, twice / 6 * sum, twice / 24 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose()));
  }
  for (const auto& [from, to] : arcs_) {
    const Vector2 a = on_circle(from), b = on_circle(to);
    const double turn = to - from, swing = b.x() * b.y() - a.x() * a.y();
    const double mixed = (b.y() * b.y() - a.y() * a.y()) / 8;
    Matrix2 second;
    second << (turn + swing) / 8, mixed, mixed, (turn - swing) / 8;
    add(turn / 2, -quarter_turn(b - a) / 3, second);
  }
  m.block<1, 2>(0, 1) = m.block<2, 1>(1, 0).transpose();
  return m;
}

Matrix3 PressedArea::slip_moments(const Vector2& slip, double spin) const {
  Matrix3 result;
  const double speed = slip.norm();
  if (speed > near_pole * std::fabs(spin)) {
    const Vector2 u = slip / speed;
    const Matrix3 m = moments();
    result.topRows<2>() = u * m.row(0);
    result.row(2) = u.y() * m.row(1) - u.x() * m.row(2);
    const auto add = [&](auto far) {
      for (const auto& [from, to] : sides_) far.add_side(from, to);
      for (const auto& [from, to] : arcs_) far.add_arc(from, to);
      return Matrix3(result + far.sum);
    };
    if (spin == 0) return result;
    return speed > distant_pole * std::fabs(spin) ? add(FarIntegrals<4, 6>(u, spin / speed))
                                                  : add(FarIntegrals<8, 10>(u, spin / speed));
  }
  const Vector2 pole = quarter_turn(slip / spin);
  PoleIntegrals about;
  for (const auto& [from, to] : sides_) about.add_side(from - pole, to - pole);
  if (!sides_.empty() || !about.add_disc(pole)) {
    for (const auto& [from, to] : arcs_) about.add_arc(from, to, pole);
  }
  // d = ± ẑ × ρ/|ρ|, ξ × d = ± ξ·ρ/|ρ|, (ξ, η) = pole + ρ.
  Matrix2 first = about.direction * pole.transpose() + about.tensor;  // ∫ (ρ/|ρ|) (ξ, η)
  const double couple = pole.dot(about.direction) + about.tensor.trace();
  result.col(0) << quarter_turn(about.direction), couple;
  result.row(0).tail<2>() = -first.row(1);
  result.row(1).tail<2>() = first.row(0);
  result.row(2).tail<2>() = couple * pole.transpose() + (about.tensor * pole + about.weighted).transpose();
  return std::copysign(1.0, spin) * result;
}

}  // namespace clatter::analytic::space
