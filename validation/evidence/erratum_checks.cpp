// SPDX-License-Identifier: GPL-3.0-or-later
// The errata E1 to E11: the printed form and the right one, both evaluated.
#include <fmt/format.h>

#include <gsl/gsl_eigen.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "analytic/plane/impact.hpp"
#include "numeric/motion/equations_of_motion.hpp"
#include "numeric/motion/free_flight.hpp"
#include "validation/evidence/check.hpp"
#include "validation/oracles/event_oracle.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;
using numeric::Vector3;

/// The erratum shows where the printed form gives another number than the right one.
Finding misprint_if(bool differs) { return differs ? Finding::misprint : Finding::holds; }
Measured erratum(double number, double error, const std::string& found, double printed, double right) {
  constexpr double rounding = 1e-3;  // of the numbers in the paper's text
  return {number, error, misprint_if(std::fabs(printed - right) > rounding * std::fabs(right)), found, printed, right};
}

/// Fourth line of Eq. 8, V_n − Ω d_t = −e v_n, for θ = 30°, v_n = −1, μ_i = 0.2, end a: with Ω of the model, and with
/// that of Eq. 9 as printed.
Measured sign_of_omega(CaseRuns&) {
  const double c = std::cos(analytic::pi / 6), s = 0.5, mu = 0.2, v = -1;
  const double printed = 12 * (c - mu * s) / (1 + 3 * c * c - 3 * mu * s * c) * v;
  const analytic::PlanarBody rod = analytic::make_rod({});
  const analytic::PlanarVelocity after =
      analytic::strike(rod, {.normal = v}, rod.contact_point(0, s, c),
                       {.friction = analytic::FrictionKind::impulse_ratio, .friction_value = mu})
          .after;
  const auto residual = [&](double omega) { return after.normal - omega * (-c / 2) + v; };
  const double error = worst_of({std::fabs(residual(after.angular)), std::fabs(after.angular + printed)});
  return erratum(
      residual(printed), error,
      fmt::format("residual of Eq. 8 with Ω as printed; with the model's {}", significant(residual(after.angular), 1)),
      printed, after.angular);
}

/// β at θ = 20°, v_n = −1, g = 9.81 by the brute-force simulation, in long double.
double simulated_second_angle() {
  const long double degrees = degrees_per_radian;
  const oracle::EventBody<long double> rod{1, 1 / 12.0L, {{-0.5L, 0}, {0.5L, 0}}};
  oracle::EventSimulation<long double> simulation(rod, {20 / degrees, -1, 0, 0}, {.gravity = 9.81L});
  return static_cast<double>(-simulation.run(2, 0).impacts.at(1).before.inclination * degrees);
}

Measured gravity_term(CaseRuns&) {
  const double g = 9.81, simulated = simulated_second_angle();
  const Angle theta = Angle::from_degrees(20);
  const double beta = contact_angles(theta, {.gravity_number = g}).beta.angle * degrees_per_radian;
  const auto printed = [&](double signed_g) {
    return contact_angle_as_printed(theta, signed_g).angle * degrees_per_radian;
  };
  return erratum(beta, std::fabs(beta - simulated) / simulated,
                 fmt::format("β at 20°, vₙ = −1, g = 9.81; printed {}° (g > 0) or {}° (g < 0)",
                             significant(printed(g), 4), significant(printed(-g), 3)),
                 printed(g), beta);
}

/// V_b after impact 2 for v_n = −2: the end leaves as fast as it came.
Measured factor_v(CaseRuns&) {
  const double v = -2;
  const ContactAngles at = elastic_angles(20);
  const double c = std::cos(at.beta.angle), speed = std::fabs(v);
  const double came = speed * (at.velocity[0] - at.angular[0] * c / 2);
  const double right = speed * at.velocity[1] - speed * at.angular[1] * c / 2;
  const double printed = speed * at.velocity[1] + speed * at.angular[1] * c * v / 2;
  return erratum(printed / -came, std::fabs(right / -came - 1),
                 "speed of end b after impact 2 over that before, as printed for vₙ = −2; right 1", printed, right);
}

