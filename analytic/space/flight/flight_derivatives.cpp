// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/flight/flight_derivatives.hpp"

#include <Eigen/LU>
#include <cmath>

namespace clatter::analytic::space {

namespace {

/// m, n, p of (3) as columns, in the axes of ThetaRotation, and ω_p.
struct MomentumTriad {
  Matrix3 axes;
  double across;

  MomentumTriad(const ThetaRotation& theta, const Vector3& momentum) {
    const Vector3& i = theta.moments();
    const Vector3& m = momentum;
    // m × ω without its cancellation near a principal axis.
    const Vector3 turning((i[1] - i[2]) * i[0] * m[1] * m[2], (i[2] - i[0]) * i[1] * m[2] * m[0],
                          (i[0] - i[1]) * i[2] * m[0] * m[1]);
    const double size = turning.stableNorm();
    axes << m, turning / size, m.cross(turning / size);
    across = theta.momentum() * size / i.prod();
  }
};

/// B of (3) by (4).
double drift_along_motion(const ThetaRotation& theta, const Vector3& from, const Vector3& to, double time) {
  const Vector3 a = theta.momentum() * theta.moments().cwiseInverse(), squares = theta.amplitudes().cwiseAbs2();
  const double complement = theta.least_third() * theta.least_third() / squares[2];
  const double middle = a[1] - a[2], outer = a[0] - a[2];
  const double largest = squares[0] * squares[2] * outer * outer, c = squares[2] * outer * middle;
  const double modulus = theta.modulus_square();
  const auto product = [&](const Vector3& m) {
    const MomentumTriad triad(theta, m);
    return m.prod() / (triad.across * triad.across);
  };
  const double signs = theta.sense() / theta.amplitudes().prod();
  const double bend = c * c * modulus * signs * (product(to) - product(from));
  const double swing = c * modulus * (theta.square_integral(time) - theta.square_integral(0));
  const double start = MomentumTriad(theta, from).across;
  return start * start * (largest * theta.rate() * time - bend - swing) /
         (theta.rate() * largest * squares[2] * middle * complement);
}

/// exp(M t) = 1 + M sin(νt)/ν + M² (1 − cos νt)/ν², with hyperbolic functions for ν² < 0.
Matrix3 fixed_axis_growth(const Vector3& angular_velocity, const Matrix3& inertia, double time) {
  const Matrix3 m = inertia.inverse() * cross_matrix(inertia * angular_velocity) - cross_matrix(angular_velocity);
  const double square = -(m * m).trace() / 2, rate = std::sqrt(std::fabs(square));
  const double half = rate * time / 2;
  double sine = time, versine = time * time / 2;
  if (half > 0) {
    const double s = square > 0 ? std::sin(half) : std::sinh(half), c = square > 0 ? std::cos(half) : std::cosh(half);
    sine = 2 * s * c / rate, versine = 2 * s * s / (rate * rate);
  }
  return Matrix3::Identity() + sine * m + versine * m * m;
}

}  // namespace

Matrix3 turn_growth(const FreeRotation& rotation, const Matrix3& inertia, double time) {
  const Matrix3 start = rotation.attitude(0).toRotationMatrix(), end = rotation.attitude(time).toRotationMatrix();
  const auto about_fixed_axis = [&] {
    return Matrix3(end * fixed_axis_growth(rotation.angular_velocity(0), inertia, time) * start.transpose());
  };
  if (rotation.is_steady()) return about_fixed_axis();
  const ThetaRotation& theta = *rotation.theta();
  const Matrix3 axes = theta.axes().cast<double>();
  const Vector3 momentum_before = theta.at(0).momentum, momentum_after = theta.at(time).momentum;
  const MomentumTriad from(theta, momentum_before), to(theta, momentum_after);
  // A wobble so small changes the growth by no more than its own size, and may be rounding.
  if (std::fmax(from.across, to.across) <= 1e-10 * rotation.fastest()) return about_fixed_axis();
  const double slowing = from.across / to.across;
  Matrix3 growth = Matrix3::Identity();
  growth(0, 1) = -time * from.across;
  growth(1, 1) = slowing;
  growth(2, 1) = -drift_along_motion(theta, momentum_before, momentum_after, time) / slowing;
  growth(2, 2) = 1 / slowing;
  return end * axes * to.axes * growth * (start * axes * from.axes).transpose();
}

RotationDerivatives rotation_derivatives(const FreeFlight& flight, const Matrix3& inertia, double time) {
  const FreeRotation& rotation = flight.rotation();
  const Quaternion attitude = rotation.attitude(time);
  const Matrix3 start = flight.start().attitude.toRotationMatrix(), end = attitude.toRotationMatrix();
  const Matrix3 inertia_before = start * inertia * start.transpose(), inertia_after = end * inertia * end.transpose();
  const Vector3& w = flight.start().angular_velocity;
  const Vector3 momentum = inertia_before * w, velocity = attitude * rotation.angular_velocity(time);
  const Matrix3 turn = cross_matrix(momentum);
  RotationDerivatives d;
  // So slow a turn leaves 1 − H few digits, and t³ none.
  if (w.norm() * time < 1e-5) {
    const Matrix3 bend = cross_matrix(w) + inertia_before.inverse() * (turn - cross_matrix(w) * inertia_before);
    d.attitude = time * (Matrix3::Identity() + time / 2 * bend);
  } else {
    const Matrix3 turned = turn - turn_growth(rotation, inertia, time) * turn;
    d.attitude = (turned + time * velocity * momentum.transpose()) * inertia_before / momentum.squaredNorm();
  }
  d.angular_velocity =
      inertia_after.inverse() * (inertia_before + turn * d.attitude) - cross_matrix(velocity) * d.attitude;
  return d;
}

namespace {

using Derivatives = Eigen::Matrix<double, 10, 10>;
using TimeGradient = Eigen::Matrix<double, 1, 10>;

/// At a fixed time.
Derivatives at_fixed_time(const Body& body, const FreeFlight& flight, double t, const State& now) {
  const auto [of_attitude, of_velocity] = rotation_derivatives(flight, body.inertia, t);
  const Matrix3 turn = cross_matrix(flight.start().angular_velocity);
  Derivatives j = Derivatives::Identity();
  // A turn of attitude and ω together turns the whole motion.
  j.block<3, 3>(1, 1) += of_attitude * turn;
  j.block<3, 3>(1, 7) = of_attitude;
  j.block<3, 3>(7, 1) = -cross_matrix(now.angular_velocity) + of_velocity * turn;
  j.block<3, 3>(7, 7) = of_velocity;
  return j;
}

void shift_time(const Body& body, const FreeFlight& flight, const State& now, const TimeGradient& of_time,
                Derivatives& j) {
  const Vector3 spin = now.attitude.conjugate() * now.angular_velocity;
  const Vector3 acceleration = now.attitude * (body.inertia.inverse() * (body.inertia * spin).cross(spin));
  j.row(0) += of_time;
  j.middleRows(1, 3) += now.angular_velocity * of_time;
  j.row(4) += flight.gravity_along() * of_time;
  j.row(6) -= flight.gravity() * of_time;
  j.bottomRows(3) += acceleration * of_time;
}

}  // namespace

Derivatives flight_derivatives(const Body& body, const FreeFlight& flight, double time, const State& now,
                               const TimeGradient& of_time) {
  Derivatives j = at_fixed_time(body, flight, time, now);
  shift_time(body, flight, now, of_time, j);
  return j;
}

ArrivalDerivatives arrival_derivatives(const Body& body, const FreeFlight& flight, const FirstContact& contact,
                                       const State& now, const Vector3& from, const Vector3& to) {
  const double t = contact.time;
  ArrivalDerivatives d{.of_state = at_fixed_time(body, flight, t, now), .of_time = {}};
  d.of_time = -cross_matrix(now.attitude * to).row(2) * d.of_state.middleRows(1, 3);
  d.of_time.segment<3>(1) += cross_matrix(flight.start().attitude * from).row(2);
  d.of_time[6] += t;
  d.of_time /= -contact.normal_velocity;
  shift_time(body, flight, now, d.of_time, d.of_state);
  return d;
}

}  // namespace clatter::analytic::space
