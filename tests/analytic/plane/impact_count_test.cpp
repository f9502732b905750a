// SPDX-License-Identifier: GPL-3.0-or-later
// Number and order of impacts of impact_sequence() against a brute-force simulation, at 20 000 random drops.
#include <sstream>

#include "analytic/plane/sequence.hpp"
#include "tests/support.hpp"
#include "validation/oracles/event_oracle.hpp"

namespace analytic = clatter::analytic;
namespace oracle = clatter::oracle;

namespace {

using Exact = oracle::EventSequence<long double>;

constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 2'000 : 20'000;
constexpr int impacts = 4;

/// Share of drops that may be decided by rounding: grazes, ties, or an order that a change of θ by `perturbation`
/// alters.
constexpr double most_too_close = 0.005;
/// Relative change of θ, some 45 ulp: more than what rounding amounts to in the first flight.
constexpr long double perturbation = 1e-14L;
/// Times may differ by this part, and by this multiple of what `perturbation` changes.
constexpr long double time_tolerance = 1e-9L;
constexpr long double time_amplification = 10;

/// A rod or box of length 1 and mass 1.
struct RandomDrop {
  bool is_box = false;
  double half_thickness = 0;  ///< rim radius or half the box's thickness
  double theta = 0, gravity = 0, restitution = 1, impulse_ratio = 0;
};

RandomDrop random_drop(clatter::test::Random& random) {
  RandomDrop drop;
  const double shape = random(0, 1);  // half of them thin rods
  drop.is_box = shape > 0.75;
  if (shape > 0.5) drop.half_thickness = random(0.01, drop.is_box ? 0.5 : 0.3);
  drop.theta = random(0, analytic::pi / 2);
  if (!random.one_in(3)) drop.gravity = random.decades(-3, 2);
  if (!random.one_in(3)) drop.restitution = random(0.2, 1);
  if (random.one_in(2)) drop.impulse_ratio = random(-0.3, 0.3);
  return drop;
}

analytic::PlanarBody body_of(const RandomDrop& drop) {
  if (drop.is_box) return analytic::make_box({.thickness = 2 * drop.half_thickness});
  return analytic::make_rod({.radius = drop.half_thickness});
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
  const long double thickness_part = drop.is_box ? 4 * h * h : 3 * h * h;
  oracle::EventBody<long double> body{1, (1 + thickness_part) / 12, {{-0.5L, -h}, {0.5L, -h}}};
  if (drop.half_thickness > 0) body.vertices.insert(body.vertices.end(), {{-0.5L, h}, {0.5L, h}});
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

std::string describe(const RandomDrop& drop, const analytic::Sequence& sequence, const Exact& exact) {
  std::ostringstream out;
  out.precision(17);
  out << (drop.is_box ? "box" : "rod") << ", half thickness " << drop.half_thickness << " theta " << drop.theta << " G "
      << drop.gravity << " e " << drop.restitution << " mu_i " << drop.impulse_ratio << "\n  rows:";
  for (const auto& row : sequence.rows)
    out << ' ' << analytic::PlanarBody::vertex_set_name(row.vertices) << " at " << row.start;
  out << " (" << sequence.message << ")\n  simulated:";
  for (const auto& impact : exact.impacts)
    out << ' ' << analytic::PlanarBody::vertex_set_name(only(impact.vertex)) << " at "
        << static_cast<double>(impact.time);
  return out.str();
}

}  // namespace

BOOST_AUTO_TEST_CASE(number_and_order_of_impacts_agree_with_a_brute_force_simulation) {
  clatter::test::Random random(19470521);
  int too_close = 0;
  for (int i = 0; i < drops; ++i) {
    const RandomDrop drop = random_drop(random);
    const Exact exact = simulated(drop, drop.theta), neighbour = simulated(drop, drop.theta * (1 + perturbation));
    if (exact.close_call || neighbour.close_call || !same_order(exact, neighbour)) {
      ++too_close;
      continue;
    }
    const analytic::Sequence sequence = computed(drop);
    const std::string reason = disagreement(sequence, exact, neighbour);
    BOOST_TEST(reason.empty(), reason << ": " << describe(drop, sequence, exact));
  }
  BOOST_TEST(too_close < most_too_close * drops);
}
