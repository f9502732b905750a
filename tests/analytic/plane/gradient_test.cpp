// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of impact sequences, against differences of simulations in many digits.
#include "analytic/plane/gradient.hpp"

#include <optional>

#include "analytic/base/angle.hpp"
#include "tests/support.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/event_oracle.hpp"

namespace {

using namespace clatter::analytic;
using Real = clatter::oracle::Decimal<80>;
namespace oracle = clatter::oracle;

constexpr double agreement = 1e-10;  // of derivatives over the largest of their kind, where errors are small

struct Numbers {
  double angle = 0.2, speed = 1, restitution = 1, friction = 0, gravity = 0, tangential = 0, spin = 0;
  RestitutionLaw law = RestitutionLaw::newton;
  bool has_friction = false, is_box = false;
};

Drop drop_of(const Numbers& n) {
  return {.body = n.is_box ? make_box({.mass = 1.5, .length = 0.75, .thickness = 0.25}) : make_rod({}),
          .inclination = Angle::from_radians(n.angle),
          .velocity = {.normal = -n.speed, .tangential = n.tangential, .angular = n.spin},
          .gravity = n.gravity,
          .law = {.restitution = n.restitution,
                  .law = n.law,
                  .friction = n.has_friction ? FrictionKind::coulomb : FrictionKind::none,
                  .friction_value = n.friction}};
}

/// The drop with a parameter moved, in many digits.
oracle::EventSequence<Real> simulated(const Numbers& n, int count, std::size_t parameter, const Real& by) {
  const Drop drop = drop_of(n);
  oracle::EventBody<Real> body{drop.body.mass, 0, {}};
  body.gyration_square = n.is_box ? (Real(n.is_box ? 0.75 : 1) * 0.75 + Real(0.25) * 0.25) / 12 : Real(1) / 12;
  for (int i = 0; i < drop.body.vertex_count; ++i)
    body.vertices.push_back({Real(drop.body.vertices[i].x), Real(drop.body.vertices[i].z)});
  const auto moved = [&](std::size_t which, double value) { return Real(value) + (which == parameter ? by : Real(0)); };
  oracle::EventLaw<Real> law{.restitution = moved(2, n.restitution), .gravity = Real(n.gravity)};
  law.kind = n.law == RestitutionLaw::poisson   ? oracle::EventRestitution::poisson
             : n.law == RestitutionLaw::stronge ? oracle::EventRestitution::stronge
                                                : oracle::EventRestitution::newton;
  law.friction = n.has_friction || parameter == 3 ? oracle::EventFriction::coulomb : oracle::EventFriction::none;
  law.friction_value = moved(3, n.friction);
  oracle::EventSimulation<Real> simulation(body, {moved(0, n.angle), -moved(1, n.speed), n.tangential, n.spin}, law);
  return simulation.run(static_cast<std::size_t>(count), Real(0));
}

std::array<double, 7> as_list(const ImpactGradient& g) {
  return {g.time, g.inclination, g.normal, g.tangential, g.angular, g.normal_impulse, g.tangential_impulse};
}

std::array<Real, 7> values(const oracle::EventImpact<Real>& impact) {
  return {impact.time,          impact.before.inclination, impact.after.normal,      impact.after.tangential,
          impact.after.angular, impact.normal_impulse,     impact.tangential_impulse};
}

/// Central differences by 1e-20; one-sided, by three points, for friction from above.  Nothing if another sequence is
/// within 1e-20.
std::optional<std::vector<std::array<double, 7>>> differences(const Numbers& n, int count, std::size_t parameter) {
  const Real h("1e-20");
  const bool above = parameter == 3 && n.friction == 0;
  const auto a = simulated(n, count, parameter, above ? Real(0) : Real(-h)).impacts;
  const auto b = simulated(n, count, parameter, h).impacts;
  const auto c = above ? simulated(n, count, parameter, 2 * h).impacts : b;
  std::vector<std::array<double, 7>> all;
  for (std::size_t i = 0; i < std::min({a.size(), b.size(), c.size()}); ++i) {
    if (a[i].vertex != b[i].vertex || c[i].vertex != b[i].vertex) return {};
    const auto u = values(a[i]), v = values(b[i]), w = values(c[i]);
    std::array<double, 7>& row = all.emplace_back();
    for (std::size_t k = 0; k < 7; ++k)
      row[k] = static_cast<double>(above ? (4 * v[k] - 3 * u[k] - w[k]) / (2 * h) : (v[k] - u[k]) / (2 * h));
  }
  return all;
}

struct Tally {
  int compared = 0, outside = 0, refused = 0;
  double worst = 0;  ///< beside the largest derivative of its kind, where errors say that it is known to 1e-11
};

void compare(const Numbers& n, int count, Tally& tally) {
  const SequenceGradient gradient = sequence_gradient(drop_of(n), count);
  for (std::size_t p = 0; p < drop_parameters; ++p) {
    const std::size_t known = std::min(gradient.refused[p].from, gradient.rows.size());
    if (known < gradient.rows.size()) ++tally.refused;
    const auto wanted = differences(n, static_cast<int>(known), p);
    if (known == 0 || !wanted) continue;
    BOOST_TEST_REQUIRE(wanted->size() >= known);
    for (std::size_t i = 0; i < known; ++i) {
      const auto found = as_list(gradient.rows[i].of[p]), error = as_list(gradient.rows[i].error[p]);
      double size = 0;
      for (const double one : found) size = std::fmax(size, std::fabs(one));
      for (std::size_t k = 0; k < 7; ++k) {
        const double off = std::fabs(found[k] - (*wanted)[i][k]);
        ++tally.compared;
        if (!(off <= error[k])) ++tally.outside;
        if (error[k] <= agreement * size) tally.worst = std::fmax(tally.worst, off / size);
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(derivatives_of_random_drops_are_the_differences_of_simulations_in_80_digits) {
  clatter::test::Random random(5);
  Tally tally;
  for (int i = 0; i < 80; ++i) {
    Numbers n{.angle = random(0.05, 1.5), .speed = random(0.5, 3), .gravity = i % 3 == 0 ? 0 : random(1, 10)};
    n.is_box = i % 2 == 1;
    n.has_friction = i % 4 >= 2;
    if (n.has_friction) n.friction = random(0.05, 0.8);
    if (i % 5 != 0) n.restitution = random(0.3, 0.95);
    if (i % 7 < 3) n.tangential = random(-1, 1), n.spin = random(-0.5, 0.5);
    n.law = i % 3 == 0 ? RestitutionLaw::newton : i % 3 == 1 ? RestitutionLaw::poisson : RestitutionLaw::stronge;
    compare(n, 4, tally);
  }
  BOOST_TEST(tally.compared >= 2000);
  BOOST_TEST(tally.outside <= tally.compared / 200);
  BOOST_TEST(tally.worst <= agreement);
}

BOOST_AUTO_TEST_CASE(the_first_impact_of_the_thin_rod_has_the_derivatives_of_eq_9) {
  const double theta = 0.3, c = std::cos(theta), s = std::sin(theta), v = 1.25, e = 0.75;
  const SequenceGradient gradient =
      sequence_gradient(drop_of({.angle = theta, .speed = v, .restitution = e, .gravity = 9.81}), 1);
  const double k = 1 + 3 * c * c;  // P = (1 + e) v/k, Ω = 6 c P
  const auto& [of_angle, of_speed, of_e, of_mu] = gradient.rows[0].of;
  BOOST_TEST(std::fabs(of_angle.normal_impulse - (1 + e) * v * 6 * c * s / (k * k)) <= 1e-14);
  BOOST_TEST(std::fabs(of_speed.normal_impulse - (1 + e) / k) <= 1e-15);
  BOOST_TEST(std::fabs(of_e.normal_impulse - v / k) <= 1e-15);
  BOOST_TEST(std::fabs(of_e.angular - 6 * c * v / k) <= 1e-14);
  // End a slips to the left, friction pushes to the right: dP/dμ = 3 s c (1 + e) v/k².
  BOOST_TEST(std::fabs(of_mu.normal_impulse - (1 + e) * v * 3 * s * c / (k * k)) <= 1e-14);
  BOOST_TEST(std::fabs(of_mu.tangential_impulse - (1 + e) * v / k) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(derivatives_grow_like_one_over_the_root_of_the_distance_to_a_fold_and_are_refused_at_it) {
  const double fold = 58.488442288312 / degrees_per_radian;
  const auto of_time = [&](double below) {
    const SequenceGradient gradient = sequence_gradient(drop_of({.angle = fold - below}), 2);
    return gradient.rows.size() == 2 ? std::fabs(gradient.rows[1].of[0].time) : 0;
  };
  BOOST_TEST(std::fabs(of_time(1e-6) / of_time(1e-4) - 10) <= 0.2);
  BOOST_TEST(sequence_gradient(drop_of({.angle = fold}), 2).refused[0].from <= 1U);
}

BOOST_AUTO_TEST_CASE(a_flat_landing_has_derivatives_but_none_of_the_angle) {
  const SequenceGradient gradient =
      sequence_gradient(drop_of({.angle = 0, .restitution = 0.5, .gravity = 10, .is_box = true}), 2);
  BOOST_TEST(gradient.refused[0].from == 0U);
  BOOST_TEST(!gradient.refused[0].reason.empty());
  for (const std::size_t p : {1U, 2U}) BOOST_TEST(gradient.refused[p].from == 2U);
  // The second comes 2 e v/g after the first.
  BOOST_TEST(std::fabs(gradient.rows[1].of[1].time - 2 * 0.5 / 10) <= 1e-15);
  BOOST_TEST(std::fabs(gradient.rows[1].of[2].time - 2.0 / 10) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(a_law_that_has_no_restitution_of_its_own_has_no_derivative_of_it) {
  Drop drop = drop_of({.gravity = 9.81});
  drop.law = {.law = RestitutionLaw::viscoelastic, .damping_per_stiffness = 0.1};
  const SequenceGradient gradient = sequence_gradient(drop, 2);
  BOOST_TEST(gradient.refused[2].from == 0U);
  BOOST_TEST(gradient.refused[1].reason.empty());
}
