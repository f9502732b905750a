// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/shortfall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/output/bad_input.hpp"
#include "validation/record/names.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation::inline scene {
std::string digits_shortfall(int asked, double achieved) {
  if (achieved <= std::pow(10.0, -asked)) return "";
  if (!std::isfinite(achieved)) return fmt::format("asked {} digits, achieved none of all impacts", asked);
  return fmt::format("asked {} digits, achieved {:.1f}", asked, std::max(-std::log10(achieved), 0.0));
}

double largest_error(const analytic::Sequence& sequence) {
  double worst = 0;
  for (const analytic::ImpactRow& row : sequence.rows) worst = std::max(worst, row.error.relative);
  if (!sequence.tail) return worst;
  const analytic::Tail& tail = *sequence.tail;
  if (tail.end_time > 0) worst = std::max(worst, tail.end_time_error / tail.end_time);
  if (tail.normal_impulse > 0) worst = std::max(worst, tail.normal_impulse_error / tail.normal_impulse);
  return worst;
}

double largest_error(const analytic::space::Sequence& sequence) {
  double time = 0, speed = 0, rate = 0, impulse = 0, worst = 0;
  for (const analytic::space::ImpactRow& row : sequence.rows) {
    time = std::max(time, row.start);
    speed = std::max({speed, row.before.velocity.norm(), row.impact.velocity_after.norm()});
    rate = std::max({rate, row.before.angular_velocity.norm(), row.impact.angular_velocity_after.norm(),
                     row.impact.velocity_after.norm() / row.corners.front().place.norm()});
    impulse = std::max(impulse, row.impact.impulse.norm());
  }
  const auto take = [&](double error, double size) {
    if (error > 0) worst = std::max(worst, size > 0 ? error / size : std::numeric_limits<double>::infinity());
  };
  for (const analytic::space::ImpactRow& row : sequence.rows) {
    const analytic::space::RowErrors& error = row.error;
    if (!error.predictable) return std::numeric_limits<double>::infinity();
    take(row.start > 0 ? error.start : 0, time);
    take(error.attitude, 1);
    take(error.impulse, impulse);
    take(error.velocity_after, speed);
    take(error.angular_velocity_after, rate);
  }
  return worst;
}

namespace {

template <class Sequence>
std::string shortfall_of(const Scene& scene, const Sequence& sequence) {
  if (is_cut_short(sequence.outcome)) return fmt::format("{}: {}", outcome_name(sequence.outcome), sequence.message);
  return scene.require_digits ? digits_shortfall(scene.accuracy.digits, largest_error(sequence)) : "";
}

}  // namespace

std::string shortfall(const Scene& scene, const analytic::Sequence& sequence) { return shortfall_of(scene, sequence); }

std::string shortfall(const Scene& scene, const analytic::space::Sequence& sequence) {
  return shortfall_of(scene, sequence);
}

void Shortfalls::add(const std::string& place, const std::string& why) {
  if (why.empty()) return;
  if (count_++ == 0) first_ = fmt::format("{}: {}", place, why);
}

int Shortfalls::status(long long all, const char* what) const {
  if (count_ == 0) return 0;
  say(fmt::format("{} of {} {} fall short; {}", count_, all, what, first_));
  return exit_status(FailureKind::not_computed);
}

int shortfall_status(analytic::Outcome outcome) {
  const bool outside = outcome == analytic::Outcome::outside_model;
  return exit_status(outside ? FailureKind::outside_model : FailureKind::not_computed);
}

}  // namespace clatter::validation::inline scene
