// SPDX-License-Identifier: GPL-3.0-or-later
// One impact of a corner with Coulomb friction by stepping its equation of motion in long double.
//
// Equation (2) of analytic/space/impact.hpp with dp = σ dτ, so that steps in p shrink with slip σ = |v_t|:
//     dv/dτ = W (σ n − μ v_t),   dp/dτ = σ,   dP_t/dτ = −μ v_t,   dE/dτ = −u σ/(1 − τ_d u).
// Knows nothing of angles, invariant directions and principal axes.
#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>

#include "analytic/space/impulse_path.hpp"

namespace clatter::oracle {

class SteppedImpact {
 public:
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;

  SteppedImpact(const analytic::space::Contact& contact, const analytic::ImpactLaw& law)
      : w_(contact.inverse_inertia.cast<Real>()), law_(law), friction_(law.friction_value),
        damping_(law.law == analytic::RestitutionLaw::viscoelastic ? law.damping_per_stiffness : 0),
        restitution_(law.law == analytic::RestitutionLaw::viscoelastic ? 1 : law.restitution) {
    for (int i = 0; i < 3; ++i) x_[at(i)] = contact.velocity[i];
    approach_ = -contact.velocity[2];
    speed_ = contact.velocity.cast<Real>().norm();
    run();
  }

  [[nodiscard]] Vector impulse() const { return {x_[3], x_[4], x_[5]}; }
  [[nodiscard]] Vector velocity() const { return {x_[0], x_[1], x_[2]}; }
  [[nodiscard]] Real compression() const { return compression_; }
  [[nodiscard]] bool slip_stopped() const { return stopped_; }
  [[nodiscard]] Real least_slip() const { return least_slip_; }

 private:
  /// v, P, E.
  using State = std::array<Real, 7>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static Real slip(const State& x) { return std::hypot(x[0], x[1]); }

  void operator_slip(const State& x, State& rate) const {
    const Real s = slip(x);
    set_rates(x, {-friction_ * x[0], -friction_ * x[1], s}, rate);
  }
  /// Rates for dP = `push`.
  void set_rates(const State& x, const Vector& push, State& rate) const {
    const Vector acceleration = w_ * push;
    for (int i = 0; i < 3; ++i) rate[at(i)] = acceleration[i], rate[at(i + 3)] = push[i];
    rate[6] = -x[2] / (1 - damping_ * x[2]) * push[2];
  }

  /// Rises through 0 where the present stage ends.
  [[nodiscard]] Real excess(const State& x) const {
    using analytic::RestitutionLaw;
    if (stage_ != 1) return x[2];
    if (law_.law == RestitutionLaw::newton) return x[2] - restitution_ * approach_;
    if (law_.law == RestitutionLaw::poisson) return x[5] - (1 + restitution_) * compression_;
    return -x[6];
  }
  void end_stage() {
    if (stage_ == 0) {
      compression_ = x_[5];
      x_[6] *= restitution_ * restitution_;
      stage_ = restitution_ > 0 ? 1 : 3;
    } else {
      const bool approaches = law_.law == analytic::RestitutionLaw::poisson && stage_ == 1 && x_[2] < 0;
      stage_ = approaches ? 2 : 3;
    }
  }

