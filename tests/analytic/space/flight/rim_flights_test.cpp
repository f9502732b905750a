// SPDX-License-Identifier: GPL-3.0-or-later
// Flights of rods and discs against the closed form of a symmetric top, scanned densely.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "analytic/base/errors.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "validation/oracles/free_top.hpp"

namespace {

using clatter::analytic::FrictionKind;
using clatter::analytic::Outcome;
using clatter::analytic::RestitutionLaw;
using namespace clatter::analytic::space;
using clatter::oracle::Random;
using clatter::oracle::Top;
using clatter::oracle::TopSeries;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

constexpr double largest_turn_of_a_hop = 0.099;  // [rad], of the axis about the momentum
constexpr int scenes = CLATTER_TEST_SLOW_BUILD ? 40 : 300;

struct Disc {
  double mass, length, radius;
};

struct Scene {
  Disc disc;
  Drop drop;
};

Scene random_scene(Random& random) {
  const double radius = std::exp2(random.uniform(-3, 1));
  Scene s{.disc = {random.uniform(0.1, 3), 2 * radius * std::pow(10, random.uniform(-2, 2)), radius}, .drop = {}};
  Drop& d = s.drop;
  d.body = cylinder(s.disc.mass, {.length = s.disc.length, .radius = radius});
  d.attitude = random.attitude();
  if (random.whole(1, 4) == 1) {  // almost level
    const double tilt = std::pow(10, random.uniform(-8, -1));
    d.attitude = Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitZ()) *
                 Eigen::AngleAxisd(tilt - std::numbers::pi / 2, Vector3::UnitY()) *
                 Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitX());
  }
  d.velocity = random.vector(1) - Vector3(0, 0, 1);
  d.angular_velocity = std::pow(10, random.uniform(-2, 1)) / d.body.reach() * random.vector(1);
  d.gravity = random.whole(1, 5) == 1 ? 0 : 9.81;
  d.law.law = static_cast<RestitutionLaw>(random.whole(0, 2));
  d.law.restitution = random.uniform(0.02, 1);
  if (random.whole(1, 3) > 1) d.law.friction = FrictionKind::coulomb, d.law.friction_value = random.uniform(0, 1);
  return s;
}

/// Heights of both rims after an impact: the axis n of a free symmetric top circles the momentum L at |L|/I₁, and the
/// lowest point of the rim at ±L/2 is z ± (L/2) n_z − R √(n_x² + n_y²) above the ground.
template <class Number>
class RimHeights {
 public:
  RimHeights(const Disc& disc, const ImpactRow& row, double gravity, bool hop) : disc_(disc), gravity_(gravity) {
    using Vector = Eigen::Matrix<Number, 3, 1>;
    const auto wide = [](const Vector3& v) { return Vector(Number(v[0]), Number(v[1]), Number(v[2])); };
    const Quaternion& q = row.before.attitude;
    const Number w = q.w(), x = q.x(), y = q.y(), z = q.z(), norm = w * w + x * x + y * y + z * z;
    const Vector axis((w * w + x * x - y * y - z * z) / norm, 2 * (x * y + w * z) / norm, 2 * (x * z - w * y) / norm);
    const Vector spin = wide(row.impact.angular_velocity_after);
    const Number r = disc.radius, l = disc.length, m = disc.mass;
    const Number along = m * r * r / 2, across = m * (3 * r * r + l * l) / 12;
    const Vector momentum = across * spin + (along - across) * spin.dot(axis) * axis;
    using std::sqrt;
    const Number size = sqrt(momentum.dot(momentum));
    rate_ = size / across;
    n_ = axis;
    first_ = size > 0 ? Vector(momentum.cross(axis) / size) : Vector(Vector::Zero());
    second_ = size > 0 ? Vector(momentum.cross(first_) / size) : Vector(Vector::Zero());
    z_ = 0;
    const Corner& corner = row.corners.front();
    z_ = -height(corner.index, 0);
    // In a small hop the point's own speed counts, of which rounding of the centre's leaves fewer digits.
    speed_ = 0;
    speed_ = hop && corner.radius == 0 ? Number(row.impact.contact_after.z()) - velocity(corner.index, 0)
                                       : Number(row.impact.velocity_after.z());
  }

