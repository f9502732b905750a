// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/gsl_stepper.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <new>

namespace clatter::numeric {
namespace {

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

const gsl_odeiv2_step_type* step_type(GslMethod method) {
  switch (method) {
    case GslMethod::rk4: return gsl_odeiv2_step_rk4;
    case GslMethod::rkf45: return gsl_odeiv2_step_rkf45;
    case GslMethod::rkck: return gsl_odeiv2_step_rkck;
    case GslMethod::rk8pd: break;
  }
  return gsl_odeiv2_step_rk8pd;
}

struct FreeStep {
  void operator()(gsl_odeiv2_step* step) const { gsl_odeiv2_step_free(step); }
};

class GslStepper final : public Stepper {
 public:
  explicit GslStepper(GslMethod method)
      : step_(gsl_odeiv2_step_alloc(step_type(method), ContactState::SizeAtCompileTime)),
        error_order_(method == GslMethod::rk8pd ? 8 : 5) {
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

std::unique_ptr<Stepper> make_gsl_stepper(GslMethod method) {
  gsl_set_error_handler_off();
  return std::make_unique<GslStepper>(method);
}

}  // namespace clatter::numeric
