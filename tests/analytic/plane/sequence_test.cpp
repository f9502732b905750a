// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/sequence.hpp"

#include "analytic/base/errors.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstring>
#include <random>

#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/summed_sequence.hpp"

namespace {

using namespace clatter::analytic;

Drop rod_drop(double degrees) {
  return {.body = make_rod({}),
          .inclination = Angle::from_degrees(degrees),
          .velocity = {.normal = -1},
          .gravity = 0,
          .law = {}};
}

Drop random_drop(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  Drop drop = rod_drop(uniform(0.1, 89.9));
  if (random() % 3 == 1) drop.body = make_rod({.mass = 2.5, .length = 0.7, .radius = 0.05});
  if (random() % 3 == 1) drop.body = make_box({.mass = 0.088, .length = 0.106, .width = 0.044, .thickness = 0.019});
  drop.velocity = {.normal = uniform(-5, -0.5), .tangential = uniform(-1, 1), .angular = uniform(-0.5, 0.5)};
  drop.gravity = random() % 2 ? uniform(0.1, 20) : 0;
  return drop;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

BOOST_AUTO_TEST_CASE(the_rod_dropped_at_10_degrees_has_the_three_impacts_of_the_reference_table) {
  const Sequence s = impact_sequence(rod_drop(10), {});
  BOOST_REQUIRE(s.rows.size() == 3);
  // 30-digit values of an independent computation (validation/oracles/reference).
  const double angles[] = {10, 5.08198288305537323797553338956, 10.5479772399858399151981804425};
  const double impulses[] = {0.51156927586776329289718902056, 1.00284246496985494090956210113,
                             0.485090774171696977183309561393};
  const double eps = 2.2e-16;
  for (int i = 0; i < 3; ++i) {
    const ImpactRow& row = s.rows[static_cast<std::size_t>(i)];
    BOOST_TEST(std::fabs(row.contact_angle * degrees_per_radian - angles[i]) <= 8 * eps * angles[i]);
    BOOST_TEST(std::fabs(row.impact.normal_impulse - impulses[i]) <= 8 * eps * impulses[i]);
  }
  BOOST_TEST(std::fabs(s.total_normal_impulse - 1.99950251500931521099006068308) <= 8 * eps);
  BOOST_CHECK(s.outcome == Outcome::no_further_impact);
}

BOOST_AUTO_TEST_CASE(small_angles_tend_to_2_1_2_with_impulses_that_sum_to_the_flat_landing) {
  for (const double theta : {1e-300, 1e-100, 1e-15, 1e-8, 1e-3}) {
    const Sequence s = impact_sequence(rod_drop(theta), {});
    BOOST_REQUIRE(s.rows.size() == 3);
    const double series = 1 + theta * theta / (57.2 * 57.2);  // departures are of the order θ²
    BOOST_TEST(std::fabs(s.rows[1].contact_angle / s.rows[0].contact_angle * 2 - 1) <= series - 1 + 1e-15);
    BOOST_TEST(std::fabs(s.total_normal_impulse - 2) <= 1e-9);
  }
  const double flat = impact_sequence(rod_drop(0), {}).total_normal_impulse;
  BOOST_TEST(flat == 2);
}

BOOST_AUTO_TEST_CASE(at_54_7356_degrees_both_impulses_are_1_and_the_second_angle_equals_the_first) {
  Drop drop = rod_drop(0);
  drop.inclination = Angle::from_radians(std::acos(1 / std::sqrt(3.0)));
  const Sequence s = impact_sequence(drop, {});
  const double tolerance = 10 * 2.2e-16;  // ten roundings
  BOOST_REQUIRE(s.rows.size() == 2);
  BOOST_TEST(std::fabs(s.rows[0].impact.normal_impulse - 1) <= tolerance);
  BOOST_TEST(std::fabs(s.rows[1].impact.normal_impulse - 1) <= tolerance);
  BOOST_TEST(std::fabs(s.rows[0].impact.after.normal) <= tolerance);
  BOOST_TEST(std::fabs(s.rows[1].contact_angle - s.rows[0].contact_angle) <= tolerance);
}

BOOST_AUTO_TEST_CASE(the_second_impulse_is_the_larger_below_54_7356_degrees_and_at_most_1_04540_near_47_15) {
  double largest = 0, at = 0;
  for (double theta = 0.05; theta < 54.73; theta += 0.05) {
    const Sequence s = impact_sequence(rod_drop(theta), {.impacts = 2, .amplification = false});
    BOOST_REQUIRE(s.rows[1].impact.normal_impulse > s.rows[0].impact.normal_impulse);
    if (s.rows[1].impact.normal_impulse > largest) largest = s.rows[1].impact.normal_impulse, at = theta;
  }
  BOOST_TEST(std::fabs(largest - 1.04540) <= 5e-6);
  BOOST_TEST(std::fabs(at - 47.15) <= 0.051);
}

BOOST_AUTO_TEST_CASE(elastic_sequences_conserve_energy_to_1e_minus_13) {
  std::mt19937_64 random(13);
  for (int i = 0; i < 500; ++i) {
    const Sequence s = impact_sequence(random_drop(random), {.impacts = 40, .amplification = false});
    for (const ImpactRow& row : s.rows) {
      BOOST_REQUIRE(std::fabs(row.energy_after - s.rows[0].energy_before) <= 1e-13 * s.rows[0].energy_before);
    }
  }
}

BOOST_AUTO_TEST_CASE(every_impact_loses_the_energy_that_it_says) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 500; ++i) {
    Drop drop = random_drop(random);
    drop.law = {.restitution = 0.7,
                .law = static_cast<RestitutionLaw>(i % 3),
                .friction = FrictionKind::coulomb,
                .friction_value = 0.2};
    const Sequence s = impact_sequence(drop, {.impacts = 20, .amplification = false});
    for (const ImpactRow& row : s.rows) {
      BOOST_REQUIRE(std::fabs(row.energy_before - row.energy_after - row.impact.energy_loss) <=
                    1e-13 * s.rows[0].energy_before);
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
  std::mt19937_64 random(16);
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

BOOST_AUTO_TEST_CASE(powers_of_two_in_every_unit_change_no_bit) {
  std::mt19937_64 random(15);
  for (int i = 0; i < 300; ++i) {
    Drop drop = random_drop(random);
    drop.law.restitution = i % 2 ? 1 : 0.8;
    const int m = static_cast<int>(random() % 41) - 20, l = static_cast<int>(random() % 41) - 20,
              t = static_cast<int>(random() % 41) - 20;
    Drop scaled = drop;
    scaled.body.mass = std::ldexp(drop.body.mass, m);
    scaled.body.gyration_square = std::ldexp(drop.body.gyration_square, 2 * l);
    for (Vertex& v : scaled.body.vertices) v = {std::ldexp(v.x, l), std::ldexp(v.z, l)};
    scaled.velocity = {std::ldexp(drop.velocity.normal, l - t), std::ldexp(drop.velocity.tangential, l - t),
                       std::ldexp(drop.velocity.angular, -t)};
    scaled.gravity = std::ldexp(drop.gravity, l - 2 * t);
    const Sequence a = impact_sequence(drop, {.impacts = 12}), b = impact_sequence(scaled, {.impacts = 12});
    BOOST_REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
      BOOST_REQUIRE(same_bits(a.rows[k].contact_angle, b.rows[k].contact_angle));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].start, t), b.rows[k].start));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].impact.normal_impulse, m + l - t), b.rows[k].impact.normal_impulse));
      BOOST_REQUIRE(same_bits(std::ldexp(a.rows[k].energy_after, m + 2 * (l - t)), b.rows[k].energy_after));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_near_miss_of_a_body_1024_times_as_large_is_1024_times_as_far) {
  std::mt19937_64 random(22);
  int of_rows = 0, of_ends = 0;
  const auto is_larger = [](const NearMiss& small, const NearMiss& large) {
    return same_bits(1024 * small.clearance, large.clearance) && same_bits(1024 * small.margin, large.margin) &&
           same_bits(1024 * small.time, large.time);
  };
  for (int i = 0; i < 300; ++i) {
    const Drop drop = random_drop(random);
    Drop large = drop;
    large.body.gyration_square *= 1024 * 1024;
    for (Vertex& v : large.body.vertices) v = {1024 * v.x, 1024 * v.z};
    large.velocity.angular /= 1024;
    large.gravity /= 1024;
    const Sequence a = impact_sequence(drop, {.impacts = 12}), b = impact_sequence(large, {.impacts = 12});
    BOOST_REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t k = 1; k < a.rows.size(); ++k) {
      const NearMiss &small = a.rows[k].flight.near_miss, &far = b.rows[k].flight.near_miss;
      if (std::isfinite(small.clearance)) ++of_rows;
      BOOST_REQUIRE(is_larger(small, far));
    }
    if (a.outcome == Outcome::no_further_impact && std::isfinite(a.near_miss.clearance)) ++of_ends;
    BOOST_REQUIRE(is_larger(a.near_miss, b.near_miss));
  }
  BOOST_TEST(of_rows >= 20);
  BOOST_TEST(of_ends >= 5);
}

