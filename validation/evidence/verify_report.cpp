// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/check.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "validation/evidence/figure.hpp"
#include "validation/output/html.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
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
  if (!result.done) return "not run";
  return answer_name(result.measured.answer) + std::string(result.passed() ? "✓" : "✗");
}

/// The number to four digits; a whole one has no zeros behind its point.
Cell number_cell(double number) { return is_short_whole(number) ? Cell(number, shortest(number)) : Cell(number, 4); }

Cell number_or_none(const std::optional<double>& number) { return number ? number_cell(*number) : Cell(); }

/// What the paper prints and what is right, each with its number: "printed ...: −3.074 rad/s; right ...: 3.074 rad/s".
std::string forms_of(const CheckResult& result) {
  const Check& check = *result.check;
  const auto form = [&](const std::string& text, const std::optional<double>& number) {
    if (!number) return text;
    const std::string value = is_short_whole(*number) ? shortest(*number) : significant(*number, 4);
    return fmt::format("{}: {}{}{}", text, value, check.compared_unit.empty() || check.compared_unit == "°" ? "" : " ",
                       check.compared_unit);
  };
  return fmt::format("{}; printed {}; right {}", check.compared, form(check.printed, result.measured.printed),
                     form(check.right, result.measured.right));
}

Row check_row(const CheckResult& result) {
  const Check& check = *result.check;
  const Measured& m = result.measured;
  const bool done = result.done;
  return {Cell(check.id),
          Cell(check.what),
          Cell(done ? Value(answer_name(m.answer)) : Value(), marked_answer(result)),
          done ? number_cell(m.number) : Cell(),
          Cell(check.oracle, oracle_letter(check.oracle)),
          done ? Cell(rounded_up(m.error), 2) : Cell(),
          Cell(check.tolerance, 2),
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
          Cell(check.command),
          Cell(text_or_nothing(check.place)),
          Cell(text_or_nothing(check.printed)),
          Cell(text_or_nothing(check.right)),
          Cell(text_or_nothing(check.compared)),
          number_or_none(m.printed),
          number_or_none(m.right),
          Cell(text_or_nothing(check.compared_unit))};
}

