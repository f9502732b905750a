// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/reference.hpp"

#include <sstream>

#include "validation/embedded/embedded.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline verify {
namespace {

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

}  // namespace

std::vector<oracle::ReferenceRow> reference_words(const std::string& name) {
  std::istringstream text{std::string(embedded_text("tests/analytic/reference/" + name))};
  return oracle::reference_rows(text);
}

const std::vector<ReferenceRow>& reference_table(ReferenceTable table) {
  static const std::vector<ReferenceRow> no_gravity = read("rod_sequence_no_gravity.csv");
  static const std::vector<ReferenceRow> gravity = read("rod_sequence_gravity.csv");
  return table == ReferenceTable::gravity ? gravity : no_gravity;
}

}  // namespace clatter::validation::inline verify
