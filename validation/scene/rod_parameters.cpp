// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/rod_parameters.hpp"

#include <fmt/format.h>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation::inline scene {

analytic::RodParameters read_rod(const RodTexts& t) {
  analytic::RodParameters rod;
  const auto read = [](double& value, const char* option, const std::optional<std::string>& text, const Range& range) {
    if (text) value = read_number_option(option, *text, range);
  };
  if (t.gravity_number && t.gravity) {
    throw BadInput("--gravity-number and --gravity: give one of them, not both");
  }
  double gravity = 0, length = 1, speed = 1;
  read(gravity, "--gravity", t.gravity, not_negative_number);
  read(length, "--length", t.length, positive_number);
  read(speed, "--speed", t.speed, positive_number);
  rod.gravity_number = gravity / speed * length / speed;
  if (!(rod.gravity_number <= largest_number)) {
    throw BadInput("--gravity, --length, --speed: the gravity number g L/v_n^2 overflows");
  }
  read(rod.gravity_number, "--gravity-number", t.gravity_number, not_negative_number);
  read(rod.restitution, "--restitution", t.restitution, {0, 1, false, "from 0 to 1"});
  read(rod.impulse_ratio, "--impulse-ratio", t.impulse_ratio, any_number);
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

}  // namespace clatter::validation::inline scene