  /// Angle that the axis has circled [rad].
  [[nodiscard]] Number turn(Number t) const { return rate_ * t; }
  [[nodiscard]] Number height(int rim, Number t) const {
    using std::sqrt;
    const auto n = axis(t).n;
    return z_ + t * (speed_ - gravity_ / 2 * t) + side(rim) * n[2] - disc_.radius * sqrt(n[0] * n[0] + n[1] * n[1]);
  }
  [[nodiscard]] Number velocity(int rim, Number t) const {
    using std::sqrt;
    const auto [n, rate] = axis(t);
    return speed_ - gravity_ * t + side(rim) * rate[2] -
           disc_.radius * (n[0] * rate[0] + n[1] * rate[1]) / sqrt(n[0] * n[0] + n[1] * n[1]);
  }

 private:
  struct Axis {
    Eigen::Matrix<Number, 3, 1> n, rate;
  };
  [[nodiscard]] Number side(int rim) const { return (rim == 0 ? -disc_.length : disc_.length) / 2; }
  [[nodiscard]] Axis axis(Number t) const {
    using std::cos, std::sin;
    const Number a = rate_ * t, s = sin(a), c = cos(a), half = sin(a / 2);
    return {n_ + s * first_ + 2 * half * half * second_, rate_ * (c * first_ + s * second_)};
  }

  Disc disc_;
  double gravity_;
  Eigen::Matrix<Number, 3, 1> n_, first_, second_;
  Number rate_ = 0, z_ = 0, speed_ = 0;
};

/// Lowest height of either rim strictly within (0, end), from samples with each dip refined.
long double lowest(const RimHeights<long double>& h, double end, double reach) {
  const int count = 300 + static_cast<int>(std::fmin(60 * static_cast<double>(h.turn(end)), 50000.0));
  long double least = 1e9L;
  for (int rim = 0; rim < 2; ++rim) {
    const auto at = [&](int i) -> long double {  // denser at both ends
      return end * (i < count / 4       ? std::pow(0.25L, static_cast<long double>(count / 4 - i) / 8) / 4
                    : i > 3 * count / 4 ? 1 - std::pow(0.25L, static_cast<long double>(i - 3 * count / 4) / 8) / 4
                                        : static_cast<long double>(i) / count);
    };
    for (int i = 1; i < count; ++i) {
      long double a = at(i - 1), m = at(i), b = at(i + 1);
      const long double middle = h.height(rim, m);
      least = std::fmin(least, middle);
      if (!(middle < 0.05L * reach) || middle > h.height(rim, a) || middle > h.height(rim, b)) continue;
      for (int k = 0; k < 80; ++k) {
        const long double p = a + (b - a) / 3, q = b - (b - a) / 3;
        (h.height(rim, p) < h.height(rim, q) ? b : a) = h.height(rim, p) < h.height(rim, q) ? q : p;
      }
      if (a < end * (1 - 1e-9L)) least = std::fmin(least, h.height(rim, a));
    }
  }
  return least;
}

struct Counts {
  int flights = 0, below = 0, gains = 0, late = 0, hops = 0, rough_hops = 0;
  double worst_hop = 0;
};

