// SPDX-License-Identifier: GPL-3.0-or-later
// A phone that falls on its corner from 1 m, through both models; the contact force over time as CSV.
#include <clatter/analytic.hpp>
#include <clatter/numeric.hpp>
#include <cmath>
#include <cstdio>
#include <exception>

int main() try {
  using namespace clatter;
  const double height = 1, gravity = 9.81;
  analytic::space::Drop drop;
  drop.body = analytic::space::make_box({.mass = 0.17, .length = 0.15, .width = 0.075, .thickness = 0.008});
  drop.attitude = Eigen::AngleAxisd(0.35, Eigen::Vector3d(2, 1, 0).normalized());
  drop.release_height = height + touch_height(drop.body, drop.attitude);
  drop.gravity = gravity;
  const analytic::space::Sequence sequence = impact_sequence(drop, {.impacts = 2});

  const numeric::Body body(numeric::box_mesh({.size = {0.15, 0.075, 0.008}, .mass = 0.17}));
  const numeric::World world{.ground = {.stiffness = 1e13}, .gravity = gravity};  // N/m³, no damping, no friction
  numeric::MotionState start = on_ground(body, {.attitude = drop.attitude});
  start.centre.z() += height;
  std::FILE* const csv = std::fopen("force.csv", "w");
  const auto write = [&](const numeric::HistorySample& at) { std::fprintf(csv, "%.9g,%.9g\n", at.time, at.force.z()); };
  const numeric::Simulation run = simulate(body, world, start, {.impacts = 2}, {.digits = 7}, {.history = write});
  std::fclose(csv);
  for (const std::string& warning : run.warnings) std::puts(warning.c_str());

  double gap = run.impacts.size() == sequence.rows.size() ? 0 : 1;
  for (std::size_t i = 0; i < run.impacts.size() && i < sequence.rows.size(); ++i) {
    const numeric::ImpactRecord& impact = run.impacts[i];
    const double impulse = sequence.rows[i].impulse().z();
    std::printf("%.5f N s | %.5f N s, %.0f +- %.1g N\n", impulse, impact.value.impulse.z(), impact.value.peak_force,
                impact.error.peak_force);
    gap = std::fmax(gap, std::fabs(impact.value.impulse.z() / impulse - 1));
  }
  return gap < 0.03 ? 0 : 1;             // less, the stiffer the ground
} catch (const std::exception& error) {  // what() says in one line which number is not valid and what is allowed
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
