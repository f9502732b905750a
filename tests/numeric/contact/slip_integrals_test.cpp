// SPDX-License-Identifier: GPL-3.0-or-later
// Friction over a polygon against brute force: pieces halved until the slip varies little, in extended precision.
#include <boost/math/quadrature/gauss.hpp>

#include "numeric/contact/slip_integrals.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::numeric;
using Real = long double;
using Six = std::array<Real, 6>;  // as SlipIntegrals

constexpr double allowed = 1e-13;  // of ∫|q| dA, times the size for moments

struct Place {
  Real x, y;
};

struct Node {
  Real at, weight;
};

/// Gauss–Legendre in extended precision.
std::vector<Node> legendre_rule() {
  using Rule = boost::math::quadrature::gauss<Real, 14>;
  std::vector<Node> rule;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const Real side : {-1, 1}) rule.push_back({side * Rule::abscissa()[i], Rule::weights()[i]});
  return rule;
}

/// The brute force: halves the polygon across the direction in which the slip changes most, until Gauss's rule serves.
class Oracle {
 public:
  explicit Oracle(const SlipPatch& patch) : patch_(patch) {
    const PlaneLinear &e = patch.east, &n = patch.north;
    const double angle = std::atan2(2 * (e.x * e.y + n.x * n.y), e.x * e.x + n.x * n.x - e.y * e.y - n.y * n.y) / 2;
    axes_[0] = {std::cos(angle), std::sin(angle)};
    axes_[1] = {-std::sin(angle), std::cos(angle)};
    for (int i = 0; i < 2; ++i) speeds_[i] = std::hypot(at_slope(e, axes_[i]), at_slope(n, axes_[i]));
  }

  Six integrals() {
    std::vector<Place> polygon;
    for (int i = 0; i < patch_.count; ++i) {
      polygon.push_back({patch_.corners[i].x, patch_.corners[i].y});
      const Place v = slip(polygon.back());
      fastest_ = std::max(fastest_, std::hypot(v.x, v.y));
    }
    add(polygon, 0);
    return sum_;
  }
  /// ∫|q| dA.
  [[nodiscard]] Real total() const { return total_; }

 private:
  static Real at_slope(const PlaneLinear& f, const Place& p) { return Real(f.x) * p.x + Real(f.y) * p.y; }
  static Real at(const PlaneLinear& f, const Place& p) { return f.value + at_slope(f, p); }
  [[nodiscard]] Place slip(const Place& p) const { return {at(patch_.east, p), at(patch_.north, p)}; }
  [[nodiscard]] Real along(int axis, const Place& p) const { return axes_[axis].x * p.x + axes_[axis].y * p.y; }

