// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/sequence.hpp"

#include <cstring>

#include "analytic/base/errors.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::test;

Drop rod_drop(double degrees, double gravity = 0) {
  return {.body = make_rod({}),
          .inclination = Angle::from_degrees(degrees),
          .velocity = {.normal = -1},
          .gravity = gravity,
          .law = {}};
}

Drop random_drop(Random& random) {
  Drop drop = rod_drop(random(0.1, 89.9), random.one_in(2) ? random(0.1, 20) : 0);
  if (random.one_in(3)) drop.body = make_rod({.mass = 2.5, .length = 0.7, .radius = 0.05});
  if (random.one_in(3)) drop.body = make_box({.mass = 0.088, .length = 0.106, .width = 0.044, .thickness = 0.019});
  drop.velocity = {.normal = random(-5, -0.5), .tangential = random(-1, 1), .angular = random(-0.5, 0.5)};
  return drop;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Bodies that look the same turned by half a turn and mirrored.
struct SymmetricScene {
  PlanarBody body;
  double restitution, gravity, friction;

  [[nodiscard]] Sequence run(double degrees, double sign) const {
    Drop drop{.body = body,
              .inclination = Angle::from_degrees(degrees),
              .velocity = {.normal = -1.3, .tangential = sign * 0.2, .angular = sign * 0.4},
              .gravity = gravity,
              .law = {.restitution = restitution}};
    if (friction > 0) drop.law.friction = FrictionKind::coulomb, drop.law.friction_value = friction;
    return impact_sequence(drop, {.impacts = 4, .amplification = false});
  }
};

const SymmetricScene symmetric_scenes[] = {{make_rod({}), 1, 0, 0},
                                           {make_rod({}), 1, 9.81, 0},
                                           {make_rod({}), 0.8, 9.81, 0.1},
                                           {make_rod({.length = 0.7, .radius = 0.02}), 0.9, 9.81, 0.3},
                                           {make_box({0.08814, 0.10566, 0.04394, 0.01905}), 0.7, 9.81, 0}};

/// @param sign −1: seen from behind the page
void check_same(const Sequence& some, const Sequence& other, double sign) {
  constexpr double grown = 1e-9;  // rounding of the state, grown over four impacts of these scenes
  BOOST_REQUIRE(!some.rows.empty());
  BOOST_REQUIRE_EQUAL(some.rows.size(), other.rows.size());
  const double impulse = other.rows[0].impact.normal_impulse, rate = std::fabs(other.rows[0].impact.after.angular) + 1;
  for (std::size_t i = 0; i < some.rows.size(); ++i) {
    const Impact &a = some.rows[i].impact, &b = other.rows[i].impact;
    BOOST_TEST(std::fabs(a.normal_impulse - b.normal_impulse) <= grown * impulse);
    BOOST_TEST(std::fabs(a.tangential_impulse - sign * b.tangential_impulse) <= grown * impulse);
    BOOST_TEST(std::fabs(a.after.normal - b.after.normal) <= grown);
    BOOST_TEST(std::fabs(a.after.tangential - sign * b.after.tangential) <= grown);
    BOOST_TEST(std::fabs(a.after.angular - sign * b.after.angular) <= grown * rate);
    BOOST_TEST(std::fabs(some.rows[i].start - other.rows[i].start) <= grown);
    BOOST_TEST(std::fabs(some.rows[i].contact_angle - other.rows[i].contact_angle) <= grown);
  }
}

}  // namespace

