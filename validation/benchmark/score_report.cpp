// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/benchmark_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

Value impact_value(const ImpactScore& one, int n) {
  Value value;
  value["n"] = n;
  value["place"] = one.place;
  value["lines"] = std::vector<double>{static_cast<double>(one.first_line), static_cast<double>(one.last_line)};
  value["true_place"] = text_or_nothing(one.true_place);
  value["t"] = one.time;
  value["time_error"] = rounded_up(one.time_error);
  value["law_error"] = rounded_up(one.law_error);
  value["velocity_error"] = rounded_up(one.velocity_error);
  value["angular_velocity_error"] = rounded_up(one.angular_error);
  value["energy_error"] = rounded_up(one.energy_error);
  value["energy_drift"] = rounded_up(one.drift);
  value["flight_error"] = rounded_up(one.flight_error);
  value["error"] = rounded_up(one.error);
  value["impulse_normal"] = one.impulse_normal;
  value["impulse_tangential"] = one.impulse_tangential;
  value["velocity_after"] = parts(one.after.velocity);
  value["angular_velocity_after"] = parts(one.after.angular_velocity);
  return value;
}

Cell step_cell(const std::optional<double>& step) { return step ? Cell(*step, 4) : Cell(); }

Cell error_cell(double error) { return std::isfinite(error) ? Cell(rounded_up(error), 2) : Cell(Value(), "?"); }

Row submission_row(const Submission& one) {
  const Score& score = one.score;
  return {Cell(one.path, one.name),
          Cell(text_or_nothing(one.head.problem)),
          Cell(one.problem_version > 0 ? Value(one.problem_version) : Value()),
          Cell(text_or_nothing(one.head.engine)),
          Cell(text_or_nothing(one.head.version)),
          Cell(text_or_nothing(one.head.settings)),
          Cell(score.law),
          Cell(score.law_is_declared),
          step_cell(one.head.step),
          Cell(static_cast<long long>(score.found)),
          Cell(static_cast<long long>(score.expected)),
          Cell(score.order_is_right),
          error_cell(score.law_error),
          error_cell(score.velocity_error),
          error_cell(score.angular_error),
          error_cell(score.time_error),
          one.is_list ? error_cell(score.impulse_error) : Cell(),
          error_cell(score.energy_error),
          one.is_list ? Cell() : error_cell(score.flight_error),
          one.is_list ? Cell() : error_cell(score.start_error),
          one.gradients ? error_cell(score.gradient_error) : Cell(),
          error_cell(score.error()),
          Cell(score.error() > 0 ? Value(score.decided_by()) : Value()),
          Cell(verdict_name(one.verdict)),
          Cell(text_or_nothing(score.findings.empty() ? std::string() : score.findings.front()))};
}

/// The share of the error of V, Ω and t that goes without a cause; below 0 where it would be larger, NaN where that is
/// not known.
double share_of(const Submission& one, const Cause& cause) {
  const double share = 1 - cause.error_without.value_or(Score::unknown) / one.score.motion_error();
  return std::isfinite(share) ? share : std::nan("");
}

Value submission_value(const std::vector<Column>& columns, const Submission& one) {
  Value value = row_object(columns, submission_row(one));
  value["findings"] = one.score.findings;
  value["law_unexplained"] = one.law_is_unexplained;
  Value causes{Value::List{}};
  for (const Cause& cause : one.causes) {
    causes.push_back(Value::Fields{{"cause", cause.name},
                                   {"value", cause.value ? Value(*cause.value) : Value()},
                                   {"misfit", cause.misfit},
                                   {"share", share_of(one, cause)},
                                   {"words", cause.words}});
  }
  value["causes"] = std::move(causes);
  Value impacts{Value::List{}};
  int n = 0;
  for (const ImpactScore& impact : one.score.impacts) impacts.push_back(impact_value(impact, ++n));
  value["impact_scores"] = std::move(impacts);
  return value;
}

