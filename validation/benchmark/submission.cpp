// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/submission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "validation/benchmark/gradient_score.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"

namespace clatter::validation {
namespace {

/// A file's text as a table of the kind that its header says.
struct ReadFile {
  NumericTable table;
  bool is_list;
  std::vector<GradientColumn> gradients;  ///< of a list
};

ReadFile read_file(const std::string& path, const ColumnNames& names) {
  std::string text = NumericTable::text_of(path);
  const std::vector<std::string> header = NumericTable::header_of(text);
  const auto has = [&](const char* name) {
    return names.contains(name) || std::find(header.begin(), header.end(), name) != header.end();
  };
  const bool is_list = has("place");
  if (!is_list) {
    const TableRequest request = Motion::request(Motion::is_in_space(header, names), names);
    return {NumericTable::parse(path, std::move(text), request), is_list, {}};
  }
  TableRequest request = impact_list_request(has("Px"), names);
  std::vector<GradientColumn> gradients = gradient_columns_of(header, has("Px"));
  for (const GradientColumn& column : gradients) request.words.push_back(column.name);
  return {NumericTable::parse(path, std::move(text), request), is_list, std::move(gradients)};
}

SubmissionHead head_of(const NumericTable& table) {
  const auto text = [&](const char* key) { return table.comment(key).value_or(""); };
  SubmissionHead head{.problem = text("problem"),
                      .engine = text("engine"),
                      .version = text("version"),
                      .settings = text("settings"),
                      .step = stated_step(table)};
  if (table.comment("law")) head.law = read_law(place_of(table, "law"), text("law"));
  return head;
}

/// The value of a line that has few of them; nothing without the line.
std::optional<std::string> chosen_comment(const NumericTable& table, const std::string& key,
                                          const std::vector<std::string>& allowed) {
  const auto given = table.comment(key);
  if (given && std::find(allowed.begin(), allowed.end(), *given) == allowed.end()) {
    throw BadInput(
        fmt::format("{} = {}: must be {}", place_of(table, key), shown_field(*given), fmt::join(allowed, " or ")));
  }
  return given;
}

Ending ending_of(const NumericTable& table) {
  Ending ending{.nothing_approaches = chosen_comment(table, "ended", {"nothing approaches"}).has_value(), .energy = {}};
  const auto energy = table.comment("energy");
  double value = 0;
  if (energy && !read_number(trimmed(*energy), value)) {
    throw BadInput(fmt::format("{} = {}: must be a number of joules", place_of(table, "energy"), shown_field(*energy)));
  }
  if (energy) ending.energy = value;
  return ending;
}

/// A list in the plane says which turn its Omega counts as positive: a guess would hide a wrong sign.
Score judge_list(const Answer& answer, const SubmissionHead& head, const Reference& reference) {
  const NumericTable& table = answer.table;
  Score score =
      score_list(listed_impacts(table, reference, answer.is_counter_clockwise), reference, head.law, answer.ending);
  if (table.column("Omega") && !table.comment("Omega")) {
    score.left_out = "no line \"# Omega: clockwise\" or \"# Omega: counter-clockwise\"";
    score.findings.insert(score.findings.begin(), "incomplete: " + score.left_out);
  }
  return score;
}

Submission judge(const ReadFile& file, const SubmissionHead& head, const Reference& reference) {
  Submission submission{
      .path = file.table.path(), .head = head, .is_list = file.is_list, .gradients = !file.gradients.empty()};
  const std::string other = "counter-clockwise";
  const Answer answer{
      .table = file.table,
      .is_list = file.is_list,
      .is_counter_clockwise = file.is_list && chosen_comment(file.table, "Omega", {"clockwise", other}) == other,
      .ending = ending_of(file.table)};
  submission.score = file.is_list ? judge_list(answer, head, reference)
                                  : score_motion(Motion(file.table, reference), reference, head.law, answer.ending);
  score_gradients(answer, file.gradients, reference, submission.score);
  submission.verdict = verdict_of(submission.score, reference.tolerances);
  if (!(submission.score.impacts_error() <= reference.tolerances[1])) {
    submission.causes = causes_of(answer, reference, submission.score);
  }
  return submission;
}

/// Least-squares slope of ln(error) over ln(step).
std::optional<double> observed_order(const std::vector<SubmissionGroup::Step>& steps) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const SubmissionGroup::Step& one : steps) {
    if (!one.step || !(one.motion_error > 0 && std::isfinite(one.motion_error))) continue;
    const double a = std::log(*one.step), b = std::log(one.motion_error);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double spread = n * xx - x * x;
  if (!(n >= 2 && spread > 1e-12 * n * xx)) return std::nullopt;
  return (n * xy - x * y) / spread;
}

}  // namespace

