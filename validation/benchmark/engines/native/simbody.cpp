// SPDX-License-Identifier: GPL-3.0-or-later
// Simbody: rigid contact of points with a plane, SemiExplicitEulerTimeStepper.  Rod's ends and box's corners are
// points.
#include <Simbody.h>
#include <unistd.h>

#include "problem.hpp"

namespace {

using SimTK::Vec3;

Vec3 vector(const league::Vector3& v) { return {v[0], v[1], v[2]}; }
league::Vector3 array(const Vec3& v) { return {v[0], v[1], v[2]}; }

void add_contacts(const league::Problem& problem, SimTK::SimbodyMatterSubsystem& matter,
                  SimTK::MobilizedBody::Free& body) {
  const double e = problem.restitution, mu = problem.friction;
  for (const league::Vector3& point : league::contact_points(problem)) {
    if (mu > 0) {
      matter.adoptUnilateralContact(
          new SimTK::PointPlaneContact(matter.Ground(), SimTK::ZAxis, 0, body, vector(point), e, mu, mu, 0));
    } else {
      matter.adoptUnilateralContact(
          new SimTK::PointPlaneFrictionlessContact(matter.Ground(), SimTK::ZAxis, 0, body, vector(point), e));
    }
  }
}

void use_tuned_settings(SimTK::SemiExplicitEulerTimeStepper& stepper) {
  using Stepper = SimTK::SemiExplicitEulerTimeStepper;
  // SemiExplicitEulerTimeStepper.h: the defaults are Poisson's restitution, the solver PLUS, simultaneous impacts and
  // thresholds of speed for capture and for the coefficient's least value.
  stepper.setImpulseSolverType(Stepper::PGS);
  stepper.setRestitutionModel(Stepper::Newton);
  stepper.setInducedImpactModel(Stepper::Sequential);
  stepper.setMaxInducedImpactsPerStep(5);
  stepper.setConstraintTolerance(1e-9);
  stepper.setDefaultImpactCaptureVelocity(1e-6);
  stepper.setDefaultImpactMinCORVelocity(1e-6);
  stepper.setDefaultFrictionTransitionVelocity(1e-6);
}

/// Debian's build writes a trace of each step to standard output, where the report belongs.
class SilentOutput {
 public:
  SilentOutput() : kept_(dup(1)) {
    std::fflush(stdout);
    if (!std::freopen("/dev/null", "w", stdout)) throw std::runtime_error("cannot open /dev/null");
  }
  ~SilentOutput() {
    std::cout.flush();
    std::fflush(stdout);
    dup2(kept_, 1);
    close(kept_);
  }
  SilentOutput(const SilentOutput&) = delete;
  SilentOutput& operator=(const SilentOutput&) = delete;

 private:
  int kept_;
};

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  const SilentOutput silent;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  if (problem.gravity > 0) SimTK::Force::Gravity(forces, matter, -SimTK::ZAxis, problem.gravity);
  const auto& inertia = problem.inertia;
  const SimTK::Body::Rigid mass(
      SimTK::MassProperties(problem.mass, Vec3(0), SimTK::Inertia(inertia[0], inertia[1], inertia[2])));
  SimTK::MobilizedBody::Free body(matter.Ground(), SimTK::Transform(), mass, SimTK::Transform());
  add_contacts(problem, matter, body);
  system.realizeTopology();
  SimTK::State start = system.getDefaultState();
  const auto& q = problem.attitude;
  const SimTK::Rotation attitude(SimTK::Quaternion(q[0], q[1], q[2], q[3]));
  // The points have no radius, so the body starts lower than one with spheres.
  body.setQToFitTransform(start, SimTK::Transform(attitude, vector(problem.position) - Vec3(0, 0, problem.radius)));
  body.setUToFitVelocity(start, SimTK::SpatialVec(vector(problem.angular_velocity), vector(problem.velocity)));
  SimTK::SemiExplicitEulerTimeStepper stepper(system);
  if (problem.tuned()) use_tuned_settings(stepper);
  if (!problem.tuned()) trajectory.law = "poisson routh";
  stepper.initialize(start);
  int steps = 0;
  trajectory.record([&] { stepper.stepTo(++steps * problem.step); },
                    [&] {
                      const SimTK::State& now = stepper.getState();
                      system.realize(now, SimTK::Stage::Velocity);
                      const SimTK::Quaternion at = body.getBodyRotation(now).convertRotationToQuaternion();
                      trajectory.add_spatial(array(body.getBodyOriginLocation(now) + Vec3(0, 0, problem.radius)),
                                             {at[0], at[1], at[2], at[3]}, array(body.getBodyOriginVelocity(now)),
                                             array(body.getBodyAngularVelocity(now)));
                    });
}

}  // namespace

int main() {
  int major = 0, minor = 0, build = 0;
  SimTK_version_simbody(&major, &minor, &build);
  return league::run_all({"Simbody", std::to_string(major) + '.' + std::to_string(minor)}, simulate);
}
