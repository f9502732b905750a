// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include "numeric/contact/gauss_rules.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

using std::numbers::pi;

constexpr double relative = 1e-12;

/// A body of this shape, whose mass properties play no part.
Body body_of(const SmoothShape& shape) { return round_body(shape, 1, Matrix3::Identity()); }

GroundView pressed(const SmoothShape& shape, const Vector3& normal, double depth) {
  return test::pressed(body_of(shape), normal, depth);
}

ContactLoad load_of(const SmoothShape& shape, const Ground& ground, const GroundView& view) {
  return contact_surface(body_of(shape), ground)->load(view);
}

void check_close(double value, double expected, double bound) { BOOST_TEST(std::fabs(value - expected) <= bound); }

BOOST_AUTO_TEST_CASE(a_ball_presses_with_the_volume_of_its_cap_or_the_depth_over_its_surface) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const double radius = random.decades(-3, 1), depth = radius * random.decades(-9, 0.29);
    const SmoothShape ball{Vector3::Constant(radius), 0, random.vector(radius / 2)};
    const GroundView view = pressed(ball, random.direction(), depth);
    // The depth itself is known to the rounding of the body's size.
    const double known = relative + 20e-16 * radius / depth;
    const double volume = pi * depth * depth * (radius - depth / 3), over_surface = pi * radius * depth * depth;
    const ContactLoad projected = load_of(ball, {.stiffness = 1, .area = AreaMeasure::projected}, view);
    const ContactLoad surface = load_of(ball, {.stiffness = 1, .area = AreaMeasure::surface}, view);
    check_close(projected.force, volume, known * volume);
    check_close(surface.force, over_surface, known * over_surface);
    check_close(surface.energy, over_surface * depth / 3, 2 * known * over_surface * depth);
    const double energy = pi * depth * depth * depth * (radius / 3 - depth / 12);
    check_close(projected.energy, energy, 2 * known * energy);
    check_close(surface.deepest, depth, known * depth);
    // All of it acts through the centre.
    const Vector3 moment = (surface.first_moment - surface.force * ball.centre).cross(view.normal());
    BOOST_TEST(moment.norm() <= 1e-14 * surface.force * radius);
  }
}

BOOST_AUTO_TEST_CASE(an_ellipsoid_presses_with_the_volume_that_is_cut_off) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const SmoothShape shape{{random(0.2, 1), random(0.2, 1), random(0.2, 1)}, 0, random.vector(0.2)};
    const Vector3 normal = random.direction();
    const double stretch = shape.semiaxes.cwiseProduct(normal).norm();
    const double depth = stretch * random.decades(-6, 0.29), part = depth / stretch;
    const double volume = pi * shape.semiaxes.prod() * part * part * (1 - part / 3);
    const ContactLoad load =
        load_of(shape, {.stiffness = 2, .area = AreaMeasure::projected}, pressed(shape, normal, depth));
    check_close(load.force, 2 * volume, (relative + 20e-16 / part) * 2 * volume);
  }
}

/// Prolate, its axis upright: z = c cos φ and the ring's radius a sin φ give 2π a k ∫(z − c + d)√(a² cos² + c² sin²)
/// sin φ.
BOOST_AUTO_TEST_CASE(a_spheroid_presses_with_the_depth_over_its_surface) {
  for (const double ratio : {0.1, 0.3, 0.7, 1.5, 4.0, 10.0}) {
    for (const double part : {1e-6, 1e-3, 0.1, 0.7, 1.3, 1.9}) {
      const double c = 1, a = ratio, depth = part * c;
      const SmoothShape shape{{c, a, a}, 0, Vector3::Zero()};
      // ∫√(a² t² + c² (1 − t²)) (t − t₀) dt from t₀ = 1 − part to 1 by Simpson's rule in many parts.
      constexpr int parts = 20000;
      double sum = 0;
      for (int i = 0; i <= 2 * parts; ++i) {
        const double up = part * i / (2 * parts), t = 1 - part + up;
        const double weight = i == 0 || i == 2 * parts ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * up * std::sqrt(a * a * t * t + c * c * (1 - t * t));
      }
      const double expected = 2 * pi * a * c * sum * part / (6 * parts);
      const ContactLoad load =
          load_of(shape, {.stiffness = 1, .area = AreaMeasure::surface}, pressed(shape, -Vector3::UnitX(), depth));
      check_close(load.force, expected, (1e-11 + 20e-16 / part) * expected);
    }
  }
}

