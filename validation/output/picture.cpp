// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "validation/output/gnuplot.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {
namespace {

// Lengths in units of the SVG's pixel.
constexpr double whole_width = 800, left_margin = 100, right_margin = 20, top_margin = 8, line_height = 19;
constexpr double bottom_margin = 60, key_line = 19, above_panel = 18, character_width = 8.4, key_sample = 62;
constexpr std::array<double, 4> panel_heights{380, 250, 200, 160};  // with one, two, three, or more panels
constexpr std::size_t title_columns = 112;
constexpr double most_whole_tics = 20;
constexpr double png_scale = 1.4;       // 1120 pixels wide
constexpr double png_font_scale = 0.7;  // its font sizes are points, those of SVG pixels

std::vector<std::string> title_of(const Picture& picture) {
  // A title that is too long for its line goes on below.
  const std::size_t cut =
      display_width(picture.what) > title_columns * 3 / 4 ? picture.what.find("; ") : std::string::npos;
  std::vector<std::string> lines{picture.what.substr(0, cut)};
  std::string joined = cut == std::string::npos ? "" : picture.what.substr(cut + 2);
  const auto finish = [&] {
    std::istringstream stream(wrapped(joined, title_columns));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    joined.clear();
  };
  for (const std::string& part : picture.scene) {
    if (!joined.empty() && display_width(joined) + 2 + display_width(part) > title_columns) finish();
    joined += (joined.empty() ? "" : "; ") + part;
  }
  finish();
  return lines;
}

/// The legend above a panel, with as many names in a line as fit.
struct Key {
  std::size_t names = 0, columns = 1;
  explicit Key(const FigurePlot& plot) {
    std::size_t longest = 0;
    for (const FigureCurve& curve : plot.curves) {
      if (curve.legend.empty()) continue;
      ++names;
      longest = std::max(longest, display_width(curve.legend));
    }
    columns = std::max<std::size_t>(
        1, static_cast<std::size_t>((whole_width - left_margin - right_margin) /
                                    (character_width * static_cast<double>(longest) + key_sample)));
  }
  [[nodiscard]] double height() const {
    return above_panel + key_line * static_cast<double>((names + columns - 1) / columns);
  }
};

/// Where the panels stand, measured from above.
struct Layout {
  std::vector<double> tops;
  double panel, height;
  Layout(std::size_t lines, const std::vector<PicturePanel>& panels)
      : panel(panel_heights[std::min(panels.size(), panel_heights.size()) - 1]),
        height(top_margin + line_height * static_cast<double>(lines)) {
    for (const PicturePanel& one : panels) {
      tops.push_back(height + Key(one.plot).height());
      height = tops.back() + panel;
      const bool is_last = &one == &panels.back();
      if (!is_last && !one.plot.x_label.empty()) height += bottom_margin;  // an axis of its own
    }
    height += bottom_margin;
  }
};

std::string terminal_text(PictureFormat format, double height) {
  if (format == PictureFormat::svg) {
    return fmt::format("set terminal svg size {},{} font 'sans-serif,13' background '#ffffff' name 'clatter'\n",
                       whole_width, height);
  }
  return fmt::format(
      "set terminal pngcairo size {},{} font 'sans-serif,13' fontscale {} linewidth {} pointscale {} background "
      "'#ffffff'\n",
      png_scale * whole_width, png_scale * height, png_font_scale * png_scale, png_scale, png_scale);
}

std::string title_text(const std::vector<std::string>& lines, double height) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += fmt::format("set label {} {} at screen {}, screen {} left noenhanced font '{}'\n", i + 1,
                        gnuplot_quoted(lines[i]), 12 / whole_width,
                        1 - (top_margin + line_height * (static_cast<double>(i) + 0.5)) / height,
                        i == 0 ? "sans-serif Bold,14" : "sans-serif,12");
  }
  return text;
}

std::string panel_text(const PicturePanel& panel, const Layout& layout, std::size_t i) {
  const PlotData data{panel.columns, panel.rows};
  std::string text = fmt::format("set tmargin at screen {}\nset bmargin at screen {}\nset key maxcols {}\n",
                                 1 - layout.tops[i] / layout.height,
                                 1 - (layout.tops[i] + layout.panel) / layout.height, Key(panel.plot).columns);
  text += axes_text(data, panel.plot);
  // As a label, so that the names stand in line and wide numbers do not push them off the page.
  text += fmt::format("set label 10 {} at screen {}, graph 0.5 center rotate by 90\n",
                      gnuplot_quoted(panel.plot.y_label), 14 / whole_width);
  if (panel.plot.x_label.empty()) text += "set format x ''\n";
  if (panel.plot.whole_x && panel.plot.x.high - panel.plot.x.low <= most_whole_tics) text += "set xtics 1\n";
  if (panel.plot.whole_y) text += "set ytics 1\n";
  const std::string name = fmt::format("$panel{}_", i + 1);
  return text + data_blocks(data, panel.plot, name) + plot_command(data, panel.plot, name) +
         "unset logscale\nset size noratio\nset format '% h'\nset xtics autofreq\nset ytics autofreq\n" +
         (panel.plot.no_axes ? axes_style : "");
}

}  // namespace

const char* terminal_name(PictureFormat format) { return format == PictureFormat::svg ? "svg" : "pngcairo"; }

std::string picture_script(const Picture& picture, PictureFormat format, const std::string& output) {
  const std::vector<std::string> lines = title_of(picture);
  const Layout layout(lines.size(), picture.panels);
  std::string text = "set encoding utf8\n" + terminal_text(format, layout.height);
  if (!output.empty()) text += fmt::format("set output {}\n", gnuplot_quoted(output));
  text += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", left_margin / whole_width,
                      1 - right_margin / whole_width);
  text += std::string(axes_style) +
          "set key at graph 0, graph 1.02 bottom left horizontal Left reverse noenhanced samplen 1.5\nset boxwidth "
          "0.6\nset multiplot\n";
  text += title_text(lines, layout.height);
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    text += panel_text(picture.panels[i], layout, i);
    if (i == 0) text += "unset label\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace clatter::validation
