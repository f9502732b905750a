// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/first_contact.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "analytic/space/flight/body.hpp"
#include "validation/oracles/free_top.hpp"

namespace {

using namespace clatter::analytic::space;
using clatter::analytic::FlightEnd;

constexpr int drops = CLATTER_TEST_SLOW_BUILD ? 2000 : 100000;

/// A flight that begins with a vertex on the ground and rising, or with the body above the ground.
struct Scene {
  Body body;
  State state;
  double gravity = 0;
  int touching = -1;
};

double lowest(const Scene& s) {
  double least = 1e300;
  for (const Vector3& r : s.body.vertices) least = std::fmin(least, (s.state.attitude * r).z());
  return least;
}

Scene random_scene(auto& random) {
  std::uniform_real_distribution<double> share(0, 1), sided(-1, 1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  Scene s;
  const Vector3 size(std::exp2(-3 * share(random)), std::exp2(-3 * share(random)), std::exp2(-5 * share(random)));
  s.body = box(1, {.size = size, .centre = 0.3 * share(random) * sided(random) * size});
  if (share(random) < 0.3) s.body.vertices.resize(4);  // two diagonals' ends are missing: a wedge
  s.state.attitude = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
  s.state.angular_velocity = std::exp2(6 * sided(random)) * vector();
  s.state.velocity = std::exp2(2 * sided(random)) * vector();
  s.gravity = share(random) < 0.3 ? 0 : 9.81;
  s.state.position.z() = -lowest(s);
  if (share(random) < 0.3) {
    s.state.position.z() += share(random);
    return s;
  }
  for (int i = 0; i < static_cast<int>(s.body.vertices.size()); ++i) {
    const Vector3 r = s.state.attitude * s.body.vertices[i];
    if (std::fabs(r.z() + s.state.position.z()) > 1e-12) continue;
    s.touching = i;
    const double u = s.state.velocity.z() + s.state.angular_velocity.cross(r).z();
    s.state.velocity.z() += std::fabs(u) - u;
  }
  return s;
}

/// Height and normal velocity of each vertex by the series, at a time after the state expanded.
class March {
 public:
  explicit March(const Scene& scene) : scene_(scene), series_(12) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(scene.body.inertia);
    Matrix3 axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Quaternion q = scene.state.attitude * Quaternion(axes);
    const Vector3 w = q.conjugate() * scene.state.angular_velocity;
    for (int k = 0; k < 3; ++k) {
      top_.moments[k] = solver.eigenvalues()[k];
      top_.w[k] = w[k];
    }
    top_.q = {q.w(), q.x(), q.y(), q.z()};
    for (const Vector3& r : scene.body.vertices) places_.push_back(axes.transpose() * r);
  }

  struct Found {
    int vertex = -1;
    double time = 0;
    bool ambiguous = false;  ///< another vertex, or a graze, is as near as this march can tell
  };

  Found first() {
    const double speed = scene_.state.angular_velocity.norm(), end = last_time();
    const double step = std::fmin(0.08 / speed, end / 20);
    Found found;
    while (time_ < end) {
      series_.expand(top_);
      clatter::oracle::Top<double> next = top_;
      series_.evaluate(next, step);
      for (std::size_t i = 0; i < places_.size(); ++i) inspect(i, step, next, found);
      if (found.vertex >= 0) return found;
      top_ = next;
      time_ += step;
    }
    return found;
  }

 private:
  struct Height {
    double value, rate;
  };

  /// Below −reach for certain, or above it for good.
  [[nodiscard]] double last_time() const {
    const double reach = scene_.body.reach(), v = scene_.state.velocity.z(), z = scene_.state.position.z();
    const double g = scene_.gravity;
    if (g > 0) return (v + std::sqrt(v * v + 2 * g * (z + reach))) / g;
    return v > 0 ? (reach - z) / v + 1e-9 : (z + reach) / -v;
  }

  [[nodiscard]] Height at(std::size_t i, double h) {
    clatter::oracle::Top<double> top = top_;
    series_.evaluate(top, h);
    return of(i, h, top);
  }

  [[nodiscard]] Height of(std::size_t i, double h, const clatter::oracle::Top<double>& top) const {
    const Quaternion q(top.q[0], top.q[1], top.q[2], top.q[3]);
    const double t = time_ + h;
    const Vector3 w(top.w[0], top.w[1], top.w[2]);
    return {scene_.state.position.z() + t * (scene_.state.velocity.z() - scene_.gravity / 2 * t) + (q * places_[i]).z(),
            scene_.state.velocity.z() - scene_.gravity * t + (q * w.cross(places_[i])).z()};
  }

  /// Whether vertex i reaches the ground in the step, and before `found`.
  void inspect(std::size_t i, double step, const clatter::oracle::Top<double>& next, Found& found) {
    double low = 0, high = step;
    const bool leaves = time_ == 0 && static_cast<int>(i) == scene_.touching;
    Height start = leaves ? at(i, 1e-7 * step) : of(i, 0, top_), end = of(i, step, next);
    if (leaves) low = 1e-7 * step;
    if (start.rate < 0 && end.rate > 0 && end.value > 0) {  // the lowest point between
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (at(i, middle).rate < 0 ? low : high) = middle;
      }
      high = (low + high) / 2;
      end = at(i, high);
      if (std::fabs(end.value) < 1e-9) found.ambiguous = true;
      low = 0;
    }
    if (!(end.value <= 0)) return;
    if (leaves) low = 1e-7 * step;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (at(i, middle).value > 0 ? low : high) = middle;
    }
    const double time = time_ + high;
    if (found.vertex >= 0 && std::fabs(time - found.time) * (1 + std::fabs(end.rate)) < 1e-8) found.ambiguous = true;
    if (found.vertex < 0 || time < found.time) {
      found.vertex = static_cast<int>(i);
      found.time = time;
    }
  }

  const Scene& scene_;
  clatter::oracle::TopSeries<double> series_;
  clatter::oracle::Top<double> top_;
  std::vector<Vector3> places_;
  double time_ = 0;
};

