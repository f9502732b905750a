// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/explain/explanation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "analytic/base/angle.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/explain/formula.hpp"
#include "validation/explain/steps.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

/// Why impact n of a run does not happen.
Step missing_impact(const Run& run, int n) {
  const std::size_t have = run.impacts.size();
  Step step{fmt::format("Impact {} does not happen", n),
            {fmt::format("The sequence has {} impact{}. It ends with {}: {}.", have, have == 1 ? "" : "s", run.outcome,
                         run.message)}};
  if (!run.near_miss || !std::isfinite(run.near_miss->clearance)) return step;
  const analytic::NearMiss& miss = *run.near_miss;
  step.equations.push_back({.quantity = number("h_least", miss.clearance, "m", miss.margin),
                            .words = {"clearance, the least height of a vertex at a turning point"}});
  step.equations.push_back(
      {.quantity = number("Δh", miss.margin, "m"), .words = {"margin, the rounding error of that height"}});
  return step;
}

bool strikes_with_one_point(const analytic::ImpactRow& row) { return std::popcount(row.vertices) == 1; }
bool strikes_with_one_point(const analytic::space::ImpactRow& row) { return !row.group; }

/// None where a number is not known.
std::optional<Factors> factors(const Impact& now, const Impact& last) {
  const auto ratio = [&](const auto& of) { return of(now.value) / of(last.value); };
  const auto speed = [](const Numbers& x) { return x.approach_speed; };
  const auto rebound = [](const Numbers& x) { return 1 + x.restitution; };
  const auto impulse = [](const Numbers& x) { return x.impulse[2]; };
  const Factors found{.normal_impulse = ratio(impulse),
                      .approach_speed = ratio(speed),
                      .effective_mass = ratio(impulse) / (ratio(speed) * ratio(rebound)),
                      .one_plus_restitution = ratio(rebound)};
  const bool is_known = now.predictable && std::isfinite(found.effective_mass) && found.effective_mass > 0;
  return is_known ? std::optional(found) : std::nullopt;
}

Step beside_last(const Factors& factors, int n) {
  const auto times = [](double factor) { return "×" + significant(factor, 3); };
  const std::string rebound = times(factors.one_plus_restitution);
  return {
      fmt::format("Beside impact {}", n - 1),
      {fmt::format("Normal impulse {}: approach speed {}, effective mass that the contact feels {}{}. The effective "
                   "mass is the normal impulse over the change of the contact's normal velocity.",
                   times(factors.normal_impulse), times(factors.approach_speed), times(factors.effective_mass),
                   rebound == times(1) ? "" : ", 1 + e " + rebound)}};
}

/// An equation in its parts; numbers are left out where they would only repeat the value.
struct Parts {
  std::string name, formula{}, numbers{}, value, words;
};
Parts parts_of(const Equation& equation, const FormulaWriter& writer) {
  Parts parts{.name = writer.symbol(equation.quantity),
              .value = writer.value(equation.quantity),
              .words = writer.words(equation.words)};
  if (equation.formula.empty()) return parts;
  const Expression& formula = equation.formula.front();
  parts.formula = writer.formula(formula);
  if (formula->operation != Operation::quantity) parts.numbers = writer.numbers(formula);
  return parts;
}

std::string joined(const Parts& parts, const std::string& between) {
  std::string line = parts.name;
  for (const std::string& part : {parts.formula, parts.numbers, parts.value}) {
    if (!part.empty()) line += (line.size() == parts.name.size() ? " = " : between) + part;
  }
  return line;
}

std::string law_text(const Law& law, const FormulaWriter& writer, const std::string& equals) {
  return writer.formula(law.left) + equals + writer.formula(law.right);
}

constexpr std::size_t text_width = 79;

/// "name = formula", and "= numbers" and "= value, words" below it.
std::string equation_lines(const Parts& parts, std::size_t name_width) {
  const std::string pad(name_width - std::min(name_width, display_width(parts.name)) + 2, ' ');
  const std::string below(name_width + 2, ' '), room(name_width + 5, ' ');
  const std::string words = parts.words.empty() ? "" : ", " + parts.words;
  const auto first = [&](const std::string& text) {
    return pad + parts.name + " = " + wrapped(room + text, text_width, "").substr(room.size()) + "\n";
  };
  const auto under = [&](const std::string& text) { return wrapped(below + " = " + text, text_width, "   ") + "\n"; };
  if (parts.formula.empty()) return first(parts.value + words);
  if (parts.numbers.empty()) return first(parts.formula + " = " + parts.value + words);
  return first(parts.formula) + under(parts.numbers) + under(parts.value + words);
}

