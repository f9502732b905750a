// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/smooth_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

#include "numeric/contact/footprint.hpp"

namespace clatter::numeric {
namespace {

using Piece = SmoothContact::Piece;

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

}  // namespace

/// What all pieces of an evaluation share.
struct SmoothContact::Shared {
  const GroundView& view;
  Vector3 normal;      ///< of the ground, body frame
  Vector3 rate_slope;  ///< δ̇ = −(vertical speed + rate_slope·u); also the rate of change of the normal
  Vector3 up;          ///< m: the gradient of the height on the ball, unit
  double stretch;      ///< its size s [m]
};

struct SmoothContact::Sums {
  LoadIntegrals pressing;
  ContactLoad load;
  LoadRates* rates;
};

std::unique_ptr<ContactSurface> contact_surface(const Body& body, const Ground& ground, Footprint* footprint) {
  if (body.smooth()) return std::make_unique<SmoothContact>(body, ground, footprint);
  return std::make_unique<ContactLoader>(body, ground, footprint);
}

SmoothContact::SmoothContact(const Body& body, const Ground& ground, Footprint* footprint)
    : body_(body), ground_(ground), footprint_(footprint), shape_(*body.smooth()),
      slimness_(shape_.semiaxes.minCoeff() / shape_.semiaxes.maxCoeff()) {}

ContactLoad SmoothContact::load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) {
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
    depths[static_cast<std::size_t>(end)] = depth;
    if (depth > sums.load.deepest) {
      sums.load.deepest = depth;
      sums.load.deepest_rate = -(view.vertical_speed + shared.rate_slope.dot(centre - a.cwiseProduct(shared.up)));
    }
    if (!(depth > 0)) continue;
    if (submerged) submerged->push_back(end);
    add_end(end, depth, shared, sums);
  }
  if (shape_.straight > 0 && sums.load.deepest > 0) add_mantle(depths, shared, sums);
  take_ground(ground_, sums.pressing, sums.load);
  if (rates) {
    rates->stiffness = ground_.stiffness;
    rates->damping = ground_.damping;
    rates->load = sums.pressing;
  }
  return sums.load;
}

