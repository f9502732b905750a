// SPDX-License-Identifier: GPL-3.0-or-later
// The first root of the height of a body's point in a piece of a flight, certified by bounds of its second derivative.
#pragma once

#include <optional>

#include "analytic/detail/limits.hpp"
#include "analytic/detail/root_finder.hpp"
#include "analytic/space/first_contact.hpp"
#include "analytic/space/hop.hpp"

namespace clatter::analytic::space {

/// Looks at one point after another and keeps the earliest contact, and the nearest miss, of all that it has seen.
class PointSearch {
 public:
  /// A moment of a point.
  struct Node {
    FlightMoment moment;
    PointHeight point;
  };

  PointSearch(const Body& body, const FreeFlight& flight);

  /// Looks for the point's first root in a piece, unless one before it is known.  True when one was found.
  bool look(int point, const Node& a, const Node& b);
  /// Takes the time as the point's contact, unless one before it is known; true.
  bool take(int point, double time, detail::Bracket bracket);

  [[nodiscard]] PointHeights& heights() { return heights_; }
  [[nodiscard]] FirstContact& found() { return found_; }
  /// Time of the earliest contact so far.
  [[nodiscard]] double best() const { return best_; }
  /// Clearances from here on are no near miss.
  [[nodiscard]] double threshold() const { return threshold_; }
  /// Normal velocity of the point that arrives first; of a small hop to relative accuracy, with that `error`.
  /// @param first  the point at the contact
  double arrival_velocity(const PointHeight& first, double& error) const;

 private:
  bool halves(int point, const Node& a, const Node& b);
  /// A height that is not above the ground though the piece before has no root that could be told: at rounding.
  bool solve_after(int point, const Node& a, const Node& node);
  bool convex(int point, const Node& a, const Node& b);
  bool solve(int point, const Node& a, const Node& b);
  /// Root of h/t in (0, b].
  bool solve_quotient(int point, const PointHeight& start, const Node& b);
  Node at(int point, double time);

  const Body& body_;
  const FreeFlight& flight_;
  PointHeights heights_;
  FirstContact found_;
  std::optional<Hop> hop_;
  double hop_time_ = -1;
  double best_ = detail::never_happens, threshold_;
};

}  // namespace clatter::analytic::space
