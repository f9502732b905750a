// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "numeric/contact/footprint.hpp"
#include "numeric/contact/smooth_patch.hpp"

namespace clatter::numeric {
namespace {

/// A piece of the surface in coordinates of its own, u = origin + axes p: p of over_zone or of over_mantle.
struct Piece {
  Vector3 origin;
  Matrix3 axes;
  SpaceLinear depth, rate;
  SpaceLinear weight, weight_rate;  ///< of the area on ball or cylinder, projected measure
  double area = 1;                  ///< the same of the surface, where it is one number
  bool by_normal = false;           ///< where it is not: |normal + normal_change p|
  Vector3 normal;
  Matrix3 normal_change;
  bool is_mantle = false;
  double height = 0;  ///< of the cap
  Mantle mantle;
  HalfSpaces parts;  ///< that what presses lies in; none: all that is below the ground
};

/// ∫q s and ∫q s p over a piece, q the pressure and s the direction of the slip.
struct DirectionSums {
  double east = 0, north = 0;
  Vector3 east_place = Vector3::Zero(), north_place = Vector3::Zero();

  void add(const Vector3& p, double load, const AlongGround& direction) {
    const double e = load * direction.east, n = load * direction.north;
    east += e;
    north += n;
    for (int i = 0; i < 3; ++i) east_place[i] += e * p[i], north_place[i] += n * p[i];
  }
};

/// The weight of the area at a point of a piece, times the area on ball or cylinder.
double weight_at(const Piece& piece, const Vector3& p, bool projected) {
  if (projected) return piece.weight.at(p);
  return piece.by_normal ? (piece.normal + piece.normal_change * p).norm() : piece.area;
}

constexpr double level_rounding = 1e-14;  ///< of a slope: what is no slope along the ground

/// Whether half-spaces leave heights of a cap alone; narrows the zone to them.
bool between_heights(const HalfSpaces& parts, Zone& zone) {
  for (int i = 0; i < parts.count(); ++i) {
    const Vector3& slope = parts[i].slope;
    if (!(std::hypot(slope.x(), slope.y()) <= level_rounding * std::fabs(slope.z())) || slope.z() == 0) return false;
    const double height = -parts[i].value / slope.z();
    if (slope.z() < 0) zone.high = std::min(zone.high, height);
    else zone.low = std::max(zone.low, height);
  }
  return true;
}

/// Whether a linear function changes its sign at one depth, within what is below the ground.
bool is_by_depth(const SpaceLinear& f, const SpaceLinear& depth, double& at) {
  if (!(f.slope.cross(depth.slope).norm() <= level_rounding * f.slope.norm() * depth.slope.norm())) return false;
  const double slope = f.slope.dot(depth.slope) / depth.slope.squaredNorm();
  at = slope != 0 ? depth.value - f.value / slope : 0;
  return at > 0;
}

/// Integrals in the coordinates of a piece, weighted by the measure.
struct LocalSums {
  double depth = 0, depth_squared = 0, depth_rate = 0, depth_rate_squared = 0, rate = 0, rate_squared = 0;
  Vector3 depth_place = Vector3::Zero(), depth_rate_place = Vector3::Zero(), rate_place = Vector3::Zero(),
          rate_squared_place = Vector3::Zero();
  Matrix3 depth_places = Matrix3::Zero();
  double force_by_area = 0;
  Vector3 force_place_by_area = Vector3::Zero();

  void add(const Vector3& p, double d, double r, double weight) {
    const double wd = weight * d, wdr = wd * r;
    depth += wd;
    depth_squared += wd * d;
    depth_rate += wdr;
    depth_rate_squared += wdr * r;
    depth_place += wd * p;
    depth_rate_place += wdr * p;
  }
  void add_rates(const Vector3& p, double d, double r, double weight, double weight_rate, const Ground& ground) {
    const double wr = weight * r, force = weight_rate * d * (ground.stiffness + ground.damping * r);
    rate += wr;
    rate_squared += wr * r;
    rate_place += wr * p;
    rate_squared_place += wr * r * p;
    depth_places += weight * d * p * p.transpose();
    force_by_area += force;
    force_place_by_area += force * p;
  }
};

constexpr int most_around = 48;  ///< beyond it, graded parts take fewer

/// Slip over a piece, in its coordinates, and what presses there.
struct PieceSlip {
  const Piece& piece;
  SpaceLinear east, north, pressure;
  double rounding, digits;
  bool projected;

  [[nodiscard]] double load(const Vector3& p) const {
    return piece.depth.at(p) * pressure.at(p) * weight_at(piece, p, projected);
  }
  [[nodiscard]] AlongGround at(const Vector3& p) const { return {east.at(p), north.at(p)}; }
  /// Its change along a vector.
  [[nodiscard]] AlongGround rate(const Vector3& way) const { return {east.slope.dot(way), north.slope.dot(way)}; }
};

/// Sums loads along the directions of a slip, many places at a time: square roots and quotients of several take no
/// longer than those of one.
class DirectionSummer {
 public:
  explicit DirectionSummer(const PieceSlip& slip) : slip_(slip) {}

  void add(const Vector3& p, double area) { put(p.x(), p.y(), p.z(), area, false); }
  /// A place of the lower half of the sphere and the area that it stands for, seen along the vertical.
  void add_above(double x, double y, double area) { put(x, y, 0, area, true); }
  [[nodiscard]] const DirectionSums& sums() {
    flush();
    return sums_;
  }

 private:
  static constexpr int room = 32;
  using Row = Eigen::Array<double, room, 1>;

  void put(double x, double y, double z, double area, bool is_above) {
    if (count_ == room || is_above != is_above_) flush();
    is_above_ = is_above;
    x_[count_] = x;
    y_[count_] = y;
    z_[count_] = z;
    area_[count_++] = area;
  }
  [[nodiscard]] Row at_all(const SpaceLinear& f) const {
    return f.value + f.slope.x() * x_ + f.slope.y() * y_ + f.slope.z() * z_;
  }

  [[nodiscard]] Row weights() const {
    const Piece& piece = slip_.piece;
    if (slip_.projected) return at_all(piece.weight);
    if (!piece.by_normal) return Row::Constant(piece.area);
    Row square = Row::Zero();
    for (int i = 0; i < 3; ++i) square += at_all({piece.normal[i], piece.normal_change.row(i).transpose()}).square();
    return square.sqrt();
  }

