// SPDX-License-Identifier: GPL-3.0-or-later
// One impact of a corner with Coulomb friction by stepping its equation of motion, in long double or in many digits.
//
// Equation (2) of analytic/space/impulse/impact.hpp with dp = σ dτ, so that steps in p shrink with slip σ = |v_t|:
//     dv/dτ = W (σ n − μ v_t),   dp/dτ = σ,   dP_t/dτ = −μ v_t,   dE/dτ = −u σ/(1 − τ_d u),
// by Taylor series of v, P, E in τ, whose coefficients follow one from another by Cauchy products (σ² = v_t·v_t).
// Knows nothing of angles, invariant directions and principal axes.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/space/impulse/impulse_path.hpp"

namespace clatter::oracle {

template <class Number>
class SteppedImpact {
 public:
  using Real = Number;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;

  /// @param inverse_inertia  W of the contact [1/kg]
  /// @param velocity         of the corner, v_n < 0 [m/s]
  SteppedImpact(const Matrix& inverse_inertia, const Vector& velocity, const analytic::ImpactLaw& law)
      : w_(inverse_inertia), law_(law.law), friction_(law.friction_value),
        damping_(is_viscoelastic() ? law.damping_per_stiffness : 0),
        restitution_(is_viscoelastic() ? 1 : law.restitution) {
    using std::sqrt;
    for (int i = 0; i < 3; ++i) x_[at(i)] = velocity[i];
    approach_ = -velocity[2];
    speed_ = sqrt(velocity.squaredNorm());
    run();
  }
  SteppedImpact(const analytic::space::Contact& contact, const analytic::ImpactLaw& law)
      : SteppedImpact(contact.inverse_inertia.cast<Real>(), contact.velocity.cast<Real>(), law) {}

  [[nodiscard]] Vector impulse() const { return {x_[3], x_[4], x_[5]}; }
  [[nodiscard]] Vector velocity() const { return {x_[0], x_[1], x_[2]}; }
  [[nodiscard]] Real compression() const { return compression_; }
  [[nodiscard]] bool slip_stopped() const { return stopped_; }
  [[nodiscard]] Real least_slip() const { return least_slip_; }

 private:
  static constexpr int digits = std::numeric_limits<Real>::digits10;
  static constexpr int order = digits + 4;
  using State = std::array<Real, 7>;  ///< v, P, E
  using Series = std::array<Real, order + 1>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static Real rounding() { return std::numeric_limits<Real>::epsilon(); }
  static Real slip(const State& x) {
    using std::sqrt;
    return sqrt(x[0] * x[0] + x[1] * x[1]);
  }
  /// Coefficient k of the product of two series, from coefficient `first` of each on.
  static Real product(const Series& a, const Series& b, int k, int first = 0) {
    Real sum = 0;
    for (int j = first; j <= k - first; ++j) sum += a[at(j)] * b[at(k - j)];
    return sum;
  }
  static Real square(const Series& a, int k, int first = 0) {
    Real sum = 0;
    for (int j = first; 2 * j < k; ++j) sum += a[at(j)] * a[at(k - j)];
    const bool has_middle = k % 2 == 0 && k / 2 >= first;
    return has_middle ? Real(2 * sum + a[at(k / 2)] * a[at(k / 2)]) : Real(2 * sum);
  }
  [[nodiscard]] bool is_viscoelastic() const { return law_ == analytic::RestitutionLaw::viscoelastic; }

  /// Coefficient k of σ from the earlier ones, by σ² = v_t·v_t.
  [[nodiscard]] Real slip_term(const Series& slip, int k) const {
    using std::sqrt;
    const Real of_square = square(terms_[0], k) + square(terms_[1], k);
    return k == 0 ? Real(sqrt(of_square)) : Real((of_square - square(slip, k, 1)) / (2 * slip[0]));
  }
  /// Coefficient k of dE/dτ from the earlier ones.
  [[nodiscard]] Real loss_term(const Series& slip, const Series& loss, int k) const {
    Real rest = -product(terms_[2], slip, k);
    for (int j = 1; j <= k; ++j) rest += damping_ * terms_[2][at(j)] * loss[at(k - j)];
    return rest / (1 - damping_ * terms_[2][0]);
  }

