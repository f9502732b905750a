// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/edge_friction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/law/viscoelastic.hpp"
#include "analytic/space/landing/simultaneous.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "tests/analytic/space/landing/flat_landing.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::ImpactLaw;
using clatter::analytic::RestitutionLaw;
using clatter::oracle::check_energy_account;
using clatter::oracle::check_turned;
using clatter::oracle::coulomb;
using clatter::oracle::normal_velocity;
using clatter::oracle::Random;

constexpr double mass = 0.18;

/// An edge from `from` to `to` from the centre of mass, and what an independent program makes of its landing.
struct EdgeLanding {
  const char* name;
  Matrix3 inertia;
  Vector3 from, to, velocity, angular_velocity;
  double friction, restitution;
  RestitutionLaw law;
  Vector3 velocity_after, angular_velocity_after;
};

/// Of a box, leaning by `angle` about x.
Matrix3 leaning_box(double a, double b, double c, double angle = 0) {
  const Matrix3 lean = Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix();
  const Vector3 moments = mass / 12 * Vector3(b * b + c * c, a * a + c * c, a * a + b * b);
  return lean * moments.asDiagonal() * lean.transpose();
}

/// The landing turned by `angle` about the vertical, on a ground with c/k = `damping` for the viscoelastic law.
auto land_by(const auto& how, const EdgeLanding& l, double angle, double damping) {
  const Body body{.mass = mass, .inertia = l.inertia, .vertices = {}, .rims = {}};
  State before;
  before.attitude = Eigen::AngleAxisd(angle, Vector3::UnitZ());
  before.velocity = before.attitude * l.velocity;
  before.angular_velocity = before.attitude * l.angular_velocity;
  const std::vector<Corner> corners{{.index = 0, .place = l.from}, {.index = 1, .place = l.to}};
  ImpactLaw law = coulomb(l.restitution, l.friction, l.law);
  law.damping_per_stiffness = damping;
  return how(body, before, corners, law);
}

std::optional<GroupImpact> land(const EdgeLanding& l, double angle = 0, double damping = 0) {
  return land_by(rebound_as_a_whole, l, angle, damping);
}

/// A rod on the ground, its centre of mass at the height of the ground.
EdgeLanding rod(const Vector3& velocity, double spin) {
  return {.name = "rod",
          .inertia = Vector3(1e-7, 3e-4, 3e-4).asDiagonal(),
          .from = {-0.07, 0, 0},
          .to = {0.07, 0, 0},
          .velocity = velocity,
          .angular_velocity = {0, 0, spin},
          .friction = 0.2,
          .restitution = 0.5,
          .law = RestitutionLaw::newton,
          .velocity_after = {},
          .angular_velocity_after = {}};
}

