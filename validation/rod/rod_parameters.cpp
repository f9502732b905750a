// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/rod/rod.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {

double Sweep::value(long long i) const {
  if (i == count - 1 && step == 0) return to;
  if (step > 0) return std::fmin(clean_step(from, step, i), to);
  const double part = static_cast<double>(i) / static_cast<double>(count - 1);
  if (logarithmic) return from * std::pow(to / from, part);
  return from + (to - from) * part;
}

Arguments range_arguments(RangeRequest& r, const std::string& what) {
  const char* const group = "Range";
  return {
      number_argument("--from", r.from, any_number, "X", "first " + what, group),
      number_argument("--to", r.to, any_number, "X", "last " + what, group),
      number_argument("--step", r.step, positive_number, "X", "step from one to the next", group),
      whole_argument("--count", r.count, 1, 100'000'000, "N", "or the number of values, both ends included", group)};
}

Sweep sweep_of(const RangeRequest& request, const SweepDefault& fallback, const Range& allowed) {
  Sweep sweep{.from = request.from.value_or(fallback.from), .to = request.to.value_or(fallback.to)};
  for (const auto& [option, value] : {std::pair{"--from", sweep.from}, std::pair{"--to", sweep.to}}) {
    if (!allowed.holds(value))
      throw BadInput(fmt::format("{} '{}': must be {}", option, shortest(value), allowed.allowed()));
  }
  if (!(sweep.from <= sweep.to)) {
    throw BadInput(
        fmt::format("--from {}: must not be greater than --to {}", shortest(sweep.from), shortest(sweep.to)));
  }
  if (request.step && request.count) {
    throw BadInput(
        fmt::format("--step {} and --count {}: give one of them, not both", shortest(*request.step), *request.count));
  }
  if (request.count) {
    sweep.count = *request.count;
    if (sweep.count == 1) sweep.to = sweep.from;
    return sweep;
  }
  sweep.step = request.step.value_or(fallback.step);
  const double steps = (sweep.to - sweep.from) / sweep.step;
  if (!(steps < 1e8)) throw BadInput(fmt::format("--step {}: more than 100000000 values", sweep.step));
  sweep.count = count_of_steps(steps);
  return sweep;
}

Arguments rod_arguments(RodRequest& r) {
  const char* const group = "Rod";
  return {number_argument("--gravity-number", r.gravity_number, not_negative_number, "G", "G = g L/v_n^2 (0)", group),
          number_argument("--gravity", r.gravity, not_negative_number, "M/S2",
                          "or gravity, with --length and --speed (0)", group),
          number_argument("--length", r.length, positive_number, "M", "of the rod, for --gravity (1)", group),
          number_argument("--speed", r.speed, positive_number, "M/S", "|v_n| at the first impact, for --gravity (1)",
                          group),
          number_argument("--restitution", r.restitution, {0, 1, false, "from 0 to 1"}, "E",
                          "coefficient of restitution, 0 to 1 (1)", group),
          number_argument("--impulse-ratio", r.impulse_ratio, any_number, "MU_I",
                          "Eq. 8's ratio of tangential to normal impulse (0)", group)};
}

analytic::RodParameters rod_parameters(const RodRequest& r) {
  if (r.gravity_number && r.gravity) throw BadInput("--gravity-number and --gravity: give one of them, not both");
  const double of_gravity = r.gravity.value_or(0) / r.speed * r.length / r.speed;
  if (!(of_gravity <= largest_number))
    throw BadInput("--gravity, --length, --speed: the gravity number g L/v_n^2 overflows");
  analytic::RodParameters rod;
  rod.gravity_number = r.gravity_number.value_or(of_gravity);
  rod.restitution = r.restitution;
  rod.impulse_ratio = r.impulse_ratio;
  return rod;
}

Value rod_fields(const analytic::RodParameters& p) {
  return Value::Fields{
      {"gravity_number", p.gravity_number}, {"restitution", p.restitution}, {"impulse_ratio", p.impulse_ratio}};
}

std::string rod_summary(const RodRequest& r) {
  const std::string rod = r.gravity
                              ? fmt::format("g = {} m/s², L = {} m, |vₙ| = {} m/s: G = {:.6g}", shortest(*r.gravity),
                                            shortest(r.length), shortest(r.speed), rod_parameters(r).gravity_number)
                              : fmt::format("m = L = |vₙ| = 1, G = {}", shortest(r.gravity_number.value_or(0)));
  return fmt::format("thin rod, {}, e = {}, μᵢ = {}", rod, shortest(r.restitution), shortest(r.impulse_ratio));
}

std::string ratio_warning(const analytic::RodParameters& p) {
  const double mu = p.impulse_ratio;
  if (mu == 0) return "";
  std::string where = "at every θ";
  // A ratio above the one that sticks, 3sc/(1 + 3s²) = 3t/(1 + 4t²) with t = tan θ, pushes along the slip.
  if (mu > 0 && mu < 0.75) {
    const double root = std::sqrt(9 - 16 * mu * mu);
    const auto degrees = [&](double over) { return std::atan(over / (8 * mu)) * analytic::degrees_per_radian; };
    where = fmt::format("below θ = {}° and above {}°", significant(degrees(3 - root), 3),
                        significant(degrees(3 + root), 3));
  }
  return fmt::format(
      "the impulse ratio pushes the contact along its slip in impact 1 {}{}; Eq. 8 takes it as given, clatter sequence "
      "--friction MU follows the slip",
      where, p.restitution == 1 ? ", and creates energy there" : "");
}

}  // namespace clatter::validation
