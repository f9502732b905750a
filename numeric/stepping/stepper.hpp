// SPDX-License-Identifier: GPL-3.0-or-later
// The methods of time integration, and one step of a contact.
#pragma once

#include <memory>
#include <vector>

#include "numeric/contact/contact_system.hpp"

namespace clatter::numeric {

/// How contacts are integrated in time.
enum class Method {
  automatic,  ///< tvd_rk3 when a step is given, else rkck up to four digits and rk8pd beyond
  tvd_rk3,    ///< third-order TVD Runge–Kutta with a fixed step, the paper's method
  rk4,        ///< classical fourth order, adaptive by step doubling (GSL)
  rkf45,      ///< Runge–Kutta–Fehlberg 4(5), adaptive (GSL)
  rkck,       ///< Cash–Karp 4(5), adaptive (GSL)
  rk8pd,      ///< Prince–Dormand 8(9), adaptive (GSL)
};

/// One step of a Runge–Kutta method for Eq. 3 of Shan et al. (2005), U̇ = R(U).
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Advances `y` by `h` [s] into `next`; `rate` is the derivative at y.  `error` gets the local error estimate,
  /// or 0 for a method without one.  No allocation.
  /// @return false if the method failed (a number that is not finite).
  virtual bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h,
                    ContactState& next, ContactState& error) = 0;
  /// Order of the error estimate in h; 0: there is none, the step is fixed.
  [[nodiscard]] virtual int error_order() const = 0;
};

/// @throws std::invalid_argument for Method::automatic.
[[nodiscard]] std::unique_ptr<Stepper> make_stepper(Method method);

/// A linearly implicit step for friction that is stiff: over a slip that is slow beside that from the patch's spin it
/// is a damper whose rate μ_k F_n/(m |slip|) explicit steps can follow by steps of its inverse alone, a thousandth of
/// the contact and less.  ROS34PW2 of Rang and Angermann (BIT 45 (2005) 761), a W-method: of third order whatever
/// matrix stands for the Jacobian, and stable where that has what is stiff.  Here it has the derivatives of the
/// accelerations by the velocities, from differences.
class FrictionStepper final : public Stepper {
 public:
  /// For slip that differs by `speed` or more [m/s], of bodies of the radius [m].
  void begin(double speed, double radius);
  /// The fastest rate at which friction changes velocities at y, whose derivative is `rate` [1/s]: a norm, not below
  /// it.
  [[nodiscard]] double fastest_rate(ContactSystem& system, const ContactState& y, const ContactState& rate);

  bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h, ContactState& next,
            ContactState& error) override;
  [[nodiscard]] int error_order() const override { return 3; }

 private:
  using Jacobian = Eigen::Matrix<double, 6, 6>;  ///< of V̇ and ω̇′ by V and ω′

  double speed_ = 0, radius_ = 1;
  Jacobian jacobian_ = Jacobian::Zero();
  ContactState at_ = ContactState::Zero(), rate_ = ContactState::Zero();  ///< where it was taken
};

/// An instant of a contact.
struct ContactInstant {
  double time = 0;  ///< after touch-down [s]
  ContactState state = ContactState::Zero(), rate = ContactState::Zero();
  ContactDiagnosis diagnosis;
};

/// Takes steps of a contact, trial steps too, and keeps what the last one left.
class ContactStep {
 public:
  ContactStep(ContactSystem& system, Stepper& stepper);

  /// A step of length h [s] from `from` to `to`; false if a number of it is not finite.  No allocation.
  [[nodiscard]] bool take(const ContactInstant& from, double h, ContactInstant& to);

  /// Takes explicit steps until friction is stiff.  @param speed, radius  see FrictionStepper
  void begin(double speed, double radius);
  /// Goes over to implicit steps where those of length h [s] at an instant are held back by the stiffness of friction,
  /// and back where they are not.
  void choose_method(const ContactInstant& now, double h);

  /// Estimate of the last step's local error.
  [[nodiscard]] const ContactState& error() const { return error_; }
  /// Vertices below the ground at the end of the last step, repetitions allowed.
  [[nodiscard]] const std::vector<int>& submerged() const { return submerged_; }
  /// Order of the error estimate in h; 0: the method has a fixed step.
  [[nodiscard]] int error_order() const { return is_stiff_ ? friction_.error_order() : stepper_.error_order(); }
  [[nodiscard]] const ContactSystem& system() const { return system_; }

 private:
  ContactSystem& system_;
  Stepper& stepper_;
  FrictionStepper friction_;
  bool is_stiff_ = false;
  static constexpr int first_look = 50;  ///< costs as much as an explicit step
  int steps_ = 0;                        ///< since the method was changed or looked at last
  int next_look_ = first_look;           ///< so many explicit steps later
  ContactState error_;
  std::vector<int> submerged_;
};

}  // namespace clatter::numeric
