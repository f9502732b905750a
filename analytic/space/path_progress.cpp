// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/path_progress.hpp"

#include <cmath>

#include "analytic/law/viscoelastic.hpp"

namespace clatter::analytic::space {

double PathProgress::excess(const Measure& m) const {
  if (stage_ != Stage::restitution) return m.normal_velocity;
  if (rule_.law == RestitutionLaw::newton) return m.normal_velocity - rule_.restitution;
  if (rule_.law == RestitutionLaw::poisson) return m.impulse - (1 + rule_.restitution) * compression;
  return -m.store;
}

double PathProgress::excess_rate(const Measure& m, double normal_rate) const {
  if (stage_ != Stage::restitution || rule_.law == RestitutionLaw::newton) return normal_rate;
  return rule_.law == RestitutionLaw::poisson ? 1 : -storing(m.normal_velocity);
}

void PathProgress::end_stage() {
  if (stage_ == Stage::compression) {
    compression = at.impulse;
    at.normal_velocity = 0;
    const double e = rule_.law == RestitutionLaw::viscoelastic ? 1 : rule_.restitution;
    at.store *= e * e;
    stage_ = e > 0 ? Stage::restitution : Stage::done;
    return;
  }
  if (stage_ == Stage::overtime) at.normal_velocity = 0;
  else if (rule_.law == RestitutionLaw::newton) at.normal_velocity = rule_.restitution;
  const bool approaches = rule_.law == RestitutionLaw::poisson && at.normal_velocity < 0;
  stage_ = approaches ? Stage::overtime : Stage::done;
}

double PathProgress::length_of_stage(double normal_rate) const {
  const double u = at.normal_velocity;
  if (stage_ == Stage::restitution && rule_.law == RestitutionLaw::poisson) {
    return (1 + rule_.restitution) * compression - at.impulse;
  }
  if (!(normal_rate > 0)) return std::numeric_limits<double>::infinity();
  if (stage_ != Stage::restitution) return -u / normal_rate;
  if (rule_.law == RestitutionLaw::newton) return (rule_.restitution - u) / normal_rate;
  const double separation =
      separation_speed(rule_.damping, Unloading<>{.from = u, .slope = normal_rate, .work = at.store});
  return std::fmax(separation - u, 0.0) / normal_rate;
}

void PathProgress::advance(const Line& line, double length) {
  const double u = at.normal_velocity;
  const double next = u + line.normal_rate * length;
  if (is_energetic()) at.store += stored_work(rule_.damping, {.from = u, .to = next, .length = length});
  at.normal_velocity = next;
  at.impulse += length;
  friction += length * line.ratio;
}

void PathProgress::follow(const Line& line) {
  double left = line.length;
  while (!is_done()) {
    const double length = length_of_stage(line.normal_rate);
    if (!(length <= left)) break;
    advance(line, length);
    end_stage();
    left -= length;
  }
  if (!is_done() && left < std::numeric_limits<double>::infinity()) advance(line, left);
}

}  // namespace clatter::analytic::space