  void flush() {
    constexpr double no_slip = 1e-100;  // [m/s]: has no direction
    if (count_ == 0) return;
    for (int i = count_; i < room; ++i) x_[i] = y_[i] = z_[i] = area_[i] = 0;
    count_ = 0;
    if (is_above_) {
      const Row square = x_.square() + y_.square(), cosine = (1 - square).sqrt();
      z_ = square / (1 + cosine);
      area_ /= cosine;
    }
    const Row east = at_all(slip_.east), north = at_all(slip_.north);
    const Row size = (east.square() + north.square() + slip_.rounding * slip_.rounding).sqrt().max(no_slip);
    const Row load = area_ * weights() * at_all(slip_.piece.depth) * at_all(slip_.pressure) / size;
    const Row along_east = load * east, along_north = load * north;
    sums_.east += along_east.sum();
    sums_.north += along_north.sum();
    sums_.east_place += Vector3((along_east * x_).sum(), (along_east * y_).sum(), (along_east * z_).sum());
    sums_.north_place += Vector3((along_north * x_).sum(), (along_north * y_).sum(), (along_north * z_).sum());
  }

  const PieceSlip& slip_;
  Row x_, y_, z_, area_;
  int count_ = 0;
  bool is_above_ = false;
  DirectionSums sums_;
};

/// Largest change of the slip over a cap from its value at the lowest point: along it, and by its height.
struct Variation {
  double along, up;
};

Variation variation(const PieceSlip& slip) {
  const double height = slip.piece.height, rho = height < 1 ? std::sqrt(height * (2 - height)) : 1;
  const Vector3 &e = slip.east.slope, &n = slip.north.slope;
  return {std::sqrt(e.head<2>().squaredNorm() + n.head<2>().squaredNorm()) * rho, std::hypot(e.z(), n.z()) * height};
}

/// For slip that varies by a part q < 1 over the cap: terms of order k in the place fall like q^k.
CapRule rule_of_variation(const PieceSlip& slip, double part) {
  const Variation change = variation(slip);
  const double order = slip.digits / -std::log10(std::max(part, 1e-15));
  const bool by_height = slip.piece.height > 0.3 || change.up > change.along;
  CapRule rule;
  rule.around = 6 + 2 * static_cast<int>(std::ceil(order / 2));
  const int heights = 3 + static_cast<int>(std::ceil(by_height ? order / 2 : order / 4));
  rule.parts = (heights + most_gauss_nodes - 1) / most_gauss_nodes;
  rule.heights = std::min(heights, most_gauss_nodes);
  return rule;
}

/// The line on which both components of the slip vanish, and the ball: they meet at middle ± √square × line.
struct RestingLine {
  Vector3 line, middle;
  double square;         ///< < 0: the line misses the ball
  bool is_line = false;  ///< or the components vanish on one plane, or none

  explicit RestingLine(const PieceSlip& slip) {
    const Vector3 &e = slip.east.slope, &n = slip.north.slope, across = e.cross(n);
    const double size = across.norm();
    is_line = size > 1e-6 * e.norm() * n.norm();
    if (!is_line) return;
    line = across / size;
    const Vector3 foot = -(slip.east.value * n.cross(line) + slip.north.value * line.cross(e)) / size;
    middle = foot + line.z() * line;
    square = line.z() * line.z() - foot.squaredNorm() + 2 * foot.z();
  }
};

/// The places of the lower half of the ball, near the cap, where nothing slips, the lower one first.
/// @return how many
int resting_places(const PieceSlip& slip, std::array<Vector3, 2>& places) {
  const double height = slip.piece.height;
  if (slip.piece.is_mantle || !(height < 0.5)) return 0;
  const double widest = std::min(3 * std::sqrt(height * (2 - height)), 0.6);
  const RestingLine rests(slip);
  if (!rests.is_line || !(rests.square >= 0)) return 0;
  int count = 0;
  for (const double side : {-1.0, 1.0}) {
    Vector3 p = rests.middle + side * std::sqrt(rests.square) * rests.line;
    const double across = p.x() * p.x() + p.y() * p.y();
    if (!(p.z() < 1 && across < widest * widest)) continue;
    p.z() = across / (1 + std::sqrt(1 - across));
    places[count++] = p;
  }
  if (count == 2 && places[1].z() < places[0].z()) std::swap(places[0], places[1]);
  return count;
}

/// How many places around a resting place the direction of the slip asks for, by where |v|² = c₀ + c₁ cos + c₂ cos 2 of
/// the rim's angle may vanish: c₀ = c₁ cosh η + c₂ cosh 2η at least.
int places_around(const PieceSlip& slip, const SphereArc& rim) {
  constexpr int count = 8;
  double mean = 0;
  std::complex<double> first, second;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count, square = slip.at(rim.at(angle)).square() / count;
    mean += square;
    first += 2 * square * std::polar(1.0, angle);
    second += 2 * square * std::polar(1.0, 2 * angle);
  }
  const double c1 = std::abs(first), c2 = std::abs(second);
  const double cosine = 2 * (mean + c2) / (c1 + std::sqrt(c1 * c1 + 8 * c2 * (mean + c2)));
  if (!(cosine > 1)) return most_around + 1;
  const double wanted = slip.digits * std::numbers::ln10 / std::acosh(std::min(cosine, 1e15));
  return wanted < most_around ? 8 + 2 * static_cast<int>(std::ceil(wanted / 2)) : most_around + 1;
}

/// Where the direction of slip along a curve is singular: at t = centre ± i width.
struct Turn {
  double centre, width;
};

/// Gauss's rule by a parameter t from which the place along a curve is smooth, where the direction of slip turns near
/// two places, the sharper one first.  About each t = centre + width × sinh s, and the direction is smooth in s.
class TurnRule {
 public:
  /// @param whole  length of what the digits are of
  /// @param power  of the length of a part, with which what it has to do with the direction falls
  TurnRule(const std::array<Turn, 2>& turns, double digits, double whole, double power)
      : turns_(turns), digits_(digits), whole_(whole), power_(power) {}
  /// Calls visit(t, weight) between two t; the order for what is not the direction is order_of(length of t) at least.
  template <class Order, class Visit>
  void over(double from, double to, Order&& order_of, Visit&& visit) const {
    const Turn &sharp = turns_[0], &other = turns_[1];
    const double apart = other.centre - sharp.centre, between = (sharp.centre + other.centre) / 2;
    // The map about the sharper one serves both where the other is no sharper than it is far.
    const bool is_alone = !(other.width < std::fabs(apart));
    const double split = is_alone ? (apart > 0 ? to : from) : std::clamp(between, from, to);
    const double far = is_alone ? std::numeric_limits<double>::infinity() : std::fabs(apart);
    if (split > from) about(apart > 0 ? sharp : other, far, from, split, order_of, visit);
    if (to > split) about(apart > 0 ? other : sharp, far, split, to, order_of, visit);
  }

