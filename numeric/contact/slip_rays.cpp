// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_rays.hpp"

#include <cmath>

#include "numeric/contact/gauss_rules.hpp"

namespace clatter::numeric {
namespace {

constexpr double least_ellipse_along_rays = 2.2;  ///< ρ from which Gauss's rule is taken
constexpr double least_part_of_ray = 1e-15;       ///< of the segment: rounding
constexpr double least_ratio = 0.25;              ///< (W/v_r)² from which the closed forms do not cancel
constexpr int slow_order = 12;                    ///< of Gauss's rule below it, right to 1e-15

/// ∫_0^1 λⁿ/√(λ² W² + v_r²) dλ, n from 2 to 5.
struct RayIntegrals {
  double by_force[3] = {0, 0, 0};   ///< n from 2 to 4
  double by_moment[3] = {0, 0, 0};  ///< n from 3 to 5
};

RayIntegrals closed_ray(double square, double rounding) {
  const double slow = rounding * rounding, end = std::sqrt(square + slow), speed = std::sqrt(square), over = 1 / square;
  const double j0 = std::log((speed + end) / rounding) / speed, j1 = 1 / (end + rounding);
  const double j2 = (end - slow * j0) * over / 2, j3 = (end - 2 * slow * j1) * over / 3;
  const double j4 = (end - 3 * slow * j2) * over / 4, j5 = (end - 4 * slow * j3) * over / 5;
  return {{j2, j3, j4}, {j3, j4, j5}};
}

RayIntegrals slow_ray(double square, double rounding) {
  const double slow = rounding * rounding;
  double j[4] = {0, 0, 0, 0};
  for (const GaussNode& node : gauss_rule(slow_order)) {
    const double part = (1 + node.at) / 2, part_square = part * part;
    double weight = node.weight / 2 * part_square / std::sqrt(part_square * square + slow);
    for (double& integral : j) {
      integral += weight;
      weight *= part;
    }
  }
  return {{j[0], j[1], j[2]}, {j[1], j[2], j[3]}};
}

/// Equation (1) for one segment.
class Rays {
 public:
  Rays(const SlipPatch& patch, const SlipSegment& segment)
      : g_(segment),
        rounding_(patch.rounding), change_{patch.east.along(segment.half), patch.north.along(segment.half)},
        depth_change_(patch.depth.along(segment.half)), stiffness_change_(patch.stiffness.along(segment.half)) {}

  SlipIntegrals sum() {
    add_part(-1, 1);
    return sum_;
  }

 private:
  void add_part(double low, double high) {
    const double middle = (low + high) / 2, half = (high - low) / 2;
    const double ellipse = segment_ellipse(slip(middle), {half * change_.east, half * change_.north}, rounding_);
    if (ellipse < least_ellipse_along_rays && half > least_part_of_ray) {
      add_part(low, middle);
      add_part(middle, high);
      return;
    }
    for (const GaussNode& node : gauss_rule(gauss_order(ellipse))) add_ray(middle + half * node.at, half * node.weight);
  }

  void add_ray(double at, double weight) {
    const SlipVector v = slip(at);
    const double square = v.square();
    const RayIntegrals ray =
        square > least_ratio * rounding_ * rounding_ ? closed_ray(square, rounding_) : slow_ray(square, rounding_);
    const double depth = g_.depth_at_middle + at * depth_change_;
    const double stiffness = g_.stiffness_at_middle + at * stiffness_change_;
    const double constant = g_.depth * g_.stiffness, linear = g_.depth * stiffness + g_.stiffness * depth;
    const auto along_ray = [&](const double(&n)[3]) {
      return weight * (constant * n[0] + linear * n[1] + depth * stiffness * n[2]);
    };
    const double force = along_ray(ray.by_force), moment = along_ray(ray.by_moment);
    const double x = moment * (g_.middle.x + at * g_.half.x), y = moment * (g_.middle.y + at * g_.half.y);
    sum_.add({v.east * force, v.north * force, v.east * x, v.east * y, v.north * x, v.north * y}, 1);
  }

  [[nodiscard]] SlipVector slip(double at) const {
    return {g_.slip.east + at * change_.east, g_.slip.north + at * change_.north};
  }

  const SlipSegment& g_;
  double rounding_;
  SlipVector change_;
  double depth_change_, stiffness_change_;
  SlipIntegrals sum_;
};

}  // namespace

SlipIntegrals along_rays(const SlipPatch& patch, const SlipSegment& segment) { return Rays(patch, segment).sum(); }

}  // namespace clatter::numeric