/// The flight from one row to the next.
void check(const Scene& s, const ImpactRow& from, const ImpactRow& to, Counts& counts) {
  const double t = to.flight.time, reach = s.drop.body.reach();
  if (from.corners.size() > 1 || from.corners[0].radius > 0 || !(t > 0)) return;
  ++counts.flights;
  if (!(to.energy_before - from.energy_after <= 1e-12 * from.energy_after)) ++counts.gains;
  const double turning = from.impact.angular_velocity_after.norm();
  const Vector3 axis = from.before.attitude * Vector3::UnitX();
  // The attitude's rounding turns the lowest point of a rim by that over its tilt.
  const double tilt = Vector3::UnitZ().cross(axis).norm();
  const double turned = 1 + s.disc.radius * turning * t / (tilt * reach);
  const double rate = RimHeights<double>(s.disc, from, s.drop.gravity, false).turn(1);
  const bool hop = t * rate < largest_turn_of_a_hop;
  const RimHeights<long double> h(s.disc, from, s.drop.gravity, hop);
  if (!(lowest(h, t, reach) >= -(1e-12 + 1e-14 * turned) * reach)) ++counts.below;
  if (to.corners[0].radius > 0) return;
  const RimHeights<Wide> exact(s.disc, from, s.drop.gravity, hop);
  const int rim = to.corners[0].index;
  const double velocity = static_cast<double>(exact.velocity(rim, t));
  const double off = std::fabs(static_cast<double>(exact.height(rim, t)) / velocity);
  const double speed = from.impact.velocity_after.norm() + s.drop.gravity * t + reach * turning;
  if (!(off <= 1e-14 * (t * speed + reach) * turned / std::fabs(velocity))) ++counts.late;
  if (!(hop && rim == from.corners[0].index && velocity > -1e-2 * speed)) return;
  ++counts.hops;
  // Rounding of ω counts beside its part across the axis, which alone moves the rims, and that of the parts of h″
  // beside what they leave for the hop.
  const double departure = from.impact.contact_after.z();
  const double condition = (1 + std::fabs(departure / velocity)) / tilt * turning /
                           axis.cross(from.impact.angular_velocity_after).norm() *
                           (1 + reach * rate * rate * t / (2 * departure));
  double error = off / t / condition;
  // Faster arrivals near level take the velocity of the place, which the attitude's rounding turns.
  if (std::fabs(velocity) < tilt * speed)
    error = std::fmax(error, std::fabs(to.impact.approach_speed / velocity + 1) / condition);
  counts.worst_hop = std::fmax(counts.worst_hop, error);
  if (!(error <= 2e-14)) ++counts.rough_hops;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_flight_of_a_rod_or_disc_goes_below_the_ground_gains_energy_or_misses_its_contact) {
  Random random(15);  // a draw of which three flights go below the ground with too low a bound of a rim's bends
  Counts counts;
  int stopped = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scene s = random_scene(random);
    Sequence sequence;
    try {
      sequence = impact_sequence(s.drop, {.impacts = 12, .amplification = false});
    } catch (const std::exception&) {  // it rises at the first contact
      continue;
    }
    if (sequence.outcome == Outcome::not_computed) {
      ++stopped;
      BOOST_TEST_MESSAGE("scene " << i << ": " << sequence.message);
    }
    Counts before = counts;
    for (std::size_t k = 1; k < sequence.rows.size(); ++k) {
      check(s, sequence.rows[k - 1], sequence.rows[k], counts);
      if (counts.below + counts.gains + counts.late + counts.rough_hops >
          before.below + before.gains + before.late + before.rough_hops) {
        BOOST_TEST_MESSAGE("scene " << i << " row " << k + 1 << ": below " << counts.below << " gains " << counts.gains
                                    << " late " << counts.late << " rough " << counts.rough_hops);
        before = counts;
      }
    }
  }
  BOOST_TEST_MESSAGE(counts.flights << " flights: " << counts.below << " below ground, " << counts.gains
                                    << " gain energy, " << counts.late << " without a root, " << counts.rough_hops
                                    << " of " << counts.hops << " hops rough, worst " << counts.worst_hop << "; "
                                    << stopped << " sequences not computed");
  BOOST_TEST(counts.below == 0);
  BOOST_TEST(counts.gains == 0);
  BOOST_TEST(counts.late == 0);
  BOOST_TEST(counts.rough_hops == 0);
  BOOST_TEST(stopped == 0);
  BOOST_TEST(counts.flights > 5 * scenes);
  BOOST_TEST(counts.hops > scenes);
}

/// A round body whose inertia differs across its axis and whose mass lies beside it: a tube with a strip of lead.
Scene lopsided_scene(Random& random) {
  Scene s = random_scene(random);
  Matrix3& inertia = s.drop.body.inertia;
  const double along = inertia(0, 0), across = inertia(1, 1);
  inertia(2, 2) = std::fmax(random.uniform(across - 0.98 * along, across), 1.02 * (along - across));
  const Vector3 size(s.disc.length / 2, s.disc.radius, s.disc.radius);
  const Vector3 centre = 0.3 * random.vector(1).cwiseProduct(size);
  for (Rim& rim : s.drop.body.rims) rim.centre -= centre;
  return s;
}