 private:
  /// @param other  distance of the other turn
  template <class Order, class Visit>
  void about(const Turn& turn, double other, double from, double to, Order&& order_of, Visit&& visit) const {
    constexpr double part_length = 4, least_digits = 3, widest = 1e3;
    const double width = std::clamp(turn.width, std::pow(10, -digits_ - 1) * whole_, widest * whole_);
    const double begin = std::asinh((from - turn.centre) / width), end = std::asinh((to - turn.centre) / width);
    const double next = std::asinh(other / width);  // where the other one lies
    const int parts = std::max(1, static_cast<int>(std::ceil((end - begin) / part_length)));
    const double half = (end - begin) / (2 * parts);
    double low = from;
    for (int i = 0; i < parts; ++i) {
      const double middle = begin + half * (2 * i + 1);
      const double high = i + 1 == parts ? to : turn.centre + width * std::sinh(middle + half);
      const double digits = std::max(digits_ + power_ * std::log10((high - low) / whole_), least_digits);
      const double strip = std::numbers::pi / 2 / half, beside = std::max((next - std::fabs(middle)) / half, 1.1);
      const double ellipse = std::min(strip + std::sqrt(strip * strip + 1), beside + std::sqrt(beside * beside - 1));
      const int order = std::min(std::max(gauss_order(ellipse, digits), order_of(high - low)), most_gauss_nodes);
      for (const GaussNode& node : gauss_rule(order)) {
        const double grown = std::exp(middle + half * node.at);
        visit(turn.centre + width * (grown - 1 / grown) / 2, half * node.weight * width * (grown + 1 / grown) / 2);
      }
      low = high;
    }
  }

  const std::array<Turn, 2>& turns_;
  double digits_, whole_, power_;
};

/// Slip along a circle, v(φ) = v(0) + v′(0) sin φ + (v(π) − v(0)) (1 − cos φ)/2.
struct CircleSlip {
  AlongGround at_zero, at_half_turn, rate;
};

/// Length along a curve, near where the slip vanishes, within which it is below v_r.
double fading(double rounding, const std::complex<double>& speed, const std::complex<double>& bend) {
  return std::min(rounding / std::abs(speed), std::sqrt(2 * rounding / std::abs(bend)));
}

/// Rule along a circle for what the direction of the slip is a factor of.  With u = tan φ/2 the slip, as a complex
/// number, is zero where
///     v(π) u² + 2 v′(0) u + v(0) = 0.
class CircleRule {
 public:
  CircleRule(const CircleSlip& slip, double rounding, double digits) : digits_(digits) {
    using Complex = std::complex<double>;
    const auto complex = [](const AlongGround& v) { return Complex(v.east, v.north); };
    const Complex c = complex(slip.at_zero), b = complex(slip.rate), a = complex(slip.at_half_turn);
    const Complex root = std::sqrt(b * b - a * c);
    const Complex q = std::norm(b + root) > std::norm(b - root) ? -b - root : root - b;
    const std::array<Complex, 2> over{q, c}, under{a, q};
    for (std::size_t i = 0; i < 2; ++i) {
      // φ = 2 arctan(over/under) = −i log((under + i over)/(under − i over)).
      const Complex turned(-over[i].imag(), over[i].real());
      const double plus = std::norm(under[i] + turned), minus = std::norm(under[i] - turned);
      const Complex ratio = (under[i] + turned) * std::conj(under[i] - turned);
      double& width = turns_[i].width;
      turns_[i].centre = std::arg(ratio);
      width = plus > 0 && minus > 0 ? std::fabs(std::log(plus / minus)) / 2 : std::numeric_limits<double>::infinity();
      if (rounding > 0 && std::isfinite(width)) {
        const double cosine = std::cos(turns_[i].centre), sine = std::sin(turns_[i].centre);
        const Complex change = (a - c) / 2.0;
        width = std::hypot(width, fading(rounding, b * cosine + change * sine, change * cosine - b * sine));
      }
    }
    if (turns_[0].width > turns_[1].width) std::swap(turns_[0], turns_[1]);
  }

  CircleRule(const std::array<Turn, 2>& turns, double digits, double power)
      : turns_(turns), digits_(digits), power_(power) {}
  /// Calls visit(φ, weight) between two angles.
  /// Parts of the circle have the nearest of each root's images.
  template <class Visit>
  void over(double from, double to, Visit&& visit) const {
    constexpr double longest = std::numbers::pi;
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / longest)));
    for (int i = 0; i < parts; ++i) {
      const double begin = from + (to - from) * i / parts, end = from + (to - from) * (i + 1) / parts;
      std::array<Turn, 2> turns = turns_;
      for (Turn& turn : turns) {
        const double middle = (begin + end) / 2;
        turn.centre = middle + std::remainder(turn.centre - middle, 2 * std::numbers::pi);
      }
      TurnRule(turns, digits_, to - from, power_)
          .over(
              begin, end, [](double length) { return trigonometric_order(length / 2) + 2; }, visit);
    }
  }

 private:
  std::array<Turn, 2> turns_;
  double digits_, power_ = 1;
};

