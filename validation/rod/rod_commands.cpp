// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter angles` and `clatter angles --regimes`: the thin rod that strikes with one end and then the other.
#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/sink.hpp"
#include "validation/rod/rod.hpp"

namespace clatter::validation {
namespace {

struct AnglesInput {
  AnglesOptions options;
  OutputChoice output;
  PlotChoice plot;
};

std::vector<std::string> script_head(const AnglesRequest& request) {
  const Report frame = angles_frame(request);
  return {frame.title, frame.head[0], "parameters: " + compact_json(frame.fields.at("parameters"))};
}

void show_progress(long long done, long long count) {
  std::fputs(fmt::format("\rclatter: {} of {} rows{}", done, count, done == count ? "\n" : "").c_str(), stderr);
}

/// Blocks of rows, two at a time on two threads, written in order.
int write_csv(const AnglesRequest& request, const OutputChoice& choice) {
  Sink sink(choice.path);
  sink.write(csv_head(angles_frame(request), choice.style.bare));
  const CooperativeInterrupt interrupt;
  constexpr long long block = 8192;
  const long long count = request.count;
  const bool progress = count > 20 * block && shows_progress();
  for (long long begin = 0; begin < count; begin += 2 * block) {
    const long long middle = std::min(begin + block, count);
    const long long end = std::min(middle + block, count);
    auto second = std::async(std::launch::async, angles_csv_rows, std::cref(request), middle, end);
    sink.write(angles_csv_rows(request, begin, middle));
    sink.write(second.get());
    if (progress) show_progress(end, count);
    if (!interrupt.requested()) continue;
    if (sink.is_file()) return interrupted_status;
    sink.write(fmt::format("# interrupted after {} of {} rows\n", end, count));
    sink.commit();
    return interrupted_status;
  }
  sink.commit();
  return 0;
}

int run_angles(const AnglesInput& input) {
  const AnglesRequest request = angles_request(input.options);
  const OutputChoice& choice = input.output;
  check_files(choice, plot_files(input.plot));
  PlotFile plot(input.plot);
  if (choice.style.format == Format::csv) {
    const int status = write_csv(request, choice);
    if (status != 0) {
      plot.leave_out("interrupted");
      return status;
    }
  } else {
    write_report(choice, angles_report(request));
  }
  if (plot.is_wanted()) plot.write(angles_picture(request), script_head(request));
  return 0;
}

}  // namespace

Command angles_command() {
  return command_of<AnglesInput>(run_angles, [](Command& command, AnglesInput& input) {
    command.add(angles_arguments(input.options));
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer = "Example: clatter angles --from 0 --to 60 --step 2.5 --gravity-number 0.1";
    command.columns = {{"angles", [] {
                          AnglesRequest request;
                          request.as_printed = true;
                          return angles_frame(request).grid.columns;
                        }}};
  });
}

namespace {

struct RegimesInput {
  RegimesRequest request;
  OutputChoice output;
  PlotChoice plot;
};

int run_regimes(const RegimesInput& input) {
  const FoundRegimes found = find_regimes(input.request);
  check_files(input.output, plot_files(input.plot));
  PlotFile plot(input.plot);
  write_report(input.output, found.report);
  if (plot.is_wanted()) plot.write(regimes_picture(found), found.script_head);
  return 0;
}

}  // namespace

Command regimes_command() {
  return command_of<RegimesInput>(run_regimes, [](Command& command, RegimesInput& input) {
    command.add(regimes_arguments(input.request));
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter angles --regimes --over restitution --from 0.2 --to 1 --step 0.1\n"
        "Of the thin rod in its plane, whose regimes end at folds of one angle. In space an attitude has three angles, "
        "and\n"
        "the number of impacts of its drops is a row of clatter sweep.";
    command.columns = {{"regimes", regimes_columns}};
  });
}

}  // namespace clatter::validation
