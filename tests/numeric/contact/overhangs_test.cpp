// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/overhangs.hpp"

#include "numeric/contact/contact_load.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double relative = 1e-12;   ///< integrals are right to 1e-13 of the normal force
constexpr double of_columns = 3e-3;  ///< 500 × 500 columns, of which those at edges count in full or not at all

Mesh tetrahedron(Random& random) {
  std::vector<Vector3> nodes;
  double volume = 0;
  while (!(std::fabs(volume) > 0.1)) {
    nodes = {random.vector(), random.vector(), random.vector(), random.vector()};
    volume = (nodes[1] - nodes[0]).cross(nodes[2] - nodes[0]).dot(nodes[3] - nodes[0]);
  }
  if (volume < 0) std::swap(nodes[1], nodes[2]);
  return single(ElementShape::tetrahedron, nodes, Element{}.density);
}

GroundView view_of(const Body& body, const Eigen::Quaterniond& attitude, double depth, const Vector3& velocity,
                   const Vector3& rotation) {
  MotionState state;
  state.attitude = attitude;
  GroundView view = pressed(on_ground(body, state), depth);
  view.vertical_speed = velocity.z();
  view.angular_velocity = attitude.conjugate() * rotation;
  view.east_speed = velocity.x();
  view.north_speed = velocity.y();
  return view;
}

struct Corner {
  Body body;
  GroundView view;
  Ground ground;
};

/// With friction 1.
Corner random_corner(Random& random) {
  Body body(tetrahedron(random));
  const Eigen::Quaterniond attitude(Eigen::AngleAxisd(random(0, 3), random.direction()));
  const GroundView view = view_of(body, attitude, random(0.01, 0.5), random.vector(), random.vector(3));
  return {std::move(body), view,
          with_friction({.stiffness = 1, .damping = random(0, 0.5), .area = AreaMeasure::projected}, 1)};
}

Vector3 force_of(const GroundView& view, const SlipLoad& load) {
  return load.east * view.east + load.north * view.north;
}

/// Power that friction takes, over μ.
double dissipated(const GroundView& view, const SlipLoad& load) {
  return -load.east * view.east_speed - load.north * view.north_speed - load.moment.dot(view.angular_velocity);
}

/// Friction over columns of the ground, each found by where its line meets the faces of the tetrahedron.
Vector3 friction_of_columns(const Corner& corner) {
  const GroundView& view = corner.view;
  const Facets& facets = corner.body.facets();
  const double size = corner.body.radius();
  constexpr int columns = 500;
  const double side = 2 * size / columns;
  Vector3 sum = Vector3::Zero();
  const Vector3 up = view.normal();
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      const Vector3 foot = ((i + 0.5) * side - size) * view.east + ((j + 0.5) * side - size) * view.north;
      double low = -1e9, high = 1e9;  // heights along `up` from the foot, within all faces
      for (const Facet& facet : facets.facets) {
        const Vector3& u = facets.vertices[facets.corners[facets.loops[facet.begin].begin]];
        const double slope = facet.normal.dot(up), at = facet.normal.dot(u - foot) / slope;
        (slope < 0 ? low : high) = slope < 0 ? std::max(low, at) : std::min(high, at);
      }
      if (!(low < high)) continue;
      const Vector3 bottom = foot + low * up, top = foot + high * up;
      const double depth = -view.height(bottom), above = std::max(-view.height(top), 0.0);
      if (!(depth > 0)) continue;
      const Vector3 turning = view.angular_velocity.cross(bottom);
      const double rate = -(view.vertical_speed + turning.dot(up));
      const double pressure = std::max(corner.ground.stiffness + corner.ground.damping * rate, 0.0) * (depth - above);
      const Vector3 slip = turning + view.east_speed * view.east + view.north_speed * view.north;
      const Vector3 along = slip - slip.dot(up) * up;
      sum -= pressure * side * side * along.normalized();
    }
  }
  return sum;
}