Measured relative_velocity(CaseRuns&) {
  const double v = -1;
  const ContactAngles at = elastic_angles(20);
  const double c = std::cos(Angle::from_degrees(20).radians), d = 1 + 3 * c * c;
  const double printed = (1 - 3 * c * c) / d * v - std::cos(at.beta.angle) * 6 * c / d * v;
  const double actual = at.velocity[0] - at.angular[0] * std::cos(at.beta.angle) / 2;
  const ContactAngles heavy = elastic_angles(20, 1);
  return erratum(printed / actual, std::fabs(printed / actual + 1),
                 fmt::format("v_rn over the normal velocity of the contact point; with G = 1 also − gT = {}",
                             significant(-heavy.beta.time, 3)),
                 printed, actual);
}

Measured second_fold(CaseRuns&) {
  const analytic::RegimeBoundary fold = regime_boundary(analytic::ImpactNumber::second, {});
  const double exact = second_impact_fold_beta();
  const double beta = fold.beta * degrees_per_radian;
  return erratum(beta, std::fabs(fold.beta - exact) / exact,
                 fmt::format("β at the end of the second impact, θ = {}°; printed 90° at 58°",
                             significant(fold.theta * degrees_per_radian, 14)),
                 90, beta);
}

Measured third_fold(CaseRuns&) {
  const analytic::RegimeBoundary fold = regime_boundary(analytic::ImpactNumber::third, {});
  const double theta = fold.theta * degrees_per_radian;
  return erratum(
      theta, std::fabs(theta / third_impact_fold_deg - 1),
      fmt::format("θ at the end of the third impact, β = {}°, γ = {}°; printed around 27°",
                  significant(fold.beta * degrees_per_radian, 9), significant(fold.gamma * degrees_per_radian, 9)),
      27, theta);
}

Measured centre_after_first(CaseRuns&) {
  const double at_45 = elastic_angles(45).velocity[0];
  return {at_45,
          std::fabs(at_45 + 0.2),
          misprint_if(at_45 < 0),
          fmt::format("V₁ at 45°, downward; {} at 54.7356°, {} at 58°",
                      significant(elastic_angles(std::acos(1 / std::sqrt(3.0)) * degrees_per_radian).velocity[0], 1),
                      significant(elastic_angles(58).velocity[0], 3)),
          {},
          at_45};
}

/// A body in a general state under a general load.
struct General {
  numeric::BodyInertia body{1.3, Vector3(0.02, 0.05, 0.06).asDiagonal()};
  numeric::MotionState state{.centre = {0, 0, 1},
                             .attitude = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized(),
                             .velocity = {0.4, -0.2, 1},
                             .angular_velocity = {2, -3, 1.5}};
  numeric::WorldWrench wrench{.force = {1, 2, -12}, .moment = {0.3, -0.2, 0.1}};
};

/// The eigenvalues of a symmetric matrix, ascending.
numeric::Vector7 eigenvalues(numeric::Matrix7 matrix) {
  constexpr std::size_t size = 7;
  numeric::Vector7 values;
  const std::unique_ptr<gsl_eigen_symm_workspace, void (*)(gsl_eigen_symm_workspace*)> workspace(
      gsl_eigen_symm_alloc(size), gsl_eigen_symm_free);
  gsl_matrix_view of_matrix = gsl_matrix_view_array(matrix.data(), size, size);
  gsl_vector_view of_values = gsl_vector_view_array(values.data(), size);
  gsl_eigen_symm(&of_matrix.matrix, &of_values.vector, workspace.get());
  std::sort(values.begin(), values.end());
  return values;
}

Measured singular_mass_matrix(CaseRuns&) {
  const General general;
  const numeric::LagrangeSystem system = lagrange_system(general.body, general.state, general.wrench);
  const numeric::Vector7 values = eigenvalues(system.mass_matrix);
  const numeric::LagrangeAcceleration solved = solve(system);
  // Newton–Euler, written out: I ω̇′ = Aᵀ M − ω′ × I ω′.
  const Vector3& omega = general.state.angular_velocity;
  const Vector3 moment = general.state.attitude.conjugate() * general.wrench.moment;
  const Vector3 exact = general.body.inertia.inverse() * (moment - omega.cross(general.body.inertia * omega));
  constexpr double rounding = 1e-12;  // of an eigenvalue that is 0, over the largest
  const auto rank = std::count_if(values.begin(), values.end(), [&](double v) { return v > rounding * values[6]; });
  return erratum(
      values[0] / values[6], (solved.angular - exact).norm() / exact.norm(),
      fmt::format("smallest over largest eigenvalue of M; the next is {}", significant(values[1] / values[6], 2)), 7,
      static_cast<double>(rank));
}

