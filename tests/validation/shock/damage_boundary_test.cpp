// SPDX-License-Identifier: GPL-3.0-or-later
// The damage boundary against its closed forms and against an integration of the part's equation of motion.
#include "validation/shock/damage_boundary.hpp"

#include "tests/support.hpp"

using namespace clatter::validation;

namespace {

using std::numbers::pi;
constexpr double closed_form = 1e-9;  // what is claimed of corners
constexpr double by_steps = 1e-6;     // of 4000 steps of fourth order in each period and in the pulse

/// Largest |ω² z| of z̈ + ω² z = −s, by Runge and Kutta, over the pulse of length 1 and two periods after it.
double stepped(PulseShape shape, double turns) {
  const double omega = 2 * pi * turns, end = 1 + 2 / turns;
  const double step = 1 / std::ceil(4000 * std::max(1.0, turns));
  const auto push = [&](double t) {
    if (t > 1 + 1e-12) return 0.0;
    return shape == PulseShape::rectangle ? 1.0 : std::sin(pi * t);
  };
  double z = 0, v = 0, largest = 0;
  for (long i = 0; static_cast<double>(i) * step < end; ++i) {
    const double t = static_cast<double>(i) * step;
    // A step's pulse is that of its own side of the end.
    const bool after = t > 1 - 0.5 * step;
    const auto pull = [&](double at, double of) { return -(after ? 0 : push(at)) - omega * omega * of; };
    const double k1 = pull(t, z), k2 = pull(t + step / 2, z + step / 2 * v);
    const double k3 = pull(t + step / 2, z + step / 2 * v + step * step / 4 * k1);
    const double k4 = pull(t + step, z + step * v + step * step / 2 * k2);
    z += step * v + step * step / 6 * (k1 + k2 + k3);
    v += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    largest = std::max(largest, std::fabs(omega * omega * z));
  }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(responses_to_both_pulses_are_those_of_the_equation_of_motion) {
  clatter::test::Random random(3);
  for (int i = 0; i < 15; ++i) {
    const double turns = random.decades(-2, 1);
    for (const PulseShape shape : {PulseShape::rectangle, PulseShape::half_sine})
      BOOST_TEST(std::fabs(pulse_response(shape, turns) / stepped(shape, turns) - 1) < by_steps,
                 "f T = " << turns << ": " << pulse_response(shape, turns) << ", by steps " << stepped(shape, turns));
  }
}

BOOST_AUTO_TEST_CASE(the_half_sine_is_smooth_where_its_closed_form_is_zero_over_zero) {
  // f T = 1/2: the residual is π/2.
  for (const double off : {0.0, 1e-12, -1e-9, 1e-7, -1e-5})
    BOOST_TEST(std::fabs(pulse_response(PulseShape::half_sine, 0.5 * (1 + off)) - pi / 2) < 1e-9 + std::fabs(off));
}

BOOST_AUTO_TEST_CASE(the_corner_of_the_boundary_lies_where_astm_has_it) {
  clatter::test::Random random(4);
  for (int i = 0; i < 100; ++i) {
    const FragilePart part{random.decades(0, 3), random.decades(1, 4)};
    const double omega = 2 * pi * part.frequency;
    const DamageBoundary rectangle = damage_boundary(part, PulseShape::rectangle);
    BOOST_TEST(std::fabs(rectangle.critical_velocity * omega / part.fragility - 1) < closed_form);
    BOOST_TEST(std::fabs(rectangle.critical_acceleration * 2 / part.fragility - 1) < closed_form);
    BOOST_TEST(std::fabs(rectangle.corner_velocity / (pi / 2 * rectangle.critical_velocity) - 1) < closed_form);
    const DamageBoundary half_sine = damage_boundary(part, PulseShape::half_sine);
    BOOST_TEST(std::fabs(half_sine.critical_acceleration * 1.768457654 / part.fragility - 1) < closed_form);
    // On the boundary, at both its ends and at its corner, the margin is 1; off it, it is not.
    for (const PulseShape shape : {PulseShape::rectangle, PulseShape::half_sine}) {
      const DamageBoundary at = damage_boundary(part, shape);
      BOOST_TEST(std::fabs(margin(part, shape, at.corner_velocity, at.critical_acceleration) - 1) < closed_form);
      BOOST_TEST(std::fabs(margin(part, shape, at.critical_velocity, 1e6 * part.fragility) - 1) < closed_form);
      BOOST_TEST(margin(part, shape, 0.99 * at.critical_velocity, 1e6 * part.fragility) > 1);
      BOOST_TEST(margin(part, shape, 10 * at.corner_velocity, 0.99 * at.critical_acceleration) > 1);
      BOOST_TEST(margin(part, shape, 1.01 * at.corner_velocity, 1.01 * at.critical_acceleration) < 1);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_part_known_by_its_test_or_at_its_place_fails_where_it_was_taken_further) {
  clatter::test::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const double peak = random.decades(1, 4), duration = random.decades(-4, -2), far = random.decades(0.1, 3);
    const double velocity = 2 * peak * duration / pi;  // the integral of a half sine
    const FragilePart tested{.fragility = peak, .duration = duration, .kind = FragilePart::Kind::tested};
    // Only where both exceed those of the test it fails, by the one that exceeds less.
    BOOST_TEST(std::fabs(blow_margin(tested, velocity, peak).value - 1) < closed_form);
    BOOST_TEST(std::fabs(blow_margin(tested, 2 * far * velocity, far * peak).value * far - 1) < closed_form);
    BOOST_TEST(std::fabs(blow_margin(tested, far * velocity, 2 * far * peak).value * far - 1) < closed_form);
    BOOST_TEST(std::fabs(velocity_margin(tested, far * velocity) * far - 1) < closed_form);
    const FragilePart at_place{.fragility = peak, .kind = FragilePart::Kind::at_place};
    BOOST_TEST(std::fabs(blow_margin(at_place, random.decades(-2, 2), far * peak).value * far - 1) < closed_form);
  }
}

BOOST_AUTO_TEST_CASE(the_eight_conditions_of_jesd22_b110b_have_its_changes_of_velocity_and_heights) {
  // Table 1 of the standard has cm/s and cm, made with rounded g: to a unit of the last place, relative or absolute.
  struct Printed {
    char name;
    double peak, milliseconds, velocity, height;
  };
  constexpr double rounded = 1.1, printed_g = 0.01;
  constexpr Printed table[] = {{'H', 2900, 0.3, 543, 150}, {'G', 2000, 0.4, 499, 127}, {'B', 1500, 0.5, 468, 112},
                               {'F', 900, 0.7, 393, 78.9}, {'A', 500, 1.0, 312, 49.7}, {'E', 340, 1.2, 255, 33.1},
                               {'D', 200, 1.5, 187, 17.9}, {'C', 100, 2.0, 125, 7.9}};
  BOOST_TEST(service_conditions().size() == std::size(table));
  for (std::size_t i = 0; i < std::size(table); ++i) {
    const auto& [name, pulse] = service_conditions()[i];
    const Printed& row = table[i];
    BOOST_TEST(name == row.name);
    BOOST_TEST(std::fabs(pulse.acceleration / standard_gravity - row.peak) < 1e-9);
    BOOST_TEST(std::fabs(1e3 * pulse.duration - row.milliseconds) < 1e-12);
    BOOST_TEST(std::fabs(100 * pulse.velocity() - row.velocity) < rounded);
    BOOST_TEST(std::fabs(100 * pulse.height(0) - row.height) < printed_g * row.height);
  }
}

BOOST_AUTO_TEST_CASE(the_mildest_condition_that_covers_a_blow_is_the_last_that_does) {
  BOOST_TEST(covering_condition(0.1, 10) == 'C');
  // A hair inside each condition is covered by it, a hair outside in either by the next one up.
  const auto& all = service_conditions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double velocity = all[i].pulse.velocity(), peak = all[i].pulse.acceleration;
    const char harder = i == 0 ? '-' : all[i - 1].name;
    BOOST_TEST(covering_condition(velocity * (1 - 1e-9), peak * (1 - 1e-9)) == all[i].name);
    BOOST_TEST(covering_condition(velocity * (1 + 1e-9), peak * (1 - 1e-9)) == harder);
    BOOST_TEST(covering_condition(velocity * (1 - 1e-9), peak * (1 + 1e-9)) == harder);
  }
}

BOOST_AUTO_TEST_CASE(an_equivalent_pulse_has_the_blow_s_numbers_and_the_fall_its_speed) {
  const TestPulse pulse = equivalent_pulse(7, 12'000);
  BOOST_TEST(std::fabs(pulse.velocity() / 7 - 1) < 1e-15);
  // A fall from h ends with √(2 g h), and (1 + e) times that is the change of velocity.
  for (const double e : {0.0, 0.5, 1.0})
    BOOST_TEST(std::fabs((1 + e) * std::sqrt(2 * standard_gravity * pulse.height(e)) / 7 - 1) < 1e-14);
}
