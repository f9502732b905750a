// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/surface/repair.hpp"

#include "numeric/body/mass_properties.hpp"
#include "tests/numeric/support.hpp"

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double rounding = 100 * eps;

std::vector<Triangle> box_of_6() { return box_of_triangles({0, 0, 0}, {1, 2, 3}); }

std::vector<Triangle> together(std::vector<Triangle> one, const std::vector<Triangle>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

std::vector<Triangle> turned(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) turn(triangle);
  return triangles;
}

/// Each triangle with corners of its own.
Triangles soup(const std::vector<Triangle>& triangles) {
  Triangles all;
  for (const Triangle& triangle : triangles) {
    const int first = static_cast<int>(all.corners.size());
    all.corners.insert(all.corners.end(), triangle.begin(), triangle.end());
    all.triangles.push_back({first, first + 1, first + 2});
  }
  return all;
}

/// The volume by a sum of this test's own, in long double, and that the bar holds it.
Repairs check_volume(const std::vector<Triangle>& triangles, double volume, double off = 0) {
  const RepairedSurface done = repaired(soup(triangles));
  long double sum = 0;
  for (const SurfaceElement& element : done.surface.elements) {
    std::array<long double, 9> x{};
    for (int i = 0; i < 9; ++i) x[i] = done.surface.nodes[element.nodes[i / 3]][i % 3];
    sum +=
        (x[0] * (x[4] * x[8] - x[5] * x[7]) + x[1] * (x[5] * x[6] - x[3] * x[8]) + x[2] * (x[3] * x[7] - x[4] * x[6])) /
        6;
  }
  BOOST_TEST(std::fabs(static_cast<double>(sum) - volume) <= off + rounding * volume);
  BOOST_TEST(std::fabs(done.repairs.volume - volume) <= done.repairs.volume_error + rounding * volume);
  BOOST_TEST(done.repairs.volume_error <= 20 * off + 1e3 * rounding * volume);
  return done.repairs;
}

void check_refused(const std::vector<Triangle>& triangles, const std::string& words) {
  CHECK_REFUSED_SAYING(repaired(soup(triangles)), MeshError, words);
}

void check_strict_refuses(const std::vector<Triangle>& triangles) {
  CHECK_REFUSED_SAYING(repaired(soup(triangles), {.strict = true}), MeshError, "");
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_closed_surface_is_left_as_it_is) {
  const Repairs repairs = check_volume(box_of_6(), 6);
  BOOST_TEST(!repairs.any());
  BOOST_TEST(repairs.words() == "nothing repaired");
  const Surface strict = repaired(soup(box_of_6()), {.strict = true}).surface;
  const Surface plain = repaired(soup(box_of_6())).surface;
  BOOST_CHECK(strict.nodes == plain.nodes);
  for (std::size_t i = 0; i < 12; ++i) {
    BOOST_CHECK(strict.elements[i].nodes == plain.elements[i].nodes);
    BOOST_TEST(plain.elements[i].element == static_cast<int>(i));
  }
}

BOOST_AUTO_TEST_CASE(corners_across_a_seam_are_joined_and_the_bar_of_the_volume_holds_what_that_moves) {
  constexpr double gap = 1e-7;  // of a size of 3: below a millionth
  std::vector<Triangle> seam = box_of_6();
  for (std::size_t t = 0; t < 4; ++t) {  // bottom and top lie beside the rest
    for (Vector3& corner : seam[t]) corner += Vector3(gap, -gap, gap);
  }
  const Repairs repairs = check_volume(seam, 6, 20 * gap);
  BOOST_TEST(repairs.joined == 8);
  BOOST_TEST(repairs.words() == "8 corners joined");
  BOOST_TEST(repairs.volume_error >= std::fabs(repairs.volume - 6));
  BOOST_TEST(repairs.volume_error > gap);
  check_strict_refuses(seam);
  CHECK_REFUSED_SAYING(repaired(soup(seam), {.weld = 1e-9}), MeshError, "open");
}

BOOST_AUTO_TEST_CASE(corners_closer_than_the_weld_stay_where_nothing_is_open) {
  const std::vector<Triangle> thin = box_of_triangles({0, 0, 0}, {1, 1, 1e-8});
  const Repairs repairs = check_volume(thin, 1e-8, eps);  // of coordinates of 1 [m]
  BOOST_TEST(!repairs.any());
}