std::string as_text(const Explanation& explanation, const std::vector<std::string>& head, bool ascii) {
  const FormulaWriter writer(Notation::text, explanation.scene.accuracy.digits);
  const auto plain = [&](const std::string& text) { return ascii ? to_ascii(text) : text; };  // of another width
  std::string out;
  for (const std::string& line : head) out += wrapped(plain(line)) + "\n";
  for (const Step& step : explanation.steps) {
    out += "\n" + plain(step.title) + "\n";
    if (!step.words.empty()) out += wrapped("  " + plain(writer.words(step.words)), text_width, "") + "\n";
    for (const Law& law : step.laws) out += wrapped("    " + plain(law_text(law, writer, " = ")), text_width) + "\n";
    std::vector<Parts> all;
    std::size_t name_width = 0;
    for (const Equation& equation : step.equations) {
      Parts parts = parts_of(equation, writer);
      for (std::string* part : {&parts.name, &parts.formula, &parts.numbers, &parts.value, &parts.words})
        *part = plain(*part);
      name_width = std::max(name_width, display_width(parts.name));
      all.push_back(std::move(parts));
    }
    for (const Parts& parts : all) out += equation_lines(parts, name_width);
  }
  return out;
}

std::string as_markdown(const Explanation& explanation, const std::vector<std::string>& head) {
  const FormulaWriter writer(Notation::text, explanation.scene.accuracy.digits);
  std::string out;
  for (const std::string& line : head) out += line + "  \n";
  for (const Step& step : explanation.steps) {
    out += "\n### " + step.title + "\n\n";
    if (!step.words.empty()) out += writer.words(step.words) + "\n\n";
    for (const Law& law : step.laws) out += "> `" + law_text(law, writer, " = ") + "`  \n";
    if (!step.laws.empty()) out += "\n";
    for (const Equation& equation : step.equations) {
      const Parts parts = parts_of(equation, writer);
      out += "- `" + joined(parts, " = ") + "`" + (parts.words.empty() ? "" : ", " + parts.words) + "\n";
    }
  }
  return out;
}

/// "NAME &= FORMULA", then numbers and value on lines of their own.
std::string equation_tex(const Parts& parts) {
  std::string tex = parts.name, between = " &= ";
  for (const std::string& part : {parts.formula, parts.numbers, parts.value}) {
    if (part.empty()) continue;
    tex += between + part;
    between = " \\\\ &= ";
  }
  return tex;
}

/// The head as comments, then a paragraph with aligned equations for each step.
std::string as_latex(const Explanation& explanation, const std::vector<std::string>& head) {
  const FormulaWriter writer(Notation::tex, explanation.scene.accuracy.digits);
  std::string out;
  for (const std::string& line : head) out += "% " + line + "\n";
  out += "% needs \\usepackage{amsmath}\n";
  for (const Step& step : explanation.steps) {
    out += "\n\\paragraph{" + to_latex(step.title) + "}" + (step.words.empty() ? "" : " ") + writer.words(step.words) +
           "\n";
    std::string lines;
    for (const Law& law : step.laws) lines += (lines.empty() ? "  " : " \\\\\n  ") + law_text(law, writer, " &= ");
    if (!lines.empty()) out += "\\begin{align*}\n" + lines + "\n\\end{align*}\n";
    lines.clear();
    for (const Equation& equation : step.equations) {
      const Parts parts = parts_of(equation, writer);
      lines += (lines.empty() ? "  " : " \\\\\n  ") + equation_tex(parts) +
               (parts.words.empty() ? "" : " && \\text{" + parts.words + "}");
    }
    if (!lines.empty()) out += "\\begin{align*}\n" + lines + "\n\\end{align*}\n";
  }
  return out;
}

/// A number, a list of components, or of rows.
Value value_of(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 1) return matrix(0, 0);
  if (matrix.cols() == 1) return Value(Eigen::VectorXd(matrix));
  Value::List rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.emplace_back(Eigen::VectorXd(matrix.row(i)));
  return rows;
}