  /// The series from x_ on: of slip, or of a corner that pushes with `push` per normal impulse.
  void expand(const Vector* push) {
    const bool needs_energy = law_ == analytic::RestitutionLaw::stronge || is_viscoelastic();
    Series slip{}, loss{};
    for (std::size_t i = 0; i < x_.size(); ++i) terms_[i][0] = x_[i];
    for (int k = 0; k < order; ++k) {
      Vector rate = Vector::Zero();
      if (push == nullptr) {
        slip[at(k)] = slip_term(slip, k);
        rate = Vector(-friction_ * terms_[0][at(k)], -friction_ * terms_[1][at(k)], slip[at(k)]);
      } else if (k == 0) {
        rate = *push;
        slip[0] = 1;
      }
      const Vector change = w_ * rate;
      for (int i = 0; i < 3; ++i) {
        terms_[at(i)][at(k + 1)] = change[i] / (k + 1);
        terms_[at(i + 3)][at(k + 1)] = rate[i] / (k + 1);
      }
      if (needs_energy) loss[at(k)] = loss_term(slip, loss, k);
      terms_[6][at(k + 1)] = loss[at(k)] / (k + 1);
    }
  }
  [[nodiscard]] State after(const Real& step) const {
    State x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = terms_[i][at(order)];
      for (int k = order - 1; k >= 0; --k) x[i] = x[i] * step + terms_[i][at(k)];
    }
    return x;
  }
  /// The longest step whose last terms are rounding of the state, tangential velocities on the scale of slip.
  [[nodiscard]] Real longest_step(bool slips) const {
    using std::abs;
    using std::pow;
    const Real impulse = x_[5] + approach_ / w_(2, 2);
    const Real scales[] = {slips ? slip(x_) : speed_, approach_, impulse, impulse * approach_};
    constexpr int scale_of[] = {0, 0, 1, 2, 2, 2, 3};
    Real least = 1 / rounding();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      for (int k = order - 1; k <= order; ++k) {
        const Real part = abs(terms_[i][at(k)]) / scales[scale_of[i]];
        if (part > 0) least = fmin_of(least, pow(Real(rounding() / part), Real(1) / k));
      }
    }
    return least;
  }
  static Real fmin_of(const Real& a, const Real& b) { return b < a ? b : a; }

  /// Rises through 0 where the present stage ends.
  [[nodiscard]] Real excess(const State& x) const {
    using analytic::RestitutionLaw;
    if (stage_ != 1) return x[2];
    if (law_ == RestitutionLaw::newton) return x[2] - restitution_ * approach_;
    if (law_ == RestitutionLaw::poisson) return x[5] - (1 + restitution_) * compression_;
    return -x[6];
  }
  void end_stage() {
    if (stage_ == 0) {
      compression_ = x_[5];
      x_[6] *= restitution_ * restitution_;
      stage_ = restitution_ > 0 ? 1 : 3;
    } else {
      const bool approaches = law_ == analytic::RestitutionLaw::poisson && stage_ == 1 && x_[2] < 0;
      stage_ = approaches ? 2 : 3;
    }
  }

  /// Steps until slip has stopped or the impact has ended.
  void integrate(const Vector* push) {
    const bool slips = push == nullptr;
    Real constant_step = approach_ / w_.norm() / 4;  // where the series end and bound no step
    for (int i = 0; i < 20000 && stage_ != 3; ++i) {
      if (slips && slip(x_) <= rounding() / 8 * speed_) return;
      expand(push);
      const Real step = slips ? longest_step(true) : fmin_of(longest_step(false), constant_step *= 2);
      const State next = after(step);
      if (excess(next) >= 0) {
        locate_end(step);
      } else {
        x_ = next;
        if (slips) least_slip_ = fmin_of(least_slip_, slip(x_));
      }
    }
    if (stage_ != 3) throw std::runtime_error("stepped impact: too many steps");
  }
  /// Where excess() rises through 0 within the step: by bisection, and by secants that keep the bracket.
  void locate_end(const Real& step) {
    Real low = 0, high = step, at_low = excess(x_), at_high = excess(after(step));
    for (int i = 0; i < 12 * digits && high - low > rounding() * high; ++i) {
      Real middle = (low + high) / 2;
      const Real secant = low - at_low * (high - low) / (at_high - at_low), inside = (high - low) * rounding();
      if (i % 3 != 0 && secant > low + inside && secant < high - inside) middle = secant;
      const Real value = excess(after(middle));
      (value >= 0 ? high : low) = middle;
      (value >= 0 ? at_high : at_low) = value;
    }
    x_ = after(high);
    end_stage();
  }

  /// dP/dp of a corner whose slip has stopped.
  [[nodiscard]] Vector push_from_rest() const {
    using Plane = Eigen::Matrix<Real, 2, 1>;
    const Plane b(w_(0, 2), w_(1, 2));
    const auto solved = [&](const Real& scale, const Real& f) -> Plane {
      const Real xx = scale * w_(0, 0) + f, yy = scale * w_(1, 1) + f, xy = scale * w_(0, 1);
      return Plane(yy * b[0] - xy * b[1], xx * b[1] - xy * b[0]) / (xx * yy - xy * xy);
    };
    const Plane stick = -solved(1, 0);
    if (stick.squaredNorm() <= friction_ * friction_) return {stick[0], stick[1], 1};
    Real low = 0, high = b.norm();
    for (int i = 0; i < 4 * digits; ++i) {
      const Real middle = (low + high) / 2;
      (solved(friction_, middle).squaredNorm() > 1 ? low : high) = middle;
    }
    const Plane s = solved(friction_, high);
    return {-friction_ * s[0], -friction_ * s[1], 1};
  }

  void run() {
    least_slip_ = slip(x_);
    const bool slips = least_slip_ > 0;
    if (slips) integrate(nullptr);
    if (stage_ == 3) return;
    stopped_ = slips;
    x_[0] = x_[1] = 0;
    const Vector push = push_from_rest();
    integrate(&push);
  }

  Matrix w_;
  analytic::RestitutionLaw law_;
  Real friction_, damping_, restitution_, approach_ = 0, speed_ = 0, compression_ = 0, least_slip_ = 0;
  State x_{};
  std::array<Series, 7> terms_{};
  int stage_ = 0;  ///< compression, restitution, Poisson's rest, ended
  bool stopped_ = false;
};

}  // namespace clatter::oracle
