// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/step_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/estimated.hpp"
#include "validation/record/names.hpp"

namespace clatter::validation::inline reports {

Step missing_impact(int n, const SequenceEnd& end) {
  Step step{fmt::format("Impact {} does not happen", n),
            fmt::format("The sequence has {} impact{}. It ends with {}: {}.", end.impacts, end.impacts == 1 ? "" : "s",
                        outcome_name(end.outcome), end.message),
            {}};
  const analytic::NearMiss& miss = end.near_miss;
  if (end.outcome == analytic::Outcome::no_further_impact && std::isfinite(miss.clearance)) {
    step.equations.push_back(
        {"clearance", "least height of a vertex at a turning point", "", miss.clearance, "m", miss.margin});
    step.equations.push_back({"margin", "rounding error of that height", "", miss.margin, "m"});
  }
  return step;
}

void StepWriter::add(Equation equation) {
  if (equation.error == 0) equation.error = relative_ * std::max(std::fabs(equation.value), equation.size);
  steps_.back().equations.push_back(std::move(equation));
}

void StepWriter::add_vector(const std::string& name, const std::string& prime, const std::string& formula,
                            const Eigen::Vector3d& vector, const std::string& unit) {
  for (int k = 0; k < 3; ++k) {
    add({.name = fmt::format("{}_{}{}", name, "xyz"[k], prime),
         .formula = formula,
         .value = vector[k],
         .unit = unit,
         .size = vector.norm()});
  }
}

std::string StepWriter::number(double value, double size) const {
  const double error = relative_ * std::max(std::fabs(value), size);
  const std::string text = known_text({value, error}, {.digits = digits_, .size = size});
  return text.starts_with("-") ? "(" + text + ")" : text;
}

std::string StepWriter::product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    text += fmt::format("{}{}·{}", k > 0 ? " + " : "", number(a[k], a.norm()), number(b[k], b.norm()));
  }
  return text;
}

}  // namespace clatter::validation::inline reports