/// ½ q̇ᵀ M q̇ with both rows of the block column, and with the printed one alone.
Measured block_column(CaseRuns&) {
  const General general;
  const numeric::LagrangeSystem system = lagrange_system(general.body, general.state, general.wrench);
  numeric::Vector7 rate;
  rate << general.state.velocity, system.beta_rate;
  const Vector3& omega = general.state.angular_velocity;
  const double exact =
      (general.body.mass * general.state.velocity.squaredNorm() + omega.dot(general.body.inertia * omega)) / 2;
  const double full = rate.dot(system.mass_matrix * rate) / 2;
  const double printed = rate.tail<4>().dot(system.mass_matrix.bottomRows<4>() * rate) / 2;
  return erratum(printed / exact, std::fabs(full / exact - 1),
                 "share of the kinetic energy that the printed block gives; it has 4 rows for 7 unknowns",
                 printed / exact, full / exact);
}

/// Acceleration of a point of the phone in free flight: the simulator's path, differentiated, less the part of ω̇′.
Measured centripetal_term(CaseRuns&) {
  const numeric::Body body = scene_of_case("phone-damped", {}).make_body();
  const numeric::MotionState state{.attitude = General().state.attitude, .angular_velocity = {2, -3, 1.5}};
  const numeric::FreeFlight flight(body, state, 0);
  const Vector3 u(0.3, 0.1, -0.2), &omega = state.angular_velocity;
  const auto place = [&](double time) -> Vector3 { return flight.at(time).attitude * u; };
  constexpr double h = 2e-3;  // rounding and the fourth-order formula's remainder balance here
  const Vector3 path = (16 * (place(h) + place(-h)) - place(2 * h) - place(-2 * h) - 30 * place(0)) / (12 * h * h);
  const Vector3 turning = numeric::NewtonEuler(body.mass(), body.inertia()).angular(omega, Vector3::Zero());
  const Vector3 exact = state.attitude.conjugate() * path - turning.cross(u);
  numeric::Matrix3 cross;
  cross << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
  const Vector3 right = cross * cross * u, printed = cross * cross.transpose() * u;
  const auto share = [&](const Vector3& form) { return form.dot(exact) / exact.squaredNorm(); };
  return erratum(share(printed), (right - exact).norm() / exact.norm(),
                 "ω̃ω̃ᵀu over the acceleration in free flight; ω̃ω̃u gives 1", share(printed), share(right));
}

Measured two_versions_of_figure_17(CaseRuns& case_runs) {
  const auto& text = case_runs.run("rod-at-1ms").impacts;
  const auto& caption = case_runs.run("rod-from-2m").impacts;
  // The lowest vertex of the rod lies L/2 sin θ + r cos θ below the centre at 45°.
  const double fall = 2 - (0.5 + 0.01) * std::sqrt(0.5), speed = std::sqrt(2 * 9.81 * fall);
  const double came = caption.at(0).value.approach_speed;
  const auto gaps = [](const auto& impacts) {
    return (impacts.at(2).value.start - impacts.at(1).value.start) /
           (impacts.at(1).value.start - impacts.at(0).value.start);
  };
  return erratum(
      came, std::fabs(came / speed - 1),
      fmt::format(
          "m/s at the first touch from 2 m, text 1; the third impact is apart, as described, only in the caption's: "
          "its interval is {} times the first (text: {})",
          significant(gaps(caption), 3), significant(gaps(text), 2)),
      1, came);
}

}  // namespace

CheckMeasures erratum_measures() {
  return {{"E1", sign_of_omega},
          {"E2", gravity_term},
          {"E3", factor_v},
          {"E4", relative_velocity},
          {"E5", second_fold},
          {"E6", third_fold},
          {"E7", centre_after_first},
          {"E8", singular_mass_matrix},
          {"E9", block_column},
          {"E10", centripetal_term},
          {"E11", two_versions_of_figure_17}};
}

}  // namespace clatter::validation
