// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/shortfall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "validation/output/bad_input.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {

std::string digits_shortfall(int asked, double achieved) {
  if (achieved <= std::pow(10.0, -asked)) return "";
  if (!std::isfinite(achieved)) return fmt::format("asked {} digits, achieved none of all impacts", asked);
  return fmt::format("asked {} digits, achieved {:.1f}", asked, std::max(-std::log10(achieved), 0.0));
}

namespace {

/// Whether impacts take energy along the normal.
bool takes_energy(const Scene& scene) {
  return restitution_law(scene) == analytic::RestitutionLaw::viscoelastic ? scene.world.ground.is_damped()
                                                                          : scene.impact.restitution.value_or(1) < 1;
}

}  // namespace

std::string shortfall(const Scene& scene, const Run& run) {
  if (run.is_cut_short) return fmt::format("{}: {}", run.outcome, run.message);
  if (scene.until_rest && run.outcome == std::string_view("impact-limit"))
    return fmt::format("not at rest after {} impacts{}", run.impacts.size(),
                       takes_energy(scene) ? "" : "; restitution 1 takes no energy");
  return scene.require_digits ? digits_shortfall(scene.accuracy.digits, run.relative_error) : "";
}

void Shortfalls::add(const std::string& place, const std::string& why) {
  if (why.empty()) return;
  if (count_++ == 0) first_ = fmt::format("{}: {}", place, why);
}

std::string Shortfalls::words(long long all, const char* what) const {
  return count_ == 0 ? "" : fmt::format("{} of {} {} fall short; {}", count_, all, what, first_);
}

int Shortfalls::status(long long all, const char* what) const { return status_of(words(all, what)); }

int status_of(const std::string& why, int status) {
  if (why.empty()) return 0;
  say(why);
  return status;
}

int shortfall_status(const Run& run) {
  return exit_status(run.leaves_model ? FailureKind::outside_model : FailureKind::not_computed);
}

}  // namespace clatter::validation