BOOST_AUTO_TEST_CASE(the_mirror_image_has_the_mirrored_sequence) {
  std::mt19937_64 random(16);
  for (int i = 0; i < 300; ++i) {
    const Drop drop = random_drop(random);
    const ImpactLaw law{.restitution = 0.9, .friction = FrictionKind::coulomb, .friction_value = 0.3};
    // Seen from behind the page: x, inclination, spin and tangential velocity change sign, ends change
    // names, z and times stay.
    BodyMotion motion(drop.body, drop.inclination, drop.velocity, drop.gravity);
    const Angle& angle = drop.inclination;
    BodyMotion mirror(drop.body, {-angle.radians, -angle.degrees, -angle.sine, angle.cosine},
                      {drop.velocity.normal, -drop.velocity.tangential, -drop.velocity.angular}, drop.gravity);
    const auto swapped = [](VertexSet set) {
      return static_cast<VertexSet>((set & 0b0101) << 1 | (set & 0b1010) >> 1);
    };
    constexpr double grown = 1e-9;  // rounding, which three impacts may multiply by 10⁶
    VertexSet here = motion.lowest_vertices(), there = mirror.lowest_vertices();
    for (int k = 0; k < 3; ++k) {
      BOOST_REQUIRE(swapped(here) == there);
      const Impact a = motion.strike(here, law).impact, b = mirror.strike(there, law).impact;
      BOOST_REQUIRE(std::fabs(a.normal_impulse - b.normal_impulse) <= grown * a.normal_impulse);
      BOOST_REQUIRE(std::fabs(a.tangential_impulse + b.tangential_impulse) <= grown * a.normal_impulse);
      const Flight f = motion.fly(), m = mirror.fly();
      BOOST_REQUIRE(f.end == m.end);
      if (f.end != FlightEnd::contact) break;
      BOOST_REQUIRE(std::fabs(motion.time() - mirror.time()) <= grown * motion.time());
      BOOST_REQUIRE(std::fabs(std::fabs(motion.inclination()) - std::fabs(mirror.inclination())) <= 10 * grown);
      here = f.arrival.vertices;
      there = m.arrival.vertices;
    }
  }
}

