// SPDX-License-Identifier: GPL-3.0-or-later
// Number and order of impacts of impact_sequence() against a brute-force simulation, at 100 000 random
// drops.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "validation/oracles/event_oracle.hpp"

namespace analytic = clatter::analytic;
namespace oracle = clatter::oracle;

namespace {

using Exact = oracle::EventSequence<long double>;

constexpr std::size_t drops = 100'000;
constexpr int impacts = 4;

/// Share of drops that may be decided by rounding: grazes, ties, or an order that a change of θ by
/// `perturbation` alters.
constexpr double most_too_close = 0.005;
/// Relative change of θ, some 45 ulp: more than what rounding amounts to in the first flight.
constexpr long double perturbation = 1e-14L;
/// Times may differ by this part, and by this multiple of what `perturbation` changes.
constexpr long double time_tolerance = 1e-9L;
constexpr long double time_amplification = 10;

enum class Shape { thin_rod, thick_rod, box };

struct RandomDrop {
  Shape shape = Shape::thin_rod;
  double half_thickness = 0;  ///< rim radius or half the box's thickness; L = 1
  double theta = 0;
  double gravity = 0;
  double restitution = 1;
  double impulse_ratio = 0;
};

std::vector<RandomDrop> random_drops() {
  std::mt19937_64 random(19470521);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<RandomDrop> all(drops);
  for (auto& drop : all) {
    const double shape = unit(random);
    drop.shape = shape < 0.5 ? Shape::thin_rod : shape < 0.75 ? Shape::thick_rod : Shape::box;
    if (drop.shape == Shape::thick_rod) drop.half_thickness = 0.01 + 0.29 * unit(random);
    if (drop.shape == Shape::box) drop.half_thickness = 0.01 + 0.49 * unit(random);
    drop.theta = analytic::pi / 2 * unit(random);
    if (unit(random) > 1.0 / 3) drop.gravity = std::pow(10, -3 + 5 * unit(random));
    if (unit(random) > 1.0 / 3) drop.restitution = 0.2 + 0.8 * unit(random);
    if (unit(random) > 0.5) drop.impulse_ratio = -0.3 + 0.6 * unit(random);
  }
  return all;
}

analytic::PlanarBody body_of(const RandomDrop& drop) {
  if (drop.shape == Shape::box)
    return analytic::make_box({.mass = 1, .length = 1, .width = 1, .thickness = 2 * drop.half_thickness});
  return analytic::make_rod({.mass = 1, .length = 1, .radius = drop.half_thickness});
}

analytic::Sequence computed(const RandomDrop& drop) {
  analytic::Drop scene;
  scene.body = body_of(drop);
  scene.inclination = analytic::Angle::from_radians(drop.theta);
  scene.velocity = {.normal = -1, .tangential = 0, .angular = 0};
  scene.gravity = drop.gravity;
  scene.law.restitution = drop.restitution;
  scene.law.friction = drop.impulse_ratio == 0 ? analytic::FrictionKind::none : analytic::FrictionKind::impulse_ratio;
  scene.law.friction_value = drop.impulse_ratio;
  return analytic::impact_sequence(scene, {.impacts = impacts, .digits = 15, .amplification = false});
}

/// Uniform solids: k² = (3r² + L²)/12 for the cylinder, (L² + T²)/12 for the box.
oracle::EventBody<long double> simulated_body(const RandomDrop& drop) {
  const long double h = drop.half_thickness;
  const long double thickness_part = drop.shape == Shape::box ? 4 * h * h : 3 * h * h;
  oracle::EventBody<long double> body{1, (1 + thickness_part) / 12, {{-0.5L, -h}, {0.5L, -h}}};
  if (drop.shape != Shape::thin_rod) {
    body.vertices.push_back({-0.5L, h});
    body.vertices.push_back({0.5L, h});
  }
  return body;
}

Exact simulated(const RandomDrop& drop, long double theta) {
  const oracle::EventLaw<long double> law{.restitution = drop.restitution,
                                          .friction = oracle::EventFriction::ratio,
                                          .friction_value = drop.impulse_ratio,
                                          .gravity = drop.gravity};
  return oracle::EventSimulation<long double>(simulated_body(drop), {theta, -1, 0, 0}, law).run(impacts, 0);
}

bool same_order(const Exact& x, const Exact& y) {
  return std::equal(x.impacts.begin(), x.impacts.end(), y.impacts.begin(), y.impacts.end(),
                    [](const auto& p, const auto& q) { return p.vertex == q.vertex; });
}

analytic::VertexSet only(std::size_t vertex) { return static_cast<analytic::VertexSet>(1U << vertex); }

/// Why the rows are not those of the simulation; empty if they are.
std::string disagreement(const analytic::Sequence& sequence, const Exact& exact, const Exact& neighbour) {
  const bool accumulates =
      sequence.outcome == analytic::Outcome::at_rest || sequence.outcome == analytic::Outcome::sustained_contact;
  const std::size_t rows = sequence.rows.size();
  if (rows > exact.impacts.size()) return "too many impacts";
  if (rows < exact.impacts.size() && !accumulates) return "too few impacts";
  for (std::size_t i = 0; i < exact.impacts.size(); ++i) {
    const bool in_tail = i >= rows;
    const auto vertices = in_tail ? sequence.tail.value().vertices : sequence.rows[i].vertices;
    if (vertices != only(exact.impacts[i].vertex)) return "another vertex";
    if (in_tail) continue;
    const long double time = exact.impacts[i].time;
    const long double allowed = time_tolerance * time + time_amplification * std::abs(neighbour.impacts[i].time - time);
    if (!(std::abs(sequence.rows[i].start - time) <= allowed)) return "another time";
  }
  return {};
}

struct Verdict {
  std::size_t compared = 0;
  std::size_t too_close = 0;
  std::array<std::size_t, impacts + 1> by_count{};  ///< drops with so many impacts
  std::vector<std::string> mismatches;

