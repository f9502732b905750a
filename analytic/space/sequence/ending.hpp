// SPDX-License-Identifier: GPL-3.0-or-later
// How a sequence ends on the ground: the face on which a body has to come to rest, and its last motion there.
#pragma once

#include <optional>
#include <vector>

#include "analytic/space/landing/face_friction.hpp"
#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

/// Energy of the vertical motion, of turning about horizontal axes, and of height above rest on the face of the lowest
/// three vertices, of a rod that has two above rest on these; infinite where three are not of one face, or the body has
/// round surfaces [J].
[[nodiscard]] double vertical_energy(const Drop& drop, const State& now);

/// The face on which a body must come to rest, because its energy keeps it there in one of two ways.
///  1. The energy E of its vertical motion and turning about horizontal axes, above that of rest on the lowest face,
///     cannot lift it off by more than
///         height of the centre of mass  E/(m g),   tilt  E/(m g ρ),                                   (1)
///     ρ the distance inside the face of the point that the resting body presses on: that below the centre of mass,
///     moved by friction, by μ times the centre's height at most, and by what products of inertia do to a spinning
///     body.  No other point comes down at such a tilt, and impacts with e < 1 take the energy away.  Rest is taken to
///     come within 8 v/(g (1 − e)), v = √(2E/m), which is not proved: a body that does not tilt needs 2, the slowest of
///     360 random boxes 3.0, or 3.4 v/g with e <= 0.3 (time-stepping of their unilateral motion).
///  2. Its energy, without that of horizontal motion that no friction can change, is less than m g H, H the height of
///     the centre of mass on the lowest edge over which it can roll from the face on which it would come to rest
///     without energy to another such face:
///         h(u) = max_i u·r_i, u the direction down: h grows towards an edge, its saddles; rolling follows −grad h. (2)
///     Newton's law with friction can create energy: it has to be less than a quarter of that, both above rest on the
///     face, which is not proved to be enough.  1500 random drops with e <= 0.95 and μ <= 1.5 gained 43 % at most.  It
///     leaves open when the body rests.
/// Nothing where neither holds.
/// @param time  of the state, since the first impact [s]
[[nodiscard]] std::optional<Rest> settles(const Drop& drop, const State& now, double time);

// What a body does on the ground after its last impact: it lies, slides, spins or rolls.
//
// On level ground, with friction μ under the weight m g:
//     slide without spin     V̇ = −μ g V/|V|: it stops after v/(μ g), having gone v²/(2 μ g)                 (3)
//     slide with spin        of a face or a level rim: face_friction.hpp
//     ball                   slip s = V − r ω × ẑ keeps its direction: V̇ = −μ g s/|s|, I ω̇ = m r μ g ẑ × s/|s|,
//                            until |s|/(μ g (1 + m r²/I)) has passed; then it rolls on for ever              (4)
//     mantle                 of a body of revolution that moves across its axis: the same, I about the axis
// Without friction slides and spins go on for ever.  Where the ground slopes along x, a slide along x is (3) with
// V̇ = g_x ∓ μ g; it comes to rest, or slides down for ever.

/// The motion after the state `now`, in which nothing bounces or rocks any more.
class GroundedMotion {
 public:
  /// @param touching  points on the ground (Corner::index): of a face, an edge of a flat body, a level rim, a mantle, a
  ///                  ball
  GroundedMotion(const Drop& drop, const State& now, const std::vector<int>& touching);

  /// Nothing where none of the above describes it, as where a rim rolls or a slide tips over.
  [[nodiscard]] const std::optional<LastMotion>& summary() const { return summary_; }
  /// Domain: there is a summary.  @param time  since `now` [s]
  [[nodiscard]] std::optional<State> at(double time) const;

 private:
  struct Piece {  ///< with constant accelerations
    double begin = 0;
    State state;
    Vector3 acceleration = Vector3::Zero(), turning = Vector3::Zero();
  };
  [[nodiscard]] static State after(const Piece& piece, double time);
  void lie(const std::vector<int>& touching);
  void slide_straight();
  void slide_on_slope();
  void slide_and_turn();
  void roll(double radius, double moment);
  [[nodiscard]] bool carries(const Vector2& point) const;
  [[nodiscard]] std::optional<double> mantle() const;
  void summarise(LastMotion::Kind kind, double duration);

  const Drop& drop_;
  State now_;
  double friction_;
  ContactArea area_;  ///< from below the centre of mass; two corners: an edge
  std::optional<LastMotion> summary_;
  std::vector<Piece> pieces_;
  std::optional<SpinningFace> face_;  ///< that spins and is rubbed: in place of pieces
};

}  // namespace clatter::analytic::space
