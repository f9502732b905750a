// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of sums over a run and of the difference of both models.
#include "tests/support.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/run/run.hpp"

using namespace clatter::validation;

namespace {

Impact impact(bool predictable) {
  Impact one;
  one.predictable = predictable;
  one.value.impulse[2] = one.value.energy_loss = one.value.peak_force = 2;
  one.error.impulse[2] = one.error.energy_loss = one.error.peak_force = 0.5;
  return one;
}

}  // namespace

BOOST_AUTO_TEST_CASE(sums_over_an_impact_that_cannot_be_predicted_are_unknown_whatever_its_own_bars) {
  Run run;
  run.impacts = {impact(true), impact(true)};
  const Totals known = totals(run);
  BOOST_TEST((known.predictable && known.normal_impulse.value == 4 && known.normal_impulse.error >= 1));
  BOOST_TEST((known.energy_loss.error < 1.1 && known.largest_peak.error < 1.1));
  run.impacts.push_back(impact(false));
  const Totals unknown = totals(run);
  BOOST_TEST(!unknown.predictable);
  for (const Estimated& sum : {unknown.normal_impulse, unknown.energy_loss, unknown.last_start, unknown.largest_peak})
    BOOST_TEST(!std::isfinite(sum.error));
}

BOOST_AUTO_TEST_CASE(a_deviation_has_the_errors_of_both_models) {
  ComparedImpact compared;
  compared.discrete.emplace();
  compared.continuous.emplace();
  (*compared.discrete)[0] = 1;
  (*compared.continuous)[0] = 3;
  compared.discrete_error[0] = 0.25;
  compared.continuous_error[0] = 0.5;
  const Estimated deviation = NumberPair{compared, 0}.deviation_number();
  BOOST_TEST(deviation.value == 2);
  BOOST_TEST((deviation.error >= 0.75 && deviation.error < 0.75001));
}
