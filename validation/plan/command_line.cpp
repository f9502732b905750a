// SPDX-License-Identifier: GPL-3.0-or-later
// The command that runs a plan's choice.
#include <fmt/format.h>

#include "validation/output/number.hpp"
#include "validation/output/shell_word.hpp"
#include "validation/plan/plan.hpp"

namespace clatter::validation::inline plan {
std::string command_line(const Plan& plan) {
  const Scene& scene = plan.scene;
  std::string line = fmt::format("clatter {} {}", is_continuous(plan.choice.level) ? "simulate" : "compare",
                                 shell_word(name_of_source(scene.path)));
  if (!is_continuous(plan.choice.level)) return line;
  line += fmt::format(" --method {} --tolerance {}", method_name(plan.choice.method), shortest(plan.choice.tolerance));
  if (plan.choice.level == ModelLevel::planar && !scene.world.planar) line += " --planar";
  for (const WeighedPart& part : plan.parts) {
    if (part.left_out && part.part == Part::friction) line += " --static-friction 0 --sliding-friction 0";
    if (part.left_out && part.part == Part::damping) line += " --damping 0";
  }
  return line;
}

}  // namespace clatter::validation::inline plan
