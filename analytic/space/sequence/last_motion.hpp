// SPDX-License-Identifier: GPL-3.0-or-later
// What a body does on the ground after its last impact: it lies, slides, spins or rolls.
//
// On level ground, with friction μ under the weight m g:
//     slide without spin     V̇ = −μ g V/|V|: it stops after v/(μ g), having gone v²/(2 μ g)                 (1)
//     slide with spin        of a face or a level rim: face_slide.hpp
//     ball                   slip s = V − r ω × ẑ keeps its direction: V̇ = −μ g s/|s|, I ω̇ = m r μ g ẑ × s/|s|,
//                            until |s|/(μ g (1 + m r²/I)) has passed; then it rolls on for ever              (2)
//     mantle                 of a body of revolution that moves across its axis: the same, I about the axis
// Without friction slides and spins go on for ever.  Where the ground slopes along x, a slide along x is (1) with
// V̇ = g_x ∓ μ g; it comes to rest, or slides down for ever.
#pragma once

#include <optional>
#include <vector>

#include "analytic/space/landing/face_slide.hpp"
#include "analytic/space/sequence/impact_rows.hpp"

namespace clatter::analytic::space {

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
