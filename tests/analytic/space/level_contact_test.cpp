// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/level_contact.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "analytic/plane/impact.hpp"
#include "analytic/space/simultaneous.hpp"
#include "tests/analytic/space/flat_landing.hpp"
#include "tests/analytic/space/random_contact.hpp"

namespace {

using namespace clatter::analytic;
using namespace clatter::analytic::space;
using clatter::oracle::coulomb;
using clatter::oracle::FlatBox;
using clatter::oracle::frictionless;
using clatter::oracle::normal_velocity;
using clatter::oracle::Random;

using Motion = Eigen::Matrix<double, 6, 1>;

struct Landing {
  Body body;
  State before;
  std::vector<Corner> touching;
  Law law;

  [[nodiscard]] GroupImpact impact() const { return strike_together(body, before, touching, law); }
  /// With angular velocities as speeds of a point at this distance.
  [[nodiscard]] Motion after(double reach) const {
    const GroupImpact struck = impact();
    Motion motion;
    motion << struck.velocity_after, reach * struck.angular_velocity_after;
    return motion;
  }
};

Landing landing_of(const FlatBox& box, const Law& law, const Vector3& velocity, const Vector3& spin) {
  Landing l{.body = box.body, .before = {}, .touching = box.bottom, .law = law};
  l.before.velocity = velocity;
  l.before.angular_velocity = spin;
  return l;
}

/// A box on its bottom, or on one of the edges of that with the centre of mass above.
Landing random_landing(Random& random, bool on_edge, const FlatBox& box) {
  Landing l = landing_of(box, {}, {0, 0, -1}, Vector3::Zero());
  Quaternion lean = Quaternion::Identity();
  if (on_edge) {
    lean = Eigen::AngleAxisd(std::atan2(box.width, box.height), Vector3::UnitX());
    const bool low = (lean * box.bottom[0].place).z() < (lean * box.bottom[2].place).z();
    l.touching = low ? std::vector{box.bottom[0], box.bottom[1]} : std::vector{box.bottom[2], box.bottom[3]};
  }
  l.before.attitude = Quaternion(Eigen::AngleAxisd(random.uniform(0, 6.28), Vector3::UnitZ())) * lean;
  l.law = coulomb(random.uniform(0, 1), std::pow(10, random.uniform(-1.3, 0.3)),
                  static_cast<RestitutionLaw>(random.whole(0, 2)));
  return l;
}

/// Seen in a mirror, y → −y, with the corners in another order.
Landing mirrored(Landing l) {
  const auto seen = [](Vector3 v) { return Vector3(v.x(), -v.y(), v.z()); };
  const Quaternion q = l.before.attitude;
  l.before.attitude = Quaternion(q.w(), -q.x(), q.y(), -q.z());
  l.before.velocity = seen(l.before.velocity);
  l.before.angular_velocity = -seen(l.before.angular_velocity);
  for (Corner& corner : l.touching) corner.place = seen(corner.place);
  std::ranges::reverse(l.touching);
  return l;
}

Motion mirrored(Motion m) {
  m[1] *= -1, m[3] *= -1, m[5] *= -1;
  return m;
}

}  // namespace

