#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/cli/derivation.hpp"
#include "validation/cli/explanation_latex.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/scene_flags.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/message.hpp"
#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

struct ExplainInput {
  std::string number;
  SceneFlags scene;
  OutputTexts output;
};

/// "name = formula" and, where the line gets too long, "= numbers = value" below it.
std::string equation_text(const Equation& equation, std::size_t name_width, int digits) {
  const std::string pad(name_width - std::min(name_width, display_width(equation.name)), ' ');
  std::string line = "  " + pad + equation.name + " = " + equation.formula;
  const std::string value = (equation.formula.empty() ? "" : " = ") + value_text(equation, digits);
  if (equation.numbers.empty()) return line + value + "\n";
  const std::string below = std::string(name_width + 2, ' ');
  return line + "\n" + wrapped(below + " = " + equation.numbers, 79, "   ") + "\n" + below + value + "\n";
}

std::string as_text(const std::vector<std::string>& head, const std::vector<Step>& steps, int digits, bool ascii) {
  std::string out;
  for (const std::string& line : head) out += wrapped(line) + "\n";
  for (const Step& step : steps) {
    std::size_t name_width = 0;
    for (const Equation& e : step.equations) name_width = std::max(name_width, display_width(e.name));
    out += "\n" + step.title + "\n" + wrapped("  " + step.text, 79, "") + "\n";
    for (const Equation& e : step.equations) out += equation_text(e, name_width, digits);
  }
  return ascii ? to_ascii(out) : out;
}

std::string joined(const Equation& e, int digits) {
  std::string line = e.name;
  for (const std::string& part : {e.formula, e.numbers, value_text(e, digits)}) {
    if (!part.empty()) line += " = " + part;
  }
  return line;
}

std::string as_markdown(const std::vector<std::string>& head, const std::vector<Step>& steps, int digits) {
  std::string out;
  for (const std::string& line : head) out += line + "  \n";
  for (const Step& step : steps) {
    out += "\n### " + step.title + "\n\n" + step.text + "\n\n";
    for (const Equation& e : step.equations) out += "- `" + joined(e, digits) + "`\n";
  }
  return out;
}

Report report_of(const Explanation& explanation, const std::string& what) {
  Report report = begun_report("explain", what);
  report.head = scene_head(explanation.scene, Model::discrete);
  report.fields = explanation_fields(explanation);
  report.grid.columns = explain_columns();
  for (const Step& step : explanation.steps) {
    for (const Equation& e : step.equations) {
      report.grid.rows.push_back({Cell(step.title), Cell(e.name), Cell(e.formula), Cell(e.numbers),
                                  Cell(Value(e.value)), Cell(e.unit), Cell(Value(e.error))});
    }
  }
  return report;
}

int run_explain(const ExplainInput& input) {
  const int n = read_integer_option("explain N", input.number, 1, 1000000);
  const Scene scene = read_scene_flags(input.scene);
  const OutputChoice choice = read_output(input.output);
  check_files(choice, {});
  const Explanation explanation = explain_impact(scene, n);
  for (const std::string& warning : explanation.warnings) say(warning);
  const std::vector<Step>& steps = explanation.steps;
  const Report report = report_of(explanation, fmt::format("impact {} step by step", n));
  std::vector<std::string> head{report.title};
  head.insert(head.end(), report.head.begin(), report.head.end());
  std::string text;
  switch (choice.style.format) {
    case Format::json:
    case Format::csv: text = report_text(report, choice.style); break;
    case Format::markdown: text = as_markdown(head, steps, scene.options.digits); break;
    case Format::latex: text = explanation_latex(head, steps, scene.options.digits); break;
    case Format::table: text = as_text(head, steps, scene.options.digits, choice.style.ascii); break;
  }
  write_out(choice, text);
  if (explanation.shortfall.empty()) return 0;
  say(explanation.shortfall);
  return explanation.shortfall_status;
}

}  // namespace

std::vector<Column> explain_columns() {
  return {{"step", "", "", "title of the step"},
          {"quantity", "", "", "name of the number"},
          {"equation", "", "", "that it follows from"},
          {"numbers", "", "", "the same with its numbers"},
          {"value", "", "", "in `unit`"},
          {"unit", "", "", "of the value"},
          {"error", "", "", "of the value"}};
}

Command explain_command() {
  auto input = std::make_shared<ExplainInput>();
  Command command{.name = "explain", .help = "how impact N came about, step by step"};
  command.add(
      {.name = "N", .target = &input->number, .type = "", .help = "number of the impact, from 1", .required = true});
  add_scene_flags(command, input->scene, Model::discrete);
  add_output_options(command, input->output);
  command.footer = "Example: clatter explain 2 --angle 10";
  command.run = [input] { return run_explain(*input); };
  return command;
}

}  // namespace clatter::validation
