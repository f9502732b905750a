// SPDX-License-Identifier: GPL-3.0-or-later
// Siconos: time stepping of Moreau and Jean.  default: theta = 1/2, one Newton step; tuned: Newton iterated.
#include <unistd.h>

#include "siconos_points.hpp"

namespace {

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  problem.require_plane("the adapter is written for the plane");
  // Newton's method is iterated for a system that is not known as linear.
  const std::shared_ptr<LagrangianDS> body = problem.tuned() ? league::falling_body<LagrangianDS>(problem)
                                                             : league::falling_body<LagrangianLinearTIDS>(problem);
  const auto world = league::over_floor(problem, body);
  const auto integrator = std::make_shared<MoreauJeanOSI>(0.5);
  SP::OneStepNSProblem impacts;
  if (problem.friction > 0) {
    impacts = std::make_shared<FrictionContact>(2);
  } else {
    impacts = std::make_shared<LCP>();
  }
  const auto steps = std::make_shared<TimeDiscretisation>(0, problem.step);
  const auto stepping = std::make_shared<TimeStepping>(world, steps, integrator, impacts);
  if (problem.tuned()) {  // TimeStepping.hpp; the relations are not linear in the angle
    stepping->setNewtonTolerance(1e-10);
    stepping->setNewtonMaxIteration(50);
  }
  bool first = true;
  trajectory.record(
      [&] {
        if (!first) stepping->nextStep();
        first = false;
        stepping->computeOneStep();
      },
      [&] { league::add_row(problem, *body, trajectory); });
}

}  // namespace

int main() {
  const int status = league::run_all({"Siconos, Moreau-Jean", SICONOS_VERSION}, simulate);
  std::fflush(nullptr);
  _exit(status);  // its destructors of static objects fail after a run
}
