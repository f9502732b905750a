// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/near_flat/footprint.hpp"

#include <Eigen/LU>

#include "analytic/near_flat/two_contacts.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/landing/flat_landing.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::analytic::near_flat;
using clatter::test::eps;
namespace space = clatter::analytic::space;

Footprint box(double length, double width, double thickness) {
  Footprint f{.corners = {}, .mobility = Eigen::Matrix2d::Zero()};
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    f.corners.emplace_back(x * length / 2, y * width / 2);
  f.mobility(0, 0) = 12 / (length * length + thickness * thickness);
  f.mobility(1, 1) = 12 / (width * width + thickness * thickness);
  return f;
}

/// A thin plate in the form of a triangle: its inertia is that of a third of its mass at the middle of each side.
Footprint triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d centre = (a + b + c) / 3;
  Footprint f{.corners = {a - centre, b - centre, c - centre}, .mobility = Eigen::Matrix2d::Zero()};
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d r = (f.corners[i] + f.corners[(i + 1) % 3]) / 2;
    inertia(0, 0) += r.y() * r.y() / 3;
    inertia(1, 1) += r.x() * r.x() / 3;
    inertia(0, 1) -= r.x() * r.y() / 3;
  }
  inertia(1, 0) = inertia(0, 1);
  inertia(2, 2) = inertia(0, 0) + inertia(1, 1);
  f.mobility = slope_mobility(1, inertia);
  return f;
}

/// Over all directions of the tilt.
struct Extremes {
  double second = 0, largest = 0, shares = 0;
  std::size_t at = 0, fewest = 1000, most = 0;

  explicit Extremes(const TiltSectors& found) : shares(found.open_share) {
    for (const TiltSector& sector : found.sectors) {
      const std::size_t hardest = sector.hardest();
      if (sector.strikes[hardest].approach > largest * (1 + 8 * eps)) {
        largest = sector.strikes[hardest].approach;
        at = hardest + 1;
      }
      if (sector.strikes.size() > 1) second = std::fmax(second, sector.strikes[1].approach);
      fewest = std::min(fewest, sector.strikes.size());
      most = std::max(most, sector.strikes.size());
      shares += sector.share();
    }
  }
};

