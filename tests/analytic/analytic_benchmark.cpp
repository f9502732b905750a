// SPDX-License-Identifier: GPL-3.0-or-later
// Speed of the discrete model.  Not a test.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "analytic/batch/batch.hpp"
#include "analytic/batch/lane_kernels.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/body.hpp"
#include "analytic/space/landing/tilted_outcomes.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"

namespace {

using namespace clatter::analytic;

std::vector<Angle> angles_up_to(double degrees) {
  std::vector<Angle> angles;
  for (int i = 1; i <= 4096; ++i) angles.push_back(Angle::from_degrees(degrees * i / 4096));
  return angles;
}

/// First and second impact with the root between them.
void second_contact_angle(benchmark::State& state) {
  const auto angles = angles_up_to(58.48);
  std::vector<int> evaluations;
  for (const Angle& angle : angles) evaluations.push_back(contact_angles(angle, {}).beta.evaluations);
  std::sort(evaluations.begin(), evaluations.end());
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(contact_angles(angles[i++ % angles.size()], {}));
  state.counters["evaluations_median"] = evaluations[evaluations.size() / 2];
  state.counters["evaluations_most"] = evaluations.back();
}
BENCHMARK(second_contact_angle);

/// Argument: whether errors are followed.
void three_impact_sequence(benchmark::State& state) {
  const Drop drop{.body = make_rod({}),
                  .inclination = Angle::from_degrees(10),
                  .velocity = {.normal = -1},
                  .gravity = 0,
                  .law = {}};
  const SequenceOptions options{.impacts = 3, .amplification = state.range(0) != 0};
  for (auto _ : state) benchmark::DoNotOptimize(impact_sequence(drop, options));
}
BENCHMARK(three_impact_sequence)->Arg(0)->Arg(1);

void three_impact_box_with_gravity_and_friction(benchmark::State& state) {
  const Drop drop{.body = make_box({.mass = 0.088, .length = 0.106, .width = 0.044, .thickness = 0.019}),
                  .inclination = Angle::from_degrees(10),
                  .velocity = {.normal = -4.4},
                  .gravity = 9.81,
                  .law = {.restitution = 0.8, .friction = FrictionKind::coulomb, .friction_value = 0.075}};
  for (auto _ : state) benchmark::DoNotOptimize(impact_sequence(drop, {.impacts = 3, .amplification = false}));
}
BENCHMARK(three_impact_box_with_gravity_and_friction);

/// Three impacts of 4096 drops at once, for each instruction set; the time of one is items_per_second's inverse.
void batch_of_drops(benchmark::State& state, const PlanarBody& body, double gravity, double least_restitution) {
  const auto kernels = batch::kernels();
  const auto& kernel = kernels[std::min<std::size_t>(static_cast<std::size_t>(state.range(0)), kernels.size() - 1)];
  std::vector<double> angle, restitution;
  for (int i = 0; i < 4096; ++i) {
    angle.push_back((i + 0.5) / 4096 * pi / 2);
    restitution.push_back(least_restitution + (1 - least_restitution) * (i % 64) / 64);
  }
  const std::vector<double> fall{-1}, still{0}, g{gravity};
  const BatchDrops drops{body, angle, fall, still, still, g, restitution, still};
  std::vector<BatchOutcome> outcomes(angle.size());
  for (auto _ : state) {
    run_batch(drops, {.limit = 3}, 0, outcomes, kernel.run);
    benchmark::DoNotOptimize(outcomes.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(angle.size()));
  state.SetLabel(kernel.name);
}
BENCHMARK_CAPTURE(batch_of_drops, elastic_rod, make_rod({}), 0, 1)->DenseRange(0, 2);
BENCHMARK_CAPTURE(batch_of_drops, rod_with_restitution, make_rod({}), 0, 0.3)->DenseRange(0, 2);
BENCHMARK_CAPTURE(batch_of_drops, rod_with_gravity, make_rod({}), 1, 1)->DenseRange(0, 2);
BENCHMARK_CAPTURE(batch_of_drops, box, make_box({.length = 0.15, .thickness = 0.03}), 0, 0.5)->DenseRange(0, 2);

void fold_angle(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(regime_boundary(ImpactNumber::second, {}));
}
BENCHMARK(fold_angle);

/// Random corners in space, each with the restitution laws in turn.
void corner_in_space(benchmark::State& state, double most_friction) {
  clatter::oracle::Random random(3);
  std::vector<clatter::oracle::Collision> collisions;
  std::vector<ImpactLaw> laws;
  for (int i = 0; i < 1024; ++i) {
    collisions.push_back(clatter::oracle::random_collision(random));
    laws.push_back(clatter::oracle::random_law(random, most_friction));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& c = collisions[i % collisions.size()];
    benchmark::DoNotOptimize(space::strike(c.body, c.before, c.place, laws[i++ % laws.size()]));
  }
}
void frictionless_corner_in_space(benchmark::State& state) { corner_in_space(state, 0); }
BENCHMARK(frictionless_corner_in_space);
void corner_with_friction_in_space(benchmark::State& state) { corner_in_space(state, 1); }
BENCHMARK(corner_with_friction_in_space);

/// A box of a phone's shape that lands on its corner.
space::Drop phone_corner(double friction) {
  space::Drop drop;
  drop.body = space::box(0.18, {.size = {0.14, 0.07, 0.008}});
  drop.attitude = space::Quaternion(0.76, 0.19, -0.51, 0.36);
  drop.velocity = {0.9, 0.2, -1.7};
  drop.angular_velocity = {2, 3, -1};
  drop.gravity = 9.81;
  if (friction > 0) {
    drop.law = {.restitution = 0.8,
                .law = RestitutionLaw::stronge,
                .friction = FrictionKind::coulomb,
                .friction_value = friction};
  }
  return drop;
}

/// A frictionless corner impact in space and the flight to the next.
void space_impact_and_flight(benchmark::State& state) {
  const space::Drop drop = phone_corner(0);
  const auto s = space::impact_sequence(drop, {.impacts = 2, .amplification = false});
  const space::State before = s.rows[0].before;
  const space::Corner corner = s.rows[0].corners[0];
  const space::PrincipalAxes principal(drop.body.inertia);
  for (auto _ : state) {
    const space::Impact impact = space::strike(drop.body, before, corner.place, drop.law);
    space::State after = before;
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
    const space::FreeFlight flight(principal, after, drop.gravity);
    const space::Touch touch{corner.index, impact.contact_after.z()};
    benchmark::DoNotOptimize(space::first_contact(drop.body, flight, {&touch, 1}));
  }
}
BENCHMARK(space_impact_and_flight);

/// Three impacts of a box in space; argument: hundredths of the friction coefficient, then whether errors are followed.
void space_sequence(benchmark::State& state) {
  const space::Drop drop = phone_corner(static_cast<double>(state.range(0)) / 100);
  const SequenceOptions options{.impacts = 3, .amplification = state.range(1) != 0};
  for (auto _ : state) benchmark::DoNotOptimize(space::impact_sequence(drop, options));
}
BENCHMARK(space_sequence)->Args({0, 0})->Args({0, 1})->Args({30, 0})->Args({30, 1});

/// A body that lands level as it stands, without a spin.
space::Drop level(const space::Body& body, double friction, double restitution = 0.5) {
  space::Drop drop;
  drop.body = body;
  drop.velocity = {0, 0, -1};
  drop.law = {.restitution = restitution, .friction = FrictionKind::coulomb, .friction_value = friction};
  return drop;
}
space::Body phone() { return space::box(0.18, {.size = {0.14, 0.07, 0.008}}); }
/// Corners far apart for its inertia strike one another again and again.
space::Body light_box() {
  space::Body box = space::box(1, {.size = {1, 0.7, 1}});
  box.inertia = space::Vector3(6e-4, 5e-3, 5.5e-3).asDiagonal();
  return box;
}
space::Body coin() {
  space::Body coin = space::cylinder(0.0075, {.length = 0.0022, .radius = 0.0116});
  for (space::Rim& rim : coin.rims) rim = {{0, 0, rim.centre.x()}, {0, 0, rim.axis.x()}, rim.radius};
  coin.inertia = space::Vector3(coin.inertia(1, 1), coin.inertia(1, 1), coin.inertia(0, 0)).asDiagonal();
  return coin;
}

/// A level landing, and what small tilts make of it; argument: most strikes with a whole edge or face.
void level_landing(benchmark::State& state, const space::Drop& drop) {
  const space::Sequence sequence = space::impact_sequence(drop, {.impacts = 1});
  const space::ImpactRow& row = sequence.rows.at(0);
  const space::TiltEffort most{.rubs = static_cast<std::size_t>(state.range(0))};
  for (auto _ : state) {
    benchmark::DoNotOptimize(space::impact_sequence(drop, {.impacts = 1}));
    benchmark::DoNotOptimize(space::tilted_outcomes(drop.body, row.before, row.corners, drop.law, most));
  }
}
BENCHMARK_CAPTURE(level_landing, phone, level(phone(), 0))->Arg(20);
BENCHMARK_CAPTURE(level_landing, phone_with_friction, level(phone(), 0.3))->Arg(20)->Arg(10'000);
BENCHMARK_CAPTURE(level_landing, plastic_light_box, level(light_box(), 0.3, 0))->Arg(20)->Arg(10'000);
BENCHMARK_CAPTURE(level_landing, coin, level(coin(), 0.3))->Arg(20)->Arg(10'000);

}  // namespace

BENCHMARK_MAIN();
