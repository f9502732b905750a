// SPDX-License-Identifier: GPL-3.0-or-later
// Balls, ellipsoids and capsules: closed forms of a bouncing ball, and flights against Taylor series scanned densely.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "analytic/space/impulse/impact.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"

namespace {

using clatter::analytic::FrictionKind;
using clatter::analytic::Outcome;
using clatter::analytic::RestitutionLaw;
using namespace clatter::analytic::space;
using clatter::oracle::Random;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

constexpr int scenes = CLATTER_TEST_SLOW_BUILD ? 40 : 300;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Body random_body(Random& random) {
  const double mass = random.uniform(0.1, 3), size = std::exp2(random.uniform(-4, 2));
  const int kind = random.whole(0, 4);
  Body body = kind == 0 ? capsule(mass, {.length = size * random.uniform(2.01, 9), .radius = size})
                        : ellipsoid(mass, size * (kind == 1 ? Vector3::Ones()
                                                            : Vector3(std::exp2(random.uniform(-3, 0)), 1,
                                                                      kind == 2 ? 1 : random.uniform(0.2, 1))));
  if (random.whole(1, 3) > 1) return body;
  const Vector3 off = 0.3 * size * random.vector(0.5);  // the mass lies elsewhere
  for (Ellipsoid& part : body.ellipsoids) part.centre -= off;
  return body;
}

Drop random_drop(Random& random) {
  Drop d{.body = random_body(random), .law = {}};
  d.attitude = random.attitude();
  d.velocity = random.vector(1) - Vector3(0, 0, 1);
  d.angular_velocity = std::pow(10, random.uniform(-2, 1)) / d.body.reach() * random.vector(1);
  d.gravity = random.whole(1, 5) == 1 ? 0 : 9.81;
  d.law.law = static_cast<RestitutionLaw>(random.whole(0, 2));
  d.law.restitution = random.uniform(0.02, 1);
  if (random.whole(1, 3) > 1) {
    d.law.friction = FrictionKind::coulomb;
    d.law.friction_value = random.uniform(0, 1);
  }
  return d;
}

/// Heights after an impact, from Euler's equations and e′ = e × ω alone: Taylor series, step by step.
template <class Real>
class Heights {
 public:
  using Vector = Eigen::Matrix<Real, 3, 1>;

  Heights(const Body& body, const ImpactRow& row, double gravity, double end)
      : body_(body), inertia_(body.inertia.template cast<Real>()), gravity_(gravity) {
    const Eigen::Quaternion<Real> q = row.before.attitude.template cast<Real>().normalized();
    Vector e = q.conjugate() * Vector(Vector::UnitZ());
    Vector w = q.conjugate() * Vector(row.impact.angular_velocity_after.template cast<Real>());
    length_ = std::fmin(end, 0.1 / static_cast<double>(w.norm()));  // end, without a turn
    for (double t = 0; t < end; t += length_) {
      add_step(e, w);
      e = sum(steps_.back(), Real(length_));
      w = sum(rates_, Real(length_));
    }
    z_ = -height(row.corners.front().index, 0);
    speed_ = 0;
    // The point's own speed counts in a small hop, of which rounding of the centre's leaves fewer digits.
    speed_ = row.impact.contact_after.z() - velocity(row.corners.front().index, 0);
  }

  [[nodiscard]] Real height(int part, Real t) const {
    return z_ + t * (speed_ - gravity_ / 2 * t) + support(part, vertical(t));
  }
  [[nodiscard]] Real velocity(int part, Real t) const {
    const auto& [c, axes] = body_.ellipsoids[part];
    const Vector e = vertical(t), rate = slope(t), d = axes.template cast<Real>();
    const Vector v = d.cwiseProduct(e);
    return speed_ - gravity_ * t + rate.dot(c.template cast<Real>()) - v.dot(d.cwiseProduct(rate)) / v.norm();
  }
  [[nodiscard]] int samples() const { return 16 * static_cast<int>(steps_.size()) + 200; }

 private:
  static constexpr std::size_t terms = 22;
  using Series = std::array<Vector, terms>;