/// What follows from where the piece lies: rate and measure.
void SmoothContact::complete(Piece& piece, const Vector3& normal_at_origin, const Matrix3& normal_change,
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

void SmoothContact::add_end(int end, double depth, const Shared& shared, Sums& sums) {
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

void SmoothContact::add_mantle(const std::array<double, 2>& depths, const Shared& shared, Sums& sums) {
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
  const double depth = depths[static_cast<std::size_t>(deeper)] - shared.stretch * (up.x() * up.x() / (1 + steep));
  piece.depth = {depth, {-shared.stretch * std::fabs(up.x()), 0, -shared.stretch * steep}};
  piece.mantle = {shape_.straight / shape_.semiaxes.x(), depth, piece.depth.slope.x(), shared.stretch * steep};
  if (!(depth > 0)) return;
  Matrix3 normal_change = turn;
  normal_change.col(0).setZero();
  complete(piece, down, normal_change, shared);
  add_piece(piece, sums);
}

/// As fine as the square root of the measure asks for: it is analytic where |Im ψ| and |Im φ| < arsinh(κ/ρ), κ the
/// least over the largest semiaxis, ρ the sine of the cap's half-angle.
CapRule SmoothContact::rule_for(double height) const {
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

template <class Visit>
void SmoothContact::over(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const {
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
void SmoothContact::over_part_of_mantle(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const {
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

void SmoothContact::add_piece(Piece& piece, Sums& sums) {
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
  if (ground_.has_friction()) pieces_[static_cast<std::size_t>(count_++)] = piece;
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

namespace {

constexpr double most_variation = 0.45;  ///< of the slip over a cell, from its middle, in parts of it
constexpr int most_around = 48;          ///< beyond it, graded parts take fewer

/// Slip over a piece, in its coordinates, and what presses there.
struct PieceSlip {
  const Piece& piece;
  SpaceLinear east, north, pressure;
  double rounding, digits;
  bool projected;

  [[nodiscard]] double load(const Vector3& p) const {
    return piece.depth.at(p) * pressure.at(p) * weight_at(piece, p, projected);
  }
  [[nodiscard]] SlipVector at(const Vector3& p) const { return {east.at(p), north.at(p)}; }
};

void add_at(const PieceSlip& slip, const Vector3& p, double area, DirectionSums& sums) {
  const SlipVector v = slip.at(p);
  const double size = std::sqrt(v.square() + slip.rounding * slip.rounding);
  if (size > 0) sums.add(p, area * slip.load(p) / size, v);
}

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

/// The place of the lower half of the ball where nothing slips, by Newton's method; whether it is near the cap.
bool find_resting_place(const PieceSlip& slip, Vector3& place) {
  const double height = slip.piece.height;
  if (slip.piece.is_mantle || !(height < 0.5)) return false;
  const double widest = std::min(3 * std::sqrt(height * (2 - height)), 0.6);
  place.setZero();
  for (int pass = 0; pass < 12; ++pass) {
    const SlipVector v = slip.at(place);
    const double tilt = 1 / (1 - place.z());
    const double ex = slip.east.slope.x() + slip.east.slope.z() * place.x() * tilt;
    const double ey = slip.east.slope.y() + slip.east.slope.z() * place.y() * tilt;
    const double nx = slip.north.slope.x() + slip.north.slope.z() * place.x() * tilt;
    const double ny = slip.north.slope.y() + slip.north.slope.z() * place.y() * tilt;
    const double determinant = ex * ny - ey * nx, size = ex * ex + ey * ey + nx * nx + ny * ny;
    if (!(std::fabs(determinant) > 1e-6 * size)) return false;
    const double dx = (v.north * ey - v.east * ny) / determinant, dy = (v.east * nx - v.north * ex) / determinant;
    place.x() += dx;
    place.y() += dy;
    const double square = place.x() * place.x() + place.y() * place.y();
    if (!(square < widest * widest)) return false;
    place.z() = square / (1 + std::sqrt(1 - square));
    if (std::hypot(dx, dy) <= 1e-15 * widest) return true;
  }
  return false;
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

/// Gauss's rule on a part of a curve, by how much the slip varies over it.
struct PartRule {
  bool is_smooth;  ///< enough for one rule
  double digits, square, varies;

  PartRule(const PieceSlip& slip, const SlipVector& middle, const SlipVector& from, const SlipVector& to)
      : digits(slip.digits), square(middle.square() + slip.rounding * slip.rounding) {
    const auto change = [&](const SlipVector& other) {
      return SlipVector{other.east - middle.east, other.north - middle.north}.square();
    };
    varies = std::max(change(from), change(to));
    is_smooth = varies <= most_variation * most_variation * square;
  }
  /// @param half  of the angle that the part spans [rad]
  [[nodiscard]] int order(double half) const {
    if (!is_smooth) return 2;
    const double inverse = std::sqrt(square / std::max(varies, 1e-12 * square));
    return std::max(gauss_order(inverse + std::sqrt(inverse * inverse - 1), digits), trigonometric_order(half) + 2);
  }
};

/// A cap, or a part of one, as rays from the place where nothing slips, along which the direction hardly varies, to its
/// boundary; their areas have signs, so that the place may lie outside.
class RestingFan {
 public:
  /// @param centre  of find_resting_place()
  RestingFan(const PieceSlip& slip, const Vector3& centre, DirectionSums& sums);
  /// False, and nothing added, where the slip turns round along the rays.
  bool add_up();

 private:
  /// Parts of the rim, halved until the slip varies little along each.
  struct Part {
    double from, to;
    SlipVector at_from, at_to;
    int level;
  };
  void add_ray(const SphereArc& arc, double angle, double step);
  void add_graded(const SphereArc& arc);

  const PieceSlip& slip_;
  Vector3 centre_;
  SphereArc rim_;  ///< of the whole cap
  DirectionSums& sums_;
  int order_ = 0;       ///< along a ray
  bool is_low_ = true;  ///< of SphereRay
};

RestingFan::RestingFan(const PieceSlip& slip, const Vector3& centre, DirectionSums& sums)
    : slip_(slip), centre_(centre), sums_(sums) {
  const double height = slip.piece.height, rho = std::sqrt(height * (2 - height));
  rim_ = {{0, 0, height}, {rho, 0, 0}, {0, rho, 0}, 0, 2 * std::numbers::pi};
}

/// Along a ray v = λ v₁ + λ² v₂, v₂ by the heights: the direction is analytic up to |v₁/v₂|.
bool RestingFan::add_up() {
  constexpr double nearest = 1.5;
  const Vector3 &e = slip_.east.slope, &n = slip_.north.slope;
  const double determinant = std::fabs(e.x() * n.y() - e.y() * n.x());
  const double size = e.head<2>().squaredNorm() + n.head<2>().squaredNorm();
  const double least = determinant / std::sqrt(size);  // not above √2 × the lesser singular value
  const double length = std::hypot(centre_.x(), centre_.y()) + rim_.a.x();
  const double root = least / (std::hypot(e.z(), n.z()) * length / 2 + 1e-3 * least);
  if (!(root > nearest)) return false;
  const double bend = 2 * root - 1;
  const double highest = std::max(slip_.piece.height, centre_.z());
  is_low_ = highest < SphereRay::low;
  order_ =
      std::max(ray_order(highest, length, slip_.digits), gauss_order(bend + std::sqrt(bend * bend - 1), slip_.digits));
  if (order_ >= most_gauss_nodes) return false;
  if (slip_.piece.parts.count() > 0) {
    HalfSpaces all = slip_.piece.parts;
    all.add({slip_.piece.height, {0, 0, -1}});
    const SphereBoundary boundary(all);
    for (int i = 0; i < boundary.count; ++i) add_graded(boundary.arcs[static_cast<std::size_t>(i)]);
    return true;
  }
  const int around = places_around(slip_, rim_);
  if (around > most_around) return add_graded(rim_), true;
  for (int i = 0; i < around; ++i) add_ray(rim_, 2 * std::numbers::pi * i / around, 2 * std::numbers::pi / around);
  return true;
}

/// Below v_r the direction fades like λ/√(λ² + f²): by the roots ±if on [0, 2f] and, from five times the end of one
/// part to that of the next, on [a, 5a], a >= 2f.  That, and all within 2f, is no more than f² of the whole.
void RestingFan::add_ray(const SphereArc& arc, double angle, double step) {
  static constexpr double first_ellipse = 2.89, next_ellipse = 2.6, least_digits = 3;
  const Vector3 end = arc.at(angle);
  const SphereRay ray(centre_, end, arc.rate(angle), is_low_);
  const double fades = slip_.rounding > 0 ? std::min(slip_.rounding / std::sqrt(slip_.at(end).square()), 1.0) : 0;
  const double digits = fades > 0 ? std::max(slip_.digits + 2 * std::log10(fades), least_digits) : 0;
  double from = 0, to = fades > 0 ? std::min(2 * fades, 1.0) : 1;
  while (from < 1) {
    int order = to == 1 ? order_ : std::min(order_, 5);
    if (fades > 0) order = std::max(order, gauss_order(from > 0 ? next_ellipse : first_ellipse, digits));
    for (const GaussNode& node : gauss_rule(order)) {
      const auto [place, area] = ray.at((from + to) / 2 + (to - from) / 2 * node.at);
      add_at(slip_, place, (to - from) / 2 * node.weight * area * step, sums_);
    }
    from = to;
    to = std::min(5 * to, 1.0);
  }
}

/// Where the resting place lies so near the boundary that the direction turns there within a short way.
void RestingFan::add_graded(const SphereArc& arc) {
  constexpr double longest = std::numbers::pi / 2;
  std::array<Part, 128> stack;
  int top = 0;
  const auto slip_at = [&](double angle) { return slip_.at(arc.at(angle)); };
  const double length = arc.to - arc.from;
  const int begins = std::max(1, static_cast<int>(std::ceil(length / longest)));
  for (int i = 0; i < begins; ++i) {
    const double from = arc.from + length * i / begins, to = arc.from + length * (i + 1) / begins;
    stack[static_cast<std::size_t>(top++)] = {from, to, slip_at(from), slip_at(to), 0};
  }
  const int deepest = std::min(60, static_cast<int>(slip_.digits / std::log10(2.0)) + 2);
  while (top > 0) {
    const Part part = stack[static_cast<std::size_t>(--top)];
    const double middle = (part.from + part.to) / 2, half = (part.to - part.from) / 2;
    const SlipVector v = slip_at(middle);
    const PartRule rule(slip_, v, part.at_from, part.at_to);
    if (!rule.is_smooth && part.level < deepest) {
      stack[static_cast<std::size_t>(top++)] = {part.from, middle, part.at_from, v, part.level + 1};
      stack[static_cast<std::size_t>(top++)] = {middle, part.to, v, part.at_to, part.level + 1};
      continue;
    }
    for (const GaussNode& node : gauss_rule(rule.order(half))) {
      add_ray(arc, middle + half * node.at, half * node.weight);
    }
  }
}

/// The direction in which the slip varies most over the piece; the slip's own where it does not vary.
SlipVector steepest(const PieceSlip& slip) {
  const Vector3 &e = slip.east.slope, &n = slip.north.slope;
  const double angle = std::atan2(2 * e.dot(n), e.squaredNorm() - n.squaredNorm()) / 2;
  return {std::cos(angle), std::sin(angle)};
}

SpaceLinear component(const PieceSlip& slip, const SlipVector& way) {
  return {way.east * slip.east.value + way.north * slip.north.value,
          way.east * slip.east.slope + way.north * slip.north.slope};
}

/// Along a piece of a slice, by Gauss's rule on parts that are halved until the slip varies little over each.
void along_slice(const PieceSlip& slip, const Slices& slices, const Slices::Slice& slice, double begin, double end,
                 double weight, DirectionSums& sums) {
  struct Part {
    double from, to;
    SlipVector at_from, at_to;
    int level;
  };
  const auto slip_at = [&](double angle) { return slip.at(slices.place(slice, angle)); };
  std::array<Part, 128> stack;
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = {begin, end, slip_at(begin), slip_at(end), 0};
  const int deepest = std::min(60, static_cast<int>(slip.digits / std::log10(2.0)) + 2);
  while (top > 0) {
    const Part part = stack[static_cast<std::size_t>(--top)];
    const double middle = (part.from + part.to) / 2, half = (part.to - part.from) / 2;
    const SlipVector v = slip_at(middle);
    const PartRule rule(slip, v, part.at_from, part.at_to);
    if (!rule.is_smooth && part.level < deepest) {
      stack[static_cast<std::size_t>(top++)] = {part.from, middle, part.at_from, v, part.level + 1};
      stack[static_cast<std::size_t>(top++)] = {middle, part.to, v, part.at_to, part.level + 1};
      continue;
    }
    for (const GaussNode& node : gauss_rule(rule.order(half))) {
      add_at(slip, slices.place(slice, middle + half * node.at), weight * half * node.weight, sums);
    }
  }
}

/// Any part of a piece, by slices across which the slip varies most.
void over_slices(const PieceSlip& slip, HalfSpaces parts, DirectionSums& sums) {
  const Piece& piece = slip.piece;
  const SlipVector way = steepest(slip);
  const SpaceLinear along = component(slip, way), across = component(slip, {-way.north, way.east});
  if (piece.is_mantle) parts.add(piece.depth);
  else if (piece.height < 2) parts.add({piece.depth.value / -piece.depth.slope.z(), {0, 0, -1}});
  const double axis = std::atan2(along.slope.x(), -along.slope.y());
  Slices slices = piece.is_mantle ? Slices(piece.mantle.length, parts) : Slices(parts, axis);
  slices.mind(along, across);
  slices.each_piece([&](const Slices::Slice& slice, double from, double to, double weight) {
    along_slice(slip, slices, slice, from, to, weight, sums);
  });
}

/// The cap, or its part, where one rule serves; false: none does.
bool over_cap(const PieceSlip& slip, DirectionSums& sums) {
  const Variation change = variation(slip);
  const double part =
      (change.along + change.up) / std::sqrt(slip.at(Vector3::Zero()).square() + slip.rounding * slip.rounding);
  if (part < 0.5 && slip.piece.parts.count() == 0) {
    over_zone({0, slip.piece.height}, rule_of_variation(slip, part),
              [&](const Vector3& p, double area) { add_at(slip, p, area, sums); });
    return true;
  }
  Vector3 centre;
  return find_resting_place(slip, centre) && RestingFan(slip, centre, sums).add_up();
}

/// The whole strip, if the slip varies by less than a third of its size.
bool over_whole_strip(const PieceSlip& slip, double width, DirectionSums& sums) {
  constexpr double largest_part = 1.0 / 3;
  const double part = 2 * width / std::sqrt(slip.at(Vector3::Zero()).square() + slip.rounding * slip.rounding);
  if (!(part < largest_part)) return false;
  const int more = static_cast<int>(std::ceil(slip.digits / (2 * std::log10(2 / std::max(part, 1e-15)))));
  over_mantle(slip.piece.mantle, 32, more, [&](const Vector3& p, double area) { add_at(slip, p, area, sums); });
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
  const SlipVector way = steepest(slip);
  const Range along = range_over(slip.piece, component(slip, way));
  if (!(along.low < 0 && along.high > 0)) return slip.north.value == 0 && slip.north.slope.isZero(0);
  const Range across = range_over(slip.piece, component(slip, {-way.north, way.east}));
  return std::max(-across.low, across.high) <= std::pow(10, -slip.digits) * (along.high - along.low);
}

}  // namespace

SlipLoad SmoothContact::slip_load(const GroundView& view, const SlipField& field) {
  SlipLoad load;
  for (int i = 0; i < count_; ++i) {
    const Piece& piece = pieces_[static_cast<std::size_t>(i)];
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

/// The slip of a piece; `field`'s floor counts where its points slip alike.
SmoothContact::SlipOver SmoothContact::slip_over(const Piece& piece, const GroundView& view,
                                                 const SlipField& field) const {
  const BodySlip slip = body_slip(piece.origin, view, field);
  SlipOver over{{slip.east, piece.axes.transpose() * slip.east_slope}, {}};
  if (!field.planar) over.north = {slip.north, piece.axes.transpose() * slip.north_slope};
  return over;
}

DirectionSums SmoothContact::directions(const Piece& piece, const GroundView& view, const SlipField& field) const {
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
  DirectionSums sums;
  if (rounding == 0 && slips_one_way(slip)) {
    const SlipVector way = steepest(slip);
    const SpaceLinear along = component(slip, way);
    const Range range = range_over(piece, along);
    for (const double side : {1.0, -1.0}) {
      if (!(side > 0 ? range.high > 0 : range.low < 0)) continue;
      HalfSpaces parts = piece.parts;
      if (range.low < 0 && range.high > 0) parts.add({side * along.value, side * along.slope});
      const SlipVector direction{side * way.east, side * way.north};
      over(piece, parts, [&](const Vector3& p, double area) { sums.add(p, area * slip.load(p), direction); });
    }
    return sums;
  }
  const bool is_whole = piece.parts.count() == 0;
  if (field.rough) {
    over(piece, piece.parts, [&](const Vector3& p, double area) { add_at(slip, p, area, sums); });
  } else if (!(piece.is_mantle ? is_whole && over_whole_strip(slip, width, sums) : over_cap(slip, sums))) {
    over_slices(slip, piece.parts, sums);
  }
  return sums;
}

SlipRange SmoothContact::slip_range(const GroundView& view, const SlipField& field) const {
  SlipRange range;
  for (int i = 0; i < count_; ++i) {
    const Piece& piece = pieces_[static_cast<std::size_t>(i)];
    const auto [east, north] = slip_over(piece, view, field);
    const Range by_east = range_over(piece, east), by_north = range_over(piece, north);
    range.add(by_east.low, by_north.low);
    range.add(by_east.high, by_north.high);
  }
  return range;
}

}  // namespace clatter::numeric