Value group_value(const SubmissionGroup& group) {
  Value value;
  value["problem"] = text_or_nothing(group.head.problem);
  value["engine"] = text_or_nothing(group.head.engine);
  value["version"] = text_or_nothing(group.head.version);
  value["settings"] = text_or_nothing(group.head.settings);
  value["law"] = text_or_nothing(group.head.law);
  value["verdict"] = verdict_name(group.verdict);
  value["order"] = group.order ? Value(group.order->value) : Value();
  value["order_error"] = group.order ? error_or_nothing(*group.order) : Value();
  value["causes"] = Value::List{};
  for (const auto& [name, files, leads] : group.causes)
    value["causes"].push_back(Value::Fields{
        {"cause", name}, {"files", static_cast<long long>(files)}, {"first_in", static_cast<long long>(leads)}});
  value["unexplained"] = rounded_up(group.unexplained);
  for (const SubmissionGroup::Step& step : group.steps) {
    Value one;
    one["step"] = step.step ? Value(*step.step) : Value();
    one["files"] = static_cast<long long>(step.files);
    one["motion_error"] = rounded_up(step.motion_error);
    one["law_error"] = rounded_up(step.law_error);
    one["error"] = step.error;
    one["verdict"] = verdict_name(step.verdict);
    value["steps"].push_back(std::move(one));
  }
  return value;
}

/// Causes that explain a run in place of each other in one line, those beside them in lines of their own; first that
/// the law is broken where none explains that.
std::vector<std::string> cause_words(const Submission& one) {
  std::vector<std::string> lines, either;
  if (one.law_is_unexplained) lines.push_back(fmt::format("{}: {}", unexplained_law, one.score.law_words));
  for (const Cause& cause : one.causes) {
    if (cause.is_more || one.law_is_unexplained) lines.push_back("and: " + cause.words);
    else either.push_back(cause.words);
  }
  if (either.empty()) return lines;
  const std::string first = either.size() > 1 ? "either " : "";
  lines.insert(lines.begin(), fmt::format("likely cause: {}{}", first, fmt::join(either, "; or ")));
  return lines;
}

/// With two digits, as errors are everywhere.
std::string error_words(double error) { return std::isfinite(error) ? significant(rounded_up(error), 2) : "?"; }

/// " of impact 3": whose error it is that decides; empty: none's alone.
std::string deciding_impact(const Score& score) {
  const std::string by = score.decided_by();
  const auto error = [&](const ImpactScore& one) {
    return by == "law" ? one.law_error
           : by == "V" ? one.velocity_error
           : by == "Ω" ? one.angular_error
           : by == "t" ? std::fabs(one.time_error)
                       : std::nan("");
  };
  const auto worst = std::ranges::max_element(score.impacts, {}, error);
  if (worst == score.impacts.end() || !(error(*worst) > 0)) return "";
  return fmt::format(" of impact {}", worst - score.impacts.begin() + 1);
}

/// "coarse by t of impact 3, off by 0.0042"
std::string class_words(const Submission& one) {
  const double error = one.score.error();
  return fmt::format("{} by {}{}{}", verdict_name(one.verdict), one.score.decided_by(), deciding_impact(one.score),
                     std::isfinite(error) ? ", off by " + error_words(error) : "");
}

/// "box, some engine, tuned": what the files of a group have alike.
std::string group_name(const SubmissionHead& head) {
  std::string words;
  for (const std::string& part : {head.problem, head.engine, head.version, head.settings}) {
    if (!part.empty()) words += (words.empty() ? "" : ", ") + part;
  }
  return words;
}

