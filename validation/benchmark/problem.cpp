// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

const std::string folder = "validation/benchmark/problems/";
const std::vector<std::string> texts{"id", "title", "class", "motivation", "separates", "acceptance"};
const std::vector<std::string> numbers{"t",  "Px", "Py", "Pz", "Vx",       "Vy",
                                       "Vz", "Wx", "Wy", "Wz", "duration", "uncertainty"};

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = scene_keys();
  for (const std::string& text : texts) keys.push_back("problem." + text);
  for (const char* key : {"version", "gaps", "until", "tolerances", "energy_alone", "at_rest", "end_energy",
                          "ground_end", "laws_agree"}) {
    keys.push_back(std::string("problem.") + key);
  }
  return keys;
}

Problem read_problem(const EmbeddedFile& file) {
  constexpr Range positive{0, 1e9, false, "at least 0"};
  const std::string path(file.name);
  const SceneValues values(path, file.text, known_keys());
  Problem problem;
  problem.id = values.text("problem.id");
  problem.version = static_cast<int>(values.integer("problem.version", 1, 1, 1000));
  problem.title = values.text("problem.title");
  problem.motivation = values.text("problem.motivation");
  problem.separates = values.text("problem.separates");
  problem.acceptance = values.text("problem.acceptance");
  problem.is_compliant = values.text("problem.class") == "compliant";
  problem.energy_alone = values.truth("problem.energy_alone", false);
  problem.at_rest = values.truth("problem.at_rest", false);
  constexpr Range finite{-1e9, 1e9, false, "finite"};
  if (values.has("problem.end_energy")) problem.end_energy = values.number("problem.end_energy", 0, finite);
  if (values.has("problem.ground_end")) problem.ground_end = values.number("problem.ground_end", 0, finite);
  problem.gaps = values.numbers("problem.gaps", {1, 2, 3, 4, 5, 6, 7, 8}, positive, "heights in m");
  problem.tolerances = values.numbers("problem.tolerances", {4}, positive, "four errors");
  if (values.has("problem.until")) problem.until = values.number("problem.until", 0, positive);
  problem.scene = read_discrete_scene(values, {}).scene;
  problem.scene_text = file.text.substr(file.text.find("[drop]"));
  return problem;
}

const NumericTable& truth_table() {
  static const NumericTable table = NumericTable::parse(
      "validation/benchmark/truth.csv", std::string(embedded_text("validation/benchmark/truth.csv")),
      {.required = numbers, .optional = {"n"}, .words = {"problem", "law", "place"}, .names = {}});
  return table;
}

std::vector<std::size_t> rows_of(const Problem& problem, const std::string& law) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < truth_table().rows(); ++i) {
    if (truth_table().word(i, "problem") == problem.id && truth_table().word(i, "law") == law) rows.push_back(i);
  }
  return rows;
}

}  // namespace

const std::vector<Problem>& benchmark_problems() {
  static const std::vector<Problem> problems = [] {
    std::vector<Problem> all;
    for (const EmbeddedFile& file : embedded_files()) {
      if (file.name.starts_with(folder)) all.push_back(read_problem(file));
    }
    std::sort(all.begin(), all.end(), [](const Problem& a, const Problem& b) { return a.id < b.id; });
    return all;
  }();
  return problems;
}

const Problem& problem_named(const std::string& where, const std::string& id) {
  std::vector<std::string> ids;
  for (const Problem& problem : benchmark_problems()) {
    if (problem.id == id) return problem;
    ids.push_back(problem.id);
  }
  std::string printable = id.substr(0, 40);
  for (char& c : printable) c = c < ' ' || c > '~' ? '?' : c;
  throw BadInput(fmt::format("{}: no problem {}; did you mean {}?", where, printable.empty() ? "(empty)" : printable,
                             nearest_name(id, ids)));
}

std::vector<std::string> truth_laws(const Problem& problem) {
  std::vector<std::string> laws;
  for (std::size_t i = 0; i < truth_table().rows(); ++i) {
    const std::string& law = truth_table().word(i, "law");
    if (truth_table().word(i, "problem") != problem.id) continue;
    if (std::find(laws.begin(), laws.end(), law) == laws.end()) laws.push_back(law);
  }
  return laws;
}

std::vector<TruthRow> truth_of(const Problem& problem, const std::string& law) {
  std::vector<TruthRow> rows;
  const NumericTable& table = truth_table();
  const auto number = [&](std::size_t row, const char* name) { return table.at(row, table.column(name).value()); };
  for (const std::size_t i : rows_of(problem, law)) {
    rows.push_back({.place = table.word(i, "place"),
                    .time = number(i, "t"),
                    .duration = number(i, "duration"),
                    .impulse = {number(i, "Px"), number(i, "Py"), number(i, "Pz")},
                    .velocity = {number(i, "Vx"), number(i, "Vy"), number(i, "Vz")},
                    .angular_velocity = {number(i, "Wx"), number(i, "Wy"), number(i, "Wz")},
                    .uncertainty = number(i, "uncertainty")});
  }
  return rows;
}

std::vector<std::vector<std::string>> truth_digits(const Problem& problem, const std::string& law) {
  std::vector<std::vector<std::string>> all;
  const NumericTable& table = truth_table();
  for (const std::size_t i : rows_of(problem, law)) {
    std::vector<std::string>& row = all.emplace_back();
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k) row.push_back(table.field(i, numbers[k]));
  }
  return all;
}

std::string oracle_of(const Problem& problem) {
  if (problem.is_compliant) {
    return "50-digit arithmetic: exact integrals of the pressure, Taylor series in time; second route: the simulator";
  }
  if (problem.scene.body.is_round()) {
    return "50-digit arithmetic: closed forms of a ball's impact and flight; second route: the discrete model in space";
  }
  if (truth_of(problem, truth_laws(problem).front()).front().place.find(' ') != std::string::npos) {
    return "50-digit arithmetic: closed forms of a level landing that friction stops; second route: the discrete model "
           "in space";
  }
  if (problem.scene.has_vectors()) {
    return "50-digit arithmetic: impulses from the 3 x 3 inverse contact inertia, Taylor series of flights and slip; "
           "second route: closed forms of the discrete model";
  }
  return "50-digit arithmetic: Eq. 8 piece by piece, roots of the height with a bound on its curvature; second route: "
         "the discrete model";
}

}  // namespace clatter::validation
