#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/cli/scene_flags.hpp"
#include "validation/cli/tradeoff_report.hpp"
#include "validation/figures/drawing.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

struct TradeoffInput {
  SceneFlags scene;
  std::optional<std::string> plot;
  OutputTexts output;
};

int run_tradeoff(const TradeoffInput& input) {
  const SimulationScene scene = read_scene_flags(input.scene);
  const OutputChoice choice = read_output(input.output);
  refuse_scene_file(input.scene, "--output", choice.path);
  if (scene.sweep)
    throw BadInput(fmt::format("{}: a sweep has no tradeoff; give --angle or leave out [sweep]", scene.path));
  if (input.plot && *input.plot == choice.path)
    throw BadInput(fmt::format("--plot {}: must be another file than --output's", *input.plot));
  std::optional<Sink> plot;
  if (input.plot) {
    refuse_scene_file(input.scene, "--plot", *input.plot);
    plot.emplace(*input.plot, "--plot");
  }
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
  if (plot && !interrupt.requested()) {
    plot->write(draw(tradeoff_figure(scene, tradeoff)).at(0));
    plot->commit();
  }
  write_report(
      choice, [&] { return tradeoff_json(scene, tradeoff); }, [&] { return tradeoff_records(scene, tradeoff); },
      [&] { return tradeoff_table(scene, tradeoff); });
  return interrupt.requested() ? interrupted_status : 0;
}

}  // namespace

Action add_tradeoff_command(CLI::App& app) {
  auto input = std::make_shared<TradeoffInput>();
  CLI::App* command = app.add_subcommand("tradeoff", "what accuracy costs: models, methods, tolerances");
  add_scene_flags(*command, input->scene);
  add_text(*command, "--plot", input->plot, "FILE", "also a picture (SVG)");
  add_output_options(*command, input->output);
  command->footer(
      "Example: clatter tradeoff validation/cases/rod-45.toml --plot tradeoff.svg\n"
      "The table shows the front, --format csv all points.");
  return [input] { return run_tradeoff(*input); };
}

}  // namespace clatter::validation