/// By rigid-body dynamics in world axes with graded panels of Gauss's rule along the edge, the pressure point by a root
/// finder, Dormand–Prince steps in P at 3e-14.
const std::vector<EdgeLanding>& landings() {
  using enum RestitutionLaw;
  static const Matrix3 products = (Matrix3() << 0, 2e-5, -1e-5, 2e-5, 0, 3e-5, -1e-5, 3e-5, 0).finished();
  static const std::vector<EdgeLanding> all = {
      {"a box leaning on its edge",
       leaning_box(0.14, 0.07, 0.05, 0.6),
       {-0.07, 0.015, -0.04},
       {0.07, 0.015, -0.04},
       {0.3, 0.2, -1},
       {1, 0, 15},
       0.3,
       0.5,
       newton,
       {0.21978767061809143, -0.024161073180635796, 0.24232274523768085},
       {16.678483650821278, 0, 11.326416004477295}},
      {"an edge one end of which comes down faster",
       leaning_box(0.14, 0.07, 0.05, 0.6),
       {-0.07, 0.015, -0.04},
       {0.07, 0.015, -0.04},
       {0.3, 0.2, -1},
       {1, -3, 12},
       0.25,
       0.6,
       poisson,
       {0.2105923314823587, -0.01316421336787291, 0.278807426344769},
       {18.279258692632382, 1.6842527108657546, 10.820604005075646}},
      {"products of inertia, aslant and aside",
       leaning_box(0.14, 0.07, 0.05) + products,
       {-0.06, 0.02, -0.03},
       {0.075, 0.01, -0.03},
       {-0.4, 0.3, -1},
       {2, 4, -20},
       0.25,
       0.5,
       stronge,
       {-0.33032648056778374, 0.17905460193367254, 0.09201799078706703},
       {24.295683997695086, -3.8117022966234453, -16.32126700494123}},
      {"pressure on a part of the edge",
       leaning_box(0.14, 0.07, 0.1),
       {-0.07, 0.005, -0.05},
       {0.07, 0.005, -0.05},
       {1.3, 0.2, -1},
       {0, 0, 6},
       0.55,
       0.3,
       stronge,
       {0.6083118775057131, 0.0467493524285123, 0.3055584130629195},
       {-0.9138848160481492, 0, 4.009624172354333}},
      {"slide and spin stop",
       leaning_box(0.14, 0.07, 0.05),
       {-0.07, 0.01, -0.03},
       {0.07, 0.01, -0.03},
       {0.05, 0.02, -1},
       {0, 1, 4},
       0.5,
       0.5,
       stronge,
       {-0.014995499832852864, -0.2671886587699525, 0.41078710823308734},
       {8.906288625782109, -0.4998499944909101, 0}},
      {"a needle",
       Vector3(1e-7, 3e-4, 3e-4).asDiagonal(),
       {-0.07, 0, 0},
       {0.07, 0, 0},
       {0.3, 0.1, -1},
       {0, 2, 15},
       0.3,
       0.5,
       poisson,
       {0.07550663014517918, 0.033285328881994695, 0.5},
       {0, -1, 6.46479668857517}},
  };
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(landings_of_edges_agree_with_an_independent_program) {
  constexpr double tolerance = 1e-9;
  for (const EdgeLanding& l : landings()) {
    BOOST_TEST_CONTEXT(l.name) {
      const auto whole = land(l);
      BOOST_REQUIRE(whole.has_value());
      BOOST_TEST((whole->velocity_after - l.velocity_after).norm() <= tolerance);
      BOOST_TEST((whole->angular_velocity_after - l.angular_velocity_after).norm() <= tolerance * 20);
      check_energy_account({.mass = mass, .inertia = l.inertia, .vertices = {}, .rims = {}}, l, *whole);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_landing_of_an_edge_turned_or_seen_in_a_mirror_or_from_its_other_end_is_the_same_landing) {
  constexpr double tolerance = 2e-13;
  for (const EdgeLanding& l : landings()) {
    BOOST_TEST_CONTEXT(l.name) {
      const auto whole = land(l), turned = land(l, 0.7);
      BOOST_REQUIRE(whole && turned);
      check_turned(*whole, *turned, 0.7, tolerance);
      EdgeLanding mirrored = l;  // y → −y, and the ends
      const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
      mirrored.inertia = mirror * l.inertia * mirror;
      mirrored.from = mirror * l.to, mirrored.to = mirror * l.from;
      mirrored.velocity = mirror * l.velocity, mirrored.angular_velocity = -mirror * l.angular_velocity;
      const auto seen = land(mirrored);
      BOOST_REQUIRE(seen.has_value());
      BOOST_TEST((mirror * seen->velocity_after - whole->velocity_after).norm() <= tolerance);
      BOOST_TEST((mirror * seen->angular_velocity_after + whole->angular_velocity_after).norm() <= 20 * tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rod_that_lands_level_and_spins_loses_mu_p_l_over_4_of_its_spin) {
  constexpr double tolerance = 1e-13;
  const double loss = 0.2 * 1.5 * mass * 0.14 / 4 / 3e-4;
  const auto spun = land(rod({0, 0, -1}, 20)), stopped = land(rod({0, 0, -1}, loss / 2));
  BOOST_REQUIRE(spun && stopped);
  BOOST_TEST(std::fabs(spun->angular_velocity_after.z() - (20 - loss)) <= 20 * tolerance);
  BOOST_TEST(spun->velocity_after.head<2>().norm() <= tolerance);
  BOOST_TEST(std::fabs(stopped->angular_velocity_after.z()) <= 20 * tolerance);
  BOOST_CHECK(stopped->path == PathKind::slip_stick);
}

BOOST_AUTO_TEST_CASE(a_rod_that_hardly_spins_while_it_slides_is_held_by_a_couple_in_proportion_to_the_spin) {
  constexpr double tolerance = 1e-12, rounding = 4e-15;
  for (const double spin : {0.0, 1e-12, -1e-9, 1e-7}) {
    const Vector3 along = rub_of_edge({2, 0, 2 * spin}, 0), across = rub_of_edge({0, 2, 2 * spin}, 0);
    BOOST_TEST((along - Vector3(1, 0, spin / 3)).norm() <= tolerance * std::fabs(spin) + rounding);
    BOOST_TEST((across - Vector3(0, 1, 0)).norm() <= rounding);  // all points slip one way
  }
}

BOOST_AUTO_TEST_CASE(a_rod_that_slides_straight_loses_mu_p_over_m_along_or_across_itself) {
  constexpr double tolerance = 1e-13;
  for (const Vector3& s : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0.6, 0.8, 0)}) {
    const auto slid = land(rod(s - Vector3::UnitZ(), 0));
    BOOST_REQUIRE(slid.has_value());
    BOOST_TEST((slid->velocity_after - 0.7 * s - 0.5 * Vector3::UnitZ()).norm() <= tolerance);
    BOOST_TEST(slid->angular_velocity_after.norm() <= tolerance);
  }
}

// The work of the ground is that of the normal velocity alone, whose change is P/m.
BOOST_AUTO_TEST_CASE(a_rod_that_slides_to_a_stop_rebounds_by_its_law_however_little_it_spins) {
  constexpr double tolerance = 1e-12;
  using enum RestitutionLaw;
  for (const double spin : {0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1.0}) {
    for (const double friction : {0.21, 0.29, 0.3, 0.35, 1.0, 4.0}) {
      for (const RestitutionLaw law : {newton, poisson, stronge, viscoelastic}) {
        EdgeLanding low = rod({0.3, 0, -1}, spin);
        low.from.z() = low.to.z() = -0.001;
        low.friction = friction, low.law = law, low.restitution = law == viscoelastic ? 1 : 0.5;
        const auto whole = land(low, 0.4, law == viscoelastic ? 0.7 : 0);
        BOOST_REQUIRE(whole.has_value());
        const double e = law == viscoelastic ? clatter::analytic::restitution_of_damping(0.7) : 0.5;
        const bool stops = friction * (1 + e) >= 0.3;
        BOOST_TEST(std::fabs(whole->velocity_after.z() - e) <= tolerance);
        BOOST_TEST(std::fabs(whole->velocity_after.head<2>().norm() - (stops ? 0 : 0.3 - friction * (1 + e))) <=
                   std::fmax(tolerance, 0.01 * spin * spin));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rubbing_along_an_edge_is_the_integral_over_its_pressed_part) {
  constexpr double tolerance = 1e-13;  // of the sum over 4000 panels, whose x and pressure lose digits
  Random random(5);
  for (int i = 0; i < (CLATTER_TEST_SLOW_BUILD ? 30 : 300); ++i) {
    const Vector3 slip = random.vector(1).cwiseProduct(Vector3(std::pow(10, random.uniform(-8, 0)), 1, 1));
    if (slip.head<2>().norm() > 5 * std::fabs(slip[2])) continue;  // the sum loses digits
    const double point = random.uniform(-0.999, 0.999);
    const double length = std::fmin(2, 3 * (1 - std::fabs(point))), inner = std::fmin(std::fabs(point), 1.0 / 3);
    const double start = point > 0 ? 1 - length : -1;
    const auto pressure = [&](double x) {  // trapezoid or triangle of mean `point`
      const double y = 2 * (x - start) / length - 1;
      return (1 + std::copysign(3 * inner, point) * y) / length;
    };
    // z = |α| sinh t makes the direction of slip (sech t, tanh t) smooth.
    const double pole = -slip[1] / slip[2], width = std::fabs(slip[0] / slip[2]);
    const double from = std::asinh((start - pole) / width), to = std::asinh((start + length - pole) / width);
    Vector3 sum = Vector3::Zero();
    constexpr int panels = 4000;
    for (int k = 0; k < panels; ++k) {
      for (const double node : {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}) {
        const double t = from + (to - from) * (k + (1 + node) / 2) / panels, x = pole + width * std::sinh(t);
        const double z = slip[1] + slip[2] * x, weight = (node == 0 ? 8 : 5) / 18.0 * (to - from) / panels;
        sum += weight * width * std::cosh(t) * pressure(x) / std::hypot(slip[0], z) * Vector3(slip[0], z, x * z);
      }
    }
    BOOST_TEST((rub_of_edge(slip, point) - sum).norm() <= tolerance / length);
  }
}

BOOST_AUTO_TEST_CASE(an_edge_that_stands_so_high_that_friction_along_it_tips_it_is_pushed_at_its_end) {
  constexpr double tolerance = 1e-12;
  EdgeLanding high = rod({3, 0, -1}, 0);
  high.friction = 0.5;
  high.inertia = leaning_box(0.14, 0.07, 0.05);
  for (const double height : {0.139, 0.141, 0.15}) {  // of the length 0.14 the pressure may use half
    high.from.z() = high.to.z() = -height;
    const auto landed = land(high);
    BOOST_REQUIRE(landed.has_value());
    const double tilt = 1.5 * mass * (0.5 * height - std::fmin(0.5 * height, 0.07)) / high.inertia(1, 1);
    BOOST_TEST((landed->velocity_after - Vector3(3 - 0.75, 0, 0.5)).norm() <= tolerance);
    BOOST_TEST((landed->angular_velocity_after - Vector3(0, tilt, 0)).norm() <= 20 * tolerance);
    BOOST_TEST(landed->tilts == (height > 0.14));
    BOOST_TEST(landed->is_whole == !landed->tilts);
  }
}

BOOST_AUTO_TEST_CASE(a_slip_or_spin_of_1e_9_changes_the_landing_of_a_high_edge_by_as_little_and_mirrors_mirror_it) {
  constexpr double kick = 1e-9;
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  Random random(19);
  int tilted = 0, lost = 0;
  for (int n = 0; n < 40; ++n) {
    const auto little = [&] { return std::pow(10.0, -random.whole(0, 12)) * random.uniform(-1, 1); };
    EdgeLanding l = rod({little(), little(), -1}, 0);
    l.angular_velocity.z() = 10 * little();
    const double lean = random.uniform(-0.6, 0.6), height = random.uniform(0.05, 0.3);
    l.inertia = leaning_box(0.14, 0.07, height, lean);
    l.from = {-0.07, 0.05 * std::sin(lean), -height}, l.to = {0.07, 0.05 * std::sin(lean), -height};
    l.friction = random.uniform(0.1, 1);
    l.law = n % 2 == 0 ? RestitutionLaw::poisson : RestitutionLaw::stronge;
    const auto whole = land(l);
    BOOST_TEST_CONTEXT("landing " << n) {
      if (!whole) {  // its slip could not be followed
        ++lost;
        BOOST_TEST(land_by(strike_together, l, 0, 0).is_open);
        continue;
      }
      if (whole->tilts) ++tilted;
      BOOST_TEST(whole->energy_loss >= -1e-12);
      EdgeLanding other = l;
      other.velocity += kick * Vector3(0.6, -0.8, 0);
      other.angular_velocity.z() += kick;
      const auto kicked = land(other);
      BOOST_REQUIRE(kicked.has_value());
      const double margin = 3 * whole->path_error + 1e-11;
      BOOST_TEST((kicked->velocity_after - whole->velocity_after).norm() <= margin + 300 * kick);
      BOOST_TEST((kicked->angular_velocity_after - whole->angular_velocity_after).norm() <= 20 * (margin + 300 * kick));
      EdgeLanding seen = l;
      seen.inertia = mirror * l.inertia * mirror;
      seen.from = mirror * l.to, seen.to = mirror * l.from;
      seen.velocity = mirror * l.velocity, seen.angular_velocity = -mirror * l.angular_velocity;
      const auto image = land(seen);
      BOOST_REQUIRE(image.has_value());
      BOOST_TEST((mirror * image->velocity_after - whole->velocity_after).norm() <= margin);
      BOOST_TEST((mirror * image->angular_velocity_after + whole->angular_velocity_after).norm() <= 20 * margin);
    }
  }
  BOOST_TEST(tilted > 8);
  BOOST_TEST(lost < 10);
}

BOOST_AUTO_TEST_CASE(an_edge_at_rest_that_friction_cannot_hold_slips_as_one_that_slips_a_little_does) {
  constexpr double little = 1e-9, tolerance = 1e-7;
  EdgeLanding driven = landings()[2];
  driven.friction = 0.05;
  driven.angular_velocity = {1, 2, 0};
  const Vector3 turning = driven.angular_velocity.cross((driven.from + driven.to) / 2);
  driven.velocity = Vector3(0, 0, -1) - Vector3(turning.x(), turning.y(), 0);
  const auto slipped = land(driven);
  BOOST_REQUIRE(slipped.has_value());
  BOOST_CHECK(slipped->path == PathKind::slip);
  for (const Vector3& push : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)}) {
    EdgeLanding pushed = driven;
    pushed.velocity += little * push;
    const auto other = land(pushed);
    BOOST_REQUIRE(other.has_value());
    BOOST_TEST((other->velocity_after - slipped->velocity_after).norm() <= tolerance);
    BOOST_TEST((other->angular_velocity_after - slipped->angular_velocity_after).norm() <= 20 * tolerance);
  }
  driven.friction = 1;
  const auto held = land(driven);
  BOOST_REQUIRE(held.has_value());
  BOOST_CHECK(held->path == PathKind::stick);
  BOOST_TEST(std::fabs(held->angular_velocity_after.z()) <= 1e-13);
}

// By little: slip would die out a hundred times slower than it turns to the direction in which it does.
BOOST_AUTO_TEST_CASE(an_edge_that_friction_can_hold_sticks_by_however_little_or_much) {
  EdgeLanding held = rod({0, 0, -1}, 0);
  held.inertia << 1.2769e-3, 3.54e-4, 2.308e-4, 3.54e-4, 9.751e-4, -8.9e-5, 2.308e-4, -8.9e-5, 1.5435e-3;
  held.from = {-0.03805784, -0.04572437, -0.02366973};
  held.to = {-0.02287285, 0.13216081, -0.02366973};
  for (const double friction : {0.142, 0.5, 2.0, 10.0}) {  // slip under much friction would tip it
    held.friction = friction;
    const auto landed = land(held);
    BOOST_REQUIRE(landed.has_value());
    BOOST_CHECK(landed->path == PathKind::stick);
  }
  held.friction = 0.12;  // less than what holding it takes
  const auto slipped = land(held);
  BOOST_REQUIRE(slipped.has_value());
  BOOST_CHECK(slipped->path == PathKind::slip);
}

BOOST_AUTO_TEST_CASE(stronges_law_takes_energy_from_edges_both_ends_of_which_keep_the_ratio_of_their_speeds) {
  Random random(12);
  constexpr int landings = CLATTER_TEST_SLOW_BUILD ? 150 : 1500;
  int whole = 0, both = 0;
  for (int i = 0; i < landings; ++i) {
    EdgeLanding l = rod({random.uniform(-1, 1), random.uniform(-1, 1), -1}, random.uniform(-30, 30));
    const Matrix3 turn = random.attitude().toRotationMatrix();
    l.inertia = turn * leaning_box(0.14, random.uniform(0.01, 0.1), random.uniform(0.01, 0.1)) * turn.transpose();
    l.from = {-random.uniform(0, 0.1), random.uniform(-0.05, 0.05), -random.uniform(0, 0.1)};
    l.to = l.from + Vector3(random.uniform(0.05, 0.2), random.uniform(-0.05, 0.05), 0);
    l.angular_velocity.head<2>() = random.vector(5).head<2>();
    l.friction = std::pow(10, random.uniform(-2, 0.7)), l.restitution = random.uniform(0, 1);
    l.law = RestitutionLaw::stronge;
    const auto impact = land(l);
    if (!impact) continue;
    ++whole;
    const double energy =
        (mass * l.velocity.squaredNorm() + l.angular_velocity.dot(l.inertia * l.angular_velocity)) / 2;
    BOOST_TEST(impact->energy_loss >= -1e-13 * energy);
    const double a = normal_velocity(l.velocity, l.angular_velocity, l.from);
    const double b = normal_velocity(l.velocity, l.angular_velocity, l.to);
    if (!(a < 0 && b < 0) || impact->tilts) continue;
    ++both;
    const double a_after = normal_velocity(impact->velocity_after, impact->angular_velocity_after, l.from);
    const double b_after = normal_velocity(impact->velocity_after, impact->angular_velocity_after, l.to);
    BOOST_TEST(std::fabs(a_after * b - b_after * a) <= 1e-12 * (std::fabs(a) + std::fabs(b)));
  }
  BOOST_TEST(3 * whole > landings);
  BOOST_TEST(6 * both > landings);
}
