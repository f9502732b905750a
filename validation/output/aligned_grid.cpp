// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/aligned_grid.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace clatter::validation::inline output {
namespace {

constexpr std::size_t gap = 2;            // before each column
constexpr std::size_t least_folded = 20;  // narrower texts are not folded

/// A shown column: its texts, and how wide they stand.
struct TableColumn {
  std::string heading, unit;
  bool words = false;
  std::vector<std::string> cells;
  std::size_t width = 0;

  [[nodiscard]] std::size_t least_width() const {
    return std::min(width, std::max({least_folded, display_width(heading), display_width(unit)}));
  }
};
using TableColumns = std::vector<TableColumn>;

TableColumns table_columns(const Grid& grid) {
  TableColumns columns;
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    const Column& column = grid.columns[i];
    if (!column.shown) continue;
    TableColumn shown{column.heading, column.unit, column.words, {}};
    shown.width = std::max(display_width(shown.heading), display_width(shown.unit));
    for (const Row& row : grid.rows) {
      shown.cells.push_back(i < row.size() ? shown_text(row[i]) : "");
      shown.width = std::max(shown.width, display_width(shown.cells.back()));
    }
    columns.push_back(std::move(shown));
  }
  return columns;
}

std::size_t total_width(const TableColumns& columns) {
  std::size_t total = 0;
  for (const TableColumn& column : columns) total += column.width + gap;
  return total;
}

/// Takes what is too wide from the columns of words, the widest first.
void fold_words(TableColumns& columns) {
  std::vector<TableColumn*> words;
  for (TableColumn& column : columns) {
    if (column.words) words.push_back(&column);
  }
  std::stable_sort(words.begin(), words.end(),
                   [](const TableColumn* one, const TableColumn* other) { return one->width > other->width; });
  for (TableColumn* const column : words) {
    const std::size_t total = total_width(columns);
    if (total <= table_width) return;
    const std::size_t excess = total - table_width;
    column->width -= std::min(excess, column->width - column->least_width());
  }
}

/// As many columns beside each other as fit, at least one after the leading ones.
std::vector<TableColumns> blocks_of(const TableColumns& columns, std::size_t leading) {
  const auto first = columns.begin() + static_cast<std::ptrdiff_t>(std::min(leading, columns.size()));
  const TableColumns keys(columns.begin(), first);
  std::vector<TableColumns> blocks;
  for (auto column = first; column != columns.end();) {
    TableColumns block = keys;
    do {
      block.push_back(*column++);
    } while (column != columns.end() && total_width(block) + gap + column->width <= table_width);
    const std::size_t total = total_width(block);
    if (total > table_width) {  // one column alone
      TableColumn& wide = block.back();
      wide.width -= std::min(total - table_width, wide.width - wide.least_width());
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// The first `width` columns of a text, and what is left of it.
std::string cut_off(std::string& text, std::size_t width) {
  std::size_t end = 0;
  for (std::size_t seen = 0; end < text.size(); ++end) {
    if ((text[end] & 0xC0) != 0x80 && seen++ == width) break;
  }
  std::string head = text.substr(0, end);
  text.erase(0, end);
  return head;
}

/// A text on lines of at most `width` columns; words that are longer are cut.
std::vector<std::string> folded(const std::string& text, std::size_t width) {
  if (display_width(text) <= width) return {text};
  std::vector<std::string> lines;
  std::istringstream broken(wrapped(text, width, ""));
  for (std::string line; std::getline(broken, line);) {
    while (display_width(line) > width) lines.push_back(cut_off(line, width));
    lines.push_back(line);
  }
  return lines;
}

std::string padded(const std::string& text, std::size_t width, bool words) {
  const std::string blanks(width - display_width(text), ' ');
  return words ? text + blanks : blanks + text;
}

/// One row of cells, on as many lines as the highest of them needs.
std::string row_text(const TableColumns& columns, const std::vector<std::string>& cells) {
  std::vector<std::vector<std::string>> lines;
  std::size_t height = 1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    lines.push_back(folded(cells[i], columns[i].width));
    height = std::max(height, lines.back().size());
  }
  std::string out;
  for (std::size_t k = 0; k < height; ++k) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      line +=
          std::string(gap, ' ') + padded(k < lines[i].size() ? lines[i][k] : "", columns[i].width, columns[i].words);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string block_text(const TableColumns& columns, std::size_t rows) {
  std::vector<std::string> headings, units;
  for (const TableColumn& column : columns) {
    headings.push_back(column.heading);
    units.push_back(column.unit);
  }
  std::string out = row_text(columns, headings) + row_text(columns, units) + std::string(gap, ' ');
  for (std::size_t i = gap; i < total_width(columns); ++i) out += "─";
  out += "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const TableColumn& column : columns) cells.push_back(column.cells[row]);
    out += row_text(columns, cells);
  }
  return out;
}

}  // namespace

std::size_t natural_width(const Grid& grid) { return total_width(table_columns(grid)); }

std::string aligned_grid(const Grid& grid) {
  TableColumns columns = table_columns(grid);
  fold_words(columns);
  if (total_width(columns) <= table_width) return block_text(columns, grid.rows.size());
  std::string out;
  for (const TableColumns& block : blocks_of(table_columns(grid), grid.leading)) {
    out += (out.empty() ? "" : "\n") + block_text(block, grid.rows.size());
  }
  return out;
}

}  // namespace clatter::validation::inline output