BOOST_AUTO_TEST_CASE(flat_triangles_are_left_out_and_their_corners_stay_on_the_edges) {
  std::vector<Triangle> flat = box_of_6();
  const Triangle first = flat[0];
  const Vector3 middle =
      (first[0] + first[1]) / 2;  // one face is cut there, the flat triangle fills the gap to the other
  flat[0] = {first[0], middle, first[2]};
  flat.push_back({middle, first[1], first[2]});
  flat.push_back({first[0], first[1], middle});
  flat.push_back({first[0], first[0], first[1]});
  const Repairs repairs = check_volume(flat, 6);
  BOOST_TEST(repairs.flat == 2);
  BOOST_TEST(repaired(soup(flat)).surface.elements.size() == 14u);
  check_strict_refuses(flat);
}

BOOST_AUTO_TEST_CASE(a_corner_on_an_edge_of_a_neighbour_splits_it) {
  std::vector<Triangle> split = box_of_6();
  const Triangle first = split[0];
  const Vector3 middle = (first[0] + first[1]) / 2;
  split[0] = {first[0], middle, first[2]};
  split.push_back({middle, first[1], first[2]});
  const Repairs repairs = check_volume(split, 6);
  BOOST_TEST(repaired(soup(split)).surface.elements.size() == 14u);
  BOOST_TEST(repairs.volume_error <= 1e-12);
  check_strict_refuses(split);
}

BOOST_AUTO_TEST_CASE(triangles_turned_inside_out_are_turned_back) {
  std::vector<Triangle> some = box_of_6();
  for (const std::size_t t : {1u, 5u, 8u}) turn(some[t]);
  BOOST_TEST(check_volume(some, 6).turned == 3);
  BOOST_TEST(check_volume(turned(box_of_6()), 6).turned == 12);
  check_strict_refuses(some);
  check_strict_refuses(turned(box_of_6()));
}

BOOST_AUTO_TEST_CASE(doubled_triangles_are_left_out_whichever_way_they_face) {
  std::vector<Triangle> doubled = box_of_6();
  doubled.push_back(doubled[3]);
  doubled.push_back({doubled[4][1], doubled[4][0], doubled[4][2]});
  const Repairs repairs = check_volume(doubled, 6);
  BOOST_TEST(repairs.doubled == 2);
  BOOST_TEST(check_volume(together(box_of_6(), turned(box_of_6())), 6).doubled == 12);  // both sides of a sheet
  check_strict_refuses(doubled);
}

BOOST_AUTO_TEST_CASE(the_wall_between_two_boxes_that_share_a_face_is_none_of_the_surface) {
  // Only where the diagonals of the common face agree are its triangles the same.
  const std::vector<Triangle> stacked = together(box_of_6(), box_of_triangles({0, 0, 3}, {1, 2, 5}));
  std::vector<Triangle> same = stacked;
  same[12] = {same[2][0], same[2][2], same[2][1]};
  same[13] = {same[3][0], same[3][2], same[3][1]};
  const Repairs repairs = check_volume(same, 10);
  BOOST_TEST(repairs.doubled == 4);
  BOOST_TEST(repairs.parts == 1);
}

BOOST_AUTO_TEST_CASE(a_box_that_faces_inward_in_another_is_its_cavity_and_one_that_faces_outward_is_left_out) {
  const std::vector<Triangle> inner = box_of_triangles({0.25, 0.5, 0.5}, {0.5, 1, 1.5});
  const Repairs hollow = check_volume(together(box_of_6(), turned(inner)), 6 - 0.125);
  BOOST_TEST(hollow.cavities == 1);
  BOOST_TEST(!hollow.any());
  const Repairs nested = check_volume(together(inner, box_of_6()), 6);
  BOOST_TEST(nested.nested == 1);
  BOOST_TEST(nested.parts == 1);
  const Repairs inside_out = check_volume(together(turned(box_of_6()), inner), 6 - 0.125);
  BOOST_TEST(inside_out.cavities == 1);
  BOOST_TEST(inside_out.turned == 24);
  const std::vector<Triangle> island =
      together(together(box_of_6(), turned(inner)), box_of_triangles({0.3, 0.6, 0.6}, {0.4, 0.7, 0.7}));
  BOOST_TEST(check_volume(island, 6 - 0.125 + 0.001).parts == 2);
  check_strict_refuses(together(inner, box_of_6()));
}

