// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of the simulator: whole drops and single evaluations.  notebooks-data/tradeoff.py has cost against error.
// Run on one core: build/full/tests/numeric_benchmark
#include <benchmark/benchmark.h>

#include <cmath>

#include "numeric/contact/contact_load.hpp"
#include "numeric/motion/free_flight.hpp"
#include "tests/numeric/bodies.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

struct Drop1 {
  Body body;
  World world;
  MotionState start;
  Request request = plain;
  Accuracy accuracy = {};
};

MotionState dropped_from(const Body& body, double angle, double height) {
  MotionState state = touching_state(body, {.inclination = angle * degree});
  state.velocity = {0, 0, -std::sqrt(2 * 9.81 * (height - state.centre.z()))};
  return state;
}

/// One impact of the paper's rod at 45° and k_G = 1e11.
Drop1 rod_drop() {
  Drop1 drop{rod(), weightless({.stiffness = 1e11}), {}};
  drop.start = touching_state(drop.body, {.inclination = 45 * degree});
  return drop;
}

/// Two impacts of the damped phone with friction; n hexahedra along its three edges.
Drop1 phone_drop(int nx, int ny, int nz) {
  Drop1 drop{phone(nx, ny, nz),
             {.ground = {.stiffness = 1e8, .damping = 1e7, .static_friction = 0.075, .sliding_friction = 0.075}},
             {},
             plain_impacts(2)};
  drop.start = dropped_from(drop.body, 10, 1);
  return drop;
}

Simulation run(const Drop1& drop) { return simulate(drop.body, drop.world, drop.start, drop.request, drop.accuracy); }

/// Argument: whether errors are estimated.
void time_drop(benchmark::State& state, Drop1 drop) {
  drop.request.error_estimates = drop.request.amplification = state.range(0) != 0;
  long evaluations = 0;
  for (auto _ : state) {
    const Simulation simulation = run(drop);
    evaluations = simulation.force_evaluations;
    benchmark::DoNotOptimize(&simulation);
  }
  state.counters["evaluations"] = static_cast<double>(evaluations);
}

void rod_impact(benchmark::State& state) { time_drop(state, rod_drop()); }
void damped_phone_two_impacts(benchmark::State& state) { time_drop(state, phone_drop(1, 1, 1)); }

void contact_evaluation(benchmark::State& state) {
  const Body body = state.range(0) == 0 ? phone() : rod();
  const Ground ground{.stiffness = 1e9, .damping = 1e7};
  const MotionState touch = touching_state(body, {.inclination = 0.3});
  GroundView view;
  view.reference = {touch.attitude.conjugate() * Vector3::UnitZ(), touch.centre.z()};
  view.sink = -1e-4;
  view.vertical_speed = -1;
  const auto loader = facet_surface(body, ground);
  for (auto _ : state) benchmark::DoNotOptimize(loader->load(view));
}

/// A face that lies almost flat and spins about a point of it.
void regularised_friction_evaluation(benchmark::State& state) {
  const Body body = phone();
  const Ground ground{.stiffness = 1e9, .damping = 1e7, .static_friction = 0.3, .sliding_friction = 0.3};
  const MotionState touch = touching_state(body, {.inclination = 0.01, .out_of_plane_tilt = 0.005});
  GroundView view;
  view.reference = {touch.attitude.conjugate() * Vector3::UnitZ(), touch.centre.z()};
  view.sink = -1e-3;
  view.vertical_speed = -0.1;
  view.angular_velocity = Vector3(2, -1, 30);
  view.east_speed = 0.2;
  const auto loader = facet_surface(body, ground);
  const SlipField field{.kind = SlipField::Kind::points, .regularisation = 1e-3};
  for (auto _ : state) {
    benchmark::DoNotOptimize(loader->load(view));
    benchmark::DoNotOptimize(loader->slip_load(view, field));
  }
}

void touch_down_search(benchmark::State& state) {
  const Body body = phone();
  MotionState start;
  start.centre.z() = 0.3;
  start.velocity.z() = 2;
  start.angular_velocity = Vector3(3, 40, 5);
  for (auto _ : state) benchmark::DoNotOptimize(next_touch_down(body, FreeFlight(body, start, 9.81)));
}

BENCHMARK(rod_impact)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(damped_phone_two_impacts)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(contact_evaluation)->Arg(0)->Arg(1);
BENCHMARK(regularised_friction_evaluation);
BENCHMARK(touch_down_search)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
