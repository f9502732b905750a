// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/simultaneous.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "analytic/space/flight/body.hpp"
#include "analytic/space/landing/level_rim.hpp"
#include "analytic/space/landing/striking_body.hpp"

namespace clatter::analytic::space {

namespace {

/// Corners nearer to a line than this part of the extent lie on the line.
constexpr double flat = 1e-12;

/// Indices of the points on the corners of the convex hull, counter-clockwise; two if all lie on one line to rounding
/// (the outermost ones), one if all coincide.
std::vector<int> convex_hull(const std::vector<Vector2>& points) {
  const auto at = [&](int i) -> const Vector2& { return points[i]; };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(
      order, [&](int i, int j) { return at(i).x() < at(j).x() || (at(i).x() == at(j).x() && at(i).y() < at(j).y()); });
  double extent = 0;
  for (const Vector2& p : points) extent = std::fmax(extent, (p - points.front()).norm());
  if (!(extent > 0)) return points.empty() ? order : std::vector<int>{0};
  std::vector<int> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto i = begin; i != end; ++i) {
      const auto turns_right = [&] {
        const Vector2 side = at(hull.back()) - at(hull[hull.size() - 2]);
        return !(cross(side, at(*i) - at(hull.back())) > flat * extent * side.norm());
      };
      while (hull.size() >= base + 2 && turns_right()) hull.pop_back();
      hull.push_back(*i);
    }
    hull.pop_back();
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return hull;
}

/// A body with its touching corners.
class StrikingGroup {
 public:
  StrikingGroup(const Body& body, const State& before, std::span<const Corner> touching, const ImpactLaw& law)
      : struck_(body, before, law) {
    for (const Corner& corner : touching) {
      points_.push_back({.index = corner.index, .place = corner.place, .arm = struck_.arm(corner.place)});
      struck_.know_approach(-velocity(points_.back()).z());
    }
  }

  struct Point {
    int index;
    Vector3 place, arm;
  };
  using Points = std::vector<Point>;

  [[nodiscard]] const Points& points() const { return points_; }
  [[nodiscard]] Vector3 velocity(const Point& p) const { return struck_.velocity(p.arm); }
  [[nodiscard]] bool approaches(const Point& p) const { return struck_.approaches(p.arm); }
  [[nodiscard]] Points approaching() const {
    Points some;
    std::ranges::copy_if(points_, std::back_inserter(some), [&](const Point& p) { return approaches(p); });
    return some;
  }
  /// Those that approach as fast as the fastest, to rounding.
  [[nodiscard]] Points fastest() const {
    const Points some = approaching();
    const auto slower = [&](const Point& p, const Point& q) { return velocity(p).z() > velocity(q).z(); };
    const auto fastest = std::ranges::max_element(some, slower);
    Points equal;
    for (const Point& p : some) {
      const double behind = velocity(p).z() - velocity(*fastest).z();
      if (behind <= struck_.rounding(p.arm) + struck_.rounding(fastest->arm)) equal.push_back(p);
    }
    return equal;
  }

  /// Strikes with these points as a whole; false, and nothing done, if pushes alone cannot do it.
  bool strike(const Points& group) {
    if (group.empty()) return false;
    std::vector<Vector2> feet;
    for (const Point& p : group) feet.push_back(p.arm.head<2>());
    const std::vector<int> hull = convex_hull(feet);
    const auto corner = [&](int i) -> const Point& { return group[hull[i]]; };
    if (hull.size() == 1) return strike_corner(corner(0)), true;
    return hull.size() == 2 ? strike_edge(corner(0), corner(1), group) : strike_face(group, hull);
  }

  /// Strikes with all that approach, unless something then approaches that friction has not tilted.
  bool strike_as_a_whole() {
    StrikingGroup group = *this;
    group.tilted_ = false;
    const bool struck = group.strike(approaching());
    if (group.is_lost_) struck_.leave_open();
    if (!struck || !(group.tilted_ || group.approaching().empty())) return false;
    struck_.take(group.struck_);
    return true;
  }
  /// The corner that strikes alone where these cannot together.

  /// The end of an edge that is nearest to its pressure point; which corner of a face it is, the law leaves open.
  [[nodiscard]] const Point& first_of(const Points& group) {
    if (group.size() == 2) {
      const double point = struck_.edge_contact(group[0].place, group[1].place).pressure_point();
      if (std::fabs(point) > 1) return group[point > 0 ? 1 : 0];
    }
    if (group.size() > 1 && struck_.law().rubs()) struck_.leave_open();
    return group.front();
  }

