// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/reports/extremes_report.hpp"

namespace clatter::validation::inline cli {
namespace {

struct ExtremesInput {
  std::vector<std::string> only;
  bool quick = false;
  std::optional<std::string> seed, seconds, plot;
  OutputTexts output;
};

std::vector<std::string> axis_names() {
  std::vector<std::string> names;
  for (const MapAxis& axis : map_axes()) names.push_back(axis.name);
  return names;
}

ExtremesOptions read_options(const ExtremesInput& input) {
  if (input.quick && !input.only.empty()) throw BadInput("--quick: excludes --only; give one of them, not both");
  for (const std::string& name : input.only) static_cast<void>(read_name_option("--only", name, axis_names()));
  ExtremesOptions options;
  options.axes = input.only;
  options.long_runs = !input.quick;
  if (input.seconds) {
    options.cell_seconds =
        read_number_option("--seconds", *input.seconds, {0, 3600, true, "greater than 0, at most 3600"});
  }
  if (input.seed)
    options.runs.seed = static_cast<std::uint64_t>(read_integer_option("--seed", *input.seed, 0, 2147483647));
  return options;
}

int run_extremes(const ExtremesInput& input) {
  ExtremesOptions options = read_options(input);
  const OutputChoice choice = read_output(input.output);
  check_files(choice, {{"--plot", input.plot.value_or("")}});
  std::optional<Sink> plot;
  if (input.plot) plot.emplace(*input.plot, "--plot");
  const CooperativeInterrupt interrupt;
  ExtremesMap map;
  {
    Progress progress;
    options.progress = [&](std::size_t done, std::size_t of) {
      progress.show(progress_bar(done, of));
      return !interrupt.requested();
    };
    map = measure_extremes(options);
  }
  if (plot && map.complete) {
    plot->write(extremes_picture(map));
    plot->commit();
  }
  write_report(choice, extremes_report(map));
  return map_status(map);
}

}  // namespace

Command extremes_command() {
  auto input = std::make_shared<ExtremesInput>();
  Command command{.name = "extremes", .help = "the map of what holds, to every quantity's ends"};
  command.add_list("--only", input->only, "AXIS", "these quantities, such as angle speed");
  command.add_flag("--quick", input->quick, "without the long runs (impacts, random scenes)");
  command.add_text("--seed", input->seed, "S", "of the random scenes (1)");
  command.add_text("--seconds", input->seconds, "S", "that a cell may take (1)");
  command.add_text("--plot", input->plot, "FILE", "also a picture, .svg");
  add_output_options(command, input->output);
  command.footer =
      "Example: clatter extremes --only angle restitution --plot extremes.svg\n"
      "Quantities: angle, stiffness, damping, restitution, ratio, friction, speed,\n"
      "gravity, size, mass, turns, impacts, squares, cubes, long.\n"
      "The table has one row per region, --format csv and json all cells. Each cell\n"
      "ends within a second with a number and its error or with a typed refusal;\n"
      "exit status 1 if one does not, or if an error is beyond its bound.";
  command.run = [input] { return run_extremes(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
