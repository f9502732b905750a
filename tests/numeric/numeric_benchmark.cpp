// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of the simulator: whole drops, single evaluations, and cost against error for each method.
// Run on one core: build/full/tests/numeric_benchmark
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

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

void time_drop(benchmark::State& state, const Drop1& drop) {
  long evaluations = 0;
  for (auto _ : state) {
    const Simulation simulation = run(drop);
    evaluations = simulation.force_evaluations;
    benchmark::DoNotOptimize(&simulation);
  }
  state.counters["evaluations"] = static_cast<double>(evaluations);
}

void rod_impact(benchmark::State& state) { time_drop(state, rod_drop()); }

void rod_impact_with_estimates(benchmark::State& state) {
  Drop1 drop = rod_drop();
  drop.request.error_estimates = drop.request.amplification = true;
  time_drop(state, drop);
}

void damped_phone_two_impacts(benchmark::State& state) { time_drop(state, phone_drop(1, 1, 1)); }

void damped_phone_two_impacts_with_estimates(benchmark::State& state) {
  Drop1 drop = phone_drop(1, 1, 1);
  drop.request.error_estimates = drop.request.amplification = true;
  time_drop(state, drop);
}

/// 2 (550·500 + 550·210 + 500·210) = 991,000 surface elements.  The solid inside would be 58 million; only the shell is
/// made, with the box's own mass and inertia.
const Drop1& million_phone() {
  static const std::unique_ptr<Drop1> drop = [] {
    const int n[3] = {550, 500, 210};
    const Vector3 size = phone_size();
    Surface surface;
    std::map<std::array<int, 3>, int> index;
    const auto node = [&](std::array<int, 3> at) {
      const auto [entry, is_new] = index.try_emplace(at, static_cast<int>(surface.nodes.size()));
      if (is_new) {
        surface.nodes.emplace_back(size.x() * (at[0] / double(n[0]) - 0.5), size.y() * (at[1] / double(n[1]) - 0.5),
                                   size.z() * (at[2] / double(n[2]) - 0.5));
      }
      return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const int side : {0, n[axis]}) {
        for (int i = 0; i < n[u]; ++i) {
          for (int j = 0; j < n[v]; ++j) {
            std::array<int, 4> corners{};
            for (int c = 0; c < 4; ++c) {
              std::array<int, 3> at{};
              at[static_cast<std::size_t>(axis)] = side;
              at[static_cast<std::size_t>(u)] = i + (c == 1 || c == 2 ? 1 : 0);
              at[static_cast<std::size_t>(v)] = j + (c >= 2 ? 1 : 0);
              corners[static_cast<std::size_t>(c)] = node(at);
            }
            if (side == 0) std::swap(corners[1], corners[3]);
            surface.elements.push_back({corners, static_cast<int>(surface.elements.size())});
          }
        }
      }
    }
    const MassProperties properties = mass_properties(box_mesh({.size = size, .mass = phone_mass}));
    Drop1 small = phone_drop(1, 1, 1);
    return std::make_unique<Drop1>(Drop1{Body(properties, surface), small.world, small.start, small.request});
  }();
  return *drop;
}

void damped_phone_with_a_million_surface_elements(benchmark::State& state) { time_drop(state, million_phone()); }

void contact_evaluation(benchmark::State& state) {
  const Body body = state.range(0) == 0 ? phone() : rod();
  const Ground ground{.stiffness = 1e9, .damping = 1e7};
  const MotionState touch = touching_state(body, {.inclination = 0.3});
  GroundView view;
  view.reference = {touch.attitude.conjugate() * Vector3::UnitZ(), touch.centre.z()};
  view.sink = -1e-4;
  view.vertical_speed = -1;
  ContactLoader loader(body, ground);
  for (auto _ : state) benchmark::DoNotOptimize(loader.load(view, {}));
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
  ContactLoader loader(body, ground);
  const SlipField field{.kind = SlipField::Kind::points, .regularisation = 1e-3};
  for (auto _ : state) {
    benchmark::DoNotOptimize(loader.load(view));
    benchmark::DoNotOptimize(loader.slip_load(view, field));
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

BENCHMARK(rod_impact)->Unit(benchmark::kMicrosecond);
BENCHMARK(rod_impact_with_estimates)->Unit(benchmark::kMicrosecond);
BENCHMARK(damped_phone_two_impacts)->Unit(benchmark::kMicrosecond);
BENCHMARK(damped_phone_two_impacts_with_estimates)->Unit(benchmark::kMicrosecond);
BENCHMARK(damped_phone_with_a_million_surface_elements)->Unit(benchmark::kMicrosecond);
BENCHMARK(contact_evaluation)->Arg(0)->Arg(1);
BENCHMARK(regularised_friction_evaluation);
BENCHMARK(touch_down_search)->Unit(benchmark::kMicrosecond);

double seconds(const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

/// Largest relative error of normal impulse and peak force, over the impacts.
double worst_error(const Simulation& run, const Simulation& reference) {
  double worst = 0;
  for (std::size_t i = 0; i < reference.impacts.size(); ++i) {
    const ImpactNumbers& exact = reference.impacts[i].value;
    if (i >= run.impacts.size()) return 1;
    const ImpactNumbers& n = run.impacts[i].value;
    worst = std::max(
        {worst, std::fabs(n.impulse.z() / exact.impulse.z() - 1), std::fabs(n.peak_force / exact.peak_force - 1)});
  }
  return worst;
}

/// Cost against error of every method.
void print_trade(const char* name, Drop1 drop) {
  drop.accuracy.digits = 12;
  const Simulation reference = run(drop);
  fmt::print("\n{}\n{:>9} {:>7} {:>12} {:>12} {:>10}\n", name, "method", "digits", "evaluations", "error", "time [us]");
  for (const auto& [method, title] : {std::pair{Method::tvd_rk3, "tvd-rk3"},
                                      {Method::rk4, "rk4"},
                                      {Method::rkf45, "rkf45"},
                                      {Method::rkck, "rkck"},
                                      {Method::rk8pd, "rk8pd"}}) {
    for (const int digits : {2, 3, 4, 6, 8, 10}) {
      if (method == Method::tvd_rk3 && digits > 8) continue;
      drop.accuracy.method = method;
      drop.accuracy.digits = digits;
      Simulation result;
      const double time = seconds([&] { result = run(drop); });
      fmt::print("{:>9} {:>7} {:>12} {:>12.1e} {:>10.0f}\n", title, digits, result.force_evaluations,
                 worst_error(result, reference), 1e6 * time);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  print_trade("Rod, 45 deg, one impact: cost against error", rod_drop());
  print_trade("Damped phone, two impacts: cost against error", phone_drop(1, 1, 1));
}