/// A cap, or a part of one, as rays from a place where nothing slips, along which the direction hardly varies, to its
/// boundary; their areas have signs, so that the place may lie outside.
class RestingFan {
 public:
  /// @param centre  of resting_places()
  /// Along a ray v = λ v₁ + λ² v₂, v₂ by the heights: the direction is analytic up to |v₁/v₂|.
  RestingFan(const PieceSlip& slip, const Vector3& centre, DirectionSummer& sums)
      : slip_(slip), centre_(centre), sums_(sums) {
    constexpr double far = 1.5, nearest = 0.3;
    const double height = slip.piece.height, rho = std::sqrt(height * (2 - height));
    rim_ = {{0, 0, height}, {rho, 0, 0}, {0, rho, 0}, 0, 2 * std::numbers::pi};
    // Its rates along the ball at the place itself: where there are two close to each other they hardly vary there.
    const Vector3 &e = slip_.east.slope, &n = slip_.north.slope,
                  tilt = Vector3(centre.x(), centre.y(), 0) / (1 - centre.z());
    const AlongGround by_x = slip_.rate({1, 0, tilt.x()}), by_y = slip_.rate({0, 1, tilt.y()});
    const double determinant = std::fabs(by_x.east * by_y.north - by_y.east * by_x.north);
    const double least =
        determinant / std::sqrt(by_x.square() + by_y.square());  // not above √2 × the lesser singular value
    const double length = std::hypot(centre_.x(), centre_.y()) + rho;
    const double root = least / (std::hypot(e.z(), n.z()) * length / 2 + 1e-3 * least);
    const double highest = std::max(height, centre_.z());
    is_low_ = highest < SphereRay::low;
    order_ = ray_order(highest, length, slip_.digits);
    bends_ = !(root > far);
    if (bends_) {
      serves_ = is_low_ && root > nearest;
      return;
    }
    const double bend = 2 * root - 1;
    order_ = std::max(order_, gauss_order(bend + std::sqrt(bend * bend - 1), slip_.digits));
    serves_ = order_ < most_gauss_nodes;
  }

  /// Whether rays serve: not where the slip turns round near the place.
  [[nodiscard]] bool serves() const { return serves_; }

  void add_up(const HalfSpaces& parts) {
    if (parts.count() > 0) {
      HalfSpaces all = parts;
      all.add({slip_.piece.height, {0, 0, -1}});
      const SphereBoundary boundary(all);
      for (int i = 0; i < boundary.count; ++i) add_graded(boundary.arcs[i]);
      return;
    }
    const int around = bends_ ? most_around + 1 : places_around(slip_, rim_);
    if (around > most_around) return add_graded(rim_);
    for (int i = 0; i < around; ++i) add_ray(rim_, 2 * std::numbers::pi * i / around, 2 * std::numbers::pi / around);
  }

 private:
  /// Where the direction turns along a ray: at its beginning, below v_r, and where v₁ + λ v₂ is zero.
  [[nodiscard]] std::array<Turn, 2> turns(const Vector3& end) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    const Vector3 way = end - centre_;
    const AlongGround at_end = slip_.at(end);
    std::array<Turn, 2> turns{{{0, none}, {0, none}}};
    if (slip_.rounding > 0) turns[0].width = slip_.rounding / std::sqrt(at_end.square());
    if (!bends_) return turns;
    const double rise = (centre_.x() * way.x() + centre_.y() * way.y()) / (1 - centre_.z());
    const AlongGround first = slip_.rate({way.x(), way.y(), rise});
    const std::complex<double> v1(first.east, first.north), v2(at_end.east - first.east, at_end.north - first.north);
    if (std::norm(v2) > 0) {
      const std::complex<double> root = -v1 / v2;
      turns[1] = {root.real(), std::hypot(root.imag(), slip_.rounding / std::abs(v1))};
    }
    if (turns[0].width > turns[1].width) std::swap(turns[0], turns[1]);
    return turns;
  }

  void add_ray(const SphereArc& arc, double angle, double step) {
    const Vector3 end = arc.at(angle), way = end - centre_, rate = arc.rate(angle);
    const double seen = way.x() * rate.y() - way.y() * rate.x();
    const SphereRay ray(centre_, end, rate, is_low_);
    const auto add = [&](double part, double weight) {
      if (is_low_) {
        sums_.add_above(centre_.x() + part * way.x(), centre_.y() + part * way.y(), step * weight * part * seen);
        return;
      }
      const auto [place, area] = ray.at(part);
      sums_.add(place, step * weight * area);
    };
    if (!bends_ && slip_.rounding == 0) {
      for (const GaussNode& node : gauss_rule(order_)) add((1 + node.at) / 2, node.weight / 2);
      return;
    }
    const std::array<Turn, 2> turns = this->turns(end);
    constexpr int low_order = 5;
    const auto order_of = [&](double length) { return length < 0.5 ? std::min(order_, low_order) : order_; };
    TurnRule(turns, slip_.digits, 1, 2).over(0, 1, order_of, add);
  }

  /// Where the resting place lies so near the boundary that the direction turns there within a short way.
  void add_graded(const SphereArc& arc) {
    const CircleSlip along{slip_.at(arc.at(0)), slip_.at(arc.at(std::numbers::pi)), slip_.rate(arc.b)};
    CircleRule(along, 0, slip_.digits).over(arc.from, arc.to, [&](double angle, double weight) {
      add_ray(arc, angle, weight);
    });
  }

  const PieceSlip& slip_;
  Vector3 centre_;
  SphereArc rim_;  ///< of the whole cap
  DirectionSummer& sums_;
  bool serves_ = false;
  int order_ = 0;       ///< along a ray, beside the direction
  bool bends_ = false;  ///< whether the direction varies along rays so that each asks for its own rule
  bool is_low_ = true;  ///< of SphereRay
};

/// The direction in which the slip varies most over the piece; the slip's own where it does not vary.
AlongGround steepest(const PieceSlip& slip) {
  const Vector3 &e = slip.east.slope, &n = slip.north.slope;
  const double angle = std::atan2(2 * e.dot(n), e.squaredNorm() - n.squaredNorm()) / 2;
  return {std::cos(angle), std::sin(angle)};
}

SpaceLinear component(const PieceSlip& slip, const AlongGround& way) {
  return {way.east * slip.east.value + way.north * slip.north.value,
          way.east * slip.east.slope + way.north * slip.north.slope};
}

/// Any part of a piece, by slices across which the slip varies most.
void over_slices(const PieceSlip& slip, HalfSpaces parts, DirectionSummer& sums) {
  const Piece& piece = slip.piece;
  const AlongGround way = steepest(slip);
  const SpaceLinear along = component(slip, way), across = component(slip, {-way.north, way.east});
  if (piece.is_mantle) parts.add(piece.depth);
  else if (piece.height < 2) parts.add({piece.depth.value / -piece.depth.slope.z(), {0, 0, -1}});
  const double axis = std::atan2(along.slope.x(), -along.slope.y());
  Slices slices = piece.is_mantle ? Slices(piece.mantle.length, parts) : Slices(parts, axis);
  slices.mind(along, across);
  const AlongGround rate = slip.rate(slices.across());
  slices.each_piece([&](const Slices::Slice& slice, double from, double to, double weight) {
    const CircleSlip around{slip.at(slices.place(slice, 0)),
                            slip.at(slices.place(slice, std::numbers::pi)),
                            {slice.radius * rate.east, slice.radius * rate.north}};
    CircleRule(around, slip.rounding, slip.digits).over(from, to, [&](double angle, double area) {
      sums.add(slices.place(slice, angle), weight * area);
    });
  });
}

