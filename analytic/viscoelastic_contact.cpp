// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/viscoelastic_contact.hpp"

#include <cmath>
#include <limits>

#include "analytic/detail/log1p_minus.hpp"

namespace clatter::analytic {
namespace {

using detail::log1p_minus;

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
