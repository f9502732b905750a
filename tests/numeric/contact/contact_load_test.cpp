// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double relative = 1e-12;

ContactLoad load_at(const Body& body, const Ground& ground, const Drop& drop, double depth) {
  return facet_surface(body, ground)->load(pressed(touching_state(body, drop), depth));
}

/// Moment of the normal load about the centre of mass, world frame.
Vector3 moment(const ContactLoad& load, const MotionState& touch) {
  return touch.attitude * load.first_moment.cross(touch.attitude.conjugate() * Vector3::UnitZ());
}

void check_vector(const Vector3& value, const Vector3& expected, double bound) {
  BOOST_TEST((value - expected).norm() <= bound);
}

/// The phone cut into six tetrahedra around its diagonal.
Mesh six_tetrahedra() {
  Mesh mesh = box_mesh({.size = phone_size(), .mass = phone_mass});
  const Element whole = mesh.elements[0];
  mesh.elements.clear();
  const int around[7] = {1, 2, 3, 7, 4, 5, 1};  // the edges' path around the diagonal from 0 to 6
  for (int i = 0; i < 6; ++i)
    mesh.elements.push_back(
        {ElementShape::tetrahedron,
         {whole.nodes[0], whole.nodes[around[i]], whole.nodes[around[i + 1]], whole.nodes[6], -1, -1, -1, -1},
         whole.density});
  return mesh;
}

/// F = k A δ, U = ½ k A δ², no moment.
BOOST_AUTO_TEST_CASE(a_plate_lying_flat_is_a_linear_spring) {
  const Body body = box_body({0.3, 0.2, 0.1}, 1);
  for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
    const Ground ground{.stiffness = 1e7, .area = area};
    const double depth = 1e-4, sides = area == AreaMeasure::surface ? 2 * (0.3 + 0.2) * depth * depth / 2 : 0;
    const ContactLoad load = load_at(body, ground, {}, depth);
    BOOST_TEST(load.force == 1e7 * (0.06 * depth + sides), boost::test_tools::tolerance(relative));
    check_vector(load.first_moment.cross(Vector3::UnitZ()), Vector3::Zero(), relative * load.force);
  }
}

/// Edge of a box at inclination θ, a wedge: the bottom wets l_b = d/sin θ, the end face l_s = d/cos θ; on each
/// ∫δ = W l d/2 with its centroid l/3 from the edge, ∫δ² = W l d²/3.  Projected: times cos θ and sin θ.
BOOST_AUTO_TEST_CASE(a_wedge_gives_the_closed_forms_of_force_moment_and_energy) {
  const Vector3 size(0.3, 0.2, 0.1);
  const Body body = box_body(size, 1);
  const double k = 1e8, depth = 1e-3;
  for (const double angle : {1 * degree, 10 * degree, 45 * degree, 80 * degree}) {
    const double sine = std::sin(angle), cosine = std::cos(angle), width = size.y();
    const double bottom = depth / sine, end = depth / cosine;
    for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
      const bool surface = area == AreaMeasure::surface;
      const double bottom_weight = surface ? 1 : cosine, end_weight = surface ? 1 : sine;
      const double on_bottom = k * bottom_weight * width * bottom * depth / 2;
      const double on_end = k * end_weight * width * end * depth / 2;
      const Drop drop{.inclination = angle};
      // The side faces, vertical, are wetted too and count only in the surface measure: triangle of legs bottom, end.
      const double on_sides = surface ? 2 * k * bottom * end / 2 * depth / 3 : 0;
      const ContactLoad load = load_at(body, Ground{.stiffness = k, .area = area}, drop, depth);
      BOOST_TEST(load.force == on_bottom + on_end + on_sides, boost::test_tools::tolerance(relative));
      const Vector3 edge(-size.x() / 2, 0, -size.z() / 2);
      const Vector3 expected = on_bottom * (edge + Vector3(bottom / 3, 0, 0)) +
                               on_end * (edge + Vector3(0, 0, end / 3)) +
                               on_sides * (edge + Vector3(bottom / 4, 0, end / 4));
      check_vector(load.first_moment, expected, relative * load.force * size.norm());
      const double side_square = surface ? 2 * bottom * end / 2 * depth * depth / 6 : 0;
      const double energy = k / 2 *
                            (bottom_weight * width * bottom * depth * depth / 3 +
                             end_weight * width * end * depth * depth / 3 + side_square);
      BOOST_TEST(load.energy == energy, boost::test_tools::tolerance(relative));
    }
  }
}

