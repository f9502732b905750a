// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/face_friction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "tests/analytic/space/landing/flat_landing.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::oracle::check_energy_account;
using clatter::oracle::check_turned;
using clatter::oracle::coulomb;
using clatter::oracle::Random;

const ContactArea disc{.corners = {Vector2::Zero()}, .radius = 1};

ContactArea rectangle(double a, double b, const Vector2& centre = Vector2::Zero()) {
  ContactArea area;
  for (const auto& [x, y] : {std::pair{-a, -b}, {a, -b}, {a, b}, {-a, b}}) {
    area.corners.emplace_back(centre + Vector2(x, y) / 2);
  }
  return area;
}

/// Couple of friction about the centre of an evenly pressed area that only spins, per μN and unit.
double couple_of_spin(const ContactArea& area) {
  const PressedArea pressed(area);
  return pressed.slip_moments(Vector2::Zero(), 1)(2, 0) / pressed.moments()(0, 0) * pressed.unit();
}

struct Landing {
  const char* name;
  double depth;
  ContactArea area;
  Vector3 moments, products;  ///< of inertia: xx, yy, zz; xy, xz, yz
  double friction, restitution;
  Vector3 velocity, angular_velocity;
  Vector3 velocity_after;
  double spin_after;
};

constexpr double mass = 0.18;

Body body_of(const Landing& l) {
  Body body{.mass = mass, .inertia = l.moments.asDiagonal(), .vertices = {}, .rims = {}};
  body.inertia(0, 1) = body.inertia(1, 0) = l.products[0];
  body.inertia(0, 2) = body.inertia(2, 0) = l.products[1];
  body.inertia(1, 2) = body.inertia(2, 1) = l.products[2];
  return body;
}

Vector3 of_box(double a, double b, double c) {
  return mass / 12 * Vector3(b * b + c * c, a * a + c * c, a * a + b * b);
}

/// The landing turned by `angle` about the vertical.
std::optional<GroupImpact> land(const Landing& l, double angle = 0) {
  Body body = body_of(l);
  const Quaternion turn(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
  State before;
  before.attitude = turn;
  before.velocity = turn * l.velocity;
  before.angular_velocity = turn * l.angular_velocity;
  std::vector<Corner> corners;
  if (l.area.radius > 0) {
    const Vector2& c = l.area.corners.front();
    body.rims = {{.centre = {c.x(), c.y(), -l.depth}, .axis = Vector3::UnitZ(), .radius = l.area.radius}};
    corners = {{.index = 0, .place = body.rims.front().centre, .radius = l.area.radius}};
  } else {
    for (const Vector2& c : l.area.corners) {
      corners.push_back({.index = static_cast<int>(corners.size()), .place = {c.x(), c.y(), -l.depth}});
    }
  }
  return rebound_as_a_whole(body, before, corners, coulomb(l.restitution, l.friction));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_face_that_only_spins_is_held_by_the_couple_of_its_mean_distance_from_the_centre) {
  constexpr double tolerance = 1e-14;
  BOOST_TEST(std::fabs(couple_of_spin(disc) - 2.0 / 3) <= tolerance);
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.14, 0.07}, {2.0, 1e-3}}) {
    const double x = a / 2, y = b / 2;
    const double mean =
        std::hypot(x, y) / 3 + x * x / (6 * y) * std::asinh(y / x) + y * y / (6 * x) * std::asinh(x / y);
    BOOST_TEST(std::fabs(couple_of_spin(rectangle(a, b)) - mean) <= tolerance * mean);
  }
}