  void merge(const Verdict& other) {
    compared += other.compared;
    too_close += other.too_close;
    for (std::size_t i = 0; i < by_count.size(); ++i) by_count[i] += other.by_count[i];
    mismatches.insert(mismatches.end(), other.mismatches.begin(), other.mismatches.end());
  }
};

std::string describe(const RandomDrop& drop, const analytic::Sequence& sequence, const Exact& exact,
                     const std::string& reason) {
  std::ostringstream out;
  out.precision(17);
  out << reason << ": shape " << static_cast<int>(drop.shape) << " half thickness " << drop.half_thickness << " theta "
      << drop.theta << " G " << drop.gravity << " e " << drop.restitution << " mu_i " << drop.impulse_ratio
      << "\n  rows:";
  for (const auto& row : sequence.rows)
    out << ' ' << analytic::PlanarBody::vertex_set_name(row.vertices) << " at " << row.start;
  out << " (" << sequence.message << ")\n  simulated:";
  for (const auto& impact : exact.impacts)
    out << ' ' << analytic::PlanarBody::vertex_set_name(only(impact.vertex)) << " at "
        << static_cast<double>(impact.time);
  return out.str();
}

void judge(const RandomDrop& drop, Verdict& verdict) {
  const auto exact = simulated(drop, drop.theta);
  const auto neighbour = simulated(drop, drop.theta * (1 + perturbation));
  ++verdict.by_count[exact.impacts.size()];
  if (exact.close_call || neighbour.close_call || !same_order(exact, neighbour)) {
    ++verdict.too_close;
    return;
  }
  ++verdict.compared;
  const auto sequence = computed(drop);
  const std::string reason = disagreement(sequence, exact, neighbour);
  if (!reason.empty()) verdict.mismatches.push_back(describe(drop, sequence, exact, reason));
}

/// Drops shared out between two threads.
Verdict judge_all(const std::vector<RandomDrop>& all) {
  constexpr std::size_t thread_count = 2;
  std::array<Verdict, thread_count> verdicts;
  std::array<std::exception_ptr, thread_count> failures;
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < thread_count; ++k)
    threads.emplace_back([&, k] {
      try {
        for (std::size_t i = k; i < all.size(); i += thread_count) judge(all[i], verdicts[k]);
      } catch (...) {
        failures[k] = std::current_exception();
      }
    });
  for (auto& thread : threads) thread.join();
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  verdicts[0].merge(verdicts[1]);
  return verdicts[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(number_and_order_of_impacts_agree_with_a_brute_force_simulation) {
  const Verdict verdict = judge_all(random_drops());
  BOOST_TEST_MESSAGE(verdict.compared << " drops compared, " << verdict.too_close
                                      << " too close to call; with 1, 2, 3, 4 impacts: " << verdict.by_count[1] << ' '
                                      << verdict.by_count[2] << ' ' << verdict.by_count[3] << ' '
                                      << verdict.by_count[4]);
  constexpr std::size_t shown = 10;
  for (std::size_t i = 0; i < std::min(shown, verdict.mismatches.size()); ++i)
    BOOST_TEST_MESSAGE(verdict.mismatches[i]);
  BOOST_TEST(verdict.mismatches.empty(), verdict.mismatches.size() << " drops differ");
  BOOST_TEST(static_cast<double>(verdict.too_close) < most_too_close * static_cast<double>(drops));
}