/// Height of a rim's lowest point at the end of a flight that starts as `row` ends, by Taylor series of Euler's
/// equations; `lowest` becomes the least height of either rim on the way.
long double flown_height(const Scene& s, const ImpactRow& row, double time, int rim, long double& lowest) {
  const Body& body = s.drop.body;
  const State from = state_after(row);
  const Quaternion& q = from.attitude;
  const Vector3 w = q.conjugate() * from.angular_velocity;
  Top<long double> top;
  top.q = {q.w(), q.x(), q.y(), q.z()};
  for (std::size_t k = 0; k < 3; ++k) {
    top.w[k] = w[static_cast<int>(k)];
    top.moments[k] = body.inertia(static_cast<int>(k), static_cast<int>(k));
  }
  const double fastest = (body.inertia * w).norm() / body.inertia.diagonal().minCoeff();
  const int steps = 1 + static_cast<int>(3 * fastest * time), parts = 24;
  TopSeries<long double> series(24);
  const long double part = static_cast<long double>(time) / steps / parts;
  long double height = 0;
  for (int i = 0; i < steps * parts; ++i) {
    if (i % parts == 0) {
      if (i > 0) series.evaluate(top, part * parts);
      series.expand(top);
    }
    Top<long double> then = top;
    series.evaluate(then, part * (i % parts + 1));
    const Eigen::Quaternion<long double> turn(then.q[0], then.q[1], then.q[2], then.q[3]);
    const Eigen::Matrix<long double, 3, 1> up =
        turn.normalized().conjugate() * Eigen::Matrix<long double, 3, 1>(0, 0, 1);
    const long double t = part * (i + 1),
                      centre = row.before.position.z() + t * (from.velocity.z() - s.drop.gravity / 2 * t);
    for (int k = 0; k < 2; ++k) {
      const Rim& one = body.rims[k];
      const long double at = centre + up.dot(one.centre.cast<long double>()) - one.radius * std::hypot(up[1], up[2]);
      if (i + 1 < steps * parts) lowest = std::fmin(lowest, at);
      if (k == rim) height = at;
    }
  }
  return height;
}

BOOST_AUTO_TEST_CASE(no_flight_of_a_lopsided_rod_or_disc_goes_below_the_ground_gains_energy_or_misses_its_contact) {
  Random random(31);
  int flights = 0;
  for (int i = 0; i < scenes; ++i) {
    const Scene s = lopsided_scene(random);
    BOOST_TEST(!s.drop.body.transverse_moment());
    Sequence sequence;
    try {
      sequence = impact_sequence(s.drop, {.impacts = 5, .amplification = false});
    } catch (const std::domain_error&) {  // it rises at the first contact
      continue;
    }
    BOOST_TEST((sequence.outcome != Outcome::not_computed), sequence.message);
    const double reach = s.drop.body.reach();
    for (std::size_t k = 1; k < sequence.rows.size(); ++k) {
      const ImpactRow &from = sequence.rows[k - 1], &to = sequence.rows[k];
      if (from.corners[0].radius > 0 || to.corners[0].radius > 0 || !(to.flight.time > 0)) continue;
      ++flights;
      const double t = to.flight.time, turned = from.impact.angular_velocity_after.norm() * t;
      const double size = 1e-14 * (reach * (1 + turned) + t * from.impact.velocity_after.norm());
      long double lowest = 0;
      const long double height = flown_height(s, from, t, to.corners[0].index, lowest);
      BOOST_TEST_CONTEXT("scene " << i << ", flight " << k) {
        BOOST_TEST(std::fabs(height) <= 2 * size);
        BOOST_TEST(lowest >= -1e-12L * reach);
        BOOST_TEST(to.energy_before - from.energy_after <= 1e-12 * from.energy_after);
      }
    }
  }
  BOOST_TEST(flights > scenes);
}