  void strike_corner(const Point& p) { struck_.strike_at(p.place, {p.index}); }
  [[nodiscard]] bool converges(StrikeSeries& series) { return series.converges(struck_); }
  [[nodiscard]] GroupImpact result() const { return struck_.result(); }
  [[nodiscard]] std::size_t strikes() const { return struck_.strikes(); }

 private:
  static std::vector<int> indices_of(const Points& group) {
    std::vector<int> indices;
    for (const Point& p : group) indices.push_back(p.index);
    return indices;
  }

  /// The edge strikes with its pressure point as a corner, or with friction all along it.
  bool strike_edge(const Point& first, const Point& second, const Points& group) {
    const EdgeContact edge = struck_.edge_contact(first.place, second.place);
    if (struck_.law().rubs() && !edge.strikes_as_corner()) {
      const auto struck = struck_.strike_along(edge, first.place, second.place, indices_of(group));
      tilted_ = struck && struck->tilts;
      is_lost_ = !struck && std::fabs(edge.pressure_point()) <= 1;
      return struck.has_value();
    }
    const double point = edge.pressure_point();
    if (!(std::fabs(point) <= 1)) return false;
    StrikingBody struck = struck_;
    struck.strike_at(((1 - point) * first.place + (1 + point) * second.place) / 2, indices_of(group));
    if (struck.approaches(first.arm) || struck.approaches(second.arm)) return false;
    struck_.take(struck);
    return true;
  }

  bool strike_face(const Points& group, const std::vector<int>& hull) {
    double depth = 0;
    for (const Point& p : group) depth -= p.arm.z() / static_cast<double>(group.size());
    ContactArea area;
    for (const int i : hull) area.corners.emplace_back(group[i].arm.head<2>());
    const auto face = struck_.face_rebound(depth, area);
    is_lost_ = face && face->is_lost;
    if (!face || is_lost_) return false;
    struck_.push(*face, indices_of(group));
    tilted_ = face->tilts;
    return true;
  }

  StrikingBody struck_;
  Points points_;
  bool tilted_ = false;
  bool is_lost_ = false;  ///< friction of what has a pressure without it could not be followed
};

}  // namespace

std::optional<GroupImpact> rebound_as_a_whole(const Body& body, const State& before, std::span<const Corner> touching,
                                              const ImpactLaw& law) {
  if (const Corner* rim = level_rim(touching)) return LevelRim(body, before, *rim, law).rebound_as_a_whole();
  StrikingGroup group(body, before, touching, law);
  if (!group.strike_as_a_whole()) return {};
  GroupImpact result = group.result();
  result.is_whole = !result.tilts;
  return result;
}

GroupImpact strike_together(const Body& body, const State& before, std::span<const Corner> touching,
                            const ImpactLaw& law) {
  if (const Corner* rim = level_rim(touching)) return LevelRim(body, before, *rim, law).strike();
  StrikingGroup group(body, before, touching, law);
  StrikeSeries series;
  while (group.strike_as_a_whole()) check_number_of_strikes(group.strikes());
  const bool is_whole = group.strikes() == 1 && group.approaching().empty();
  for (auto fastest = group.fastest(); !fastest.empty(); fastest = group.fastest()) {
    check_number_of_strikes(group.strikes());
    if (group.converges(series)) continue;
    if (!group.strike(fastest)) group.strike_corner(group.first_of(fastest));
  }
  GroupImpact result = group.result();
  result.is_whole = is_whole && !result.tilts;
  return result;
}

GroupImpact strike_beside(const Body& body, const State& before, std::span<const Corner> arriving,
                          std::span<const Corner> held, const ImpactLaw& law) {
  GroupImpact all = strike_together(body, before, arriving, law);
  State between = before;
  between.velocity = all.velocity_after;
  between.angular_velocity = all.angular_velocity_after;
  std::vector<Corner> touching(arriving.begin(), arriving.end());
  touching.insert(touching.end(), held.begin(), held.end());
  const GroupImpact then = strike_together(body, between, touching, law);
  all.is_whole = false;
  all.tilts = all.tilts || then.tilts;
  all.is_open = all.is_open || then.is_open;
  all.path_error = std::fmax(all.path_error, then.path_error);
  if (then.order.empty()) return all;
  all.impulse += then.impulse;
  all.moment += then.moment;
  all.velocity_after = then.velocity_after;
  all.angular_velocity_after = then.angular_velocity_after;
  all.energy_loss += then.energy_loss;
  all.order.insert(all.order.end(), then.order.begin(), then.order.end());
  return all;
}

}  // namespace clatter::analytic::space
