#include "numeric/stepping/touch_counter.hpp"

#include <algorithm>
#include <utility>

namespace clatter::numeric {

TouchCounter::TouchCounter(const Body& body) : body_(body) {
  const Facets& facets = body.facets();
  const std::size_t vertices = facets.vertices.size();
  std::vector<std::pair<int, int>> edges;
  edges.reserve(2 * facets.corners.size());
  const double longest = body.radius() / 4;
  for (const Loop& loop : facets.loops) {
    for (int c = loop.begin; c < loop.end; ++c) {
      const int next = c + 1 < loop.end ? c + 1 : loop.begin;
      const int from = facets.corners[static_cast<std::size_t>(c)], to = facets.corners[static_cast<std::size_t>(next)];
      const double length = (facets.vertices[static_cast<std::size_t>(from)] -
                             facets.vertices[static_cast<std::size_t>(to)]).norm();
      if (!(length < longest)) continue;
      edges.emplace_back(from, to);
      edges.emplace_back(to, from);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  neighbour_begin_.assign(vertices + 1, 0);
  for (const auto& [from, to] : edges) {
    ++neighbour_begin_[static_cast<std::size_t>(from) + 1];
    neighbours_.push_back(to);
  }
  for (std::size_t v = 0; v < vertices; ++v) neighbour_begin_[v + 1] += neighbour_begin_[v];
  stamps_.assign(vertices, 0);
  before_.assign(vertices, 0);
  flooded_.assign(vertices, 0);
  stack_.reserve(vertices);
}

void TouchCounter::begin() {
  now_ += 2;  // what was below at the end of an earlier contact is not below now
  touches_ = 0;
  any_before_ = touched_a_ = touched_b_ = false;
}

bool TouchCounter::all_new(const std::vector<int>& submerged) const {
  return any_before_ && !submerged.empty() &&
         std::none_of(submerged.begin(), submerged.end(), [&](int vertex) { return stamp_of(vertex) == now_; });
}

void TouchCounter::note_end(int vertex) {
  const double x = body_.facets().vertices[static_cast<std::size_t>(vertex)].x();
  const double middle = 1e-9 * body_.half_length();
  touched_a_ = touched_a_ || x < -middle;
  touched_b_ = touched_b_ || x > middle;
}

void TouchCounter::update(const std::vector<int>& submerged) {
  const int previous = now_++;
  bool grown = false;
  for (const int vertex : submerged) {
    int& stamp = stamps_[static_cast<std::size_t>(vertex)];
    if (stamp == now_) continue;
    before_[static_cast<std::size_t>(vertex)] = stamp;
    if (stamp != previous) {
      grown = true;
      note_end(vertex);
    }
    stamp = now_;
  }
  any_before_ = !submerged.empty();
  if (!grown) return;
  bool new_place = false;
  for (const int vertex : submerged) {
    if (flooded_[static_cast<std::size_t>(vertex)] != now_ && !joins_old(vertex)) new_place = true;
  }
  if (new_place) ++touches_;
}

/// Visits the connected set of a vertex; tells whether part of it was below before.
bool TouchCounter::joins_old(int seed) {
  bool joins = false;
  stack_.clear();
  stack_.push_back(seed);
  flooded_[static_cast<std::size_t>(seed)] = now_;
  while (!stack_.empty()) {
    const auto vertex = static_cast<std::size_t>(stack_.back());
    stack_.pop_back();
    joins = joins || before_[vertex] == now_ - 1;
    for (int i = neighbour_begin_[vertex]; i < neighbour_begin_[vertex + 1]; ++i) {
      const auto next = static_cast<std::size_t>(neighbours_[static_cast<std::size_t>(i)]);
      if (stamps_[next] != now_ || flooded_[next] == now_) continue;
      flooded_[next] = now_;
      stack_.push_back(static_cast<int>(next));
    }
  }
  return joins;
}

}  // namespace clatter::numeric
