// SPDX-License-Identifier: GPL-3.0-or-later
// Coulomb friction during contacts.
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

Simulation rod_at_45(double mu, double stiffness = 1e11, bool planar = false,
                     const HistoryRecorder& history = nullptr) {
  static const Body body = rod();
  const Ground ground = with_friction({.stiffness = stiffness}, mu);
  return dropped(body, weightless(ground, planar), 45 * degree, 1, {.digits = 8}, {.history = history});
}

double ratio(const ImpactNumbers& n) { return n.impulse.x() / n.impulse.z(); }

/// d_t d_n/(I + m d_n²): the ratio that sticking takes at the rim.
double sticking_ratio() {
  const double angle = 45 * degree, r = 0.01;
  const double across = 0.5 * std::cos(angle) - r * std::sin(angle);
  const double down = 0.5 * std::sin(angle) + r * std::cos(angle);
  return across * down / (rod().inertia()(1, 1) + down * down);
}

}  // namespace

BOOST_AUTO_TEST_CASE(slip_in_one_direction_has_the_impulse_ratio_mu) {
  for (const double mu : {0.1, 0.3, 0.5}) {
    const Simulation run = rod_at_45(mu);
    BOOST_TEST((run.impacts.at(0).mode == FrictionMode::slip));
    BOOST_TEST(std::fabs(ratio(run.impacts.at(0).value)) == mu, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(run.impacts.at(0).value.work_friction > 0);
  }
}

/// Above the sliding friction the static one only keeps slip that has ended from beginning again.
BOOST_AUTO_TEST_CASE(a_body_that_slides_feels_the_sliding_friction_alone) {
  const double sliding = 0.3;
  const Ground tilted{.stiffness = 1e11, .static_friction = 0.5, .sliding_friction = sliding};  // 0.586 would stick
  const Simulation rod_run = dropped(rod(), weightless(tilted), 45 * degree, 1);
  BOOST_TEST((rod_run.impacts.at(0).mode == FrictionMode::slip));
  BOOST_TEST(std::fabs(ratio(rod_run.impacts.at(0).value)) == sliding, boost::test_tools::tolerance(1e-9));
  // A plate that slides at 10 m/s, by a law over its whole patch: (v_r/v)²/2 below the coefficient.
  const Ground local{
      .stiffness = 1e8, .static_friction = 0.5, .sliding_friction = sliding, .friction = FrictionLaw::regularised};
  const Body plate = phone();
  const MotionState start = touching_state(plate, {.velocity = {10, 0, -1}});
  const Simulation plate_run = simulate(plate, weightless(local), start, plain);
  BOOST_TEST(ratio(plate_run.impacts.at(0).value) == -sliding, boost::test_tools::tolerance(1e-7));
}

/// Claim C11: a plateau from about 0.6 on; with the rod's real radius from 0.586 on, but for the patch's size.
BOOST_AUTO_TEST_CASE(beyond_the_sticking_ratio_more_friction_changes_nothing) {
  const Simulation first = rod_at_45(0.62), second = rod_at_45(0.8);
  BOOST_TEST((first.impacts.at(0).mode == FrictionMode::stick));
  // The very end, where the force fades and the rod's turning asks for more than it, slips for an instant.
  BOOST_TEST(ratio(first.impacts.at(0).value) == ratio(second.impacts.at(0).value), boost::test_tools::tolerance(1e-5));
  // The rigid body's ratio but for the patch's size, which falls by √10 on a ground a hundred times as stiff.
  const auto off = [](const Simulation& run) {
    return std::fabs(std::fabs(ratio(run.impacts.at(0).value)) - sticking_ratio());
  };
  BOOST_TEST(off(first) <= 0.01);
  BOOST_TEST(off(rod_at_45(0.8, 1e13)) <= 0.4 * off(second));
  BOOST_TEST(std::fabs(first.impacts.at(0).value.work_friction) <= 1e-9 * first.energy_start);
}

/// Claim C12.
BOOST_AUTO_TEST_CASE(the_pressure_centre_of_a_sticking_rod_stays_at_rest) {
  std::vector<HistorySample> rows;
  const Simulation run = rod_at_45(0.7, 1e11, false, [&](const HistorySample& sample) { rows.push_back(sample); });
  BOOST_REQUIRE(rows.size() > 10);
  for (const HistorySample& row : rows) {
    // But for the very end, where the force has faded.
    if (!(row.force.z() > 0.01 * run.impacts.at(0).value.peak_force)) continue;
    BOOST_TEST(std::fabs(row.point_velocity.x()) <= 1e-9);
    BOOST_TEST(std::hypot(row.force.x(), row.force.y()) <= 0.7 * row.force.z());
  }
}

/// At 45° the rod sticks from 0.586 on: with that much static friction, however little when it slides.
BOOST_AUTO_TEST_CASE(slip_that_ends_sticks_or_turns_as_the_static_friction_allows) {
  struct Case {
    double speed, static_friction, sliding_friction;
    FrictionMode mode;
  };
  const Body body = rod();
  for (const Case& c : {Case{0.3, 0.7, 0.7, FrictionMode::slip_stick},
                        {0.3, 0.7, 0.5, FrictionMode::slip_stick},
                        {0.3, 0.2, 0.2, FrictionMode::reverse_slip},
                        {-0.3, 0.2, 0.2, FrictionMode::slip}}) {
    const MotionState start = touching_state(body, {.inclination = 45 * degree, .velocity = {c.speed, 0, -1}});
    const Ground ground{
        .stiffness = 1e11, .static_friction = c.static_friction, .sliding_friction = c.sliding_friction};
    BOOST_TEST((simulate(body, weightless(ground), start, plain).impacts[0].mode == c.mode),
               c.speed << ' ' << c.static_friction << ' ' << c.sliding_friction);
  }
}

/// In space the plane of the drop may be any: here it is turned by 0.7 rad about the vertical.
BOOST_AUTO_TEST_CASE(friction_knows_no_direction_of_the_ground) {
  const Body body = phone();
  const Ground ground{.stiffness = 1e8, .damping = 1e6, .static_friction = 0.3, .sliding_friction = 0.2};
  MotionState start =
      touching_state(body, {.inclination = 0.4, .velocity = {1, 0.5, -2}, .spin = 3, .out_of_plane_tilt = 0.2});
  const ImpactNumbers straight = simulate(body, weightless(ground), start, plain).impacts[0].value;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vector3::UnitZ()));
  start.attitude = turn * start.attitude;
  start.velocity = turn * start.velocity;
  const ImpactNumbers turned = simulate(body, weightless(ground), start, plain).impacts[0].value;
  BOOST_TEST((turned.impulse - turn * straight.impulse).norm() <= 1e-8 * straight.impulse.norm());
  BOOST_TEST((turned.angular_velocity_after - turn * straight.angular_velocity_after).norm() <=
             1e-7 * straight.angular_velocity_after.norm());
}

