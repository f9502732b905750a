// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/rod_options.hpp"

namespace clatter::validation::inline cli {

void add_rod_options(Command& command, RodTexts& t) {
  const auto add = [&](const char* name, std::optional<std::string>& text, const char* type, const char* help) {
    command.add_text(name, text, type, help, "Rod");
  };
  add("--gravity-number", t.gravity_number, "G", "G = g L/v_n^2 (0)");
  add("--gravity", t.gravity, "M/S2", "or gravity, with --length and --speed (0)");
  add("--length", t.length, "M", "of the rod, for --gravity (1)");
  add("--speed", t.speed, "M/S", "|v_n| at the first impact, for --gravity (1)");
  add("--restitution", t.restitution, "E", "coefficient of restitution, 0 to 1 (1)");
  add("--impulse-ratio", t.impulse_ratio, "MU_I", "Eq. 8's ratio of tangential to normal impulse (0)");
}

}  // namespace clatter::validation::inline cli
