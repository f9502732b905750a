// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/smooth_patch.hpp"

#include <algorithm>
#include <cassert>

namespace clatter::numeric {
namespace {

/// Sorts by insertion: std::sort of so few makes g++ 12 warn of places that it never reaches.
template <class Iterator>
void sort_few(Iterator begin, Iterator end) {
  for (Iterator i = begin; i != end; ++i) std::rotate(std::upper_bound(begin, i, *i), i, i + 1);
}

/// A plane by its unit normal, f = distance + normal·p.
struct UnitPlane {
  double distance;  ///< of the origin
  Vector3 normal;
};

UnitPlane unit_plane(const SpaceLinear& f) {
  const double size = f.slope.norm();
  return {f.value / size, f.slope / size};
}

/// Where two planes and the unit sphere about (0, 0, 1) meet: 0 or 2 points.
int meet(const UnitPlane& one, const UnitPlane& other, std::array<Vector3, 2>& points) {
  const Vector3 line = one.normal.cross(other.normal);
  const double square = line.squaredNorm();
  if (!(square > 1e-28)) return 0;
  const Vector3 foot = -(one.distance * other.normal.cross(line) + other.distance * line.cross(one.normal)) / square;
  const Vector3 along = line / std::sqrt(square);
  const double constant = foot.squaredNorm() - 2 * foot.z(), discriminant = along.z() * along.z() - constant;
  if (!(discriminant > 0)) return 0;
  const double far = along.z() + std::copysign(std::sqrt(discriminant), along.z());
  points = {foot + far * along, foot + constant / far * along};
  return 2;
}

/// sin x/x.
double sinc(double x) { return std::fabs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

}  // namespace

Vector3 SphereArc::at(double angle) const {
  Vector3 p = middle + a * std::cos(angle) + b * std::sin(angle);
  const double square = p.x() * p.x() + p.y() * p.y();
  if (square < 0.5 && p.z() < 1) p.z() = square / (1 + std::sqrt(1 - square));
  return p;
}

SphereRay::SphereRay(const Vector3& from, const Vector3& end, const Vector3& rate, bool is_low)
    : from_(from), end_(end), way_(end - from), is_low_(is_low) {
  if (is_low_) {
    area_ = way_.x() * rate.y() - way_.y() * rate.x();
    return;
  }
  sine_ = std::min(way_.norm() / 2, 1.0);
  cosine_ = std::sqrt((1 - sine_) * (1 + sine_));
  half_ = std::asin(sine_);
  const double sine = 2 * sine_ * cosine_;
  inverse_sine_ = sine > 0 ? 1 / sine : 0;
  area_ = -(from - Vector3::UnitZ()).dot(way_.cross(rate)) * (sine > 0 ? 2 * half_ * inverse_sine_ : 1);
}

int ray_order(double highest, double length, double digits) {
  if (!(highest < SphereRay::low)) return trigonometric_order(std::asin(std::min(std::sqrt(highest / 2), 1.0)));
  // The roots of (1 − p_z)² = 1 − |p_xy|² lie no nearer, in units of half the ray from its middle.
  const double rho = std::sqrt(highest * (2 - highest)), nearest = 1 + 2 * (1 - rho) / std::max(length, 1e-3);
  return gauss_order(nearest + std::sqrt(nearest * nearest - 1), digits);
}

SurfacePoint SphereRay::at(double part) const {
  if (is_low_) {
    const double x = from_.x() + part * way_.x(), y = from_.y() + part * way_.y(), square = x * x + y * y;
    const double root = std::sqrt(1 - square);
    return {{x, y, square / (1 + root)}, area_ * part / root};
  }
  if (!(inverse_sine_ > 0)) return {(1 - part) * from_ + part * end_, area_ * part};
  const double sine = std::sin(part * half_), cosine = std::cos(part * half_);
  const double sine_left = sine_ * cosine - cosine_ * sine, cosine_left = cosine_ * cosine + sine_ * sine;
  const double forward = 2 * sine * cosine * inverse_sine_, back = 2 * sine_left * cosine_left * inverse_sine_;
  SurfacePoint point{back * from_ + forward * end_, area_ * forward};
  point.place.z() -= 2 * sine * sine_left / cosine_;
  return point;
}

SphereBoundary::SphereBoundary(const HalfSpaces& half_spaces) {
  has_top = half_spaces.contain({0, 0, 2});
  for (int i = 0; i < half_spaces.count(); ++i) {
    if (!(half_spaces[i].slope.squaredNorm() > 0)) {
      if (half_spaces[i].value > 0) continue;
      count = 0;
      has_top = false;
      return;
    }
    const auto [distance, normal] = unit_plane(half_spaces[i]);
    const double across = normal.x() * normal.x() + normal.y() * normal.y();
    const double square = across - distance * (2 * normal.z() + distance);
    if (!(square > 0)) continue;  // the plane misses the sphere: all of it is in, or nothing, which the top tells
    const Vector3 unit = normal.unitOrthogonal();
    SphereArc arc{Vector3(-normal.z() * normal.x(), -normal.z() * normal.y(), across) - distance * normal,
                  std::sqrt(square) * unit, std::sqrt(square) * unit.cross(normal)};
    std::array<double, 2 * HalfSpaces::most> angles;
    int found = 0;
    for (int j = 0; j < half_spaces.count(); ++j) {
      std::array<Vector3, 2> points;
      if (j == i || !(half_spaces[j].slope.squaredNorm() > 0)) continue;
      if (meet({distance, normal}, unit_plane(half_spaces[j]), points) == 0) continue;
      for (const Vector3& p : points) {
        const Vector3 arm = p - arc.middle;
        angles[found++] = std::atan2(arm.dot(arc.b), arm.dot(arc.a));
      }
    }
    sort_few(angles.begin(), angles.begin() + found);
    for (int j = 0; j < std::max(found, 1); ++j) {
      const bool whole = found == 0, last = j + 1 == found;
      arc.from = whole ? 0 : angles[j];
      arc.to = whole  ? 2 * std::numbers::pi
               : last ? angles[0] + 2 * std::numbers::pi
                      : angles[static_cast<std::size_t>(j) + 1];
      if (arc.to > arc.from && half_spaces.contain(arc.at((arc.from + arc.to) / 2), i)) arcs[count++] = arc;
    }
  }
}

double Mantle::Strip::x(double t) const {
  const double half_change = t * (narrow - wide) / 2;
  return x1 + per_cosine * t * sinc(half_change) * std::sin(wide + half_change);
}

double Mantle::end() const {
  if (!(depth > 0)) return 0;
  return slope < 0 ? std::min(length, -depth / slope) : length;
}

double Mantle::full_end() const {
  const double over = depth - 2 * drop;
  if (!(over >= 0)) return 0;
  return slope < 0 ? std::min(length, -over / slope) : length;
}

double Mantle::half_width(double x) const {
  return 2 * std::asin(std::sqrt(std::clamp((depth + slope * x) / (2 * drop), 0.0, 1.0)));
}

Mantle::Strip Mantle::strip() const {
  const double x1 = full_end(), x2 = end();
  if (!(x2 > x1) || !(drop > 0)) return {};
  const double narrow = slope < 0 && x2 < length ? 0 : half_width(x2);
  const double wide = x1 > 0 ? std::numbers::pi : half_width(x1);
  if (!(wide > 0)) return {};
  return {x1, x2, wide, narrow, (x2 - x1) / (sinc((narrow - wide) / 2) * std::sin((wide + narrow) / 2))};
}

Slices::Slices(double length, const HalfSpaces& half_spaces)
    : is_sphere_(false), along_(Vector3::UnitX()), across_(Vector3::UnitY()), half_spaces_(half_spaces) {
  begin(0, length);
}

Slices::Slices(const HalfSpaces& half_spaces, double axis)
    : is_sphere_(true), along_(std::cos(axis), std::sin(axis), 0), across_(-std::sin(axis), std::cos(axis), 0),
      half_spaces_(half_spaces) {
  begin(-1, 1);
}

void Slices::begin(double low, double high) {
  low_ = low;
  high_ = high;
  breaks_[count_++] = low;
  breaks_[count_++] = high;
  for (int i = 0; i < half_spaces_.count(); ++i) {
    add_touches(half_spaces_[i]);
    for (int j = 0; j < i; ++j) add_corners(half_spaces_[i], half_spaces_[j]);
  }
  sort_few(breaks_.begin(), breaks_.begin() + count_);
}

void Slices::mind(const SpaceLinear& one, const SpaceLinear& other) {
  add_touches(one);
  add_corners(one, other);
  add_near_miss(one, other);
  for (int i = 0; i < half_spaces_.count(); ++i) add_corners(one, half_spaces_[i]);
  sort_few(breaks_.begin(), breaks_.begin() + count_);
}

void Slices::add_break(double x) {
  assert(count_ < static_cast<int>(breaks_.size()));
  if (x > low_ && x < high_) breaks_[count_++] = x;
}

void Slices::add_touches(const SpaceLinear& plane) {
  const double x = along(plane.slope), size = std::hypot(across_.dot(plane.slope), plane.slope.z());
  if (!is_sphere_) {
    if (x == 0) return;
    add_break(-(plane.value + plane.slope.z() + size) / x);
    add_break(-(plane.value + plane.slope.z() - size) / x);
    return;
  }
  const double square = plane.slope.squaredNorm();
  if (!(square > 0)) return;
  // The ends of its circle along the axis.
  const double centre = plane.value + plane.slope.z(), radius = 1 - centre * centre / square;
  if (!(radius > 0)) return;
  const double middle = -centre * x / square, half = std::sqrt(radius / square) * size;
  add_break(middle - half);
  add_break(middle + half);
}

/// Points of the line of two planes on the sphere or on y² + (ζ − 1)² = 1.
void Slices::add_corners(const SpaceLinear& one, const SpaceLinear& other) {
  if (is_sphere_) {
    std::array<Vector3, 2> points;
    if (!(one.slope.squaredNorm() > 0 && other.slope.squaredNorm() > 0)) return;
    if (meet(unit_plane(one), unit_plane(other), points) == 0) return;
    for (const Vector3& p : points) add_break(along(p));
    return;
  }
  const Vector3 line = one.slope.cross(other.slope);
  const double square = line.squaredNorm();
  if (!(square > 0)) return;
  const Vector3 foot = -(one.value * other.slope.cross(line) + other.value * line.cross(one.slope)) / square;
  const double a = line.y() * line.y() + line.z() * line.z(), z = foot.z() - 1;
  const double b = foot.y() * line.y() + z * line.z(), c = foot.y() * foot.y() + z * z - 1;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0) || !(a > 0)) return;
  for (const double sign : {1.0, -1.0}) add_break(foot.x() + (-b + sign * std::sqrt(discriminant)) / a * line.x());
}

