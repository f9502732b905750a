// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of sums over a run.
#include "tests/support.hpp"
#include "validation/run/run.hpp"

using namespace clatter::validation;

BOOST_AUTO_TEST_CASE(sums_over_an_impact_that_cannot_be_predicted_are_unknown_whatever_its_own_bars) {
  Impact one;
  one.predictable = true;
  one.value.impulse[2] = one.value.energy_loss = one.value.peak_force = 2;
  one.error.impulse[2] = one.error.energy_loss = one.error.peak_force = 0.5;
  Run run;
  run.impacts = {one, one};
  const Totals known = totals(run);
  BOOST_TEST((known.predictable && known.normal_impulse.value == 4 && known.normal_impulse.error >= 1));
  BOOST_TEST((known.energy_loss.error < 1.1 && known.largest_peak.error < 1.1));
  run.impacts.push_back(one);
  run.impacts.back().predictable = false;
  const Totals unknown = totals(run);
  BOOST_TEST(!unknown.predictable);
  for (const Estimated& sum : {unknown.normal_impulse, unknown.energy_loss, unknown.last_start, unknown.largest_peak})
    BOOST_TEST(!std::isfinite(sum.error));
}
