// SPDX-License-Identifier: GPL-3.0-or-later
// The map as a heat map, written as SVG without another program.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/reports/extremes_report.hpp"

namespace clatter::validation::inline reports {
namespace {

constexpr double left_margin = 150, strip = 780, right_margin = 20, row_height = 15, axis_gap = 36, top = 118;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

/// Viridis in eight steps, dark for few digits: told apart by every kind of colour vision, and by lightness alone.
const char* colour_of(double digits) {
  constexpr std::array colours{"#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"};
  return colours[std::min<std::size_t>(static_cast<std::size_t>(digits / 2), colours.size() - 1)];
}

/// A pattern of its own for each kind of refusal.
const char* fill_of(const ExtremeCell& cell) {
  switch (cell.verdict) {
    case CellVerdict::number: return colour_of(cell.digits());
    case CellVerdict::bad_input: return "url(#bad-input)";
    case CellVerdict::outside_model: return "url(#outside-model)";
    case CellVerdict::not_computed: return "url(#not-computed)";
    case CellVerdict::ended_early:
    case CellVerdict::time_limit: return "url(#ended-early)";
    case CellVerdict::broken: return "#d00000";
  }
  return "none";
}

std::string tooltip(const ExtremeCell& cell) {
  const std::string what = cell.has_number()
                               ? fmt::format("{} digits, {}", significant(cell.digits(), 3), cell.measure.outcome)
                               : fmt::format("{}: {}", verdict_name(cell.verdict), cell.reason);
  return escaped(fmt::format("{} {}, {}: {}", cell.axis, cell.label, level_name(cell.model), what));
}

std::string text(double x, double y, const std::string& attributes, const std::string& words) {
  return fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", x, y, attributes, escaped(words));
}

std::string box(double x, double y, double width, double height, const std::string& fill) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"", x, y, width,
                     height, fill);
}

std::string definitions() {
  const auto pattern = [](const char* name, const char* marks) {
    return fmt::format(
        "<pattern id=\"{}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
        "<rect width=\"6\" height=\"6\" fill=\"#f2f2f2\"/>{}</pattern>\n",
        name, marks);
  };
  return "<defs>\n" + pattern("bad-input", "<path d=\"M0 6L6 0\" stroke=\"#8a8a8a\" stroke-width=\"1\"/>") +
         pattern("outside-model", "<path d=\"M0 0L6 6M0 6L6 0\" stroke=\"#6a6a6a\" stroke-width=\"0.9\"/>") +
         pattern("not-computed", "<circle cx=\"3\" cy=\"3\" r=\"1.3\" fill=\"#6a6a6a\"/>") +
         pattern("ended-early", "<path d=\"M0 3H6\" stroke=\"#8a8a8a\" stroke-width=\"1.2\"/>") + "</defs>\n";
}

std::string legend() {
  std::string out = text(left_margin, 62, "font-size=\"12\"", "right digits:");
  double x = left_margin + 82;
  for (int digits = 0; digits < 16; digits += 2) {
    out += box(x, 50, 40, 16, colour_of(digits)) + "/>\n";
    out += text(x + 20, 62,
                fmt::format("text-anchor=\"middle\" font-size=\"11\" fill=\"{}\"", digits < 8 ? "#ffffff" : "#000000"),
                digits == 14 ? "14–16" : fmt::format("{}–{}", digits, digits + 2));
    x += 40;
  }
  out += text(left_margin, 86, "font-size=\"12\"", "no number:");
  x = left_margin + 82;
  for (const auto& [name, words] : {std::pair{"bad-input", "bad input"},
                                    {"outside-model", "outside the model"},
                                    {"not-computed", "not computed"},
                                    {"ended-early", "run ended early"}}) {
    out += box(x, 74, 40, 16, fmt::format("url(#{})", name)) + " stroke=\"#bbbbbb\"/>\n";
    out += text(x + 46, 86, "font-size=\"11\"", words);
    x += 160;
  }
  return out;
}

/// Cells of one axis and model, side by side.
std::string strip_of(const std::vector<const ExtremeCell*>& cells, double y) {
  std::string out;
  const double width = strip / static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out += box(left_margin + width * static_cast<double>(i), y, width + 0.3, row_height - 2, fill_of(*cells[i])) +
           "><title>" + tooltip(*cells[i]) + "</title></rect>\n";
  }
  return out;
}

/// Values under an axis, as many as there is room for, both ends included.
std::string scale_of(const std::vector<const ExtremeCell*>& cells, double y) {
  std::string out;
  const double width = strip / static_cast<double>(cells.size());
  const std::size_t step = std::max<std::size_t>(1, (cells.size() + 12) / 13);
  for (std::size_t i = 0; i < cells.size(); i += step) {
    const bool crowds_last = i + step >= cells.size() && i + 1 < cells.size() && cells.size() - 1 - i < (step + 1) / 2;
    const std::size_t at = crowds_last || i + step >= cells.size() ? cells.size() - 1 : i;
    out += text(left_margin + width * (static_cast<double>(at) + 0.5), y,
                "text-anchor=\"middle\" font-size=\"9.5\" fill=\"#444444\"", cells[at]->label);
  }
  return out;
}

std::vector<const ExtremeCell*> cells_of(const ExtremesMap& map, const std::string& axis, ModelLevel model) {
  std::vector<const ExtremeCell*> cells;
  for (const ExtremeCell& cell : map.cells) {
    if (cell.axis == axis && cell.model == model) cells.push_back(&cell);
  }
  return cells;
}

}  // namespace

std::string extremes_picture(const ExtremesMap& map) {
  std::string body;
  double y = top;
  for (const MapAxis& axis : map_axes()) {
    if (axis.name == "long") continue;
    std::vector<const ExtremeCell*> last;
    const double begin = y;
    for (const ModelLevel model : all_levels) {
      const auto cells = cells_of(map, axis.name, model);
      if (cells.empty()) continue;
      body += text(left_margin - 6, y + 10.5, "text-anchor=\"end\" font-size=\"11\"", level_name(model));
      body += strip_of(cells, y);
      last = cells;
      y += row_height;
    }
    if (last.empty()) continue;
    body += text(12, begin + 10.5, "font-size=\"12\" font-weight=\"bold\"", axis.symbol);
    body += text(left_margin, begin - 3, "font-size=\"9\" fill=\"#555555\"", axis.what);
    body += scale_of(last, y + 8);
    y += axis_gap;
  }
  const double width = left_margin + strip + right_margin;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
             "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             width, y) +
         definitions() +
         text(12, 26, "font-size=\"17\" font-weight=\"bold\"",
              "What holds at the extremes: digits of each model to both ends of each quantity") +
         legend() + body + "</svg>\n";
}

}  // namespace clatter::validation::inline reports