BOOST_AUTO_TEST_CASE(a_face_that_slides_and_hardly_spins_is_held_by_a_couple_in_proportion_to_the_spin) {
  constexpr double tolerance = 1e-12, rounding = 2e-16;
  for (const ContactArea& area : {disc, rectangle(0.14, 0.07), rectangle(1, 3)}) {
    const PressedArea pressed(area);
    const Matrix3 moments = pressed.moments();
    for (const double spin : {0.0, 1e-12, -1e-9, 1e-7}) {
      const Matrix3 slip = pressed.slip_moments({2, 0}, 2 * spin);
      BOOST_TEST(std::fabs(slip(0, 0) - moments(0, 0)) <= tolerance * moments(0, 0));
      BOOST_TEST(std::fabs(slip(2, 0) - spin * moments(1, 1)) <= tolerance * std::fabs(spin) + rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(integrals_over_what_a_pressure_pushes_and_what_it_would_pull_sum_to_those_over_the_area) {
  constexpr double tolerance = 5e-14;
  Random random(3);
  int cut = 0;
  for (int i = 0; i < 2000; ++i) {
    PressedArea area(i % 2 == 0 ? disc : rectangle(random.uniform(0.2, 2), 1, {0.3, -0.2}));
    const Vector3 pressure = random.vector(1);
    const Vector2 slip = std::pow(10, random.uniform(-3, 3)) * random.vector(1).head<2>();
    const double spin = random.uniform(-1, 1);
    const Matrix3 moments = area.moments(), slips = area.slip_moments(slip, spin);
    Matrix3 moments_sum = Matrix3::Zero(), slips_sum = Matrix3::Zero();
    bool whole = false;
    for (const double sign : {1.0, -1.0}) {
      whole = area.press(sign * pressure) || whole;
      if (area.is_empty()) continue;
      moments_sum += area.moments(), slips_sum += area.slip_moments(slip, spin);
    }
    if (!whole) ++cut;
    BOOST_TEST((moments - moments_sum).norm() <= tolerance * moments.norm());
    BOOST_TEST((slips - slips_sum).norm() <= tolerance * moments.norm());
  }
  BOOST_TEST(cut > 1000);
}

BOOST_AUTO_TEST_CASE(integrals_are_continuous_where_their_method_changes) {
  constexpr double tolerance = 5e-14;
  for (ContactArea area : {disc, rectangle(1, 0.6), rectangle(0.2, 3)}) {
    PressedArea pressed(area);
    const double size = pressed.moments().norm();
    for (const Vector3& pressure : {Vector3(1, 0, 0), Vector3(0.1, 0.7, -0.4)}) {
      pressed.press(pressure);
      for (const double angle : {0.1, 1.0, 2.0, 4.0}) {
        const Vector2 slip(std::cos(angle), std::sin(angle));
        constexpr double third = 1.0 / 3;
        const Matrix3 below = pressed.slip_moments(slip, third - 1e-15),
                      above = pressed.slip_moments(slip, third + 1e-15);
        BOOST_TEST((below - above).norm() <= tolerance * size);
      }
    }
  }
}

/// Landings by an independent program: other quadratures (graded cones about the pole), pressure by a root finder,
/// Dormand–Prince steps in P at 1e-12; `slips from rest` by a root finder for its one direction.
const std::vector<Landing>& landings() {
  static const std::vector<Landing> all = {
      {"a box that slides and spins",
       0.004,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.008),
       {0, 0, 0},
       0.3,
       0.5,
       {0.3, 0, -1},
       {0, 0, 20},
       {0.1648687029928202, -0.002443208563788837, 0.5},
       11.33330442199776},
      {"a box that tilts too",
       0.02,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.04),
       {0, 0, 0},
       0.4,
       0.5,
       {0.3, 0.2, -1},
       {2, -3, 15},
       {0.07972011909925159, 0.09523204871627665, 0.5},
       4.360042894931391},
      {"products of inertia, the face aside",
       0.02,
       rectangle(0.14, 0.07, {0.01, -0.008}),
       of_box(0.14, 0.07, 0.04),
       {2e-5, -1e-5, 3e-5},
       0.3,
       0.6,
       {0.3, 0.2, -1},
       {2, -1, 8},
       {0.03103166887837657, 0.04345268277078153, 0.6},
       1.308278722969069},
      {"pressure on a part of the face",
       0.05,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.1),
       {0, 0, 0},
       0.45,
       0.3,
       {1.3, 0.2, -1},
       {0, 0, 6},
       {0.7395993064477298, 0.06690461077119135, 0.3},
       4.315108345064561},
      {"slide and spin stop",
       0.01,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.02),
       {0, 0, 0},
       0.4,
       0.5,
       {0.3, 0.1, -1},
       {0, 0, 6},
       {0, 0, 0.5},
       0},
      {"a spin alone",
       0.01,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.02),
       {0, 0, 0},
       0.2,
       0.5,
       {0, 0, -1},
       {0, 0, 30},
       {0, 0, 0.5},
       23.89817057757651},
      {"a pole far outside",
       0.01,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.02),
       {0, 0, 0},
       0.2,
       0.5,
       {2, 0.5, -1},
       {0, 0, 3},
       {1.709611087004753, 0.4267395486288038, 0.5},
       2.661218906981814},
      {"slip nearly stops and turns back",
       0.03,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.06),
       {0, 0, 0},
       0.1,
       0.9,
       {-0.09, -0.015, -1},
       {1, 6, 0.5},
       {-0.08233696956912644, 0.01177907738519151, 0.9},
       0.07672564369997278},
      {"slips from rest",
       0.03,
       rectangle(0.14, 0.07),
       of_box(0.14, 0.07, 0.06),
       {2e-5, -1e-5, 3e-5},
       0.1,
       0.9,
       {0.18, -0.03, -1},
       {1, 6, 0},
       {-0.006775106933793185, -0.003120525907367167, 0.9},
       0.5015656654480013},
      {"a disc",
       0.02,
       {.corners = {{0, 0}}, .radius = 0.06},
       {3e-4, 2.5e-4, 4e-4},
       {0, 0, 0},
       0.3,
       0.5,
       {0.3, 0.1, -1},
       {0, 0, 20},
       {0.1925361987308732, 0.05159872810213719, 0.5},
       12.32579434897131},
      {"a disc aside that tilts",
       0.03,
       {.corners = {{0.01, -0.005}}, .radius = 0.06},
       {3e-4, 2.5e-4, 4e-4},
       {1e-5, 2e-5, -1e-5},
       0.4,
       0.5,
       {0.7, 0.1, -1},
       {2, 1, 9},
       {0.1896415370487159, -0.01894602386038788, 0.5},
       4.188431017338657},
      {"pressure on a part of a disc",
       0.06,
       {.corners = {{0.002, -0.005}}, .radius = 0.06},
       {3e-4, 2.5e-4, 4e-4},
       {1e-5, 2e-5, -1e-5},
       0.4,
       0.5,
       {0.9, 0.1, -1},
       {0.5, 0, 9},
       {0.3618824233250765, -0.05803057810536594, 0.5},
       6.579698998834603},
  };
  return all;
}

