// One box through both models: the continuous one has the impulses of the discrete one, and peak forces besides.
#include <clatter/analytic.hpp>
#include <clatter/numeric.hpp>
#include <cmath>
#include <cstdio>

int main() {
  using namespace clatter;
  analytic::Drop drop;
  drop.body = analytic::make_box({.mass = 0.18, .length = 0.14, .width = 0.07, .thickness = 0.008});
  drop.inclination = analytic::Angle::from_degrees(30);
  drop.velocity.normal = -1;
  drop.gravity = 9.81;
  const analytic::Sequence sequence = impact_sequence(drop, {.impacts = 2});

  const numeric::Body body(numeric::box_mesh({.size = {0.14, 0.07, 0.008}, .mass = 0.18}));
  const numeric::World world{.ground = {.stiffness = 1e12}};  // [N/m³], without damping and friction
  const numeric::MotionState start = touching_state(body, {.inclination = drop.inclination.radians});
  const numeric::Simulation run = simulate(body, world, start, {.impacts = 2});
  for (const std::string& warning : run.warnings) std::puts(warning.c_str());

  double gap = run.impacts.size() == sequence.rows.size() ? 0 : 1;
  for (std::size_t i = 0; i < run.impacts.size() && i < sequence.rows.size(); ++i) {
    const double exact = sequence.rows[i].impulse().z();
    const numeric::ImpactNumbers& impact = run.impacts[i].value;
    std::printf("%.5f N s  %.5f N s  %.0f N\n", exact, impact.impulse.z(), impact.peak_force);
    gap = std::fmax(gap, std::fabs(impact.impulse.z() / exact - 1));
  }
  return gap < 0.01 ? 0 : 1;
}