/// "_x" of a vector, "_xz" of a matrix.
std::string component_name(const Eigen::MatrixXd& matrix, Eigen::Index i, Eigen::Index k) {
  if (matrix.size() == 1) return "";
  const char* const axes = matrix.rows() == 4 ? "0123" : "xyz";
  return matrix.cols() == 1 ? fmt::format("_{}", axes[i]) : fmt::format("_{}{}", axes[i], axes[k]);
}

Value equation_fields(const Equation& equation, int digits) {
  const Parts text = parts_of(equation, {Notation::text, digits}), tex = parts_of(equation, {Notation::tex, digits});
  return Value::Fields{{"name", text.name},
                       {"symbolic", text.formula},
                       {"numeric", text.numbers},
                       {"tex", equation_tex(tex)},
                       {"words", text.words},
                       {"value", value_of(equation.quantity.value)},
                       {"error", rounded_up(equation.quantity.error)},
                       {"unit", equation.quantity.unit}};
}

struct ExplainInput {
  int number = 1;
  SceneFlags scene;
  OutputChoice output;
};

int run_explain(const ExplainInput& input) {
  const PreparedScene scene = read_discrete_flags(input.scene);
  require_level(scene.scene, "explain");
  check_files(input.output);
  const Explanation explanation = explain_impact(scene, input.number);
  for (const std::string& warning : explanation.warnings) say(warning);
  write_out(input.output, explanation_text(explanation, input.output.style));
  return status_of(explanation.shortfall, explanation.shortfall_status);
}

}  // namespace

Explanation explain_impact(const PreparedScene& prepared, int n) {
  Scene scene = prepared.scene;
  scene.request.impacts = std::max(scene.request.impacts, n);
  const auto explained = [&](const auto& drop) -> Explanation {
    const auto sequence = impact_sequence(drop, {.impacts = n, .digits = scene.accuracy.digits});
    const Run run = run_of(sequence);
    const bool has_impact = static_cast<std::size_t>(n) <= sequence.rows.size();
    const bool falls_short = scene.require_digits || !has_impact;
    std::vector<Step> steps = has_impact ? impact_steps(scene, drop, sequence, n) : std::vector{missing_impact(run, n)};
    std::optional<Factors> beside;
    const auto at = static_cast<std::size_t>(n - 1);
    if (has_impact && n > 1 && strikes_with_one_point(sequence.rows[at]) &&
        strikes_with_one_point(sequence.rows[at - 1]))
      beside = factors(run.impacts[at], run.impacts[at - 1]);
    if (beside) steps.push_back(beside_last(*beside, n));
    return {.scene = scene,
            .impact = n,
            .approach_speed = first_approach_speed(prepared.drop),
            .steps = std::move(steps),
            .beside_last = beside,
            .warnings = sequence.warnings,
            .shortfall = falls_short ? shortfall(scene, run) : "",
            .shortfall_status = shortfall_status(run)};
  };
  return std::visit(explained, prepared.drop);
}

Quantity number(const Symbol& symbol, double value, const std::string& unit, double error, double size) {
  return {symbol, Eigen::MatrixXd::Constant(1, 1, value), unit, error, size};
}

Quantity StepWriter::with_error(Quantity quantity) const {
  if (quantity.value.size() > 1 && quantity.size == 0) quantity.size = quantity.value.norm();
  const double largest = std::max(quantity.value.cwiseAbs().maxCoeff(), quantity.size);
  if (quantity.error == 0 && largest > 0) quantity.error = relative_ * largest;
  return quantity;
}

void StepWriter::say(const Words& words) {
  Words& all = steps_.back().words;
  all.insert(all.end(), words.begin(), words.end());
}

Quantity StepWriter::given(const Quantity& exact, const Words& words) {
  steps_.back().equations.push_back({exact, {}, words});
  return exact;
}

Quantity StepWriter::found(const Quantity& quantity, const Words& words) { return given(with_error(quantity), words); }

Quantity StepWriter::found(const Quantity& quantity, const Expression& formula, const Words& words) {
  const Quantity known = with_error(quantity);
  steps_.back().equations.push_back({known, {formula}, words});
  return known;
}