/// "box, some engine: order 1.17 ± 0.05 with 5 steps; 0.00208 s: off by 0.085, fails; 0.000130 s: off by 0.0039,
/// coarse"
std::string group_words(const SubmissionGroup& group) {
  std::string words = group_name(group.head);
  if (words.empty()) words = "all files";
  const auto off = [](const SubmissionGroup::Step& step) {
    return fmt::format("off by {}, {}", error_words(step.error), verdict_name(step.verdict));
  };
  std::string unknown;
  std::vector<SubmissionGroup::Step> steps, right;  // with a known length; with all impacts right
  for (const SubmissionGroup::Step& step : group.steps) {
    if (!step.step) unknown = "; step unknown, for want of a line \"# step:\": " + off(step);
    else steps.push_back(step);
    if (step.step && std::isfinite(step.motion_error)) right.push_back(step);
  }
  if (steps.empty()) return words + unknown;
  if (steps.size() == 1) return words + ": " + off(steps.front()) + unknown;
  std::string order = "no order";
  if (group.order) order = fmt::format("order {:.2f}", group.order->value);
  if (group.order && std::isfinite(group.order->error)) order += " ± " + significant(rounded_up(group.order->error), 1);
  order += fmt::format(" with {} steps", right.size());
  if (group.order && right.size() == 2) order += ", too few to tell its error";
  if (group.order) {
    const auto [few, many] = std::ranges::minmax(right, {}, &SubmissionGroup::Step::files);
    if (few.files != many.files)
      order += fmt::format(" of {} to {} starts, which are not alike", few.files, many.files);
  }
  const SubmissionGroup::Step &longest = steps.front(), &shortest = steps.back();
  return words + fmt::format(": {}; {} s: {}; {} s: {}{}", order, significant(*longest.step, 3), off(longest),
                             significant(*shortest.step, 3), off(shortest), unknown);
}

/// "causes: time-step in 24 of 24 files, first-order-step in 20; with all of them mended V and Ω are off by 3e-5"
std::string group_causes(const SubmissionGroup& group) {
  std::string words = "causes";
  for (const std::string& part : {group.head.problem, group.head.engine, group.head.settings})
    words += (part.empty() ? "" : words == "causes" ? " in " : ", ") + part;
  std::string separator = ": ";
  for (const auto& [name, files, leads] : group.causes) {
    words += separator + fmt::format("{} in {}", name, files);
    if (separator == ": ") words += fmt::format(" of {} files", group.files);
    separator = ", ";
  }
  if (std::isfinite(group.unexplained))
    words += "; with all of them mended V and Ω are off by " + error_words(group.unexplained) + " at most";
  return words;
}

/// The likely cause, and how much of the error of V, Ω and t would go without it: "time-step (91 %)".
std::string short_reason(const Submission& one) {
  if (one.law_is_unexplained) return unexplained_law;
  if (one.causes.empty()) return "";
  const Cause& cause = one.causes.front();
  const double share = share_of(one, cause);
  return cause.name + (share > 0 ? fmt::format(" ({:.0f} %)", 100 * share) : "");
}

/// The files of a group stand together, the longest step first.
std::vector<Submission> by_group(std::vector<Submission> submissions) {
  std::ranges::stable_sort(submissions, {}, [](const Submission& one) {
    return std::tuple_cat(one.head.group(), std::tuple(-one.head.step.value_or(0)));
  });
  return submissions;
}

/// A line for each of many files.
/// @param says_what  whether it has what the error is one of
Grid files_in_lines(const std::vector<Submission>& submissions, bool says_what) {
  Grid lines;
  lines.columns = {word_column("file", "file", ""),
                   {"step", "step", "s"},
                   {"error", "error", ""},
                   word_column("decided_by", "of", ""),
                   word_column("verdict", "verdict", ""),
                   word_column("cause", "likely cause", "")};
  lines.columns[3].shown = says_what;
  for (const Submission& one : submissions) {
    const Score& score = one.score;
    const bool has_all = score.order_is_right || score.ends_early;
    const std::string of = !has_all ? "impacts" : score.error() > 0 ? score.decided_by() : "";
    lines.rows.push_back({Cell(one.name), one.head.step ? Cell(*one.head.step, 3) : Cell(), error_cell(score.error()),
                          Cell(text_or_nothing(of)), Cell(verdict_name(one.verdict)),
                          Cell(text_or_nothing(short_reason(one)))});
  }
  return lines;
}