/// Where the line of two planes misses the sphere or cylinder, its complex points foot ± i w line: sums over slices
/// turn at their real part, within the imaginary one.
void Slices::add_near_miss(const SpaceLinear& one, const SpaceLinear& other) {
  constexpr double wider = 8;
  const Vector3 line = one.slope.cross(other.slope);
  const double square = line.squaredNorm();
  if (!(square > 0)) return;
  const Vector3 foot =
      -(one.value * other.slope.cross(line) + other.value * line.cross(one.slope)) / square - Vector3::UnitZ();
  Vector3 round = line, from = foot;  // what of them counts for the distance to the axis or the centre
  if (!is_sphere_) round.x() = from.x() = 0;
  const double a = round.squaredNorm(), b = from.dot(round), c = from.squaredNorm() - 1, discriminant = b * b - a * c;
  if (!(a > 0) || !(discriminant < 0)) return;
  const double x = along(foot - b / a * line), width = std::fabs(std::sqrt(-discriminant) / a * along(line));
  for (const double off : {-wider * width, -width, 0.0, width, wider * width}) add_break(x + off);
}

Vector3 Slices::place(const Slice& slice, double angle) const {
  const double half = std::sin(angle / 2), square = half * half;
  const double across = 2 * slice.radius * half * std::sqrt(std::max(1 - square, 0.0));  // |angle| <= π
  Vector3 p = slice.x * along_ + across * across_;
  p.z() = 2 * slice.radius * square;
  if (is_sphere_) p.z() += slice.x * slice.x / (1 + slice.radius);
  return p;
}