BOOST_AUTO_TEST_CASE(boxes_apart_are_parts_and_the_bar_of_boxes_that_overlap_holds_what_they_share) {
  const Repairs apart = check_volume(together(box_of_6(), box_of_triangles({5, 0, 0}, {6, 1, 1})), 7);
  BOOST_TEST(apart.parts == 2);
  BOOST_TEST(apart.overlapping == 0);
  for (const Vector3& low : {Vector3(0.5, 0.5, 0.5), Vector3(0.5, 0, 0)}) {  // the second with faces in common planes
    const Vector3 high = low + Vector3(1, 2, 3);
    const Repairs repairs = repaired(soup(together(box_of_6(), box_of_triangles(low, high)))).repairs;
    const double shared = (Vector3(1, 2, 3) - low).prod();
    BOOST_TEST(repairs.overlapping == 1);
    BOOST_TEST(repairs.volume_error >= shared);
    BOOST_TEST(std::fabs(repairs.volume - 12) <= rounding * 12);
    check_strict_refuses(together(box_of_6(), box_of_triangles(low, high)));
  }
  BOOST_TEST(repaired(soup(together(box_of_6(), box_of_triangles({1, 3, 0}, {2, 4, 1})))).repairs.overlapping == 0);
}

BOOST_AUTO_TEST_CASE(boxes_that_touch_in_an_edge_are_two) {
  const std::vector<Triangle> touching = together(box_of_6(), box_of_triangles({1, 2, 0}, {2, 3, 3}));
  const Repairs repairs = check_volume(touching, 9);
  BOOST_TEST(repairs.touching == 1);
  BOOST_TEST(repairs.parts == 2);
  BOOST_TEST(repaired(soup(touching)).surface.nodes.size() == 16u);
  check_strict_refuses(touching);
}

BOOST_AUTO_TEST_CASE(what_stays_open_has_one_side_or_no_place_is_refused_by_its_triangle) {
  std::vector<Triangle> open = box_of_6();
  open.pop_back();
  check_refused(open, "open");
  open = box_of_6();
  open[7][1].y() = not_a_number;
  check_refused(open, "triangle 7: a coordinate is not finite");
  check_refused({}, "no element");
  CHECK_REFUSED_SAYING(repaired({.corners = {Vector3::Zero()}, .triangles = {{0, 0, 1}}}), MeshError,
                       "corner 1 is not one");
  std::vector<Triangle> fin = box_of_6();
  fin.push_back({fin[0][0], fin[0][1], Vector3(5, 5, 5)});
  check_refused(fin, "3 faces instead of 2");
}

BOOST_AUTO_TEST_CASE(bars_hold_what_coordinates_of_32_bits_leave_of_volume_and_moments) {
  const Mesh ball =
      round_mesh({.semiaxes = Vector3::Constant(0.3), .straight = 0, .mass = 1, .sectors = 24, .rings = 6});
  Surface exact = boundary_surface(ball);
  Triangles stored{.corners = {}, .triangles = {}, .rounding = 0x1p-24};
  for (Vector3& node : exact.nodes) {
    node += Vector3(10, 20, 30);  // far off, where 32 bits lose most
    stored.corners.push_back(node.cast<float>().cast<double>());
  }
  Surface fine{.nodes = exact.nodes, .elements = {}};
  for (const SurfaceElement& element : exact.elements) {
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, {0, 2, 3}}) {
      if (element.nodes[k] < 0) continue;
      fine.elements.push_back({.nodes = {element.nodes[i], element.nodes[j], element.nodes[k], -1}});
      stored.triangles.push_back({element.nodes[i], element.nodes[j], element.nodes[k]});
    }
  }
  const RepairedSurface done = repaired(stored);
  const MassProperties one = mass_properties(fine, 1), other = mass_properties(done.surface, 1);
  const double off = std::fabs(one.mass - other.mass), turn_off = (one.inertia - other.inertia).cwiseAbs().maxCoeff();
  BOOST_TEST(off > 0);
  BOOST_TEST(off <= done.repairs.volume_error);
  BOOST_TEST(done.repairs.volume_error <= 1e-4 * one.mass);
  BOOST_TEST(turn_off <= done.repairs.moment_error);
  BOOST_TEST(done.repairs.moment_error <= 1e-2 * one.inertia(0, 0));
}
