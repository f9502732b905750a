#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "validation/cli/commands.hpp"
#include "validation/cli/history_file.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/simulation_report.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

using numeric::Outcome;
using numeric::Simulation;

struct Flag {
  const char *name, *key, *type, *help;
};

/// Flags and the keys of the scene file that they override.
constexpr Flag flags[] = {
    {"--angle", "drop.angle_deg", "DEG", "inclination at the first impact, end a low"},
    {"--tilt", "drop.tilt_deg", "DEG", "rotation about the body's long axis before that"},
    {"--speed", "drop.speed", "M/S", "downward speed of the centre of mass at the first touch"},
    {"--height", "drop.height", "M", "or its height at release from rest"},
    {"--tangential-velocity", "drop.tangential_velocity", "M/S", "of the centre of mass, to the right"},
    {"--spin", "drop.spin", "RAD/S", "clockwise, as Omega in Eq. 8"},
    {"--gravity", "world.gravity", "M/S2", "gravity"},
    {"--restitution", "impact.restitution", "E", "of the discrete model (kept, not used here)"},
    {"--restitution-law", "impact.law", "NAME", "of the discrete model (kept, not used here)"},
    {"--impulse-ratio", "impact.impulse_ratio", "MU_I", "of the discrete model (kept, not used here)"},
    {"--friction", "impact.friction", "MU", "of the discrete model (kept, not used here)"},
    {"--body", "body.shape", "rod|box|mesh", "shape of the body"},
    {"--mass", "body.mass", "KG", "mass"},
    {"--length", "body.length", "M", "of the rod"},
    {"--radius", "body.radius", "M", "of the rod"},
    {"--size", "body.size", "LxWxT", "of the box in m"},
    {"--stiffness", "ground.stiffness", "N/M3", "k_G"},
    {"--damping", "ground.damping", "N.S/M4", "c_G"},
    {"--static-friction", "ground.static_friction", "MU", "of the ground"},
    {"--sliding-friction", "ground.sliding_friction", "MU", "of the ground"},
    {"--area", "ground.area", "surface|projected", "area over which the load is integrated"},
    {"--impacts", "run.impacts", "N", "most impacts to report"},
    {"--digits", "run.digits", "N", "significant digits, 2 to 12"},
    {"--method", "run.method", "NAME", "auto, tvd-rk3, rk4, rkf45, rkck or rk8pd"},
    {"--step", "run.step", "S", "of tvd-rk3"},
    {"--history", "run.history", "FILE", "time history as CSV"},
};

struct SimulateInput {
  std::string file;
  std::vector<std::optional<std::string>> texts{std::size(flags)};
  bool planar = false;
  OutputTexts output;

  [[nodiscard]] std::vector<SceneOverride> overrides() const {
    std::vector<SceneOverride> given;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (texts[i]) given.push_back({flags[i].key, flags[i].name, *texts[i]});
    }
    return given;
  }
};

/// A line on stderr that renews itself, for runs that last.
class Progress {
 public:
  void show(const std::string& text) {
    if (!shows_progress()) return;
    shown_ = true;
    fmt::print(stderr, "\r\033[Kclatter: {}", text);
  }
  ~Progress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool shown_ = false;
};

constexpr long evaluations_before_progress = 200'000;

std::string bar(std::size_t done, std::size_t of) {
  constexpr std::size_t width = 30;
  const std::size_t filled = of > 0 ? width * done / of : 0;
  return std::string(filled, '#') + std::string(width - filled, '.') + fmt::format(" {} of {}", done, of);
}

Simulation run_scene(const SimulationScene& scene, const numeric::Body& body, const CooperativeInterrupt& interrupt,
                     const std::function<void(int, long)>& show, numeric::HistoryRecorder* history) {
  numeric::Options options = scene.options;
  options.history = history;
  options.progress = [&](int impacts, long evaluations) {
    if (evaluations >= evaluations_before_progress) show(impacts, evaluations);
    return !interrupt.requested();
  };
  const numeric::MotionState start = scene.start(body);
  if (history && scene.height) record_fall(*history, start, body.mass(), options.gravity, 20);
  return numeric::simulate(body, scene.ground, start, options);
}

void print(const OutputChoice& choice, const std::function<Json()>& json, const std::function<Table()>& records,
           const std::function<Table()>& table) {
  switch (choice.style.format) {
    case Format::json: write_out(choice, json_text(json())); break;
    case Format::csv: write_out(choice, table_text(records(), choice.style)); break;
    default: write_out(choice, table_text(table(), choice.style));
  }
}