/// A line for each group of files.
Grid groups_in_lines(const std::vector<SubmissionGroup>& groups, const std::vector<Submission>& submissions) {
  Grid lines;
  lines.columns = {
      word_column("problem", "problem", ""), {"files", "files", ""}, word_column("best", "best", ""),
      word_column("worst", "worst", ""),     {"order", "order", ""}, word_column("cause", "commonest cause", "")};
  for (const SubmissionGroup& group : groups) {
    Verdict best = group.verdict;
    for (const Submission& one : submissions) {
      if (one.head.group() == group.head.group()) best = std::min(best, one.verdict);
    }
    std::string cause;
    for (const auto& [name, files, leads] : group.causes) {  // all that are as common and as often the first
      if (files != group.causes.front().files || leads != group.causes.front().leads) break;
      cause += (cause.empty() ? "" : ", ") + fmt::format("{} in {}", name, files);
    }
    lines.rows.push_back({Cell(group_name(group.head)), Cell(static_cast<long long>(group.files)),
                          Cell(verdict_name(best)), Cell(verdict_name(group.verdict)),
                          group.order ? Cell(group.order->value, 3) : Cell(), Cell(text_or_nothing(cause))});
  }
  return lines;
}

/// What is wrong with a file, and why.
/// @param all  whether its findings are told, not the first alone
void add_details(const Submission& one, bool all, std::vector<std::string>& notes) {
  const std::string name = one.name;
  const bool says_why = !one.score.order_is_right || one.verdict == Verdict::incomplete;  // in a finding
  if (one.verdict != Verdict::exact && !says_why) notes.push_back(name + ": " + class_words(one));
  for (const std::string& words : cause_words(one)) notes.push_back(name + ": " + words);
  for (const std::string& finding : one.score.findings) {
    if (one.law_is_unexplained && finding == one.score.law_words) continue;
    notes.push_back(name + ": " + finding);
    if (all || one.score.findings.size() == 1) continue;
    notes.push_back(fmt::format("{}: {} findings in all, by --details", name, one.score.findings.size()));
    break;
  }
  if (!one.is_list && !one.head.step) notes.push_back(name + ": its step is unknown, for want of a line \"# step:\"");
  if (!one.score.law_is_declared && one.score.law != "any")
    notes.push_back(name + ": declares no law; judged by the one that fits best, " + one.score.law);
}

constexpr double least_drawn = 1e-17, most_drawn = 10;  // errors are drawn there that are 0, larger or unknown

/// Errors of impacts by one curve, and the axes that show them.
struct DrawnAnswer {
  std::string legend;
  std::vector<double> errors;  ///< of each impact
};

void add_answer(const DrawnAnswer& answer, double curve, PicturePanel& panel) {
  constexpr double colours = 9;  // of the palette: curves beyond look otherwise
  for (std::size_t n = 0; n < answer.errors.size(); ++n) {
    const double error = std::clamp(answer.errors[n], least_drawn, most_drawn), at = static_cast<double>(n + 1);
    panel.rows.push_back({curve, at, error});
    Range2& y = panel.plot.y;
    y = {std::fmin(y.low, error / 5), std::fmax(y.high, error * 5)};
    panel.plot.x.high = std::fmax(panel.plot.x.high, at + 0.5);
  }
  panel.plot.curves.push_back({.x = "impact",
                               .y = "error",
                               .legend = answer.legend,
                               .style = curve < colours            ? FigureCurve::Style::line_points
                                        : answer.errors.size() > 1 ? FigureCurve::Style::dashed
                                                                   : FigureCurve::Style::squares,
                               .where = {{"curve", curve}}});
}

std::vector<double> errors_of(const Submission& submission) {
  std::vector<double> errors;
  for (const ImpactScore& one : submission.score.impacts) errors.push_back(one.error);
  return errors;
}

