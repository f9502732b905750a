// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/plot_options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/cli/scene_flags.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/reports/tradeoff_report.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation::inline cli {
namespace {

struct TradeoffInput {
  SceneFlags scene;
  OutputTexts output;
  PlotTexts plot;
};

int run_tradeoff(const TradeoffInput& input) {
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice choice = read_output(input.output);
  check_files(choice, plot_files(input.plot));
  if (scene.sweep)
    throw BadInput(fmt::format("{}: a sweep has no tradeoff; give --angle or leave out [sweep]", scene.path));
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  Tradeoff tradeoff;
  {
    Progress progress;
    TradeoffOptions options;
    options.progress = [&](std::size_t done, std::size_t of) {
      progress.show(progress_bar(done, of));
      return !interrupt.requested();
    };
    tradeoff = measure_tradeoff(scene, options);
  }
  write_report(choice, tradeoff_report(scene, tradeoff));
  if (interrupt.requested()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  plot.write(tradeoff_picture(scene, tradeoff), run_words("tradeoff", "cost against true error", scene));
  if (tradeoff.shortfall.empty()) return 0;
  say(tradeoff.shortfall);
  return exit_status(FailureKind::not_computed);
}

}  // namespace

Command tradeoff_command() {
  auto input = std::make_shared<TradeoffInput>();
  Command command{.name = "tradeoff", .help = "what accuracy costs: models, methods, tolerances"};
  add_scene_flags(command, input->scene);
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter tradeoff rod-45 --plot tradeoff.svg\n"
      "The table shows the front, --format csv all points.";
  command.run = [input] { return run_tradeoff(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
