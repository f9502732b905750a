#include "validation/verify/reference.hpp"

#include <sstream>

#include "validation/embedded/embedded.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<ReferenceRow> read(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> names;
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    ReferenceRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) {
      double value = 0;
      if (read_number(cells[i], value)) row[names[i]] = value;
    }
  }
  return rows;
}

}  // namespace

const std::vector<ReferenceRow>& reference_table(ReferenceTable table) {
  static const std::vector<ReferenceRow> no_gravity =
      read(embedded_text("tests/analytic/reference/rod_sequence_no_gravity.csv"));
  static const std::vector<ReferenceRow> gravity =
      read(embedded_text("tests/analytic/reference/rod_sequence_gravity.csv"));
  return table == ReferenceTable::gravity ? gravity : no_gravity;
}

}  // namespace clatter::validation
