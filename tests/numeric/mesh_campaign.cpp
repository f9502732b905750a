// SPDX-License-Identifier: GPL-3.0-or-later
// Random drops with friction: each face as one facet against the same body in a fine mesh, number by number, in units
// of the error bars.  Run on one core: build/full/tests/mesh_campaign [scenes [first [parts [seconds [laws]]]]]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "tests/numeric/bodies.hpp"
#include "tests/numeric/row_comparison.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr FrictionLaw laws[] = {FrictionLaw::coulomb, FrictionLaw::local, FrictionLaw::regularised};
constexpr const char* law_names[] = {"coulomb", "local", "regularised"};

struct Limits {
  int parts = 64;        ///< of the fine mesh, along each edge
  double seconds = 180;  ///< of one fine run; beyond it, half the parts
};

constexpr int impacts = 3;

struct Scene {
  bool is_rod = false;
  Vector3 size = Vector3::Zero();  ///< of a box [m]; a rod has length and radius in x and y
  int sectors = 16;                ///< of a rod
  World world;
  Accuracy accuracy;
  Drop drop;
  Vector3 more_spin = Vector3::Zero();  ///< body frame [rad/s]
  int law = 0;

  [[nodiscard]] Body body(int parts) const {
    const bool merge = parts == 1;
    if (!is_rod) return box_body(size, 0.1, parts, parts, parts, merge);
    return Body(
        rod_mesh(
            {.length = size.x(), .radius = size.y(), .mass = 0.1, .sectors = sectors, .rings = parts, .layers = parts}),
        merge);
  }
  [[nodiscard]] MotionState start(const Body& body) const {
    MotionState state = touching_state(body, drop);
    state.angular_velocity += more_spin;
    return state;
  }
};

/// Laws in turn, half of the scenes of each in the plane.
Scene random_scene(unsigned number) {
  std::mt19937 random(1000 + number);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto decades = [&](double low, double high) { return std::pow(10, draw(low, high)); };
  const auto chance = [&](double part) { return draw(0, 1) < part; };
  Scene scene;
  scene.law = static_cast<int>(number % 3);
  const bool planar = number / 3 % 2 == 0;
  scene.is_rod = chance(0.3);
  if (scene.is_rod) {
    scene.size = {decades(-1, 0), 0, 0};
    scene.size.y() = scene.size.x() * draw(0.01, 0.2);
    scene.sectors = chance(0.5) ? 8 : 16;
  } else {
    for (int i = 0; i < 3; ++i) scene.size[i] = decades(-2, -0.7);
  }
  Ground& ground = scene.world.ground;
  ground.stiffness = decades(7, 10);
  ground.damping = chance(0.3) ? 0 : ground.stiffness * draw(0, 0.15);
  ground.sliding_friction = draw(0.05, 1);
  ground.static_friction = ground.sliding_friction * (chance(0.5) ? 1 : draw(1, 1.4));
  ground.friction = laws[scene.law];
  ground.regularisation_speed = decades(-4, -1);
  ground.area = chance(0.5) ? AreaMeasure::surface : AreaMeasure::projected;
  scene.drop = {.inclination = (chance(0.3) ? draw(0, 8) : draw(0, 90)) * degree,
                .velocity = {draw(-2, 2), planar ? 0 : draw(-2, 2), -decades(-0.5, 0.7)},
                .spin = chance(0.3) ? 0 : draw(-40, 40),
                .out_of_plane_tilt = planar ? 0 : draw(-45, 45) * degree};
  if (!planar && chance(0.7)) scene.more_spin = {draw(-20, 20), 0, draw(-40, 40)};
  scene.world.planar = planar;
  scene.accuracy.digits = chance(0.5) ? 6 : 9;
  scene.world.gravity = chance(0.2) ? 0 : 9.81;
  return scene;
}

struct Fine {
  Simulation run;
  int parts = 0;
  double seconds = 0;
};