/// Level: the strip of a cylinder, and the halves of a ball's cap.  Upright: the ball's.
BOOST_AUTO_TEST_CASE(a_capsule_presses_with_its_cap_its_strip_or_both) {
  constexpr double radius = 0.3, straight = 2;
  const SmoothShape shape{Vector3::Constant(radius), straight, Vector3::Zero()};
  for (const double part : {1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5}) {
    const double depth = part * radius, cap = pi * depth * depth * (radius - depth / 3);
    const double angle = 2 * std::asin(std::sqrt(part / 2));
    const double segment = radius * radius * (angle - std::sin(2 * angle) / 2);
    const double by_depth = 2 * radius * radius * (std::sin(angle) - angle * std::cos(angle));
    const double known = 1e-11 + 20e-16 / part;
    const double cut = part < 1e-2 ? 1e-5 : 1e-11;  // what the closed forms lose
    const GroundView level = pressed(shape, Vector3(0, 0.6, 0.8), depth),
                     upright = pressed(shape, Vector3::UnitX(), depth);
    const double volume = cap + segment * straight, surface = pi * radius * depth * depth + by_depth * straight;
    check_close(load_of(shape, {.stiffness = 1, .area = AreaMeasure::projected}, level).force, volume,
                (known + cut) * volume);
    check_close(load_of(shape, {.stiffness = 1, .area = AreaMeasure::surface}, level).force, surface,
                (known + cut) * surface);
    if (part <= 1)
      check_close(load_of(shape, {.stiffness = 1, .area = AreaMeasure::projected}, upright).force, cap, known * cap);
  }
}

/// Against the facets of a fine mesh, which come to the shape with the second order.
BOOST_AUTO_TEST_CASE(load_rates_and_friction_are_those_of_ever_finer_facets) {
  Random random(3);
  for (int i = 0; i < 24; ++i) {
    const bool is_capsule = i % 3 == 2;
    const SmoothShape shape{is_capsule ? Vector3(Vector3::Constant(0.5)) : Vector3(random(0.4, 1), random(0.4, 1), 0.7),
                            is_capsule ? 1.5 : 0, Vector3::Zero()};
    const Vector3 normal = i % 6 == 5 ? Vector3(random(-0.05, 0.05), 0.6, 0.8).normalized() : random.direction();
    GroundView view = pressed(shape, normal, random(0.05, 0.3));
    view.vertical_speed = random(-1, 1);
    view.angular_velocity = random.vector(2);
    view.east_speed = random(-1, 1);
    view.north_speed = random(-1, 1);
    // Some of the patches let go in a part.
    const Ground ground = with_friction({.stiffness = 1,
                                         .damping = i % 2 == 0 ? 0.2 : 1.5,
                                         .area = i % 4 < 2 ? AreaMeasure::projected : AreaMeasure::surface},
                                        1);
    const SlipField fields[] = {
        {.kind = SlipField::Kind::points},
        {.kind = SlipField::Kind::points, .regularisation = 0.1},
        {.kind = SlipField::Kind::turning, .centre = shape.lowest(0, normal), .east = 0.05, .north = 0.02, .spin = 1.3},
        {.kind = SlipField::Kind::points, .planar = true}};
    constexpr int numbers = 27;
    using Numbers = Eigen::Matrix<double, numbers, 1>;
    const auto numbers_of = [&](ContactSurface& surface) {
      LoadRates rates;
      const ContactLoad load = surface.load(view, &rates);
      Numbers all;
      all << load.force, load.first_moment, load.energy, load.damping_power, load.release_power, rates.rates.rate,
          rates.rates.rate_squared, rates.rates.rate_position, rates.rates.depth_position_squared.diagonal(),
          rates.force_by_area, Eigen::Matrix<double, 11, 1>::Zero();
      int place = 16;
      for (const SlipField& field : fields) {
        const SlipLoad slip = surface.slip_load(view, field);
        all[place++] = slip.east;
        all[place++] = field.planar ? 0 : slip.north;
        if (place < numbers) all[place++] = slip.moment.dot(Vector3(1, 2, 3));
      }
      return all;
    };
    const Body body = body_of(shape);
    const Numbers smooth = numbers_of(*contact_surface(body, ground));
    const auto faceted = [&](int fine) {
      const Body mesh(
          {.mass = 1, .centre = Vector3::Zero(), .inertia = Matrix3::Identity()},
          boundary_surface(round_mesh(
              {.semiaxes = shape.semiaxes, .straight = shape.straight, .sectors = 4 * fine, .rings = fine})));
      return numbers_of(*contact_surface(mesh, ground));
    };
    const Numbers coarse = faceted(24), fine = faceted(48), limit = fine + (fine - coarse) / 3;
    for (int n = 0; n < numbers; ++n) {
      const double size = std::max(std::fabs(smooth[n]), 0.02 * smooth[0]);
      BOOST_TEST(std::fabs(smooth[n] - limit[n]) <= 0.15 * std::fabs(fine[n] - coarse[n]) + 2e-4 * size,
                 "shape " << i << ", number " << n << ": " << smooth[n] << " for " << limit[n] << ", meshes "
                          << coarse[n] << ", " << fine[n]);
    }
  }
}

