// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of impact sequences in space, against differences of motions in 34 digits, and against the plane's.
#include "analytic/space/sequence/gradient.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>

#include "analytic/base/angle.hpp"
#include "tests/analytic/space/impulse/random_contact.hpp"
#include "validation/oracles/digits.hpp"
#include "validation/oracles/free_top.hpp"
#include "validation/oracles/stepped_impact.hpp"

namespace {

using clatter::analytic::FrictionKind, clatter::analytic::ImpactLaw, clatter::analytic::RestitutionLaw;
using namespace clatter::analytic::space;
using clatter::oracle::Random;
using Many = clatter::oracle::Decimal<34>;
using ManyVector = Eigen::Matrix<Many, 3, 1>;
using ManyMatrix = Eigen::Matrix<Many, 3, 3>;
using Top = clatter::oracle::Top<Many>;

constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 4 : 18;
constexpr double agreement = 1e-10;  // of derivatives over the largest of their kind

ManyMatrix axes_of(const std::array<Many, 4>& q) {
  return Eigen::Quaternion<Many>(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

/// One impact of the oracle: t, P, V′, ω′.
struct Struck {
  int corner = 0;
  Many time = 0;
  ManyVector impulse, velocity, turning;
};

/// A box that strikes with one corner after another.
class Oracle {
 public:
  /// The drop with one of its numbers moved.
  Oracle(const Drop& drop, SpaceParameter parameter, double by)
      : law_(drop.law), gravity_(drop.gravity), mass_(drop.body.mass), places_(drop.body.vertices) {
    if (parameter == SpaceParameter::restitution) law_.restitution += by;
    if (parameter == SpaceParameter::friction) law_.friction_value += by;
    const Quaternion& q = drop.attitude;
    Eigen::Quaternion<Many> attitude(Many(q.w()), Many(q.x()), Many(q.y()), Many(q.z()));
    attitude.normalize();
    using std::cos, std::sin;
    const Many half = Many(by) / 2;
    if (parameter == SpaceParameter::angle) attitude = Eigen::Quaternion<Many>(cos(half), 0, -sin(half), 0) * attitude;
    if (parameter == SpaceParameter::tilt) attitude = attitude * Eigen::Quaternion<Many>(cos(half), sin(half), 0, 0);
    top_.q = {attitude.w(), attitude.x(), attitude.y(), attitude.z()};
    for (int k = 0; k < 3; ++k) top_.moments[k] = drop.body.inertia(k, k);
    velocity_ = drop.velocity.cast<Many>();
    if (parameter == SpaceParameter::speed) velocity_[2] -= by;
    set_turning(drop.angular_velocity.cast<Many>());
    height_ = -arm(lowest(top_)).z();
  }

  /// Nothing if a corner grazes or none comes down soon.
  std::optional<std::vector<Struck>> run(int count) {
    std::vector<Struck> all;
    int corner = lowest(top_);
    for (;;) {
      all.push_back(strike(corner));
      if (static_cast<int>(all.size()) == count) return all;
      const auto next = fly();
      if (!next) return {};
      corner = *next;
    }
  }

 private:
  [[nodiscard]] ManyVector arm(int corner) const { return arm(top_, corner); }
  [[nodiscard]] ManyVector arm(const Top& top, int corner) const {
    return axes_of(top.q) * places_[corner].cast<Many>();
  }
  [[nodiscard]] int lowest(const Top& top) const {
    const ManyMatrix axes = axes_of(top.q);
    int best = 0;
    Many least = 1e300;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Many z = axes.row(2).dot(places_[i].cast<Many>());
      if (z < least) least = z, best = static_cast<int>(i);
    }
    return best;
  }
  [[nodiscard]] ManyVector turning() const { return axes_of(top_.q) * ManyVector(top_.w[0], top_.w[1], top_.w[2]); }
  void set_turning(const ManyVector& world) {
    const ManyVector w = axes_of(top_.q).transpose() * world;
    top_.w = {w[0], w[1], w[2]};
  }

  Struck strike(int corner) {
    const ManyMatrix axes = axes_of(top_.q);
    const ManyVector moments(1 / top_.moments[0], 1 / top_.moments[1], 1 / top_.moments[2]);
    const ManyMatrix inverse = axes * moments.asDiagonal() * axes.transpose();
    const ManyVector r = arm(corner), w = turning();
    ManyMatrix cross;
    cross << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
    const ManyMatrix contact = ManyMatrix::Identity() / mass_ + cross * inverse * cross.transpose();
    const ManyVector impulse =
        clatter::oracle::SteppedImpact<Many>(contact, ManyVector(velocity_ + w.cross(r)), law_).impulse();
    velocity_ += impulse / mass_;
    const ManyVector after = w + inverse * r.cross(impulse);
    set_turning(after);
    return {corner, time_, impulse, velocity_, after};
  }

  [[nodiscard]] Many height_at(const Top& top, const Many& t, int corner) const {
    return height_ + velocity_[2] * t - gravity_ * t * t / 2 + arm(top, corner).z();
  }

  /// Steps of a hundredth of a radian, until a corner is below the ground; then secants.
  std::optional<int> fly() {
    using std::abs, std::sqrt;
    const Many spin = sqrt(top_.w[0] * top_.w[0] + top_.w[1] * top_.w[1] + top_.w[2] * top_.w[2]);
    const Many step = Many(0.01) / spin;
    Top from = top_;
    Many begin = 0;
    clatter::oracle::TopSeries<Many> series(20);  // of a hundredth of a radian
    for (int i = 0; i < 4000; ++i) {
      series.expand(from);
      Top to = from;
      series.evaluate(to, step);
      const int corner = lowest(to);
      if (height_at(to, begin + step, corner) < 0) return land(series, from, begin, step, corner);
      from = to;
      begin += step;
    }
    return {};
  }
  std::optional<int> land(const clatter::oracle::TopSeries<Many>& series, const Top& from, const Many& begin,
                          const Many& step, int corner) {
    using std::abs;
    Top at = from;
    const auto height = [&](const Many& by) {
      series.evaluate(at, by);
      return height_at(at, begin + by, corner);
    };
    Many a = step / 2, b = step, at_a = height(a), at_b = height(b);
    for (int i = 0; i < 60 && abs(b - a) > Many(1e-33) * step && at_a != at_b; ++i) {
      const Many next = b - at_b * (b - a) / (at_b - at_a);
      a = b, at_a = at_b;
      b = next, at_b = height(b);
    }
    if (!(b > -step && b < 2 * step)) return {};
    (void)height(b);
    top_ = at;
    const Many t = begin + b;
    velocity_[2] -= gravity_ * t;
    time_ += t;
    height_ = -arm(corner).z();
    return lowest(top_) == corner ? std::optional(corner) : std::nullopt;
  }

  ImpactLaw law_;
  Many gravity_, mass_;
  std::vector<Vector3> places_;
  Top top_;
  ManyVector velocity_;
  Many height_ = 0, time_ = 0;
};

/// t, P, V′, ω′.
using Numbers = Eigen::Matrix<double, 10, 1>;

std::optional<std::vector<Numbers>> differences(const Drop& drop, SpaceParameter parameter, int count) {
  const bool is_of_law = parameter == SpaceParameter::restitution || parameter == SpaceParameter::friction;
  const double h = is_of_law ? 0x1p-30 : 0x1p-40;
  const auto low = Oracle(drop, parameter, -h).run(count), high = Oracle(drop, parameter, h).run(count);
  if (!low || !high) return {};
  std::vector<Numbers> all;
  for (std::size_t i = 0; i < low->size(); ++i) {
    const Struck &a = (*low)[i], &b = (*high)[i];
    if (a.corner != b.corner) return {};
    Numbers& d = all.emplace_back();
    d << static_cast<double>((b.time - a.time) / (2 * h)), ((b.impulse - a.impulse) / Many(2 * h)).cast<double>(),
        ((b.velocity - a.velocity) / Many(2 * h)).cast<double>(),
        ((b.turning - a.turning) / Many(2 * h)).cast<double>();
  }
  return all;
}

struct Tally {
  int compared = 0, outside = 0, refused = 0;
  double worst = 0;  ///< error beside the largest derivative of its kind, where the bar is below the agreement asked
};

void compare(const Drop& drop, int count, Tally& tally) {
  const SpaceGradient gradient = sequence_gradient(drop, count);
  for (std::size_t p = 0; p < space_parameters; ++p) {
    const std::size_t known = std::min(gradient.refused[p].from, gradient.rows.size());
    if (known < static_cast<std::size_t>(count)) ++tally.refused;
    const auto wanted = differences(drop, static_cast<SpaceParameter>(p), static_cast<int>(known));
    if (known == 0 || !wanted) continue;
    for (std::size_t i = 0; i < known; ++i) {
      const SpaceImpactGradient& of = gradient.rows[i].of[p];
      const SpaceGradientError& error = gradient.rows[i].error[p];
      const Numbers& right = (*wanted)[i];
      const double off[] = {std::fabs(of.time - right[0]), (of.impulse - right.segment<3>(1)).norm(),
                            (of.velocity - right.segment<3>(4)).norm(), (of.angular_velocity - right.tail<3>()).norm()};
      const double bars[] = {error.time, error.impulse, error.velocity, error.angular_velocity};
      const double size[] = {std::fabs(right[0]), right.segment<3>(1).norm(), right.segment<3>(4).norm(),
                             right.tail<3>().norm()};
      for (int k = 0; k < 4; ++k) {
        ++tally.compared;
        if (!(off[k] <= bars[k])) ++tally.outside;
        if (bars[k] <= 1e-7 * size[k]) tally.worst = std::fmax(tally.worst, off[k] / size[k]);
      }
    }
  }
}

/// Friction and restitution that doubles can move by 2⁻³⁰ exactly.
double round_number(double x) { return std::round(x * 0x1p16) * 0x1p-16; }

Drop random_drop(Random& random, int i) {
  Drop drop;
  const double length = random.uniform(0.5, 1.5), width = random.uniform(0.5, 1.5);
  drop.body = box(random.uniform(0.2, 2), {.size = {length, width, random.uniform(0.5, 1.5)}});
  drop.attitude = random.attitude();
  drop.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, -1)};
  drop.angular_velocity = random.vector(0.5);
  drop.gravity = i % 3 == 0 ? 0 : random.uniform(1, 10);
  ImpactLaw& law = drop.law;
  law.law = i % 3 == 0 ? RestitutionLaw::newton : i % 3 == 1 ? RestitutionLaw::poisson : RestitutionLaw::stronge;
  law.restitution = round_number(random.uniform(0.3, 0.9));
  law.friction = FrictionKind::coulomb;
  law.friction_value = round_number(i % 2 == 0 ? 0.01 : random.uniform(0.1, 0.7));
  return drop;
}

}  // namespace