/// While the tower slips, the ground pushes at its front edge, 3 μh/5 ahead: ω_y grows by (μh − a/2)/I per impulse, and
/// slip by −μ − h times that.  After it has stopped, nothing turns the tower any more.
BOOST_AUTO_TEST_CASE(a_tower_that_slips_a_little_is_tilted_until_slip_stops_and_rebounds_as_a_whole_thereafter) {
  constexpr double mu = 0.4, h = 0.2, half = 0.05, slip = 0.1, e = 0.65, tolerance = 1e-13;
  const FlatBox tower(2 * half, 2 * half, 2 * h, 1);
  const double turning = (mu * h - half) / tower.body.inertia(1, 1), stop = slip / (mu + h * turning);
  for (const double sense : {1.0, -1.0}) {
    const GroupImpact struck =
        landing_of(tower, coulomb(e, mu), {sense * slip, 0, -1}, Vector3::Zero()).impact();
    BOOST_TEST(std::fabs(struck.angular_velocity_after.y() - sense * turning * stop) <= 10 * tolerance);
    BOOST_TEST(std::fabs(struck.velocity_after.x() - sense * (slip - mu * stop)) <= tolerance);
    BOOST_TEST(std::fabs(struck.velocity_after.z() - half * turning * stop - e) <= tolerance);  // of the front edge
    BOOST_TEST(std::fabs(struck.velocity_after.y()) + std::fabs(struck.angular_velocity_after.x()) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_flat_landing_in_the_plane_of_a_box_is_that_of_the_planar_model_wherever_the_ground_pushes) {
  constexpr double tolerance = 2e-12;
  Random random(4);
  int tilting = 0;
  for (int i = 0; i < 600; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 3), random.uniform(0.2, 3));
    const PlanarBody body{.mass = box.body.mass,
                          .gyration_square = (box.length * box.length + box.height * box.height) / 12};
    const PlanarVelocity v{-1, i % 7 == 0 ? 0 : random.uniform(-1, 1), random.uniform(-1, 1)};
    Law law = coulomb(random.uniform(0, 1), i % 5 == 0 ? 0 : random.uniform(0, 1.5));
    if (i % 5 == 0) law.law.friction = FrictionKind::none;
    const auto planar = strike_flat(body, v, {-box.length / 2, -box.height / 2}, {box.length / 2, -box.height / 2},
                                    law.law);
    if (!planar) continue;
    tilting += planar->tilts;
    const GroupImpact struck =
        landing_of(box, law, {v.tangential, 0, v.normal}, {0, v.angular, 0}).impact();
    BOOST_TEST_CONTEXT(i) {
      BOOST_TEST(std::fabs(struck.velocity_after.x() - planar->after.tangential) <= tolerance);
      BOOST_TEST(std::fabs(struck.velocity_after.z() - planar->after.normal) <= tolerance);
      BOOST_TEST(std::fabs(struck.angular_velocity_after.y() - planar->after.angular) <= 20 * tolerance);
      BOOST_TEST(std::fabs(struck.energy_loss - planar->energy_loss) <= 10 * tolerance);
    }
  }
  BOOST_TEST(tilting > 100);
}

/// The oracle tries all sets of corners that might push.
BOOST_AUTO_TEST_CASE(without_friction_a_face_gets_the_least_change_of_velocity_that_lifts_each_corner_by_its_law) {
  constexpr double tolerance = 1e-11;
  Random random(5);
  int nearest = 0;
  for (int i = 0; i < 300; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 3), 1);
    const double e = random.uniform(0, 1);
    Vector3 spin = random.vector(1) * 2;
    spin.z() = 0;
    const Landing l = landing_of(box, frictionless(e), {0, 0, -1}, spin);
    const auto rise = [&](const Vector3& v, const Vector3& w, std::size_t k) {
      return normal_velocity(v, w, box.bottom[k].place);
    };
    bool all = true;
    for (std::size_t k = 0; k < 4; ++k) all = all && rise(l.before.velocity, spin, k) < 0;
    if (!all) continue;
    double least = 1e9;
    Vector3 best = Vector3::Zero();  // V_z, ω_x, ω_y
    for (unsigned set = 1; set < 15; ++set) {
      std::vector<std::size_t> pushing;
      for (std::size_t k = 0; k < 4; ++k) {
        if (set >> k & 1) pushing.push_back(k);
      }
      if (pushing.size() > 3) continue;
      const auto count = static_cast<Eigen::Index>(pushing.size());
      Eigen::MatrixXd lift(3, count);
      Eigen::VectorXd wanted(count);
      for (Eigen::Index c = 0; c < count; ++c) {
        const std::size_t k = pushing[static_cast<std::size_t>(c)];
        lift.col(c) << 1, box.bottom[k].place.y(), -box.bottom[k].place.x();
        wanted[c] = -(1 + e) * rise(l.before.velocity, spin, k);
      }
      const Vector3 mobility(1, 1 / box.body.inertia(0, 0), 1 / box.body.inertia(1, 1));
      const Eigen::MatrixXd g = lift.transpose() * mobility.asDiagonal() * lift;
      const Eigen::VectorXd p = g.colPivHouseholderQr().solve(wanted);
      const Vector3 change = mobility.asDiagonal() * (lift * p);
      bool valid = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const double before = rise(l.before.velocity, spin, k);
        valid = valid && before + change.dot(Vector3(1, box.bottom[k].place.y(), -box.bottom[k].place.x())) >=
                             -e * before - 1e-12;
      }
      const double size = change.cwiseAbs2().cwiseQuotient(mobility).sum();
      if (valid && size < least) least = size, best = change;
    }
    const GroupImpact struck = l.impact();
    BOOST_TEST_CONTEXT(i) {
      BOOST_TEST(std::fabs(struck.velocity_after.z() - (best[0] - 1)) <= tolerance);
      BOOST_TEST((struck.angular_velocity_after.head<2>() - spin.head<2>() - best.tail<2>()).norm() <= 20 * tolerance);
    }
    nearest += !struck.is_whole;
  }
  BOOST_TEST(nearest > 50);
}