/// A whole cap where slip vanishes along a curve but for what little it has across, as of a ball that rolls and hardly
/// spins: rays from the lowest point, which are parts of circles, around which the sums of rays turn near the places
/// where nothing slips, or nearly so, and where the curve leaves the cap.
class RollingFan {
 public:
  RollingFan(const PieceSlip& slip, DirectionSummer& sums) : slip_(slip), sums_(sums) {}

  void add_up() {
    const SpaceLinear along = component(slip_, steepest(slip_));
    const double height = slip_.piece.height, rho = std::sqrt(height * (2 - height));
    const double middle = along.value + along.slope.z() * height;
    const double size = std::hypot(along.slope.x(), along.slope.y()) * rho;
    const CircleRule rule(turns(), std::min(slip_.digits, most_digits), 1.5);
    const auto add = [&](double azimuth, double step) { add_ray(azimuth, step); };
    const double peak = std::atan2(along.slope.y(), along.slope.x());
    const double half = std::fabs(middle) < size ? std::acos(-middle / size) : 0;
    if (half > 0) rule.over(peak - half, peak + half, add);
    rule.over(peak + half, peak - half + 2 * std::numbers::pi, add);
  }

 private:
  /// Azimuths of the places where nothing slips; complex ones where the line misses the ball.  At a real one the sum of
  /// a ray has a term like w log w only, so that a width of 1e-5 changes nothing above 1e-9.
  [[nodiscard]] std::array<Turn, 2> turns() const {
    using Complex = std::complex<double>;
    constexpr double none = std::numeric_limits<double>::infinity(), sharpest = 3e-5;
    std::array<Turn, 2> turns{{{0, none}, {0, none}}};
    const RestingLine rests(slip_);
    if (!rests.is_line) return turns;
    const Vector3 &middle = rests.middle, way = std::sqrt(std::fabs(rests.square)) * rests.line;
    if (rests.square >= 0) {
      for (const int i : {0, 1}) {
        const Vector3 p = i == 0 ? Vector3(middle - way) : Vector3(middle + way);
        if (p.z() < 2 * slip_.piece.height) turns[i] = {std::atan2(p.y(), p.x()), sharpest};
      }
      if (turns[0].width > turns[1].width) std::swap(turns[0], turns[1]);
      return turns;
    }
    // ψ = arctan(y/x) = −i/2 log((x + iy)/(x − iy)).
    const Complex one(middle.x() - way.y(), middle.y() + way.x()), other(middle.x() + way.y(), way.x() - middle.y());
    const double azimuth = std::atan2(middle.y(), middle.x()), half = std::arg(one * std::conj(other)) / 2;
    const double width = std::fabs(std::log(std::norm(one) / std::norm(other))) / 4;
    turns[0] = {half + std::numbers::pi * std::round((azimuth - half) / std::numbers::pi), std::max(width, sharpest)};
    return turns;
  }

  void add_ray(double azimuth, double step) {
    const double x = std::cos(azimuth), y = std::sin(azimuth);
    const CircleSlip along{slip_.at(Vector3::Zero()), slip_.at({0, 0, 2}), slip_.rate({x, y, 0})};
    const double end = 2 * std::asin(std::sqrt(slip_.piece.height / 2));
    CircleRule(along, slip_.rounding, std::min(slip_.digits, most_digits))
        .over(0, end, [&](double angle, double weight) {
          const double sine = std::sin(angle / 2), across = 2 * sine * std::cos(angle / 2);
          sums_.add({across * x, across * y, 2 * sine * sine}, weight * across * step);
        });
  }

  static constexpr double most_digits = 10;
  const PieceSlip& slip_;
  DirectionSummer& sums_;
};

/// The cap, or its part, where one rule serves; false: none does.
bool over_cap(const PieceSlip& slip, DirectionSummer& sums) {
  const Variation change = variation(slip);
  const double part =
      (change.along + change.up) / std::sqrt(slip.at(Vector3::Zero()).square() + slip.rounding * slip.rounding);
  if (part < 0.5 && slip.piece.parts.count() == 0) {
    over_zone({0, slip.piece.height}, rule_of_variation(slip, part),
              [&](const Vector3& p, double area) { sums.add(p, area); });
    return true;
  }
  std::array<Vector3, 2> places;
  const int count = resting_places(slip, places);
  const auto roll = [&] {
    if (slip.piece.parts.count() > 0 || !(slip.piece.height < 2)) return false;
    RollingFan(slip, sums).add_up();
    return true;
  };
  if (count == 0) return roll();
  RestingFan fan(slip, places[0], sums);
  if (count == 1 || !(places[1].z() < slip.piece.height)) {
    if (fan.serves()) fan.add_up(slip.piece.parts);
    return fan.serves() || roll();
  }
  // To each place the part that is nearer to it.
  RestingFan other(slip, places[1], sums);
  if (!fan.serves() || !other.serves()) return roll();
  const Vector3 apart = places[0] - places[1];
  const double middle = apart.dot(places[0] + places[1]) / 2;
  HalfSpaces near = slip.piece.parts, far = near;
  near.add({-middle, apart});
  far.add({middle, -apart});
  fan.add_up(near);
  other.add_up(far);
  return true;
}

/// The whole strip, if the slip varies by less than a third of its size.
bool over_whole_strip(const PieceSlip& slip, double width, DirectionSummer& sums) {
  constexpr double largest_part = 1.0 / 3;
  const double part = 2 * width / std::sqrt(slip.at(Vector3::Zero()).square() + slip.rounding * slip.rounding);
  if (!(part < largest_part)) return false;
  const int more = static_cast<int>(std::ceil(slip.digits / (2 * std::log10(2 / std::max(part, 1e-15)))));
  over_mantle(slip.piece.mantle, 32, more, [&](const Vector3& p, double area) { sums.add(p, area); });
  return true;
}

