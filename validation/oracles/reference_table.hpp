// SPDX-License-Identifier: GPL-3.0-or-later
// Reference tables: comment lines, a line of column names, rows of decimal numbers with gaps.
#pragma once

#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace clatter::oracle {

/// One row: the digits of each column that has an entry.
using ReferenceRow = std::map<std::string, std::string>;

inline std::vector<std::string> split_at_commas(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

inline std::vector<ReferenceRow> reference_rows(std::istream& text) {
  std::vector<ReferenceRow> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto fields = split_at_commas(line);
    if (names.empty()) {
      names = fields;
      continue;
    }
    ReferenceRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (!fields[i].empty()) row[names.at(i)] = fields[i];
  }
  return rows;
}

/// @throws std::runtime_error if the file cannot be read.
inline std::vector<ReferenceRow> read_reference_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return reference_rows(file);
}

}  // namespace clatter::oracle
