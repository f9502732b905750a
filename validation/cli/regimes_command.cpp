// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/plot_options.hpp"
#include "validation/cli/rod_options.hpp"
#include "validation/reports/regimes_report.hpp"

namespace clatter::validation::inline cli {
namespace {

struct RegimesInput {
  RegimesTexts texts;
  OutputTexts output;
  PlotTexts plot;
};

int run_regimes(const RegimesInput& input) {
  const OutputChoice choice = read_output(input.output);
  const FoundRegimes found = find_regimes(input.texts);
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  write_report(choice, found.report);
  if (plot.is_wanted()) {
    plot.write(regimes_picture(found.all, {found.name, found.words, found.logarithmic}, found.rod_words),
               found.script_head);
  }
  return 0;
}

}  // namespace

Command regimes_command() {
  auto input = std::make_shared<RegimesInput>();
  Command command{.name = "regimes", .help = "number of impacts and fold angles"};
  command.add_text("--over", input->texts.over, "gravity-number|restitution|impulse-ratio",
                   "what to vary (gravity-number)", "Range");
  add_sweep_options(command, input->texts.sweep, "value");
  command.add_flag("--log", input->texts.logarithmic, "values in geometric progression", "Range");
  add_rod_options(command, input->texts.rod);
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.add_text("--digits", input->texts.digits, "N", "significant digits in tables (8)", "Output");
  command.footer =
      "Example: clatter regimes --over restitution --from 0.2 --to 1 --step 0.1\n"
      "Of the thin rod in its plane, whose regimes end at folds of one angle. In space an attitude has three angles, "
      "and\n"
      "the number of impacts of its drops is a row of clatter sweep.";
  command.run = [input] { return run_regimes(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
