// SPDX-License-Identifier: GPL-3.0-or-later
// Which parts of the body touch the ground, and how many times a new one came down.
#pragma once

#include <vector>

#include "numeric/body/body.hpp"

namespace clatter::numeric {

/// A new place is a set of the outline's vertices that go below the ground together, apart from all that were below
/// before and from one another's: not connected, over vertices below the ground, by edges shorter than a quarter of the
/// body's radius. (Along a longer edge the contact spreads as well, but what arrives at its far end is another blow.)
/// Between two updates vertices go below at once; longer edges, and facets that then lie below wholly, connect them
/// too: a face or an edge that lands flat is one place, two feet are two.  Vertices within a face or a straight edge do
/// not count, so that nothing depends on how a face is meshed.  The ends of a smooth shape count as the vertices of a
/// long edge.  No allocation after construction.
class TouchCounter {
 public:
  explicit TouchCounter(const Body& body);

  /// At a touch-down at `point` (body frame), which says what end it is of a shape that has but one.
  void begin(const Vector3& point);
  /// Takes the vertices that are below the ground now, repetitions allowed.
  void update(const std::vector<int>& submerged);
  /// Whether none of `submerged` was below the ground at the last update, though others were.
  [[nodiscard]] bool all_new(const std::vector<int>& submerged) const;

  [[nodiscard]] int touches() const { return touches_; }
  [[nodiscard]] bool touched_a() const { return touched_a_; }  ///< a vertex with x′ < 0
  [[nodiscard]] bool touched_b() const { return touched_b_; }  ///< a vertex with x′ > 0

 private:
  enum class Link { near, far, facet };
  struct Neighbour {
    int vertex;
    Link link;
    int facet;  ///< that must lie below wholly; of Link::facet
  };
  struct Edge {
    int from;
    Neighbour to;
  };

  [[nodiscard]] std::vector<Edge> edges() const;
  void add_loop(const Loop& loop, std::vector<Edge>& edges) const;
  /// Number of a vertex of the facets; −1: it does not count.
  [[nodiscard]] int corner_of(int vertex) const { return body_.smooth() ? vertex : body_.outline_vertex(vertex); }
  [[nodiscard]] int stamp_of(int vertex) const { return stamps_[vertex]; }
  [[nodiscard]] bool is_new(int vertex) const;
  [[nodiscard]] bool connects(int from, const Neighbour& to) const;
  [[nodiscard]] bool joins_old(int seed);
  void note_end(double x);

  const Body& body_;
  std::vector<int> neighbour_begin_;
  std::vector<Neighbour> neighbours_;
  std::vector<int> stamps_;   ///< update at which a vertex was last below the ground
  std::vector<int> flooded_;  ///< update at which it was last flooded
  std::vector<int> before_;   ///< update before the stamp at which it was below, for continuity
  std::vector<int> stack_;
  std::vector<int> corners_;  ///< of the outline, below the ground now
  int now_ = 2;
  int touches_ = 0;
  bool any_before_ = false;
  bool touched_a_ = false, touched_b_ = false;
};

}  // namespace clatter::numeric
