// SPDX-License-Identifier: GPL-3.0-or-later
// How far an impact has come along its path in impulse space, and when its restitution law ends it.
//
// Units here: the approach speed v and v/W_nn.  Restitution laws, with u the normal velocity and u = −1 at the start:
//   Newton       ends where u = e first
//   Poisson      ends at p = (1+e) p_c; were u < 0 there, the ground would go on pushing: until u = 0
//   Stronge      ends where E = 0, dE = −u dp, E multiplied by e² at p_c
//   viscoelastic ends where E = 0, dE = −u dp/(1 − τu), E left as it is at p_c (viscoelastic.hpp)
// p_c, the end of compression, is the first impulse at which u = 0.  Where u turns negative again after it (a second
// compression; friction that reverses can do that), E grows again without a second loss, and p_c stays.
#pragma once

#include <limits>

#include "analytic/law/impact_law.hpp"
#include "analytic/space/body.hpp"

namespace clatter::analytic::space {

/// What ends compression and restitution.
struct RestitutionRule {
  RestitutionLaw law = RestitutionLaw::newton;
  double restitution = 1;  ///< e
  double damping = 0;      ///< τ v of the viscoelastic law
};

enum class Stage {
  compression,  ///< until u = 0
  restitution,  ///< until the law's condition
  overtime,     ///< Poisson's impulse is spent and the point still approaches: until u = 0
  done,
};

/// What the stages look at, along the path.
struct Measure {
  double impulse = 0;           ///< p
  double normal_velocity = -1;  ///< u
  double store = 0;             ///< E
};

class PathProgress {
 public:
  PathProgress(const RestitutionRule& rule, double initial_slip)
      : slip(initial_slip), least_slip(initial_slip), rule_(rule) {}

  [[nodiscard]] Stage stage() const { return stage_; }
  [[nodiscard]] bool is_done() const { return stage_ == Stage::done; }
  /// What rises through zero at the end of the stage.
  [[nodiscard]] double excess(const Measure& at) const;
  /// The derivative of excess() by the impulse, where u has the derivative `normal_rate`.
  [[nodiscard]] double excess_rate(const Measure& at, double normal_rate) const;
  /// Enters the next stage.
  void end_stage();

  /// Goes along a straight line of constant ratio = dP_t/dp and normal_rate = du/dp for the impulse `length` or to the
  /// end of the law, whichever comes first.
  struct Line {
    Vector2 ratio = Vector2::Zero();
    double normal_rate = 1;
    double length = std::numeric_limits<double>::infinity();
  };
  void follow(const Line& line);

  /// dE/dp at u.
  [[nodiscard]] double storing(double normal_velocity) const {
    return -normal_velocity / (1 - rule_.damping * normal_velocity);
  }
  /// Whether E is needed at all.
  [[nodiscard]] bool is_energetic() const { return rule_.law >= RestitutionLaw::stronge; }
  [[nodiscard]] double damping() const { return rule_.damping; }
  /// A strongly damped ground gives its last energy back while u is 1/τ to rounding, which is that of p and of 1.
  [[nodiscard]] bool is_at_limit_speed() const {
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    return stage_ == Stage::restitution && is_energetic() &&
           1 - rule_.damping * at.normal_velocity <= rounding * (1 + rule_.damping * at.impulse);
  }

  Measure at;
  Vector2 friction = Vector2::Zero();                             ///< P_t
  double slip;                                                    ///< σ
  double least_slip;                                              ///< smallest σ so far
  double compression = std::numeric_limits<double>::quiet_NaN();  ///< p_c

 private:
  [[nodiscard]] double length_of_stage(double normal_rate) const;
  void advance(const Line& line, double length);

  RestitutionRule rule_;
  Stage stage_ = Stage::compression;
};

}  // namespace clatter::analytic::space