/// Those have 50 digits beside them (contact_angles_accuracy_test).
BOOST_AUTO_TEST_CASE(the_sequence_of_a_thin_rod_has_the_contact_angles_and_to_the_bit_their_impulses) {
  std::vector<double> degrees{1e-300, 1e-100, 1e-15, 1e-8, 1e-3};
  for (double theta = 0.5; theta < 90; theta += 0.5) degrees.push_back(theta);
  for (const double theta : degrees) {
    for (const double g : {0.0, 0.1}) {
      const Sequence s = impact_sequence(rod_drop(theta, g), {.impacts = 3});
      const ContactAngles c = contact_angles(Angle::from_degrees(theta), {.gravity_number = g});
      BOOST_TEST_REQUIRE(s.rows.size() >= static_cast<std::size_t>(c.impacts()));
      const double angles[] = {theta / degrees_per_radian, c.beta.angle, c.gamma.angle};
      double total = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(c.impacts()); ++k) {
        BOOST_REQUIRE(same_bits(s.rows[k].impact.normal_impulse, c.impulse[k]));
        BOOST_REQUIRE(std::fabs(s.rows[k].contact_angle - angles[k]) <= 8 * eps * angles[k]);
        total += c.impulse[k];
      }
      if (s.outcome != Outcome::no_further_impact) continue;
      BOOST_REQUIRE(s.rows.size() == static_cast<std::size_t>(c.impacts()));
      BOOST_REQUIRE(std::fabs(s.total_normal_impulse - total) <= 8 * eps * total);
    }
  }
}

BOOST_AUTO_TEST_CASE(every_impact_loses_the_energy_that_it_says_and_an_elastic_one_none) {
  Random random(13);
  for (int i = 0; i < 500; ++i) {
    Drop drop = random_drop(random);
    if (i % 4 > 0) {
      drop.law = {.restitution = 0.7,
                  .law = static_cast<RestitutionLaw>(i % 4 - 1),
                  .friction = FrictionKind::coulomb,
                  .friction_value = 0.2};
    }
    const Sequence s = impact_sequence(drop, {.impacts = 30, .amplification = false});
    const double allowed = 1e-13 * s.rows[0].energy_before;
    for (const ImpactRow& row : s.rows) {
      BOOST_REQUIRE(std::fabs(row.energy_before - row.energy_after - row.impact.energy_loss) <= allowed);
      if (i % 4 == 0) BOOST_REQUIRE(std::fabs(row.energy_after - s.rows[0].energy_before) <= allowed);
    }
  }
}

/// Of P₁ = (1 + e)/(1 + 3c²), with c the cosine of θ: θ P₁′/P₁ = 6 θ s c/(1 + 3c²); of angle and speed themselves 1.
BOOST_AUTO_TEST_CASE(the_amplification_at_the_first_impact_is_the_logarithmic_derivative_of_its_impulse) {
  constexpr double tolerance = 1e-6;  // rounding of 2⁻⁵² over the shift of 2⁻³⁰, with a few roundings
  for (const double degrees : {5.0, 30.0, 60.0, 75.0}) {
    const Sequence s = impact_sequence(rod_drop(degrees), {});
    const double theta = degrees / degrees_per_radian, c = std::cos(theta);
    const double of_impulse = 6 * theta * std::sin(theta) * c / (1 + 3 * c * c);
    BOOST_TEST(std::fabs(s.rows[0].amplification - std::fmax(1, of_impulse)) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(errors_that_sums_need_are_the_same_without_the_others) {
  Random random(16);
  for (int i = 0; i < 200; ++i) {
    Drop drop = random_drop(random);
    if (i % 2) drop.law = {.restitution = 0.8, .friction = FrictionKind::coulomb, .friction_value = 0.1};
    const Sequence all = impact_sequence(drop, {.impacts = 20}), sums = summed_sequence(drop, {.impacts = 20});
    BOOST_REQUIRE(sums.rows.size() == all.rows.size());
    BOOST_REQUIRE(same_bits(sums.total_normal_impulse_error, all.total_normal_impulse_error));
    for (std::size_t n = 0; n < all.rows.size(); ++n) {
      const RowErrors &a = all.rows[n].error, &b = sums.rows[n].error;
      BOOST_REQUIRE(b.predictable == a.predictable);
      for (const auto number : {&RowErrors::relative, &RowErrors::start, &RowErrors::contact_angle,
                                &RowErrors::normal_impulse, &RowErrors::energy_loss}) {
        BOOST_REQUIRE(same_bits(b.*number, a.*number));
      }
      BOOST_REQUIRE(std::isinf(b.inclination) && std::isinf(b.energy_after));
    }
  }
}

/// Near misses with the flights that they are of.
BOOST_AUTO_TEST_CASE(powers_of_two_in_every_unit_change_no_bit) {
  Random random(15);
  int of_rows = 0, of_ends = 0;
  for (int i = 0; i < 300; ++i) {
    Drop drop = random_drop(random);
    if (i % 4 == 3) drop.law.restitution = 0.8;
    const auto power = [&] { return static_cast<int>(random.below(41)) - 20; };
    const int m = power(), l = power(), t = power();
    Drop scaled = drop;
    scaled.body.mass = std::ldexp(drop.body.mass, m);
    scaled.body.gyration_square = std::ldexp(drop.body.gyration_square, 2 * l);
    for (Vertex& v : scaled.body.vertices) v = {std::ldexp(v.x, l), std::ldexp(v.z, l)};
    scaled.velocity = {.normal = std::ldexp(drop.velocity.normal, l - t),
                       .tangential = std::ldexp(drop.velocity.tangential, l - t),
                       .angular = std::ldexp(drop.velocity.angular, -t)};
    scaled.gravity = std::ldexp(drop.gravity, l - 2 * t);
    const auto is_scaled = [&](const NearMiss& a, const NearMiss& b) {
      return same_bits(std::ldexp(a.clearance, l), b.clearance) && same_bits(std::ldexp(a.margin, l), b.margin) &&
             same_bits(std::ldexp(a.time, t), b.time);
    };
    const Sequence a = impact_sequence(drop, {.impacts = 12}), b = impact_sequence(scaled, {.impacts = 12});
    BOOST_REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
      BOOST_REQUIRE(same_bits(a.rows[k].contact_angle, b.rows[k].contact_angle));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].start, t), b.rows[k].start));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].impact.normal_impulse, m + l - t), b.rows[k].impact.normal_impulse));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].energy_after, m + 2 * (l - t)), b.rows[k].energy_after));
      if (k == 0) continue;
      BOOST_REQUIRE(is_scaled(a.rows[k].flight.near_miss, b.rows[k].flight.near_miss));
      of_rows += std::isfinite(a.rows[k].flight.near_miss.clearance) ? 1 : 0;
    }
    BOOST_REQUIRE(is_scaled(a.near_miss, b.near_miss));
    of_ends += a.outcome == Outcome::no_further_impact && std::isfinite(a.near_miss.clearance) ? 1 : 0;
  }
  BOOST_TEST(of_rows >= 20);
  BOOST_TEST(of_ends >= 5);
}

