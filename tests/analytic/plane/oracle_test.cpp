// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle of the thin rod judged on its own: against tables, and its derivatives against differences.

#include <map>

#include "tests/support.hpp"
#include "validation/oracles/reference_table.hpp"
#include "validation/oracles/rod_oracle.hpp"

namespace oracle = clatter::oracle;
using oracle::Digits150;
using oracle::Digits50;
using oracle::Quantity;

namespace {

/// The tables print 30 significant digits; the last may be rounded either way.
const Digits150 table_tolerance("1e-28");

const std::map<std::string, Quantity> columns = {
    {"beta_deg", oracle::beta},    {"gamma_deg", oracle::gamma},  {"P1", oracle::impulse_1},
    {"P2", oracle::impulse_2},     {"P3", oracle::impulse_3},     {"V1", oracle::velocity_1},
    {"Omega1", oracle::angular_1}, {"V2", oracle::velocity_2},    {"Omega2", oracle::angular_2},
    {"V3", oracle::velocity_3},    {"Omega3", oracle::angular_3}, {"T1", oracle::time_1},
    {"T2", oracle::time_2}};

/// Times are printed for contacts within 90° only.
bool within_upright(const oracle::RodSolution<Digits150>& solution, Quantity q) {
  if (q == oracle::time_1) return solution.second == oracle::Contact::other_end;
  if (q == oracle::time_2) return solution.third == oracle::Contact::other_end;
  return true;
}

void check_row(const oracle::ReferenceRow& row) {
  oracle::RodCase<Digits150> rod;
  rod.theta = oracle::radians(Digits150(row.at("theta_deg")));
  rod.gravity_number = Digits150(row.at("G"));
  const auto solution = oracle::solve_rod(rod);
  for (const auto& [name, quantity] : columns) {
    const auto& value = solution.quantities[quantity];
    const bool expected = value && within_upright(solution, quantity);
    BOOST_TEST_CONTEXT("theta " << row.at("theta_deg") << " G " << row.at("G") << ": " << name) {
      BOOST_TEST((row.count(name) == 1) == expected);
      if (!expected || row.count(name) == 0) continue;
      const Digits150 reference(row.at(name));
      const bool angle = quantity == oracle::beta || quantity == oracle::gamma;
      const Digits150 printed = angle ? oracle::radians(reference) : reference;
      BOOST_TEST(abs(value->value - printed) <= table_tolerance * abs(printed));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_rod_oracle_reproduces_the_tables_without_gravity_and_with_it) {
  for (const char* name : {"rod_sequence_no_gravity.csv", "rod_sequence_gravity.csv"}) {
    const auto rows = oracle::read_reference_table(std::string(CLATTER_TEST_DATA_DIR) + "/" + name);
    BOOST_TEST(rows.size() > 20U);
    for (const auto& row : rows) check_row(row);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_agree_with_central_differences) {
  const Digits50 step("1e-15"), tolerance("1e-25");  // error (h q‴/q)² ~ 1e-30 away from folds
  using Case = oracle::RodCase<Digits50>;
  const std::vector<std::pair<oracle::Parameter, Digits50 Case::*>> parameters = {
      {oracle::Parameter::theta, &Case::theta},
      {oracle::Parameter::gravity_number, &Case::gravity_number},
      {oracle::Parameter::restitution, &Case::restitution},
      {oracle::Parameter::impulse_ratio, &Case::impulse_ratio}};
  const Case rod{Digits50("0.4"), Digits50("0.5"), Digits50("0.9"), Digits50("0.1")};
  for (const auto& [parameter, field] : parameters) {
    Case above = rod, below = rod;
    above.*field = rod.*field * (1 + step);
    below.*field = rod.*field * (1 - step);
    const auto at = oracle::solve_rod(rod, 3, parameter);
    const auto high = oracle::solve_rod(above);
    const auto low = oracle::solve_rod(below);
    for (std::size_t q = 0; q < oracle::quantity_count; ++q) {
      BOOST_TEST_REQUIRE(at.quantities[q].has_value());
      const Digits50 difference = (high.quantities[q]->value - low.quantities[q]->value) / (2 * step * (rod.*field));
      const Digits50 scale = abs(at.quantities[q]->value / (rod.*field));
      BOOST_TEST(abs(at.quantities[q]->slope - difference) <= tolerance * scale);
    }
  }
}
