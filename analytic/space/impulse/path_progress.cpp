// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/path_progress.hpp"

#include "analytic/law/viscoelastic.hpp"

namespace clatter::analytic::space {

template <class Number>
double PathProgress<Number>::excess_rate(const Measure<>& m, double normal_rate) const {
  if (stage_ != Stage::restitution || rule_.law == RestitutionLaw::newton) return normal_rate;
  return rule_.law == RestitutionLaw::poisson ? 1 : -storing(m.normal_velocity);
}

template <class Number>
void PathProgress<Number>::end_stage() {
  if (stage_ == Stage::compression) {
    compression = at.impulse;
    at.normal_velocity = 0;
    const double e = rule_.law == RestitutionLaw::viscoelastic ? 1 : rule_.restitution;
    at.store = e * e * at.store;
    stage_ = e > 0 ? Stage::restitution : Stage::done;
    return;
  }
  if (stage_ == Stage::overtime) at.normal_velocity = 0;
  else if (rule_.law == RestitutionLaw::newton) at.normal_velocity = rule_.restitution * approach_;
  const bool approaches = rule_.law == RestitutionLaw::poisson && at.normal_velocity < 0;
  stage_ = approaches ? Stage::overtime : Stage::done;
}

template <class Number>
Number PathProgress<Number>::length_of_stage(const Number& normal_rate) const {
  const Number u = at.normal_velocity;
  if (stage_ == Stage::restitution && rule_.law == RestitutionLaw::poisson) {
    return (1 + rule_.restitution) * compression - at.impulse;
  }
  if (!(normal_rate > 0)) return std::numeric_limits<double>::infinity();
  if (stage_ != Stage::restitution) return -u / normal_rate;
  if (rule_.law == RestitutionLaw::newton) return (rule_.restitution * approach_ - u) / normal_rate;
  const Number rise =
      separation_speed(rule_.damping, Unloading<Number>{.from = u, .slope = normal_rate, .work = at.store}) - u;
  return rise > 0 ? rise / normal_rate : Number(0);
}

template <class Number>
void PathProgress<Number>::advance(const Line& line, const Number& length) {
  const Number u = at.normal_velocity;
  const Number next = u + line.normal_rate * length;
  if (is_energetic()) {
    at.store = at.store + stored_work(rule_.damping, ImpulseStretch<Number>{.from = u, .to = next, .length = length});
  }
  at.normal_velocity = next;
  at.impulse = at.impulse + length;
  for (std::size_t i = 0; i < 2; ++i) friction[i] = friction[i] + length * line.ratio[i];
}

template <class Number>
void PathProgress<Number>::follow(const Line& line) {
  Number left = line.length;
  while (!is_done()) {
    const Number length = length_of_stage(line.normal_rate);
    if (!(length <= left)) break;
    advance(line, length);
    end_stage();
    left = left - length;
  }
  if (!is_done() && left < std::numeric_limits<double>::infinity()) advance(line, left);
}

template class PathProgress<double>;
template class PathProgress<PathDual>;

}  // namespace clatter::analytic::space