Slices::Slice Slices::slice(int interval, double part) const {
  const double begin = breaks_[interval];
  const double width = breaks_[static_cast<std::size_t>(interval) + 1] - begin;
  const double sine = std::sin(std::numbers::pi / 2 * part);
  Slice slice{.x = begin + width * sine * sine, .from = {}, .to = {}};
  slice.rate = std::numbers::pi / 2 * width * std::sin(std::numbers::pi * part);
  if (is_sphere_) slice.radius = std::sqrt(std::max((1 - slice.x) * (1 + slice.x), 0.0));
  const Vector3 bottom = place(slice, 0);
  std::array<double, most + 2> angles;
  std::size_t found = 0;
  angles[found++] = -std::numbers::pi;
  angles[found++] = std::numbers::pi;
  for (int i = 0; i < half_spaces_.count(); ++i) {
    const SpaceLinear& f = half_spaces_[i];
    const double y = slice.radius * across_.dot(f.slope), z = slice.radius * f.slope.z(), size = std::hypot(y, z);
    // f = f(bottom) + y sin φ + z (1 − cos φ) = … + size cos(φ − peak); its part above −size, without cancellation.
    const double above = f.at(bottom) + (z < 0 ? y * y / (size - z) : size + z);
    if (!(size > 0) || !(above > 0) || !(above < 2 * size)) continue;
    const double half = 2 * std::asin(std::sqrt(above / (2 * size))), peak = std::atan2(y, -z);
    for (const double angle : {peak - half, peak + half}) angles[found++] = std::remainder(angle, 2 * std::numbers::pi);
  }
  sort_few(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(found));
  for (std::size_t i = 0; i + 1 < found && slice.count < most; ++i) {
    if (!(angles[i + 1] > angles[i])) continue;
    if (!half_spaces_.contain(place(slice, (angles[i] + angles[i + 1]) / 2))) continue;
    slice.from[slice.count] = angles[i];
    slice.to[slice.count++] = angles[i + 1];
  }
  return slice;
}

}  // namespace clatter::numeric