/// Range of a linear function over a cap.
struct Range {
  double low, high;
};

Range range_over(const Piece& piece, const SpaceLinear& f) {
  Range range{f.value, f.value};
  const auto take = [&](double value) { range = {std::min(range.low, value), std::max(range.high, value)}; };
  if (piece.is_mantle) {
    for (const double x : {0.0, piece.mantle.end()}) {
      const double half = piece.mantle.drop > 0 ? piece.mantle.half_width(x) : std::numbers::pi;
      for (const double angle : {-half, 0.0, half}) take(f.at(mantle_point(x, angle)));
    }
    return range;
  }
  const double size = f.slope.norm(), rho = std::sqrt(piece.height * (2 - piece.height));
  const double across = std::hypot(f.slope.x(), f.slope.y()) * rho, rim = f.value + f.slope.z() * piece.height;
  take(rim - across);
  take(rim + across);
  for (const double side : {-1.0, 1.0}) {
    if (size > 0 && 1 + side * f.slope.z() / size < piece.height) take(f.value + f.slope.z() + side * size);
  }
  return range;
}

/// Whether all slip is along one line, as in the plane, or as good as that where it changes its sign.
bool slips_one_way(const PieceSlip& slip) {
  const AlongGround way = steepest(slip);
  const Range along = range_over(slip.piece, component(slip, way));
  if (!(along.low < 0 && along.high > 0)) return slip.north.value == 0 && slip.north.slope.isZero(0);
  const Range across = range_over(slip.piece, component(slip, {-way.north, way.east}));
  return std::max(-across.low, across.high) <= std::pow(10, -slip.digits) * (along.high - along.low);
}

/// The load on a SmoothShape.  The affine map that makes its ends unit balls leaves heights linear: an end lies below
/// the ground within a cap about its lowest point, the straight part within a strip of a unit cylinder, and depth, rate
/// and the vertical component of the area are linear in the place on the ball.  So the integrals of the projected
/// measure are exact by three heights and six places around (over_zone), e.g. of a ball of radius R
///     F_n = π k_G d² (R − d/3)   (projected),      F_n = π k_G R d²   (surface);
/// where the measure is that of an ellipsoid's surface the rule is as fine as its axes ask for.  Where the clamp, or
/// the end of a half, cuts the cap, its parts are integrated over. Accuracy: 1e-13 of F_n; a strip that the clamp or a
/// change of slip cuts, 1e-9.
class SmoothContact final : public ContactSurface {
 public:
  /// `body` has a smooth shape.
  /// @param footprint  gets all that lies below the ground, if not null.
  SmoothContact(const Body& body, const Ground& ground, Footprint* footprint = nullptr)
      : body_(body), ground_(ground), footprint_(footprint), shape_(*body.smooth()),
        slimness_(shape_.semiaxes.minCoeff() / shape_.semiaxes.maxCoeff()) {}

  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override {
    count_ = 0;
    const Vector3 &n0 = view.reference.normal, &t = view.turn, &a = shape_.semiaxes;
    const Vector3 normal = n0 + t, stretched = a.cwiseProduct(normal);
    const double s0 = a.cwiseProduct(n0).norm(), s = stretched.norm();
    const Shared shared{view, normal, normal.cross(view.angular_velocity), stretched / s, s};
    // |S n| since touch-down, without cancellation.
    const Vector3 squared = a.cwiseProduct(a);
    const double longer = (2 * n0 + t).dot(squared.cwiseProduct(t)) / (s + s0);
    Sums sums{{}, {}, rates};
    sums.load.deepest = -std::numeric_limits<double>::infinity();
    std::array<double, 2> depths{};
    for (int end = 0; end < shape_.ends(); ++end) {
      const Vector3 centre = shape_.end_centre(end);
      const double depth = (s0 - view.reference.height(centre)) + (longer - (t.dot(centre) + view.sink));
      depths[end] = depth;
      if (depth > sums.load.deepest) {
        sums.load.deepest = depth;
        sums.load.deepest_rate = -(view.vertical_speed + shared.rate_slope.dot(centre - a.cwiseProduct(shared.up)));
      }
      if (!(depth > 0)) continue;
      if (submerged) submerged->push_back(end);
      add_end(end, depth, shared, sums);
    }
    if (shape_.straight > 0 && sums.load.deepest > 0) add_mantle(depths, shared, sums);
    take_ground(ground_, sums.pressing, sums.load, rates);
    return sums.load;
  }

  /// About the place where nothing slips, or the two, if near the patch: there the direction of the slip varies around
  /// it alone; else along circles, graded towards where the slip vanishes.  Of a cap that rolls and hardly spins right
  /// to some 1e-7 of F_n, of what the clamp or a seam cuts no better than its slices where slip all but vanishes.
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override {
    SlipLoad load;
    for (int i = 0; i < count_; ++i) {
      const Piece& piece = pieces_[i];
      const DirectionSums sums = directions(piece, view, field);
      load.east -= sums.east;
      load.north -= sums.north;
      const auto moment = [&](double sum, const Vector3& place) -> Vector3 {
        return sum * piece.origin + piece.axes * place;
      };
      load.moment -=
          moment(sums.east, sums.east_place).cross(view.east) + moment(sums.north, sums.north_place).cross(view.north);
    }
    return load;
  }

  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override {
    SlipRange range;
    for (int i = 0; i < count_; ++i) {
      const Piece& piece = pieces_[i];
      const auto [east, north] = slip_over(piece, view, field);
      const Range by_east = range_over(piece, east), by_north = range_over(piece, north);
      range.add(by_east.low, by_north.low);
      range.add(by_east.high, by_north.high);
    }
    return range;
  }

 private:
  /// What all pieces of an evaluation share.
  struct Shared {
    const GroundView& view;
    Vector3 normal;      ///< of the ground, body frame
    Vector3 rate_slope;  ///< δ̇ = −(vertical speed + rate_slope·u); also the rate of change of the normal
    Vector3 up;          ///< m: the gradient of the height on the ball, unit
    double stretch;      ///< its size s [m]
  };
  struct Sums {
    LoadIntegrals pressing;
    ContactLoad load;
    LoadRates* rates;
  };

