// SPDX-License-Identifier: GPL-3.0-or-later
// The map of extremes: what each cell promises, and that a broken promise is seen.
#include <fmt/format.h>

#include <map>
#include <set>

#include "numeric/motion/free_rotation.hpp"
#include "tests/support.hpp"
#include "validation/evidence/extremes.hpp"
#include "validation/evidence/oracles.hpp"

namespace {

using namespace clatter::validation;
using clatter::analytic::Angle;
using clatter::analytic::Drop;
using clatter::analytic::Sequence;
constexpr double none = clatter::test::not_a_number;

constexpr LongRuns runs{.impacts = CLATTER_TEST_SLOW_BUILD ? 100 : 1000,
                        .discrete_scenes = CLATTER_TEST_SLOW_BUILD ? 3000 : 100'000,
                        .continuous_scenes = CLATTER_TEST_SLOW_BUILD ? 30 : 200};

// A cell has a second; the test gives it more, so that no test depends on a time, and prints what the slowest took.
constexpr double cell_seconds = 600;

const ExtremesMap& whole_map() {
  static const ExtremesMap map = measure_extremes({.axes = {}, .runs = runs, .cell_seconds = cell_seconds});
  return map;
}

CellMeasure measured(double error, double bound) {
  return {.error = error, .bound = bound, .oracle = "", .outcome = ""};
}

int status_of(const ExtremeCell& cell) {
  return map_status({.cells = {cell}, .regions = regions_of({cell}), .cell_seconds = 1});
}

int status_after(std::function<CellMeasure(const CellClock&)> work) {
  return status_of(fill_cell({{"angle", 1, "1", ModelLevel::discrete}, std::move(work)}, 1));
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_cell_ends_with_a_number_and_its_error_or_a_typed_refusal) {
  const ExtremesMap& map = whole_map();
  BOOST_TEST(map.cells.size() > 1000u);
  for (const std::string& failure : map_failures(map)) BOOST_ERROR(failure);
  BOOST_TEST(map_status(map) == 0);
  fmt::print("{} cells, the slowest {:.2f} s\n", map.cells.size(), slowest_cell(map)->seconds);
  for (const ExtremeCell& cell : map.cells) BOOST_TEST((cell.has_number() || !cell.reason.empty()));
}

BOOST_AUTO_TEST_CASE(every_axis_has_cells_of_both_continuous_models_and_of_the_discrete_one_where_it_has_the_quantity) {
  const std::set<std::string> of_one_model{"squares", "cubes", "disc", "needle", "slenderness", "bounces", "hops"};
  for (const MapAxis& axis : map_axes()) {
    if (of_one_model.contains(axis.name)) continue;
    for (const ModelLevel model : {ModelLevel::discrete, ModelLevel::planar, ModelLevel::spatial}) {
      if (axis.name == "ratio" && model != ModelLevel::discrete) continue;
      const auto here = std::ranges::count_if(
          whole_map().cells, [&](const ExtremeCell& cell) { return cell.axis == axis.name && cell.model == model; });
      BOOST_TEST(here >= (axis.name == "long" ? 1 : static_cast<long>(axis.values.size())), axis.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(tracked_squares_are_met_up_to_20_degrees_and_beyond_30_most_strike_with_more_than_one_corner) {
  for (const ExtremeCell& cell : whole_map().cells) {
    if (cell.axis != "squares") continue;
    if (cell.value < 20) {
      BOOST_TEST(cell.has_number(), cell.label);
      BOOST_TEST(cell.measure.error < 0.12, cell.label);
      BOOST_TEST(cell.measure.bound > 0.2, cell.label);
    }
    if (cell.value >= 30) BOOST_TEST((cell.verdict == CellVerdict::outside_model), cell.label);
  }
}

BOOST_AUTO_TEST_CASE(round_bodies_have_a_number_in_every_cell_from_flat_to_upright_and_from_discs_to_needles) {
  std::map<std::string, long> numbers;
  for (const ExtremeCell& cell : whole_map().cells) {
    if (cell.model == ModelLevel::discrete_in_space && cell.has_number()) ++numbers[cell.axis];
  }
  for (const char* axis : {"disc", "needle", "slenderness", "bounces", "hops"})
    BOOST_TEST(numbers[axis] == static_cast<long>(map_axis(axis).values.size()), axis);
}

BOOST_AUTO_TEST_CASE(regions_cover_all_cells_once_and_join_what_is_alike) {
  const ExtremesMap& map = whole_map();
  std::size_t next = 0;
  for (const MapRegion& region : map.regions) {
    BOOST_TEST(region.first == next);
    BOOST_TEST(region.most_digits - region.fewest_digits <= 1);
    next = region.last + 1;
  }
  BOOST_TEST(next == map.cells.size());
  BOOST_TEST(map.regions.size() < map.cells.size() / 3);
}

BOOST_AUTO_TEST_CASE(a_broken_cell_makes_status_1) {
  for (const auto& [error, bound, status] :
       {std::array{1e-16, 1e-15, 0.}, {1e-14, 1e-15, 1}, {none, 1, 1}, {0, none, 1}}) {
    BOOST_TEST(status_after([error = error, bound = bound](const CellClock&) { return measured(error, bound); }) ==
               status);
  }
  BOOST_TEST(status_after([](const CellClock&) -> CellMeasure { throw std::runtime_error("of no type"); }) == 1);
  BOOST_TEST(status_after([](const CellClock&) -> CellMeasure { throw std::domain_error("angle = 91"); }) == 0);
  ExtremeCell slow = whole_map().cells.front();
  slow.seconds = 1.5;
  BOOST_TEST(status_of(slow) == 1);
}

BOOST_AUTO_TEST_CASE(the_laws_of_motion_notice_a_row_that_is_off_by_1e_12) {
  const Drop drop{.body = clatter::analytic::make_rod({}),
                  .inclination = Angle::from_degrees(20),
                  .velocity = {.normal = -1, .tangential = 0, .angular = 0},
                  .gravity = 9.81,
                  .law = {}};
  const Sequence good = impact_sequence(drop, {.impacts = 6, .digits = 6, .amplification = false});
  BOOST_TEST(retrace(drop, good).residual <= 1e-14);
  for (int what = 0; what < 7; ++what) {
    Sequence bad = good;
    clatter::analytic::ImpactRow& row = bad.rows[2];
    double* const numbers[] = {&row.start,
                               &row.centre_height,
                               &row.impact.normal_impulse,
                               &row.impact.after.angular,
                               &row.flight.arrival.inclination,
                               &row.before.normal,
                               &row.impact.separation_speed};
    *numbers[what] *= 1 + 1e-12;
    BOOST_TEST(retrace(drop, bad).residual > 1e-13, what);
  }
  Sequence bad = good;
  bad.rows[1].impact.normal_impulse = none;
  BOOST_TEST(!(retrace(drop, bad).residual <= 1));
}

BOOST_AUTO_TEST_CASE(the_exact_rod_notices_an_angle_off_by_1e_12_and_an_impact_too_few) {
  const RodStart start{.angle_deg = 20, .parameters = {}};
  RodImpacts impacts = rod_impacts(contact_angles(Angle::from_degrees(20), {}));
  BOOST_TEST(rod_error(start, impacts).error <= 1e-15);
  impacts.angle[2] *= 1 + 1e-12;
  BOOST_TEST(rod_error(start, impacts).error >= 5e-13);
  impacts.count = 2;
  BOOST_TEST(!rod_error(start, impacts).ends_rightly);
  // Upright the rod does not turn, whatever the digits of π leave of its cosine.
  const auto impacts_at = [](double degrees) { return rod_impacts(contact_angles(Angle::from_degrees(degrees), {})); };
  const RodError upright = rod_error({.angle_deg = 90, .parameters = {}}, impacts_at(90));
  BOOST_TEST((upright.error <= 1e-15 && upright.ends_rightly));
  // 40° lies between the folds: two impacts.
  const RodImpacts two = impacts_at(40);
  BOOST_TEST(two.count == 2);
  BOOST_TEST(rod_error({.angle_deg = 40, .parameters = {}}, two).ends_rightly);
}

/// physics.md, section 3.
BOOST_AUTO_TEST_CASE(the_exact_restitution_has_the_known_values) {
  BOOST_TEST(static_cast<double>(exact_restitution(0)) == 1);
  BOOST_TEST(std::fabs(static_cast<double>(exact_restitution(0.1L)) - 0.937475579949905) <= 1e-15);
  BOOST_TEST(std::fabs(static_cast<double>(exact_restitution(1)) - 0.593624260040) <= 1e-12);
  BOOST_TEST(std::fabs(static_cast<double>(exact_restitution(1e300L)) * 1e300 - 1) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(a_million_turns_in_flight_keep_nine_digits_and_one_wrong_period_is_noticed) {
  const clatter::numeric::Vector3 moments(1, 2, 2.5), omega(0.5, 0, 0.7);
  const clatter::numeric::FreeRotation rotation(moments.asDiagonal(), {.angular_velocity = omega});
  const PeriodicSpin spin({1, 2, 2.5}, {0.5, 0, 0.7});
  const double time = 1e6 * 6.283185307179586 / omega.norm();
  BOOST_TEST(spin.error(rotation.at(time), time) <= 1e-9);
  BOOST_TEST(spin.error(rotation.at(time), time + 1e-6) >= 1e-7);
}

BOOST_AUTO_TEST_CASE(an_interrupted_map_keeps_its_cells_and_says_so) {
  const ExtremesMap map =
      measure_extremes({.axes = {"angle"}, .progress = [](std::size_t done, std::size_t) { return done < 5; }});
  BOOST_TEST(map.cells.size() == 5u);
  BOOST_TEST(map_status(map) == 130);
  BOOST_TEST(extremes_report(map).fields.at("message").text().find("interrupted") != std::string::npos);
}