/// Corner of a box: the ground's normal has components n_i in the body frame, the legs are d/n_i.  Projected:
/// k × the tetrahedron's volume d³/(6 n₁n₂n₃) with its centroid at a quarter of each leg.  Surface: on the face
/// across axis i ∫δ = d³/(6 n_j n_k), centroid of pressure at a quarter of its legs.
BOOST_AUTO_TEST_CASE(a_corner_gives_the_closed_forms_of_force_and_moment) {
  const Vector3 size(0.3, 0.2, 0.1);
  const Body body = box_body(size, 1);
  const Drop drop{.inclination = 0.5, .out_of_plane_tilt = 0.4};
  const MotionState touch = touching_state(body, drop);
  const Vector3 n = (touch.attitude.conjugate() * Vector3::UnitZ()).cwiseAbs();
  const Vector3 inward = touch.attitude.conjugate() * Vector3::UnitZ();
  const double depth = 1e-3, k = 1e9, cube = depth * depth * depth;
  Vector3 corner, legs;
  for (int i = 0; i < 3; ++i) {
    corner[i] = inward[i] > 0 ? -size[i] / 2 : size[i] / 2;
    legs[i] = std::copysign(depth / n[i], inward[i]);
  }
  const ContactLoad projected = load_at(body, {.stiffness = k, .area = AreaMeasure::projected}, drop, depth);
  const double buoyancy = k * cube / (6 * n[0] * n[1] * n[2]);
  BOOST_TEST(projected.force == buoyancy, boost::test_tools::tolerance(relative));
  const Vector3 lift = buoyancy * (corner + legs / 4);
  // Only the moment of the vertical load has to agree: the first moment differs by a multiple of the normal.
  check_vector(projected.first_moment.cross(inward), lift.cross(inward), relative * buoyancy * size.norm());

  const ContactLoad surface = load_at(body, {.stiffness = k}, drop, depth);
  double force = 0;
  Vector3 first_moment = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const double part = k * cube / (6 * n[j] * n[l]);
    Vector3 centroid = corner;
    centroid[j] += legs[j] / 4;
    centroid[l] += legs[l] / 4;
    force += part;
    first_moment += part * centroid;
  }
  BOOST_TEST(surface.force == force, boost::test_tools::tolerance(relative));
  check_vector(surface.first_moment, first_moment, relative * force * size.norm());
}

BOOST_AUTO_TEST_CASE(a_body_wholly_in_the_ground_floats_with_its_volume) {
  const Vector3 size(0.3, 0.2, 0.1);
  const Ground ground{.stiffness = 1e6, .area = AreaMeasure::projected};
  const ContactLoad load = load_at(box_body(size, 1), ground, {.inclination = 0.7, .out_of_plane_tilt = 0.3}, 5);
  BOOST_TEST(load.force == 1e6 * size.prod(), boost::test_tools::tolerance(relative));
}

/// A plane's load does not know how the plane is meshed.
BOOST_AUTO_TEST_CASE(meshing_and_merging_change_nothing_beyond_rounding) {
  constexpr double rounding = 1e-13;
  const Drop drop{.inclination = 0.2, .out_of_plane_tilt = 0.1};
  for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
    const auto load_of = [&](const Body& body) {
      GroundView view = pressed(touching_state(body, drop), 2e-3);
      view.vertical_speed = -1;
      view.angular_velocity = Vector3(1, 2, 3);
      return facet_surface(body, {.stiffness = 1e9, .damping = 1e7, .area = area})->load(view);
    };
    const ContactLoad whole = load_of(phone());
    for (const bool merge : {true, false}) {
      for (const Body& body : {phone(13, 7, 5, merge), Body(six_tetrahedra(), merge)}) {
        const ContactLoad meshed = load_of(body);
        BOOST_TEST(std::fabs(meshed.force - whole.force) <= rounding * whole.force);
        check_vector(meshed.first_moment, whole.first_moment, rounding * whole.force * phone_size().norm());
        BOOST_TEST(std::fabs(meshed.energy - whole.energy) <= rounding * whole.energy);
        BOOST_TEST(std::fabs(meshed.damping_power - whole.damping_power) <= rounding * whole.damping_power);
      }
    }
  }
}

/// The mirror image at the plane x = 0 lands on the other end with the mirrored load.
BOOST_AUTO_TEST_CASE(a_mirror_image_bears_the_mirrored_load) {
  const Body body = rod();
  const Drop left{.inclination = 0.6}, right{.inclination = -0.6};
  const ContactLoad a = load_at(body, {.stiffness = 1e11}, left, 1e-3),
                    b = load_at(body, {.stiffness = 1e11}, right, 1e-3);
  const double both = moment(a, touching_state(body, left)).y() + moment(b, touching_state(body, right)).y();
  BOOST_TEST(std::fabs(a.force - b.force) <= 1e-13 * a.force);
  BOOST_TEST(std::fabs(both) <= 1e-13 * a.force);
}

