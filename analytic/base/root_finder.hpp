// SPDX-License-Identifier: GPL-3.0-or-later
// Roots of smooth functions of one variable by GSL, inside a bracket and with a count of evaluations.
#pragma once

namespace clatter::analytic::detail {

/// Value and derivative of a function, with the size of the value's rounding error.
struct Sample {
  double value = 0;
  double slope = 0;
  double noise = 0;
};

struct Bracket {
  double low = 0;
  double high = 0;
};

struct Root {
  double value = 0;
  int evaluations = 0;
};

/// A function by reference: no allocation, no template in the solver.
class FunctionView {
 public:
  template <class F>
  explicit FunctionView(const F& f)
      : object_(&f), call_([](const void* object, double x) { return (*static_cast<const F*>(object))(x); }) {}
  Sample operator()(double x) const { return call_(object_, x); }

 private:
  const void* object_;
  Sample (*call_)(const void*, double);
};

/// The root in `bracket` of a function that has one sign at the low end (`rising`: negative) and the
/// other at the high end.  GSL's Newton method from `guess`; where a step leaves what is left of the
/// bracket or takes back most of the one before, bisection isolates the root further first.  Stops when the step
/// predicted next is below half an ulp or the value below its rounding error.
/// @throws NumericalError after 80 evaluations, or if the function is not finite.
[[nodiscard]] Root bracketed_root(FunctionView f, Bracket bracket, double guess, bool rising);

}  // namespace clatter::analytic::detail
