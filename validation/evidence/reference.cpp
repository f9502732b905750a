// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/reference.hpp"

#include <cmath>
#include <sstream>

#include "validation/embedded/embedded.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
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

long double slope(long double theta) {
  const long double c = std::cos(theta);
  return (1 - 3 * c * c) / (6 * c);
}

/// Height of the grazing end at its lowest point; negative: it strikes.
long double clearance(long double theta) {
  const long double k = slope(theta), beta = std::acos(k);
  return std::sin(theta) + k * (theta + beta) - std::sin(beta);
}

long double fold() {
  long double low = 1.0L, high = 1.03L;  // 57.3° … 59.0°
  for (int i = 0; i < 80; ++i) {
    const long double middle = (low + high) / 2;
    (clearance(middle) < 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

std::vector<oracle::ReferenceRow> reference_words(const std::string& name) {
  std::istringstream text{std::string(embedded_text("validation/oracles/reference/" + name))};
  return oracle::reference_rows(text);
}

const std::vector<ReferenceRow>& reference_table(ReferenceTable table) {
  static const std::vector<ReferenceRow> no_gravity = read("rod_sequence_no_gravity.csv");
  static const std::vector<ReferenceRow> gravity = read("rod_sequence_gravity.csv");
  return table == ReferenceTable::gravity ? gravity : no_gravity;
}

double second_impact_fold() { return static_cast<double>(fold()); }

double second_impact_fold_beta() { return static_cast<double>(std::acos(slope(fold()))); }

}  // namespace clatter::validation
