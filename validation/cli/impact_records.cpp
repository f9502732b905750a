#include "validation/cli/impact_records.hpp"

#include <algorithm>

namespace clatter::validation {
namespace {

std::size_t widest_line(const Table& table) {
  const std::string text = table_text(table, {});
  std::size_t widest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    widest = std::max(widest, display_width(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return widest;
}

}  // namespace

void fit_columns(Table& table, int digits, const std::vector<std::size_t>& starts) {
  for (const std::size_t first : starts) {
    for (int shown = digits - 1; shown >= 3; --shown) {
      if (widest_line(table) <= 80) return;
      for (auto& row : table.rows) {
        for (std::size_t i = first; i < row.size(); ++i) row[i].digits = std::min(row[i].digits, shown);
      }
    }
  }
}

Cell json_cell(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return Cell(value.get<std::string>());
  if (value.is_boolean()) return Cell(value.get<bool>() ? "true" : "false");
  return {value.get<double>(), 17};
}

void add_impact_records(Table& table, const Json& impacts) {
  for (const Json& impact : impacts) {
    const bool first = table.columns.empty();
    auto& row = table.rows.emplace_back();
    std::vector<Column> columns;
    for (const auto& [key, value] : impact.items()) {
      if (value.is_object()) continue;
      for (std::size_t i = 0; i < (value.is_array() ? 3u : 1u); ++i) {
        const std::string suffix = value.is_array() ? std::string("_") + "xyz"[i] : "";
        columns.push_back({key + suffix, key + suffix, ""});
        row.push_back(json_cell(value.is_array() ? value[i] : value));
      }
    }
    if (first) table.columns = std::move(columns);
  }
}

}  // namespace clatter::validation
