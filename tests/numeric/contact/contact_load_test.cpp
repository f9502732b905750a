// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>

#include "tests/numeric/bodies.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double relative = 1e-12;

/// A body at rest, pushed `depth` below the attitude at which it touches.
GroundView pressed(const Body& body, const MotionState& touch, double depth) {
  GroundView view;
  const Eigen::Quaterniond back = touch.attitude.conjugate();
  view.reference = {back * Vector3::UnitZ(), touch.centre.z()};
  view.sink = -depth;
  view.east = back * Vector3::UnitX();
  view.north = back * Vector3::UnitY();
  static_cast<void>(body);
  return view;
}

ContactLoad load_at(const Body& body, const Ground& ground, const Drop& drop, double depth) {
  ContactLoader loader(body, ground);
  return loader.load(pressed(body, touching_state(body, drop), depth), {});
}

/// Moment of the normal load about the centre of mass, world frame.
Vector3 moment(const ContactLoad& load, const MotionState& touch) {
  return touch.attitude * load.first_moment.cross(touch.attitude.conjugate() * Vector3::UnitZ());
}

void check_vector(const Vector3& value, const Vector3& expected, double bound) {
  BOOST_TEST((value - expected).norm() <= bound);
}

}  // namespace

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

/// A plate's whole lower face in the ground at inclination θ, its middle δ below it, its upper face above.  Projected,
/// this is the displaced volume W L δ/cos θ; over x along the plate its height is (δ − x sin θ)/cos θ.
BOOST_AUTO_TEST_CASE(a_tilted_plate_gives_the_closed_forms_of_force_and_moment) {
  const double length = 0.1, width = 0.2, thickness = 0.5, angle = 0.1, k = 1e7, depth = 0.02;
  const Body body = box_body({length, width, thickness}, 1);
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const double middle = depth - length / 2 * sine;  // below the ground of the lower face's middle
  const double volume = width * length * middle / cosine;
  const ContactLoad load =
      load_at(body, {.stiffness = k, .area = AreaMeasure::projected}, {.inclination = angle}, depth);
  BOOST_TEST(load.force == k * volume, boost::test_tools::tolerance(relative));
  // ∫x h dx and ∫(z₀ + h/2) h dx over the trapezoid, h = (δ − x sin θ)/cos θ, z₀ the lower face.
  const double along = -width * sine / cosine * length * length * length / 12;
  const double squares =
      width * (middle * middle * length + sine * sine * length * length * length / 12) / (cosine * cosine);
  const double up = -thickness / 2 * volume + squares / 2;
  // The moment about y of k V at the centroid: −(x cos θ − z sin θ) F.
  const double expected = -k * (along * cosine - up * sine);
  const MotionState touch = touching_state(body, {.inclination = angle});
  BOOST_TEST(std::fabs(moment(load, touch).y() - expected) <= relative * load.force * thickness);
}

