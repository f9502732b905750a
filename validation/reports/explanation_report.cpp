// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/explanation_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/output/symbols.hpp"
#include "validation/reports/explanation_latex.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation::inline reports {
namespace {

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
  const auto plain = [&](const std::string& text) { return ascii ? to_ascii(text) : text; };  // of another width
  std::string out;
  for (const std::string& line : head) out += wrapped(plain(line)) + "\n";
  for (const Step& step : steps) {
    std::size_t name_width = 0;
    for (const Equation& e : step.equations) name_width = std::max(name_width, display_width(e.name));
    out += "\n" + step.title + "\n" + wrapped("  " + plain(step.text), 79, "") + "\n";
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

Report explanation_report(const Explanation& explanation) {
  Report report = begun_report("explain", fmt::format("impact {} step by step", explanation.impact));
  report.head = scene_head(explanation.scene, Model::discrete, explanation.approach_speed);
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

std::string explanation_text(const Explanation& explanation, const TextStyle& style) {
  const Report report = explanation_report(explanation);
  const int digits = explanation.scene.accuracy.digits;
  std::vector<std::string> head{report.title};
  head.insert(head.end(), report.head.begin(), report.head.end());
  switch (style.format) {
    case Format::markdown: return as_markdown(head, explanation.steps, digits);
    case Format::latex: return explanation_latex(head, explanation.steps, digits);
    case Format::table: return as_text(head, explanation.steps, digits, style.ascii);
    case Format::json:
    case Format::csv: break;
  }
  return report_text(report, style);
}

}  // namespace clatter::validation::inline reports