std::string read_law(const std::string& where, const std::string& text) {
  const std::vector<std::string> known{"newton", "poisson", "stronge", "routh", "moreau"};
  std::string words = text, restitution, friction;
  std::transform(words.begin(), words.end(), words.begin(),
                 [](unsigned char c) { return std::isalpha(c) ? static_cast<char>(std::tolower(c)) : ' '; });
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    const auto at = std::find(known.begin(), known.end(), word);
    std::string& part = at < known.begin() + 3 ? restitution : friction;
    if (at == known.end() || !part.empty()) {
      throw BadInput(
          fmt::format("{} = {}: must be newton, poisson or stronge, then routh or moreau", where, shown_field(text)));
    }
    part = word;
  }
  if (restitution.empty()) restitution = "newton";
  if (friction.empty()) friction = "routh";
  if (words.find_first_not_of(' ') == std::string::npos || (friction == "moreau" && restitution != "newton")) {
    throw BadInput(fmt::format("{} = {}: must be newton, poisson or stronge, then routh, or newton moreau", where,
                               shown_field(text)));
  }
  return restitution + " " + friction;
}

Submission judge_file(const std::string& path, const std::string& problem, const ColumnNames& names) {
  const ReadFile file = read_file(path, names);
  SubmissionHead head = head_of(file.table);
  std::string where = place_of(file.table, "problem");
  if (!problem.empty()) head.problem = problem, where = "--problem";
  if (head.problem.empty()) {
    throw BadInput(path + ": no line \"# problem: ID\" above the header; --problem names one");
  }
  const Problem& named = problem_named(where, head.problem);
  static std::map<std::string, Reference> references;  // many files have the same problem
  const auto found = references.find(named.id);
  const Reference& reference =
      found != references.end() ? found->second : references.emplace(named.id, reference_of(named)).first->second;
  Submission submission = judge(file, head, reference);
  submission.problem_version = named.version;
  return submission;
}

Submission judge_file(const std::string& path, const Reference& reference, const ColumnNames& names) {
  const ReadFile file = read_file(path, names);
  const SubmissionHead head = head_of(file.table);
  return judge(file, head, reference);
}

std::vector<SubmissionGroup> group_submissions(const std::vector<Submission>& submissions) {
  using Name = std::tuple<std::string, std::string, std::string, std::string, std::string>;
  std::map<Name, SubmissionGroup> groups;
  for (const Submission& one : submissions) {
    const SubmissionHead& head = one.head;
    SubmissionGroup& group = groups[{head.problem, head.engine, head.version, head.settings, head.law}];
    group.head = head;
    group.verdict = std::max(group.verdict, one.verdict);
    auto step = std::find_if(group.steps.begin(), group.steps.end(),
                             [&](const SubmissionGroup::Step& other) { return other.step == head.step; });
    if (step == group.steps.end()) step = group.steps.insert(step, {.step = head.step});
    ++step->files;
    step->motion_error = std::max(step->motion_error, one.score.motion_error());
    step->law_error = std::max(step->law_error, one.score.law_error);
    step->error = std::max(step->error, one.score.error());
  }
  std::vector<SubmissionGroup> all;
  for (auto& [name, group] : groups) {
    std::sort(group.steps.begin(), group.steps.end(),
              [](const auto& a, const auto& b) { return a.step.value_or(0) > b.step.value_or(0); });
    group.order = observed_order(group.steps);
    all.push_back(std::move(group));
  }
  return all;
}

}  // namespace clatter::validation
