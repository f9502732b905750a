// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "validation/output/aligned_grid.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/symbols.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation::inline output {
namespace {

using Texts = std::vector<std::vector<std::string>>;

std::vector<std::size_t> shown_columns(const Grid& grid) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].shown) shown.push_back(i);
  }
  return shown;
}

/// Heading, unit and cell texts of the shown columns.
Texts shown_texts(const Grid& grid, const std::vector<std::size_t>& shown) {
  Texts texts(2);
  for (const std::size_t i : shown) {
    texts[0].push_back(grid.columns[i].heading);
    texts[1].push_back(grid.columns[i].unit);
  }
  for (const Row& row : grid.rows) {
    auto& line = texts.emplace_back();
    for (const std::size_t i : shown) line.push_back(i < row.size() ? shown_text(row[i]) : "");
  }
  return texts;
}

std::vector<std::string> head_lines(const Report& report) {
  std::vector<std::string> lines{report.title};
  lines.insert(lines.end(), report.head.begin(), report.head.end());
  return lines;
}

std::string aligned(const Report& report) {
  std::string out;
  for (const auto& line : head_lines(report)) out += wrapped(line) + "\n";
  out += aligned_grid(report.table());
  for (const auto& line : report.notes) out += wrapped(line) + "\n";
  return out;
}

/// The report in plain characters, which have other widths.
Report plain(Report report) {
  Grid& grid = report.digest ? *report.digest : report.grid;
  for (auto* lines : {&report.head, &report.notes}) {
    for (auto& line : *lines) line = to_ascii(line);
  }
  report.title = to_ascii(report.title);
  for (Column& column : grid.columns) {
    column.heading = to_ascii(column.heading);
    column.unit = to_ascii(column.unit);
  }
  for (Row& row : grid.rows) {
    for (Cell& cell : row) cell.shown = to_ascii(shown_text(cell));
  }
  return report;
}

std::string markdown(const Report& report) {
  const Grid& grid = report.table();
  const std::vector<std::size_t> columns = shown_columns(grid);
  const Texts texts = shown_texts(grid, columns);
  std::string out;
  for (const auto& line : head_lines(report)) out += line + "\n";
  out += "\n|";
  for (std::size_t i = 0; i < texts[0].size(); ++i) {
    out += " " + texts[0][i] + (texts[1][i].empty() ? "" : " [" + texts[1][i] + "]") + " |";
  }
  out += "\n|";
  for (const std::size_t column : columns) out += grid.columns[column].words ? ":---|" : "---:|";
  out += "\n";
  for (std::size_t row = 2; row < texts.size(); ++row) {
    out += "|";
    for (const auto& cell : texts[row]) out += " " + cell + " |";
    out += "\n";
  }
  out += "\n";
  for (const auto& line : report.notes) out += line + "\n";
  return out;
}

std::string latex(const Report& report) {
  const Grid& grid = report.table();
  const Texts texts = shown_texts(grid, shown_columns(grid));
  std::string out;
  for (const auto& line : head_lines(report)) out += "% " + line + "\n";
  out += "\\begin{tabular}{";
  for (const std::size_t column : shown_columns(grid)) out += grid.columns[column].words ? 'l' : 'r';
  out += "}\n\\hline\n";
  for (std::size_t row = 0; row < texts.size(); ++row) {
    for (std::size_t i = 0; i < texts[row].size(); ++i) out += (i ? " & " : "") + to_latex(texts[row][i]);
    out += row == 1 ? " \\\\\n\\hline\n" : " \\\\\n";
  }
  out += "\\hline\n\\end{tabular}\n";
  for (const auto& line : report.notes) out += "% " + line + "\n";
  return out;
}

}  // namespace

std::string headline(const std::string& command, const std::string& what) {
  return fmt::format("clatter {}, {}: {}", version, command, what);
}

Report begun_report(const std::string& command, const std::string& what) {
  Report report;
  report.title = headline(command, what);
  report.fields = Value::Fields{{"clatter", version}};
  return report;
}

std::string shown_text(const Cell& cell) {
  if (cell.shown) return *cell.shown;
  if (!cell.value.number()) return cell.value.text();
  return cell.digits > 0 ? significant(*cell.value.number(), cell.digits) : "?";
}

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t width, const std::string& indent) {
  const std::size_t lead = text.find_first_not_of(' ');
  if (lead == std::string::npos || display_width(text) <= width) return text;
  std::istringstream words(text);
  std::string out, word, line(lead, ' ');
  bool first = true;
  while (words >> word) {
    if (!first && display_width(line) + 1 + display_width(word) > width) {
      out += line + "\n";
      line = std::string(lead, ' ') + indent;
      first = true;
    }
    line += (first ? "" : " ") + word;
    first = false;
  }
  return out + line;
}

void fit_columns(Report& report, int digits, const std::vector<std::size_t>& starts) {
  Grid& grid = report.digest ? *report.digest : report.grid;
  const std::vector<Row> whole = grid.rows;
  const std::vector<std::size_t> columns = shown_columns(grid);
  for (const std::size_t first : starts) {
    for (int shown = digits - 1; shown >= 3; --shown) {
      if (natural_width(grid) <= table_width) return;
      for (Row& row : grid.rows) {
        for (std::size_t i = first; i < columns.size() && columns[i] < row.size(); ++i) {
          Cell& cell = row[columns[i]];
          cell.digits = std::min(cell.digits, shown);
        }
      }
    }
  }
  if (natural_width(grid) > table_width) grid.rows = whole;  // it stands in several blocks, which take all digits
}

std::string report_text(const Report& report, const TextStyle& style) {
  switch (style.format) {
    case Format::json: return json_text(report.fields);
    case Format::csv: return csv_text(report, style.bare);
    case Format::markdown: return markdown(report);
    case Format::latex: return latex(report);
    case Format::table: break;
  }
  return style.ascii ? to_ascii(aligned(plain(report))) : aligned(report);
}

}  // namespace clatter::validation::inline output