/// A triangular prism with an edge down, of half-angle φ: two faces W × d/cos φ and two ends d² tan φ.
BOOST_AUTO_TEST_CASE(a_prism_gives_the_closed_form_of_the_force) {
  const double half_angle = 0.6, height = 0.1, width = 0.3, k = 1e8, depth = 0.01;
  const double reach = height * std::tan(half_angle);
  Mesh mesh;
  for (const double y : {-width / 2, width / 2}) {
    mesh.nodes.emplace_back(0, y, 0);
    mesh.nodes.emplace_back(reach, y, height);
    mesh.nodes.emplace_back(-reach, y, height);
  }
  mesh.elements.push_back({ElementShape::prism, {0, 2, 1, 3, 5, 4, -1, -1}, 1000});
  const Body body(mesh);
  const double ends = depth * depth * std::tan(half_angle);
  const ContactLoad projected = load_at(body, {.stiffness = k, .area = AreaMeasure::projected}, {}, depth);
  BOOST_TEST(projected.force == k * width * ends, boost::test_tools::tolerance(relative));
  const ContactLoad surface = load_at(body, {.stiffness = k}, {}, depth);
  BOOST_TEST(surface.force == k * (width * depth * depth / std::cos(half_angle) + 2 * ends * depth / 3),
             boost::test_tools::tolerance(relative));
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

/// A round patch as a polygon: the rod standing upright, its end face a regular 16-gon with area 8 r² sin(π/8).
BOOST_AUTO_TEST_CASE(a_polygonal_cap_gives_the_closed_form_of_the_force) {
  const double k = 1e9, depth = 1e-5, r = 0.01;
  const ContactLoad load =
      load_at(rod(), {.stiffness = k, .area = AreaMeasure::projected}, {.inclination = 90 * degree}, depth);
  BOOST_TEST(load.force == k * depth * 8 * r * r * std::sin(std::numbers::pi / 8),
             boost::test_tools::tolerance(relative));
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
  for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
    const Ground ground{.stiffness = 1e9, .damping = 1e7, .area = area};
    const Drop drop{.inclination = 0.2, .out_of_plane_tilt = 0.1};
    const auto load_of = [&](const Body& body) {
      GroundView view = pressed(body, touching_state(body, drop), 2e-3);
      view.vertical_speed = -1;
      view.angular_velocity = Vector3(1, 2, 3);
      return ContactLoader(body, ground).load(view, {});
    };
    const ContactLoad whole = load_of(phone());
    for (const bool merge : {true, false}) {
      const ContactLoad meshed = load_of(phone(13, 7, 5, merge));
      BOOST_TEST(std::fabs(meshed.force - whole.force) <= rounding * whole.force);
      check_vector(meshed.first_moment, whole.first_moment, rounding * whole.force * phone_size().norm());
      BOOST_TEST(std::fabs(meshed.energy - whole.energy) <= rounding * whole.energy);
      BOOST_TEST(std::fabs(meshed.damping_power - whole.damping_power) <= rounding * whole.damping_power);
    }
  }
}

/// The box of one hexahedron and the same box cut into six tetrahedra around its diagonal.
BOOST_AUTO_TEST_CASE(a_triangulation_changes_nothing_beyond_rounding) {
  constexpr double rounding = 1e-13;
  const Mesh box = box_mesh({.size = phone_size(), .mass = phone_mass});
  Mesh cut = box;
  cut.elements.clear();
  const std::array<int, 8>& n = box.elements[0].nodes;
  const int around[6] = {1, 2, 3, 7, 4, 5};  // the edges' path around the diagonal from 0 to 6
  for (int i = 0; i < 6; ++i) {
    const auto corner = [&](int j) { return n[static_cast<std::size_t>(around[j % 6])]; };
    Element element{
        ElementShape::tetrahedron, {n[0], corner(i), corner(i + 1), n[6], -1, -1, -1, -1}, box.elements[0].density};
    cut.elements.push_back(element);
  }
  for (const bool merge : {true, false}) {
    const Body whole(box, merge), pieces(cut, merge);
    BOOST_TEST((whole.inertia() - pieces.inertia()).norm() <= rounding * whole.inertia().norm());
    for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
      const Ground ground{.stiffness = 1e9, .area = area};
      const Drop drop{.inclination = 0.3, .out_of_plane_tilt = 0.2};
      const ContactLoad a = load_at(whole, ground, drop, 3e-3), b = load_at(pieces, ground, drop, 3e-3);
      BOOST_TEST(std::fabs(a.force - b.force) <= rounding * a.force);
      check_vector(a.first_moment, b.first_moment, rounding * a.force * phone_size().norm());
    }
  }
}

/// The mirror image at the plane x = 0 lands on the other end with the mirrored load.
BOOST_AUTO_TEST_CASE(a_mirror_image_bears_the_mirrored_load) {
  constexpr double rounding = 1e-13;
  const Body body = rod();
  const Ground ground{.stiffness = 1e11};
  const MotionState left = touching_state(body, {.inclination = 0.6});
  const MotionState right = touching_state(body, {.inclination = -0.6});
  const ContactLoad a = load_at(body, ground, {.inclination = 0.6}, 1e-3);
  const ContactLoad b = load_at(body, ground, {.inclination = -0.6}, 1e-3);
  BOOST_TEST(std::fabs(a.force - b.force) <= rounding * a.force);
  BOOST_TEST(std::fabs(moment(a, left).y() + moment(b, right).y()) <= rounding * a.force);
}

