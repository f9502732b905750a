// SPDX-License-Identifier: GPL-3.0-or-later
// The claims C1 to C8: what the discrete model of the thin rod shows, each with a number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/verify/check.hpp"
#include "validation/verify/elastic_rod.hpp"
#include "validation/verify/fold.hpp"
#include "validation/verify/reference.hpp"

namespace clatter::validation::inline verify {
namespace {

using analytic::ContactAngles;
using analytic::degrees_per_radian;

Measured second_is_twice(CaseRuns&) {
  const ContactAngles at = elastic_angles(1e-6);
  const double ratio = at.impulse[1] / at.impulse[0];
  const double ten = elastic_angles(10).impulse[1] / elastic_angles(10).impulse[0];
  return {ratio, std::fabs(ratio - 2), holds_if(std::fabs(ratio - 2) < 1e-9),
          fmt::format("at 1e-6°; at 10° still {}", number(ten))};
}

Measured equal_impulses(CaseRuns&) {
  double low = 50, high = 58;
  const auto excess = [](double degrees) {
    const ContactAngles at = elastic_angles(degrees);
    return at.impulse[1] - at.impulse[0];
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0 ? low : high) = middle;
  }
  const double exact = std::acos(1 / std::sqrt(3.0)) * degrees_per_radian;
  return {low, std::fabs(low - exact) / exact, rounds_to(low, 54.74, 0.01), "P₁ = P₂ = 1 there"};
}

Measured second_angle(CaseRuns&) {
  const double small = 1e-6, equal = std::acos(1 / std::sqrt(3.0)) * degrees_per_radian;
  const double ratio = elastic_angles(small).beta.angle * degrees_per_radian / small;
  const double there = elastic_angles(equal).beta.angle * degrees_per_radian / equal;
  return {ratio, std::max(std::fabs(ratio - 0.5), std::fabs(there - 1)), holds_if(std::fabs(ratio - 0.5) < 1e-9),
          fmt::format("β/θ at 1e-6°; at 54.7356° it is {}", number(there, 12))};
}

Measured last_second_impact(CaseRuns&) {
  const double boundary = regime_boundary(analytic::ImpactNumber::second, {}).theta * degrees_per_radian;
  const double exact = second_impact_fold() * degrees_per_radian;
  return {boundary, std::fabs(boundary - exact) / exact, rounds_to(boundary, 58, 1), "a grazing fold, 58° rounded"};
}

Measured last_third_impact(CaseRuns&) {
  const double boundary = regime_boundary(analytic::ImpactNumber::third, {}).theta * degrees_per_radian;
  constexpr double known = 27.577809606636;  // from an independent computation in 60 digits
  return {boundary, std::fabs(boundary - known) / known, rounds_to(boundary, 27, 1),
          "a grazing fold; rounded it is 28°"};
}

Measured two_one_two(CaseRuns&) {
  const double theta = 1e-6;
  const ContactAngles at = elastic_angles(theta);
  const double beta = at.beta.angle * degrees_per_radian / theta, gamma = at.gamma.angle * degrees_per_radian / theta;
  return {2 * beta, std::max(std::fabs(beta - 0.5), std::fabs(gamma - 1)), holds_if(std::fabs(gamma - 1) < 1e-9),
          fmt::format("θ:β:γ = 2:{}:{} at 1e-6°", number(2 * beta, 10), number(2 * gamma, 10))};
}

Measured sum_of_three(CaseRuns&) {
  const auto sum = [](const ContactAngles& at) { return at.impulse[0] + at.impulse[1] + at.impulse[2]; };
  const double small = sum(elastic_angles(1e-6));
  return {sum(elastic_angles(10)), std::fabs(small - 2), holds_if(std::fabs(small - 2) < 1e-9),
          fmt::format("2 for θ → 0, flat landing 2; at 10° and at 25° {}", number(sum(elastic_angles(25)), 6))};
}

/// The paper does not give the G of Fig. 11; v_n = −1 and g = 9.81 of its text make it 9.81.
Measured gravity_changes_little(CaseRuns&) {
  const double free = elastic_angles(20).beta.angle, text = elastic_angles(20, 9.81).beta.angle;
  double error = 0, tenth = 0;
  for (const ReferenceRow& row : reference_table(ReferenceTable::gravity)) {
    if (row.at("theta_deg") != 20) continue;
    const double beta = elastic_angles(20, row.at("G")).beta.angle * degrees_per_radian;
    error = std::max(error, std::fabs(beta / row.at("beta_deg") - 1));
    if (row.at("G") == 0.1) tenth = beta;
  }
  return {text / free, error, Answer::ambiguous,
          fmt::format("β at 20°: {}° without gravity; {}° for G = 0.1 (a phone from 1 m has 0.05), {}° for the text's "
                      "G = 9.81: little or most of it, the paper does not say which G",
                      number(free * degrees_per_radian), number(tenth), number(text * degrees_per_radian))};
}

}  // namespace

void add_angle_claim_measures(Measures& measures) {
  measures["C1"] = second_is_twice;
  measures["C2"] = equal_impulses;
  measures["C3"] = second_angle;
  measures["C4"] = last_second_impact;
  measures["C5"] = last_third_impact;
  measures["C6"] = two_one_two;
  measures["C7"] = sum_of_three;
  measures["C8"] = gravity_changes_little;
}

}  // namespace clatter::validation::inline verify
