// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/base/root_finder.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"

namespace clatter::analytic::detail {

namespace {

constexpr int budget = 80;

/// GSL's solvers of one thread, allocated once; its error handler, which would abort, is switched off
/// here and every status is looked at instead.
struct Workspace {
  Workspace() {
    gsl_set_error_handler_off();
    newton.reset(gsl_root_fdfsolver_alloc(gsl_root_fdfsolver_newton));
  }
  struct Free {
    void operator()(gsl_root_fdfsolver* s) const { gsl_root_fdfsolver_free(s); }
  };
  std::unique_ptr<gsl_root_fdfsolver, Free> newton;
};

Workspace& workspace() {
  thread_local Workspace space;
  return space;
}

/// @param value the function's last one
[[noreturn]] void give_up(int status, double value) {
  const std::string why = status != GSL_SUCCESS  ? gsl_strerror(status)
                          : std::isfinite(value) ? "after " + std::to_string(budget) + " steps"
                                                 : "the function is not finite";
  throw NumericalError("root-finder: no convergence (" + why + ")");
}

/// What GSL calls: evaluates, counts and remembers the last sample.
struct Evaluated {
  FunctionView f;
  int evaluations = 0;
  double at = 0;
  Sample last{};

  const Sample& sample(double x) {
    if (evaluations == 0 || x != at) {
      last = f(x);
      at = x;
      ++evaluations;
    }
    return last;
  }
  static double value(double x, void* evaluated) { return static_cast<Evaluated*>(evaluated)->sample(x).value; }
  static double slope(double x, void* evaluated) { return static_cast<Evaluated*>(evaluated)->sample(x).slope; }
  static void both(double x, void* evaluated, double* value, double* slope) {
    const Sample& sample = static_cast<Evaluated*>(evaluated)->sample(x);
    *value = sample.value;
    *slope = sample.slope;
  }
};

/// Where to bisect: by magnitude while the bracket spans several, since roots may be as small as 1e-300.
double middle(const Bracket& bracket) {
  constexpr double least = std::numeric_limits<double>::min();
  if (!(bracket.low >= 0 && bracket.high > 4 * bracket.low && bracket.high > least)) {
    return std::midpoint(bracket.low, bracket.high);
  }
  const int low = std::ilogb(std::fmax(bracket.low, least));
  const int high = std::ilogb(bracket.high);
  const double guess = std::ldexp(1.0, std::midpoint(low, high));
  return guess > bracket.low && guess < bracket.high ? guess : std::midpoint(bracket.low, bracket.high);
}

bool inside(const Bracket& bracket, double x) { return x > bracket.low && x < bracket.high; }

void narrow(Bracket& bracket, const Evaluated& evaluated, bool rising) {
  const bool below = (evaluated.last.value < 0) == rising;
  (below ? bracket.low : bracket.high) = evaluated.at;
}

}  // namespace

Root bracketed_root(FunctionView f, Bracket bracket, double guess, bool rising) {
  Evaluated evaluated{f};
  gsl_function_fdf function{&Evaluated::value, &Evaluated::slope, &Evaluated::both, &evaluated};
  gsl_root_fdfsolver* const solver = workspace().newton.get();
  double x = inside(bracket, guess) ? guess : middle(bracket);
  int status = gsl_root_fdfsolver_set(solver, &function, x);
  double previous_step = 0;
  for (int i = 0; status == GSL_SUCCESS && i < budget && std::isfinite(evaluated.last.value); ++i) {
    const double step = -evaluated.last.value / evaluated.last.slope;
    if (evaluated.last.value == 0 || std::fabs(evaluated.last.value) <= evaluated.last.noise) {
      return {x, evaluated.evaluations};
    }
    narrow(bracket, evaluated, rising);
    const double next = x + step;
    const bool stays = inside(bracket, next);
    // Convergence is quadratic: the step after this one is about step³/previous².
    const double ratio = previous_step == 0 ? 1 : step / previous_step;
    const double predicted = std::fabs(step) * ratio * ratio;
    if (stays && predicted <= 0.25 * epsilon * std::fabs(next)) return {next, evaluated.evaluations};
    if (next == x || bracket.high - bracket.low <= epsilon * std::fabs(x)) return {x, evaluated.evaluations};
    // Newton's steps may lead from one side of the root to the other without end.
    const bool returns = step * previous_step < 0 && std::fabs(step) > 0.75 * std::fabs(previous_step);
    if (stays && !returns) {
      status = gsl_root_fdfsolver_iterate(solver);
      x = gsl_root_fdfsolver_root(solver);
      previous_step = step;
    } else {
      x = middle(bracket);
      status = gsl_root_fdfsolver_set(solver, &function, x);
      previous_step = 0;
    }
  }
  give_up(status, evaluated.last.value);
}

}  // namespace clatter::analytic::detail