/// A curve for each file or, where these are many, of each group with the worst error of each impact.
std::vector<DrawnAnswer> drawn_answers(const std::vector<Submission>& submissions,
                                       const std::vector<SubmissionGroup>& groups) {
  constexpr std::size_t many = 6;
  std::vector<DrawnAnswer> drawn;
  if (submissions.size() <= many || groups.size() == submissions.size()) {
    for (const Submission& one : submissions)
      drawn.push_back({fmt::format("{}: {}", one.name, verdict_name(one.verdict)) +
                           (std::isfinite(one.score.error()) ? " by " + one.score.decided_by() : ""),
                       errors_of(one)});
    return drawn;
  }
  for (const SubmissionGroup& group : groups) {
    const std::string name = group_name(group.head);
    DrawnAnswer& worst =
        drawn.emplace_back(DrawnAnswer{fmt::format("{}{}worst of {} files: {}", name, name.empty() ? "" : ", ",
                                                   group.files, verdict_name(group.verdict)),
                                       {}});
    for (const Submission& one : submissions) {
      if (one.head.group() != group.head.group()) continue;
      const std::vector<double> errors = errors_of(one);
      worst.errors.resize(std::max(worst.errors.size(), errors.size()));
      for (std::size_t n = 0; n < errors.size(); ++n) worst.errors[n] = worse(worst.errors[n], errors[n]);
    }
  }
  return drawn;
}

constexpr double wrong_impacts = -10;  ///< curve of steps at which a file has wrong, missing or more impacts

/// The worst error of V, Ω and t of a group over its steps.
void add_steps(const SubmissionGroup& group, double curve, PicturePanel& panel) {
  for (const SubmissionGroup::Step& step : group.steps) {
    if (!step.step) continue;
    const bool is_known = std::isfinite(step.motion_error);
    const double error = is_known ? std::clamp(step.motion_error, least_drawn, most_drawn) : 1;
    panel.rows.push_back({is_known ? curve : wrong_impacts, *step.step, error});
    Range2& y = panel.plot.y;
    y = {std::fmin(y.low, error / 5), std::fmax(y.high, error * 5)};
    Range2& x = panel.plot.x;
    x = {std::fmin(x.low, *step.step / 1.3), std::fmax(x.high, *step.step * 1.3)};
  }
  std::string name = group.head.problem;
  for (const std::string& part : {group.head.engine, group.head.settings}) name += (part.empty() ? "" : " ") + part;
  if (group.order) name += fmt::format(": order of the mean {:.2f}", group.order->value);
  if (group.incomplete > 0) name += fmt::format(", {} of {} files incomplete", group.incomplete, group.files);
  panel.plot.curves.push_back({.x = "step",
                               .y = "error",
                               .legend = name,
                               .style = FigureCurve::Style::line_points,
                               .where = {{"curve", curve}}});
}

/// Their limits as dotted lines, those within the axis.
void add_classes(const std::vector<double>& tolerances, const std::string& of_what, PicturePanel& panel) {
  const std::string& axis = panel.columns[1].name;
  for (std::size_t k = 0; k < tolerances.size(); ++k) {
    if (!(tolerances[k] > panel.plot.y.low && tolerances[k] < panel.plot.y.high)) continue;
    const double curve = -1 - static_cast<double>(k);
    for (const double x : {panel.plot.x.low, panel.plot.x.high}) panel.rows.push_back({curve, x, tolerances[k]});
    panel.plot.curves.push_back({.x = axis,
                                 .y = "error",
                                 .legend = fmt::format("limit of {}{}", verdict_name(static_cast<Verdict>(k)), of_what),
                                 .style = k % 2 == 0 ? FigureCurve::Style::dotted : FigureCurve::Style::dashed,
                                 .where = {{"curve", curve}},
                                 .colour = ink});
  }
}

}  // namespace

