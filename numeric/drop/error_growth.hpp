// SPDX-License-Identifier: GPL-3.0-or-later
// How much a small error of the start has grown.
#pragma once

#include "numeric/motion/free_flight.hpp"
#include "numeric/stepping/contact_run.hpp"

namespace clatter::numeric {

/// What an error of that size has grown to while the amplification went `from` one value `to` another.  It never counts
/// as falling: a contact that damps one deviation may keep another.  Not known growths count as none.
[[nodiscard]] inline double grown(double error, double from, double to) {
  const double growth = to / from;
  return error * (growth > 1 ? growth : 1);
}

/// What a neighbour's contact is run by: `same` as the contact beside it, or `rough`, which is cheap at the tolerance
/// that its deviation needs.  Both of one system.
struct ContactRuns {
  ContactRun &same, &rough;
};

/// Carries one small deviation along a drop: through flights by the linearised equations, through contacts by a
/// neighbouring run, rescaled after each, so that a growth beyond 1/ε still shows.  Deviations are measured in
/// one norm: position over the body's radius R, angle, speed over the start's (|V| + R|ω|), angular velocity
/// times R over that.  The first deviation has equal parts in all of them (in the plane only, for a planar
/// drop), so that growth in any direction shows, out of the plane of symmetry too.  Right to about 10 %, a factor of
/// two in contacts that a deviation changes in kind.  It costs about a quarter of a run to six digits.
class ErrorGrowth {
 public:
  ErrorGrowth(const Body& body, const MotionState& start, const Gravity& gravity, bool planar);

  /// From `start` through a flight of `time` [s].
  void fly(const MotionState& start, double time);
  /// From the touch-down `touch` through the contact whose result is given, by a run of the neighbour.
  void touch(const ContactRuns& runs, const ContactControl& control, const MotionState& touch,
             const ContactResult& contact);

  /// Size of the deviation over that of the start.
  [[nodiscard]] double factor() const { return factor_; }

 private:
  using Deviation = Eigen::Matrix<double, 12, 1>;  // position, turn (body frame), velocity, angular velocity

  [[nodiscard]] MotionState moved(const MotionState& state, double size) const;
  [[nodiscard]] Deviation between(const MotionState& from, const MotionState& to) const;
  void take(const Deviation& deviation);

  const Body& body_;
  Gravity gravity_;
  bool planar_;
  double speed_;
  Deviation deviation_;  ///< scaled, of size 1
  double factor_ = 1;
};

}  // namespace clatter::numeric
