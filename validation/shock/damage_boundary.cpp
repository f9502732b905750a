// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/damage_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::validation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_sine_largest = 1.7684576539936718;  ///< of pulse_response(), and where; mpmath, 30 digits
constexpr double half_sine_at = 0.80993678514945079;

/// β = Ω/ω = 1/(2 f T).  During the pulse turns of sin Ωt − β sin ωt lie where cos Ωt = cos ωt: ωt = 2πk/(1 ± β).
double half_sine_response(double turns) {
  const double beta = 1 / (2 * turns), scale = 1 - beta * beta;
  constexpr double close = 1e-6;  // of resonance of the two: there the closed forms are 0/0, and the response is flat
  if (std::fabs(scale) < close)
    return (half_sine_response(turns * (1 - close)) + half_sine_response(turns * (1 + close))) / 2;
  double largest = std::fabs(2 * beta * std::cos(pi * turns) / scale);  // of what rings on
  const double end = 2 * pi * turns;                                    // ωT
  const auto note = [&](double at) {
    if (at > 0 && at < end) largest = std::max(largest, std::fabs((std::sin(beta * at) - beta * std::sin(at)) / scale));
  };
  for (int k = 1; k <= turns + 1; ++k) {
    note(2 * pi * k / (1 + beta));
    note(2 * pi * k / std::fabs(1 - beta));
  }
  return largest;
}

}  // namespace

double pulse_area(PulseShape shape) { return shape == PulseShape::rectangle ? 1 : 2 / pi; }

double pulse_response(PulseShape shape, double turns) {
  if (shape == PulseShape::rectangle) return turns >= 0.5 ? 2 : 2 * std::sin(pi * turns);
  constexpr double quasi_static = 1e4;  // beyond it 1 + O(1/(f T)): within 5e-5, and of no part that is fragile
  return turns > quasi_static ? 1 : half_sine_response(turns);
}

DamageBoundary damage_boundary(const FragilePart& part, PulseShape shape) {
  const double velocity = part.fragility / (2 * pi * part.frequency);
  const bool rectangle = shape == PulseShape::rectangle;
  const double acceleration = part.fragility / (rectangle ? 2 : half_sine_largest);
  const double turns = rectangle ? 0.5 : half_sine_at;
  return {velocity, acceleration, pulse_area(shape) * acceleration * turns / part.frequency};
}

double margin(const FragilePart& part, PulseShape shape, double velocity, double acceleration) {
  const double duration = velocity / (pulse_area(shape) * acceleration);
  return part.fragility / (acceleration * pulse_response(shape, part.frequency * duration));
}

double TestPulse::velocity() const { return pulse_area(PulseShape::half_sine) * acceleration * duration; }

double TestPulse::height(double restitution) const {
  const double approach = velocity() / (1 + restitution);
  return approach * approach / (2 * standard_gravity);
}

TestPulse equivalent_pulse(double velocity, double acceleration) {
  return {acceleration, velocity / (pulse_area(PulseShape::half_sine) * acceleration)};
}

const std::array<ServiceCondition, 8>& service_conditions() {
  static const std::array<ServiceCondition, 8> all{{{'H', {2900 * standard_gravity, 0.3e-3}},
                                                    {'G', {2000 * standard_gravity, 0.4e-3}},
                                                    {'B', {1500 * standard_gravity, 0.5e-3}},
                                                    {'F', {900 * standard_gravity, 0.7e-3}},
                                                    {'A', {500 * standard_gravity, 1.0e-3}},
                                                    {'E', {340 * standard_gravity, 1.2e-3}},
                                                    {'D', {200 * standard_gravity, 1.5e-3}},
                                                    {'C', {100 * standard_gravity, 2.0e-3}}}};
  return all;
}

char covering_condition(double velocity, double acceleration) {
  char name = '-';
  for (const ServiceCondition& condition : service_conditions()) {
    if (condition.pulse.velocity() >= velocity && condition.pulse.acceleration >= acceleration) name = condition.name;
  }
  return name;
}

}  // namespace clatter::validation
