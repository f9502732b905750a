// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/program/commands.hpp"

#include "validation/sweep/sweep_run.hpp"

// The first program, which is there before the whole one is built, has the commands of a first table; of the others it
// knows the names and what they are for.
#ifdef CLATTER_FIRST_PROGRAM
#define WHOLE(make) nullptr
#else
#define WHOLE(make) make
#endif

namespace clatter::validation {
namespace {

struct Listed {
  const char* name;
  const char* help;
  Command (*make)();
};

// clang-format off
constexpr Listed listed[]{
    {"sequence", "impact sequence of a falling rod or box", sequence_command},
    {"angles", "contact angles and impulses of the thin rod", WHOLE(angles_command)},
    {"regimes", "number of impacts and fold angles", WHOLE(regimes_command)},
    {"atlas", "clattering close to flat, in closed form", WHOLE(atlas_command)},
    {"explain", "how impact N came about, step by step", explain_command},
    {"gradient", "derivatives of the state after each impact", WHOLE(gradient_command)},
    {"simulate", "drop of any body, continuous contact", WHOLE(simulate_command)},
    {"compare", "both models side by side, and why they differ", WHOLE(compare_command)},
    {"shock", "what the impacts do to points of the body, and response spectra", WHOLE(shock_command)},
    {"ground", "k_G and c_G from measurements of a drop, or from a layer", WHOLE(ground_command)},
    {"report", "one HTML page on a drop, to hand in", WHOLE(report_command)},
    {"sweep", "many scenes: grids or random values, rows as CSV", WHOLE(sweep_command)},
    {"map", "a picture of outcomes over two keys", WHOLE(map_command)},
    {"verify", "every claim of the paper, checked", WHOLE(verify_command)},
    {"figures", "the data of the paper's figures, a file each", WHOLE(figures_command)},
    {"plan", "the smallest model that serves, and its cost", WHOLE(plan_command)},
    {"tradeoff", "what accuracy costs: models, methods, tolerances", WHOLE(tradeoff_command)},
    {"extremes", "the map of what holds, to every quantity's ends", WHOLE(extremes_command)},
    {"benchmark", "certified problems, and answers of others", WHOLE(benchmark_command)},
    {"measured", "impact laws against tracked drops", WHOLE(measured_command)},
    {"demo", "a page to play with, in the browser", WHOLE(demo_command)},
    {"keys", "every key of scenes, its flag and default", WHOLE(keys_command)},
    {"columns", "every column of CSV and JSON, its unit and meaning", WHOLE(columns_command)},
    {"init", "a commented scene file to begin with", WHOLE(init_command)},
    {"completion", "print the completion script of a shell", WHOLE(completion_command)},
    {"man", "print the manual page (roff)", WHOLE(man_command)},
};
// clang-format on

}  // namespace

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = [] {
    std::vector<Command> all;
    for (const auto& [name, help, make] : listed) {
      all.push_back(make != nullptr ? make() : Command{});
      all.back().name = name;
      all.back().help = help;
    }
    return all;
  }();
  return commands;
}

void hand_over([[maybe_unused]] char** words) {
#ifndef CLATTER_FIRST_PROGRAM
  become_mpi_program(words);
#endif
}

}  // namespace clatter::validation