std::vector<Column> score_columns() {
  return {
      word_column("file", "file", "that was judged"),
      Column{"problem", "problem", "", "from its line # problem:", true, true},
      Column{"problem_version", "", "", "of the problem", false},
      Column{"engine", "", "", "from its line # engine:", false, true},
      Column{"engine_version", "", "", "from its line # version:", false, true},
      Column{"settings", "", "", "from its line # settings:", false, true},
      Column{"law", "", "", "that the impacts are judged by; any: the laws agree", false, true},
      Column{"law_declared", "", "", "whether the file says so; otherwise the law that fits best", false},
      {"step", "step", "s", "from its line # step:"},
      {"found", "found", "", "impacts found"},
      {"expected", "of", "", "impacts of the truth"},
      Column{"order_right", "", "", "whether number and places are right, in their order", false},
      {"law_error", "law", "", "largest distance of an impact from the exact map at the code's own state, relative"},
      {"velocity_error", "V", "", "largest error of V after an impact, over the sequence's largest"},
      {"angular_velocity_error", "Ω", "", "the same of Ω"},
      {"time_error", "t", "", "largest error of an impact's time, over that of the last impact"},
      Column{"impulse_error", "", "", "of a list the largest error of an impulse, over the sequence's largest", false},
      {"energy_error", "energy", "", "largest error of energy after impacts, or drift between them, over the start's"},
      Column{"flight_error", "", "",
             "the farthest of a row off the free flight since the impact before, over the body's reach", false},
      Column{"start_error", "", "", "distance of the state at the first touch from the problem's", false},
      Column{"gradient_error", "d/d", "", "of a list that gives derivatives their largest error", false},
      Column{"error", "", "", "the largest of all", false},
      Column{"decided_by", "", "", "what that is an error of", false, true},
      word_column("verdict", "verdict", "class of tolerance: exact, sharp, good, coarse, fails"),
      Column{"finding", "", "", "what is wrong, the first", false, true}};
}

/// What stands below the table.
std::vector<std::string> score_legend() {
  return {"found, of: impacts found, impacts asked for",
          "law: off the exact law at the run's own state, of the change that it makes",
          "V, Ω: off the truth, of the sequence's largest; t: off it, of the last one's",
          "energy: off the truth, and drift between impacts, of the start's",
          "all without units, 1 is 100 %; ?: not told, impacts are wrong, missing or extra"};
}

Report score_report(const std::string& command, const std::vector<Submission>& submissions, bool details) {
  Report report = begun_report(command, "answers of others against the truth");
  report.grid.columns = score_columns();
  const std::vector<Submission> sorted = by_group(submissions);
  const bool in_lines = submissions.size() > 1 && !details;
  const std::vector<SubmissionGroup> groups = group_submissions(submissions);
  const bool by_problem = in_lines && groups.front().head.problem != groups.back().head.problem;  // they are sorted
  if (in_lines) {
    report.digest = files_in_lines(sorted, !by_problem);
    if (by_problem) report.further = std::exchange(report.digest, groups_in_lines(groups, submissions));
    report.notes = {
        "error: the largest of all, without unit, 1 is 100 %; ?: impacts are wrong, missing or extra; --details tells "
        "all errors and findings of each file"};
  } else {
    report.notes = score_legend();
  }
  Value files{Value::List{}}, problems{Value::List{}};
  Verdict worst = Verdict::exact;
  for (const Submission& one : submissions) {
    report.grid.rows.push_back(submission_row(one));
    for (Column& column : report.grid.columns) column.shown |= one.gradients && column.name == "gradient_error";
    files.push_back(submission_value(report.grid.columns, one));
    worst = std::max(worst, one.verdict);
  }
  if (!in_lines) {
    report.digest = Grid{report.grid.columns, {}};
    for (const Submission& one : sorted) {
      report.digest->rows.push_back(submission_row(one));
      add_details(one, details || command == "benchmark", report.notes);
    }
  }
  for (const SubmissionGroup& group : groups) {
    problems.push_back(group_value(group));
    if (by_problem) continue;
    if (submissions.size() > 1) report.notes.push_back(group_words(group));
    if (group.files > 1 && !group.causes.empty()) report.notes.push_back(group_causes(group));
  }
  report.fields["verdict"] = verdict_name(worst);
  report.fields["files"] = std::move(files);
  report.fields["problems"] = std::move(problems);
  return report;
}

void add_unread(const std::vector<UnreadFile>& unread, Report& report) {
  Value files{Value::List{}};
  for (const UnreadFile& one : unread) {
    files.push_back(Value::Fields{{"file", one.path}, {"reason", one.reason}});
    report.notes.push_back("not judged: " + one.reason);
  }
  report.fields["unread"] = std::move(files);
}

bool Requirement::is_met(const Submission& submission) const {
  if (verdict && !(submission.verdict <= *verdict)) return false;
  return !error || (submission.score.left_out.empty() && submission.score.error() <= *error);
}