/// The regularised law tends to Coulomb's as its speed falls.
BOOST_AUTO_TEST_CASE(the_regularised_law_tends_to_coulombs) {
  const Body body = rod();
  const auto impulse = [&](const Ground& ground) {
    return dropped(body, weightless(ground), 45 * degree, 1).impacts[0].value.impulse;
  };
  const Vector3 coulomb = impulse(with_friction({.stiffness = 1e11}, 0.3));
  double previous = 1;
  for (const double speed : {1e-2, 1e-3, 1e-4}) {
    const Vector3 soft = impulse(
        with_friction({.stiffness = 1e11, .friction = FrictionLaw::regularised, .regularisation_speed = speed}, 0.3));
    const double gap = (soft - coulomb).norm();
    BOOST_TEST(gap < 0.5 * previous);
    previous = gap;
  }
  BOOST_TEST(previous <= 1e-3 * coulomb.norm());
}

/// A plate that spins flat on the ground: the local law slows the spin, sticking at the centre would not.
BOOST_AUTO_TEST_CASE(the_regularised_law_slows_a_spinning_plate) {
  const Body body = phone();
  MotionState start = touching_state(body, {.velocity = {0, 0, -1}});
  start.angular_velocity = Vector3(0, 0, 10);
  const Ground ground = with_friction({.stiffness = 1e8, .friction = FrictionLaw::regularised}, 0.3);
  const Simulation run = simulate(body, weightless(ground), start, plain);
  const double spin = run.impacts.at(0).value.angular_velocity_after.z();
  BOOST_TEST(spin < 9.9);
  BOOST_TEST(spin > -10 * eps);  // it may come to rest, to rounding, and does not turn back
  BOOST_TEST(run.impacts.at(0).value.work_friction > 0);
}

