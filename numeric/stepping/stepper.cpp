// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/stepper.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <cassert>
#include <new>
#include <stdexcept>

namespace clatter::numeric {
namespace {

/// Integrates Eq. 3 of Shan et al. (2005) as they did: third-order total-variation-diminishing Runge–Kutta method of
/// Shu and Osher (1988):
///     y₁ = y + h f(y),   y₂ = ¾ y + ¼ (y₁ + h f(y₁)),   y(t+h) = ⅓ y + ⅔ (y₂ + h f(y₂)).
class TvdRk3 final : public Stepper {
 public:
  bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h, ContactState& next,
            ContactState& error) override {
    ContactState slope;
    const ContactState first = y + h * rate;
    system.derivative(first, slope);
    // Increments are combined instead of states, so that the state's own rounding enters once.
    const ContactState increment = 0.25 * h * (rate + slope);
    system.derivative(y + increment, slope);
    next = y + (2.0 / 3.0) * (increment + h * slope);
    error.setZero();
    return next.allFinite();
  }
  [[nodiscard]] int error_order() const override { return 0; }
};

using State = Eigen::Map<ContactState>;
using ConstState = Eigen::Map<const ContactState>;

int derivative(double, const double* y, double* rate, void* system) {
  const ContactState state = ConstState(y);
  ContactState slope;
  static_cast<ContactSystem*>(system)->derivative(state, slope);
  State result(rate);
  result = slope;
  return slope.allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

struct FreeStep {
  void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
};

/// Embedded Runge–Kutta methods of the GNU Scientific Library.
class GslStepper final : public Stepper {
 public:
  GslStepper(const gsl_odeiv2_step_type* type, int error_order)
      : step_(gsl_odeiv2_step_alloc(type, ContactState::SizeAtCompileTime)), error_order_(error_order) {
    if (!step_) throw std::bad_alloc();
  }

  bool step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h, ContactState& next,
            ContactState& error) override {
    const gsl_odeiv2_system equations{derivative, nullptr, ContactState::SizeAtCompileTime, &system};
    next = y;
    const int status =
        gsl_odeiv2_step_apply(step_.get(), 0, h, next.data(), error.data(), rate.data(), nullptr, &equations);
    return status == GSL_SUCCESS && next.allFinite() && error.allFinite();
  }

  [[nodiscard]] int error_order() const override { return error_order_; }

 private:
  std::unique_ptr<gsl_odeiv2_step, FreeStep> step_;
  int error_order_;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(Method method) {
  gsl_set_error_handler_off();
  switch (method) {
    case Method::tvd_rk3: return std::make_unique<TvdRk3>();
    case Method::rk4: return std::make_unique<GslStepper>(gsl_odeiv2_step_rk4, 5);
    case Method::rkf45: return std::make_unique<GslStepper>(gsl_odeiv2_step_rkf45, 5);
    case Method::rkck: return std::make_unique<GslStepper>(gsl_odeiv2_step_rkck, 5);
    case Method::rk8pd: return std::make_unique<GslStepper>(gsl_odeiv2_step_rk8pd, 8);
    case Method::automatic: break;
  }
  throw std::invalid_argument("make_stepper: choose a method before asking for its stepper");
}

ContactStep::ContactStep(ContactSystem& system, Stepper& stepper) : system_(system), stepper_(stepper) {
  submerged_.reserve(system.body().facets().corners.size());
}

bool ContactStep::take(const ContactInstant& from, double h, ContactInstant& to) {
  assert(h > 0);
  if (!stepper_.step(system_, from.state, from.rate, h, to.state, error_)) return false;
  euler_parameters(to.state).normalize();
  to.time = from.time + h;
  submerged_.clear();
  to.diagnosis = system_.diagnose(to.state, to.rate, &submerged_);
  return to.rate.allFinite();
}

}  // namespace clatter::numeric
