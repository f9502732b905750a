// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/figures/gnuplot.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/reports/verify_report.hpp"
#include "validation/verify/check.hpp"

namespace clatter::validation::inline cli {
namespace {

struct VerifyInput {
  bool quick = false;
  std::vector<std::string> only;
  std::optional<std::string> html;
  OutputTexts output;
};

int run_verify(const VerifyInput& input) {
  const CheckSelection selection = select_checks(input.quick, input.only);
  const OutputChoice choice = read_output(input.output);
  check_files(choice, {{"--html", input.html.value_or("")}});
  std::optional<Sink> page;
  if (input.html) {  // what is missing is found before the work
    require_gnuplot("--html " + *input.html);
    page.emplace(*input.html, "--html");
  }
  const CooperativeInterrupt interrupt;
  CaseRuns case_runs;
  case_runs.goes_on = [&] { return !interrupt.requested(); };
  std::vector<CheckResult> results;
  {
    Progress progress;
    results = verify_checks(selection.checks, case_runs, [&](std::size_t done, std::size_t of, const std::string& id) {
      progress.show(fmt::format("{} {}", progress_bar(done, of), id));
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
  auto input = std::make_shared<VerifyInput>();
  Command command{.name = "verify", .help = "every claim of the paper, checked"};
  command.add_flag("--quick", input->quick, "leave out the checks that take long");
  command.add_list("--only", input->only, "ID", "these checks, such as C1 E2");
  command.add_text("--html", input->html, "FILE", "also a page with the verdicts and all figures (needs gnuplot)");
  add_output_options(command, input->output);
  command.footer = "Example: clatter verify --quick --html verification.html\nExit status 1 if a check fails.";
  command.run = [input] { return run_verify(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
