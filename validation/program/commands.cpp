// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/program/program.hpp"

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
  const char* section;
  const char* name;
  const char* help;
  Command (*make)();
  const char* was = "";
};

constexpr const char* one_drop = "One drop";
constexpr const char* many_drops = "Many drops";
constexpr const char* on_parts = "Shock";
constexpr const char* checking = "Check";
constexpr const char* learning = "Learn";

// clang-format off
constexpr Listed listed[]{
    {one_drop, "sequence", "impact sequence of a falling body, discrete model", sequence_command},
    {one_drop, "simulate", "drop of any body, continuous contact", WHOLE(simulate_command)},
    {one_drop, "compare", "both models side by side, and why they differ", WHOLE(compare_command)},
    {one_drop, "explain", "how impact N came about, step by step", explain_command},
    {one_drop, "gradient", "derivatives of the state after each impact", WHOLE(gradient_command)},
    {many_drops, "sweep", "many scenes: grids or random values, rows as CSV", WHOLE(sweep_command)},
    {many_drops, "map", "a picture of outcomes over two keys", WHOLE(map_command)},
    {many_drops, "angles", "contact angles and impulses of the thin rod", WHOLE(angles_command)},
    {many_drops, "angles --regimes", "number of impacts and fold angles", WHOLE(regimes_command), "regimes"},
    {many_drops, "atlas", "clattering close to flat, in closed form", WHOLE(atlas_command)},
    {on_parts, "report", "one HTML page on a drop, to hand in", WHOLE(report_command)},
    {on_parts, "shock", "what the impacts do to points of the body, and response spectra", WHOLE(shock_command)},
    {on_parts, "shock --ground", "k_G and c_G from measurements of a drop, or from a layer", WHOLE(ground_command), "ground"},
    {checking, "verify", "every claim of the paper, checked", WHOLE(verify_command)},
    {checking, "verify --figures", "the data of the paper's figures, a file each", WHOLE(figures_command), "figures"},
    {checking, "verify --extremes", "the map of what holds, to every quantity's ends", WHOLE(extremes_command), "extremes"},
    {checking, "plan", "the smallest model that serves, and its cost", WHOLE(plan_command)},
    {checking, "plan --tradeoff", "what accuracy costs: models, methods, tolerances", WHOLE(tradeoff_command), "tradeoff"},
    {checking, "benchmark", "certified problems, and answers of others", WHOLE(benchmark_command)},
    {checking, "measured", "impact laws against tracked drops", WHOLE(measured_command)},
    {learning, "help", "what a command does, or help scene, help keys, help columns", help_command},
    {learning, "help keys", "every key of scenes, its flag and default", WHOLE(keys_command), "keys"},
    {learning, "help columns", "every column of CSV and JSON, its unit and meaning", WHOLE(columns_command), "columns"},
    {learning, "init", "a commented scene file to begin with", WHOLE(init_command)},
    {learning, "demo", "a page to play with, in the browser", WHOLE(demo_command)},
    {learning, "completion", "print the completion script of a shell", WHOLE(completion_command)},
    {learning, "man", "print the manual page (roff)", WHOLE(man_command)},
};
// clang-format on

}  // namespace

const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = [] {
    std::vector<Command> all;
    for (const auto& [section, name, help, make, was] : listed) {
      all.push_back(make != nullptr ? make() : Command{});
      all.back().section = section;
      all.back().name = name;
      all.back().help = help;
      all.back().was = was;
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
