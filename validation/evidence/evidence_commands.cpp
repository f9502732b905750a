// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter verify`, `clatter verify --figures` and `clatter verify --extremes`: what holds, and how it is seen.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/evidence/check.hpp"
#include "validation/evidence/extremes.hpp"
#include "validation/evidence/figure.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {
namespace {

struct VerifyInput {
  bool quick = false;
  std::vector<std::string> only;
  std::string html;
  OutputChoice output;
};

int run_verify(const VerifyInput& input) {
  const CheckSelection selection = select_checks(input.quick, input.only);
  const OutputChoice& choice = input.output;
  check_files(choice, {{"--html", input.html}});
  std::optional<Sink> page;
  if (!input.html.empty()) {  // what is missing is found before the work
    require_gnuplot("--html " + input.html);
    page.emplace(input.html, "--html");
  }
  const CooperativeInterrupt interrupt;
  CaseRuns case_runs;
  case_runs.goes_on = [&] { return !interrupt.requested(); };
  std::vector<CheckResult> results;
  {
    Progress progress;
    results = verify_checks(selection.checks, case_runs, [&](std::size_t done, std::size_t of, const std::string& id) {
      progress.show(fmt::format("{}{} {}", progress_bar(done, of), progress.time_left(done, of), id));
      return !interrupt.requested();
    });
  }
  write_report(choice, verify_report(results, selection.words));
  if (page && !interrupt.requested()) {
    page->write(verify_page(results, selection.words, case_runs));
    page->commit();
  }
  return verify_status(summary_of(results));
}

}  // namespace

Command verify_command() {
  return command_of<VerifyInput>(run_verify, [](Command& command, VerifyInput& input) {
    command.add_flag("--quick", input.quick, "leave out the checks that take long");
    command.add_list("--only", input.only, "ID", "these checks, such as C1 E2");
    command.add_text("--html", input.html, "FILE", "also a page with the verdicts and all figures (needs gnuplot)");
    add_output_options(command, input.output);
    command.footer = "Example: clatter verify --quick --html verification.html\nExit status 1 if a check fails.";
    command.columns = {{"verify", verify_columns}};
  });
}

namespace {

struct FiguresInput {
  TextStyle style{.format = Format::csv};
  std::string folder;
  std::vector<std::string> only;
};

std::vector<int> chosen(const FiguresInput& input) {
  if (input.only.empty()) return figure_numbers();
  std::vector<int> numbers;
  for (const std::string& text : input.only) {
    const int number = read_integer_option("--only", text, 1, 99);
    const auto& known = figure_numbers();
    if (std::find(known.begin(), known.end(), number) == known.end())
      throw BadInput(fmt::format("--only {}: no such figure; there are {}", number, fmt::join(known, ", ")));
    numbers.push_back(number);
  }
  return numbers;
}

/// FOLDER/figure_07.csv, or .txt, .json, .md, .tex.
std::string path_of(const FiguresInput& input, int number) {
  const char* const extensions[]{"txt", "csv", "json", "md", "tex"};  // in the order of Format
  const char* const extension = extensions[static_cast<std::size_t>(input.style.format)];
  return (std::filesystem::path(input.folder) / fmt::format("figure_{:02}.{}", number, extension)).string();
}

int run_figures(const FiguresInput& input) {
  const std::vector<int> numbers = chosen(input);
  if (input.folder.empty()) throw BadInput("--output DIR: required, the folder for the files");
  std::error_code error;
  std::filesystem::create_directories(input.folder, error);
  if (!std::filesystem::is_directory(input.folder, error))
    throw BadInput(fmt::format("--output {}: must be a folder that exists or can be made", input.folder));
  for (const int number : std::set<int>(numbers.begin(), numbers.end()))
    require_writable({"--output", path_of(input, number)});
  CaseRuns case_runs;
  Progress progress;
  std::size_t done = 0;
  for (const int number : numbers) {
    progress.show(progress_bar(done++, numbers.size()));
    Sink sink(path_of(input, number));
    sink.write(report_text(figure_report(make_figure(number, case_runs)), input.style));
    sink.commit();
  }
  const std::string count = numbers.size() == 1 ? "1 file" : fmt::format("{} files", numbers.size());
  write_out({}, fmt::format("{} in {}; clatter verify --html FILE draws the figures\n", count, input.folder));
  return 0;
}

}  // namespace

Command figures_command() {
  return command_of<FiguresInput>(run_figures, [](Command& command, FiguresInput& input) {
    command.add_text("--output", input.folder, "DIR", "folder for figure_07.csv, ...; made if it is not there");
    command.add_list("--only", input.only, "N", "numbers of figures");
    command.add(format_argument(input.style.format, "form of the files (csv)"));
    command.add_flag("--ascii", input.style.ascii, "plain ASCII in tables");
    command.add_flag("--bare", input.style.bare, "CSV without comments");
    command.footer =
        "Example: clatter verify --figures --only 7 14 --output figures\n"
        "Comments \"plot: ...\" and in JSON the list plots say how each panel is drawn.\n"
        "clatter verify --html FILE draws them. Figs. 13 and 18 of the paper are meshes, Figs. 1 to 6 sketches.";
  });
}

namespace {

struct ExtremesInput {
  std::vector<std::string> only;
  bool quick = false;
  std::optional<int> seed;
  std::optional<double> seconds;
  std::string plot;
  OutputChoice output;
};

ExtremesOptions read_options(const ExtremesInput& input) {
  if (input.quick && !input.only.empty()) throw BadInput("--quick: excludes --only; give one of them, not both");
  std::vector<std::string> names;
  for (const MapAxis& axis : map_axes()) names.push_back(axis.name);
  for (const std::string& name : input.only) static_cast<void>(read_name_option("--only", name, names));
  ExtremesOptions options;
  options.axes = input.only;
  options.long_runs = !input.quick;
  if (input.seconds) options.cell_seconds = *input.seconds;
  if (input.seed) options.runs.seed = static_cast<std::uint64_t>(*input.seed);
  return options;
}

int run_extremes(const ExtremesInput& input) {
  ExtremesOptions options = read_options(input);
  const OutputChoice& choice = input.output;
  check_files(choice, {{"--plot", input.plot}});
  std::optional<Sink> plot;
  if (!input.plot.empty()) plot.emplace(input.plot, "--plot");
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
  return command_of<ExtremesInput>(run_extremes, [](Command& command, ExtremesInput& input) {
    command.add_list("--only", input.only, "AXIS", "these quantities, such as angle speed");
    command.add_flag("--quick", input.quick, "without the long runs (impacts, random scenes)");
    command.add(whole_argument("--seed", input.seed, 0, 2147483647, "S", "of the random scenes (1)"));
    command.add(number_argument("--seconds", input.seconds, {0, 3600, true, "greater than 0, at most 3600"}, "S",
                                "that a cell may take (1)"));
    command.add_text("--plot", input.plot, "FILE", "also a picture, .svg");
    add_output_options(command, input.output);
    command.footer =
        "Example: clatter verify --extremes --only angle restitution --plot extremes.svg\n"
        "Quantities: angle, stiffness, damping, restitution, ratio, friction, speed,\n"
        "gravity, size, mass, turns, impacts, disc, needle, slenderness, bounces, hops,\n"
        "squares, cubes, long.\n"
        "The table has one row per region, --format csv and json all cells. Each cell\n"
        "ends within a second with a number and its error or with a typed refusal;\n"
        "exit status 1 if one does not, or if an error is beyond its bound.";
    command.columns = {{"extremes", extremes_columns}};
  });
}

}  // namespace clatter::validation
