#include "validation/cli/verify_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "validation/cli/impact_records.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

const char* const what_it_is = "every claim, its oracle, tolerance and measured error";

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

std::string answer_word(const CheckResult& result) { return result.done ? answer_name(result.measured.answer) : ""; }

/// The number to four digits; a whole one has no zeros behind its point.
Cell number_cell(double number) { return is_short_whole(number) ? Cell(shortest(number)) : Cell(number, 4); }

Json check_json(const CheckResult& result) {
  const Check& check = *result.check;
  const Measured& m = result.measured;
  return {{"id", check.id},
          {"what", check.what},
          {"claim", check.claim},
          {"quantity", check.number},
          {"unit", check.unit.empty() ? Json(nullptr) : Json(check.unit)},
          {"oracle", check.oracle},
          {"metric", check.error},
          {"answer", result.done ? Json(answer_name(m.answer)) : Json(nullptr)},
          {"expected_answer", answer_name(check.answer)},
          {"number", result.done ? number_or_null(m.number) : Json(nullptr)},
          {"measured_error", result.done ? number_or_null(m.error) : Json(nullptr)},
          {"tolerance", check.tolerance},
          {"seen", check.seen},
          {"reason", check.reason},
          {"verdict", verdict_word(result)},
          {"failure", result.failure.empty() ? Json(nullptr) : Json(result.failure)},
          {"found", m.found},
          {"seconds", result.seconds},
          {"figure", check.figure ? Json(*check.figure) : Json(nullptr)},
          {"command", check.command}};
}

/// For a terminal: the oracle as a letter, the verdict as a mark.
Table narrow_table(const std::vector<CheckResult>& results) {
  Table table;
  table.columns = {{.name = "id", .heading = "id", .unit = "", .words = true},
                   {.name = "what", .heading = "what", .unit = "", .words = true},
                   {.name = "answer", .heading = "answer", .unit = "", .words = true},
                   {"number", "number", ""},
                   {.name = "oracle", .heading = "by", .unit = "", .words = true},
                   {"measured_error", "error", ""},
                   {"tolerance", "limit", ""},
                   {"seconds", "cost", "s"}};
  for (const CheckResult& result : results) {
    const Measured& m = result.measured;
    table.rows.push_back({Cell(result.check->id), Cell(result.check->what), Cell(marked_answer(result)),
                          result.done ? number_cell(m.number) : Cell(), Cell(oracle_letter(result.check->oracle)),
                          result.done ? Cell(m.error, 2) : Cell(), Cell(result.check->tolerance, 1),
                          Cell(fmt::format("{:.2f}", result.seconds))});
  }
  table.notes = {
      "by: the oracle, c closed form, t 30-digit table, l conservation law, m other model, o convergence, v "
      "independent value; limit: of the error",
      "answer: does the claim hold?  ✓: the error is within its limit and the answer is the expected one.  "
      "--format json says what each number is and what else was found"};
  return table;
}

Table wide_table(const std::vector<CheckResult>& results) {
  Table table;
  for (const char* name : {"id", "what", "answer"})
    table.columns.push_back({.name = name, .heading = name, .unit = "", .words = true});
  for (const char* name : {"number", "error", "tolerance"}) table.columns.push_back({name, name, ""});
  for (const char* name : {"verdict", "oracle", "found"})
    table.columns.push_back({.name = name, .heading = name, .unit = "", .words = true});
  table.columns.push_back({"seconds", "cost", "s"});
  for (const CheckResult& result : results) {
    const Measured& m = result.measured;
    table.rows.push_back({Cell(result.check->id), Cell(result.check->what), Cell(answer_word(result)),
                          result.done ? number_cell(m.number) : Cell(), result.done ? Cell(m.error, 2) : Cell(),
                          Cell(result.check->tolerance, 2), Cell(verdict_word(result)), Cell(result.check->oracle),
                          Cell(m.found), Cell(fmt::format("{:.2f}", result.seconds))});
  }
  return table;
}

}  // namespace

VerifySummary summary_of(const std::vector<CheckResult>& results) {
  VerifySummary summary;
  for (const CheckResult& result : results) {
    ++(result.passed() ? summary.passed : result.done ? summary.failed : summary.not_run);
    summary.seconds += result.seconds;
  }
  return summary;
}

int verify_status(const VerifySummary& summary) {
  constexpr int check_failed = 1;
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

Table verify_table(const std::vector<CheckResult>& results, const std::string& selection, Format format) {
  Table table = format == Format::table ? narrow_table(results) : wide_table(results);
  table.head = {headline("verify", what_it_is), selection};
  std::vector<std::string> outcome;
  for (const CheckResult& result : results) {
    if (result.done && !result.passed()) outcome.push_back(fmt::format("{}: {}", result.check->id, result.failure));
  }
  outcome.push_back(summary_words(summary_of(results)));
  table.notes.insert(table.notes.begin(), outcome.begin(), outcome.end());
  return table;
}

Json verify_json(const std::vector<CheckResult>& results, const std::string& selection) {
  const VerifySummary summary = summary_of(results);
  Json json{{"clatter", version}, {"model", "verification"}, {"selection", selection}, {"checks", Json::array()}};
  for (const CheckResult& result : results) json["checks"].push_back(check_json(result));
  json["passed"] = summary.passed;
  json["failed"] = summary.failed;
  json["not_run"] = summary.not_run;
  json["seconds"] = summary.seconds;
  json["message"] = summary_words(summary);
  return json;
}

Table verify_records(const std::vector<CheckResult>& results, const std::string& selection) {
  Table table{.head = {headline("verify", what_it_is), selection}, .columns = {}, .rows = {}, .notes = {}};
  const Json json = verify_json(results, selection);
  add_impact_records(table, json["checks"]);
  table.notes = {summary_words(summary_of(results))};
  return table;
}

}  // namespace clatter::validation
