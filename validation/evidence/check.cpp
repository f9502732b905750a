// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/check.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <exception>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/processor_time.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

constexpr double loosest = 5;  // times the error seen

[[noreturn]] void unsound(const std::string& id, const std::string& why) {
  throw std::runtime_error(fmt::format("validation/evidence/checks.toml: {}: {}", id, why));
}

Finding answer_of(const std::string& id, const std::string& name) {
  for (const Finding answer : {Finding::holds, Finding::refuted, Finding::ambiguous, Finding::misprint}) {
    if (name == answer_name(answer)) return answer;
  }
  unsound(id, "answer must be holds, refuted, ambiguous or misprint");
}

Check check_of(const toml::table& row) {
  const auto text = [&](const char* key) { return row[key].value_or(std::string()); };
  Check check{.id = text("id"),
              .what = text("what"),
              .claim = text("claim"),
              .number = text("number"),
              .unit = text("unit"),
              .oracle = text("oracle"),
              .error = text("error"),
              .seen = row["seen"].value_or(0.0),
              .tolerance = row["tolerance"].value_or(0.0),
              .reason = text("reason"),
              .answer = Finding::holds,
              .quick = row["quick"].value_or(true),
              .figure = row["figure"].value<int>(),
              .command = text("command"),
              .place = text("place"),
              .printed = text("printed"),
              .right = text("right"),
              .compared = text("compared"),
              .compared_unit = text("compared_unit")};
  check.answer = answer_of(check.id, row["answer"].value_or(std::string("holds")));
  for (const std::string* required :
       {&check.what, &check.claim, &check.number, &check.oracle, &check.error, &check.reason, &check.command}) {
    if (required->empty()) unsound(check.id, "what, claim, number, oracle, error, reason and command are required");
  }
  if (check.id.starts_with('E') &&
      (check.place.empty() || check.printed.empty() || check.right.empty() || check.compared.empty()))
    unsound(check.id, "an erratum needs place, printed, right and compared");
  if (!(check.tolerance > 0 && check.tolerance <= loosest * check.seen * (1 + 1e-12)))
    unsound(check.id, "the tolerance must be positive and at most 5 times the error seen");
  return check;
}

const CheckMeasures& all_measures() {
  static const CheckMeasures measures = [] {
    CheckMeasures all;
    for (const auto& group : {claim_measures, erratum_measures, exact_measures, figure_measures, model_measures,
                              bar_measures, space_measures}) {
      all.merge(group());
    }
    return all;
  }();
  return measures;
}

std::vector<Check> read_checks() {
  const toml::table table = toml::parse(embedded_text("validation/evidence/checks.toml"));
  std::vector<Check> checks;
  std::set<std::string> ids;
  for (const toml::node& node : *table["check"].as_array()) {
    checks.push_back(check_of(*node.as_table()));
    if (!ids.insert(checks.back().id).second) unsound(checks.back().id, "given twice");
    if (!all_measures().contains(checks.back().id)) unsound(checks.back().id, "nothing measures it");
  }
  for (const auto& [id, measure] : all_measures()) {
    if (!ids.contains(id)) unsound(id, "is measured but not in the table");
  }
  return checks;
}

std::string judge(const Check& check, const Measured& measured) {
  if (!(measured.error <= check.tolerance))
    return fmt::format("the error {} is not within {}", significant(measured.error, 3), shortest(check.tolerance));
  if (measured.answer != check.answer)
    return fmt::format("the answer is {}, expected was {}", answer_name(measured.answer), answer_name(check.answer));
  return "";
}