  [[nodiscard]] Real support(int part, const Vector& e) const {
    const auto& [c, axes] = body_.ellipsoids[part];
    return e.dot(c.template cast<Real>()) - axes.template cast<Real>().cwiseProduct(e).norm();
  }
  static Vector sum(const Series& series, Real t) {
    Vector value = Vector::Zero();
    for (std::size_t k = terms; k-- > 0;) value = (value * t + series[k]).eval();
    return value;
  }
  void add_step(const Vector& e, const Vector& w) {
    Series es, ws, momenta;
    es[0] = e, ws[0] = w, momenta[0] = inertia_ * w;
    const Eigen::Matrix<Real, 3, 3> inverse = inertia_.inverse();
    for (std::size_t n = 0; n + 1 < terms; ++n) {
      Vector turn = Vector::Zero(), torque = Vector::Zero();
      for (std::size_t k = 0; k <= n; ++k) {
        turn += es[k].cross(ws[n - k]);
        torque += momenta[k].cross(ws[n - k]);
      }
      es[n + 1] = turn / Real(n + 1);
      momenta[n + 1] = torque / Real(n + 1);
      ws[n + 1] = inverse * momenta[n + 1];
    }
    steps_.push_back(es);
    rates_ = ws;
  }
  [[nodiscard]] std::pair<const Series&, Real> step(Real t) const {
    const std::size_t i = std::min(static_cast<std::size_t>(static_cast<double>(t) / length_), steps_.size() - 1);
    return {steps_[i], t - Real(length_) * Real(i)};
  }
  [[nodiscard]] Vector vertical(Real t) const {
    const auto [series, s] = step(t);
    return sum(series, s);
  }
  [[nodiscard]] Vector slope(Real t) const {
    const auto [series, s] = step(t);
    Vector value = Vector::Zero();
    for (std::size_t k = terms; k-- > 1;) value = (value * s + Real(k) * series[k]).eval();
    return value;
  }

