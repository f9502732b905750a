// SPDX-License-Identifier: GPL-3.0-or-later
// Where an event, or the largest force, lies within a step of a contact.
#pragma once

#include <functional>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/stepping/contact_result.hpp"
#include "numeric/stepping/stepper.hpp"

namespace clatter::numeric {

// Which parts of the body touch the ground, and how many times a new one came down.

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

/// Events are roots of the numerical solution: the step is repeated with the length that ends on the event.
class EventLocator {
 public:
  explicit EventLocator(ContactStep& step) : step_(step) {}

  /// Events within steps of this tolerance.
  void begin(const ContactScales& scales, double tolerance) {
    scales_ = scales;
    tolerance_ = tolerance;
  }

  /// Length of the step from `now` at whose end `indicator` has just fallen to 0 [s].  `at_root`, given at the end of
  /// the whole step of length h, gets that instant; both stay where the indicator does not fall through 0.
  double fall(const std::function<double(const ContactInstant&)>& indicator, const ContactInstant& now, double h,
              ContactInstant& at_root);

  /// Length of the step from `now`, where F_n > high, at whose end F_n is from `low` to `high` [N]; `at_end` gets that
  /// instant.  Both stay where the search finds none.  For a step at whose end F_n is less than `low`.
  double fade(double low, double high, const ContactInstant& now, double h, ContactInstant& at_end);

  /// Length of the step from `now` at whose end the deepest vertex is just out of the ground, by Newton's method in
  /// a bracket; `at_root` as for fall().
  double lift_off(const ContactInstant& now, double h, ContactInstant& at_root);

 private:
  ContactStep& step_;
  ContactScales scales_;
  double tolerance_ = 0;
  ContactInstant trial_;
};

class ForcePeak {
 public:
  explicit ForcePeak(ContactStep& step) : step_(step) {}

  void begin(double force = 0) {
    force_ = force;
    time_ = 0;
  }

  /// Looks for a larger force in the accepted step from `now` to `next`: at its end, and at a maximum of F_n inside it.
  /// The peak of the cubic through the forces and their rates at both ends gives its time, which a secant of the rate
  /// then mends once; the force is that of the numerical solution there, and its error of second order in the time's.
  /// @return the instant of the largest force so far if that lies inside the step, else null.
  [[nodiscard]] const ContactInstant* look(const ContactInstant& now, const ContactInstant& next);

  [[nodiscard]] double force() const { return force_; }  ///< largest F_n so far [N]
  [[nodiscard]] double time() const { return time_; }    ///< of that, after touch-down [s]

 private:
  void note(const ContactInstant& at);

  ContactStep& step_;
  ContactInstant trial_, inside_;
  double force_ = 0, time_ = 0;
};

/// The largest depth of a vertex below the ground.
class DeepestPoint {
 public:
  explicit DeepestPoint(ContactStep& step) : step_(step) {}

  void begin(double depth = 0) { depth_ = depth; }

  /// Looks for a larger depth in the accepted step from `now` to `next`: at its end, and at a maximum inside it, which
  /// the cubic through the depths and their rates at both ends places.  The depth of the numerical solution there is
  /// carried on to the maximum by the parabola of its rate, so that its error is of third order in the time's.
  void look(const ContactInstant& now, const ContactInstant& next);

  [[nodiscard]] double depth() const { return depth_; }  ///< largest δ so far [m]

 private:
  ContactStep& step_;
  ContactInstant trial_;
  double depth_ = 0;
};

}  // namespace clatter::numeric