/// 3 if there is no number at all because of what the run met.
int status_of(const Simulation& run) {
  switch (run.outcome) {
    case Outcome::interrupted: return interrupted_status;
    case Outcome::evaluation_limit:
    case Outcome::step_too_small:
    case Outcome::not_representable:
    case Outcome::flight_undecided:
      fmt::print(stderr, "clatter: {}: {}\n", outcome_name(run.outcome), run.message);
      return run.impacts.empty() ? 3 : 0;
    default: return 0;
  }
}

int run_single(const SimulationScene& scene, const numeric::Body& body, const OutputChoice& choice) {
  const CooperativeInterrupt interrupt;
  std::optional<HistoryFile> history;
  if (!scene.history.empty()) {
    history.emplace(scene.history, std::vector<std::string>{headline("simulate", "time history"),
                                                            "scene: " + scene.json().dump()});
  }
  Simulation run;
  {
    Progress progress;
    const auto show = [&](int impacts, long evaluations) {
      progress.show(fmt::format("{} force evaluations, {}", evaluations,
                                bar(static_cast<std::size_t>(impacts), static_cast<std::size_t>(scene.options.impacts))));
    };
    run = run_scene(scene, body, interrupt, show, history ? &*history : nullptr);
  }
  if (history) history->commit();
  print(choice, [&] { return simulation_json(scene, run); }, [&] { return simulation_records(scene, run); },
        [&] { return simulation_table(scene, run); });
  return status_of(run);
}

/// The scene with the swept quantity at one value.
SimulationScene at_value(const SimulationScene& scene, double value) {
  SimulationScene one = scene;
  if (scene.sweep->quantity == SceneSweep::Quantity::angle_deg) one.angle_deg = value;
  else one.ground.static_friction = one.ground.sliding_friction = value;
  return one;
}

int run_sweep(const SimulationScene& scene, const numeric::Body& body, const OutputChoice& choice) {
  const CooperativeInterrupt interrupt;
  const std::vector<double> values = scene.sweep->values();
  std::vector<SweptRun> runs;
  {
    Progress progress;
    for (const double value : values) {
      if (interrupt.requested()) break;
      if (runs.size() % 10 == 0) progress.show(bar(runs.size(), values.size()));
      SweptRun swept{value, at_value(scene, value), {}};
      swept.run = run_scene(swept.scene, body, interrupt, [](int, long) {}, nullptr);
      if (swept.run.outcome == Outcome::interrupted) break;
      runs.push_back(std::move(swept));
    }
  }
  print(choice, [&] { return sweep_json(scene, runs); }, [&] { return sweep_records(scene, runs); },
        [&] { return sweep_table(scene, runs); });
  if (runs.size() < values.size()) return interrupted_status;
  const bool any = std::any_of(runs.begin(), runs.end(), [](const SweptRun& swept) { return !swept.run.impacts.empty(); });
  if (any) return 0;
  fmt::print(stderr, "clatter: no impact could be computed: {}\n", runs.back().run.message);
  return 3;
}

int run_simulate(const SimulateInput& input) {
  std::vector<SceneOverride> overrides = input.overrides();
  SimulationScene scene = read_simulation_scene(input.file, overrides);
  if (input.planar) scene.options.planar = true;
  const OutputChoice choice = read_output(input.output);
  if (!choice.path.empty() && choice.path == scene.history) {
    throw BadInput(fmt::format("--history {}: must be another file than --output's", scene.history));
  }
  for (const auto& [option, file] : {std::pair{"--history", scene.history}, {"--output", choice.path}}) {
    if (!file.empty() && file == input.file) throw BadInput(fmt::format("{} {}: is the scene file", option, file));
  }
  const numeric::Body body = scene.make_body();
  return scene.sweep ? run_sweep(scene, body, choice) : run_single(scene, body, choice);
}

}  // namespace

Action add_simulate_command(CLI::App& app) {
  auto input = std::make_shared<SimulateInput>();
  CLI::App* command = app.add_subcommand("simulate", "drop of any body, continuous contact");
  command->add_option("SCENE", input->file, "scene file (TOML)")->required()->type_name("FILE");
  for (std::size_t i = 0; i < std::size(flags); ++i) {
    add_text(*command, flags[i].name, input->texts[i], flags[i].type, flags[i].help)
        ->group("Scene (each overrides its key in the file)");
  }
  command->add_flag("--planar", input->planar, "keep the motion in its plane")
      ->group("Scene (each overrides its key in the file)");
  add_output_options(*command, input->output);
  command->footer(
      "Example: clatter simulate validation/cases/phone-damped.toml --digits 8\n"
      "validation/cases/every-key.toml explains the keys of scene files.");
  return [input] { return run_simulate(*input); };
}

}  // namespace clatter::validation