/// Friction that brings slip and spin to rest together is stiff; a law that jumps there made steps a billionth as long.
BOOST_AUTO_TEST_CASE(a_patch_that_hardly_slips_and_spins_takes_few_steps_at_any_tolerance) {
  const Body body = box_body({0.25, 0.17, 0.008}, 0.48);
  const World world{.ground = with_friction({.stiffness = 5.6e10, .damping = 1.65e10}, 0.4)};
  const MotionState start =
      touching_state(body, {.inclination = 85 * degree, .velocity = {0, 0, -4.852}, .out_of_plane_tilt = 2 * degree});
  const auto run = [&](Method method, double tolerance) {
    return simulate(body, world, start, plain, {.method = method, .tolerance = tolerance, .evaluation_limit = 100'000});
  };
  const Simulation best = run(Method::rk8pd, 1e-13);
  for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
    const Simulation other = run(Method::rkck, tolerance);
    const Vector3 off = other.impacts.at(0).value.impulse - best.impacts.at(0).value.impulse;
    // Slow slip errs by the root of the tolerance.
    BOOST_TEST(off.norm() <= 0.01 * std::sqrt(tolerance) * best.impacts.at(0).value.impulse.norm());
  }
}

/// Holding the corner takes 0.736 of the normal force at the touch, and less than μ = 0.706 soon after: slip that began
/// has turned by then, and goes on.
BOOST_AUTO_TEST_CASE(slip_that_has_hardly_begun_is_free_to_turn_at_the_usual_tolerances) {
  const Body body = box_body({0.1372, 0.07699, 0.01878}, 0.299);
  const World world{.ground = with_friction({.stiffness = 6.7e10, .damping = 7.28e8}, 0.706)};
  const MotionState start = touching_state(
      body, {.inclination = 1.4388 * degree, .velocity = {0, 0, -1.3}, .out_of_plane_tilt = 0.1411 * degree});
  const auto spin = [&](const Accuracy& accuracy) {
    const Simulation run = simulate(body, world, start, plain, accuracy);
    BOOST_TEST((run.impacts.at(0).mode == FrictionMode::slip));
    return run.impacts.at(0).value.angular_velocity_after.z();
  };
  const double fine = spin({.method = Method::rk8pd, .tolerance = 1e-12});
  for (const double tolerance : {1e-7, 1e-8, 1e-10}) {
    // Slip that begins errs by a hundredth of the root of the tolerance; one that sticks has more than twice the spin.
    const double bound = 0.03 * std::sqrt(tolerance) * std::fabs(fine);
    BOOST_TEST(std::fabs(spin({.method = Method::rkck, .tolerance = tolerance}) - fine) <= bound);
  }
}

// Friction by the slip of each place: however a face is meshed, against brute force, and what a flat patch leaves out.

namespace {

constexpr int scenes_each = CLATTER_TEST_SLOW_BUILD ? 1 : 3;

struct RandomScene {
  Vector3 size;
  Ground ground;
  Drop drop;
};

RandomScene random_scene(Random& draw, bool planar) {
  RandomScene scene{{0.1, draw(0.03, 0.08), draw(0.01, 0.1)}, {}, {}};
  const double stiffness = draw.decades(7, 9);
  scene.ground = with_friction({.stiffness = stiffness, .damping = draw(0, 0.1) * stiffness}, draw(0.05, 0.8));
  scene.drop = {.inclination = draw(2, 80) * degree,
                .velocity = {draw(-0.5, 0.5), planar ? 0 : draw(-0.5, 0.5), -draw(0.5, 3)},
                .spin = draw(-10, 10),
                .out_of_plane_tilt = planar ? 0 : draw(-40, 40) * degree};
  return scene;
}

constexpr Request one_impact{.impacts = 1, .amplification = false};

/// A box in its plane on the projected bed: each face cut into short pieces, each with its own pressure and slip; the
/// classical Runge–Kutta method with short steps.
class PlanarBox {
 public:
  PlanarBox(const RandomScene& scene, double mass)
      : size_(scene.size), ground_(scene.ground), mass_(mass),
        inertia_(mass / 12 * (size_.x() * size_.x() + size_.z() * size_.z())) {
    state_ = {0, 0, scene.drop.inclination, scene.drop.velocity.x(), scene.drop.velocity.z(), scene.drop.spin};
    double low = 0;
    for (int i = 0; i < 4; ++i) low = std::min(low, corner(state_, i)[1]);
    state_[1] = -low;
  }

  /// Until nothing touches; the impulse along and across the ground.
  std::array<double, 2> run(double step) {
    const State start = state_;
    for (bool touched = false;;) {
      const State a = rate(state_), b = rate(moved(a, step / 2)), c = rate(moved(b, step / 2)),
                  d = rate(moved(c, step));
      for (std::size_t i = 0; i < 6; ++i) state_[i] += step / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
      double low = 1;
      for (int i = 0; i < 4; ++i) low = std::min(low, corner(state_, i)[1]);
      touched = touched || low < 0;
      if (touched && low >= 0) break;
    }
    return {mass_ * (state_[3] - start[3]), mass_ * (state_[4] - start[4])};
  }

 private:
  using State = std::array<double, 6>;  // x, z, inclination, their rates, the last one clockwise
  static constexpr int pieces = 600;

  [[nodiscard]] State moved(const State& rate, double step) const {
    State state = state_;
    for (std::size_t i = 0; i < 6; ++i) state[i] += step * rate[i];
    return state;
  }
  /// Counter-clockwise in the x–z plane.
  [[nodiscard]] std::array<double, 2> corner(const State& s, int i) const {
    const double x = (i == 0 || i == 3 ? -0.5 : 0.5) * size_.x(), z = (i < 2 ? -0.5 : 0.5) * size_.z();
    const double cosine = std::cos(s[2]), sine = std::sin(s[2]);
    return {s[0] + x * cosine - z * sine, s[1] + x * sine + z * cosine};
  }

  [[nodiscard]] State rate(const State& s) const {
    double along = 0, up = 0, turning = 0;
    for (int i = 0; i < 4; ++i) {
      const auto a = corner(s, i), b = corner(s, (i + 1) % 4);
      if (a[1] >= 0 && b[1] >= 0) continue;
      // Only what lies below: the pieces are short there.
      const double from = a[1] > 0 ? a[1] / (a[1] - b[1]) : 0, to = b[1] > 0 ? a[1] / (a[1] - b[1]) : 1;
      const double width = size_.y() * (b[0] - a[0]) * (to - from) / pieces;
      for (int j = 0; j < pieces; ++j) {
        const double part = from + (to - from) * (j + 0.5) / pieces;
        const double x = a[0] + part * (b[0] - a[0]) - s[0], z = a[1] + part * (b[1] - a[1]) - s[1];
        const double depth = -(s[1] + z), sinking = -(s[4] - s[5] * x), slip = s[3] + s[5] * z;
        const double pressure = (ground_.stiffness + ground_.damping * sinking) * depth;
        if (pressure <= 0) continue;
        const double normal = width * pressure;
        const double friction = -ground_.sliding_friction * std::fabs(normal) * (slip > 0 ? 1 : slip < 0 ? -1 : 0);
        along += friction;
        up += normal;
        turning += z * friction - x * normal;
      }
    }
    return {s[3], s[4], -s[5], along / mass_, up / mass_, turning / inertia_};
  }

  Vector3 size_;
  Ground ground_;
  double mass_, inertia_;
  State state_{};
};

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_do_not_depend_on_how_a_face_is_meshed_whatever_the_friction) {
  int compared = 0, within = 0;
  for (const FrictionLaw law : {FrictionLaw::coulomb, FrictionLaw::regularised, FrictionLaw::local}) {
    for (const bool planar : {true, false}) {
      Random random(17u + static_cast<unsigned>(law) * 2u + planar);
      for (int i = 0; i < scenes_each; ++i) {
        RandomScene scene = random_scene(random, planar);
        scene.ground.friction = law;
        const Body whole = box_body(scene.size, 0.1), meshed = box_body(scene.size, 0.1, 8, 4, 4, false);
        const World world{.ground = scene.ground, .planar = planar};
        const Simulation one = simulate(whole, world, touching_state(whole, scene.drop), one_impact);
        const Simulation other = simulate(meshed, world, touching_state(meshed, scene.drop), one_impact);
        BOOST_TEST_REQUIRE(one.impacts.size() == other.impacts.size());
        if (one.impacts.empty()) continue;
        const ImpactNumbers &a = one.impacts[0].value, &b = other.impacts[0].value;
        const Vector3 bar = one.impacts[0].error.impulse + other.impacts[0].error.impulse;
        for (int axis = 0; axis < 3; ++axis) {
          ++compared;
          const bool inside = std::fabs(a.impulse[axis] - b.impulse[axis]) <= bar[axis] + 1e-14;
          within += inside;
          BOOST_TEST(std::fabs(a.impulse[axis] - b.impulse[axis]) <= 1e-6 * a.impulse.norm(),
                     "law " << static_cast<int>(law) << (planar ? ", planar" : ", in space") << ", scene " << i << ": "
                            << a.impulse[axis] << " and " << b.impulse[axis]);
        }
      }
    }
  }
  BOOST_TEST(within >= 0.99 * compared, within << " of " << compared << " within their bars");
}

/// Every number of two impacts, to nine digits, in units of both error bars.
void check_mesh_independence(const Body& whole, const Body& meshed, const World& world, const MotionState& start) {
  using N = ImpactNumbers;
  const auto run = [&](const Body& body) {
    return simulate(body, world, start, {.impacts = 2}, {.digits = 9}).impacts;
  };
  const std::vector<ImpactRecord> one = run(whole), other = run(meshed);
  BOOST_TEST_REQUIRE((one.size() == 2U && other.size() == 2U));
  for (std::size_t i = 0; i < 2; ++i) {
    const ImpactRecord &a = one[i], &b = other[i];
    BOOST_TEST((a.predictable && a.end == b.end && a.touches == b.touches && a.mode == b.mode));
    for (const auto number :
         {&N::start, &N::duration, &N::inclination, &N::contact_angle, &N::approach_speed, &N::restitution,
          &N::peak_force, &N::peak_time, &N::indentation, &N::energy_before, &N::energy_after, &N::energy_loss,
          &N::work_damping, &N::work_friction, &N::work_released}) {
      if (std::isnan(a.value.*number) && std::isnan(b.value.*number)) continue;
      BOOST_TEST(std::fabs(a.value.*number - b.value.*number) <= a.error.*number + b.error.*number);
    }
    for (const auto vector : {&N::impulse, &N::velocity_after, &N::angular_velocity_after}) {
      const Vector3 off = (a.value.*vector - b.value.*vector).cwiseAbs(), bar = a.error.*vector + b.error.*vector;
      BOOST_TEST((off.array() <= bar.array()).all(), off.transpose() << " of " << bar.transpose());
    }
  }
}

/// About a point inside the patch, with friction that turns with the place.
BOOST_AUTO_TEST_CASE(a_box_that_spins_on_its_corner_at_54_6_degrees_does_not_depend_on_its_mesh) {
  const Vector3 size(0.1, 0.05, 0.04);
  const Body whole = box_body(size, 0.1), meshed = box_body(size, 0.1, 16, 12, 8, false);
  const World world{.ground = with_friction({.stiffness = 1e8, .damping = 1e6}, 0.6)};
  for (const double tilt : {0.0, 25.0}) {
    MotionState start = touching_state(whole, {.inclination = 54.6 * degree, .out_of_plane_tilt = tilt * degree});
    start.angular_velocity = start.attitude.conjugate() * Vector3(0, 3, 40);
    check_mesh_independence(whole, meshed, world, start);
  }
}

BOOST_AUTO_TEST_CASE(the_damped_phone_at_2_degrees_with_regularised_friction_does_not_depend_on_its_mesh) {
  const Body whole = phone(), meshed = phone(24, 10, 4, false);
  const World world{
      .ground = with_friction({.stiffness = 1e8, .damping = 1e7, .friction = FrictionLaw::regularised}, 0.075),
      .planar = true};
  MotionState start = touching_state(whole, {.inclination = 2 * degree});
  start.velocity = {0, 0, -std::sqrt(2 * world.gravity * (1 - start.centre.z()))};  // from 1 m
  check_mesh_independence(whole, meshed, world, start);
}

/// The brute force sums some thousand pieces, whose friction jumps: 1e-3 of it at most; the flat patch is further off.
BOOST_AUTO_TEST_CASE(local_friction_is_that_of_each_place_by_its_own_slip) {
  constexpr double allowed = 4e-4;
  bool flat_differs = false;
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    RandomScene scene = random_scene(random, true);
    scene.ground.area = AreaMeasure::projected;
    scene.ground.stiffness = 3e7;
    scene.ground.friction = FrictionLaw::local;
    const Body body = box_body(scene.size, 0.1);
    const auto impulse = [&] {
      return simulate(body, weightless(scene.ground, true), touching_state(body, scene.drop), one_impact)
          .impacts.at(0)
          .value;
    };
    const ImpactNumbers local = impulse();
    const std::array<double, 2> brute = PlanarBox(scene, 0.1).run(local.duration / 1000);
    BOOST_TEST(std::fabs(local.impulse.x() - brute[0]) <= allowed * local.impulse.z());
    BOOST_TEST(std::fabs(local.impulse.z() - brute[1]) <= allowed * local.impulse.z());
    BOOST_TEST(local.work_friction >= 0);
    const double loss = local.energy_loss - local.work_damping - local.work_friction - local.work_released;
    BOOST_TEST(std::fabs(loss) <= 1e-6 * local.energy_before);
    scene.ground.friction = FrictionLaw::coulomb;
    flat_differs = flat_differs || std::fabs(impulse().impulse.x() - brute[0]) > 2 * allowed * local.impulse.z();
  }
  BOOST_TEST(flat_differs);
}

