// SPDX-License-Identifier: GPL-3.0-or-later
// The oracles judged on their own: against tables, closed forms and each other.

#include <map>

#include "tests/support.hpp"
#include "validation/oracles/event_oracle.hpp"
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

const oracle::EventBody<long double> thin_rod{1, 1 / 12.0L, {{-0.5L, 0}, {0.5L, 0}}};

/// The simulation's impacts as the rod oracle names them.
oracle::Contact contact_of(const oracle::EventSequence<long double>& sequence, std::size_t impact) {
  if (sequence.impacts.size() <= impact) return oracle::Contact::none;
  return sequence.impacts[impact].vertex == sequence.impacts[impact - 1].vertex ? oracle::Contact::same_end
                                                                                : oracle::Contact::other_end;
}

/// The simulation does not tell on which side of the vertical the other end strikes.
oracle::Contact without_side(oracle::Contact contact) {
  return contact == oracle::Contact::beyond_upright ? oracle::Contact::other_end : contact;
}

void compare_oracles(const oracle::RodCase<long double>& rod) {
  // Both round in long double.  Rounding inside a flight grows like the condition number of the
  // whole, but not in proportion to it; a wrong contact would be wrong by far more.
  constexpr long double tolerance = 4096 * std::numeric_limits<long double>::epsilon();
  const oracle::EventLaw<long double> law{.restitution = rod.restitution,
                                          .friction = oracle::EventFriction::ratio,
                                          .friction_value = rod.impulse_ratio,
                                          .gravity = rod.gravity_number};
  const auto events = oracle::EventSimulation<long double>(thin_rod, {rod.theta, -1, 0, 0}, law).run(3, 0);
  if (events.close_call) return;
  const auto exact = oracle::solve_rod(rod);
  BOOST_TEST((contact_of(events, 1) == without_side(exact.second)));
  if (!exact.third) return;
  BOOST_TEST((contact_of(events, 2) == without_side(*exact.third)));
  if (*exact.third != oracle::Contact::other_end) return;
  const auto impulse = exact.quantities[oracle::impulse_3]->value;
  const auto allowed = tolerance * (1 + exact.condition(oracle::impulse_3));
  BOOST_TEST(std::abs(events.impacts[2].normal_impulse / impulse - 1) <= allowed);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_rod_oracle_reproduces_the_tables_without_gravity_and_with_it) {
  for (const char* name : {"rod_sequence_no_gravity.csv", "rod_sequence_gravity.csv"}) {
    const auto rows = oracle::read_reference_table(std::string(CLATTER_TEST_DATA_DIR) + "/" + name);
    BOOST_TEST(rows.size() > 20U);
    for (const auto& row : rows) check_row(row);
  }
}

BOOST_AUTO_TEST_CASE(the_small_angle_law_continues_the_direct_solution) {
  const oracle::SmallAngleLaw law({});
  const Digits150 theta("1e-20");
  const auto direct = oracle::solve_rod<Digits150>({theta, 0, 1, 0});
  const auto by_law = law.at(theta);
  for (std::size_t q = 0; q < oracle::quantity_count; ++q)
    BOOST_TEST(abs(by_law.quantities[q]->value / direct.quantities[q]->value - 1) < Digits150("1e-20"));
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

BOOST_AUTO_TEST_CASE(search_and_simulation_agree_on_random_rods) {
  clatter::test::Random random(2005);
  for (int i = 0; i < 1000; ++i) {
    oracle::RodCase<long double> rod;
    rod.theta = random(0, 1) * std::acos(-1.0L) / 2;
    rod.gravity_number = i % 3 == 0 ? 0 : random.decades(-3, 2);
    rod.restitution = i % 2 == 0 ? 1 : random(0.2, 1);
    rod.impulse_ratio = i % 5 == 0 ? 0 : random(-0.3, 0.3);
    compare_oracles(rod);
  }
}

BOOST_AUTO_TEST_CASE(a_square_box_on_its_corner_bounces_in_a_geometric_series) {
  const long double e = 0.6L, g = 2;
  const oracle::EventBody<long double> box{1, 1 / 6.0L, {{-0.5L, -0.5L}, {0.5L, -0.5L}, {-0.5L, 0.5L}, {0.5L, 0.5L}}};
  const long double balanced = std::acos(-1.0L) / 4;
  const oracle::EventLaw<long double> law{.restitution = e, .gravity = g};
  const auto sequence = oracle::EventSimulation<long double>(box, {balanced, -1, 0, 0}, law).run(4, 0);
  BOOST_TEST_REQUIRE(sequence.impacts.size() == 4U);
  // The corner is balanced to 1 ulp, so the box turns by a few ulp.
  constexpr long double tolerance = 100 * std::numeric_limits<long double>::epsilon();
  long double time = 0;
  long double speed = 1;
  for (const auto& impact : sequence.impacts) {
    BOOST_TEST(impact.vertex == 0U);
    BOOST_TEST(std::abs(impact.time - time) <= tolerance);
    BOOST_TEST(std::abs(impact.normal_impulse - (1 + e) * speed) <= tolerance);
    speed *= e;
    time += 2 * speed / g;
  }
}