  /// Steps of controlled size until slip has stopped (`slipping`) or the impact has ended.
  template <class Rates>
  void integrate(const Rates& rates, Real step, bool slipping) {
    boost::numeric::odeint::runge_kutta_fehlberg78<State, Real> stepper;
    for (int i = 0; i < 200000 && stage_ != 3; ++i) {
      if (slipping && slip(x_) <= 1e-19L * speed_) return;
      const Real error = try_step(stepper, rates, step);
      if (!(error <= 1)) {
        step *= std::fmax(0.2L, 0.9L * std::pow(error, -0.125L));
        continue;
      }
      if (excess(next_) >= 0) locate_end(stepper, rates, step);
      else {
        x_ = next_;
        least_slip_ = std::fmin(least_slip_, slip(x_));
        step *= std::fmin(4.0L, 0.9L * std::pow(std::fmax(error, 1e-9L), -0.125L));
      }
    }
    if (stage_ != 3) throw std::runtime_error("stepped impact: too many steps");
  }
  template <class Stepper, class Rates>
  Real try_step(Stepper& stepper, const Rates& rates, Real step) {
    // Of one step against two halves, which are better by 2⁸; the estimate embedded in the method is blind where the
    // rates do not depend on the state.
    constexpr Real tolerance = 1e-14L;
    const auto system = [&](const State& x, State& rate, Real) { rates(x, rate); };
    State error{}, half{};
    stepper.do_step(system, x_, 0.0L, error, step);
    stepper.do_step(system, x_, 0.0L, half, step / 2);
    stepper.do_step(system, half, 0.0L, next_, step / 2);
    for (std::size_t i = 0; i < error.size(); ++i) error[i] -= next_[i];
    Real worst = 0;
    const Real impulse = std::fmax(next_[5], 1e-3L * approach_ / w_(2, 2));
    for (int i = 0; i < 3; ++i) {
      const Real size = i < 2 ? std::fmax(slip(x_), 1e-25L * speed_) : approach_;
      worst = std::fmax(worst, std::fabs(error[at(i)]) / size);
      worst = std::fmax(worst, std::fabs(error[at(i + 3)]) / impulse);
    }
    worst = std::fmax(worst, std::fabs(error[6]) / (impulse * approach_));
    if (!(1 - damping_ * next_[2] > (1 - damping_ * x_[2]) / 2)) return 1e9L;
    return worst / tolerance;
  }
  template <class Stepper, class Rates>
  void locate_end(Stepper& stepper, const Rates& rates, Real step) {
    Real low = 0, high = step;
    for (int i = 0; i < 70; ++i) {
      const Real middle = (low + high) / 2;
      try_step(stepper, rates, middle);
      (excess(next_) >= 0 ? high : low) = middle;
    }
    try_step(stepper, rates, high);
    x_ = next_;
    end_stage();
  }

  /// dP/dp of a corner whose slip has stopped.
  [[nodiscard]] Vector push_from_rest() const {
    const Eigen::Matrix<Real, 2, 2> a = w_.template topLeftCorner<2, 2>();
    const Eigen::Matrix<Real, 2, 1> b = w_.template block<2, 1>(0, 2);
    const Eigen::Matrix<Real, 2, 1> stick = -a.inverse() * b;
    if (stick.norm() <= friction_) return {stick[0], stick[1], 1};
    const auto direction = [&](Real f) -> Eigen::Matrix<Real, 2, 1> {
      return (friction_ * a + f * Eigen::Matrix<Real, 2, 2>::Identity()).inverse() * b;
    };
    Real low = 0, high = b.norm();
    for (int i = 0; i < 80; ++i) {
      const Real middle = (low + high) / 2;
      (direction(middle).norm() > 1 ? low : high) = middle;
    }
    const Eigen::Matrix<Real, 2, 1> s = direction(high);
    return {-friction_ * s[0], -friction_ * s[1], 1};
  }

  void run() {
    least_slip_ = slip(x_);
    const bool slips = slip(x_) > 0;
    if (slips) {
      integrate([this](const State& x, State& rate) { operator_slip(x, rate); }, 0.01L / w_.norm(), true);
    }
    if (stage_ == 3) return;
    stopped_ = slips;
    x_[0] = x_[1] = 0;
    const Vector push = push_from_rest();
    integrate([&](const State& x, State& rate) { set_rates(x, push, rate); }, 0.01L * approach_ / w_.norm(), false);
  }

  Eigen::Matrix<Real, 3, 3> w_;
  analytic::ImpactLaw law_;
  Real friction_, damping_, restitution_, approach_ = 0, speed_ = 0, compression_ = 0, least_slip_ = 0;
  State x_{}, next_{};
  int stage_ = 0;  ///< compression, restitution, Poisson's rest, ended
  bool stopped_ = false;
};

}  // namespace clatter::oracle