CheckResult run(const Check& check, CaseRuns& case_runs) {
  CheckResult result{.check = &check, .done = true};
  const double begin = thread_seconds();
  try {
    result.measured = all_measures().at(check.id)(case_runs);
    result.failure = judge(check, result.measured);
  } catch (const CaseRuns::Interrupted&) {
    result.done = false;
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  result.seconds = thread_seconds() - begin;
  return result;
}

/// Ids as a hand writes them: several in one word, between commas, in small letters.
std::vector<std::string> ids_in(const std::vector<std::string>& words) {
  std::vector<std::string> ids;
  for (const std::string& word : words) {
    std::istringstream parts(word);
    for (std::string id; std::getline(parts, id, ',');) {
      std::transform(id.begin(), id.end(), id.begin(), [](unsigned char c) { return std::toupper(c); });
      ids.push_back(id);
    }
  }
  return ids;
}

std::vector<ReferenceRow> read(const std::string& name) {
  std::vector<ReferenceRow> rows;
  for (const oracle::ReferenceRow& words : reference_words(name)) {
    ReferenceRow& row = rows.emplace_back();
    for (const auto& [column, cell] : words) {
      double value = 0;
      if (read_number(cell, value)) row[column] = value;
    }
  }
  return rows;
}

long double slope(long double theta) {
  const long double c = std::cos(theta);
  return (1 - 3 * c * c) / (6 * c);
}

/// Height of the grazing end at its lowest point; negative: it strikes.
long double clearance(long double theta) {
  const long double k = slope(theta), beta = std::acos(k);
  return std::sin(theta) + k * (theta + beta) - std::sin(beta);
}

long double fold() {
  long double low = 1.0L, high = 1.03L;  // 57.3° … 59.0°
  for (int i = 0; i < 80; ++i) {
    const long double middle = (low + high) / 2;
    (clearance(middle) < 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

const char* answer_name(Finding answer) {
  switch (answer) {
    case Finding::holds: return "holds";
    case Finding::refuted: return "refuted";
    case Finding::ambiguous: return "ambiguous";
    case Finding::misprint: return "misprint";
  }
  return "";
}

const std::vector<Check>& all_checks() {
  static const std::vector<Check> checks = read_checks();
  return checks;
}

CheckSelection select_checks(bool quick, const std::vector<std::string>& only) {
  if (quick && !only.empty()) throw BadInput("--quick: excludes --only; give one of them, not both");
  std::vector<std::string> ids;
  for (const Check& check : all_checks()) ids.push_back(check.id);
  const std::vector<std::string> chosen = ids_in(only);
  for (const std::string& id : chosen) static_cast<void>(read_name_option("--only", id, ids));
  CheckSelection selection;
  for (const Check& check : all_checks()) {
    const bool named = std::find(chosen.begin(), chosen.end(), check.id) != chosen.end();
    if (only.empty() ? check.quick || !quick : named) selection.checks.push_back(&check);
  }
  const std::size_t count = selection.checks.size();
  selection.words = only.empty() ? fmt::format("{} set: {} checks of {}", quick ? "quick" : "full", count, ids.size())
                                 : fmt::format("{} checks by name", count);
  return selection;
}

std::vector<CheckResult> verify_checks(
    const std::vector<const Check*>& checks, CaseRuns& case_runs,
    const std::function<bool(std::size_t, std::size_t, const std::string&)>& progress) {
  std::vector<CheckResult> results(checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) results[i].check = checks[i];
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> go_on = true;
  std::mutex mutex;
  std::size_t done = 0;
  const auto work = [&] {
    for (std::size_t i; go_on && (i = next++) < checks.size();) {
      // The last in the table take longest, so they come first.
      const std::size_t place = checks.size() - 1 - i;
      CheckResult result = run(*checks[place], case_runs);
      const std::lock_guard lock(mutex);
      results[place] = std::move(result);
      if (!progress(++done, checks.size(), checks[place]->id)) go_on = false;
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t count = std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), checks.size());
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back(work);
  threads.clear();
  return results;
}

std::vector<oracle::ReferenceRow> reference_words(const std::string& name) {
  std::istringstream text{std::string(embedded_text("validation/oracles/reference/" + name))};
  return oracle::reference_rows(text);
}

const std::vector<ReferenceRow>& reference_table(ReferenceTable table) {
  static const std::vector<ReferenceRow> no_gravity = read("rod_sequence_no_gravity.csv");
  static const std::vector<ReferenceRow> gravity = read("rod_sequence_gravity.csv");
  return table == ReferenceTable::gravity ? gravity : no_gravity;
}

double second_impact_fold() { return static_cast<double>(fold()); }

double second_impact_fold_beta() { return static_cast<double>(std::acos(slope(fold()))); }

}  // namespace clatter::validation
