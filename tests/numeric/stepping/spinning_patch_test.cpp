// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of patches that spin about the vertical, in every law, against closed forms.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double mu = 0.3, mass = 1, length = 0.2, width = 0.1;
const double inertia = mass / 12 * (length * length + width * width);

constexpr double promised = 1e-6;  ///< six digits were asked for
constexpr FrictionLaw laws[] = {FrictionLaw::coulomb, FrictionLaw::local};

/// Mean distance of a rectangle's points from its middle.
double mean_arm(double a, double b) {
  const double p = a / 2, q = b / 2;
  return std::hypot(p, q) / 3 + p * p / (6 * q) * std::asinh(q / p) + q * q / (6 * p) * std::asinh(p / q);
}

Ground bed(FrictionLaw law) {
  return with_friction({.stiffness = 1e8, .area = AreaMeasure::projected, .friction = law}, mu);
}

/// A plate that lands level with 1 m/s.
ImpactNumbers landed(FrictionLaw law, double slip, double spin, const Accuracy& accuracy = {}) {
  const Body body = box_body({length, width, 0.05}, mass);
  MotionState start = touching_state(body, {.velocity = {slip, 0, -1}});
  start.angular_velocity = {0, 0, spin};
  const Simulation run = simulate(body, weightless(bed(law)), start, plain, accuracy);
  return run.impacts.at(0).value;
}

}  // namespace

/// P_n = 2 m v, Δω = −μ P_n c̄/I, c̄ the mean arm.
BOOST_AUTO_TEST_CASE(a_level_face_that_spins_without_slip_has_the_couple_of_its_even_pressure) {
  const double spin_after = 10 - mu * 2 * mass * mean_arm(length, width) / inertia;
  for (const FrictionLaw law : laws) {
    const ImpactNumbers n = landed(law, 0, 10);
    BOOST_TEST(n.angular_velocity_after.z() == spin_after, boost::test_tools::tolerance(promised));
    BOOST_TEST(landed(law, 0, -10).angular_velocity_after.z() == -spin_after, boost::test_tools::tolerance(promised));
    BOOST_TEST(std::hypot(n.velocity_after.x(), n.velocity_after.y()) <= promised);
  }
}

BOOST_AUTO_TEST_CASE(spin_that_friction_can_stop_is_stopped_and_held) {
  for (const FrictionLaw law : laws) {
    for (const double spin : {1.0, 1e-3, 1e-6, 1e-9})
      BOOST_TEST(std::fabs(landed(law, 0, spin).angular_velocity_after.z()) <= promised);
  }
}

/// Neither one nanometre a second nor the smallest number of doubles chooses another law.
BOOST_AUTO_TEST_CASE(friction_is_continuous_where_a_spinning_patch_does_not_slip) {
  const double still = landed(FrictionLaw::coulomb, 0, 10).angular_velocity_after.z();
  for (const double slip : {1e-300, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    const ImpactNumbers n = landed(FrictionLaw::coulomb, slip, 10);
    BOOST_TEST(std::fabs(n.angular_velocity_after.z() - still) <= slip + promised);
    BOOST_TEST(std::fabs(n.velocity_after.x()) <= slip + 1e-12);
  }
  double previous = still;
  for (double slip = 1e-2; slip < 1; slip *= 1.2) {
    const double spin = landed(FrictionLaw::coulomb, slip, 10).angular_velocity_after.z();
    BOOST_TEST(std::fabs(spin - previous) <= 5 * slip);
    previous = spin;
  }
}

/// ω̇ = −μ m g c̄/I: half the side's bed carries the plate, which stops and stays.
BOOST_AUTO_TEST_CASE(a_plate_that_spins_on_the_ground_comes_to_rest_in_the_time_that_even_pressure_takes) {
  const double side = 2, weight = 4 * 9.81, friction = 0.245, spin = 1;
  const Body body = box_body({side, side, 0.1}, 4);
  const Ground ground = with_friction({.stiffness = 1e7, .damping = 3e9, .area = AreaMeasure::projected}, friction);
  MotionState start = touching_state(body, {.velocity = {0, 0, -1e-3}});
  start.angular_velocity = {0, 0, spin};
  const Simulation run = simulate(body, {.ground = ground}, start, plain);
  BOOST_TEST((run.outcome == Outcome::at_rest));
  const double vertical = 4.0 / 12 * 2 * side * side;
  const double stops_after = spin * vertical / (friction * weight * mean_arm(side, side));
  BOOST_TEST(std::fabs(run.impacts.at(0).value.duration / stops_after - 1) <= 2e-3);  // the landing's own push
}

/// A corner that holds its place and turns about it rubs a little; how little spin it began with is no step.
BOOST_AUTO_TEST_CASE(the_spin_of_a_corner_that_holds_changes_the_impact_continuously) {
  const Body body = box_body({0.15, 0.075, 0.008}, 0.18);
  const Ground ground = with_friction({.stiffness = 1e9, .area = AreaMeasure::projected}, 0.9);
  const auto after = [&](double spin) {
    MotionState start =
        touching_state(body, {.inclination = 30 * degree, .velocity = {0, 0, -1}, .out_of_plane_tilt = 20 * degree});
    start.angular_velocity = start.attitude.conjugate() * Vector3(0, 0, spin);
    return simulate(body, weightless(ground), start, plain).impacts.at(0).value.velocity_after;
  };
  const Vector3 none = after(0);
  for (const double spin : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1})
    BOOST_TEST((after(spin) - none).norm() <= promised + 0.1 * spin);
}

/// Flat: v √(m/(k A)).
BOOST_AUTO_TEST_CASE(the_indentation_of_a_flat_landing_is_that_of_a_linear_spring) {
  const double depth = std::sqrt(mass / (1e8 * length * width));
  BOOST_TEST(landed(FrictionLaw::coulomb, 0, 0).indentation == depth, boost::test_tools::tolerance(1e-8));
}

/// A cube's corner, straight down: the cap has the volume √3/2 δ³, F = k √3/2 δ³, so that ½ m v² = k √3/8 δ⁴.
BOOST_AUTO_TEST_CASE(the_indentation_of_a_cubes_corner_takes_up_its_energy) {
  const Body body = box_body({0.1, 0.1, 0.1}, mass);
  const Ground ground{.stiffness = 1e9, .area = AreaMeasure::projected};
  MotionState start;
  start.attitude = Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1), Vector3(0, 0, -1));
  start.velocity = {0, 0, -1};
  start = on_ground(body, start);
  const Simulation run = simulate(body, weightless(ground), start, plain, {.digits = 8});
  const double depth = std::pow(4 * mass / (1e9 * std::sqrt(3.0)), 0.25);
  BOOST_TEST(run.impacts.at(0).value.indentation == depth, boost::test_tools::tolerance(1e-8));
}