const char* const style = R"css(
:root { --ink: #1c2430; --pale: #667; --line: #d8dce2; --good: #0a7d4f; --bad: #b3261e; --open: #a15c00; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: #fff; margin: 0 auto; max-width: 76rem; padding: 1.5rem; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; } h2 { margin: 2.2rem 0 .6rem; font-size: 1.25rem; }
p { max-width: 46rem; } .pale { color: var(--pale); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th, td { text-align: left; padding: .35rem .6rem; border-bottom: 1px solid var(--line); vertical-align: top; }
th { position: sticky; top: 0; background: #fff; } td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; } td.number .pale { white-space: normal; } td:nth-child(2) { min-width: min(24rem, 60vw); }
.passed, .holds, .misprint { color: var(--good); } .failed { color: var(--bad); font-weight: 600; } .refuted, .ambiguous { color: var(--open); font-weight: 600; }
code { font: .82rem ui-monospace, monospace; background: #f3f5f8; padding: .1rem .35rem; border-radius: 3px; overflow-wrap: anywhere; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 27rem), 1fr)); gap: .8rem; }
.plots svg:only-child { max-width: 38rem; }
.plots svg { width: 100%; height: auto; border: 1px solid var(--line); border-radius: 6px; }
nav a { margin-right: 1rem; white-space: nowrap; display: inline-block; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e6ebf0; --pale: #a3afbb; --line: #39434d; --good: #4cc38a; --bad: #ff8f85; --open: #e8a33d; color-scheme: dark; }
  body, th { background: #14181c; } code { background: #222b34; } a { color: #7fc4ee; } .plots svg { background: #fff; }
}
@media print {
  @page { margin: 12mm; }
  body { max-width: none; padding: 0; } .scroll { overflow: visible; } th { position: static; } tr, .plots svg { break-inside: avoid; }
  table { font-size: 7pt; table-layout: auto; } td:nth-child(2) { min-width: 0; } th, td { padding: 2pt 3pt; }
  td.number { white-space: normal; } code { font-size: 6.5pt; padding: 0; background: none; }
}
)css";

/// Headings of the groups, by the first letter of the checks' names.
struct Group {
  char letter;
  const char *title, *text;
};
constexpr Group groups[] = {
    {'C', "Claims of the paper",
     "Does each statement hold?  A refuted one is answered with the number that was measured."},
    {'E', "Errata", "The printed form and the right one, both evaluated at one point."},
    {'F', "Figures", "Laws that the data of each figure must obey."},
    {'X', "Exact results", "Closed forms, 30-digit tables, conservation laws, orders of convergence."},
    {'M', "Both models over every scene", "The limit of ever stiffer grounds is the discrete model's value."},
    {'R', "Random scenes", "Random rods and boxes through both models."},
    {'B', "Error bars", "How many errors lie within their bars."},
    {'S', "The discrete model in space", "40-digit scenes, conservation, symmetry, and the simulator's stiff limit."}};

std::string row_of(const CheckResult& result) {
  const Check& check = *result.check;
  const Measured& m = result.measured;
  const std::string answer = result.done ? answer_name(m.answer) : "";
  const char* verdict = !result.done ? "not run" : result.passed() ? "passed" : "failed";
  const std::string found = m.found + (check.printed.empty() ? "" : ". " + check.place + ", " + forms_of(result));
  const std::string number = (is_short_whole(m.number) ? shortest(m.number) : significant(m.number, 6)) +
                             (check.unit.empty() ? "" : " " + check.unit);
  return fmt::format(
      "<tr id=\"{}\"><td><b>{}</b></td><td>{}<br><span class=\"pale\">{}</span><br><code>{}</code></td><td "
      "class=\"{}\">{}</td>"
      "<td class=\"number\"><span class=\"pale\">{}</span><br>{}</td><td>{}<br><span class=\"pale\">{}</span></td><td "
      "class=\"number\">{}</td>"
      "<td class=\"number\" title=\"{}\">{}</td><td class=\"{}\">{}{}</td><td class=\"number\">{:.2f}</td></tr>\n",
      check.id, check.id, html_escaped(check.claim), html_escaped(found), html_escaped(check.command), answer, answer,
      html_escaped(check.number), html_escaped(number), html_escaped(check.oracle), html_escaped(check.error),
      significant(m.error, 2), html_escaped(check.reason), significant(check.tolerance, 2), verdict, verdict,
      result.failure.empty() ? "" : ": " + html_escaped(result.failure), result.seconds);
}

std::string group_html(const Group& group, const std::vector<CheckResult>& results) {
  std::string rows;
  for (const CheckResult& result : results) {
    if (result.check->id[0] == group.letter) rows += row_of(result);
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<h2 id=\"{}\">{}</h2>\n<p>{}</p>\n<div class=\"scroll\"><table><thead><tr><th></th><th>claim, what was found, "
      "how to see it</th>"
      "<th>answer</th><th>number</th><th>oracle, "
      "error</th><th>error</th><th>tolerance</th><th>verdict</th><th>s</th></tr></thead><tbody>\n{}</tbody></table></"
      "div>\n",
      group.letter, group.title, group.text, rows);
}

std::string figure_html(const Figure& figure) {
  std::string html =
      fmt::format("<h2 id=\"figure{}\">Figure {}: {}</h2>\n<p class=\"pale\">Scene: {}</p>\n<div class=\"plots\">\n",
                  figure.number, figure.number, html_escaped(figure.title), html_escaped(figure.scene));
  for (const std::string& picture : draw(figure)) html += picture + "\n";
  return html + fmt::format("</div>\n<p><code>{}</code></p>\n", html_escaped(figure.command()));
}

/// The figures that a check among the results belongs to; with a whole set, all.
std::set<int> wanted_figures(const std::vector<CheckResult>& results) {
  std::set<int> numbers;
  for (const CheckResult& result : results) {
    if (result.check->figure) numbers.insert(*result.check->figure);
  }
  return numbers;
}

}  // namespace

std::vector<Column> verify_columns() {
  std::vector<Column> columns{
      word_column("id", "id", "short name of the check"),
      word_column("what", "what", "the check in a few words"),
      word_column("answer", "answer", "whether the claim holds: holds, refuted, ambiguous or misprint"),
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
                                      {"command", "that shows it"},
                                      {"place", "equation or figure of an erratum"},
                                      {"printed", "what the paper prints there"},
                                      {"right", "the right form"},
                                      {"compared", "the number that both forms give"},
                                      {"printed_value", "that number by the printed form"},
                                      {"right_value", "the same by the right form"},
                                      {"compared_unit", "of both"}}) {
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
    if (result.done && !result.check->printed.empty() && selection.ends_with("by name"))
      report.notes.push_back(fmt::format("{}, {}: {}", result.check->id, result.check->place, forms_of(result)));
    if (result.done && !result.passed())
      report.notes.push_back(fmt::format("{}: {}", result.check->id, result.failure));
  }
  report.notes.insert(
      report.notes.end(),
      {summary_words(summary),
       "by: the oracle, c closed form, t 30-digit table, l conservation law, m other model, o convergence, v "
       "independent value; limit: of the error",
       "answer: what became of the claim, which --only ID --format json prints in full; a refuted one is an error of "
       "the paper, a misprint a form that it prints wrong; --only E1 shows it beside the right one.  ✓: the check "
       "passed, with the answer "
       "that was expected and an error within its limit"});
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

std::string verify_page(const std::vector<CheckResult>& results, const std::string& selection, CaseRuns& case_runs) {
  const VerifySummary summary = summary_of(results);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\"><title>clatter {}: verification</title><link rel=\"icon\" "
      "href=\"data:,\"><style>{}</style></head><body>\n"
      "<h1>clatter {}: verification</h1>\n<p class=\"{}\">{}</p>\n<p class=\"pale\">{}.  Reproduce: <code>clatter "
      "verify{} --html FILE</code></p>\n<p class=\"pale\">A tolerance is at most five times the error seen when it was "
      "set; "
      "its reason, shown when you point at it, says what that error is made of.</p>\n<nav>",
      version, style, version, summary.failed == 0 ? "passed" : "failed", html_escaped(summary_words(summary)),
      html_escaped(selection), selection.starts_with("quick") ? " --quick" : "");
  for (const Group& group : groups) {
    const std::string part = group_html(group, results);
    if (!part.empty()) html += fmt::format("<a href=\"#{}\">{}</a>", group.letter, group.title);
  }
  html += "<a href=\"#figures\">Pictures</a></nav>\n";
  for (const Group& group : groups) html += group_html(group, results);
  html +=
      "<h2 id=\"figures\">The paper's figures, from this run</h2>\n<p>Points: the continuous model.  Lines: the "
      "discrete "
      "model where there are points too, otherwise the continuous one over time.</p>\n";
  for (const int number : wanted_figures(results)) html += figure_html(make_figure(number, case_runs));
  return html + "</body></html>\n";
}

}  // namespace clatter::validation
