// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/law_fit.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/space/impact.hpp"

namespace clatter::validation {
namespace {

using analytic::RestitutionLaw;
using analytic::space::State;

constexpr double quadratic_below = 0.05;  // relative error
constexpr int floor_iterations = 2000;
constexpr double floor_settled = 1e-12;
constexpr std::size_t least_points = 5;

Matrix3 world_inverse_inertia(const TrackedBody& body, const Quaternion& attitude) {
  const Matrix3 axes = attitude.toRotationMatrix();
  return axes * body.core().inertia.inverse() * axes.transpose();
}

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

}  // namespace

double FittedLaw::restitution_at(double effective_mass) const {
  return std::clamp(restitution + slope * effective_mass, 0.0, 1.0);
}

double effective_mass(const TrackedBody& body, const State& state, int corner) {
  const Matrix3 w = analytic::space::inverse_contact_inertia(
      body.core().mass, world_inverse_inertia(body, state.attitude), body.arm(state.attitude, corner));
  return 1 / (body.core().mass * w(2, 2));
}

State struck(const TrackedBody& body, const State& before, int corner, const FittedLaw& law) {
  analytic::space::Law impact_law;
  impact_law.law.restitution = law.restitution_at(law.slope == 0 ? 0 : effective_mass(body, before, corner));
  impact_law.law.law = law.law;
  impact_law.law.friction = analytic::FrictionKind::coulomb;
  impact_law.law.friction_value = std::max(0.0, law.friction);
  State after = before;
  try {
    const Vector3 place = before.attitude.conjugate() * body.arm(before.attitude, corner);
    const analytic::space::Impact impact = analytic::space::strike(body.core(), before, place, impact_law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  } catch (const analytic::OutsideModelError&) {
    return before;
  } catch (const analytic::NumericalError&) {
    return before;
  }
  return after;
}

double motion_distance(const TrackedBody& body, const State& a, const State& b) {
  return std::sqrt((a.velocity - b.velocity).squaredNorm() +
                   body.gyration_square() * (a.angular_velocity - b.angular_velocity).squaredNorm());
}

double motion_size(const TrackedBody& body, const State& state) {
  return std::sqrt(state.velocity.squaredNorm() + body.gyration_square() * state.angular_velocity.squaredNorm());
}

double relative_error(const TrackedBody& body, const TrackImpact& impact, const State& predicted) {
  return motion_distance(body, impact.after.state, predicted) / motion_size(body, impact.before.state);
}

LawFit fit_law(const TrackedBody& body, const std::vector<PartImpact>& impacts, RestitutionLaw law, bool slope) {
  std::vector<const TrackImpact*> points;
  for (const PartImpact& item : impacts) {
    if (item.impact.is_point) points.push_back(&item.impact);
  }
  if (points.size() < least_points) {
    throw analytic::NumericalError("only " + std::to_string(points.size()) +
                                   " point impacts among the drops to fit on: restitution and friction need " +
                                   std::to_string(least_points));
  }
  LawFit result{.law = {.law = law}, .fit = {}, .slope = slope, .impacts = points.size()};
  const auto law_of = [&](const Eigen::VectorXd& p) { return FittedLaw{law, p[0], slope ? p[2] : 0, p[1]}; };
  const Losses losses = [&](const Eigen::VectorXd& p) {
    const FittedLaw trial = law_of(p);
    const double beyond = outside(p[1], 0, 2) + (slope ? 0 : outside(p[0], 0, 1));
    Eigen::VectorXd all(static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const State predicted = struck(body, points[i]->before.state, points[i]->corner, trial);
      all[static_cast<Eigen::Index>(i)] =
          pseudo_huber(relative_error(body, *points[i], predicted), quadratic_below) + beyond;
    }
    return all;
  };
  FitStart start{{0.4, 0.15}, {0.1, 0.05}};
  if (slope) start = {{0.4, 0.15, 0.0}, {0.1, 0.05, 0.1}};
  result.fit = fit_robustly(losses, start);
  result.law = law_of(result.fit.value);
  return result;
}

double floor_error(const TrackedBody& body, const TrackImpact& impact, double friction) {
  // Least |A P − y| over the cone by projected gradients; A maps an impulse per mass to (ΔV, k ΔΩ).
  const State &before = impact.before.state, &after = impact.after.state;
  const double k = std::sqrt(body.gyration_square());
  Eigen::Matrix<double, 6, 3> a;
  a.topRows<3>() = Matrix3::Identity();
  a.bottomRows<3>() = k * body.core().mass * world_inverse_inertia(body, before.attitude) * cross_matrix(impact.arm);
  Eigen::Matrix<double, 6, 1> y;
  y << after.velocity - before.velocity, k * (after.angular_velocity - before.angular_velocity);
  const double step = 1 / (a.transpose() * a).trace();
  Vector3 p = Vector3::Zero();
  for (int i = 0; i < floor_iterations; ++i) {
    Vector3 next = p + step * a.transpose() * (y - a * p);
    const double tangential = next.head<2>().norm();
    if (tangential > friction * next.z()) {  // the nearest point of the cone
      const double normal = std::max(0.0, (friction * tangential + next.z()) / (1 + friction * friction));
      next.head<2>() *= friction * normal / tangential;
      next.z() = normal;
    }
    const bool done = (next - p).norm() < floor_settled;
    p = next;
    if (done) break;
  }
  return (y - a * p).norm() / motion_size(body, before);
}

const std::array<RestitutionLaw, 3>& fitted_laws() {
  static const std::array laws{RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge};
  return laws;
}

const char* fitted_law_name(RestitutionLaw law) {
  switch (law) {
    case RestitutionLaw::newton: return "newton";
    case RestitutionLaw::poisson: return "poisson";
    case RestitutionLaw::stronge: return "stronge";
    case RestitutionLaw::viscoelastic: return "viscoelastic";
  }
  return "";
}

}  // namespace clatter::validation
