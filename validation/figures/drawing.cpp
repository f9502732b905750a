// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/drawing.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "validation/figures/gnuplot.hpp"
#include "validation/figures/plot_text.hpp"

namespace clatter::validation::inline figures {
namespace {

std::string script(const Figure& figure, const FigurePlot& plot, std::size_t index) {
  const PlotData data{figure.columns, figure.rows};
  return fmt::format(
             "set encoding utf8\nset terminal svg size 560,380 dynamic font 'sans-serif,13' background '#ffffff' name "
             "'f{}_{}'\n"
             "set border 3 lc rgb '#444444'\nset tics nomirror\nset grid lc rgb '#dddddd' lt 1\nset key outside top "
             "center horizontal samplen 1.5\nset boxwidth 0.6\n",
             figure.number, index) +
         fmt::format("set ylabel {}\n", gnuplot_quoted(plot.y_label)) + axes_text(data, plot) +
         data_blocks(data, plot, "$d") + plot_command(data, plot, "$d");
}

/// Without the declarations that only a file of its own may have.
std::string element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

}  // namespace

std::vector<std::string> draw(const Figure& figure) {
  std::vector<FigurePlot> plots;
  for (const FigurePlot& plot : figure.plots) {
    plots.push_back(plot);
    if (!plot.zoom) continue;
    plots.push_back(plot);
    plots.back().title += (plot.title.empty() ? "" : ", ") + plot.zoom->title;
    plots.back().x = plot.zoom->x;
    plots.back().y.high = no_number;
  }
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    pictures.push_back(element(run_gnuplot(script(figure, plots[i], i))));
  }
  return pictures;
}

}  // namespace clatter::validation::inline figures
