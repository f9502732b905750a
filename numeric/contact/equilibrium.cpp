// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::numeric {
namespace {

constexpr double difference = 1e-4;    ///< steps of central differences, of the depth
constexpr double longest_step = 0.05;  ///< of the way down, of the body's radius
constexpr double near_enough = 1e-6;   ///< force and moment from which on Newton's steps are taken whole
constexpr double balanced = 1e-9;      ///< force and moment of an equilibrium, of m g and m g times the radius
constexpr double neutral = 1e-7;       ///< stiffness against the largest that counts as none: of a ball that turns
constexpr double push = 0.01;          ///< out of an equilibrium that is not stable, of the radius
constexpr double least_fall = 1e-4;    ///< of the energy on a step down, of what the pull promises
constexpr int most_ways = 300, most_halvings = 60, most_newton = 30, most_tries = 4;

/// Height, and tilt about world x and y times the body's radius [m].
using Place = Vector3;

/// A body without velocities, moved from a reference that just touches the ground.
class Resting {
 public:
  Resting(const Body& body, const Ground& ground, const Gravity& gravity, bool planar)
      : body_(body), gravity_(gravity), planar_(planar), system_(body, ground, gravity, planar) {}

  void refer_to(MotionState pose) {
    pose.velocity.setZero();
    pose.angular_velocity.setZero();
    pose.centre.z() -= lowest_height(body_, pose);
    system_.begin(pose);
  }
  /// Goes to a place, and computes what pulls there.
  void go(const Place& place) {
    const Vector3 turn = system_.touch_down().attitude.conjugate() * Vector3(place.y(), place.z(), 0) / body_.radius();
    const double angle = turn.norm();
    state_ = system_.initial();
    displacement(state_).z() = place.x();
    euler_parameters(state_)[0] = std::cos(angle / 2);
    if (angle > 0) euler_parameters(state_).tail<3>() = turn * (std::sin(angle / 2) / angle);
    ContactState rate;
    load_ = system_.diagnose(state_, rate).load;
    const Eigen::Quaterniond attitude = system_.motion(state_).attitude;
    Vector3 moment = attitude * (body_.inertia() * angular_velocity(rate));
    if (load_.force > 0 && gravity_.along != 0) {
      const Vector3 arm = attitude * load_.pressure_centre();
      moment += arm.cross(Vector3(-body_.mass() * gravity_.along, 0, 0));
    }
    if (planar_) moment.x() = 0;
    const double weight = body_.mass() * gravity_.down;
    pull_ = Vector3(load_.force - weight, moment.x() / body_.radius(), moment.y() / body_.radius());
    energy_ = load_.energy + weight * place.x();
  }
  [[nodiscard]] const Vector3& pull() const { return pull_; }  ///< force, and moments over the radius [N]
  [[nodiscard]] double energy() const { return energy_; }
  [[nodiscard]] const ContactLoad& load() const { return load_; }
  [[nodiscard]] MotionState pose() const { return system_.motion(state_); }
  [[nodiscard]] ContactSystem& system() { return system_; }

  /// −∂pull/∂place, symmetric on level ground; leaves the body at `place`.
  [[nodiscard]] Matrix3 stiffness(const Place& place) {
    go(place);
    const double step = difference * load_.deepest;
    Matrix3 matrix;
    for (int i = 0; i < 3; ++i) {
      const Place shift = step * Vector3::Unit(i);
      go(place + shift);
      const Vector3 up = pull_;
      go(place - shift);
      matrix.col(i) = (pull_ - up) / (2 * step);
    }
    if (planar_) matrix.col(1).setZero();
    go(place);
    return matrix;
  }

