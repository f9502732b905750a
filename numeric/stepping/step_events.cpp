// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/step_events.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>

#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {

TouchCounter::TouchCounter(const Body& body) : body_(body) {
  const std::size_t vertices =
      body.smooth() ? static_cast<std::size_t>(body.smooth()->ends()) : body.facets().vertices.size();
  const std::vector<Edge> all = edges();
  neighbour_begin_.assign(vertices + 1, 0);
  for (const Edge& edge : all) {
    ++neighbour_begin_[static_cast<std::size_t>(edge.from) + 1];
    neighbours_.push_back(edge.to);
  }
  for (std::size_t v = 0; v < vertices; ++v) neighbour_begin_[v + 1] += neighbour_begin_[v];
  stamps_.assign(vertices, 0);
  before_.assign(vertices, 0);
  flooded_.assign(vertices, 0);
  stack_.reserve(vertices);
  corners_.reserve(body.facets().corners.size());
}

/// All links in both directions, sorted by where they begin.
std::vector<TouchCounter::Edge> TouchCounter::edges() const {
  if (const auto& smooth = body_.smooth()) {
    if (smooth->ends() == 1) return {};
    return {{0, {1, Link::far, -1}}, {1, {0, Link::far, -1}}};
  }
  const Facets& facets = body_.outline();
  std::vector<Edge> edges;
  edges.reserve(2 * facets.corners.size());
  const auto first_corner = [&](int loop) { return facets.corners[facets.loops[loop].begin]; };
  for (std::size_t f = 0; f < facets.facets.size(); ++f) {
    const Facet& facet = facets.facets[f];
    for (int l = facet.begin; l < facet.end; ++l) {
      add_loop(facets.loops[l], edges);
      if (l == facet.begin) continue;  // a hole's outline is joined to the face's
      edges.push_back({first_corner(facet.begin), {first_corner(l), Link::facet, static_cast<int>(f)}});
      edges.push_back({first_corner(l), {first_corner(facet.begin), Link::facet, static_cast<int>(f)}});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
  return edges;
}

void TouchCounter::add_loop(const Loop& loop, std::vector<Edge>& edges) const {
  const Facets& facets = body_.outline();
  const double longest = body_.radius() / 4;
  for (int c = loop.begin; c < loop.end; ++c) {
    const int next = c + 1 < loop.end ? c + 1 : loop.begin;
    const int from = facets.corners[c], to = facets.corners[next];
    const double length = (facets.vertices[from] - facets.vertices[to]).norm();
    // The facet beyond the edge gives the other direction.
    edges.push_back({from, {to, length < longest ? Link::near : Link::far, -1}});
  }
}

void TouchCounter::begin(const Vector3& point) {
  now_ += 2;  // what was below at the end of an earlier contact is not below now
  touches_ = 0;
  any_before_ = touched_a_ = touched_b_ = false;
  if (body_.smooth() && body_.smooth()->ends() == 1) note_end(point.x());
}

bool TouchCounter::all_new(const std::vector<int>& submerged) const {
  return any_before_ && !submerged.empty() && std::none_of(submerged.begin(), submerged.end(), [&](int vertex) {
           const int corner = corner_of(vertex);
           return corner >= 0 && stamp_of(corner) == now_;
         });
}

void TouchCounter::note_end(double x) {
  const double middle = 1e-9 * body_.half_length();
  touched_a_ = touched_a_ || x < -middle;
  touched_b_ = touched_b_ || x > middle;
}

void TouchCounter::update(const std::vector<int>& submerged) {
  const int previous = now_++;
  bool grown = false;
  corners_.clear();
  for (const int facet_vertex : submerged) {
    const int vertex = corner_of(facet_vertex);
    if (vertex < 0) continue;
    corners_.push_back(vertex);
    int& stamp = stamps_[vertex];
    assert(stamp <= now_);
    if (stamp == now_) continue;
    before_[vertex] = stamp;
    if (stamp != previous) {
      grown = true;
      if (!body_.smooth()) note_end(body_.outline().vertices[vertex].x());
      else if (body_.smooth()->ends() == 2) note_end(body_.smooth()->end_centre(vertex).x());
    }
    stamp = now_;
  }
  any_before_ = !submerged.empty();
  if (!grown) return;
  for (const int vertex : corners_) {
    if (flooded_[vertex] != now_ && !joins_old(vertex)) ++touches_;
  }
}

/// Below the ground now, and not at the update before.
bool TouchCounter::is_new(int vertex) const { return stamp_of(vertex) == now_ && before_[vertex] != now_ - 1; }

bool TouchCounter::connects(int from, const Neighbour& to) const {
  if (stamp_of(to.vertex) != now_) return false;
  if (to.link == Link::near) return true;
  if (!is_new(from) || !is_new(to.vertex)) return false;
  if (to.link == Link::far) return true;
  const Facets& facets = body_.outline();
  const Facet& facet = facets.facets[to.facet];
  const int begin = facets.loops[facet.begin].begin;
  const int end = facets.loops[facet.end - 1].end;
  return std::all_of(facets.corners.begin() + begin, facets.corners.begin() + end,
                     [&](int vertex) { return stamp_of(vertex) == now_; });
}

/// Visits the connected set of a vertex; tells whether part of it was below before.
bool TouchCounter::joins_old(int seed) {
  bool joins = false;
  stack_.clear();
  stack_.push_back(seed);
  flooded_[seed] = now_;
  while (!stack_.empty()) {
    const int vertex = stack_.back();
    stack_.pop_back();
    joins = joins || !is_new(vertex);
    const auto v = static_cast<std::size_t>(vertex);
    for (int i = neighbour_begin_[v]; i < neighbour_begin_[v + 1]; ++i) {
      const Neighbour& next = neighbours_[i];
      int& flooded = flooded_[next.vertex];
      if (flooded == now_ || !connects(vertex, next)) continue;
      flooded = now_;
      stack_.push_back(next.vertex);
    }
  }
  return joins;
}

namespace {

constexpr double resolved_part = 1e-3;  ///< of the tolerance: an event's time over the contact's

struct Depth {
  double value, rate;  ///< [m], [m/s]
};

/// The cubic over a step, 0 at its beginning.
struct StepCubic {
  double slope, end_slope;  ///< rates times the length of the step
  double rise;              ///< value at the end
};

/// Where in the step, from 0 to 1, the cubic has a maximum: p′(s) = slope + 2 b s + 3 a s² falls through 0 there once;
/// 0 where it has none inside.
double place_of_top(const StepCubic& p) {
  if (!(p.slope >= 0) || !(p.end_slope <= 0) || p.slope == p.end_slope) return 0;
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  const double root = std::sqrt(std::max(b * b - 3 * a * p.slope, 0.0));
  const double s = b <= 0 ? p.slope / (root - b) : (-b - root) / (3 * a);
  return s > 0 && s < 1 ? s : 0;
}

/// What the cubic rises to at the part s of the step.
double rise_to(const StepCubic& p, double s) {
  const double a = p.slope + p.end_slope - 2 * p.rise, b = 3 * p.rise - 2 * p.slope - p.end_slope;
  return s * (p.slope + s * (b + s * a));
}

/// Depth of the deepest vertex; the load looks at no facet above the ground.
Depth deepest_point(const ContactSystem& system, const ContactInstant& at) {
  const ContactLoad& load = at.diagnosis.load;
  if (load.deepest > 0) return {load.deepest, load.deepest_rate};
  const MotionState motion = system.motion(at.state);
  const Vector3 lowest = lowest_vertex(system.body(), motion);
  return {-system.height(lowest, at.state), -point_velocity(motion, lowest).z()};
}

}  // namespace

double EventLocator::fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now,
                          double h, ContactInstant& at_root) {
  const double at_start = indicator(now), at_end = indicator(at_root);
  if (!(at_start > 0 && at_end <= 0)) return h;
  double shortest = h;  // with the indicator at or below 0; at_root has its end
  const auto value = [&](double length) {
    if (length <= 0) return at_start;
    if (!step_.take(now, length, trial_)) return at_end;
    const double found = indicator(trial_);
    if (found <= 0 && length < shortest) {
      shortest = length;
      at_root = trial_;
    }
    return std::isfinite(found) ? found : at_end;
  };
  const double resolution = std::max(1e-14, resolved_part * tolerance_) * (scales_.time + now.time);
  std::uintmax_t iterations = 50;
  const double high =
      boost::math::tools::toms748_solve(
          value, 0.0, h, at_start, at_end, [&](double a, double b) { return b - a <= resolution; }, iterations)
          .second;
  assert(high > 0 && high <= h);
  if (high == shortest || !step_.take(now, high, trial_)) return shortest;
  at_root = trial_;
  return high;
}

double EventLocator::fade(double low, double high, const ContactInstant& now, double h, ContactInstant& at_end) {
  ContactInstant strong = now;
  double end = h;  // where the force is below `low`
  const double aim = std::sqrt(low * high);
  for (int i = 0; i < 100 && strong.diagnosis.load.force > high; ++i) {
    const double begin = strong.time - now.time, rate = strong.diagnosis.force_rate;
    const double newton = rate < 0 ? begin - (strong.diagnosis.load.force - aim) / rate : begin;
    const double length = newton > begin && newton < end ? newton : (begin + end) / 2;
    if (!(length > begin && length < end) || !step_.take(now, length, trial_)) break;
    if (trial_.diagnosis.load.force > low) {
      strong = trial_;
    } else {
      end = length;
    }
  }
  if (!(strong.time > now.time)) return h;
  at_end = strong;
  return strong.time - now.time;
}

double EventLocator::lift_off(const ContactInstant& now, double h, ContactInstant& at_root) {
  const double resolution = 1e-13 * scales_.depth;
  double low = 0, high = h, length = h, reached = h;
  for (int i = 0; i < 100; ++i) {
    const auto [depth, rate] = deepest_point(step_.system(), at_root);
    if (std::fabs(depth) <= resolution || high - low <= 1e-14 * (scales_.time + now.time)) break;
    (depth > 0 ? low : high) = length;
    const double newton = rate < 0 ? length - depth / rate : low;
    length = newton > low && newton < high ? newton : (low + high) / 2;
    if (!step_.take(now, length, trial_)) break;
    at_root = trial_;
    reached = length;
  }
  return reached;
}

void ForcePeak::note(const ContactInstant& at) {
  if (!(at.diagnosis.load.force > force_)) return;
  force_ = at.diagnosis.load.force;
  time_ = at.time;
}

const ContactInstant* ForcePeak::look(const ContactInstant& now, const ContactInstant& next) {
  note(next);
  const double h = next.time - now.time;
  const StepCubic cubic{h * now.diagnosis.force_rate, h * next.diagnosis.force_rate,
                        next.diagnosis.load.force - now.diagnosis.load.force};
  const double s = place_of_top(cubic);
  if (s == 0) return nullptr;
  const double top = now.diagnosis.load.force + rise_to(cubic, s);
  if (!(top > 0.9 * force_) || !step_.take(now, s * h, trial_)) return nullptr;
  note(trial_);
  inside_ = trial_;
  const double at_trial = h * trial_.diagnosis.force_rate;
  const double other_s = at_trial > 0 ? 1 : 0, other = at_trial > 0 ? cubic.end_slope : cubic.slope;
  const double better = s - at_trial * (other_s - s) / (other - at_trial);
  if (better > 0 && better < 1 && step_.take(now, better * h, trial_)) note(trial_);
  if (trial_.time == time_) inside_ = trial_;
  return inside_.time == time_ ? &inside_ : nullptr;
}

void DeepestPoint::look(const ContactInstant& now, const ContactInstant& next) {
  const ContactLoad &from = now.diagnosis.load, &to = next.diagnosis.load;
  depth_ = std::max(depth_, to.deepest);
  const double h = next.time - now.time, begin = std::max(from.deepest, 0.0);
  const StepCubic cubic{h * from.deepest_rate, h * to.deepest_rate, to.deepest - begin};
  const double s = place_of_top(cubic);
  if (s == 0 || !(begin + rise_to(cubic, s) > 0.9 * depth_) || !step_.take(now, s * h, trial_)) return;
  const double depth = trial_.diagnosis.load.deepest, slope = h * trial_.diagnosis.load.deepest_rate;
  // The rate falls along the line from here to the end of the step that lies beyond the maximum.
  const double fall = slope > 0 ? (slope - cubic.end_slope) / (1 - s) : (cubic.slope - slope) / s;
  depth_ = std::max(depth_, fall > 0 ? depth + slope * slope / (2 * fall) : depth);
}

}  // namespace clatter::numeric
