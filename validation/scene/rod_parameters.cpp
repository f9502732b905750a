// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/rod_parameters.hpp"

#include <fmt/format.h>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {

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
  if (!(of_gravity <= largest_number)) {
    throw BadInput("--gravity, --length, --speed: the gravity number g L/v_n^2 overflows");
  }
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

std::string rod_summary(const analytic::RodParameters& p) {
  return fmt::format("thin rod, m = L = |v_n| = 1, G = {}, e = {}, μᵢ = {}", shortest(p.gravity_number),
                     shortest(p.restitution), shortest(p.impulse_ratio));
}

}  // namespace clatter::validation