Quantity StepWriter::computed(const Symbol& symbol, const std::string& unit, const Expression& formula,
                              const Words& words, double size) {
  Quantity quantity{symbol, evaluated(formula), unit, 0, size};
  if (unit == "°") quantity.value *= analytic::degrees_per_radian;
  return found(quantity, formula, words);
}

Given write_body(StepWriter& writer, double mass, double gravity) {
  writer.open("What is given", {});
  const Quantity m = writer.given(number("m", mass, "kg"), {"mass"});
  const Quantity g = number("g", gravity, "m/s²");
  if (gravity > 0) writer.given(g, {"gravity"});
  return {.mass = m, .gravity = g};
}

void write_law(StepWriter& writer, const Scene& scene, const analytic::ImpactLaw& law, Given& given) {
  if (law.law == analytic::RestitutionLaw::viscoelastic) {
    const double stiffness = scene.world.ground.stiffness, damping = scene.world.ground.damping;
    const Quantity tau = number("τ", law.damping_per_stiffness, "s/m");
    if (!scene.world.ground.has_dissipation() && stiffness > 0 && damping / stiffness == law.damping_per_stiffness) {
      const Quantity k = writer.given(number("k_G", stiffness, "N/m³"), {"stiffness of the ground"});
      const Quantity c = writer.given(number("c_G", damping, "N·s/m⁴"), {"its damping"});
      given.damping_time = writer.found(tau, c / k, {"from which the restitution follows at each speed"});
    } else if (scene.world.ground.has_dissipation()) {
      given.damping_time =
          writer.given(tau, {scene.world.ground.is_pad() ? "dissipation of the ground, a pad"
                                                         : "dissipation of the ground, an elastic half-space"});
    } else {
      given.damping_time = writer.given(tau, {"damping over stiffness of the ground, c_G/k_G"});
    }
  } else {
    given.restitution = writer.given(number("e", law.restitution, ""), {words_of(law.law).coefficient});
  }
  const Quantity coefficient = number("μ", law.friction_value, "");
  if (law.friction == analytic::FrictionKind::coulomb && law.friction_value > 0)
    given.friction = writer.given(coefficient, {"Coulomb's coefficient of friction"});
  if (law.friction == analytic::FrictionKind::moreau && law.friction_value > 0)
    given.moreau = writer.given(coefficient, {"coefficient of friction, by the slip after the impact"});
  if (law.friction == analytic::FrictionKind::impulse_ratio)
    given.impulse_ratio =
        writer.given(number("μ_i", law.friction_value, ""), {"impulse ratio, tangential over normal"});
}

Quantity write_restitution(StepWriter& writer, const Given& given, const Quantity& u, double value) {
  if (given.restitution) return *given.restitution;
  const Quantity e = number("e", value, "", 0, 1), zeta = number("ζ", 0, "");
  writer.open("Restitution from the ground's damping",
              {"The ground's springs and dampers act together as the contact sinks in, and let go of it when they no "
               "longer push. The damping number ",
               zeta, " is that of the speed of approach; the coefficient of restitution ", e,
               " solves the equation below, by the function of Lambert."});
  writer.law(function("ln", (1 + zeta) / (1 - zeta * e)), zeta * (1 + e));
  const Quantity s = writer.computed("ζ", "", -(*given.damping_time * u));
  if (evaluated(s)(0, 0) == 0) return writer.found(e, {"a ground without damping gives all back"});
  const Expression sum = 1 + s;
  return writer.found(e, (1 + function("W_0", -(sum * function("exp", -sum)))) / s);
}

void write_fall(StepWriter& writer, const Scene& scene, const Given& given, const Quantity& z, const Quantity& speed) {
  if (scene.clearance) {
    const Quantity c = writer.given(number("H", *scene.clearance, "m"), {"height of the lowest point at release"});
    writer.found(speed, -function("√", 2 * given.gravity * c),
                 {"velocity of the centre of mass along the normal, after the fall"});
    return;
  }
  if (scene.is_released()) {
    writer.found(speed, {"velocity of the centre of mass along the normal, after the free flight from the release"});
    return;
  }
  if (!scene.height || !(given.gravity.value(0, 0) > 0)) {
    writer.given(speed, {"velocity of the centre of mass along the normal, before"});
    return;
  }
  const Quantity h = writer.given(number("H", *scene.height, "m"), {"height of the centre of mass at release"});
  const Expression fall = 2 * given.gravity * (h - z);
  writer.found(speed, -function("√", fall), {"velocity of the centre of mass along the normal, after the fall"});
}