BOOST_AUTO_TEST_CASE(a_drop_with_its_other_end_low_is_the_mirror_image_and_one_turned_over_falls_the_same) {
  for (const SymmetricScene& scene : symmetric_scenes) {
    for (const double degrees : {8., 25., 50., 71., 90.}) {
      const Sequence upright = scene.run(degrees, 1);
      check_same(scene.run(-degrees, -1), upright, -1);
      if (degrees == 90) continue;
      check_same(scene.run(degrees - 180, 1), upright, 1);
      check_same(scene.run(180 - degrees, -1), upright, -1);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_drop_or_no_request_is_refused) {
  Drop recedes = rod_drop(30);
  recedes.velocity.angular = 10;
  CHECK_REFUSED(impact_sequence(recedes, {}), std::domain_error);
  CHECK_REFUSED(impact_sequence(rod_drop(30), {.impacts = 0}), std::domain_error);
  const auto with = [](auto&& change) {
    Drop drop = rod_drop(30);
    change(drop);
    return impact_sequence(drop, {});
  };
  CHECK_REFUSED_SAYING(with([](Drop& drop) { drop.inclination.degrees = 40; }), std::domain_error, "inclination");
  CHECK_REFUSED_SAYING(with([](Drop& drop) { drop.inclination.radians = 0.5; }), std::domain_error, "inclination");
  CHECK_REFUSED_SAYING(with([](Drop& drop) { drop.inclination.sine = 0.6; }), std::domain_error, "inclination");
  CHECK_REFUSED_SAYING(with([](Drop& drop) { drop.body.vertex_count = 5; }), std::domain_error, "vertex count");
  for (const double mass : {0.0, -1.0, not_a_number})
    CHECK_REFUSED_SAYING(with([&](Drop& drop) { drop.body.mass = mass; }), std::domain_error, "mass");
  CHECK_REFUSED_SAYING(with([](Drop& drop) { drop.body.vertices[1].z = not_a_number; }), std::domain_error, "vertex");
  CHECK_REFUSED(impact_sequence(rod_drop(30), {.digits = 16}), std::domain_error);
  for (const double degrees : {181.0, -200.0}) CHECK_REFUSED(symmetric_scenes[0].run(degrees, 1), std::domain_error);
  // Bodies whose k² overflows or vanishes; their rows had wrong impulses and energies that are no numbers.
  for (const double length : {1e-170, 1e-160, 1e160, 1e300}) {
    Drop drop = rod_drop(20);
    drop.body = make_rod({.length = length, .radius = length / 100});
    drop.velocity.normal = -length;
    CHECK_REFUSED(impact_sequence(drop, {}), std::domain_error);
  }
}

BOOST_AUTO_TEST_CASE(an_impulse_ratio_beyond_the_limit_is_computed_with_a_warning_of_the_energy) {
  Drop drop = rod_drop(45);
  drop.law = {.friction = FrictionKind::impulse_ratio, .friction_value = 0.7};
  const Sequence s = impact_sequence(drop, {});
  BOOST_REQUIRE(s.warnings.size() == 1);
  BOOST_TEST(s.warnings[0].find("creates energy") != std::string::npos);
}

/// After many turns the inclination used to be reduced by a double 2π and no longer belonged to its sine: the next
/// flight ended up to a tenth of the rod off the ground, and 10⁴ impacts lost or won 10⁻⁶ of the energy.
BOOST_AUTO_TEST_CASE(an_elastic_rod_keeps_its_energy_over_10000_impacts_however_often_it_turns_between_them) {
  constexpr double per_impact = 8 * eps;  // energies of an impact and a flight, a few eps each, all to one side
  for (const double speed : {1.0, 100.0, 1e4, 1e5}) {
    for (const bool thin : {true, false}) {
      Drop drop = rod_drop(20, 9.81);
      drop.body.uniform_thin_rod = thin;
      drop.velocity.normal = -speed;
      const Sequence s = impact_sequence(drop, {.impacts = 10000, .amplification = false});
      BOOST_REQUIRE(s.rows.size() == 10000u);
      const double first = s.rows[0].energy_before;
      for (std::size_t i = 0; i < s.rows.size(); ++i) {
        const double off = std::fabs(s.rows[i].energy_after - first) / first;
        BOOST_REQUIRE_MESSAGE(off <= per_impact * static_cast<double>(i + 1),
                              "impact " << i + 1 << " at " << speed << ": " << off);
      }
    }
  }
}

/// These were called "nothing reaches the ground any more", whatever the gravity, or ran for ever.
BOOST_AUTO_TEST_CASE(a_fall_whose_end_no_double_can_tell_is_not_computed_and_not_called_the_last) {
  struct Case {
    double speed, gravity, angular;
  };
  const auto run = [](const Case& c) {
    Drop drop = rod_drop(20, c.gravity);
    drop.velocity = {.normal = -c.speed, .tangential = 0, .angular = c.angular};
    return impact_sequence(drop, {});
  };
  for (const Case& c : {Case{1e12, 9.81, 0},
                        {1e100, 9.81, 0},
                        {1, 1e-300, 0},
                        {1, 1e-100, 0},
                        {1, 1e-30, 0},
                        {1, 9.81, -2e9}}) {  // the last makes 10¹⁸ turns
    const Sequence sequence = run(c);
    BOOST_TEST_CONTEXT("speed " << c.speed << ", gravity " << c.gravity << ": " << sequence.message) {
      BOOST_TEST((sequence.outcome == Outcome::not_computed));
      BOOST_TEST(sequence.message.find("no digit") != std::string::npos);
      BOOST_TEST((!sequence.rows.empty() && sequence.rows.size() < 6u));  // what could be computed is kept
    }
  }
  for (const double speed : {1e-300, 1e-200, 1e200, 1e300}) {
    CHECK_REFUSED(run({speed, 9.81, 0}), NumericalError);  // G is no double
  }
  CHECK_REFUSED(run({1, 5e-324, 0}), NumericalError);
}