BOOST_AUTO_TEST_CASE(derivatives_of_random_drops_are_the_differences_of_motions_in_34_digits) {
  Random random(41);
  Tally tally;
  for (int i = 0; i < drops; ++i) compare(random_drop(random, i), 3, tally);
  BOOST_TEST_MESSAGE(tally.compared << " compared, " << tally.outside << " outside, " << tally.refused << " refused, "
                                    << tally.worst << " worst");
  BOOST_TEST(tally.compared >= 20 * drops);
  BOOST_TEST(tally.outside == 0);
  BOOST_TEST(tally.worst <= agreement);
}

BOOST_AUTO_TEST_CASE(a_thin_rod_in_its_plane_has_the_plane_s_derivatives) {
  namespace plane = clatter::analytic;
  for (const double friction : {0.0, 0.1, 0.8}) {
    const double theta = 0.4;
    plane::Drop flat{.body = plane::make_rod({.mass = 0.5, .length = 0.3, .radius = 0}),
                     .inclination = plane::Angle::from_radians(theta),
                     .velocity = {.normal = -1.5, .tangential = 0.25, .angular = 0.5},
                     .gravity = 9.81,
                     .law = {.restitution = 0.75, .friction = FrictionKind::coulomb, .friction_value = friction}};
    if (friction == 0) flat.law.friction = FrictionKind::none;
    Drop drop;
    drop.body = cylinder(0.5, {.length = 0.3, .radius = 0});
    drop.attitude = turn_by({0, -theta, 0});
    drop.velocity = {0.25, 0, -1.5};
    drop.angular_velocity = {0, 0.5, 0};
    drop.gravity = 9.81;
    drop.law = flat.law;
    const plane::SequenceGradient wanted = plane::sequence_gradient(flat, 3);
    const SpaceGradient found = sequence_gradient(drop, 3);
    BOOST_TEST_REQUIRE(found.rows.size() == 3U);
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t i = 0; i < plane::drop_parameters; ++i) {
        const plane::ImpactGradient& right = wanted.rows[n].of[i];
        const std::size_t p = i == 0 ? 0 : i + 1;  // beside the tilt
        const SpaceImpactGradient& of = found.rows[n].of[p];
        const SpaceGradientError& error = found.rows[n].error[p];
        BOOST_TEST_CONTEXT("friction " << friction << ", impact " << n + 1 << ", parameter " << i) {
          BOOST_TEST(found.refused[p].reason == wanted.refused[i].reason);
          BOOST_CHECK_LE(std::fabs(of.time - right.time), error.time + 1e-15);
          BOOST_CHECK_LE(std::fabs(-of.attitude.y() - right.inclination), error.attitude + 1e-15);
          BOOST_CHECK_LE((of.velocity - Vector3(right.tangential, 0, right.normal)).norm(), error.velocity + 1e-15);
          BOOST_CHECK_LE((of.angular_velocity - Vector3(0, right.angular, 0)).norm(), error.angular_velocity + 1e-14);
          BOOST_CHECK_LE((of.impulse - Vector3(right.tangential_impulse, 0, right.normal_impulse)).norm(),
                         error.impulse + 1e-15);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_level_face_has_derivatives_but_none_of_a_turn) {
  Drop drop;
  drop.body = box(1, {.size = {0.3, 0.2, 0.1}});
  drop.velocity = {0, 0, -2};
  drop.gravity = 10;
  drop.law.restitution = 0.5;
  const SpaceGradient gradient = sequence_gradient(drop, 2);
  BOOST_TEST_REQUIRE(gradient.rows.size() == 2U);
  for (const std::size_t turn : {0U, 1U}) {
    BOOST_TEST(gradient.refused[turn].from == 0U);
    BOOST_TEST(!gradient.refused[turn].reason.empty());
  }
  // The second comes 2 e v/g after the first.
  const auto &of_speed = gradient.rows[1].of[2], &of_e = gradient.rows[1].of[3];
  BOOST_TEST(gradient.refused[2].from == 2U);
  BOOST_TEST(std::fabs(of_speed.time - 2 * 0.5 / 10) <= gradient.rows[1].error[2].time + 1e-15);
  BOOST_TEST(std::fabs(of_e.time - 2 * 2.0 / 10) <= gradient.rows[1].error[3].time + 1e-15);
  BOOST_TEST(gradient.rows[1].error[3].time <= 1e-9);
}

BOOST_AUTO_TEST_CASE(slip_that_begins_from_rest_has_derivatives_along_which_it_stays_at_rest) {
  Drop drop;
  drop.body = box(1, {.size = {0.15, 0.075, 0.05}});
  drop.attitude = turn_by({0.3, -0.6, 0});
  drop.velocity = {0, 0, -2};
  drop.gravity = 9.81;
  drop.law = {.restitution = 0.5, .friction = FrictionKind::coulomb, .friction_value = 0.125};
  const SpaceGradient gradient = sequence_gradient(drop, 1);
  BOOST_TEST_REQUIRE(gradient.rows.size() == 1U);
  // The impact is of degree one in the velocities.
  const SpaceImpactGradient& of_speed = gradient.rows[0].of[2];
  const Vector3& impulse = gradient.sequence.rows[0].impact.impulse;
  BOOST_TEST((of_speed.impulse - impulse / 2).norm() <= gradient.rows[0].error[2].impulse);
  BOOST_TEST(gradient.rows[0].error[2].impulse <= 1e-9 * impulse.norm());
  Tally tally;
  compare(drop, 1, tally);
  BOOST_TEST(tally.compared == 20);
  BOOST_TEST(tally.outside == 0);
}
