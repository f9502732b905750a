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

  /// Estimate of the last step's local error.
  [[nodiscard]] const ContactState& error() const { return error_; }
  /// Vertices below the ground at the end of the last step, repetitions allowed.
  [[nodiscard]] const std::vector<int>& submerged() const { return submerged_; }
  /// Order of the error estimate in h; 0: the method has a fixed step.
  [[nodiscard]] int error_order() const { return stepper_.error_order(); }
  [[nodiscard]] const ContactSystem& system() const { return system_; }

 private:
  ContactSystem& system_;
  Stepper& stepper_;
  ContactState error_;
  std::vector<int> submerged_;
};

}  // namespace clatter::numeric