/// Boxes of 1 × 1 × 0.1, each at its place in a grid.
Mesh blocks(const std::vector<std::array<int, 3>>& cells) {
  const Mesh grid =
      moved(box_mesh({.size = {3, 3, 0.3}, .nx = 3, .ny = 3, .nz = 3}), Matrix3::Identity(), {1.5, 1.5, 0.15});
  return without(grid, [&](const Vector3& centre) {
    const std::array<int, 3> cell{static_cast<int>(centre.x()), static_cast<int>(centre.y()),
                                  static_cast<int>(10 * centre.z())};
    return std::find(cells.begin(), cells.end(), cell) == cells.end();
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_of_faces_that_look_up_is_bounded_by_the_normal_force_and_takes_energy) {
  Random random(7);
  int looking_up = 0;
  for (int i = 0; i < 90; ++i) {
    const Corner corner = random_corner(random);
    ContactLoader loader(corner.body, corner.ground);
    const ContactLoad load = loader.load(corner.view);
    if (!(load.force > 0)) continue;
    for (const Facet& facet : corner.body.facets().facets) looking_up += facet.normal.dot(corner.view.normal()) > 0;
    for (const double regularisation : {0.0, 0.1}) {
      for (const bool planar : {false, true}) {
        const SlipField field{.planar = planar, .regularisation = regularisation};
        const SlipLoad friction = loader.slip_load(corner.view, field);
        BOOST_TEST(std::hypot(friction.east, planar ? 0 : friction.north) <= load.force * (1 + relative));
        if (!planar) BOOST_TEST(dissipated(corner.view, friction) >= -relative * load.force);
      }
    }
    const SlipField flat{.kind = SlipField::Kind::turning, .centre = load.pressure_centre(), .east = 0.1, .spin = 1};
    BOOST_TEST(force_of(corner.view, loader.slip_load(corner.view, flat)).norm() <= load.force * (1 + relative));
  }
  BOOST_TEST(looking_up > 60);
}

BOOST_AUTO_TEST_CASE(friction_is_that_of_columns_each_pressed_by_the_difference_of_its_ends) {
  Random random(11);
  for (int seen = 0; seen < 5;) {
    const Corner corner = random_corner(random);
    ContactLoader loader(corner.body, corner.ground);
    const ContactLoad load = loader.load(corner.view);
    if (!(load.force > 0.02)) continue;  // a patch of many columns
    ++seen;
    const Vector3 found = force_of(corner.view, loader.slip_load(corner.view, {}));
    BOOST_TEST((found - friction_of_columns(corner)).norm() <= of_columns * load.force);
  }
}

/// The surface measure has no columns, and walls below the ground by so little have no load of their own.
BOOST_AUTO_TEST_CASE(walls_that_are_all_but_upright_change_no_friction) {
  constexpr double depth = 3.5e-8, of_walls = 1e-7;
  const Body box = box_body({2, 2, 0.5}, 1);
  for (const Vector3& axis : {Vector3(0, 1, 0), Vector3(0.6, 0.8, 0)}) {
    for (const double tilt : {2e-10, 1e-9, 1e-8, 1e-7, 1e-6}) {
      const GroundView view =
          view_of(box, Eigen::Quaterniond(Eigen::AngleAxisd(tilt, axis)), depth, {0, -1e-7, -1}, {0, 0, 20});
      const auto friction_by = [&](AreaMeasure area) -> Vector3 {
        const Ground ground = with_friction({.stiffness = 1, .area = area}, 1);
        ContactLoader loader(box, ground);
        const double force = loader.load(view).force;
        return force_of(view, loader.slip_load(view, {})) / force;
      };
      BOOST_TEST((friction_by(AreaMeasure::projected) - friction_by(AreaMeasure::surface)).norm() <= of_walls);
    }
  }
}

/// Two shelves above each other on one wall are the wall and the shelves, each by itself.
BOOST_AUTO_TEST_CASE(a_face_that_looks_up_leans_on_the_next_face_below_it) {
  const std::vector<std::array<int, 3>> wall{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, low{{1, 0, 0}, {2, 0, 0}},
      high{{1, 0, 2}, {2, 0, 2}};
  std::vector<std::array<int, 3>> all = wall;
  all.insert(all.end(), low.begin(), low.end());
  all.insert(all.end(), high.begin(), high.end());
  const Ground ground = with_friction({.stiffness = 1, .damping = 0.01, .area = AreaMeasure::projected}, 1);
  const Vector3 velocity(0.3, -0.2, -0.1), rotation(2, 3, 0.5), centre(1.5, 0.5, 0.15);
  const auto friction_of = [&](const std::vector<std::array<int, 3>>& cells) {
    Mesh mesh = blocks(cells);
    const MassProperties properties = mass_properties(mesh);
    const Body body(mesh);
    ContactLoader loader(body, ground);
    GroundView view;
    view.reference = {Vector3::UnitZ(), properties.centre.z() - 0.4};
    const Vector3 at = velocity + rotation.cross(properties.centre - centre);
    view.vertical_speed = at.z();
    view.east_speed = at.x();
    view.north_speed = at.y();
    view.angular_velocity = rotation;
    static_cast<void>(loader.load(view));
    const SlipLoad load = loader.slip_load(view, {});
    return Vector3(load.east, load.north,
                   load.moment.z() + (properties.centre.x() * load.north - properties.centre.y() * load.east));
  };
  const Vector3 whole = friction_of(all), parts = friction_of(wall) + friction_of(low) + friction_of(high);
  BOOST_TEST((whole - parts).norm() <= 1e-10 * parts.norm());
}