 private:
  const Body& body_;
  Gravity gravity_;
  bool planar_;
  ContactSystem system_;
  ContactState state_;
  ContactLoad load_;
  Vector3 pull_;
  double energy_ = 0;
};

/// Depth to which the weight presses the body, straight down from its reference; infinite if the ground gives way.
double depth_under(Resting& body, double weight, double radius) {
  double low = 0, high = 1e-12 * radius;
  while (!(body.system().pressed(high).force >= weight)) {
    low = high;
    high *= 4;
    if (!(high < radius)) return std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < 20; ++i) {
    const double middle = (low + high) / 2;
    (body.system().pressed(middle).force >= weight ? high : low) = middle;
  }
  return high;
}

/// Inverse of the stiffness, by its size in each of its axes and none where it is neutral: leads down from a saddle.
Vector3 step_down(const Matrix3& stiffness, const Vector3& pull) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes((stiffness + stiffness.transpose()) / 2);
  const double largest = axes.eigenvalues().cwiseAbs().maxCoeff();
  Vector3 along = axes.eigenvectors().transpose() * pull;
  for (int i = 0; i < 3; ++i) {
    const double size = std::fabs(axes.eigenvalues()[i]);
    along[i] = size > neutral * largest ? along[i] / size : along[i] / (neutral * largest);
  }
  return axes.eigenvectors() * along;
}

/// Down the energy until force and moment are near balance, by Newton's steps.  On a slope, where friction's moment has
/// no energy, that falls instead.
void descend(Resting& resting, Place& place, double weight, double radius, bool has_energy) {
  for (int i = 0; i < most_ways && resting.pull().norm() > near_enough * weight; ++i) {
    const Matrix3 stiffness = resting.stiffness(place);
    const Vector3 pull = resting.pull();
    const double before = resting.energy();
    Vector3 step = step_down(stiffness, pull);
    step *= std::min(1.0, longest_step * radius / step.norm());
    const auto is_better = [&] {
      return has_energy ? before - resting.energy() >= least_fall * step.dot(pull)
                        : resting.pull().norm() < pull.norm();
    };
    int halvings = 0;
    for (; halvings < most_halvings; ++halvings, step /= 2) {
      resting.go(place + step);
      if (is_better()) break;
    }
    if (halvings == most_halvings) return;
    // The tilt is counted from the present attitude, so that moments are its derivatives.
    const MotionState pose = resting.pose();
    const double height = pose.centre.z();
    resting.refer_to(pose);
    place = {height - resting.system().touch_down().centre.z(), 0, 0};
    resting.go(place);
    if (resting.load().deepest > 0) continue;
    place.x() = -depth_under(resting, weight, radius);
    resting.go(place);
  }
}

/// Newton's steps to the balance of force and moment, as near as numbers tell; what is left of them [N].
double balance(Resting& resting, Place& place) {
  Place next = place;
  double least = resting.pull().norm();
  for (int i = 0; i < most_newton; ++i) {
    Eigen::CompleteOrthogonalDecomposition<Matrix3> solver;
    solver.setThreshold(neutral);
    next += solver.compute(resting.stiffness(next)).solve(resting.pull());
    resting.go(next);
    if (!(resting.pull().norm() < least)) break;
    least = resting.pull().norm();
    place = next;
  }
  return least;
}

}  // namespace

std::optional<Equilibrium> equilibrium_near(const Body& body, const Ground& ground, const Gravity& gravity, bool planar,
                                            const MotionState& near) {
  const double weight = body.mass() * gravity.down, radius = body.radius();
  const double along = body.mass() * std::fabs(gravity.along);
  if (!(weight > 0) || along > ground.static_friction * weight) return std::nullopt;
  Resting resting(body, ground, gravity, planar);
  resting.refer_to(near);
  Place place(-depth_under(resting, weight, radius), 0, 0);
  if (!std::isfinite(place.x())) return std::nullopt;
  resting.go(place);
  for (int tries = 0; tries < most_tries; ++tries) {
    descend(resting, place, weight, radius, gravity.along == 0);
    const double left = balance(resting, place);
    const Matrix3 stiffness = resting.stiffness(place);
    const Eigen::SelfAdjointEigenSolver<Matrix3> axes((stiffness + stiffness.transpose()) / 2);
    const bool is_stable = axes.eigenvalues()[0] >= -neutral * axes.eigenvalues()[2];
    if (!(left <= balanced * weight)) return std::nullopt;
    if (is_stable) return Equilibrium{resting.pose(), resting.load().deepest, resting.load().energy};
    place += push * radius * axes.eigenvectors().col(0);
    resting.go(place);
  }
  return std::nullopt;
}

}  // namespace clatter::numeric