BOOST_AUTO_TEST_CASE(a_thin_rectangle_has_17_7_second_121_49_third_and_four_to_six_strikes_whatever_its_sides) {
  for (const double length : {1.0, 2.0, 7.3}) {
    const Extremes found(tilt_sectors(box(length, 1, 0), 1));
    BOOST_CHECK_LE(std::fabs(found.second - 17. / 7), 8 * eps);
    BOOST_CHECK_LE(std::fabs(found.largest - 121. / 49), 8 * eps);
    BOOST_CHECK_EQUAL(found.at, 3u);
    BOOST_CHECK_EQUAL(found.fewest, 4u);
    BOOST_CHECK_EQUAL(found.most, 6u);
    BOOST_CHECK_LE(std::fabs(found.shares - 1), 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(cube_phone_and_any_thin_triangle_have_their_hardest_strikes_where_the_billiard_has_them) {
  const Extremes cube(tilt_sectors(box(1, 1, 1), 1)), phone(tilt_sectors(box(0.15, 0.075, 0.008), 1));
  BOOST_CHECK_LE(std::fabs(cube.largest - 2), 8 * eps);
  BOOST_CHECK_EQUAL(cube.at, 2u);
  BOOST_CHECK_LE(std::fabs(phone.second - 541489601. / 223285399), 8 * eps);  // 1 + 2 (λ − 1)/(λ + 1)
  BOOST_CHECK_LE(std::fabs(phone.largest - 2.4560), 5e-5);
  BOOST_CHECK_EQUAL(phone.at, 3u);
  for (const Eigen::Vector2d& tip : {Eigen::Vector2d(0, 1), Eigen::Vector2d(0.3, 2.5), Eigen::Vector2d(3, 0.4)}) {
    const Extremes found(tilt_sectors(triangle({0, 0}, {1, 0}, tip), 1));
    BOOST_CHECK_LE(std::fabs(found.largest - 77. / 27), 64 * eps);
    BOOST_CHECK_EQUAL(found.at, 4u);
  }
}

BOOST_AUTO_TEST_CASE(the_opposite_corner_second_has_its_closed_form_for_any_restitution_and_thickness) {
  for (const double e : {0.3, 0.8, 1.0}) {
    for (const double thickness : {0.0, 0.2, 0.9}) {
      const double lambda = 3 * 4 / (4 + thickness * thickness) + 3 / (1 + thickness * thickness);
      const Extremes found(tilt_sectors(box(2, 1, thickness), e, 20));
      BOOST_CHECK_LE(std::fabs(found.second - (1 + (1 + e) * (lambda - 1) / (lambda + 1))), 16 * eps);
    }
  }
}

BOOST_AUTO_TEST_CASE(every_sector_is_what_its_own_directions_give_and_elastic_strikes_keep_the_energy) {
  Footprint uneven = box(2, 1, 0.3);
  for (Eigen::Vector2d& corner : uneven.corners) corner += Eigen::Vector2d(0.2, -0.1);
  uneven.corners.emplace_back(1.6, 0.1);
  uneven.mobility(0, 1) = uneven.mobility(1, 0) = 0.4;
  for (const double e : {1.0, 0.4}) {
    const TiltSectors found = tilt_sectors(uneven, e);
    BOOST_CHECK_GT(found.sectors.size(), 10u);
    for (const TiltSector& sector : found.sectors) {
      for (const double s : {0.001, 0.5, 0.999}) {
        const auto one = strikes_of_tilt(uneven, e, (1 - s) * sector.from + s * sector.to, 200);
        BOOST_REQUIRE(std::ranges::equal(one, sector.strikes, {}, &CornerStrike::corner, &CornerStrike::corner));
      }
      double v = -1, lost = 0;  // ΔT/m = P (v + v′)/2
      Eigen::Vector2d rate = Eigen::Vector2d::Zero();
      for (const CornerStrike& strike : sector.strikes) {
        v += strike.impulse;
        rate += strike.impulse * uneven.mobility * uneven.corners[strike.corner];
        lost += strike.impulse * strike.approach * (1 - e) / 2;
      }
      BOOST_CHECK_LE(std::fabs((v * v + rate.dot(uneven.mobility.inverse() * rate)) / 2 + lost - 0.5), 1e-14);
      for (const Eigen::Vector2d& corner : uneven.corners) BOOST_CHECK_GE(v + corner.dot(rate), -1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(two_contacts_of_a_footprint_are_the_wedge_of_the_plane) {
  const TwoContacts arms{0.3, 0.7, 0.2};
  const Footprint line{.corners = {{-0.3, 0}, {0.7, 0}}, .mobility = Eigen::Vector2d(25, 1).asDiagonal()};
  for (const double e : {1.0, 0.75}) {
    const auto plane = strikes(arms, e, End::a, 100);
    const auto found = strikes_of_tilt(line, e, 0.3, 100);
    BOOST_REQUIRE_EQUAL(found.size(), plane.size());
    for (std::size_t i = 0; i < plane.size(); ++i)
      BOOST_CHECK_LE(std::fabs(found[i].impulse - plane[i].impulse), 32 * eps);
  }
  const auto critical = critical_restitution(line);
  BOOST_REQUIRE(critical.has_value());
  BOOST_CHECK_LE(std::fabs(critical->restitution - critical_restitution(arms)), 1e-12);
}

BOOST_AUTO_TEST_CASE(critical_restitution_of_a_thin_rectangle_parts_few_strikes_from_endless) {
  const auto found = critical_restitution(box(2, 1, 0));
  BOOST_REQUIRE(found.has_value());
  BOOST_CHECK_LE(found->error, 1e-12);
  BOOST_CHECK_EQUAL(found->cycle.size(), 4u);
  BOOST_CHECK_EQUAL(strikes_of_tilt(box(2, 1, 0), found->restitution * 0.999, 1, 3000).size(), 3000u);
  BOOST_CHECK_LE(strikes_of_tilt(box(2, 1, 0), found->restitution * 1.001, 1, 3000).size(), 1000u);
  BOOST_CHECK(!critical_restitution(box(1, 1, 1)));
}

/// Largest error of the approaches of the full model in space of a phone tilted into the middle of a sector.
double error_of_tilt(const TiltSector& sector, double e, double tilt) {
  const clatter::oracle::FlatBox phone(0.15, 0.075, 0.008, 0.2);
  space::Body body = phone.body;
  for (const space::Corner& corner : phone.bottom) body.vertices.push_back(corner.place);
  const double direction = (sector.from + sector.to) / 2;
  space::Drop drop;
  drop.body = body;
  drop.attitude = Eigen::AngleAxisd(tilt, space::Vector3(std::sin(direction), -std::cos(direction), 0));
  drop.velocity = {0, 0, -1};
  drop.law = clatter::oracle::frictionless(e);
  const auto count = static_cast<int>(sector.strikes.size());
  const auto full = space::impact_sequence(drop, {.impacts = count, .amplification = false});
  BOOST_REQUIRE_EQUAL(full.rows.size(), sector.strikes.size());
  double error = 0;
  for (std::size_t i = 0; i < sector.strikes.size(); ++i)
    error = std::fmax(error, std::fabs(full.rows[i].impact.approach_speed - sector.strikes[i].approach));
  return error;
}

BOOST_AUTO_TEST_CASE(the_full_model_in_space_tends_to_every_sector_with_the_first_power_of_the_tilt) {
  int sectors = 0;
  for (const double e : {1.0, 0.6}) {
    for (const TiltSector& sector : tilt_sectors(box(0.15, 0.075, 0.008), e).sectors) {
      if (sector.share() < 0.01) continue;
      ++sectors;
      const double coarse = error_of_tilt(sector, e, 2e-6), fine = error_of_tilt(sector, e, 1e-6);
      BOOST_CHECK_LE(fine, 1e-4);
      BOOST_CHECK_LE(std::fabs(coarse / fine - 2), 0.1);
    }
  }
  BOOST_CHECK_GE(sectors, 20);
}

BOOST_AUTO_TEST_CASE(a_footprint_that_is_none_is_refused) {
  Footprint f = box(1, 1, 1);
  f.mobility(0, 0) = -1;
  CHECK_REFUSED(tilt_sectors(f, 1), std::domain_error);
  CHECK_REFUSED(tilt_sectors(box(1, 1, 1), -0.1), std::domain_error);
  f = box(1, 1, 1);
  f.corners.resize(1);
  CHECK_REFUSED(tilt_sectors(f, 1), std::domain_error);
}

}  // namespace
