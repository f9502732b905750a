// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/shock/measured_shock.hpp"
#include "validation/shock/shock_history.hpp"
#include "validation/shock/shock_options.hpp"
#include "validation/shock/shock_pulses.hpp"
#include "validation/shock/shock_report.hpp"

namespace clatter::validation {
namespace {

const char* const shock_summary = "shock at points of the body";

struct ShockCommandInput : ShockInput {
  std::string measured;  ///< a record in place of a drop; empty: none
  std::string columns;   ///< of it, divided by commas
  std::string against;   ///< a scene to stand beside it
  std::string required;  ///< a file of breakpoints; empty: none
  OutputChoice output;
  PlotChoice plot;
};

const std::vector<std::string> unit_options{"g", "m/s2"};

bool is_of_acceleration(const std::string& unit) {
  return std::find(unit_options.begin(), unit_options.end(), unit) != unit_options.end();
}

/// --unit is a record's, unless it is that of the mesh of a scene beside it.
std::optional<AccelerationUnit> record_unit(const ShockCommandInput& input) {
  const std::string& unit = input.scene.texts.at("--unit");
  const bool has_scene = !input.against.empty() || !input.scene.source.empty() || is_given(input.scene, "--mesh");
  if (unit.empty() || (has_scene && !is_of_acceleration(unit))) return std::nullopt;
  return static_cast<AccelerationUnit>(read_name_option("--unit", unit, unit_options));
}

/// The drop beside a record.
ShockInput drop_beside(const ShockCommandInput& input) {
  ShockInput drop = input;
  if (std::string& unit = drop.scene.texts.at("--unit"); is_of_acceleration(unit)) unit.clear();
  if (!input.against.empty() && !input.scene.source.empty())
    throw BadInput("--against: a scene is given already; give one of them, not both");
  if (!input.against.empty()) drop.scene.source = input.against;
  return drop;
}

/// The required spectrum, at whose breakpoints others are computed, too.
void read_required(const ShockCommandInput& input, ShockRequest& request, ShockView& view) {
  if (input.required.empty()) return;
  view.required = read_required_spectrum(input.required);
  for (const auto& [frequency, acceleration] : view.required->points) request.breakpoints.push_back(frequency);
}

/// The drop run at its one probe; nothing where none is given.
std::optional<ShockRun> run_beside(const ShockInput& drop, const std::vector<double>& breakpoints) {
  if (drop.scene.source.empty() && drop.probes.empty()) return std::nullopt;
  const Scene scene = shock_scene(drop);
  const std::vector<Probe> probes = probes_of(drop);
  if (probes.size() != 1) {
    std::string names;
    for (const Probe& probe : probes) names += (names.empty() ? ": " : ", ") + probe.name;
    throw BadInput(
        fmt::format("--probe: required, where on the body the record was taken: {}NAME:X,Y,Z, not {} points{}",
                    probes.empty() ? "" : "a NAME of the scene's, or ", probes.size(), names));
  }
  ShockRequest request = request_of(drop);
  request.breakpoints = breakpoints;
  return run_shock(scene, probes, request);
}

int run_measured(const ShockCommandInput& input) {
  const ShockInput drop = drop_beside(input);
  ShockView view = shown_of(drop);
  ShockRequest of_record = input.request;
  read_required(input, of_record, view);
  const std::optional<ShockRun> beside = run_beside(drop, of_record.breakpoints);
  check_files(input.output, plot_files(input.plot));
  PlotFile plot(input.plot);
  RecordRequest wanted{.path = input.measured, .rate = input.view.rate, .unit = record_unit(input)};
  std::istringstream names(input.columns);
  for (std::string name; std::getline(names, name, ',');) wanted.columns.push_back(name);
  view.rate.reset();
  AccelerationRecord record = read_accelerations(wanted);
  if (beside && record.axes.size() == 1) of_record.axis.reset();  // its only one, beside whichever of the body
  const MeasuredShock shock = measure_shock(std::move(record), of_record);
  const ShockRun* const simulated = beside ? &*beside : nullptr;
  write_report(input.output, measured_shock_report(shock, of_record, view, simulated));
  if (plot.is_wanted())
    plot.write(measured_shock_picture(shock, of_record, view, simulated),
               {"clatter shock --measured: " + input.measured});
  return 0;
}

int run_shock_command(const ShockCommandInput& input) {
  if (!input.measured.empty()) return run_measured(input);
  for (const auto& [given, option] : {std::pair{!input.columns.empty(), "--column"},
                                      {is_of_acceleration(input.scene.texts.at("--unit")), "--unit"},
                                      {!input.against.empty(), "--against"}}) {
    if (given) throw BadInput(fmt::format("{}: only with --measured FILE", option));
  }
  const Scene scene = shock_scene(input);
  const std::vector<Probe> probes = probes_of(input);
  if (probes.empty())
    throw BadInput("--probe: required, a point of the body as NAME:X,Y,Z in m, or [[probe]] in the scene file");
  say_doubts(scene, model_of(input), probes);
  ShockRequest request = request_of(input);
  const OutputChoice& choice = input.output;
  ShockView view = view_of(input);
  read_required(input, request, view);
  if (view.rate && request.filter)
    throw BadInput("--filter: its peaks are none of the history at --rate; leave out one of them");
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  const ShockRun run = run_shock(scene, probes, request, {.progress = watched(interrupt, "the drop", scene)});
  Report report = shock_report(run, view);
  if (interrupt.requested()) note_interrupt("errors, sensitivities and spectra may be missing", report);
  write_report(choice, report);
  if (interrupt.requested()) {
    plot.leave_out("interrupted");
    return interrupted_status;
  }
  const Picture picture = shock_picture(run, view);
  if (picture.panels.empty()) plot.leave_out("no impact that can be predicted");
  else if (plot.is_wanted())
    plot.write(picture,
               run_words("shock", shock_summary, scene, request.continuous ? Model::continuous : Model::discrete));
  return status_of(scene, run);
}

}  // namespace

Command shock_command() {
  return command_of<ShockCommandInput>(run_shock_command, [](Command& command, ShockCommandInput& input) {
    add_shock_options(command, input);
    command.add(choice_argument("--rows", input.rows, {"impact", "spectrum", "pulse"},
                                "of table and CSV: impacts, response spectra, or impacts as test pulses (impact)",
                                "Shock"));
    command.add(number_argument("--rate", input.view.rate, {1e-3, 1e9, false, "from 0.001 to 1e9 Hz"}, "HZ",
                                "rows are the history at this rate, with each peak: force, torque, pressure, probes; "
                                "with --measured how often was sampled",
                                "Shock"));
    command.add(read_argument("--filter", input.request.filter, read_low_pass, "CFC1000|HZ",
                              "low-pass before peaks and spectra, of a drop or a record: a class of SAE J211-1, or a "
                              "cut-off; Butterworth, 2 poles forward and back",
                              "Shock"));
    command.add_text("--required", input.required, "FILE",
                     "a spectrum to compare with, rows of frequency and acceleration, (g) or (m/s^2) above them: met "
                     "or not, by how many dB",
                     "Shock");
    const char* const group = "Measured";
    command.add_text(
        "--measured", input.measured, "FILE",
        "accelerations of a logger or drop tower (CSV) in place of a drop: its blows and spectra; --unit g or "
        "m/s2 where the file does not say",
        group);
    command.add_text("--column", input.columns, "NAME,...", "its columns of acceleration, one to three", group);
    command.add_text("--against", input.against, "SCENE",
                     "a drop to stand beside the record, at its one probe; --axis is that of both", group);
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095\n"
        "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --rows pulse --part 300:500 "
        "--plot camera.svg\n"
        "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --rate 1e6 --format csv "
        "--output camera.csv\n"
        "Example: clatter shock --measured logger.csv --unit g --against phone.toml --probe board:0.02,0.01,0.003\n"
        "The change of velocity is what a fragile part inside feels of a blow that is short to it; the peak depends on "
        "the floor.\n"
        "Peaks are specific forces, what an accelerometer reads, of a rigid body: parts that bend are left out.";
    command.columns = {{"shock", shock_columns},
                       {"shock-spectrum", spectrum_columns},
                       {"shock-pulse", pulse_columns},
                       {"shock-measured", measured_shock_columns},
                       {"shock-history", [] { return shock_history_columns({"probe"}); }}};
  });
}

}  // namespace clatter::validation
