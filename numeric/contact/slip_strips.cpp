// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/slip_strips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/contact/gauss_rules.hpp"

namespace clatter::numeric {
namespace {

constexpr double least_ellipse = 2.6;   ///< ρ from which Gauss's rule is taken
constexpr double least_part = 2e-8;     ///< of the size: a lower part errs by less than its square
constexpr double flat_part = 1e-15;     ///< of the size: the height of an edge that is rounding
constexpr double no_slip_part = 1e-15;  ///< of the largest slip: below it, rounding

/// Sums over the strips between the polygon's edges and a line across the steepest direction of the slip: along that
/// direction in closed form, across it by Gauss's rule.
class Strips {
 public:
  Strips(const SlipPatch& patch, const SlipSurvey& s) : patch_(patch), size_(s.size) {
    const PlaneLinear &e = patch.east, &n = patch.north;
    const double xx = e.x * e.x + n.x * n.x, yy = e.y * e.y + n.y * n.y, xy = e.x * e.y + n.x * n.y;
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    steep_ = {std::cos(angle), std::sin(angle)};
    rise_ = {e.along(steep_), n.along(steep_)};
    const PlanePoint across{-steep_.y, steep_.x};
    drift_ = {e.along(across), n.along(across)};
    const double speed = std::sqrt(rise_.square());
    const double sideways =
        std::fabs(rise_.cross(s.slip)) / speed + std::fabs(rise_.cross(drift_)) / speed * 2 * s.size;
    // The line on which the slip has no part along its steep change, or the nearest one through the polygon.
    const double middle = turned(s.middle).along, least = middle - rise_.dot(s.slip) / rise_.square();
    reference_ = std::clamp(least, middle - s.size, middle + s.size);
    aligned_ = std::hypot(sideways, patch.rounding) <= no_slip_part * s.fastest;
  }

  SlipIntegrals sum() {
    Corner from = turned(patch_.corners[patch_.count - 1]);
    for (int i = 0; i < patch_.count; ++i) {
      const Corner to = turned(patch_.corners[i]);
      add_edge(from, to);
      from = to;
    }
    return sum_;
  }

 private:
  /// A corner in the coordinates along and across the steep direction.
  struct Corner {
    double along, across;
  };
  /// A side of a strip: along = at + slope × (across − from).
  struct Side {
    double from, at, slope;
    [[nodiscard]] double along(double across) const { return at + slope * (across - from); }
  };
  /// From the reference line to an edge.
  struct Strip {
    Side left, right;
    double sign;
  };

  [[nodiscard]] Corner turned(const PlanePoint& p) const {
    return {steep_.x * p.x + steep_.y * p.y, steep_.x * p.y - steep_.y * p.x};
  }
  [[nodiscard]] PlanePoint back(double along, double across) const {
    return {steep_.x * along - steep_.y * across, steep_.y * along + steep_.x * across};
  }
  [[nodiscard]] SlipVector slip(double along, double across) const { return slip_at(patch_, back(along, across)); }

  /// The signed area between the reference line and the edge.
  void add_edge(const Corner& a, const Corner& b) {
    if (!(std::fabs(a.across - b.across) > flat_part * size_)) return;
    const Side edge{a.across, a.along, (b.along - a.along) / (b.across - a.across)};
    const double low = std::min(a.across, b.across), high = std::max(a.across, b.across);
    add_strip({{a.across, reference_, 0}, edge, b.across > a.across ? 1.0 : -1.0}, low, high);
  }

  /// Cuts where a side crosses the line on which the slip has no part along its steep change, and where it has no part
  /// across.
  void add_strip(const Strip& strip, double low, double high) {
    double cuts[5] = {low, high, low, low, low};
    int count = 2;
    const auto cut_at_zero = [&](double at_low, double at_high) {
      if ((at_low > 0) == (at_high > 0)) return;
      const double cut = low + (high - low) * (at_low / (at_low - at_high));
      if (cut > low && cut < high) cuts[count++] = cut;
    };
    for (const Side* s : {&strip.left, &strip.right}) {
      cut_at_zero(rise_.dot(slip(s->along(low), low)), rise_.dot(slip(s->along(high), high)));
    }
    cut_at_zero(rise_.cross(slip(strip.left.along(low), low)), rise_.cross(slip(strip.left.along(high), high)));
    for (int i = 1; i < count; ++i) {  // std::sort of so few makes g++ 12 warn
      for (int j = i; j > 0 && cuts[j] < cuts[j - 1]; --j) std::swap(cuts[j], cuts[j - 1]);
    }
    for (int i = 1; i < count; ++i) add_part(strip, cuts[i - 1], cuts[i]);
  }

  void add_part(const Strip& strip, double low, double high) {
    if (!(high > low)) return;
    const double ellipse = aligned_ ? std::numeric_limits<double>::infinity() : part_ellipse(strip, low, high);
    if (ellipse < least_ellipse && high - low > least_part * size_) {
      const double middle = (low + high) / 2;
      add_part(strip, low, middle);
      add_part(strip, middle, high);
      return;
    }
    const double half = (high - low) / 2, middle = (high + low) / 2;
    for (const GaussNode& node : gauss_rule(gauss_order(ellipse))) {
      add_line(strip, middle + half * node.at, half * node.weight);
    }
  }

  /// Of the function across: its singularities are where the slip and v_r vanish together at an end, or on the way
  /// between ends on different sides of the least slip.
  [[nodiscard]] double part_ellipse(const Strip& strip, double low, double high) const {
    const double middle = (low + high) / 2, left = strip.left.along(middle), right = strip.right.along(middle);
    const double at_left = rise_.dot(slip(left, middle)), at_right = rise_.dot(slip(right, middle));
    const double half = (high - low) / 2;
    const auto along_side = [&](const Side& s) {
      const SlipVector change{half * (drift_.east + s.slope * rise_.east),
                              half * (drift_.north + s.slope * rise_.north)};
      return segment_ellipse(slip(s.along(middle), middle), change, patch_.rounding);
    };
    double ellipse = std::min(along_side(strip.left), along_side(strip.right));
    if ((at_left > 0) != (at_right > 0)) {
      const double speed = std::sqrt(rise_.square());
      const SlipVector sideways{rise_.cross(slip(left, middle)) / speed, 0};
      ellipse = std::min(ellipse, segment_ellipse(sideways, {half * rise_.cross(drift_) / speed, 0}, patch_.rounding));
    }
    return ellipse;
  }

  void add_line(const Strip& strip, double across, double weight) {
    const double left = strip.left.along(across), right = strip.right.along(across);
    SlipSegment segment;
    segment.middle = back((left + right) / 2, across);
    segment.half = {steep_.x * (right - left) / 2, steep_.y * (right - left) / 2};
    segment.slip = slip_at(patch_, segment.middle);
    segment.depth_at_middle = patch_.depth.at(segment.middle);
    segment.stiffness_at_middle = patch_.stiffness.at(segment.middle);
    sum_.add(along_segment(patch_, segment), strip.sign * weight * (right - left) / 2);
  }

  const SlipPatch& patch_;
  double size_;              ///< of the polygon [m]
  PlanePoint steep_;         ///< unit vector along which the slip changes most
  SlipVector rise_, drift_;  ///< its slopes along that and across
  double reference_ = 0;     ///< coordinate along of the strips' common side [m]
  bool aligned_ = false;     ///< all slip is along `rise_`, to rounding
  SlipIntegrals sum_;
};

}  // namespace

SlipIntegrals add_up_strips(const SlipPatch& patch, const SlipSurvey& survey) { return Strips(patch, survey).sum(); }

}  // namespace clatter::numeric
