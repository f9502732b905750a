// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/contact_area.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "analytic/space/flight/gauss_rule.hpp"

namespace clatter::analytic::space {

namespace {

/// A pole nearer than this, in units of the area, gives closed forms; its cube is what they cancel.
constexpr double near_pole = 3;
/// Beyond this, rules of six points do what ten and eight do nearer.
constexpr double distant_pole = 16;
/// Sixteen points give a piece of an arc to rounding if its pole, at an angle that is complex for one off the circle,
/// is so far from its ends together, in lengths of the piece; their error falls with the 32nd power of this and more.
constexpr double ends_away = 1.8;
constexpr double longest_piece = std::numbers::pi / 2, shortest_piece = 1e-15;
/// Four points do on a side shorter than this, in units of what is pushed, seen from a pole that is not near.
constexpr double short_side = 0.1;

Vector2 on_circle(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Gauss's rule on [0, 1].
template <unsigned points>
struct UnitRule {
  std::array<double, points> nodes, weights;
  UnitRule() {
    const GaussRule<points> rule;
    for (unsigned i = 0; i < points; ++i) nodes[i] = (1 + rule.nodes[i]) / 2, weights[i] = rule.weights[i] / 2;
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

  /// ∫ f dA over the triangle of pole and side is d/(k + 2) ∫ f ds for f homogeneous of degree k, d the pole's
  /// distance.
  void add_side(const Vector2& from, const Vector2& to) {
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
};

/// The same over triangles of the pole and arcs of the unit circle, angles from that of the pole.
class ArcIntegrals {
 public:
  explicit ArcIntegrals(const Vector2& pole)
      : away_(pole.norm()), off_circle_(std::fabs(std::log(away_))),
        towards_(away_ > 0 ? Vector2(pole / away_) : Vector2(Vector2::UnitX())) {
    for (Nodes& sum : sums_) sum.setZero();
  }

  void add(double from, double to) {
    constexpr double pi = std::numbers::pi;
    const double angle = std::atan2(towards_.y(), towards_.x());
    const double first = std::remainder(from - angle, 2 * pi), last = first + (to - from);
    for (int i = -1; i * pi < last; ++i) {  // half a turn, from the pole or towards it
      const double low = std::fmax(first, i * pi), high = std::fmin(last, (i + 1) * pi);
      if (!(low < high)) continue;
      if (i % 2 == 0) add_outward(low - i * pi, high - i * pi, 1);
      else add_outward((i + 1) * pi - high, (i + 1) * pi - low, -1);
    }
  }

  void add_circle() {
    folds_ = 2;
    add_outward(0, std::numbers::pi, 1);
  }

  /// Adds what the arcs are to the integrals.
  void give(PoleIntegrals& about) const {
    Matrix2 axes, tensor;
    axes << towards_, quarter_turn(towards_);
    const auto sum = [&](std::size_t i) { return folds_ * sums_[i].sum(); };
    const bool both_sides = folds_ > 1;
    const double mixed = both_sides ? 0 : sum(3);
    tensor << sum(2), mixed, mixed, sum(4);
    about.direction += axes * Vector2(sum(0), both_sides ? 0 : sum(1)) / 2;
    about.tensor += axes * tensor * axes.transpose() / 3;
    about.weighted += axes * Vector2(sum(5), both_sides ? 0 : sum(6)) / 4;
  }

 private:
  using Nodes = Eigen::Array<double, 16, 1>;

  /// In pieces as long as their distance from the pole allows; √(x² + log²|pole|) is that of the angle x.
  void add_outward(double near, double far, double side) {
    while (near < far) {
      const double reach = 2 * (near + ends_away * std::hypot(near, off_circle_)) / (ends_away * ends_away - 1);
      // A pole that is NaN takes long pieces, too.
      const double length = reach < longest_piece ? std::fmax(reach, shortest_piece) : longest_piece;
      const double end = length < far - near ? near + length : far;
      if (side > 0) add_piece(near, end);
      else add_piece(-end, -near);
      near = end;
    }
  }

  /// In s = tan(θ/2), θ from the middle: points are (1 − s², 2s)/(1 + s²), dθ = 2 ds/(1 + s²).
  void add_piece(double from, double to) {
    const auto& rule = unit_rule<16>();
    const Eigen::Map<const Nodes> nodes(rule.nodes.data()), weights(rule.weights.data());
    const double tangent = std::tan((to - from) / 4);
    const Vector2 middle = on_circle(from + (to - from) / 2);
    const Nodes s = tangent * (2 * nodes - 1), part = (1 + s * s).inverse();
    const Nodes ahead = (1 - s * s) * part, aside = 2 * s * part;
    const Nodes x = middle.x() * ahead - middle.y() * aside, y = middle.y() * ahead + middle.x() * aside;
    const Nodes along = x - away_, square = along * along + y * y;
    constexpr double tiny = std::numeric_limits<double>::min();  // where a point is on the pole
    const Nodes over = 4 * tangent * weights * part * (1 - away_ * x) / (square + tiny).sqrt();
    const Nodes first = over * along, second = over * y;
    sums_[0] += first, sums_[1] += second;
    sums_[2] += first * along, sums_[3] += first * y, sums_[4] += second * y;
    sums_[5] += first * square, sums_[6] += second * square;
  }

  double away_, off_circle_;
  Vector2 towards_;
  std::array<Nodes, 7> sums_;  ///< along the pole and across: ρ/|ρ|; ρρᵀ/|ρ|; ρ|ρ|
  double folds_ = 1;           ///< how often the arcs count, for those on both sides of the pole
};

/// ∫ (δ_x, δ_y, ξ × δ)ᵀ (1, ξ, η) dA of δ = d − u/|u| for |u| = 1 and a pole far away.
template <unsigned outward, unsigned along>
class FarIntegrals {
 public:
  FarIntegrals(const Vector2& slip, double spin, double extent)
      : slip_(slip), spin_(spin), short_(short_side * extent) {}

  void add_side(const Vector2& from, const Vector2& to) {
    if ((to - from).squaredNorm() < short_ * short_) add_side_by<4>(from, to);
    else add_side_by<along>(from, to);
  }
  void add_arc(double from, double to) {
    const auto& rule = unit_rule<along>();
    const int pieces = static_cast<int>(std::ceil((to - from) / (std::numbers::pi / 4) - 1e-9));
    const double length = (to - from) / pieces;
    for (int piece = 0; piece < pieces; ++piece) {
      for (unsigned i = 0; i < along; ++i) {
        add(on_circle(from + (piece + rule.nodes[i]) * length), rule.weights[i] * length);
      }
    }
  }
  Matrix3 sum = Matrix3::Zero();

 private:
  template <unsigned points>
  void add_side_by(const Vector2& from, const Vector2& to) {
    const auto& rule = unit_rule<points>();
    for (unsigned i = 0; i < points; ++i) add(from + rule.nodes[i] * (to - from), rule.weights[i] * cross(from, to));
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
  double spin_, short_;
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

Vector2 ContactArea::middle() const {
  Vector2 mean = Vector2::Zero();
  for (const Vector2& corner : corners) mean += corner / static_cast<double>(corners.size());
  return mean;
}

double ContactArea::extent() const {
  const Vector2 mean = middle();
  double most = radius;
  for (const Vector2& corner : corners) most = std::fmax(most, (corner - mean).norm());
  return most;
}

PressedArea::PressedArea(const ContactArea& area) : centre_(area.middle()), unit_(area.extent()) {
  if (!(area.radius > 0)) {
    for (const Vector2& corner : area.corners) corners_.emplace_back((corner - centre_) / unit_);
  }
  press(Vector3::UnitX());
}

bool PressedArea::press(const Vector3& pressure) {
  sides_.clear();
  arc_ = {};
  origin_.setZero();
  extent_ = 1;
  if (corners_.empty()) {
    press_disc(pressure);
    return sides_.empty() && !arc_.is_empty();
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
  if (!whole) see_from_within();
  return whole;
}

/// From a middle of what is pushed the integrals over a narrow part do not cancel.
void PressedArea::see_from_within() {
  for (const auto& [from, to] : sides_) origin_ += from / static_cast<double>(sides_.size());
  extent_ = 0;
  for (auto& [from, to] : sides_) {
    from -= origin_, to -= origin_;
    extent_ = std::fmax(extent_, from.norm());
  }
}

void PressedArea::press_disc(const Vector3& pressure) {
  const double slope = pressure.tail<2>().norm();
  if (pressure[0] >= slope) {
    arc_ = {0, 2 * std::numbers::pi};
    return;
  }
  if (!(pressure[0] > -slope)) return;
  const double middle = std::atan2(pressure[2], pressure[1]), half = std::acos(-pressure[0] / slope);
  arc_ = {middle - half, middle + half};
  sides_.push_back({on_circle(middle + half), on_circle(middle - half)});
}

Matrix3 PressedArea::moments_within() const {
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
  if (const auto& [from, to] = arc_; !arc_.is_empty()) {
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

Matrix3 PressedArea::moments() const {
  const Matrix3 m = moments_within();
  if (origin_ == Vector2::Zero()) return m;
  Matrix3 shift = Matrix3::Identity();
  shift.block<2, 1>(1, 0) = origin_;
  return shift * m * shift.transpose();
}

Matrix3 PressedArea::slip_moments(const Vector2& slip, double spin) const {
  if (origin_ == Vector2::Zero()) return slip_moments_within(slip, spin);
  Matrix3 m = slip_moments_within(slip + spin * quarter_turn(origin_), spin);
  m.row(2) += origin_.x() * m.row(1) - origin_.y() * m.row(0);
  m.rightCols<2>() += m.col(0) * origin_.transpose();
  return m;
}

Matrix3 PressedArea::slip_moments_within(const Vector2& slip, double spin) const {
  Matrix3 result;
  const double speed = slip.norm();
  if (speed > near_pole * extent_ * std::fabs(spin)) {
    const Vector2 u = slip / speed;
    const Matrix3 m = moments_within();
    result.topRows<2>() = u * m.row(0);
    result.row(2) = u.y() * m.row(1) - u.x() * m.row(2);
    const auto add = [&](auto far) {
      for (const auto& [from, to] : sides_) far.add_side(from, to);
      if (!arc_.is_empty()) far.add_arc(arc_.from, arc_.to);
      return Matrix3(result + far.sum);
    };
    if (spin == 0) return result;
    return speed > distant_pole * extent_ * std::fabs(spin) ? add(FarIntegrals<6, 6>(u, spin / speed, extent_))
                                                            : add(FarIntegrals<8, 10>(u, spin / speed, extent_));
  }
  const Vector2 pole = quarter_turn(slip / spin);
  PoleIntegrals about;
  for (const auto& [from, to] : sides_) about.add_side(from - pole, to - pole);
  if (!arc_.is_empty()) {
    ArcIntegrals arcs(pole);
    if (sides_.empty()) arcs.add_circle();
    else arcs.add(arc_.from, arc_.to);
    arcs.give(about);
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
