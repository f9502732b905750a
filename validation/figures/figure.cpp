#include "validation/figures/figure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "validation/figures/figures.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation {

std::size_t column_index(const std::vector<FigureColumn>& columns, const std::string& name) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name == name) return i;
  }
  throw std::out_of_range("no column " + name);
}

std::string Figure::command() const { return fmt::format("clatter figures --only {} --output DIR", number); }

const std::vector<int>& figure_numbers() {
  static const std::vector<int> numbers{7, 8, 9, 10, 11, 12, 14, 15, 16, 17, 19, 20, 21, 22, 23, 24};
  return numbers;
}

Figure make_figure(int number, CaseRuns& case_runs) {
  switch (number) {
    case 7: return figure_second_angle();
    case 8: return figure_rod_positions();
    case 9: return figure_two_impulses();
    case 10: return figure_both_angles();
    case 11: return figure_angles_with_gravity();
    case 12: return figure_impulses_with_gravity();
    case 14: return figure_rod_over_angle(case_runs);
    case 15: return figure_rod_over_friction(case_runs);
    case 16: return figure_rod_contact(case_runs);
    case 17: return figure_rod_sequence(case_runs);
    case 19: return figure_phone_history(case_runs, false);
    case 20: return figure_phone_impacts(case_runs, false);
    case 21: return figure_phone_history(case_runs, true);
    case 22: return figure_phone_impacts(case_runs, true);
    case 23: return figure_phone_energies(case_runs);
    case 24: return figure_phone_over_angle(case_runs);
    default: throw std::out_of_range(fmt::format("no figure {}", number));
  }
}

Report figure_report(const Figure& figure) {
  Report report;
  report.title = fmt::format("Figure {}: {}", figure.number, figure.title);
  report.head = {"scene: " + figure.scene, "command: " + figure.command(), std::string("clatter ") + version};
  report.remarks = report.head;
  report.explains_columns = true;
  for (const FigureColumn& column : figure.columns) {
    report.grid.columns.push_back({column.name, column.name, column.unit == "1" ? "" : column.unit, column.quantity});
  }
  for (const std::vector<double>& row : figure.rows) report.grid.rows.emplace_back(row.begin(), row.end());
  report.fields =
      Value::Fields{{"clatter", version},    {"figure", figure.number},     {"title", figure.title},
                    {"scene", figure.scene}, {"command", figure.command()}, {"rows", row_objects(report.grid)}};
  return report;
}

}  // namespace clatter::validation