  void add(const std::vector<Place>& polygon, int depth) {
    if (polygon.size() < 3) return;
    Real low[2], high[2];
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = high[axis] = along(axis, polygon[0]);
      for (const Place& p : polygon) {
        low[axis] = std::min(low[axis], along(axis, p));
        high[axis] = std::max(high[axis], along(axis, p));
      }
    }
    const Real widths[2] = {(high[0] - low[0]) * speeds_[0], (high[1] - low[1]) * speeds_[1]};
    const int axis = widths[0] >= widths[1] ? 0 : 1;
    const Real middle = (low[axis] + high[axis]) / 2;
    const Place v = slip(polygon[0]);
    const Real least = std::hypot(v.x, v.y) - widths[0] - widths[1];
    const bool smooth = std::hypot(std::max(least, Real(0)), Real(patch_.rounding)) > 3 * widths[axis];
    if (smooth || widths[axis] <= 1e-17L * fastest_ || depth > 200) {
      for (std::size_t i = 2; i < polygon.size(); ++i) add_smooth(polygon[0], polygon[i - 1], polygon[i]);
      return;
    }
    add(part(polygon, axis, middle, 1), depth + 1);
    add(part(polygon, axis, middle, -1), depth + 1);
  }

  [[nodiscard]] std::vector<Place> part(const std::vector<Place>& polygon, int axis, Real cut, int side) const {
    std::vector<Place> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Real at_a = side * (along(axis, a) - cut), at_b = side * (along(axis, b) - cut);
      if (at_a >= 0) out.push_back(a);
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
        const Real t = at_a / (at_a - at_b);
        out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      }
    }
    return out;
  }

  void add_smooth(const Place& a, const Place& b, const Place& c) {
    static const std::vector<Node> rule = legendre_rule();
    const Real area = ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
    for (const Node& m : rule) {
      const Real t = (1 + m.at) / 2;
      const Place end{b.x + t * (c.x - b.x), b.y + t * (c.y - b.y)};
      for (const Node& n : rule) {
        const Real part = (1 + n.at) / 2;
        add_point({a.x + part * (end.x - a.x), a.y + part * (end.y - a.y)}, area / 2 * m.weight * n.weight * part);
      }
    }
  }

  void add_point(const Place& p, Real weight) {
    const Place v = slip(p);
    const Real speed = std::hypot(v.x, v.y, Real(patch_.rounding));
    const Real force = weight * at(patch_.depth, p) * at(patch_.stiffness, p);
    total_ += std::fabs(force);
    if (!(speed > 0)) return;
    const Real east = force * v.x / speed, north = force * v.y / speed;
    const Six here{east, north, east * p.x, east * p.y, north * p.x, north * p.y};
    for (std::size_t i = 0; i < 6; ++i) sum_[i] += here[i];
  }

  const SlipPatch& patch_;
  Place axes_[2];
  Real speeds_[2];
  Real fastest_ = 0, total_ = 0;
  Six sum_{};
};

Six six(const SlipIntegrals& s) { return {s.east, s.north, s.east_x, s.east_y, s.north_x, s.north_y}; }

/// A random polygon with its pressure and slip.
struct Scene {
  std::vector<PlanePoint> corners;
  double size = 1;
  SlipPatch patch;
};

/// Twice the polygon's area over the square of its size: what rounding of corners does to the area of a sliver.
double breadth(const Scene& scene) {
  double sum = 0;
  for (std::size_t i = 2; i < scene.corners.size(); ++i) {
    const PlanePoint &a = scene.corners[0], &b = scene.corners[i - 1], &c = scene.corners[i];
    sum += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  return std::min(sum / (scene.size * scene.size), 1.0);
}

/// Largest deviation, relative to ∫|q| and for moments to the size.
double deviation(const SlipPatch& patch, double size) {
  Oracle oracle(patch);
  const Six exact = oracle.integrals(), found = six(slip_integrals(patch));
  Real worst = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Real error = std::fabs(found[i] - exact[i]) / (oracle.total() * (i < 2 ? 1 : Real(size)));
    if (!(error <= worst)) worst = error;
  }
  return static_cast<double>(worst);
}

enum class Middle { inside, on_an_edge, at_a_corner, beside, far, anywhere };