bool meets(const Submission& submission, const Requirement& requirement) {
  if (requirement.is_met(submission)) return true;
  say(fmt::format("{}: {}; asked for {}", submission.path, class_words(submission),
                  requirement.verdict ? verdict_name(*requirement.verdict) : fmt::format("{}", *requirement.error)));
  return false;
}

Requirement read_requirement(const std::string& name, const std::string& text) {
  double error = 0;
  if (read_number(text, error)) return {.verdict = {}, .error = read_number_option(name, text, positive_number)};
  std::vector<std::string> names = verdict_names();
  names.pop_back();
  const auto at = std::find(names.begin(), names.end(), text);
  if (at == names.end()) {
    throw BadInput(fmt::format("{} '{}': must be one of {}, or a largest error such as 1e-3{}", name, text,
                               fmt::join(names, ", "), suggestion(text, names, true)));
  }
  return {.verdict = static_cast<Verdict>(at - names.begin()), .error = {}};
}

Picture score_picture(const std::vector<Submission>& submissions) {
  const std::vector<SubmissionGroup> groups = group_submissions(submissions);
  const bool over_steps = std::ranges::any_of(
      groups, [](const SubmissionGroup& group) { return group.steps.size() > 1 && group.steps.back().step; });
  PicturePanel panel{.columns = {{"curve", "1", "number of the file or group; below 0 of a class of tolerance"},
                                 {"impact", "1", "number of the impact"},
                                 {"error", "1", "the largest of all errors of the impact and the flight after it"}},
                     .plot = {.x_label = "number of the impact",
                              .y_label = "largest error, relative",
                              .x = {0.5, 1.5},
                              .y = {},
                              .legend_place = "beside",
                              .logarithmic_x = over_steps,
                              .logarithmic_y = true,
                              .whole_x = !over_steps}};
  if (over_steps) {
    panel.columns[1] = {"step", "s", "of time"};
    panel.columns[2].quantity = "the largest of V, Ω and t";
    panel.plot.x_label = "step [s]";
    panel.plot.y_label = "error of V, Ω and t, relative, of the worst start";
    panel.plot.x = {};
    for (std::size_t i = 0; i < groups.size(); ++i) add_steps(groups[i], static_cast<double>(i), panel);
    panel.plot.curves.push_back({.x = "step",
                                 .y = "error",
                                 .legend = "at 1: impacts of a file wrong, missing, extra or cut off",
                                 .style = FigureCurve::Style::crosses,
                                 .where = {{"curve", wrong_impacts}},
                                 .colour = ink});
  } else {
    for (double curve = 0; const DrawnAnswer& one : drawn_answers(submissions, groups)) add_answer(one, curve++, panel);
    if (!(panel.plot.y.low < panel.plot.y.high)) panel.plot.y = {least_drawn, most_drawn};  // no impact at all
  }
  std::vector<std::string> problems;
  bool have_one_scale = true;
  const std::string& first = submissions.front().asked;
  const std::vector<double>& tolerances = submissions.front().tolerances;
  for (const Submission& one : submissions) {
    const std::string name = (one.problem_version > 0 ? "problem " : "") + one.asked;
    if (std::find(problems.begin(), problems.end(), name) == problems.end()) problems.push_back(name);
    have_one_scale = have_one_scale && one.tolerances == tolerances;
  }
  add_classes(tolerances, have_one_scale ? "" : " of " + first, panel);
  return {.what = over_steps ? "Errors of answers over their time steps" : "Errors of answers, impact by impact",
          .scene = problems,
          .panels = {panel}};
}

Report against_report(const Scene& scene, const Reference& reference, const std::vector<Submission>& submissions,
                      bool details) {
  Report report = score_report("compare", submissions, details);
  report.head = scene_head(scene, Model::discrete);
  report.fields["scene"] = scene_value(scene, Model::discrete);
  report.fields["message"] = text_or_nothing(reference.remark);
  if (!reference.remark.empty()) report.notes.push_back(reference.remark);
  return report;
}

}  // namespace clatter::validation
