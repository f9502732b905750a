// SPDX-License-Identifier: GPL-3.0-or-later
// Explanations as structure: symbols, numbers and values of every formula, and the TeX written from it.
#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "analytic/base/errors.hpp"
#include "tests/support.hpp"
#include "validation/explain/explanation_report.hpp"
#include "validation/explain/formula.hpp"
#include "validation/run/discrete_scene.hpp"

namespace {

using namespace clatter::validation;

// Lambert's function loses half of the digits near its branch point, where e is near 1.
constexpr double branch_point = 1e-6;
// Differences of heights and velocities that nearly cancel lose some digits of their parts' sixteen.
constexpr double cancellation = 1e-9;

struct Told {
  std::string name;
  Explanation explanation;
};

PreparedScene scene_of(const std::string& source, const std::string& flags) {
  std::vector<SceneOverride> overrides;
  std::istringstream words(flags);
  for (std::string word; words >> word;)
    overrides.push_back({word.substr(0, word.find('=')), "--set", word.substr(word.find('=') + 1)});
  return read_discrete_scene(scene_values(source), overrides);
}

void add(std::vector<Told>& all, const std::string& source, const std::string& flags, int impacts) {
  const PreparedScene scene = scene_of(source, flags);
  for (int n = 1; n <= impacts; ++n) {
    try {
      all.push_back({fmt::format("explain {} {} {}", n, source, flags), explain_impact(scene, n)});
    } catch (const clatter::analytic::OutsideModelError&) {  // a case whose friction jams
    }
  }
}

/// The same on the scene's ground, as compare has it.
void add_on_ground(std::vector<Told>& all, const std::string& source, int impacts) {
  const PreparedScene scene = prepared(read_scene(scene_values(source), {}, Model::continuous));
  for (int n = 1; n <= impacts; ++n)
    all.push_back({fmt::format("explain {} {} on its ground", n, source), explain_impact(scene, n)});
}

/// Cases of the program, and flags for every branch: laws, modes of friction, gravity, flat landings, edges and faces.
const std::vector<Told>& told() {
  static const std::vector<Told> all = [] {
    std::vector<Told> list;
    for (const std::string& name : case_names()) {
      if (case_scene(name).sweep) continue;
      add(list, name, "", 3);
      add_on_ground(list, name, 3);
    }
    // Each law and friction meets a different slip of the thin rod, the thick one and the box that lands flat.
    const char* const slips[] = {"", " drop.tangential_velocity=0.4", " drop.tangential_velocity=-1.5 drop.spin=2"};
    const std::string box = "body.shape=box body.size=0.3x0.2x0.1 ";
    int number = 0;
    for (const char* law : {"newton", "poisson", "stronge"}) {
      const std::string restitution = fmt::format("impact.restitution=0.6 impact.law={} world.gravity=9.81 ", law);
      for (const char* friction :
           {"", "impact.friction=0.05", "impact.friction=0.3", "impact.friction=0.9", "impact.impulse_ratio=0.1"}) {
        const auto slip = [&](int kind) { return restitution + friction + slips[(number + kind) % 3]; };
        add(list, "", "drop.angle_deg=20 run.impacts=4 " + slip(0), 4);
        add(list, "", "drop.angle_deg=50 body.radius=0.05 " + slip(1), 2);
        add(list, "", "drop.angle_deg=0 " + box + slip(2), 2);
        add(list, "", "drop.angle_deg=30 drop.tilt_deg=25 " + box + restitution + friction, 2);
        ++number;
      }
    }
    for (const char* attitude :
         {"drop.attitude=1x0x0x0 drop.angular_velocity=0.3x-0.2x0.1", "drop.angle_deg=0 drop.tilt_deg=20"})
      add(list, "", box + "impact.restitution=0.5 " + attitude, 3);
    add(list, "", "drop.angle_deg=90 world.gravity=9.81 impact.restitution=0.5", 3);
    add(list, "", box + "drop.angle_deg=70 drop.spin=1", 2);
    return list;
  }();
  return all;
}

std::string name_of(const Quantity& quantity) { return FormulaWriter(Notation::text, 6).symbol(quantity); }

/// Symbols that words introduce, each by itself.
void introduce(const Step& step, std::set<std::string>& known) {
  for (const auto& piece : step.words) {
    const auto* const expression = std::get_if<Expression>(&piece);
    if (expression && (*expression)->operation == Operation::quantity) known.insert(name_of((*expression)->quantity));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_symbol_of_a_formula_stands_before_it_with_the_number_that_is_put_in) {
  std::size_t formulas = 0;
  for (const Told& one : told()) {
    std::map<std::string, Eigen::MatrixXd> shown;
    for (const Step& step : one.explanation.steps) {
      for (const Equation& equation : step.equations) {
        const std::string name = name_of(equation.quantity);
        for (const Expression& formula : equation.formula) {
          ++formulas;
          for (const Quantity& used : quantities_in(formula)) {
            const auto found = shown.find(name_of(used));
            BOOST_REQUIRE_MESSAGE(found != shown.end(),
                                  one.name << ": " << name << " uses " << name_of(used) << " first");
            BOOST_TEST((found->second == used.value), one.name << ": " << name << " takes another " << name_of(used));
          }
        }
        const bool is_new = shown.emplace(name, equation.quantity.value).second;
        BOOST_TEST((is_new || shown.at(name) == equation.quantity.value), one.name << ": two numbers for " << name);
      }
    }
  }
  BOOST_TEST(formulas > 1500u);
}

BOOST_AUTO_TEST_CASE(every_symbol_of_a_law_has_been_introduced_by_words_or_an_equation) {
  for (const Told& one : told()) {
    std::set<std::string> known;
    for (const Step& step : one.explanation.steps) {
      introduce(step, known);
      for (const Law& law : step.laws) {
        for (const Expression& side : {law.left, law.right}) {
          for (const Quantity& used : quantities_in(side))
            BOOST_TEST(known.contains(name_of(used)), one.name << ", " << step.title << ": " << name_of(used));
        }
      }
      for (const Equation& equation : step.equations) known.insert(name_of(equation.quantity));
    }
  }
}

BOOST_AUTO_TEST_CASE(every_formula_evaluates_to_the_number_of_the_sequence_and_has_its_numbers_put_in) {
  const FormulaWriter writer(Notation::text, 6);
  const auto check = [&](const std::string& where, const Equation& equation) {
    if (equation.formula.empty() || !std::isfinite(equation.quantity.error)) return;
    const Expression& formula = equation.formula.front();
    const Eigen::MatrixXd mine = evaluated(formula), shown = evaluated(equation.quantity);
    const double size = std::max({shown.cwiseAbs().maxCoeff(), equation.quantity.size, 1e-3});
    const double tolerance = (name_of(equation.quantity) == "e" ? branch_point : cancellation) * size;
    BOOST_REQUIRE(mine.size() == shown.size());
    const double error = (mine - shown).cwiseAbs().maxCoeff();
    BOOST_TEST(error <= tolerance, where << ": " << name_of(equation.quantity) << " = " << writer.formula(formula)
                                         << " = " << writer.numbers(formula) << ", off by " << error);
    if (formula->operation != Operation::quantity)
      BOOST_TEST(writer.numbers(formula) != writer.formula(formula), where << ": " << writer.formula(formula));
  };
  for (const Told& one : told()) {
    for (const Step& step : one.explanation.steps)
      for (const Equation& equation : step.equations) check(one.name + ", " + step.title, equation);
  }
}

BOOST_AUTO_TEST_CASE(tex_has_balanced_braces_ascii_characters_and_commands_of_amsmath_alone) {
  const std::set<std::string> commands{
      "Omega", "omega", "alpha",  "beta",         "gamma", "theta", "varphi",       "Gamma", "mu",
      "sigma", "Delta", "lambda", "tau",          "zeta",  "psi",   "rho",          "cdot",  "times",
      "frac",  "sqrt",  "sin",    "cos",          "ln",    "exp",   "left",         "right", "begin",
      "end",   "vec",   "mathrm", "operatorname", "circ",  "text",  "paragraph",    "surd",  "dots",
      "le",    "pi",    "infty",  "approx",       "pm",    "to",    "textbackslash"};
  for (const Told& one : told()) {
    const std::string all = explanation_text(one.explanation, {.format = Format::latex});
    const std::string tex = std::regex_replace(all, std::regex("(^|\n)%[^\n]*"), "$1");  // without comments
    BOOST_TEST(std::ranges::all_of(tex, [](unsigned char c) { return c < 128; }), one.name);
    const std::regex command(R"(\\([A-Za-z]+))");
    for (std::sregex_iterator found(tex.begin(), tex.end(), command); found != std::sregex_iterator(); ++found)
      BOOST_TEST(commands.contains((*found)[1]), one.name << ": " << (*found)[1]);
    int depth = 0;
    for (const char c : tex) {
      depth += (c == '{') - (c == '}');
      BOOST_REQUIRE(depth >= 0);
    }
    BOOST_TEST(depth == 0, one.name);
  }
}

BOOST_AUTO_TEST_CASE(each_line_of_text_fits_80_columns_and_ascii_is_ascii) {
  for (const Told& one : told()) {
    const std::string text = explanation_text(one.explanation, {}),
                      ascii = explanation_text(one.explanation, {.ascii = true});
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) BOOST_TEST(display_width(line) <= 80u, one.name << ": " << line);
    BOOST_TEST(std::ranges::all_of(ascii, [](unsigned char c) { return c < 128; }), one.name);
  }
}
