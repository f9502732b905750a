// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/explain/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/base/angle.hpp"
#include "validation/explain/steps.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

/// Why impact n of a run does not happen.
Step missing_impact(const Run& run, int n) {
  const std::size_t have = run.impacts.size();
  Step step{fmt::format("Impact {} does not happen", n),
            {fmt::format("The sequence has {} impact{}. It ends with {}: {}.", have, have == 1 ? "" : "s", run.outcome,
                         run.message)}};
  if (!run.near_miss || !std::isfinite(run.near_miss->clearance)) return step;
  const analytic::NearMiss& miss = *run.near_miss;
  step.equations.push_back({.quantity = number("h_least", miss.clearance, "m", miss.margin),
                            .words = {"clearance, the least height of a vertex at a turning point"}});
  step.equations.push_back(
      {.quantity = number("Δh", miss.margin, "m"), .words = {"margin, the rounding error of that height"}});
  return step;
}

std::string restitution_words(const analytic::ImpactLaw& law) {
  switch (law.law) {
    case analytic::RestitutionLaw::newton: return "Newton's coefficient of restitution";
    case analytic::RestitutionLaw::poisson: return "Poisson's coefficient of restitution";
    case analytic::RestitutionLaw::stronge: return "Stronge's coefficient of restitution";
    case analytic::RestitutionLaw::viscoelastic: break;
  }
  return "";
}

}  // namespace

Explanation explain_impact(const PreparedScene& prepared, int n) {
  Scene scene = prepared.scene;
  scene.request.impacts = std::max(scene.request.impacts, n);
  const auto explained = [&](const auto& drop) -> Explanation {
    const auto sequence = impact_sequence(drop, {.impacts = n, .digits = scene.accuracy.digits});
    const Run run = run_of(sequence);
    const bool has_impact = static_cast<std::size_t>(n) <= sequence.rows.size();
    const bool falls_short = scene.require_digits || !has_impact;
    return {.scene = scene,
            .impact = n,
            .approach_speed = first_approach_speed(prepared.drop),
            .steps = has_impact ? impact_steps(scene, drop, sequence, n) : std::vector<Step>{missing_impact(run, n)},
            .warnings = sequence.warnings,
            .shortfall = falls_short ? shortfall(scene, run) : "",
            .shortfall_status = shortfall_status(run)};
  };
  return std::visit(explained, prepared.drop);
}

Quantity number(const Symbol& symbol, double value, const std::string& unit, double error, double size) {
  return {symbol, Eigen::MatrixXd::Constant(1, 1, value), unit, error, size};
}

Quantity StepWriter::with_error(Quantity quantity) const {
  if (quantity.value.size() > 1 && quantity.size == 0) quantity.size = quantity.value.norm();
  const double largest = std::max(quantity.value.cwiseAbs().maxCoeff(), quantity.size);
  if (quantity.error == 0 && largest > 0) quantity.error = relative_ * largest;
  return quantity;
}

void StepWriter::say(const Words& words) {
  Words& all = steps_.back().words;
  all.insert(all.end(), words.begin(), words.end());
}

Quantity StepWriter::given(const Quantity& exact, const Words& words) {
  steps_.back().equations.push_back({exact, {}, words});
  return exact;
}

Quantity StepWriter::found(const Quantity& quantity, const Words& words) { return given(with_error(quantity), words); }

Quantity StepWriter::found(const Quantity& quantity, const Expression& formula, const Words& words) {
  const Quantity known = with_error(quantity);
  steps_.back().equations.push_back({known, {formula}, words});
  return known;
}

Quantity StepWriter::computed(const Symbol& symbol, const std::string& unit, const Expression& formula,
                              const Words& words, double size) {
  Quantity quantity{symbol, evaluated(formula), unit, 0, size};
  if (unit == "°") quantity.value *= analytic::degrees_per_radian;
  return found(quantity, formula, words);
}

