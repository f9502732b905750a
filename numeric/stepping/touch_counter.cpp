// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/touch_counter.hpp"

#include <algorithm>
#include <cassert>

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

}  // namespace clatter::numeric