void write_energy(StepWriter& writer, const Words& words, const Energies& energies) {
  writer.open("Energy", words);
  writer.found(energies.before_value, energies.before, {"energy before"});
  writer.found(energies.after_value, energies.after, {"energy after"});
  writer.found(energies.loss_value, energies.loss, {"energy that the impact took, the difference of both"});
}

namespace {

std::vector<Column> explain_columns() {
  return {{"step", "", "", "title of the step"},
          {"quantity", "", "", "name of the number"},
          {"equation", "", "", "that it follows from"},
          {"numbers", "", "", "the same with its numbers"},
          {"value", "", "", "in `unit`"},
          {"unit", "", "", "of the value"},
          {"error", "", "", "of the value"}};
}

Value steps_value(const Explanation& explanation) {
  const int digits = std::max(explanation.scene.accuracy.digits, 6);  // a drawing of few digits still tells its numbers
  const FormulaWriter text(Notation::text, digits), tex(Notation::tex, digits);
  Value::List steps;
  for (const Step& step : explanation.steps) {
    Value::List laws, equations;
    for (const Law& law : step.laws)
      laws.push_back(Value::Fields{{"symbolic", law_text(law, text, " = ")}, {"tex", law_text(law, tex, " &= ")}});
    for (const Equation& equation : step.equations) equations.push_back(equation_fields(equation, digits));
    steps.push_back(Value::Fields{
        {"title", step.title}, {"text", text.words(step.words)}, {"laws", laws}, {"equations", equations}});
  }
  return steps;
}

}  // namespace

Report explanation_report(const Explanation& explanation) {
  Report report = scene_report("explain", fmt::format("impact {} step by step", explanation.impact), "discrete",
                               explanation.scene, Model::discrete, explanation.approach_speed);
  report.fields["impact"] = explanation.impact;
  report.fields["shortfall"] = text_or_nothing(explanation.shortfall);
  const std::optional<Factors>& beside = explanation.beside_last;
  report.fields["beside_last"] = !beside ? Value()
                                         : Value::Fields{{"impact", explanation.impact - 1},
                                                         {"normal_impulse", beside->normal_impulse},
                                                         {"approach_speed", beside->approach_speed},
                                                         {"effective_mass", beside->effective_mass},
                                                         {"one_plus_restitution", beside->one_plus_restitution}};
  report.fields["steps"] = steps_value(explanation);
  report.grid.columns = explain_columns();
  const FormulaWriter writer(Notation::text, explanation.scene.accuracy.digits);
  for (const Step& step : explanation.steps) {
    for (const Equation& equation : step.equations) {
      const Parts parts = parts_of(equation, writer);
      const Quantity& quantity = equation.quantity;
      for (Eigen::Index i = 0; i < quantity.value.rows(); ++i) {
        for (Eigen::Index k = 0; k < quantity.value.cols(); ++k) {
          report.grid.rows.push_back({Cell(step.title), Cell(parts.name + component_name(quantity.value, i, k)),
                                      Cell(parts.formula), Cell(parts.numbers), Cell(Value(quantity.value(i, k))),
                                      Cell(quantity.unit), Cell(rounded_up(quantity.error))});
        }
      }
    }
  }
  return report;
}

std::string explanation_text(const Explanation& explanation, const TextStyle& style) {
  const Report report = explanation_report(explanation);
  const std::vector<std::string> head = head_lines(report);
  switch (style.format) {
    case Format::markdown: return as_markdown(explanation, head);
    case Format::latex: return as_latex(explanation, head);
    case Format::table: return as_text(explanation, head, style.ascii);
    case Format::json:
    case Format::csv: break;
  }
  return report_text(report, style);
}

/// `clatter explain N SCENE`
Command explain_command() {
  return command_of<ExplainInput>(run_explain, [](Command& command, ExplainInput& input) {
    Argument number = whole_argument("N", input.number, 1, 1'000'000, "", "number of the impact, from 1");
    number.required = true;
    command.add(std::move(number));
    add_scene_flags(command, input.scene, Model::discrete);
    add_output_options(command, input.output);
    command.footer = "Example: clatter explain 2 --angle 10";
    command.columns = {{"explain", explain_columns}};
  });
}

}  // namespace clatter::validation