  void add_end(int end, double depth, const Shared& shared, Sums& sums) {
    const Vector3 &up = shared.up, across = up.unitOrthogonal();
    Matrix3 turn;
    turn << across, up.cross(across), up;
    Piece piece;
    piece.origin = shape_.end_centre(end) - shape_.semiaxes.cwiseProduct(up);
    piece.axes = shape_.semiaxes.asDiagonal() * turn;
    piece.depth = {depth, {0, 0, -shared.stretch}};
    piece.height = std::min(depth / shared.stretch, 2.0);
    complete(piece, -up, turn, shared);
    if (shape_.ends() == 2) {
      // The half beyond the seam: ±(p − up)·x > 0.
      const double side = end == 0 ? -1 : 1;
      const SpaceLinear beyond{-side * up.x(), side * turn.row(0).transpose()};
      const double rho = piece.height < 1 ? std::sqrt(piece.height * (2 - piece.height)) : 1;
      const double varies =
          std::hypot(beyond.slope.x(), beyond.slope.y()) * rho + std::fabs(beyond.slope.z()) * piece.height;
      if (!(beyond.value > -varies)) return;
      if (!(beyond.value > varies)) piece.parts.add(beyond);
    }
    add_piece(piece, sums);
  }

  void add_mantle(const std::array<double, 2>& depths, const Shared& shared, Sums& sums) {
    const Vector3& up = shared.up;
    const int deeper = depths[0] >= depths[1] ? 0 : 1;
    const Vector3 along = deeper == 0 ? Vector3::UnitX() : Vector3(-Vector3::UnitX());
    const double steep = std::hypot(up.y(), up.z());
    const Vector3 down = steep > 0 ? Vector3(0, -up.y() / steep, -up.z() / steep) : Vector3(0, 0, -1);
    Matrix3 turn;
    turn << along, along.cross(down), -down;
    Piece piece;
    piece.is_mantle = true;
    piece.origin = shape_.end_centre(deeper) + shape_.semiaxes.cwiseProduct(down);
    piece.axes = shape_.semiaxes.asDiagonal() * turn;
    const double depth = depths[deeper] - shared.stretch * (up.x() * up.x() / (1 + steep));
    piece.depth = {depth, {-shared.stretch * std::fabs(up.x()), 0, -shared.stretch * steep}};
    piece.mantle = {shape_.straight / shape_.semiaxes.x(), depth, piece.depth.slope.x(), shared.stretch * steep};
    if (!(depth > 0)) return;
    Matrix3 normal_change = turn;
    normal_change.col(0).setZero();
    complete(piece, down, normal_change, shared);
    add_piece(piece, sums);
  }

  void add_piece(Piece& piece, Sums& sums) {
    const double k = ground_.stiffness, c = ground_.damping;
    const bool projected = ground_.area == AreaMeasure::projected;
    const SpaceLinear pressure{k + c * piece.rate.value, c * piece.rate.slope};
    // Over the whole piece; a bound decides cheaply in nearly all cases.
    double reach = 0;
    if (c > 0) {
      const double length = piece.is_mantle ? piece.mantle.end() : 0;
      const double rho = piece.is_mantle || piece.height >= 1 ? 1 : std::sqrt(piece.height * (2 - piece.height));
      const double height = piece.is_mantle ? 2 : piece.height;
      reach = std::hypot(pressure.slope.x(), pressure.slope.y()) * rho + std::fabs(pressure.slope.x()) * length +
              std::fabs(pressure.slope.z()) * height;
    }
    if (footprint_) {
      over(piece, piece.parts, [&](const Vector3& p, double area) {
        footprint_->add(piece.origin, piece.axes * p, piece.depth.at(p), area * piece.weight.at(p));
      });
    }
    LocalSums local;
    const bool all_presses = pressure.value > reach;
    if (!all_presses) {
      LocalSums below;
      over(piece, piece.parts, [&](const Vector3& p, double area) {
        below.add(p, piece.depth.at(p), piece.rate.at(p), area * weight_at(piece, p, projected));
      });
      sums.load.energy += below.depth_squared;
      sums.load.release_power += below.depth_rate;
      if (!(pressure.value > -reach)) return;
      piece.parts.add(pressure);
    }
    over(piece, piece.parts, [&](const Vector3& p, double area) {
      const double depth = piece.depth.at(p), rate = piece.rate.at(p), weight = area * weight_at(piece, p, projected);
      local.add(p, depth, rate, weight);
      if (sums.rates) local.add_rates(p, depth, rate, weight, projected ? area * piece.weight_rate.at(p) : 0, ground_);
    });
    if (all_presses) sums.load.energy += local.depth_squared;
    else sums.load.release_power -= local.depth_rate;
    const auto place = [&](double sum, const Vector3& of_place) -> Vector3 {
      return sum * piece.origin + piece.axes * of_place;
    };
    sums.pressing.add({local.depth, local.depth_rate, local.depth_squared, local.depth_rate_squared,
                       place(local.depth, local.depth_place), place(local.depth_rate, local.depth_rate_place)},
                      1);
    if (ground_.has_friction()) pieces_[count_++] = piece;
    if (!sums.rates) return;
    const Vector3 moved = piece.axes * local.depth_place;
    const Matrix3 mixed = piece.origin * moved.transpose();
    sums.rates->rates.add({local.rate, local.rate_squared, place(local.rate, local.rate_place),
                           place(local.rate_squared, local.rate_squared_place),
                           local.depth * piece.origin * piece.origin.transpose() + mixed + mixed.transpose() +
                               piece.axes * local.depth_places * piece.axes.transpose()},
                          1);
    sums.rates->force_by_area += local.force_by_area;
    sums.rates->first_moment_by_area += place(local.force_by_area, local.force_place_by_area);
  }

  /// What follows from where the piece lies: rate and measure.
  void complete(Piece& piece, const Vector3& normal_at_origin, const Matrix3& normal_change,
                const Shared& shared) const {
    const Vector3& a = shape_.semiaxes;
    const Vector3 cofactor = a.prod() * a.cwiseInverse();
    const auto by_area = [&](const Vector3& direction) {
      const Vector3 turned = cofactor.cwiseProduct(direction);
      return SpaceLinear{-turned.dot(normal_at_origin), -(normal_change.transpose() * turned)};
    };
    piece.rate = {-(shared.view.vertical_speed + shared.rate_slope.dot(piece.origin)),
                  -(piece.axes.transpose() * shared.rate_slope)};
    if (ground_.area == AreaMeasure::projected) {
      piece.weight = by_area(shared.normal);
      piece.weight_rate = by_area(shared.rate_slope);
      return;
    }
    piece.weight_rate = {};
    piece.area = a.x() * a.x();
    piece.by_normal = !shape_.is_ball();
    piece.normal = cofactor.cwiseProduct(normal_at_origin);
    piece.normal_change = cofactor.asDiagonal() * normal_change;
  }

