// SPDX-License-Identifier: GPL-3.0-or-later
// Siconos: event-driven integration with LSODAR, which locates each impact.  A row stands at each event.
#include <unistd.h>

#include "siconos_points.hpp"

namespace {

void record_events(const league::Problem& problem, EventDriven& simulation, LagrangianDS& body,
                   league::Trajectory& trajectory) {
  double time = 0;
  trajectory.own_time = time;
  league::add_row(problem, body, trajectory);
  while (simulation.hasNextEvent()) {
    const auto before = std::chrono::steady_clock::now();
    simulation.advanceToEvent();
    simulation.processEvents();
    trajectory.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (!(simulation.startingTime() > time)) continue;
    trajectory.own_time = time = simulation.startingTime();
    league::add_row(problem, body, trajectory);
  }
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  problem.require_plane("the adapter is written for the plane");
  if (problem.friction > 0) throw league::Unsupported("this integrator takes no friction");
  const auto body = league::falling_body<LagrangianDS>(problem);
  const auto world = league::over_floor(problem, body);
  const auto integrator = std::make_shared<LsodarOSI>();
  const auto simulation = std::make_shared<EventDriven>(world, std::make_shared<TimeDiscretisation>(0, problem.step));
  simulation->insertIntegrator(integrator);
  // LsodarOSI.hpp: 10 and 100 times the machine's precision, as default tolerances, relative and absolute.
  simulation->insertNonSmoothProblem(std::make_shared<LCP>(), SICONOS_OSNSP_ED_IMPACT);
  simulation->insertNonSmoothProblem(std::make_shared<LCP>(), SICONOS_OSNSP_ED_SMOOTH_ACC);
  simulation->initialize();
  record_events(problem, *simulation, *body, trajectory);
}

}  // namespace

int main() {
  const int status = league::run_all({"Siconos, event-driven", SICONOS_VERSION}, simulate);
  std::fflush(nullptr);
  _exit(status);  // its destructors of static objects fail after a run
}
