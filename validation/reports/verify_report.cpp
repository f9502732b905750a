// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/verify_report.hpp"

#include <fmt/format.h>

#include <utility>

#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation::inline reports {
namespace {

const char* const verify_summary = "every claim, its oracle, tolerance and measured error";

std::string verdict_word(const CheckResult& result) {
  if (!result.done) return "not run";
  return result.passed() ? "passed" : "FAILED";
}

/// One letter for the oracle, so that the table fits a terminal.
std::string oracle_letter(const std::string& oracle) {
  for (const auto& [name, letter] : {std::pair{"closed form", "c"},
                                     {"30-digit table", "t"},
                                     {"conservation law", "l"},
                                     {"other model", "m"},
                                     {"convergence", "o"},
                                     {"independent value", "v"}}) {
    if (oracle == name) return letter;
  }
  return oracle;
}

/// The answer with a mark that says whether the check passed.
std::string marked_answer(const CheckResult& result) {
  return !result.done ? "not run" : std::string(answer_name(result.measured.answer)) + (result.passed() ? "✓" : "✗");
}

/// The number to four digits; a whole one has no zeros behind its point.
Cell number_cell(double number) { return is_short_whole(number) ? Cell(number, shortest(number)) : Cell(number, 4); }

Row check_row(const CheckResult& result) {
  const Check& check = *result.check;
  const Measured& m = result.measured;
  const bool done = result.done;
  return {Cell(check.id),
          Cell(check.what),
          Cell(done ? Value(answer_name(m.answer)) : Value(), marked_answer(result)),
          done ? number_cell(m.number) : Cell(),
          Cell(check.oracle, oracle_letter(check.oracle)),
          done ? Cell(m.error, 2) : Cell(),
          Cell(check.tolerance, 1),
          Cell(result.seconds, fmt::format("{:.2f}", result.seconds)),
          Cell(check.claim),
          Cell(check.number),
          Cell(text_or_nothing(check.unit)),
          Cell(check.error),
          Cell(answer_name(check.answer)),
          Cell(Value(check.seen)),
          Cell(check.reason),
          Cell(verdict_word(result)),
          Cell(text_or_nothing(result.failure)),
          Cell(m.found),
          Cell(check.figure ? Value(*check.figure) : Value()),
          Cell(check.command)};
}

}  // namespace

std::vector<Column> verify_columns() {
  std::vector<Column> columns{word_column("id", "id", "short name of the check"),
                              word_column("what", "what", "the check in a few words"),
                              word_column("answer", "answer", "whether the claim holds"),
                              {"number", "number", "", "that was measured, in `unit`"},
                              word_column("oracle", "by", "kind of the number's judge"),
                              {"measured_error", "error", "", "of the number, in the sense of `metric`"},
                              {"tolerance", "limit", "", "that the error must keep"},
                              {"seconds", "cost", "s", "processor time"}};
  for (const auto& [name, meaning] : {std::pair{"claim", "in full"},
                                      {"quantity", "what the number is"},
                                      {"unit", "of the number"},
                                      {"metric", "what the error is"},
                                      {"expected_answer", "the answer that passes"},
                                      {"seen", "the error when the tolerance was set"},
                                      {"reason", "of the tolerance"},
                                      {"verdict", "passed, FAILED or not run"},
                                      {"failure", "why it failed"},
                                      {"found", "what else was found"},
                                      {"figure", "of the paper that shows it"},
                                      {"command", "that shows it"}}) {
    columns.push_back({.name = name, .heading = name, .unit = "", .meaning = meaning, .shown = false});
  }
  return columns;
}

VerifySummary summary_of(const std::vector<CheckResult>& results) {
  VerifySummary summary;
  for (const CheckResult& result : results) {
    ++(result.passed() ? summary.passed : result.done ? summary.failed : summary.not_run);
    summary.seconds += result.seconds;
  }
  return summary;
}

int verify_status(const VerifySummary& summary) {
  if (summary.not_run > 0) return interrupted_status;
  return summary.failed > 0 ? check_failed : 0;
}

std::string summary_words(const VerifySummary& summary) {
  std::string text =
      fmt::format("{} of {} checks passed", summary.passed, summary.passed + summary.failed + summary.not_run);
  if (summary.failed > 0) text += fmt::format(", {} FAILED", summary.failed);
  if (summary.not_run > 0) text += fmt::format(", {} not run: interrupted", summary.not_run);
  return text + fmt::format("; {} s of processor time", significant(summary.seconds, 3));
}

Report verify_report(const std::vector<CheckResult>& results, const std::string& selection) {
  Report report = begun_report("verify", verify_summary);
  const VerifySummary summary = summary_of(results);
  report.head = {selection};
  report.grid.columns = verify_columns();
  for (const CheckResult& result : results) {
    report.grid.rows.push_back(check_row(result));
    if (result.done && !result.passed())
      report.notes.push_back(fmt::format("{}: {}", result.check->id, result.failure));
  }
  report.notes.insert(
      report.notes.end(),
      {summary_words(summary),
       "by: the oracle, c closed form, t 30-digit table, l conservation law, m other model, o convergence, v "
       "independent value; limit: of the error",
       "answer: does the claim hold?  ✓: the error is within its limit and the answer is the expected one.  "
       "--format json says what each number is and what else was found"});
  report.fields["model"] = "verification";
  report.fields["selection"] = selection;
  report.fields["checks"] = row_objects(report.grid);
  report.fields["passed"] = summary.passed;
  report.fields["failed"] = summary.failed;
  report.fields["not_run"] = summary.not_run;
  report.fields["seconds"] = summary.seconds;
  report.fields["message"] = summary_words(summary);
  return report;
}

}  // namespace clatter::validation::inline reports
