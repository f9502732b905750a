#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/cli/verify_report.hpp"
#include "validation/figures/drawing.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/verify/page.hpp"

namespace clatter::validation {
namespace {

struct VerifyInput {
  bool quick = false;
  std::vector<std::string> only;
  std::optional<std::string> html;
  OutputTexts output;
};

std::vector<std::string> ids() {
  std::vector<std::string> names;
  for (const Check& check : all_checks()) names.push_back(check.id);
  return names;
}

/// The checks asked for, in the order of the table.
std::vector<const Check*> chosen(const VerifyInput& input) {
  if (input.quick && !input.only.empty()) throw BadInput("--quick: excludes --only; give one of them, not both");
  for (const std::string& id : input.only) static_cast<void>(read_name_option("--only", id, ids()));
  std::vector<const Check*> checks;
  for (const Check& check : all_checks()) {
    const bool named = std::find(input.only.begin(), input.only.end(), check.id) != input.only.end();
    if (input.only.empty() ? check.quick || !input.quick : named) checks.push_back(&check);
  }
  return checks;
}

std::string selection_words(const VerifyInput& input, std::size_t count) {
  if (!input.only.empty()) return fmt::format("{} checks by name", count);
  return fmt::format("{} set: {} checks of {}", input.quick ? "quick" : "full", count, all_checks().size());
}

int run_verify(const VerifyInput& input) {
  const std::vector<const Check*> checks = chosen(input);
  const OutputChoice choice = read_output(input.output);
  if (input.html && *input.html == choice.path)
    throw BadInput(fmt::format("--html {}: must be another file than --output's", *input.html));
  std::optional<Sink> page;
  if (input.html) {  // what is missing is found before the work
    require_gnuplot();
    page.emplace(*input.html, "--html");
  }
  const std::string selection = selection_words(input, checks.size());
  const CooperativeInterrupt interrupt;
  Laboratory laboratory;
  laboratory.goes_on = [&] { return !interrupt.requested(); };
  std::vector<CheckResult> results;
  {
    Progress progress;
    results = verify(checks, laboratory, [&](std::size_t done, std::size_t of, const std::string& id) {
      progress.show(fmt::format("{} {}", progress_bar(done, of), id));
      return !interrupt.requested();
    });
  }
  write_report(
      choice, [&] { return verify_json(results, selection); }, [&] { return verify_records(results, selection); },
      [&] { return verify_table(results, selection, choice.style.format); });
  if (page && !interrupt.requested()) {
    page->write(verify_page(results, selection, laboratory));
    page->commit();
  }
  return verify_status(summary_of(results));
}

}  // namespace

Action add_verify_command(CLI::App& app) {
  auto input = std::make_shared<VerifyInput>();
  CLI::App* command = app.add_subcommand("verify", "every claim of the paper, checked");
  command->add_flag("--quick", input->quick, "leave out the checks that take long");
  command->add_option("--only", input->only, "these checks, such as C1 E2")->type_name("ID");
  add_text(*command, "--html", input->html, "FILE", "also a page with the verdicts and all figures (needs gnuplot)");
  add_output_options(*command, input->output);
  command->footer("Example: clatter verify --quick --html verification.html\nExit status 1 if a check fails.");
  return [input] { return run_verify(*input); };
}

}  // namespace clatter::validation
