// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/damage_boundary.hpp"

#include <fmt/format.h>

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

std::optional<FragilePart> FragilePart::oscillator() const {
  if (kind == Kind::at_place) return std::nullopt;
  if (frequency > 0) return *this;
  return FragilePart{.frequency = 1 / (2 * duration), .fragility = 2 * fragility};
}

DamageBoundary damage_boundary(const FragilePart& part, PulseShape shape) {
  if (!(part.frequency > 0)) {
    const double velocity =
        part.kind == FragilePart::Kind::tested ? TestPulse{part.fragility, part.duration}.velocity() : 0;
    return {velocity, part.fragility, velocity};
  }
  const double velocity = part.fragility / (2 * pi * part.frequency);
  const bool rectangle = shape == PulseShape::rectangle;
  const double acceleration = part.fragility / (rectangle ? 2 : half_sine_largest);
  const double turns = rectangle ? 0.5 : half_sine_at;
  return {velocity, acceleration, pulse_area(shape) * acceleration * turns / part.frequency};
}

double margin(const FragilePart& part, PulseShape shape, double velocity, double acceleration) {
  if (!(part.frequency > 0)) {
    const DamageBoundary boundary = damage_boundary(part, shape);
    return std::fmax(boundary.critical_velocity / velocity, boundary.critical_acceleration / acceleration);
  }
  const double duration = velocity / (pulse_area(shape) * acceleration);
  return part.fragility / (acceleration * pulse_response(shape, part.frequency * duration));
}

BlowMargin blow_margin(const FragilePart& part, double velocity, double acceleration, double response) {
  const double rectangle = margin(part, PulseShape::rectangle, velocity, acceleration),
               half_sine = margin(part, PulseShape::half_sine, velocity, acceleration);
  const PulseShape shape = half_sine < rectangle ? PulseShape::half_sine : PulseShape::rectangle;
  const DamageBoundary boundary = damage_boundary(part, shape);
  // Left of the boundary's corner, on the ray of pulses of one duration, a part answers to the change of velocity.
  const bool by_velocity = velocity / acceleration < boundary.corner_velocity / boundary.critical_acceleration;
  const BlowMargin pulse{std::fmin(rectangle, half_sine),
                         by_velocity ? BlowMargin::By::velocity : BlowMargin::By::peak};
  const auto oscillator = part.oscillator();
  const BlowMargin itself{oscillator && response > 0 ? oscillator->fragility / response : pulse.value,
                          BlowMargin::By::history};
  return itself.value < pulse.value ? itself : pulse;
}

double velocity_margin(const FragilePart& part, double velocity) {
  return damage_boundary(part, PulseShape::rectangle).critical_velocity / velocity;
}

std::string words_of(const FragilePart& part) {
  const std::string peak = fmt::format("{:.6g}", part.fragility / standard_gravity);
  const std::string place = part.probe.empty() ? "" : " at " + part.probe;
  if (part.kind == FragilePart::Kind::at_place)
    return fmt::format("a part that bears {} g{}", peak, place.empty() ? " at its place" : place);
  if (part.kind == FragilePart::Kind::tested)
    return fmt::format("a part{} that bore a half sine of {} g and {:.6g} ms", place, peak, 1e3 * part.duration);
  if (!part.has_limit()) return fmt::format("a part of {:.6g} Hz{} without a limit", part.frequency, place);
  return fmt::format("a part of {:.6g} Hz{} that bears {} g", part.frequency, place, peak);
}

std::string part_text(const FragilePart& part) {
  const std::string peak = fmt::format("{:.9g}", part.fragility / standard_gravity);
  const std::string place = part.probe.empty() ? "" : part.probe + ":";
  if (part.kind == FragilePart::Kind::at_place) return place + peak + "g";
  if (part.kind == FragilePart::Kind::tested) return fmt::format("{}{}g:{:.9g}ms", place, peak, 1e3 * part.duration);
  if (!part.has_limit()) return fmt::format("{}{:.9g}Hz", place, part.frequency);
  return fmt::format("{}{:.9g}:{}", place, part.frequency, peak);
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
