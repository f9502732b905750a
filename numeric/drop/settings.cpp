// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/drop/settings.hpp"

#include "numeric/base/errors.hpp"

namespace clatter::numeric {

using detail::require;

void World::validate() const {
  require(gravity >= 0, "world.gravity", gravity, "finite and at least 0");
  require(incline_deg > -90 && incline_deg < 90, "world.incline_deg", incline_deg, "above -90 and below 90 degrees");
  ground.validate();
}

void Request::validate() const {
  require(impacts >= 1, "run.impacts", impacts, "at least 1");
  if (until != std::numeric_limits<double>::infinity()) require(until >= 0, "run.until", until, "at least 0");
  double last = -std::numeric_limits<double>::infinity();
  for (const double time : times) {
    require(time >= last, "run.times", time, "finite and at least the time before it");
    require(time <= until, "run.times", time, "at most run.until");
    last = time;
  }
}

void Accuracy::validate() const {
  require(step >= 0, "run.step", step, "finite and at least 0");
  require(digits >= 2 && digits <= 12, "run.digits", digits, "from 2 to 12");
  require(tolerance == 0 || (tolerance >= least_tolerance && tolerance <= 0.1), "run.tolerance", tolerance,
          "0 or from 5e-14 to 0.1");
  require(evaluation_limit >= 1, "run.evaluation_limit", static_cast<double>(evaluation_limit), "at least 1");
  if (method == Method::tvd_rk3) require(tolerance == 0, "run.tolerance", tolerance, "left out for a fixed step");
  if (step > 0) {
    require(method == Method::automatic || method == Method::tvd_rk3, "run.step", step,
            "left out for an adaptive method, which chooses its own");
    require(tolerance == 0, "run.tolerance", tolerance, "left out for a fixed step");
  }
}

}  // namespace clatter::numeric
