// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/shock/shock_options.hpp"
#include "validation/shock/shock_report.hpp"

namespace clatter::validation {
namespace {

const char* const shock_summary = "shock at points of the body";

struct ShockCommandInput : ShockInput {
  OutputChoice output;
  PlotChoice plot;
};

int run_shock_command(const ShockCommandInput& input) {
  const Scene scene = shock_scene(input);
  const std::vector<Probe> probes = probes_of(input);
  if (probes.empty())
    throw BadInput("--probe: required, a point of the body as NAME:X,Y,Z in m, or [[probe]] in the scene file");
  const ShockRequest request = request_of(input);
  const OutputChoice& choice = input.output;
  const ShockView view = view_of(input);
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  const CooperativeInterrupt interrupt;
  const ShockRun run =
      run_shock(scene, probes, request, {.progress = [&](int, long) { return !interrupt.requested(); }});
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
  auto input = std::make_shared<ShockCommandInput>();
  Command command;
  add_shock_options(command, *input);
  command.add(choice_argument("--rows", input->rows, {"impact", "spectrum", "pulse"},
                              "of table and CSV: impacts, response spectra, or impacts as test pulses (impact)",
                              "Shock"));
  command.add(number_argument("--rate", input->view.rate, {1e-3, 1e9, false, "from 0.001 to 1e9 Hz"}, "HZ",
                              "rows are the history at this rate, with each peak: force, torque, pressure, probes",
                              "Shock"));
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095\n"
      "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --rows pulse --part 300:500 "
      "--plot camera.svg\n"
      "Example: clatter shock phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --rate 1e6 --format csv "
      "--output camera.csv\n"
      "The change of velocity is what a fragile part inside feels of a blow that is short to it; the peak depends on "
      "the floor.\n"
      "Peaks are specific forces, what an accelerometer reads, of a rigid body: parts that bend are left out.";
  command.run = [input] { return run_shock_command(*input); };
  return command;
}

}  // namespace clatter::validation
