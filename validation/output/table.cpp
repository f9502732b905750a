#include "validation/output/table.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using Texts = std::vector<std::vector<std::string>>;

std::vector<std::size_t> shown_columns(const Table& table) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].shown) shown.push_back(i);
  }
  return shown;
}

/// Heading, unit and cell texts of the shown columns.
Texts shown_texts(const Table& table, const std::vector<std::size_t>& shown) {
  Texts texts(2);
  for (const std::size_t i : shown) {
    texts[0].push_back(table.columns[i].heading);
    texts[1].push_back(table.columns[i].unit);
  }
  for (const auto& row : table.rows) {
    auto& line = texts.emplace_back();
    for (const std::size_t i : shown) line.push_back(i < row.size() ? shown_text(row[i]) : "");
  }
  return texts;
}

std::vector<std::size_t> widths(const Texts& texts) {
  std::vector<std::size_t> width(texts[0].size(), 0);
  for (const auto& line : texts) {
    for (std::size_t i = 0; i < line.size(); ++i) width[i] = std::max(width[i], display_width(line[i]));
  }
  return width;
}

std::string padded(const std::string& text, std::size_t width, bool words) {
  const std::string blanks(width - display_width(text), ' ');
  return words ? text + blanks : blanks + text;
}

std::string aligned(const Table& table) {
  const std::vector<std::size_t> columns = shown_columns(table);
  const Texts texts = shown_texts(table, columns);
  const auto width = widths(texts);
  std::string out;
  for (const auto& line : table.head) out += wrapped(line) + "\n";
  std::size_t total = 0;
  for (const std::size_t w : width) total += w + 2;
  for (std::size_t row = 0; row < texts.size(); ++row) {
    std::string line;
    for (std::size_t i = 0; i < width.size(); ++i) {
      line += "  " + padded(texts[row][i], width[i], table.columns[columns[i]].words);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    if (row != 1) continue;
    out += "  ";
    for (std::size_t i = 2; i < total; ++i) out += "─";
    out += "\n";
  }
  for (const auto& line : table.notes) out += wrapped(line) + "\n";
  return out;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string comma_separated(const Table& table) {
  std::string out;
  for (const auto& line : table.head) out += "# " + line + "\n";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out += (i ? "," : "") + quoted(table.columns[i].name);
  }
  out += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out += (i ? "," : "") + (row[i].number ? shortest(*row[i].number) : quoted(row[i].text));
    }
    out += "\n";
  }
  for (const auto& line : table.notes) out += "# " + line + "\n";
  return out;
}

std::string markdown(const Table& table) {
  const std::vector<std::size_t> columns = shown_columns(table);
  const Texts texts = shown_texts(table, columns);
  std::string out;
  for (const auto& line : table.head) out += line + "\n";
  out += "\n|";
  for (std::size_t i = 0; i < texts[0].size(); ++i) {
    out += " " + texts[0][i] + (texts[1][i].empty() ? "" : " [" + texts[1][i] + "]") + " |";
  }
  out += "\n|";
  for (const std::size_t column : columns) out += table.columns[column].words ? ":---|" : "---:|";
  out += "\n";
  for (std::size_t row = 2; row < texts.size(); ++row) {
    out += "|";
    for (const auto& cell : texts[row]) out += " " + cell + " |";
    out += "\n";
  }
  out += "\n";
  for (const auto& line : table.notes) out += line + "\n";
  return out;
}

