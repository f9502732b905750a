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

std::vector<ReferenceRow> read(const std::string& name) {
  std::vector<ReferenceRow> rows;
  for (const ReferenceWords& words : reference_words(name)) {
    ReferenceRow& row = rows.emplace_back();
    for (const auto& [column, cell] : words) {
      double value = 0;
      if (read_number(cell, value)) row[column] = value;
    }
  }
  return rows;
}

}  // namespace

std::vector<ReferenceWords> reference_words(const std::string& name) {
  std::istringstream stream{std::string(embedded_text("tests/analytic/reference/" + name))};
  std::vector<std::string> names;
  std::vector<ReferenceWords> rows;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    ReferenceWords& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

const std::vector<ReferenceRow>& reference_table(ReferenceTable table) {
  static const std::vector<ReferenceRow> no_gravity = read("rod_sequence_no_gravity.csv");
  static const std::vector<ReferenceRow> gravity = read("rod_sequence_gravity.csv");
  return table == ReferenceTable::gravity ? gravity : no_gravity;
}

}  // namespace clatter::validation
