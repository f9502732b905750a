// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/figures/figure.hpp"
#include "validation/figures/figure_file.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation::inline cli {
namespace {

struct FiguresInput {
  std::optional<std::string> format;
  bool ascii = false, bare = false;
  std::optional<std::string> folder;
  std::vector<std::string> only;
};

std::string known_numbers() {
  std::string text;
  for (const int number : figure_numbers()) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return text;
}

std::vector<int> chosen(const FiguresInput& input) {
  if (input.only.empty()) return figure_numbers();
  std::vector<int> numbers;
  for (const std::string& text : input.only) {
    const int number = read_integer_option("--only", text, 1, 99);
    const auto& known = figure_numbers();
    if (std::find(known.begin(), known.end(), number) == known.end()) {
      throw BadInput(fmt::format("--only {}: no such figure; there are {}", number, known_numbers()));
    }
    numbers.push_back(number);
  }
  return numbers;
}

int run_figures(const FiguresInput& input) {
  const std::vector<int> numbers = chosen(input);
  if (!input.folder || input.folder->empty()) throw BadInput("--output DIR: required, the folder for the files");
  OutputTexts form;
  form.format = input.format.value_or("csv");
  form.ascii = input.ascii;
  form.bare = input.bare;
  const FigureFiles files{*input.folder, read_output(form).style};
  make_folder(*input.folder, "--output");
  check_figure_files(numbers, files);
  CaseRuns case_runs;
  Progress progress;
  std::size_t done = 0;
  for (const int number : numbers) {
    progress.show(progress_bar(done++, numbers.size()));
    write_figure(make_figure(number, case_runs), files);
  }
  return 0;
}

}  // namespace

Command figures_command() {
  auto input = std::make_shared<FiguresInput>();
  Command command{.name = "figures", .help = "the data of the paper's figures, a file each"};
  command.add_text("--output", input->folder, "DIR", "folder for figure_07.csv, ...; made if it is not there");
  command.add_list("--only", input->only, "N", "numbers of figures");
  command.add_text("--format", input->format, "table|csv|json|markdown|latex", "form of the files (csv)");
  command.add_flag("--ascii", input->ascii, "plain ASCII in tables");
  command.add_flag("--bare", input->bare, "CSV without comments");
  command.footer =
      "Example: clatter figures --only 7 14 --output figures\n"
      "Comments \"plot: ...\" and in JSON the list plots say how each panel is drawn.\n"
      "clatter verify --html FILE draws them.";
  command.run = [input] { return run_figures(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
