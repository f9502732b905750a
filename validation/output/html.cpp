// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/html.hpp"

#include <fmt/format.h>

namespace clatter::validation {
namespace {

std::string paragraphs(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += (out.empty() ? "" : "<br>\n") + html_escaped(line);
  return out.empty() ? "" : "<p>" + out + "</p>\n";
}

std::string heading(const Column& column) {
  const std::string unit = column.unit.empty() ? "" : "<br>" + html_escaped(column.unit);
  return fmt::format("<th style=\"text-align: {}\">{}{}</th>", column.words ? "left" : "right",
                     html_escaped(column.heading), unit);
}

std::string cell_text(const Cell& cell, const Column& column) {
  return fmt::format("<td style=\"text-align: {}\">{}</td>", column.words ? "left" : "right",
                     html_escaped(shown_text(cell)));
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string html_table(const Report& report) {
  const Grid& table = report.table();
  std::string out = paragraphs(head_lines(report)) + "<table>\n<thead><tr>";
  for (const Column& column : table.columns) {
    if (column.shown) out += heading(column);
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const Row& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (table.columns[i].shown) out += cell_text(row[i], table.columns[i]);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n" + paragraphs(notes_and_commands(report));
}

}  // namespace clatter::validation