class Draw : public clatter::test::Random {
 public:
  using Random::Random;
  /// Convex: on an ellipse, down to slivers of 1e-6, turned and away from the origin.
  void polygon(Scene& scene) {
    std::vector<double> angles(3 + below(5));
    for (double& angle : angles) angle = (*this)(0, 2 * std::numbers::pi);
    std::sort(angles.begin(), angles.end());
    const double thin = one_in(3) ? decades(-6, 0) : (*this)(0.2, 1), turn = (*this)(0, 2 * std::numbers::pi);
    scene.size = decades(-3, 0);
    for (const double angle : angles) {
      const double x = scene.size * std::cos(angle), y = scene.size * thin * std::sin(angle);
      scene.corners.push_back({x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn)});
    }
    const PlanePoint shift = scene.corners[0];
    for (PlanePoint& p : scene.corners) p = {p.x - shift.x, p.y - shift.y};
  }

  PlanePoint fixed_point(const Scene& scene, Middle where) {
    const auto& c = scene.corners;
    const std::size_t i = below(c.size());
    const PlanePoint a = c[i], b = c[(i + 1) % c.size()], d = c[(i + 2) % c.size()];
    const double t = (*this)(0, 1), s = (*this)(0, 1 - t), far = scene.size * decades(0, 6);
    switch (where) {
      case Middle::inside: return {a.x + t * (b.x - a.x) + s * (d.x - a.x), a.y + t * (b.y - a.y) + s * (d.y - a.y)};
      case Middle::on_an_edge: return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      case Middle::at_a_corner: return a;
      case Middle::beside: return {a.x + scene.size * (*this)(-3, 3), a.y + scene.size * (*this)(-3, 3)};
      default: return {far * std::cos(6.3 * t), far * std::sin(6.3 * t)};
    }
  }

  /// Slopes of a given condition, their weak direction anywhere.
  void slip(Scene& scene, Middle where, double condition) {
    const double turn = (*this)(0, 6.3), other = (*this)(0, 6.3), size = decades(-2, 2);
    const double c = std::cos(turn), s = std::sin(turn), e = std::cos(other), n = std::sin(other);
    const double weak = condition > 0 ? size / condition : 0;
    PlaneLinear& east = scene.patch.east;
    PlaneLinear& north = scene.patch.north;
    east = {0, size * e * c + weak * n * s, size * e * s - weak * n * c};
    north = {0, size * n * c - weak * e * s, size * n * s + weak * e * c};
    const PlanePoint fixed = fixed_point(scene, where);
    east.value = -east.along(fixed);
    north.value = -north.along(fixed);
    if (where != Middle::anywhere) return;
    east.value = size * scene.size * (*this)(-1, 1);
    north.value = size * scene.size * (*this)(-1, 1) * decades(-16, 0);
  }

  /// Presses on all of the polygon, zero on an edge or not.
  void pressure(Scene& scene) {
    const double slope_x = (*this)(-1, 1), slope_y = (*this)(-1, 1);
    double least = 0;
    for (const PlanePoint& p : scene.corners) least = std::min(least, slope_x * p.x + slope_y * p.y);
    scene.patch.depth = {(one_in(2) ? 1 : 2) * -least, slope_x, slope_y};
    scene.patch.stiffness = {1, 0.3 / scene.size * (*this)(-1, 1), 0.3 / scene.size * (*this)(-1, 1)};
  }

  Scene scene(Middle where, double condition) {
    Scene scene;
    polygon(scene);
    pressure(scene);
    slip(scene, where, condition);
    scene.patch.corners = scene.corners.data();
    scene.patch.count = static_cast<int>(scene.corners.size());
    return scene;
  }
};

constexpr Middle places[] = {Middle::inside, Middle::on_an_edge, Middle::at_a_corner,
                             Middle::beside, Middle::far,        Middle::anywhere};
constexpr int scenes_each = CLATTER_TEST_SLOW_BUILD ? 1 : 2;

void check(double log_condition, double rounding_part, bool one_way = false) {
  for (const Middle where : places) {
    Draw draw(static_cast<unsigned>(100 * log_condition) + static_cast<unsigned>(where));
    for (int i = 0; i < scenes_each; ++i) {
      Scene scene = draw.scene(where, std::pow(10, log_condition));
      scene.patch.corners = scene.corners.data();
      if (one_way) scene.patch.north = {};
      const double across = scene.size * std::hypot(scene.patch.east.x, scene.patch.north.x);
      if (rounding_part > 0) scene.patch.rounding = across * rounding_part;
      const double error = deviation(scene.patch, scene.size) * breadth(scene);
      BOOST_TEST(error <= allowed, "place " << static_cast<int>(where) << ", scene " << i << ", condition 1e"
                                            << log_condition << ": " << error);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_about_any_point_of_no_slip_is_right_to_1e13) {
  for (const double log_condition : {0.0, 0.3, 1.0, 2.0, 4.0, 8.0, 16.0}) check(log_condition, 0);
}

BOOST_AUTO_TEST_CASE(regularised_friction_is_right_to_1e13) {
  for (const double part : {1e-10, 1e-6, 1e-2, 0.1, 1.0})
    for (const double log_condition : {0.0, 2.0, 16.0}) check(log_condition, part);
}

BOOST_AUTO_TEST_CASE(friction_of_slip_in_one_direction_is_right_to_1e13) {
  for (const double part : {0.0, 1e-10, 1e-4, 0.1, 1.0}) check(16, part, true);
}