/// ∫f v/√(v² + v_r²) over a cap, f the pressure times the measure: heights by Gauss's rule, places around by
/// trapezoids.
SlipLoad summed(const SmoothShape& shape, const Ground& ground, const GroundView& view, const SlipField& field) {
  constexpr int heights = 60, around = 800, nodes = 10;
  const Vector3 normal = view.normal(), a = shape.semiaxes, stretched = a.cwiseProduct(normal);
  const Vector3 up = stretched.normalized(), one = up.unitOrthogonal(), other = up.cross(one);
  const double height = -view.sink / stretched.norm();
  SlipLoad load;
  for (int k = 0; k < heights * nodes; ++k) {
    const GaussNode node = gauss_rule(nodes)[k % nodes];
    const double t = (k / nodes + (1 + node.at) / 2) / heights, z = height * t * t, rho = std::sqrt(z * (2 - z));
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      const Vector3 on_ball = rho * std::cos(angle) * one + rho * std::sin(angle) * other + (z - 1) * up;
      const Vector3 u = a.cwiseProduct(on_ball), area = a.prod() * a.cwiseInverse().cwiseProduct(on_ball);
      const double weight = ground.area == AreaMeasure::projected ? -area.dot(normal) : area.norm();
      const double rate = -(view.vertical_speed + normal.cross(view.angular_velocity).dot(u));
      const double force = stretched.norm() * (height - z) * (ground.stiffness + ground.damping * rate) * weight * 2 *
                           t * height * node.weight / 2 / heights * 2 * pi / around;
      const Vector3 turning = view.angular_velocity.cross(u);
      const double east = view.east_speed + turning.dot(view.east), north = view.north_speed + turning.dot(view.north);
      const double size = std::hypot(std::hypot(east, north), field.regularisation);
      load.east -= force * east / size;
      load.north -= force * north / size;
    }
  }
  return load;
}

void check_rubbing(const SmoothShape& shape, const Ground& ground, const GroundView& view, const SlipField& field,
                   double tolerance) {
  const auto surface = contact_surface(body_of(shape), ground);
  const double force = surface->load(view).force;
  const SlipLoad load = surface->slip_load(view, field), sum = summed(shape, ground, view, field);
  check_close(load.east, sum.east, tolerance * force);
  check_close(load.north, sum.north, tolerance * force);
}

BOOST_AUTO_TEST_CASE(a_cap_that_spins_rubs_as_the_sum_over_its_surface_wherever_nothing_slips) {
  constexpr double tolerance = 1e-10, spin = 10;
  Random random(4);
  for (const Vector3& semiaxes : {Vector3(1, 1, 1), Vector3(0.5, 0.8, 1)}) {
    const SmoothShape shape{semiaxes, 0, Vector3::Zero()};
    for (const double part : {0.0, 0.4, 0.75, 0.97, 1.0, 1.03, 2.0}) {
      const Vector3 normal = random.direction();
      const double depth = random.decades(-4, -1), width = std::sqrt(2 * depth);
      GroundView view = pressed(shape, normal, depth);
      view.vertical_speed = -0.3;
      view.angular_velocity = spin * normal + random.vector(1);
      const Vector3 lowest = view.angular_velocity.cross(shape.lowest(0, normal));
      view.east_speed = 0.6 * spin * part * width - lowest.dot(view.east);
      view.north_speed = 0.8 * spin * part * width - lowest.dot(view.north);
      const AreaMeasure area = part < 1 ? AreaMeasure::projected : AreaMeasure::surface;
      const Ground ground = with_friction({.stiffness = 1, .damping = 0.1, .area = area}, 1);
      const SlipField field{.kind = SlipField::Kind::points, .digits = 11, .regularisation = 0.03 * spin * width};
      BOOST_TEST_CONTEXT("semiaxes " << semiaxes.transpose() << ", nothing slips at " << part << " of the width")
      check_rubbing(shape, ground, view, field, tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_cap_that_rolls_and_hardly_spins_rubs_as_the_sum_over_its_surface) {
  // Slip is smooth over a twentieth of what it varies by, and azimuths are as fine as friction of seven digits asks
  // for.
  constexpr double tolerance = 3e-7, rolling = 10;
  Random random(7);
  for (int i = 0; i < 24; ++i) {
    const SmoothShape shape{i % 2 == 0 ? Vector3(1, 1, 1) : Vector3(0.7, 0.8, 1), 0, Vector3::Zero()};
    const Vector3 normal = random.direction(), along = normal.unitOrthogonal(), across = normal.cross(along);
    const double depth = random.decades(-3, -1), width = std::sqrt(2 * depth);
    GroundView view = pressed(shape, normal, depth);
    view.vertical_speed = -0.3;
    view.angular_velocity = rolling * along + rolling * width * random.decades(-4, 0) * normal;
    const Vector3 lowest = view.angular_velocity.cross(shape.lowest(0, normal));
    const Vector3 slip = rolling * depth * (random(-1, 1) * across + 0.3 * random(-1, 1) * along);
    view.east_speed = (slip - lowest).dot(view.east);
    view.north_speed = (slip - lowest).dot(view.north);
    const AreaMeasure area = i % 4 < 2 ? AreaMeasure::projected : AreaMeasure::surface;
    const Ground ground = with_friction({.stiffness = 1, .area = area}, 1);
    const SlipField field{.kind = SlipField::Kind::points, .digits = 11, .regularisation = 0.05 * rolling * depth};
    BOOST_TEST_CONTEXT("case " << i) check_rubbing(shape, ground, view, field, tolerance);
  }
}

}  // namespace
