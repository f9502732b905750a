// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/stepper.hpp"

#include <stdexcept>

#include "numeric/stepping/gsl_stepper.hpp"
#include "numeric/stepping/tvd_rk3.hpp"

namespace clatter::numeric {

std::unique_ptr<Stepper> make_stepper(Method method) {
  switch (method) {
    case Method::tvd_rk3: return std::make_unique<TvdRk3>();
    case Method::rk4: return make_gsl_stepper(GslMethod::rk4);
    case Method::rkf45: return make_gsl_stepper(GslMethod::rkf45);
    case Method::rkck: return make_gsl_stepper(GslMethod::rkck);
    case Method::rk8pd: return make_gsl_stepper(GslMethod::rk8pd);
    case Method::automatic: break;
  }
  throw std::invalid_argument("make_stepper: choose a method before asking for its stepper");
}

}  // namespace clatter::numeric