  /// As fine as the square root of the measure asks for: it is analytic where |Im ψ| and |Im φ| < arsinh(κ/ρ), κ the
  /// least over the largest semiaxis, ρ the sine of the cap's half-angle.
  [[nodiscard]] CapRule rule_for(double height) const {
    CapRule rule;
    if (ground_.area == AreaMeasure::projected || shape_.is_ball()) return rule;
    constexpr double digits = 14;
    const double kappa = slimness_ / std::sqrt((1 - slimness_) * (1 + slimness_));
    const double rho = height < 1 ? std::sqrt(height * (2 - height)) : 1;
    rule.around = 6 + 2 * static_cast<int>(std::ceil(digits * std::numbers::ln10 / (2 * std::asinh(kappa / rho))));
    const double strip = std::asinh(kappa), cosine = std::cosh(strip);
    const double rim = 1 - std::min(height, 2.0);
    const std::complex<double> beyond(1 - rim * cosine, std::sqrt(std::max(1 - rim * rim, 0.0)) * std::sinh(strip));
    for (rule.parts = 1;; rule.parts *= 2) {
      const double half = height / (2 * rule.parts);
      const auto ellipse = [&](const std::complex<double>& singular, double middle) {
        const std::complex<double> z = (singular - middle) / half, root = std::sqrt(z * z - 1.0);
        return std::max(std::abs(z + root), std::abs(z - root));
      };
      const double least = std::min(ellipse(1 - cosine, half), ellipse(beyond, height - half));
      rule.heights = gauss_order(least, digits);
      if (rule.heights < most_gauss_nodes || rule.parts >= 64) return rule;
    }
  }

  struct SlipOver {
    SpaceLinear east, north;
  };

  /// The slip of a piece; `field`'s floor counts where its points slip alike.
  [[nodiscard]] SlipOver slip_over(const Piece& piece, const GroundView& view, const SlipField& field) const {
    const BodySlip slip = body_slip(piece.origin, view, field);
    SlipOver over{{slip.east, piece.axes.transpose() * slip.east_slope}, {}};
    if (!field.planar) over.north = {slip.north, piece.axes.transpose() * slip.north_slope};
    return over;
  }

  [[nodiscard]] DirectionSums directions(const Piece& piece, const GroundView& view, const SlipField& field) const {
    const auto [east, north] = slip_over(piece, view, field);
    const Range by_east = range_over(piece, east), by_north = range_over(piece, north);
    const double width = std::max(by_east.high - by_east.low, by_north.high - by_north.low);
    const double k = ground_.stiffness, c = ground_.damping;
    const double rounding =
        width > SlipField::alike * field.floor ? field.regularisation : std::max(field.regularisation, field.floor);
    const PieceSlip slip{piece,
                         east,
                         north,
                         {k + c * piece.rate.value, c * piece.rate.slope},
                         rounding,
                         field.digits,
                         ground_.area == AreaMeasure::projected};
    if (rounding == 0 && slips_one_way(slip)) {
      DirectionSums sums;
      const AlongGround way = steepest(slip);
      const SpaceLinear along = component(slip, way);
      const Range range = range_over(piece, along);
      for (const double side : {1.0, -1.0}) {
        if (!(side > 0 ? range.high > 0 : range.low < 0)) continue;
        HalfSpaces parts = piece.parts;
        if (range.low < 0 && range.high > 0) parts.add({side * along.value, side * along.slope});
        const AlongGround direction{side * way.east, side * way.north};
        over(piece, parts, [&](const Vector3& p, double area) { sums.add(p, area * slip.load(p), direction); });
      }
      return sums;
    }
    DirectionSummer sums(slip);
    const bool is_whole = piece.parts.count() == 0;
    if (field.rough) {
      over(piece, piece.parts, [&](const Vector3& p, double area) { sums.add(p, area); });
    } else if (!(piece.is_mantle ? is_whole && over_whole_strip(slip, width, sums) : over_cap(slip, sums))) {
      over_slices(slip, piece.parts, sums);
    }
    return sums.sums();
  }

  template <class Visit>
  void over(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const {
    if (piece.is_mantle) return over_part_of_mantle(piece, parts, visit);
    Zone zone{0, piece.height};
    if (between_heights(parts, zone)) {
      if (zone.high > zone.low) over_zone(zone, rule_for(piece.height), visit);
      return;
    }
    HalfSpaces all = parts;
    if (piece.height < 2) all.add({piece.depth.value / -piece.depth.slope.z(), {0, 0, -1}});
    over_part(all, visit);
  }

  template <class Visit>
  void over_part_of_mantle(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const {
    constexpr double digits = 15;
    const bool round = ground_.area == AreaMeasure::projected || shape_.is_ball();
    const int around = round ? 8 : 8 + static_cast<int>(digits * std::numbers::ln10 / std::asinh(slimness_));
    double deeper = 0;
    if (parts.count() == 0) return over_mantle(piece.mantle, around, 0, visit);
    if (parts.count() == 1 && is_by_depth(parts[0], piece.depth, deeper)) {
      Mantle below = piece.mantle;
      below.depth -= deeper;
      const bool is_deep = parts[0].slope.dot(piece.depth.slope) > 0;
      if (!is_deep) over_mantle(piece.mantle, around, 0, visit);
      return over_mantle(below, around, 0, [&](const Vector3& p, double area) { visit(p, is_deep ? area : -area); });
    }
    HalfSpaces all = parts;
    all.add(piece.depth);
    Slices(piece.mantle.length, all).visit(visit);
  }

  const Body& body_;
  const Ground& ground_;
  Footprint* footprint_;
  SmoothShape shape_;
  double slimness_ = 1;          ///< least over largest semiaxis
  std::array<Piece, 3> pieces_;  ///< that press, of the last load
  int count_ = 0;
};

}  // namespace

std::unique_ptr<ContactSurface> contact_surface(const Body& body, const Ground& ground, Footprint* footprint) {
  if (body.smooth()) return std::make_unique<SmoothContact>(body, ground, footprint);
  return facet_surface(body, ground, footprint);
}

}  // namespace clatter::numeric