/// In the plane and in space; where slip turns back, its two halves may cancel in the estimate.
BOOST_AUTO_TEST_CASE(what_a_flat_patch_leaves_out_is_estimated_to_a_factor_of_three) {
  int scenes = 0, right = 0;
  for (const bool planar : {true, false}) {
    Random random(11);
    for (int i = 0; i < 3 * scenes_each; ++i) {
      RandomScene scene = random_scene(random, planar);
      const Body body = box_body(scene.size, 0.1);
      const MotionState start = touching_state(body, scene.drop);
      World world{.ground = scene.ground, .planar = planar};
      const Simulation flat = simulate(body, world, start, one_impact);
      world.ground.friction = FrictionLaw::local;
      const Simulation local = simulate(body, world, start, one_impact);
      if (flat.impacts.empty() || local.impacts.empty() || flat.impacts[0].touches > 1) continue;
      const Vector3 change = local.impacts[0].value.impulse - flat.impacts[0].value.impulse;
      const double actual = std::hypot(change.x(), change.y()), estimate = flat.impacts[0].local_slip;
      const double none = 1e-6 * flat.impacts[0].value.impulse.norm();
      ++scenes;
      right += (actual <= none && estimate <= 3 * none) || (estimate <= 3 * actual && actual <= 3 * estimate);
    }
  }
  BOOST_TEST(right >= 0.9 * scenes, right << " of " << scenes);
}

/// A bound leaves out what changes the impulse by less than the digits asked; ten times that, since rests add up.
BOOST_AUTO_TEST_CASE(the_estimate_asked_for_and_that_which_comes_by_itself_differ_by_less_than_the_digits) {
  constexpr int digits = 4;
  constexpr double part = 0.05;  // to which both solve for the slip
  for (const bool planar : {true, false}) {
    Random random(13);
    for (int i = 0; i < scenes_each; ++i) {
      const RandomScene scene = random_scene(random, planar);
      const Body body = box_body(scene.size, 0.1);
      const auto impact = [&](const Request& request) {
        return simulate(body, {.ground = scene.ground, .planar = planar}, touching_state(body, scene.drop), request,
                        {.digits = digits})
            .impacts.at(0);
      };
      const ImpactRecord asked = impact({.impacts = 1, .error_estimates = false, .local_slip = true});
      const ImpactRecord by_itself = impact({.impacts = 1, .amplification = false});
      BOOST_TEST(std::fabs(by_itself.local_slip - asked.local_slip) <=
                 10 * std::pow(10, -digits) * asked.value.impulse.norm() + part * asked.local_slip);
      BOOST_TEST(impact(plain).local_slip == 0);
    }
  }
}
