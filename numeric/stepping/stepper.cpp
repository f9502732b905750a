// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/stepping/stepper.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

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

namespace {

/// V and ω′ of a state, V̇ and ω̇′ of its rate.
constexpr int first_velocity = 7;
auto velocities(auto& y) { return y.template segment<6>(first_velocity); }

}  // namespace

void FrictionStepper::begin(double speed, double radius) {
  constexpr double part = 1e-9;
  speed_ = part * speed;
  radius_ = radius;
  at_.setConstant(std::nan(""));
}

double FrictionStepper::fastest_rate(ContactSystem& system, const ContactState& y, const ContactState& rate) {
  if (at_ != y || rate_ != rate) {
    at_ = y;
    rate_ = rate;
    ContactState beside = y, slope;
    for (int k = 0; k < 6; ++k) {
      const double change = k < 3 ? speed_ : speed_ / radius_;
      double& moved = velocities(beside)[k];
      const double there = moved;
      moved += change;
      system.derivative(beside, slope);
      jacobian_.col(k) = (velocities(slope) - velocities(rate)) / (moved - there);
      moved = there;
    }
  }
  Eigen::Matrix<double, 6, 1> sizes;  // so that all components are speeds
  sizes << 1, 1, 1, radius_, radius_, radius_;
  return (sizes.asDiagonal() * jacobian_ * sizes.cwiseInverse().asDiagonal()).norm();
}

bool FrictionStepper::step(ContactSystem& system, const ContactState& y, const ContactState& rate, double h,
                           ContactState& next, ContactState& error) {
  constexpr double gamma = 0.43586652150845900;
  // Rows of α and γ, and the weights of both orders; h k_i = h f(y + Σ α_ij k_j) + h J Σ γ_ij k_j.
  constexpr double alpha[4][3] = {
      {0, 0, 0}, {0.87173304301691801, 0, 0}, {0.84457060015369423, -0.11299064236484185, 0}, {0, 0, 1}};
  constexpr double coupling[4][3] = {{0, 0, 0},
                                     {-0.87173304301691801, 0, 0},
                                     {-0.90338057013044082, 0.054180672388095326, 0},
                                     {0.24212380706095346, -1.2232505839045147, 0.54526025533510214}};
  constexpr double weights[4] = {0.24212380706095346, -1.2232505839045147, 1.5452602553351020, 0.43586652150845900};
  constexpr double second[4] = {0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950};
  static_cast<void>(fastest_rate(system, y, rate));
  const Jacobian scaled = h * jacobian_;
  const Eigen::PartialPivLU<Jacobian> solver(Jacobian::Identity() - gamma * scaled);
  std::array<ContactState, 4> k;
  for (std::size_t i = 0; i < k.size(); ++i) {
    ContactState at = y, coupled = ContactState::Zero();
    for (std::size_t j = 0; j < i; ++j) {
      at += alpha[i][j] * k[j];
      coupled += coupling[i][j] * k[j];
    }
    if (i == 0) k[i] = rate;
    else system.derivative(at, k[i]);
    k[i] *= h;
    velocities(k[i]) = solver.solve(velocities(k[i]) + scaled * velocities(coupled)).eval();
  }
  next = y;
  error.setZero();
  for (std::size_t i = 0; i < k.size(); ++i) {
    next += weights[i] * k[i];
    error += (weights[i] - second[i]) * k[i];
  }
  return next.allFinite() && error.allFinite();
}

ContactStep::ContactStep(ContactSystem& system, Stepper& stepper) : system_(system), stepper_(stepper) {
  submerged_.reserve(system.body().facets().corners.size());
}

void ContactStep::begin(double speed, double radius) {
  friction_.begin(speed, radius);
  is_stiff_ = false;
  steps_ = 0;
  next_look_ = first_look;
}

void ContactStep::choose_method(const ContactInstant& now, double h) {
  // Times the fastest rate explicit steps can be about 3 long; an implicit one costs as much as two of them.
  constexpr double held_back = 2, worth_it = 6;
  constexpr int steps_to_lengthen = 5;
  using Kind = FrictionPhase::Kind;
  const Kind kind = system_.phase().kind;
  const bool can_be_stiff = stepper_.error_order() > 0 && kind != Kind::none && kind != Kind::stick && now.time > 0;
  ++steps_;
  if (is_stiff_ ? steps_ < steps_to_lengthen : !can_be_stiff || steps_ < next_look_) return;
  const double part = can_be_stiff ? h * friction_.fastest_rate(system_, now.state, now.rate) : 0;
  const bool was_stiff = std::exchange(is_stiff_, part > (is_stiff_ ? worth_it : held_back));
  if (was_stiff && is_stiff_) return;
  if (was_stiff && steps_ == steps_to_lengthen) next_look_ *= 2;  // it was in vain
  steps_ = 0;
}

bool ContactStep::take(const ContactInstant& from, double h, ContactInstant& to) {
  assert(h > 0);
  Stepper& stepper = is_stiff_ ? friction_ : stepper_;
  if (!stepper.step(system_, from.state, from.rate, h, to.state, error_)) return false;
  euler_parameters(to.state).normalize();
  to.time = from.time + h;
  submerged_.clear();
  to.diagnosis = system_.diagnose(to.state, to.rate, &submerged_);
  return to.rate.allFinite();
}

}  // namespace clatter::numeric