BOOST_AUTO_TEST_CASE(landings_with_slide_spin_tilt_and_cut_pressure_agree_with_an_independent_program) {
  constexpr double tolerance = 1e-9;
  for (const Landing& l : landings()) {
    BOOST_TEST_CONTEXT(l.name) {
      const auto whole = land(l);
      BOOST_REQUIRE(whole.has_value());
      BOOST_TEST((whole->velocity_after - l.velocity_after).norm() <= tolerance);
      BOOST_TEST(std::fabs(whole->angular_velocity_after.z() - l.spin_after) <= tolerance * 20);
      const Vector2 tilting = whole->angular_velocity_after.head<2>() + l.restitution * l.angular_velocity.head<2>();
      BOOST_TEST(tilting.norm() <= 1e-13);
      check_energy_account(body_of(l), l, *whole);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_landing_turned_about_the_vertical_or_seen_in_a_mirror_is_the_same_landing) {
  constexpr double tolerance = 2e-13;
  for (const Landing& l : landings()) {
    BOOST_TEST_CONTEXT(l.name) {
      const auto whole = land(l), turned = land(l, 0.7);
      BOOST_REQUIRE(whole && turned);
      check_turned(*whole, *turned, 0.7, tolerance);
      BOOST_CHECK(turned->path == whole->path);
      Landing mirrored = l;  // y → −y
      mirrored.velocity.y() *= -1;
      mirrored.angular_velocity.x() *= -1, mirrored.angular_velocity.z() *= -1;
      mirrored.products[0] *= -1, mirrored.products[2] *= -1;
      for (Vector2& corner : mirrored.area.corners) corner.y() *= -1;
      const auto mirror = land(mirrored);
      BOOST_REQUIRE(mirror.has_value());
      BOOST_TEST(std::fabs(mirror->velocity_after.y() + whole->velocity_after.y()) <= tolerance);
      BOOST_TEST(std::fabs(mirror->angular_velocity_after.z() + whole->angular_velocity_after.z()) <= 20 * tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_evenly_pressed_disc_that_only_spins_loses_two_thirds_of_mu_p_r) {
  constexpr double tolerance = 1e-14;
  Landing can{.name = "can",
              .depth = 0.3,
              .area = {.corners = {Vector2::Zero()}, .radius = 0.06},
              .moments = {3e-4, 3e-4, 4e-4},
              .products = Vector3::Zero(),
              .friction = 0.2,
              .restitution = 0.5,
              .velocity = {0, 0, -1},
              .angular_velocity = {0, 0, 20},
              .velocity_after = {},
              .spin_after = 0};
  const auto spun = land(can);
  BOOST_REQUIRE(spun.has_value());
  const double loss = 2.0 / 3 * 0.2 * 0.06 * 1.5 * mass / 4e-4;
  BOOST_TEST(std::fabs(spun->angular_velocity_after.z() - (20 - loss)) <= 20 * tolerance);
  BOOST_TEST(spun->velocity_after.head<2>().norm() <= tolerance);
  can.angular_velocity.z() = loss / 2;
  const auto stopped = land(can);
  BOOST_REQUIRE(stopped.has_value());
  BOOST_TEST(stopped->angular_velocity_after.z() == 0);
  BOOST_CHECK(stopped->path == PathKind::slip_stick);
}

BOOST_AUTO_TEST_CASE(a_face_with_hardly_any_spin_lands_as_one_without) {
  Landing flat = landings().front();
  flat.angular_velocity.setZero();
  const auto straight = land(flat);
  flat.angular_velocity.z() = 1e-8;
  const auto spinning = land(flat);
  BOOST_REQUIRE(straight && spinning);
  BOOST_CHECK(straight->path == PathKind::slip_stick || straight->path == PathKind::slip);
  BOOST_TEST((straight->impulse - spinning->impulse).norm() <= 1e-14);
}

BOOST_AUTO_TEST_CASE(a_face_that_rests_on_the_ground_keeps_still_where_friction_can_hold_what_the_tilt_asks_for) {
  Landing rocking = landings().front();
  rocking.products = {0, 1e-6, -2e-6};
  rocking.angular_velocity = {0.4, -0.3, 0};
  rocking.velocity = Vector3(0, 0, -1) - Vector3(0.3, 0.4, 0) * rocking.depth;
  const auto held = land(rocking);
  BOOST_REQUIRE(held.has_value());
  BOOST_CHECK(held->path == PathKind::stick);
  const Vector3 slip = held->velocity_after + held->angular_velocity_after.cross(Vector3(0, 0, -rocking.depth));
  BOOST_TEST(slip.head<2>().norm() <= 1e-16);
  BOOST_TEST(held->angular_velocity_after.z() == 0);
}

BOOST_AUTO_TEST_CASE(a_spinning_box_so_high_that_friction_would_tip_it_tilts_a_little_where_it_would_tip_a_little) {
  Landing high = landings().front();
  high.friction = 0.5;
  high.velocity = {3, 0, -1};
  high.angular_velocity = {0, 0, 1};
  const auto at_depth = [&](double depth) {
    high.depth = depth;
    return land(high).value();
  };
  BOOST_TEST(!at_depth(0.139).tilts);
  const GroupImpact high_box = at_depth(0.141);  // of the length 0.14 the pressure may use half
  BOOST_TEST(high_box.tilts);
  BOOST_TEST(!high_box.is_whole);
  for (const double depth : {0.139, 0.1395, 0.14, 0.1405, 0.141}) {
    BOOST_TEST_CONTEXT(depth) {
      constexpr double step = 1e-9;
      const GroupImpact lower = at_depth(depth - step), higher = at_depth(depth + step);
      BOOST_TEST((lower.velocity_after - higher.velocity_after).norm() <= 1e3 * step);
      BOOST_TEST((lower.angular_velocity_after - higher.angular_velocity_after).norm() <= 1e5 * step);
    }
  }
}

/// The pushes act at the leading edge, with friction against slip: all rates are constant until slip stops.
BOOST_AUTO_TEST_CASE(a_tall_box_that_slides_straight_is_pushed_at_its_leading_edge_until_slip_stops) {
  constexpr double tolerance = 1e-12, length = 0.1, height = 0.4, depth = height / 2, friction = 0.4;
  Landing tall{.name = "tall",
               .depth = depth,
               .area = rectangle(length, 0.1),
               .moments = of_box(length, 0.1, height),
               .products = Vector3::Zero(),
               .friction = friction,
               .restitution = 0.66,
               .velocity = {0.1, 0, -1},
               .angular_velocity = {},
               .velocity_after = {},
               .spin_after = 0};
  const double square = tall.moments.y() / mass, turning = (friction * depth - length / 2) / square;
  const double slowing = friction + depth * turning;
  for (const double speed : {1e-9, 0.1, 0.7, 5.0}) {
    const double push = std::fmin(speed / slowing, 1.66);  // per unit of mass
    for (const double angle : {0.0, 0.4}) {
      tall.velocity.x() = speed;
      const auto slid = land(tall, angle);
      BOOST_TEST_REQUIRE(slid.has_value());
      if (slid->order.size() > 1) continue;  // the leading edge is pushed down
      const Quaternion back(Eigen::AngleAxisd(-angle, Vector3::UnitZ()));
      const Vector3 v = back * slid->velocity_after, w = back * slid->angular_velocity_after;
      BOOST_TEST_CONTEXT(speed << " turned by " << angle) {
        BOOST_TEST((v - Vector3(speed - friction * push, 0, 0.66)).norm() <= tolerance * (1 + speed));
        BOOST_TEST((w - Vector3(0, turning * push, 0)).norm() <= tolerance * 20 * (1 + speed));
        BOOST_TEST(slid->tilts);
      }
    }
  }
}

/// Without friction the pressure point would lie outside; Newton's method finds none at once.
BOOST_AUTO_TEST_CASE(a_pressure_that_exists_is_found_where_friction_alone_brings_its_point_inside) {
  Body body = box(1.89607, {.size = {0.0479805, 0.0645238, 0.173962}});
  for (Vector3& vertex : body.vertices) vertex -= Vector3(-0.00501888, -0.00274527, -0.00766566);
  body.inertia << 0.00391973, 3.22889e-05, 0.000884811, 3.22889e-05, 0.00406159, -0.000107616, 0.000884811,
      -0.000107616, 0.00103071;
  State before;
  before.attitude = Quaternion(-0.5423779736709029, 0, 0, 0.8401345925961181).normalized();
  before.velocity = {-0.3285, 0, -0.7446};
  before.angular_velocity = {-5.819, 9.295, -41.47};
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    if (body.vertices[i].z() < 0) corners.push_back({static_cast<int>(i), body.vertices[i]});
  }
  const auto whole = rebound_as_a_whole(body, before, corners, coulomb(0.413, 0.762));
  BOOST_TEST_REQUIRE(whole.has_value());
  // By an independent integration, five digits.
  BOOST_TEST((whole->velocity_after - Vector3(0.02655, 0.21052, 0.30752)).norm() <= 1e-5);
  BOOST_TEST(std::fabs(whole->angular_velocity_after.z() + 20.969) <= 1e-3);
  const Vector3 changed = body.mass * (whole->velocity_after - before.velocity);
  BOOST_TEST((whole->impulse - changed).norm() <= 1e-13);
}

/// Sliding as fast as friction may it would tip; held, it needs next to none.
BOOST_AUTO_TEST_CASE(a_high_box_that_friction_has_stopped_sticks_however_little_it_turns_over) {
  Landing high{.name = "high",
               .depth = 0.0515,
               .area = rectangle(0.204, 0.078),
               .moments = of_box(0.204, 0.078, 0.103),
               .products = Vector3::Zero(),
               .friction = 0.9,
               .restitution = 0.5,
               .velocity = {-0.2, 0.3, -1.2},
               .angular_velocity = {},
               .velocity_after = {},
               .spin_after = 0};
  for (const double turn : {0.0, 1e-250, 1e-17, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2}) {
    BOOST_TEST_CONTEXT(turn) {
      high.angular_velocity = Vector3(turn, 0.1 * turn, 11);
      const auto held = land(high);
      BOOST_TEST_REQUIRE(held.has_value());
      BOOST_CHECK(held->path == PathKind::slip_stick);
      const Vector3 slip = held->velocity_after + held->angular_velocity_after.cross(Vector3(0, 0, -high.depth));
      BOOST_TEST(slip.head<2>().norm() <= 1e-15);
      BOOST_TEST(held->angular_velocity_after.z() == 0);
      BOOST_TEST((held->angular_velocity_after.head<2>() + 0.5 * high.angular_velocity.head<2>()).norm() <=
                 1e-15 * (1e-15 + turn));
    }
  }
}

/// Turning drives the face to slip; the direction that it had before, by rounding, is another.
BOOST_AUTO_TEST_CASE(a_driven_face_that_friction_tips_lands_as_one_without_slip_if_it_slips_by_rounding) {
  constexpr double little = 1e-11, tolerance = 1e-7;
  Random random(8);
  int tipped = 0;
  for (int i = 0; i < 40; ++i) {
    Landing driven = landings().front();
    driven.depth = 0.12;
    driven.moments = of_box(0.14, 0.07, 0.24);
    driven.friction = random.uniform(0.05, 0.4);
    driven.angular_velocity = Vector3(random.uniform(-5, 5), random.uniform(-5, 5), 0);
    const Vector3 at_rest = Vector3(0, 0, -1) - driven.angular_velocity.cross(Vector3(0, 0, -driven.depth));
    driven.velocity = at_rest;
    const auto still = land(driven);
    if (!still || !still->tilts || still->path == PathKind::stick) continue;
    ++tipped;
    for (const double angle : {0.3, 1.9, 3.5, 5.1}) {
      driven.velocity = at_rest + little * Vector3(std::cos(angle), std::sin(angle), 0);
      const auto slipped = land(driven);
      BOOST_TEST_REQUIRE(slipped.has_value());
      const double known = tolerance + 3 * (still->path_error + slipped->path_error);
      BOOST_TEST((slipped->velocity_after - still->velocity_after).norm() <= known);
      BOOST_TEST((slipped->angular_velocity_after - still->angular_velocity_after).norm() <= 30 * known);
    }
  }
  BOOST_TEST(tipped >= 5);
}

BOOST_AUTO_TEST_CASE(the_errors_of_a_landing_with_slide_and_spin_are_those_of_its_rounding) {
  const Drop drop{.body = box(mass, {.size = {0.14, 0.07, 0.008}}),
                  .velocity = {0.3, 0, -1},
                  .angular_velocity = {0, 0, 20},
                  .gravity = 9.81,
                  .law = coulomb(0.5, 0.3)};
  const Sequence sequence = impact_sequence(drop, {.impacts = 1});
  const ImpactRow& row = sequence.rows.at(0);
  BOOST_TEST(row.error.predictable);
  BOOST_TEST(std::fabs(row.impact.velocity_after.x() - landings().front().velocity_after.x()) <=
             row.error.velocity_after + 1e-12);
  // The path promises 1e-12 of the impulse, of which bars hold a few times as much.
  BOOST_TEST(row.error.velocity_after <= 5e-12);
  BOOST_TEST(row.error.angular_velocity_after <= 5e-10);
  BOOST_TEST(row.amplification < 10);
}
