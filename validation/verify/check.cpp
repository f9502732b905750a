// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/check.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <set>
#include <stdexcept>

#include "validation/embedded/embedded.hpp"

namespace clatter::validation::inline verify {
namespace {

constexpr double loosest = 5;  // times the error seen

[[noreturn]] void unsound(const std::string& id, const std::string& why) {
  throw std::runtime_error(fmt::format("validation/verify/checks.toml: {}: {}", id, why));
}

Answer answer_of(const std::string& id, const std::string& name) {
  for (const Answer answer : {Answer::holds, Answer::refuted, Answer::ambiguous}) {
    if (name == answer_name(answer)) return answer;
  }
  unsound(id, "answer must be holds, refuted or ambiguous");
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
              .answer = Answer::holds,
              .quick = row["quick"].value_or(true),
              .figure = row["figure"].value<int>(),
              .command = text("command")};
  check.answer = answer_of(check.id, row["answer"].value_or(std::string("holds")));
  for (const std::string* required :
       {&check.what, &check.claim, &check.number, &check.oracle, &check.error, &check.reason, &check.command}) {
    if (required->empty()) unsound(check.id, "what, claim, number, oracle, error, reason and command are required");
  }
  if (!(check.tolerance > 0 && check.tolerance <= loosest * check.seen * (1 + 1e-12))) {
    unsound(check.id, "the tolerance must be positive and at most 5 times the error seen");
  }
  return check;
}

std::vector<Check> read_checks() {
  const toml::table table = toml::parse(embedded_text("validation/verify/checks.toml"));
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

}  // namespace

const char* answer_name(Answer answer) {
  switch (answer) {
    case Answer::holds: return "holds";
    case Answer::refuted: return "refuted";
    case Answer::ambiguous: return "ambiguous";
  }
  return "";
}

const std::vector<Check>& all_checks() {
  static const std::vector<Check> checks = read_checks();
  return checks;
}

const Measures& all_measures() {
  static const Measures measures = [] {
    Measures all;
    add_exact_measures(all);
    add_angle_claim_measures(all);
    add_claim_measures(all);
    add_erratum_measures(all);
    add_figure_measures(all);
    add_model_measures(all);
    add_bar_measures(all);
    add_space_measures(all);
    add_measured_measures(all);
    return all;
  }();
  return measures;
}

}  // namespace clatter::validation::inline verify