Fine fine_run(const Scene& scene, const Limits& limits, bool with_estimates) {
  using Clock = std::chrono::steady_clock;
  Fine fine;
  const Request request{.impacts = impacts, .error_estimates = with_estimates, .amplification = with_estimates};
  for (fine.parts = limits.parts;; fine.parts /= 2) {
    const Body body = scene.body(fine.parts);
    const Clock::time_point begin = Clock::now();
    const auto spent = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    Observer observer;
    if (fine.parts > 8 && !with_estimates) observer.progress = [&](int, long) { return spent() < limits.seconds; };
    fine.run = simulate(body, scene.world, scene.start(body), request, scene.accuracy, observer);
    fine.seconds = spent();
    if (fine.run.outcome != Outcome::interrupted) return fine;
  }
}

/// Counts over all scenes so far.
struct Totals {
  int scenes = 0, within = 0, within_one_bar = 0, halved = 0;
  int numbers = 0, numbers_within = 0, unknown = 0;
};

void run_scene(unsigned number, const Limits& limits, Totals& totals) {
  const Scene scene = random_scene(number);
  const Body whole = scene.body(1);
  const Simulation one = simulate(whole, scene.world, scene.start(whole), {.impacts = impacts}, scene.accuracy);
  Fine fine = fine_run(scene, limits, false);
  Comparison result = compare_rows(one, fine.run, false);
  const bool one_bar = result.alike && result.within == result.numbers;
  if (!one_bar) {  // the fine run's own bars are about as large, and cost more than the run
    for (std::size_t i = 0; i < std::min(one.impacts.size(), fine.run.impacts.size()); ++i) {
      fine.run.impacts[i].error = one.impacts[i].error;
    }
    result = compare_rows(one, fine.run, true);
  }
  if (result.within < result.numbers) {
    Limits same = limits;
    same.parts = fine.parts;
    fine.run = fine_run(scene, same, true).run;
    result = compare_rows(one, fine.run, true);
  }
  ++totals.scenes;
  totals.within += result.alike && result.within == result.numbers;
  totals.within_one_bar += one_bar;
  totals.halved += fine.parts < limits.parts;
  totals.numbers += result.numbers;
  totals.numbers_within += result.within;
  totals.unknown += result.unknown;
  fmt::print("{:3} {} {} {} digits {} parts {} rows {} {:.0f} s: {}/{} within{}, worst {:.2g} ({}){}\n", number,
             law_names[scene.law], scene.world.planar ? "planar" : "space", scene.is_rod ? "rod" : "box",
             scene.accuracy.digits, fine.parts, one.impacts.size(), fine.seconds, result.within, result.numbers,
             one_bar ? "" : " both bars", result.worst, result.worst_number, result.note);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto given = [&](int i, double otherwise) { return i < argc ? std::atof(argv[i]) : otherwise; };
  const unsigned scenes = static_cast<unsigned>(given(1, 200)), first = static_cast<unsigned>(given(2, 0));
  const Limits limits{.parts = static_cast<int>(given(3, 64)), .seconds = given(4, 180)};
  const std::string laws_asked = argc > 5 ? argv[5] : "";
  Totals totals;
  for (unsigned i = first; i < first + scenes; ++i) {
    if (!laws_asked.empty() && laws_asked.find(law_names[i % 3]) == std::string::npos) continue;
    try {
      run_scene(i, limits, totals);
    } catch (const std::exception& error) {
      ++totals.scenes;
      fmt::print("{:3} REFUSED {}\n", i, error.what());
    }
  }
  fmt::print(
      "scenes {}: all numbers within both bars in {}, within the one bar alone in {}; coarser fine mesh in {}; "
      "numbers {} of {}, {} more have no bar\n",
      totals.scenes, totals.within, totals.within_one_bar, totals.halved, totals.numbers_within, totals.numbers,
      totals.unknown);
}