/// The ground's potential: F = −dU/dz, and the moment is its derivative over the turn.
BOOST_AUTO_TEST_CASE(force_and_moment_are_derivatives_of_the_stored_energy) {
  const Body body = phone();
  const double step = 1e-8, depth = 1e-3;
  for (const AreaMeasure area : {AreaMeasure::surface, AreaMeasure::projected}) {
    const Ground ground{.stiffness = 1e8, .area = area};
    const Drop drop{.inclination = 0.3, .out_of_plane_tilt = 0.2};
    const MotionState touch = touching_state(body, drop);
    ContactLoader loader(body, ground);
    const auto energy_at = [&](double down, double turn) {
      MotionState state = touch;
      state.attitude = Eigen::AngleAxisd(turn, Vector3::UnitY()) * touch.attitude;
      GroundView view = pressed(body, state, down);
      return loader.load(view, {}).energy;
    };
    const ContactLoad load = load_at(body, ground, drop, depth);
    const double force = (energy_at(depth + step, 0) - energy_at(depth - step, 0)) / (2 * step);
    const double turning = -(energy_at(depth, step) - energy_at(depth, -step)) / (2 * step);
    constexpr double of_differences = 1e-7;  // rounding of the energies over the step
    BOOST_TEST(load.force == force, boost::test_tools::tolerance(of_differences));
    BOOST_TEST(moment(load, touch).y() == turning, boost::test_tools::tolerance(of_differences));
  }
}

/// Where δ̇ < −k/c the ground would pull: a plate turning about its middle, rising on one side.
BOOST_AUTO_TEST_CASE(the_clamp_cuts_along_the_exact_line_and_books_the_released_energy) {
  const Body body = box_body({2, 1, 0.1}, 1);
  const double k = 1e6, c = 1e6, depth = 1e-3;
  const Ground ground{.stiffness = k, .damping = c, .area = AreaMeasure::projected};
  GroundView view = pressed(body, touching_state(body, {}), depth);
  const double omega = 2;  // δ̇ = ω x: below −k/c = −1 for x < −1/2
  view.angular_velocity = Vector3(0, omega, 0);
  const ContactLoad load = ContactLoader(body, ground).load(view, {});
  // δ is constant; f = (k + c ω x) δ over x from −1/2 to 1.
  BOOST_TEST(load.force == depth * (k * 1.5 + c * omega * 0.375), boost::test_tools::tolerance(relative));
  BOOST_TEST(load.damping_power == c * depth * omega * omega * 0.375, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.release_power == k * depth * omega * 0.375, boost::test_tools::tolerance(relative));
  BOOST_TEST(load.energy == k * depth * depth, boost::test_tools::tolerance(relative));
}

/// At δ̇ = −k/c exactly the ground neither presses nor pulls: all the power of its springs is released, k δ (k/c) A.
BOOST_AUTO_TEST_CASE(at_the_speed_at_which_the_ground_lets_go_all_is_released) {
  const Body body = box_body({2, 1, 0.1}, 1);
  const double k = 1e6, c = 5e5, depth = 1e-3;
  const Ground ground{.stiffness = k, .damping = c, .area = AreaMeasure::projected};
  GroundView view = pressed(body, touching_state(body, {}), depth);
  view.vertical_speed = k / c;
  const ContactLoad load = ContactLoader(body, ground).load(view, {});
  BOOST_TEST(load.force == 0);
  BOOST_TEST(load.damping_power == 0);
  BOOST_TEST(load.release_power == k * depth * (k / c) * 2, boost::test_tools::tolerance(relative));
}

BOOST_AUTO_TEST_CASE(nothing_presses_above_the_ground) {
  const ContactLoad load = load_at(phone(), {}, {.inclination = 0.3}, -1e-9);
  BOOST_TEST(load.force == 0);
  BOOST_TEST(load.deepest < 0);
}

/// So that a search for the lift-off knows how far the body is above the ground, whatever its size.
BOOST_AUTO_TEST_CASE(a_body_high_above_the_ground_is_some_of_its_sizes_above) {
  for (const double size : {1e-30, 1.0, 1e30}) {
    const ContactLoad load = load_at(box_body(size * Vector3(1, 0.4, 0.2), 1), {}, {.inclination = 0.3}, -3 * size);
    BOOST_TEST((load.deepest < -0.5 * size && load.deepest > -4 * size), size << ": " << load.deepest);
  }
}
