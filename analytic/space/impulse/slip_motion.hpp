// SPDX-License-Identifier: GPL-3.0-or-later
// How slide and spin of a level contact go on in impulse space while it slips.
#pragma once

#include <gsl/gsl_odeiv2.h>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <utility>

namespace clatter::analytic::space {

/// Slip (U_x, U_y, w) in any units that give the three one size, and quantities that go along with it, as functions of
/// the normal impulse P.  F, K and so the rates depend on the direction of slip alone; slide and spin end together.
class SlipMotion {
 public:
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 9, 1>;
  SlipMotion(const SlipMotion&) = delete;
  SlipMotion& operator=(const SlipMotion&) = delete;

 protected:
  enum class End { impulse_spent, stopped, no_pressure };  ///< the last: no rate, or too many steps

  explicit SlipMotion(Eigen::Index size);
  ~SlipMotion() = default;

  /// dy/dP at y; NaN where no pressure does it.
  virtual Values rate(const Values& y) = 0;
  /// Normal impulse up to end_stage(), from y_ and its rate: an estimate that becomes exact as it becomes small.
  virtual double impulse_left(const Values& rate) = 0;
  /// Whether the impulse ends where impulse_left() is zero.
  virtual bool end_stage() = 0;
  /// What rate() goes on from later, of several solutions: that of the last point, and back to it where a step fails.
  virtual void keep() {}
  virtual void go_back() {}
  /// Whether a step is short enough for what rate() holds on to.
  /// @param then  rate(next), the last one
  virtual bool may_step_to(const Values& /*next*/, const Values& /*then*/, double /*length*/) { return true; }

  /// Follows slip until it stops, as successive forecasts of the stop agree, or until the impulse is spent.
  /// @param from_rest  slip is first_slip, which dies out if friction holds the contact
  End slide(bool from_rest = false);

  Values y_;
  double spent_ = 0;  ///< P
  /// Local error of a step, relative to the largest slip so far, and of what goes along with it.
  double step_error_ = 4e-15;
  int most_steps_ = 20000;
  bool at_once_ = false;        ///< the step is so short that the rate may jump in it
  bool scales_along_ = false;   ///< what goes along with slip does so in proportion to its size
  bool only_friction_ = false;  ///< nothing but friction acts on slip, which can only become less

 private:
  struct StepDeleter {
    void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
  };
  static int derivative(double impulse, const double y[], double change[], void* motion);
  /// Error of a step in what goes along with slip, relative to its size or to 1.
  static double error_along(const Values& next, const Values& error);
  /// What goes along with slip, up to where it stops without turning.
  /// @param now  rate(y_)
  void go_straight_to(double stop, const Values& now);

  std::size_t size_;
  bool holds_direction_ = false;
  double held_from_ = 0, held_to_ = 0;  ///< P between which slip falls in a straight line to zero
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_step, StepDeleter> step_;
};

/// Slip, relative to what all of the impulse could do, with which a contact that is let go begins to slip.
inline constexpr double first_slip = 1e-15;

/// Slip of a contact that is let go, under the pressure that it has while it is held: it falls down a convex function,
/// the bottom of which is no slip if friction can hold the contact.
class SlipLetGo final : SlipMotion {
 public:
  using Slip = Eigen::Vector3d;
  /// @param load      dy/dP without friction
  /// @param friction  what friction adds, by the direction of slip
  SlipLetGo(const Slip& load, std::function<Slip(const Slip&)> friction)
      : SlipMotion(3), load_(load), friction_(std::move(friction)) {
    step_error_ = rough;
    most_steps_ = most_trials;
    y_ = first_slip * load_;
  }
  bool is_held() { return load_ == Slip::Zero() || slide(true) == End::stopped; }
  /// After is_held().
  [[nodiscard]] Slip direction() const { return y_.head<3>().normalized(); }

 private:
  Values rate(const Values& y) override { return load_ + friction_(y.head<3>()); }
  double impulse_left(const Values&) override { return trial - spent_; }
  bool end_stage() override { return true; }

  static constexpr int most_trials = 2000;
  static constexpr double trial = 1e-6;   ///< of the impulse
  static constexpr double rough = 1e-10;  ///< whether slip dies out is not a matter of rounding
  Slip load_;
  std::function<Slip(const Slip&)> friction_;
};

}  // namespace clatter::analytic::space
