// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/law/viscoelastic.hpp"

#include <boost/math/special_functions/lambert_w.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"
#include "analytic/base/root_finder.hpp"

namespace clatter::analytic::detail {

double log1p_minus(double x) { return std::fabs(x) < 0.5 ? boost::math::log1pmx(x) : std::log1p(x) - x; }

}  // namespace clatter::analytic::detail

namespace clatter::analytic {

namespace {

using detail::refuse;

using detail::log1p_minus;

/// atanh(s) − s by its series for 0 <= s <= 1/2.
double atanh_minus(double s) {
  const double square = s * s;
  double sum = 0;
  for (int k = 53; k >= 3; k -= 2) sum = sum * square + 1.0 / k;
  return s * square * sum;
}

/// z = s − s e for small s, from ln[(1+s)/(1−s)] − 2s = ln(1+q) − q + q s, q = z/(1−s): each side is
/// of the order s³ and computed as such.
double small_difference(double s) {
  const double left = 2 * atanh_minus(s);
  double q = left / s;
  for (int i = 0; i < 5; ++i) {
    const double residual = log1p_minus(q) + q * s - left;
    q -= residual / (s - q / (1 + q));
  }
  return q * (1 - s);
}

/// y = s e from s − ln(1+s) = −y − ln(1−y); Lambert's function gives the start, and all digits for
/// large s, where its argument is far from the branch point −1/e.
double product(double s) {
  const double argument = -(1 + s) * std::exp(-(1 + s));
  double y = 1 + boost::math::lambert_w0(argument);
  if (s > 8) return y;
  const double left = log1p_minus(s);
  for (int i = 0; i < 2; ++i) y += (log1p_minus(-y) - left) * (1 - y) / y;
  return y;
}

constexpr double small = 0.5;  // above, 1 − e is no longer small against e

/// de/ds, from differentiating the equation of product().
double restitution_slope(double s, double e, double loss) {
  // d(s e)/ds = [s/(1+s)] (1−s e)/(s e); minus e, over s, with 1 − e² = loss (1+e).
  return (loss * (1 + e) / e - s * (1 + e)) / (s * (1 + s));
}

}  // namespace

double restitution_loss_of_damping(double s) {
  if (!(s >= 0)) refuse("damping number", s, "at least 0");
  if (s == 0) return 0;
  if (std::isinf(s)) return 1;
  if (s < small) return s < 1e-160 ? 2 * s / 3 : small_difference(s) / s;
  return 1 - product(s) / s;
}

double restitution_slope_of_damping(double s) {
  if (!(s > 1e-160)) return -2.0 / 3;
  if (std::isinf(s)) return 0;
  if (s < 1) return restitution_slope(s, restitution_of_damping(s), restitution_loss_of_damping(s));
  const double y = product(s);
  return (s / (1 + s) * ((1 - y) / y) - y / s) / s;
}

double restitution_of_damping(double s) {
  if (s >= small && !std::isinf(s)) return product(s) / s;
  return 1 - restitution_loss_of_damping(s);
}

double damping_of_restitution(double restitution) {
  if (!(restitution >= 0 && restitution <= 1)) refuse("restitution", restitution, "between 0 and 1");
  if (restitution == 1) return 0;
  if (restitution == 0) return std::numeric_limits<double>::infinity();
  const double loss = 1 - restitution;
  if (loss < 1e-12) return 1.5 * loss * (1 + loss * 4.0 / 3);  // next term below loss³
  const auto excess = [&](double s) -> detail::Sample {
    const double lost = restitution_loss_of_damping(s);
    const double kept = restitution_of_damping(s);
    const double value = lost < 0.5 ? loss - lost : kept - restitution;
    return {value, restitution_slope(s, kept, lost), 0};
  };
  const double limit = 1 / restitution;
  const double guess = std::fmin(loss * (1 + restitution / 2) / restitution, limit);
  return detail::bracketed_root(detail::FunctionView(excess), {0.9 * loss, limit}, guess, false).value;
}

namespace {

/// ψ(x) = −x − ln(1−x), x²/2 for small x.
double psi(double x) { return -log1p_minus(-x); }

/// x in [0, 1) with ψ(x) = y, by Newton's method for z = −ln(1−x), in which ψ is convex; the start
/// lies above.
double inverse_psi(double y) {
  double z = y + std::sqrt(2 * y);
  double x = -std::expm1(-z);
  for (int i = 0; i < 60; ++i) {
    const double value = z < 0.5 ? psi(x) : z - x;  // x rounds to 1 for large z
    const double step = (value - y) / x;
    if (!(step > 2 * std::numeric_limits<double>::epsilon() * z)) break;
    z -= step;
    x = -std::expm1(-z);
  }
  return x;
}

}  // namespace

double stored_work(double damping_per_stiffness, const ImpulseStretch<>& stretch) {
  const double a = damping_per_stiffness * stretch.from;
  const double d = damping_per_stiffness * (stretch.to - stretch.from);
  const double mean = (stretch.from + stretch.to) / 2;
  // Over so short a stretch u/(1 − τu) is linear to rounding; for smaller d its ψ would underflow.
  if (std::fabs(d) < std::numeric_limits<double>::epsilon()) return -mean / (1 - a) * stretch.length;
  // [ψ(a+d) − ψ(a)]/d without its cancellation for small d.
  const double mean_rate = a / (1 - a) - log1p_minus(-d / (1 - a)) / d;
  return -mean_rate / damping_per_stiffness * stretch.length;
}

double separation_speed(double damping_per_stiffness, const Unloading<>& unloading) {
  const double square = unloading.from * unloading.from + 2 * unloading.slope * unloading.work;
  const double elastic = std::sqrt(std::fmax(square, 0.0));
  if (damping_per_stiffness * elastic < std::numeric_limits<double>::epsilon()) return elastic;
  const double gain = unloading.slope * damping_per_stiffness * damping_per_stiffness * unloading.work;
  const double target = psi(damping_per_stiffness * unloading.from) + gain;
  return target > 0 ? inverse_psi(target) / damping_per_stiffness : 0;
}

}  // namespace clatter::analytic