FirstContact find(const Scene& s) {
  const FreeFlight flight(PrincipalAxes(s.body.inertia), s.state, s.gravity);
  if (s.touching < 0) return first_contact(s.body, flight, {});
  const Vector3 r = s.state.attitude * s.body.vertices[s.touching];
  const Touch touch{s.touching, s.state.velocity.z() + s.state.angular_velocity.cross(r).z()};
  return first_contact(s.body, flight, {&touch, 1});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_touching_corner_that_approaches_by_rounding_arrives_alone) {
  const Body body = box(1, {.size = {0.3, 0.2, 0.1}});
  State s;
  s.attitude = Quaternion(Eigen::AngleAxisd(0.1, Vector3(1, 2, 0).normalized()));
  const auto height = [&](const Vector3& place) { return (s.attitude * place).z(); };
  const auto lowest = static_cast<int>(std::ranges::min_element(body.vertices, {}, height) - body.vertices.begin());
  const Vector3 arm = s.attitude * body.vertices[lowest];
  s.position.z() = -arm.z();
  s.angular_velocity = {0.4, -1, 0};
  s.velocity = -s.angular_velocity.cross(arm);
  const FreeFlight flight(PrincipalAxes(body.inertia), s, 9.81);
  const FirstContact first = first_contact(body, flight, std::array{Touch{lowest, -1e-17}});
  BOOST_TEST(first.time == 0);
  BOOST_TEST(first.together == std::vector<int>{lowest}, boost::test_tools::per_element());
  // So does corner 0 of an edge whose other end is 1 nm above the ground and comes down.
  s.attitude = Quaternion(Eigen::AngleAxisd(1e-9 / 0.2, Vector3::UnitX())) *
               Quaternion(Eigen::AngleAxisd(-0.4, Vector3::UnitY()));
  const Vector3 end = s.attitude * body.vertices[0];
  s.position.z() = -end.z();
  s.angular_velocity = {-2.5, 0, 0};
  s.velocity = -s.angular_velocity.cross(end);
  const FirstContact one =
      first_contact(body, FreeFlight(PrincipalAxes(body.inertia), s, 9.81), std::array{Touch{0, -1e-17}});
  BOOST_TEST(one.time == 0);
  BOOST_TEST(one.together == std::vector<int>{0}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_corner_that_impacts_of_others_have_left_below_the_ground_arrives_at_once_if_it_approaches) {
  // Two corners of an edge rattle to rest: corner 0 hops, corner 2 is below by more than the rounding of one flight.
  const Body body = box(1, {.size = {0.3, 0.2, 0.1}});
  const double below = 1e-13;
  State s;
  s.attitude = Quaternion(Eigen::AngleAxisd(-below / 0.2, Vector3::UnitX())) *
               Quaternion(Eigen::AngleAxisd(-0.4, Vector3::UnitY()));
  const Vector3 arm = s.attitude * body.vertices[0];
  s.position.z() = -arm.z();
  for (const double speed : {-1e-6, 1e-6}) {
    s.angular_velocity = {speed / 0.2, 0, 0};
    s.velocity = Vector3(0, 0, 1e-9) - s.angular_velocity.cross(arm);
    const FreeFlight flight(PrincipalAxes(body.inertia), s, 9.81);
    const FirstContact first = first_contact(body, flight, std::array{Touch{0, 1e-9}});
    BOOST_TEST_CONTEXT("speed " << speed) {
      BOOST_TEST((first.time == 0) == (speed < 0));
      BOOST_TEST(first.point == (speed < 0 ? 2 : 0));
    }
  }
}

BOOST_AUTO_TEST_CASE(in_100000_random_drops_no_first_corner_is_wrong_and_no_impact_missed) {
  std::mt19937_64 random(20);
  int compared = 0, contacts = 0, wrong = 0, evaluations = 0;
  double worst = 0;
  for (int i = 0; i < drops; ++i) {
    const Scene s = random_scene(random);
    const FirstContact found = find(s);
    evaluations += found.evaluations;
    const March::Found expected = March(s).first();
    if (expected.ambiguous) continue;
    ++compared;
    const bool contact = found.end == FlightEnd::contact;
    if (contact) ++contacts;
    const double off = contact ? std::fabs(found.time - expected.time) / (1 + found.time) : 0;
    worst = std::fmax(worst, off);
    if (contact != (expected.vertex >= 0) || (contact && (found.point != expected.vertex || !(off <= 1e-6)))) {
      ++wrong;
      if (wrong < 5)
        BOOST_TEST_MESSAGE("drop " << i << ": " << found.point << " at " << found.time << ", expected "
                                   << expected.vertex << " at " << expected.time);
    }
  }
  BOOST_TEST_MESSAGE(compared << " compared, " << contacts << " contacts, times within " << worst << ", evaluations "
                              << evaluations);
  BOOST_TEST(wrong == 0);
  BOOST_TEST(compared >= drops - drops / 500);
  BOOST_TEST(contacts > drops / 2);
}

BOOST_AUTO_TEST_CASE(a_rim_that_lies_on_the_ground_without_having_been_struck_hops_as_one_that_was_but_for_its_errors) {
  const Body rod = cylinder(1, {.length = 1, .radius = 0.05});
  for (const double rise : {1e-6, 1e-4, 1e-2}) {
    State state;
    state.attitude = Quaternion(Eigen::AngleAxisd(-0.3, Vector3::UnitY()));
    state.angular_velocity = {0.01, 0.02, 0.03};
    const Vector3 place = touching_place(rod, state.attitude, 0);
    state.position.z() = -(state.attitude * place).z();
    state.velocity.z() = rise - state.angular_velocity.cross(state.attitude * place).z();
    const FreeFlight flight(PrincipalAxes(rod.inertia), state, 9.81);
    const Touch touch{.point = 0, .normal_velocity = rise};
    const FirstContact struck = first_contact(rod, flight, {&touch, 1}), lying = first_contact(rod, flight, {});
    BOOST_TEST_CONTEXT("rises at " << rise) {
      BOOST_TEST((lying.end == FlightEnd::contact && struck.end == FlightEnd::contact));
      BOOST_TEST(lying.point == 0);
      BOOST_TEST(struck.is_hop);
      BOOST_TEST(!lying.is_hop);
      BOOST_TEST(std::fabs(lying.time - struck.time) <= lying.time_error + struck.time_error);
      BOOST_TEST(std::fabs(lying.normal_velocity - struck.normal_velocity) <= lying.velocity_error);
      BOOST_TEST(lying.velocity_error > struck.velocity_error);
    }
  }
}