/// From nothing to 1 m/s of slip and half of that of spin, in steps by which no answer may jump.
BOOST_AUTO_TEST_CASE(landings_change_in_proportion_to_slip_and_spin_and_are_mirrored_by_mirrors) {
  constexpr double rounding = 1e-12, most_per_kick = 300, mirror_tolerance = 1e-9;
  constexpr int landings = CLATTER_TEST_SLOW_BUILD ? 20 : 100;
  Random random(6);
  for (int i = 0; i < landings; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 3), 1);
    const Landing still = random_landing(random, i % 3 == 2, box);
    const double reach = Vector3(box.length, box.width, box.height).norm() / 2;
    Vector3 slide = random.vector(1), spin = random.vector(0.5 / reach);
    slide.z() = 0;
    if (i % 2 == 0) spin.head<2>().setZero();
    const Motion at_rest = still.after(reach);
    BOOST_TEST_CONTEXT(i) {
      for (const double kick : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.03, 0.2, 1.0}) {
        Landing kicked = still;
        kicked.before.velocity += kick * slide;
        kicked.before.angular_velocity += kick * spin;
        const Motion after = kicked.after(reach);
        BOOST_TEST((after - at_rest).norm() <= rounding + most_per_kick * kick);
        BOOST_TEST((mirrored(mirrored(kicked).after(reach)) - after).norm() <= mirror_tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(level_landings_by_stronges_and_poissons_laws_gain_no_energy) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const FlatBox box(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 3), 1);
    Landing l = random_landing(random, i % 2 == 0, box);
    l.law.law.law = i % 4 < 2 ? RestitutionLaw::stronge : RestitutionLaw::poisson;
    l.before.velocity += Vector3(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    l.before.angular_velocity = random.vector(0.7);
    const Vector3 spin = l.before.attitude.conjugate() * l.before.angular_velocity;
    const double energy = (l.before.velocity.squaredNorm() + spin.dot(l.body.inertia * spin)) / 2;
    const GroupImpact struck = l.impact();
    BOOST_TEST(struck.energy_loss >= -1e-12 * energy);
    for (const Corner& corner : l.touching) {
      BOOST_TEST(normal_velocity(struck.velocity_after, struck.angular_velocity_after,
                                 l.before.attitude * corner.place) >= -1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(tall_faces_on_which_slip_spirals_or_holds_against_much_friction_rebound_as_a_whole) {
  constexpr double tolerance = 1e-5;
  const Vector3 centre(-0.00501888, -0.00274527, -0.00766566);
  Landing spiral = landing_of(FlatBox(0.0479805, 0.0645238, 0.173962, 1.89607), coulomb(0.413, 0.762),
                              {-0.3285, 0, -0.7446}, {-5.819, 9.295, -41.47});
  spiral.body.inertia << 0.00391973, 3.22889e-05, 0.000884811, 3.22889e-05, 0.00406159, -0.000107616, 0.000884811,
      -0.000107616, 0.00103071;
  for (Corner& corner : spiral.touching) corner.place -= centre;
  spiral.before.attitude = Quaternion(-0.5423779736709029, 0, 0, 0.8401345925961181).normalized();
  const GroupImpact spun = spiral.impact();
  BOOST_TEST(spun.is_whole);
  BOOST_TEST((spun.velocity_after - Vector3(0.02655, 0.21052, 0.30752)).norm() <= tolerance * 2);
  BOOST_TEST(std::fabs(spun.angular_velocity_after.z() + 20.969) <= 1e-3);
  Landing held = landing_of(FlatBox(0.545944, 0.455393, 0.424524, 19.3784), coulomb(0.523, 1.38),
                            {0.7704, 0, -1.011}, {0, 0, 0.1893});
  held.before.attitude = Quaternion(0.1566730109646018, 0, 0, 0.9876505291019115).normalized();
  const GroupImpact stopped = held.impact();
  BOOST_TEST((stopped.velocity_after - Vector3(0, 0, 0.528753)).norm() <= 1e-12);
  BOOST_TEST(stopped.angular_velocity_after.norm() <= 1e-12);
}
