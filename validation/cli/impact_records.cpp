#include "validation/cli/impact_records.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "validation/output/number.hpp"

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

/// A row of records in the making, with the names of its columns.
struct Record {
  std::vector<Column> columns;
  std::vector<Cell> cells;

  void add(const std::string& name, const Json& value, const std::string& ending) {
    for (std::size_t i = 0; i < (value.is_array() ? 3u : 1u); ++i) {
      const std::string column = name + (value.is_array() ? std::string("_") + "xyz"[i] : "") + ending;
      columns.push_back({column, column, ""});
      cells.push_back(json_cell(value.is_array() ? value[i] : value));
    }
  }
};

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

std::string total_note(const Json& run) {
  const auto text = [&](const char* name) {
    return run[name].is_null() ? "unknown" : shortest(run[name].get<double>());
  };
  return "total_normal_impulse: " + text("total_normal_impulse") +
         "; total_normal_impulse_error: " + text("total_normal_impulse_error");
}

Cell json_cell(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return Cell(value.get<std::string>());
  if (value.is_boolean()) return Cell(value.get<bool>() ? "true" : "false");
  return {value.get<double>(), 17};
}

void add_impact_records(Table& table, const Json& impacts) {
  for (const Json& impact : impacts) {
    Record record;
    for (const auto& [key, value] : impact.items()) {
      if (!value.is_object()) record.add(key, value, "");
    }
    if (impact.contains("error_estimate")) {
      for (const auto& [key, value] : impact["error_estimate"].items()) record.add(key, value, "_error");
    }
    if (table.columns.empty()) table.columns = std::move(record.columns);
    table.rows.push_back(std::move(record.cells));
  }
}

}  // namespace clatter::validation