Given write_body(StepWriter& writer, double mass, double gravity) {
  writer.open("What is given", {});
  const Quantity m = writer.given(number("m", mass, "kg"), {"mass"});
  const Quantity g = number("g", gravity, "m/s²");
  if (gravity > 0) writer.given(g, {"gravity"});
  return {.mass = m, .gravity = g};
}

void write_law(StepWriter& writer, const Scene& scene, const analytic::ImpactLaw& law, Given& given) {
  if (law.law == analytic::RestitutionLaw::viscoelastic) {
    const double stiffness = scene.world.ground.stiffness, damping = scene.world.ground.damping;
    const Quantity tau = number("τ", law.damping_per_stiffness, "s/m");
    if (stiffness > 0 && damping / stiffness == law.damping_per_stiffness) {
      const Quantity k = writer.given(number("k_G", stiffness, "N/m³"), {"stiffness of the ground"});
      const Quantity c = writer.given(number("c_G", damping, "N·s/m⁴"), {"its damping"});
      given.damping_time = writer.found(tau, c / k, {"from which the restitution follows at each speed"});
    } else {
      given.damping_time = writer.given(tau, {"damping over stiffness of the ground, c_G/k_G"});
    }
  } else {
    given.restitution = writer.given(number("e", law.restitution, ""), {restitution_words(law)});
  }
  const Quantity coefficient = number("μ", law.friction_value, "");
  if (law.friction == analytic::FrictionKind::coulomb && law.friction_value > 0)
    given.friction = writer.given(coefficient, {"Coulomb's coefficient of friction"});
  if (law.friction == analytic::FrictionKind::impulse_ratio)
    given.impulse_ratio =
        writer.given(number("μ_i", law.friction_value, ""), {"impulse ratio, tangential over normal"});
}

Quantity write_restitution(StepWriter& writer, const Given& given, const Quantity& u, double value) {
  if (given.restitution) return *given.restitution;
  const Quantity e = number("e", value, "", 0, 1), zeta = number("ζ", 0, "");
  writer.open("Restitution from the ground's damping",
              {"The ground's springs and dampers act together as the contact sinks in, and let go of it when they no "
               "longer push. The damping number ",
               zeta, " is that of the speed of approach; the coefficient of restitution ", e,
               " solves the equation below, by the function of Lambert."});
  writer.law(function("ln", (1 + Expression(zeta)) / (1 - Expression(zeta) * e)),
             Expression(zeta) * (1 + Expression(e)));
  const Quantity s = writer.computed("ζ", "", -(Expression(*given.damping_time) * u));
  if (evaluated(s)(0, 0) == 0) return writer.found(e, {"a ground without damping gives all back"});
  const Expression sum = 1 + Expression(s);
  return writer.found(e, (1 + function("W_0", -(sum * function("exp", -sum)))) / s);
}

void write_fall(StepWriter& writer, const Scene& scene, const Given& given, const Quantity& z, const Quantity& speed) {
  if (scene.clearance) {
    const Quantity c = writer.given(number("H", *scene.clearance, "m"), {"height of the lowest point at release"});
    writer.found(speed, -function("√", 2 * Expression(given.gravity) * c),
                 {"velocity of the centre of mass along the normal, after the fall"});
    return;
  }
  if (!scene.height || !(given.gravity.value(0, 0) > 0)) {
    writer.given(speed, {"velocity of the centre of mass along the normal, before"});
    return;
  }
  const Quantity h = writer.given(number("H", *scene.height, "m"), {"height of the centre of mass at release"});
  const Expression fall = 2 * Expression(given.gravity) * (h - Expression(z));
  writer.found(speed, -function("√", fall), {"velocity of the centre of mass along the normal, after the fall"});
}

void write_energy(StepWriter& writer, const Words& words, const Energies& energies) {
  writer.open("Energy", words);
  writer.found(energies.before_value, energies.before, {"energy before"});
  writer.found(energies.after_value, energies.after, {"energy after"});
  writer.found(energies.loss_value, energies.loss, {"energy that the impact took, the difference of both"});
}

}  // namespace clatter::validation