  const Body& body_;
  Eigen::Matrix<Real, 3, 3> inertia_;
  double length_ = 1;
  Real gravity_, z_ = 0, speed_ = 0;
  std::vector<Series> steps_;
  Series rates_;
};

/// Lowest height of any part strictly within (0, end), each dip refined.
long double lowest(const Heights<long double>& h, int parts, long double end, double reach) {
  const int count = h.samples();
  long double least = 1e9L;
  for (int part = 0; part < parts; ++part) {
    const auto at = [&](int i) { return end * i / count; };
    for (int i = 1; i < count; ++i) {
      long double a = at(i - 1), b = at(i + 1);
      const long double middle = h.height(part, at(i));
      least = std::fmin(least, middle);
      if (!(middle < 0.05L * reach) || middle > h.height(part, a) || middle > h.height(part, b)) continue;
      for (int k = 0; k < 80; ++k) {
        const long double p = a + (b - a) / 3, q = b - (b - a) / 3;
        (h.height(part, p) < h.height(part, q) ? b : a) = h.height(part, p) < h.height(part, q) ? q : p;
      }
      if (a < end * (1 - 1e-9L)) least = std::fmin(least, h.height(part, a));
    }
  }
  return least;
}

struct Counts {
  int flights = 0, hops = 0;
  double worst_late = 0, worst_hop = 0;
};

/// The flight from one row to the next.
void check(const Drop& drop, const ImpactRow& from, const ImpactRow& to, Counts& counts) {
  const double t = to.flight.time, reach = drop.body.reach();
  if (from.group || to.group || !(t > 0)) return;
  ++counts.flights;
  const double gain = to.energy_before - from.energy_after;
  BOOST_TEST(gain <= 1e-12 * from.energy_after);
  const Heights<long double> h(drop.body, from, drop.gravity, t);
  BOOST_TEST(lowest(h, drop.body.points(), t, reach) >= -1e-12L * reach);
  const int part = to.corners[0].index;
  const double velocity = static_cast<double>(h.velocity(part, t));
  const double off = std::fabs(static_cast<double>(h.height(part, t)) / velocity);
  const double turning = from.impact.angular_velocity_after.norm();
  const double speed = from.impact.velocity_after.norm() + drop.gravity * t + reach * turning;
  // Rounding of the attitude and of the velocity, in the flight's time, over the normal velocity.
  const double bound = epsilon * (1 + turning * t) * (t * speed + reach) / std::fabs(velocity);
  counts.worst_late = std::fmax(counts.worst_late, off / bound);
  if (!to.flight.is_hop || part != from.corners[0].index) return;
  ++counts.hops;
  // Rounding of an ellipsoid's attitude turns its lowest point, by the ratio of its axes at most.
  const Vector3& axes = drop.body.ellipsoids[part].semiaxes;
  const double turned = axes.maxCoeff() / axes.minCoeff();
  const Heights<Wide> wide(drop.body, from, drop.gravity, t);
  const double arrival = static_cast<double>(wide.velocity(part, t));
  const double rough = std::fabs(static_cast<double>(wide.height(part, t)) / (t * arrival));
  counts.worst_hop =
      std::fmax(counts.worst_hop, rough / (turned * (1 + std::fabs(from.impact.contact_after.z() / arrival))));
}

Drop ball_drop(double restitution, double friction) {
  Drop d{.body = ellipsoid(2, Vector3::Constant(0.3)), .law = {}};
  d.velocity = {1, 0, -2};
  d.gravity = 9.81;
  d.law.restitution = restitution;
  d.law.friction = FrictionKind::coulomb;
  d.law.friction_value = friction;
  return d;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_flight_of_a_round_body_goes_below_the_ground_gains_energy_or_misses_its_contact) {
  Random random(71);
  Counts counts;
  for (int i = 0; i < scenes; ++i) {
    const Drop drop = random_drop(random);
    Sequence sequence;
    try {
      sequence = impact_sequence(drop, {.impacts = 12, .amplification = false});
    } catch (const std::domain_error&) {  // it rises at the first contact
      continue;
    }
    BOOST_TEST_CONTEXT("scene " << i) {
      BOOST_TEST((sequence.outcome != Outcome::not_computed), sequence.message);
      for (std::size_t k = 1; k < sequence.rows.size(); ++k) {
        BOOST_TEST_CONTEXT("row " << k + 1) { check(drop, sequence.rows[k - 1], sequence.rows[k], counts); }
      }
    }
  }
  BOOST_TEST_MESSAGE(counts.flights << " flights, " << counts.hops << " hops, times within " << counts.worst_late
                                    << " epsilon x condition, of hops relatively within " << counts.worst_hop);
  BOOST_TEST(counts.worst_hop <= 1e-13);
  BOOST_TEST(counts.worst_late <= 64);
  BOOST_TEST(counts.flights > 5 * scenes);
  BOOST_TEST(counts.hops > scenes);
}

BOOST_AUTO_TEST_CASE(a_ball_slips_by_coulombs_law_or_leaves_without_slip_by_the_law_of_two_sevenths) {
  for (const double friction : {0.02, 0.1, 0.3, 2.0}) {
    for (const double spin : {-20.0, 0.0, 4.0, 30.0}) {
      Drop d = ball_drop(0.8, friction);
      d.attitude = Quaternion(0.5, -0.1, 0.7, 0.3).normalized();
      d.angular_velocity = {0, spin, 3};
      const Impact impact = impact_sequence(d, {.impacts = 1}).rows.at(0).impact;
      const double r = 0.3, slip = 1 - r * spin, push = 1.8 * 2;  // of the lowest point; (1 + e) u
      const double stop = 2 * std::fabs(slip) / 7;                // the change that ends it
      const double change = -std::copysign(std::fmin(stop, friction * push), slip);
      const Vector3& v = impact.velocity_after;
      BOOST_TEST((v - Vector3(1 + change, 0, 1.6)).norm() <= 8 * epsilon * 3);
      const double turned = spin - 5 * change / (2 * r);
      BOOST_TEST((impact.angular_velocity_after - Vector3(0, turned, 3)).norm() <= 8 * epsilon * (30 + 10));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_ball_bounces_in_geometric_series_and_rolls_on_however_it_is_turned) {
  for (const double e : {0.3, 0.9}) {
    Drop d = ball_drop(e, 0.5);
    d.attitude = Quaternion(0.5, -0.1, 0.7, 0.3).normalized();
    const Sequence thrown = impact_sequence(d, {.impacts = 200, .digits = 12});
    BOOST_TEST_REQUIRE((thrown.outcome == Outcome::sustained_contact), thrown.message);
    const double end = 2 * e * 2 / (9.81 * (1 - e)), total = 2 * 2 * (1 + e) / (1 - e);
    BOOST_TEST_REQUIRE(thrown.tail.has_value());
    BOOST_TEST(std::fabs(thrown.tail->end_time - end) <= thrown.tail->end_time_error);
    BOOST_TEST(thrown.tail->end_time_error <= 1e-11 * end);
    BOOST_TEST(std::fabs(thrown.total_normal_impulse - total) <= 1e-11 * total);
    BOOST_TEST((thrown.rows.back().impact.path == PathKind::stick));
    BOOST_TEST(thrown.message.find("without slip") != std::string::npos);
    BOOST_TEST((thrown.tail->velocity_after - Vector3(5. / 7, 0, 0)).norm() <= 1e-14);
    d.velocity.x() = 0;
    Drop slides = ball_drop(e, 0);
    slides.law.friction = FrictionKind::none;
    for (const Drop& other : {d, slides}) {
      const Sequence rest = impact_sequence(other, {.impacts = 10000});
      BOOST_TEST_REQUIRE((rest.outcome == Outcome::at_rest), rest.message);
      BOOST_TEST(std::fabs(rest.tail->end_time - end) <= 1e-12 * end);
    }
  }
  Drop plastic = ball_drop(0, 0.5);
  const Sequence stays = impact_sequence(plastic, {.impacts = 5});
  BOOST_TEST(stays.rows.size() == 1);
  BOOST_TEST((stays.outcome == Outcome::sustained_contact));
}

BOOST_AUTO_TEST_CASE(an_elastic_ball_hops_with_equal_times_and_keeps_its_energy) {
  Drop d = ball_drop(1, 0);
  d.law.friction = FrictionKind::none;
  d.angular_velocity = {3, -40, 7};
  const Sequence sequence = impact_sequence(d, {.impacts = 50});
  BOOST_TEST_REQUIRE(sequence.rows.size() == 50);
  for (std::size_t k = 1; k < 50; ++k) {
    const ImpactRow& row = sequence.rows[k];
    BOOST_TEST(std::fabs(row.flight.time - 4 / 9.81) <= 256 * epsilon);
    BOOST_TEST(std::fabs(row.energy_after - sequence.rows[0].energy_before) <= 1e-13 * row.energy_after);
    BOOST_TEST((row.impact.angular_velocity_after - d.angular_velocity).norm() <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_level_capsule_lands_on_its_side_as_an_edge_and_rolls_on_it) {
  Drop d{.body = capsule(2, {.length = 1, .radius = 0.1}), .law = {}};
  d.velocity = {0, 0.7, -2};
  d.law.restitution = 0.5;
  d.law.friction = FrictionKind::coulomb;
  d.law.friction_value = 5;
  const Sequence sequence = impact_sequence(d, {.impacts = 2});
  const ImpactRow& row = sequence.rows.at(0);
  BOOST_TEST_REQUIRE(row.group.has_value());
  BOOST_TEST(row.corners.size() == 2);
  BOOST_TEST(row.group->is_whole);
  const double along = d.body.inertia(0, 0);  // it sticks: 1/m + r²/I across the axis
  const double push = -0.7 / (1 / 2. + 0.01 / along);
  BOOST_TEST((row.impact.impulse - Vector3(0, push, 6)).norm() <= 1e-14 * 6);
  BOOST_TEST((row.impact.angular_velocity_after - Vector3(0.1 * push / along, 0, 0)).norm() <= 1e-13);
  BOOST_TEST((sequence.outcome == Outcome::no_further_impact));
}

BOOST_AUTO_TEST_CASE(a_thin_capsule_is_a_rod_and_a_long_ellipsoid_does_not_care_which_axis_is_long) {
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    Drop thin{.body = capsule(1, {.length = 1, .radius = 1e-12}), .law = random_law(random, 1)};
    thin.attitude = random.attitude();
    thin.velocity = random.vector(0.5) - Vector3(0, 0, 2);
    thin.gravity = 9.81;
    thin.body.inertia(0, 0) = 1. / 12;  // as a thin rod has it, which nothing turns about its axis
    Drop rod = thin;
    rod.body = cylinder(1, {.length = 1, .radius = 0});
    Drop x{.body = ellipsoid(1, {0.5, 0.2, 0.2}), .law = thin.law};
    x.attitude = thin.attitude;
    x.velocity = thin.velocity;
    x.angular_velocity = random.vector(1);
    Drop z = x;
    z.body = ellipsoid(1, {0.2, 0.2, 0.5});
    z.attitude = x.attitude * Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()));
    for (const auto& [one, other, model] : {std::tuple{thin, rod, 1e-9}, {x, z, 0.0}}) {
      const Sequence a = impact_sequence(one, {.impacts = 3}), b = impact_sequence(other, {.impacts = 3});
      BOOST_TEST_REQUIRE(a.rows.size() == b.rows.size());
      for (std::size_t k = 0; k < a.rows.size() && a.rows[k].error.predictable; ++k) {
        const ImpactRow &p = a.rows[k], &q = b.rows[k];
        const double far = model * (1 + p.amplification);
        BOOST_TEST(std::fabs(p.start - q.start) <= 2 * p.error.start + far);
        BOOST_TEST((p.impact.velocity_after - q.impact.velocity_after).norm() <= 2 * p.error.velocity_after + 10 * far);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rows_scale_exactly_with_powers_of_two_and_mirror) {
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    Drop d = random_drop(random);
    d.velocity.z() = -2 - d.body.reach() * d.angular_velocity.norm();
    for (Ellipsoid& part : d.body.ellipsoids) part.centre.y() = 0;
    Drop big = d, mirrored = d;
    const int length = 7, mass = -3;  // at the same speeds
    big.body.mass = std::ldexp(d.body.mass, mass);
    big.body.inertia = std::ldexp(1.0, mass + 2 * length) * d.body.inertia;
    for (Ellipsoid& part : big.body.ellipsoids) part.centre *= 128, part.semiaxes *= 128;
    big.angular_velocity /= 128;
    big.gravity /= 128;
    mirrored.attitude = Quaternion(d.attitude.w(), -d.attitude.x(), d.attitude.y(), -d.attitude.z());
    mirrored.velocity.y() = -d.velocity.y();
    mirrored.angular_velocity = d.angular_velocity.cwiseProduct(Vector3(-1, 1, -1));
    const clatter::analytic::SequenceOptions options{.impacts = 6};
    const Sequence a = impact_sequence(d, options), b = impact_sequence(big, options),
                   c = impact_sequence(mirrored, options);
    BOOST_TEST_REQUIRE(a.rows.size() == b.rows.size());
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
      BOOST_TEST(b.rows[k].start == 128 * a.rows[k].start);
      BOOST_TEST((b.rows[k].impact.impulse == a.rows[k].impact.impulse / 8));
      if (k >= c.rows.size() || !a.rows[k].error.predictable || !c.rows[k].error.predictable) break;
      const Vector3 back = c.rows[k].impact.velocity_after.cwiseProduct(Vector3(1, -1, 1));
      BOOST_TEST((back - a.rows[k].impact.velocity_after).norm() <= 2 * a.rows[k].error.velocity_after);
    }
  }
}

BOOST_AUTO_TEST_CASE(changes_of_the_drop_by_an_ulp_stay_within_the_error_bars) {
  Random random(13);
  int rows = 0, outside = 0;
  for (int i = 0; i < scenes; ++i) {
    Drop d = random_drop(random);
    if (i % 2 == 1) {  // a rod or a disc
      const double turning = d.angular_velocity.norm() * d.body.reach(), size = std::exp2(random.uniform(-4, 2));
      d.body = cylinder(d.body.mass, {.length = 2 * size * std::pow(10, random.uniform(-2, 2)), .radius = size});
      d.angular_velocity *= turning / (d.angular_velocity.norm() * d.body.reach());
    }
    Drop near = d;
    const auto moved = [&](double x) { return x * (1 + random.whole(-1, 1) * epsilon); };
    for (int k = 0; k < 3; ++k) {
      near.velocity[k] = moved(d.velocity[k]);
      near.angular_velocity[k] = moved(d.angular_velocity[k]);
    }
    for (double& part : near.attitude.coeffs()) part = moved(part);
    Sequence a, b;
    try {
      a = impact_sequence(d, {.impacts = 8});
      b = impact_sequence(near, {.impacts = 8});
    } catch (const std::domain_error&) {
      continue;
    }
    for (std::size_t k = 0;
         k < std::min(a.rows.size(), b.rows.size()) && a.rows[k].error.predictable && b.rows[k].error.predictable;
         ++k) {
      const ImpactRow &p = a.rows[k], &q = b.rows[k];
      const RowErrors &e = p.error, &f = q.error;  // of both: each has rounding of its own
      const bool within =
          std::fabs(p.start - q.start) <= e.start + f.start &&
          std::fabs(p.impact.approach_speed - q.impact.approach_speed) <= e.approach_speed + f.approach_speed &&
          (p.impact.impulse - q.impact.impulse).norm() <= e.impulse + f.impulse &&
          (p.impact.velocity_after - q.impact.velocity_after).norm() <= e.velocity_after + f.velocity_after &&
          (p.impact.angular_velocity_after - q.impact.angular_velocity_after).norm() <=
              e.angular_velocity_after + f.angular_velocity_after;
      ++rows;
      outside += within ? 0 : 1;
    }
  }
  BOOST_TEST_MESSAGE(outside << " of " << rows << " rows outside");
  BOOST_TEST(rows > 3 * scenes);
  BOOST_TEST(outside <= 0.005 * rows);
}

BOOST_AUTO_TEST_CASE(a_turn_moves_the_lowest_point_as_its_derivative_says) {
  Random random(17);
  for (int i = 0; i < 50; ++i) {
    const Body body = random_body(random);
    const Quaternion q = random.attitude();
    const double step = 1e-5;  // the second order is 1e-10 of the reach times the ratio of the axes cubed
    const Matrix3 shift = shift_of_lowest_point(body, q, 0);
    for (int k = 0; k < 3; ++k) {
      const auto arm = [&](double angle) {
        const Quaternion turned = Quaternion(Eigen::AngleAxisd(angle, Vector3::Unit(k))) * q;
        return Vector3(turned * touching_place(body, turned, 0));
      };
      const Vector3 slope = (arm(step) - arm(-step)) / (2 * step);
      const Vector3 closed = Vector3::Unit(k).cross(arm(0)) + shift.col(k);
      BOOST_TEST((slope - closed).norm() <= 3e-7 * body.reach());
      BOOST_TEST(std::fabs(shift(2, k)) <= 1e-14 * body.reach());  // h is least there
    }
  }
}

BOOST_AUTO_TEST_CASE(inertia_is_that_of_the_uniform_body) {
  // Discs across x, by the midpoint rule, its error of the second order in the number of discs.
  const auto sum = [](double end, const auto& radius_square) -> Vector3 {
    constexpr int discs = 20000;
    double volume = 0, along = 0, across = 0;
    for (int i = 0; i < discs; ++i) {
      const double x = end * ((2. * i + 1) / discs - 1), square = radius_square(x);
      volume += square, along += square * square / 2, across += square * (square / 4 + x * x);
    }
    return Vector3(along, across, across) / volume;
  };
  const double r = 0.3, half = 0.5;
  const Vector3 pill = sum(half + r, [&](double x) {
    const double beyond = std::fmax(std::fabs(x) - half, 0);
    return r * r - beyond * beyond;
  });
  const Body body = capsule(2, {.length = 2 * (half + r), .radius = r});
  BOOST_TEST((Vector3(body.inertia.diagonal()) - 2 * pill).norm() <= 1e-8);
  const Vector3 egg = sum(0.7, [&](double x) { return r * r * (1 - x * x / 0.49); });
  BOOST_TEST((Vector3(ellipsoid(2, {0.7, r, r}).inertia.diagonal()) - 2 * egg).norm() <= 1e-8);
}

BOOST_AUTO_TEST_CASE(shapes_that_are_none_are_refused) {
  BOOST_CHECK_THROW(static_cast<void>(ellipsoid(1, {1, 0, 1})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(ellipsoid(1, {1, 1e-10, 1})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(ellipsoid(1, {1, NAN, 1})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(capsule(1, {.length = 0.19, .radius = 0.1})), std::domain_error);
  BOOST_CHECK_THROW(static_cast<void>(capsule(1, {.length = 1, .radius = 0})), std::domain_error);
  BOOST_TEST(capsule(1, {.length = 0.2, .radius = 0.1}).is_ball());
}