/// Characters that LaTeX reads as commands, and the symbols that the program prints.
std::string latex_text(const std::string& text) {
  static const std::array<std::pair<const char*, const char*>, 38> table{{{"\\", "\\textbackslash{}"},
                                                                          {"%", "\\%"},
                                                                          {"#", "\\#"},
                                                                          {"_", "\\_"},
                                                                          {"&", "\\&"},
                                                                          {"°", "$^\\circ$"},
                                                                          {"Ω", "$\\Omega$"},
                                                                          {"β", "$\\beta$"},
                                                                          {"γ", "$\\gamma$"},
                                                                          {"θ", "$\\theta$"},
                                                                          {"μ", "$\\mu$"},
                                                                          {"Σ", "$\\Sigma$"},
                                                                          {"·", "$\\cdot$"},
                                                                          {"…", "\\dots{}"},
                                                                          {"∞", "$\\infty$"},
                                                                          {"±", "$\\pm$"},
                                                                          {"−", "$-$"},
                                                                          {"₁", "$_1$"},
                                                                          {"₂", "$_2$"},
                                                                          {"₃", "$_3$"},
                                                                          {"²", "$^2$"},
                                                                          {"ₙ", "$_n$"},
                                                                          {"ₜ", "$_t$"},
                                                                          {"≤", "$\\le$"},
                                                                          {"ₖ", "$_k$"},
                                                                          {"ₛ", "$_s$"},
                                                                          {"³", "$^3$"},
                                                                          {"⁴", "$^4$"},
                                                                          {"→", "$\\to$"},
                                                                          {"≈", "$\\approx$"},
                                                                          {"–", "--"},
                                                                          {"π", "$\\pi$"},
                                                                          {"ω", "$\\omega$"},
                                                                          {"α", "$\\alpha$"},
                                                                          {"√", "$\\surd$"},
                                                                          {"×", "$\\times$"},
                                                                          {"✓", "$\\surd$"},
                                                                          {"✗", "$\\times$"}}};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto match = std::find_if(table.begin(), table.end(), [&](const auto& pair) {
      return text.compare(i, std::string_view(pair.first).size(), pair.first) == 0;
    });
    if (match == table.end()) {
      out += text[i++];
    } else {
      out += match->second;
      i += std::string_view(match->first).size();
    }
  }
  return out;
}

std::string latex(const Table& table) {
  const Texts texts = shown_texts(table, shown_columns(table));
  std::string out;
  for (const auto& line : table.head) out += "% " + line + "\n";
  out += "\\begin{tabular}{" + std::string(texts[0].size(), 'r') + "}\n\\hline\n";
  for (std::size_t row = 0; row < texts.size(); ++row) {
    for (std::size_t i = 0; i < texts[row].size(); ++i) {
      out += (i ? " & " : "") + latex_text(texts[row][i]);
    }
    out += row == 1 ? " \\\\\n\\hline\n" : " \\\\\n";
  }
  out += "\\hline\n\\end{tabular}\n";
  for (const auto& line : table.notes) out += "% " + line + "\n";
  return out;
}

}  // namespace

std::string shown_text(const Cell& cell) {
  if (!cell.number) return cell.text;
  return cell.digits > 0 ? significant(*cell.number, cell.digits) : "?";
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

std::string to_ascii(const std::string& text) {
  static const std::array<std::pair<const char*, const char*>, 47> table{
      {{"°", "deg"},   {"Ω", "Omega"}, {"ω", "omega"}, {"β", "beta"},  {"γ", "gamma"}, {"θ", "theta"}, {"μ", "mu"},
       {"Σ", "sum "},  {"·", "*"},     {"…", "..."},   {"∞", "inf"},   {"±", "+-"},    {"−", "-"},     {"₁", "1"},
       {"₂", "2"},     {"₃", "3"},     {"²", "^2"},    {"³", "^3"},    {"⁴", "^4"},    {"ₛ", "_s"},    {"≈", "~"},
       {"✓", "+"},     {"✗", "X"},     {"δ", "delta"}, {"ₖ", "_k"},    {"ₙ", "_n"},    {"ₜ", "_t"},    {"ᵢ", "_i"},
       {"≤", "<="},    {"≥", ">="},    {"─", "-"},     {"–", "-"},     {"é", "e"},     {"×", "x"},     {"φ", "phi"},
       {"α", "alpha"}, {"σ", "sigma"}, {"′", "'"},     {"″", "''"},    {"½", "1/2"},   {"→", "->"},    {"√", "sqrt "},
       {"Δ", "d"},     {"⇒", "=>"},    {"π", "pi"},    {"Γ", "Gamma"}, {"₀", "0"}}};
  std::string out = text;
  for (const auto& [from, to] : table) {
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos;) {
      out.replace(at, std::string_view(from).size(), to);
      at += std::string_view(to).size();
    }
  }
  return out;
}

std::string table_text(const Table& table, const TableStyle& style) {
  switch (style.format) {
    case Format::csv: return comma_separated(table);
    case Format::markdown: return markdown(table);
    case Format::latex: return latex(table);
    default: break;
  }
  if (!style.ascii) return aligned(table);
  Table plain = table;  // before aligning, since widths change
  for (auto& line : plain.head) line = to_ascii(line);
  for (auto& line : plain.notes) line = to_ascii(line);
  for (auto& column : plain.columns) {
    column.heading = to_ascii(column.heading);
    column.unit = to_ascii(column.unit);
  }
  for (auto& row : plain.rows) {
    for (auto& cell : row) cell.text = to_ascii(cell.text);
  }
  return to_ascii(aligned(plain));
}

}  // namespace clatter::validation