/// Where δ̇ < −k/c the ground would pull: a plate turning about its middle, rising on one side.
BOOST_AUTO_TEST_CASE(the_clamp_cuts_along_the_exact_line_and_books_the_released_energy) {
  const Body body = box_body({2, 1, 0.1}, 1);
  const double k = 1e6, c = 1e6, depth = 1e-3;
  const Ground ground{.stiffness = k, .damping = c, .area = AreaMeasure::projected};
  GroundView view = pressed(touching_state(body, {}), depth);
  const double omega = 2;  // δ̇ = ω x: below −k/c = −1 for x < −1/2
  view.angular_velocity = Vector3(0, omega, 0);
  const ContactLoad load = facet_surface(body, ground)->load(view);
  // δ is constant; f = (k + c ω x) δ over x from −1/2 to 1.
  BOOST_TEST(load.force == depth * (k * 1.5 + c * omega * 0.375), boost::test_tools::tolerance(relative));
  BOOST_TEST(load.damping_power == c * depth * omega * omega * 0.375, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.release_power == k * depth * omega * 0.375, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.energy == k * depth * depth, boost::test_tools::tolerance(relative));
  // At δ̇ = −k/c exactly it neither presses nor pulls: all the power of its springs is released, k δ (k/c) A.
  view.angular_velocity.setZero();
  view.vertical_speed = k / c;
  const ContactLoad let_go = facet_surface(body, ground)->load(view);
  BOOST_TEST((let_go.force == 0 && let_go.damping_power == 0));
  BOOST_TEST(let_go.release_power == k * depth * (k / c) * 2, boost::test_tools::tolerance(relative));
}

/// So that a search for the lift-off knows how far the body is above the ground, whatever its size.
BOOST_AUTO_TEST_CASE(a_body_high_above_the_ground_is_some_of_its_sizes_above) {
  for (const double size : {1e-30, 1.0, 1e30}) {
    const ContactLoad load = load_at(box_body(size * Vector3(1, 0.4, 0.2), 1), {}, {.inclination = 0.3}, -3 * size);
    BOOST_TEST((load.deepest < -0.5 * size && load.deepest > -4 * size), size << ": " << load.deepest);
    BOOST_TEST(load.force == 0);
  }
}

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

BOOST_AUTO_TEST_CASE(friction_of_faces_that_look_up_is_bounded_by_the_normal_force_and_takes_energy) {
  Random random(7);
  int looking_up = 0;
  for (int i = 0; i < 90; ++i) {
    const Corner corner = random_corner(random);
    const auto loader = facet_surface(corner.body, corner.ground);
    const ContactLoad load = loader->load(corner.view);
    if (!(load.force > 0)) continue;
    for (const Facet& facet : corner.body.facets().facets) looking_up += facet.normal.dot(corner.view.normal()) > 0;
    for (const double regularisation : {0.0, 0.1}) {
      for (const bool planar : {false, true}) {
        const SlipField field{.planar = planar, .regularisation = regularisation};
        const SlipLoad friction = loader->slip_load(corner.view, field);
        BOOST_TEST(std::hypot(friction.east, planar ? 0 : friction.north) <= load.force * (1 + relative));
        if (!planar) BOOST_TEST(dissipated(corner.view, friction) >= -relative * load.force);
      }
    }
    const SlipField flat{.kind = SlipField::Kind::turning, .centre = load.pressure_centre(), .east = 0.1, .spin = 1};
    BOOST_TEST(force_of(corner.view, loader->slip_load(corner.view, flat)).norm() <= load.force * (1 + relative));
  }
  BOOST_TEST(looking_up > 60);
}

BOOST_AUTO_TEST_CASE(friction_is_that_of_columns_each_pressed_by_the_difference_of_its_ends) {
  Random random(11);
  for (int seen = 0; seen < 5;) {
    const Corner corner = random_corner(random);
    const auto loader = facet_surface(corner.body, corner.ground);
    const ContactLoad load = loader->load(corner.view);
    if (!(load.force > 0.02)) continue;  // a patch of many columns
    ++seen;
    const Vector3 found = force_of(corner.view, loader->slip_load(corner.view, {}));
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
        const auto loader = facet_surface(box, ground);
        const double force = loader->load(view).force;
        return force_of(view, loader->slip_load(view, {})) / force;
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
    const auto loader = facet_surface(body, ground);
    GroundView view;
    view.reference = {Vector3::UnitZ(), properties.centre.z() - 0.4};
    const Vector3 at = velocity + rotation.cross(properties.centre - centre);
    view.vertical_speed = at.z();
    view.east_speed = at.x();
    view.north_speed = at.y();
    view.angular_velocity = rotation;
    static_cast<void>(loader->load(view));
    const SlipLoad load = loader->slip_load(view, {});
    return Vector3(load.east, load.north,
                   load.moment.z() + (properties.centre.x() * load.north - properties.centre.y() * load.east));
  };
  const Vector3 whole = friction_of(all), parts = friction_of(wall) + friction_of(low) + friction_of(high);
  BOOST_TEST((whole - parts).norm() <= 1e-10 * parts.norm());
}

}  // namespace