BOOST_AUTO_TEST_CASE(the_sequence_agrees_to_the_bit_with_the_contact_angles) {
  for (double theta = 0.5; theta < 90; theta += 0.5) {
    for (const double g : {0.0, 0.1}) {
      Drop drop = rod_drop(theta);
      drop.gravity = g;
      const Sequence s = impact_sequence(drop, {.impacts = 3});
      const ContactAngles c = contact_angles(Angle::from_degrees(theta), {.gravity_number = g});
      for (int k = 0; k < c.impacts(); ++k) {
        BOOST_REQUIRE(same_bits(s.rows[static_cast<std::size_t>(k)].impact.normal_impulse, c.impulse[k]));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_first_contact_that_recedes_is_refused) {
  Drop drop = rod_drop(30);
  drop.velocity.angular = 10;
  BOOST_CHECK_THROW(static_cast<void>(impact_sequence(drop, {})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(impact_sequence(rod_drop(30), {.impacts = 0})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(impact_sequence(rod_drop(30), {.digits = 16})), std::domain_error);
}

BOOST_AUTO_TEST_CASE(an_impulse_ratio_beyond_the_limit_is_computed_with_a_warning_of_the_energy) {
  Drop drop = rod_drop(45);
  drop.law = {.friction = FrictionKind::impulse_ratio, .friction_value = 0.7};
  const Sequence s = impact_sequence(drop, {});
  BOOST_REQUIRE(s.warnings.size() == 1);
  BOOST_TEST(s.warnings[0].find("creates energy") != std::string::npos);
}

/// Each impact restores by the map at its own speed v: e solves ln[(1+s)/(1-s e)] = s (1+e), s = tau v; a flight from
/// e v lasts 2 e v/g.
BOOST_AUTO_TEST_CASE(a_flat_body_on_damped_ground_bounces_with_the_restitution_of_each_speed) {
  const double tau = 0.3, g = 9.81;
  const Drop drop{.body = make_box({}),
                  .inclination = Angle::from_degrees(0),
                  .velocity = {.normal = -3},
                  .gravity = g,
                  .law = {.law = RestitutionLaw::viscoelastic, .damping_per_stiffness = tau}};
  const Sequence s = impact_sequence(drop, {.impacts = 4});
  double speed = 3, time = 0;
  for (const ImpactRow& row : s.rows) {
    const double e = row.impact.restitution(), number = tau * speed;
    BOOST_TEST(row.impact.approach_speed == speed, boost::test_tools::tolerance(1e-13));
    BOOST_TEST(std::fabs(row.start - time) <= 1e-13);
    BOOST_TEST(std::fabs(std::log1p(number) - std::log1p(-number * e) - number * (1 + e)) <= 1e-14);
    time += 2 * e * speed / g;
    speed *= e;
  }
  BOOST_TEST(s.rows.size() == 4u);
}

/// After many turns the inclination used to be reduced by a double 2π and no longer belonged to its sine: the next
/// flight ended up to a tenth of the rod off the ground, and 10⁴ impacts lost or won 10⁻⁶ of the energy.
BOOST_AUTO_TEST_CASE(an_elastic_rod_keeps_its_energy_over_10000_impacts_however_often_it_turns_between_them) {
  constexpr double per_impact = 8 * 2.2e-16;  // energies of an impact and a flight, a few eps each, all to one side
  for (const double speed : {1.0, 100.0, 1e4, 1e5}) {
    for (const bool thin : {true, false}) {
      Drop drop = rod_drop(20);
      drop.body.uniform_thin_rod = thin;
      drop.velocity.normal = -speed;
      drop.gravity = 9.81;
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
  const auto breaks_off = [](double speed, double gravity, double angular) {
    Drop drop = rod_drop(20);
    drop.velocity = {.normal = -speed, .tangential = 0, .angular = angular};
    drop.gravity = gravity;
    const Sequence sequence = impact_sequence(drop, {});
    BOOST_TEST((sequence.outcome == Outcome::not_computed), "speed " << speed << ", gravity " << gravity);
    BOOST_TEST(sequence.message.find("no digit") != std::string::npos, sequence.message);
    BOOST_TEST(!sequence.rows.empty());  // what could be computed is kept
    BOOST_TEST(sequence.rows.size() < 6u);
  };
  const auto refused = [](double speed, double gravity) {
    Drop drop = rod_drop(20);
    drop.velocity.normal = -speed;
    drop.gravity = gravity;
    BOOST_CHECK_THROW(static_cast<void>(impact_sequence(drop, {})), NumericalError);
  };
  for (const double speed : {1e12, 1e100}) breaks_off(speed, 9.81, 0);
  for (const double gravity : {1e-300, 1e-100, 1e-30}) breaks_off(1, gravity, 0);
  breaks_off(1, 9.81, -2e9);                                                       // 10¹⁸ turns
  for (const double speed : {1e-300, 1e-200, 1e200, 1e300}) refused(speed, 9.81);  // G is no double
  refused(1, 5e-324);
}

/// Their k² overflows or vanishes; the rows had wrong impulses and energies that are no numbers.
BOOST_AUTO_TEST_CASE(a_body_whose_inertia_is_no_double_is_refused) {
  for (const double length : {1e-170, 1e-160, 1e160, 1e300}) {
    Drop drop = rod_drop(20);
    drop.body = make_rod({.length = length, .radius = length / 100});
    drop.velocity.normal = -length;
    BOOST_CHECK_THROW(static_cast<void>(impact_sequence(drop, {})), std::domain_error);
  }
}
